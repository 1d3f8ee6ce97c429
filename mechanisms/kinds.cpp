// kinds.cpp — from the keys of a slider-crank and its loads to the element.
#include "mechanisms/kinds.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/network.h"
#include "engine/units.h"
#include "mechanisms/joint_keys.h"
#include "mechanisms/slider_crank.h"

namespace kurbel {
namespace {

Key working_end_key() {
  return {.name = "working_end",
          .type = KeyType::text,
          .fallback = "\"extended\"",
          .doc = "end of the stroke that the distance is counted from",
          .choices = {"extended", "folded"}};
}
Key work_key(const char* fallback) {
  return {.name = "work",
          .type = KeyType::text,
          .fallback = fallback,
          .doc = "line of the energy balance",
          .choices = {"useful", "harmful", "driving"}};
}

Account account_of(const Section& s) {
  const std::string& name = s.text("work");
  return name == "driving" ? Account::driving : name == "harmful" ? Account::harmful : Account::useful;
}

WorkingEnd working_end(const Section& s, const SliderCrank& crank) {
  const bool extended = s.text("working_end") == "extended";
  return {extended ? crank.x_max : crank.x_min, extended ? 1 : -1};
}

std::string mm(double metres) { return fmt::format("{:.6g} mm", metres * 1e3); }

bool read_press(const Section& s, const SliderCrank& crank, const std::string& what, Messages& messages,
                SliderLoad& load) {
  const double travel = s.number("nominal_travel"), rise = s.number("rise"), through = s.number("breakthrough"),
               drop = s.number("drop");
  const std::size_t before = messages.all().size();
  if (travel > crank.stroke())
    messages.add(s.where("nominal_travel"), fmt::format("{}: nominal_travel = {}; must be ≤ the stroke of {}", what,
                                                        mm(travel), mm(crank.stroke())));
  if (rise > travel)
    messages.add(s.where("rise"),
                 fmt::format("{}: rise = {}; must be ≤ nominal_travel = {}", what, mm(rise), mm(travel)));
  if (through >= travel - rise && through > 0 && rise <= travel)
    messages.add(s.where("breakthrough"),
                 fmt::format("{}: breakthrough = {}; must be < nominal_travel − rise = {}, where the full force stands",
                             what, mm(through), mm(travel - rise)));
  if (drop > through)
    messages.add(s.where("drop"),
                 fmt::format("{}: drop = {}; must be ≤ breakthrough = {}", what, mm(drop), mm(through)));
  if (messages.all().size() > before) return false;
  load.law =
      PressForce::make(working_end(s, crank), crank.stroke(), s.number("nominal_force"), travel, rise, through, drop);
  return true;
}

bool read_table(const Section& s, const SliderCrank& crank, const std::string& what, Messages& messages,
                SliderLoad& load) {
  CurveData data = s["force"].curve;
  const auto refuse = [&](const std::string& text) {
    messages.add(s.where("force"), fmt::format("{}: {}", what, text));
    return false;
  };
  try {
    if (data.over == "travel") {
      if (data.period > 0) return refuse("a table over travel has no period");
      TravelForce law{working_end(s, crank), Curve(data.x, data.y, data.form), {}, crank.stroke()};
      if (!data.x_back.empty()) law.retreat = Curve(data.x_back, data.y_back, data.form);
      load.law = std::move(law);
    } else {
      if (!data.x_back.empty()) return refuse("a table over the crank angle has one branch; drop return_points");
      if (data.period == 0)
        data.period = data.x.back() - data.x.front() > 2 * std::numbers::pi * 1.0001 ? 4 * std::numbers::pi
                                                                                     : 2 * std::numbers::pi;
      load.law = AngleForce{working_end(s, crank), Curve(data.x, data.y, data.form, data.period)};
    }
  } catch (const std::invalid_argument& error) {
    return refuse(error.what());
  }
  return true;
}

bool read_load(const Section& s, const SliderCrank& crank, const std::string& what, Messages& messages,
               SliderLoad& load) {
  const std::string& kind = s.kind->name;
  load.account = account_of(s);
  if (kind == "press") return read_press(s, crank, what, messages, load);
  if (kind == "table") return read_table(s, crank, what, messages, load);
  if (kind == "constant") load.law = ConstantForce{s.number("force")};
  if (kind == "opposing") load.law = OpposingForce{s.number("force")};
  if (kind == "medium") load.law = MediumResistance{s.number("viscous"), s.number("quadratic")};
  return true;
}

// The rod must pass both dead centres, and no body may have less inertia than its mass demands.
bool check_geometry(const Section& s, const SliderCrankData& d, Messages& messages) {
  const std::size_t before = messages.all().size();
  const double reach = d.radius + std::abs(d.offset);
  if (!(d.rod_length > reach))
    messages.add(s.where("rod"),
                 fmt::format("slider-crank \"{}\": rod = {}; must be > radius + |offset| = {} + {} = {}, else the "
                             "crank cannot turn fully; lengthen the rod or shorten the crank",
                             s.name, mm(d.rod_length), mm(d.radius), mm(std::abs(d.offset)), mm(reach)));
  const double least = d.crank_mass * d.crank_com * d.crank_com;
  if (d.crank_inertia < least * (1 - 1e-12))
    messages.add(s.where("crank_inertia"), fmt::format("slider-crank \"{}\": crank_inertia = {:.6g} kg·m²; is about "
                                                       "the axis and must be ≥ crank_mass · crank_com² = {:.6g} kg·m²",
                                                       s.name, d.crank_inertia, least));
  return messages.all().size() == before;
}

// Mean of I_r over a turn (the trapezium rule converges at once on periodic functions) and its least value, which
// lies at a dead centre where the slider stands still.
void find_inertias(SliderCrank& crank, const SliderCrankGeometry& geometry) {
  constexpr int n = 256;
  crank.least_inertia = std::min(crank.reduced->inertia(geometry.extended_angle()).value,
                                 crank.reduced->inertia(geometry.folded_angle()).value);
  for (int i = 0; i < n; ++i) {
    const double inertia = crank.reduced->inertia(2 * std::numbers::pi * i / n).value;
    crank.mean_inertia += inertia / n;
    crank.least_inertia = std::min(crank.least_inertia, inertia);
  }
}

void build_slider_crank(const Section& s, Network& net, Messages& messages) {
  SliderCrank crank;
  crank.name = s.name;
  crank.phase = s.number("phase");
  const SliderCrankData& d = crank.data = slider_crank_data(s);
  const int node = net.add_node(s.name, "", 0);
  net.ports[s.name] = {node, node};
  check_joints(s, messages);
  if (!check_geometry(s, d, messages)) return;
  const SliderCrankGeometry geometry(d);
  crank.x_min = geometry.x_min();
  crank.x_max = geometry.x_max();
  if (s.has("load")) {
    const std::vector<Section>& loads = s["load"].sections;
    for (std::size_t k = 0; k < loads.size(); ++k) {
      SliderLoad load{ConstantForce{}, loads.size() == 1 ? s.name + ".load" : fmt::format("{}.load{}", s.name, k + 1)};
      if (loads[k].sound &&
          read_load(loads[k], crank, fmt::format("slider-crank \"{}\": load", s.name), messages, load))
        crank.loads.push_back(std::move(load));
    }
  }
  if (!messages.empty()) return;  // extraction is the slow part
  try {
    crank.reduced = reduce_slider_crank(d);
    crank.bodies = std::make_shared<SliderCrankBodies>(d);
  } catch (const std::exception&) {  // Simbody's own checks, which speak of matrices
    messages.add(s.at, fmt::format("slider-crank \"{}\": its lengths, masses and inertias lie too far apart to be "
                                   "computed together (crank {:g} kg, rod {:g} kg, slider {:g} kg); check their units",
                                   s.name, d.crank_mass, d.rod_mass, d.slider_mass));
    return;
  }
  find_inertias(crank, geometry);
  const double phase = crank.phase;
  net.put_made(node, s.name, std::make_shared<SliderCrankMaker>(std::move(crank)), {}, phase);
}

}  // namespace

const std::vector<Kind>& slider_load_kinds() {
  static const std::vector<Kind> kinds = {
      {.name = "press",
       .doc = "nominal force before the working end, on the working stroke only, then break-through",
       .placement = Placement::nested,
       .keys = {{.name = "nominal_force",
                 .unit = "N",
                 .domain = not_negative,
                 .doc = "force F_n against the motion",
                 .required = true},
                {.name = "nominal_travel",
                 .unit = "m",
                 .domain = positive,
                 .doc = "distance before the working end where the force begins",
                 .required = true},
                {.name = "rise",
                 .unit = "m",
                 .fallback = "\"0 mm\"",
                 .domain = not_negative,
                 .doc = "travel within which the force rises; 0: an edge"},
                {.name = "breakthrough",
                 .unit = "m",
                 .fallback = "\"0 mm\"",
                 .domain = not_negative,
                 .doc = "distance before the end where the work breaks through; 0: force lasts to the end"},
                {.name = "drop",
                 .unit = "m",
                 .fallback = "\"0 mm\"",
                 .domain = not_negative,
                 .doc = "travel within which the force falls after break-through"},
                working_end_key(),
                work_key("\"useful\"")}},
      {.name = "constant",
       .doc = "force along the stroke, whatever the motion",
       .placement = Placement::nested,
       .keys = {{.name = "force", .unit = "N", .doc = "positive towards the extended end", .required = true},
                work_key("\"useful\"")}},
      {.name = "opposing",
       .doc = "constant force against the motion; holds at standstill",
       .placement = Placement::nested,
       .keys = {{.name = "force", .unit = "N", .domain = not_negative, .doc = "magnitude", .required = true},
                work_key("\"useful\"")}},
      {.name = "medium",
       .doc = "resistance of the medium, F = c v + q v |v|",
       .placement = Placement::nested,
       .keys =
           {{.name = "viscous", .unit = "N*s/m", .fallback = "\"0 N*s/m\"", .domain = not_negative, .doc = "c"},
            {.name = "quadratic", .unit = "N*s2/m2", .fallback = "\"0 N*s2/m2\"", .domain = not_negative, .doc = "q"},
            work_key("\"useful\"")}},
      {.name = "table",
       .doc = "force by table over travel or crank angle (indicator diagram)",
       .placement = Placement::nested,
       .keys = {{.name = "force",
                 .type = KeyType::curve,
                 .unit = "N",
                 .doc = "positive pushes the slider away from the working end; over the distance to that end "
                        "(return_points: branch of the other stroke) or over the crank angle (span up to 360 deg, or "
                        "720 deg for four strokes)",
                 .required = true,
                 .choices = {"travel", "angle"}},
                working_end_key(),
                work_key("\"useful\"")}},
  };
  return kinds;
}

std::vector<Kind> mechanism_kinds() {
  std::vector<Kind> kinds = {
      {.name = "slider-crank",
       .doc = "crank, rod and slider; φ = 0 with the crank along the stroke (extended, without offset)",
       .keys =
           {{.name = "radius", .unit = "m", .domain = positive, .doc = "crank radius r", .required = true},
            {.name = "rod",
             .unit = "m",
             .domain = positive,
             .doc = "rod length l, > radius + |offset|",
             .required = true},
            {.name = "offset", .unit = "m", .fallback = "\"0 m\"", .doc = "of the slider's line from the crank axis"},
            {.name = "crank_mass",
             .unit = "kg",
             .fallback = "\"0 kg\"",
             .domain = not_negative,
             .doc = "mass of the crank"},
            {.name = "crank_com",
             .unit = "m",
             .fallback = "\"0 m\"",
             .doc = "its centre of mass from the axis towards the pin; negative: counterweighted"},
            {.name = "crank_inertia",
             .unit = "kg*m2",
             .fallback = "\"0 kg*m2\"",
             .domain = not_negative,
             .doc = "about the crank's axis"},
            {.name = "rod_mass",
             .unit = "kg",
             .fallback = "\"0 kg\"",
             .domain = not_negative,
             .doc = "mass of the rod"},
            {.name = "rod_com",
             .unit = "m",
             .doc = "its centre of mass from the crank pin along the rod; default: half the rod"},
            {.name = "rod_inertia",
             .unit = "kg*m2",
             .fallback = "\"0 kg*m2\"",
             .domain = not_negative,
             .doc = "about its centre of mass"},
            {.name = "slider_mass",
             .unit = "kg",
             .fallback = "\"0 kg\"",
             .domain = not_negative,
             .doc = "mass of slider and what moves with it"},
            {.name = "gravity",
             .unit = "m/s2",
             .fallback = "\"0 m/s2\"",
             .domain = not_negative,
             .doc = "0: weight is neglected"},
            {.name = "stroke_angle",
             .unit = "rad",
             .fallback = "\"0 deg\"",
             .doc = "direction from crank axis to extended end, above the horizontal: 90 deg slider on top, -90 deg "
                    "top-driven press"},
            {.name = "phase",
             .unit = "rad",
             .fallback = "\"0 deg\"",
             .doc = "crank angle ahead of the shaft's angle (several cylinders)"},
            {.name = "load",
             .type = KeyType::sections,
             .doc = "force on the slider, or a list of them",
             .nested = &slider_load_kinds()}},
       .build = build_slider_crank}};
  for (Key& key : slider_crank_joint_keys()) kinds.front().keys.push_back(std::move(key));
  return kinds;
}

}  // namespace kurbel
