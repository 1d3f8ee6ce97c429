// gears_plots.cpp — outlines of both wheels with the path of contact; sliding, thickness of the teeth.
#include "studies/gears/gears_plots.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "studies/findings/plots.h"
#include "studies/gears/rack_cutting.h"

namespace kurbel {
namespace {

constexpr double shown_sliding = 8;  // specific sliding runs to −∞ at the base circles

GearView::Wheel view_of(const GearPair& p, int i) {
  const MeshedWheel& w = p.wheel[static_cast<std::size_t>(i)];
  GearView::Wheel view;
  view.name = fmt::format("wheel {}", i + 1);
  view.teeth = std::abs(w.teeth);
  view.internal = w.internal();
  for (const OutlinePoint& q : tooth_outline(w, view.teeth > 60 ? 7 : 10)) {
    view.x.push_back(q.x);
    view.y.push_back(q.y);
  }
  const MeshPlace place = mesh_place(p, 0);
  view.centre = i == 0 ? 0 : p.centre_distance;
  view.angle = i == 0 ? 0 : place.angle_2;
  view.speed = i == 0 ? 1 : -1 / p.ratio;
  view.circles = {{"root", 0.5 * std::abs(w.root_diameter)},
                  {"base", 0.5 * std::abs(w.base_diameter)},
                  {"working", 0.5 * std::abs(w.working_diameter)},
                  {"tip", 0.5 * std::abs(w.tip_diameter)}};
  view.edge = 0.5 * w.bore;
  return view;
}

Series over_path(const GearPair& p, const std::string& name, Role role, const std::function<double(double)>& value) {
  std::vector<double> shown = along_path(p);
  std::erase_if(shown, [&](double g) { return !std::isfinite(value(g)) || std::abs(value(g)) > shown_sliding; });
  return series_of(
      name, role, shown, [](double g) { return in_millimetres * g; }, value);
}

std::vector<EventMark> path_marks(const GearPair& p) {
  std::vector<EventMark> marks;
  for (const char name : {'A', 'B', 'C', 'D', 'E'})
    marks.push_back({in_millimetres * p.point(name), fmt::format("{}{}", name, name == 'C' ? ", pitch point" : "")});
  return marks;
}

Plot sliding_plot(const GearStage& s) {
  const GearPair& p = s.pair;
  const double omega = s.speed ? std::abs(*s.speed) : 2 / p.wheel[0].working_diameter;
  return {.title = "Sliding is least at the pitch point and greatest at the ends of the path",
          .x = {"place on the path of contact g", "mm"},
          .y = {s.speed ? "sliding speed v_g" : "sliding speed over pitch-line speed", s.speed ? "m/s" : ""},
          .series = {series_of(
              "flank of wheel 1 over that of wheel 2", Role::elastic, along_path(p),
              [](double g) { return in_millimetres * g; }, [&](double g) { return p.sliding_speed(g, omega); })},
          .marks = path_marks(p)};
}

Plot specific_plot(const GearPair& p) {
  return {.title = "Specific sliding: wear grows towards the root of either wheel",
          .x = {"place on the path of contact g", "mm"},
          .y = {"specific sliding ζ", ""},
          .series = {over_path(p, "wheel 1", Role::elastic, [&](double g) { return p.specific_sliding(g)[0]; }),
                     over_path(p, "wheel 2", Role::orange, [&](double g) { return p.specific_sliding(g)[1]; })},
          .marks = path_marks(p),
          .note = fmt::format("Values beyond ±{:g} are omitted: at a base circle ζ runs to −∞.", shown_sliding)};
}

Plot thickness_plot(const MeshedWheel& w, int i) {
  const double from = w.internal() ? w.tip_diameter : w.form_diameter,
               to = w.internal() ? w.form_diameter : w.tip_diameter;
  std::vector<double> diameters;
  for (int k = 0; k < 101; ++k) diameters.push_back(from + (to - from) * k / 100);
  return {.title = fmt::format("Tooth thickness of wheel {} from its form circle to its tip", i + 1),
          .x = {"radius", "mm"},
          .y = {"transverse tooth thickness s_t", "mm"},
          .series = {series_of(
              fmt::format("wheel {}", i + 1), i == 0 ? Role::elastic : Role::orange, diameters,
              [](double d) { return in_millimetres * 0.5 * std::abs(d); },
              [&](double d) { return in_millimetres * w.thickness(d); })},
          .marks = {{in_millimetres * 0.5 * std::abs(w.reference_diameter), "reference circle"},
                    {in_millimetres * 0.5 * std::abs(w.working_diameter), "working circle"}}};
}

}  // namespace

std::vector<double> along_path(const GearPair& p) {
  constexpr int points = 401;
  std::vector<double> places;
  for (int i = 0; i < points; ++i) places.push_back(p.start + (p.end - p.start) * i / (points - 1));
  return places;
}

GearView drawing_of(const GearStage& s) {
  const GearPair& p = s.pair;
  GearView view{
      .title = fmt::format("{}: both wheels in mesh, transverse section", s.name), .wheels = {}, .points = {}};
  view.note =
      "Wheel 1 turns counterclockwise and drives. Flanks are involutes, external fillets the trochoids that the "
      "rounded rack cuts; fillets of an internal wheel are drawn as circles.";
  view.wheels = {view_of(p, 0), view_of(p, 1)};
  view.pitch_point = 0.5 * p.wheel[0].working_diameter;
  view.direction = std::numbers::pi / 2 - p.working_angle;
  for (const char name : {'A', 'B', 'C', 'D', 'E'}) view.points.push_back({std::string(1, name), p.point(name)});
  view.points.push_back({"T₁", p.limit_start});
  if (!p.internal()) view.points.push_back({"T₂", p.limit_end});
  view.start = p.start;
  view.end = p.end;
  view.base_pitch = p.base_pitch;
  view.first_contact = contact_at(p, 0);
  view.base_radius = 0.5 * p.wheel[0].base_diameter;
  view.close_up = 1.25 * std::max({std::abs(p.start), std::abs(p.end), 2.5 * p.wheel[0].transverse_module});
  return view;
}

std::vector<Plot> plots_of(const GearStage& s) {
  std::vector<Plot> list;
  for (const int i : {0, 1})
    if (const MeshedWheel& w = s.pair.wheel[static_cast<std::size_t>(i)]; !w.internal())
      list.push_back(cutting_plot(w, i + 1));
  for (Plot& plot : std::vector<Plot>{sliding_plot(s), specific_plot(s.pair), thickness_plot(s.pair.wheel[0], 0),
                                      thickness_plot(s.pair.wheel[1], 1)})
    list.push_back(std::move(plot));
  return list;
}

}  // namespace kurbel
