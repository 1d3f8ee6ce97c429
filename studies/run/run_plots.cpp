// run_plots.cpp — speeds, torques, motion of the mechanism and energies over time and over the crank's angle.
#include "studies/run/compare.h"
#include "studies/run/run_findings.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

#include "studies/findings/trace.h"

namespace kurbel {
namespace {

Role role_of(const Result& r, const Results& all) {
  const bool elastic = r.model && is_elastic(*r.model);
  if (!elastic) return Role::rigid;
  // Two elastic models: the first steps back.
  return all.size() > 1 && &r == all.front() ? Role::orange : Role::elastic;
}

std::vector<EventMark> marks_of(const Result& r) {
  std::vector<EventMark> marks;
  for (const Event& e : r.events) marks.push_back({e.t, e.component + ": " + e.what});
  return marks;
}

double largest(const std::vector<const Trace*>& traces) {
  double value = 0;
  for (const Trace* trace : traces)
    for (const double y : trace->y) value = std::max(value, std::abs(y));
  return value;
}

Series series_of(const Trace& trace, const std::string& name, Role role, double x_factor, double y_factor) {
  Series s{.name = name, .role = role, .x = trace.x, .y = trace.y};
  for (double& x : s.x) x *= x_factor;
  for (double& y : s.y) y *= y_factor;
  return s;
}

// One quantity over time, the models over each other. Nothing if no model has it.
std::optional<Plot> over_time(const Results& results, const std::string& channel, const std::string& title,
                              const std::string& label) {
  std::vector<const Trace*> traces;
  for (const Result* r : results)
    if (const Trace* trace = r->traces->find(channel)) traces.push_back(trace);
  if (traces.empty()) return {};
  const ReadableUnit unit = readable_unit(largest(traces), traces.front()->unit, speed_unit_of(*results.back()));
  Plot plot{
      .title = title, .x = {"time", "s"}, .y = {label, unit.unit}, .series = {}, .marks = marks_of(*results.back())};
  for (const Result* r : results)
    if (const Trace* trace = r->traces->find(channel))
      plot.series.push_back(series_of(*trace, r->label, role_of(*r, results), 1, unit.factor));
  return plot;
}

// One quantity over the crank angle in the last whole cycle of each model.
std::optional<Plot> over_angle(const Results& results, const std::string& channel, const std::string& title,
                               const std::string& label) {
  std::vector<std::pair<const Result*, const Trace*>> found;
  for (const Result* r : results) {
    if (r->traces->last_cycles.empty()) continue;
    for (const Trace& trace : r->traces->last_cycles.back().traces)
      if (trace.name == channel) found.emplace_back(r, &trace);
  }
  if (found.empty()) return {};
  std::vector<const Trace*> traces;
  for (const auto& [r, trace] : found) traces.push_back(trace);
  const ReadableUnit unit = readable_unit(largest(traces), traces.front()->unit, speed_unit_of(*results.back()));
  Plot plot{.title = title, .x = {"crank angle", "°"}, .y = {label, unit.unit}, .series = {}};
  for (const auto& [r, trace] : found)
    plot.series.push_back(series_of(*trace, r->label, role_of(*r, results), 180 / std::numbers::pi, unit.factor));
  const CycleTraces& last = results.back()->traces->last_cycles.back();
  plot.note = fmt::format("Last whole cycle ({}: {:.4g} … {:.4g} s).", results.back()->label, last.begin, last.end);
  return plot;
}

std::string link_of(const Result& r) {
  return r.model->network.nodes[static_cast<std::size_t>(r.model->reduction_node)].component;
}

Plot energy_plot(const Result& r) {
  struct Line {
    const char *channel, *name;
    Role role;
  };
  constexpr Line lines[] = {
      {"kinetic_energy", "kinetic energy", Role::elastic}, {"stored_energy", "stored in springs", Role::sky},
      {"work.driving", "driving work", Role::green},       {"work.useful", "useful work", Role::orange},
      {"work.harmful", "harmful work", Role::vermillion},  {"work.weight", "work of weight", Role::purple}};
  std::vector<const Trace*> traces;
  std::vector<Line> found;
  for (const Line& line : lines)
    if (const Trace* trace = r.traces->find(line.channel)) {
      traces.push_back(trace);
      found.push_back(line);
    }
  const ReadableUnit unit = readable_unit(largest(traces), "J");
  Plot plot{.title = fmt::format("Where the energy goes, {} model", r.label),
            .x = {"time", "s"},
            .y = {"energy, work since the start", unit.unit},
            .series = {},
            .marks = marks_of(r)};
  for (std::size_t i = 0; i < traces.size(); ++i)
    if (largest({traces[i]}) > 0)
      plot.series.push_back(series_of(*traces[i], found[i].name, found[i].role, 1, unit.factor));
  if (r.energy.checks == 0 || nothing_turned_over(r.energy)) return plot;
  plot.note = fmt::format(
      "Kinetic and spring energy less all work since the start stays the same to {:.1e} of the energy turned over.",
      r.energy.relative);
  return plot;
}

// Title and label of what clearance and a flexible rod show; empty: the trace is something else.
std::pair<std::string, std::string> of_joint_or_rod(const Trace& trace) {
  const std::string& component = trace.of;
  const auto is = [&](const std::string& words) { return trace.name == Name::own(words, component); };
  for (const auto& [key, joint] :
       {std::pair("crank_pin", "crank pin"), std::pair("wrist_pin", "wrist pin"), std::pair("guide", "guide")}) {
    if (is(std::string(key) + "_force")) return {fmt::format("Contact force, {} of {}", joint, component), "force"};
    if (is(std::string(key) + "_penetration"))
      return {fmt::format("Depth of contact, {} of {}", joint, component), "depth"};
  }
  if (is("rod_deflection")) return {fmt::format("Deflection of the rod of {} at mid-span", component), "deflection"};
  if (is("rod_bending_stress")) return {fmt::format("Greatest bending stress in the rod of {}", component), "stress"};
  return {};
}

// A word that fits the plot's marks, where there are any.
void note_marks(Plot& plot) {
  if (!plot.marks.empty() && plot.note.empty())
    plot.note =
        fmt::format("Ticks below: {} event{}; hover to read.", plot.marks.size(), plot.marks.size() == 1 ? "" : "s");
}

}  // namespace

bool drawable(const Results& results) {
  return std::all_of(results.begin(), results.end(), [](const Result* r) {
    return r->traces && r->model && r->traces->find("angle")->x.size() > 1 && r->traces->find("angle")->x.back() > 0;
  });
}

std::vector<std::string> couplings(const Result& r) {
  std::vector<std::pair<double, std::string>> sorted;
  for (const TorqueJoint& joint : r.model->torque_joints) {
    const Figure* peak = r.find(QuantityKind::peak_torque, joint.component);
    if (r.traces->find("torque." + joint.component))
      sorted.emplace_back(peak ? -std::abs(peak->value) : 0, joint.component);
  }
  std::stable_sort(sorted.begin(), sorted.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<std::string> names;
  for (const auto& [peak, name] : sorted) names.push_back(name);
  return names;
}

std::vector<Plot> motion_plots(const Results& results) {
  std::vector<Plot> plots;
  if (!drawable(results)) return plots;
  const auto add = [&](std::optional<Plot> plot) {
    if (!plot) return;
    note_marks(*plot);
    plots.push_back(std::move(*plot));
  };
  const Result& front = *results.back();
  const std::string link = link_of(front);
  for (const char* end : {"", ".out"})
    add(over_time(results, "speed." + link + end, fmt::format("Speed of {}", link), "speed"));
  add(over_angle(results, "speed." + link, fmt::format("Speed of {} over its angle", link), "speed"));
  const std::vector<std::string> joints = couplings(front);
  for (std::size_t i = 0; i < joints.size() && i < most_torque_plots; ++i) {
    add(over_time(results, "torque." + joints[i], fmt::format("Torque in {}", joints[i]), "torque"));
    add(over_angle(results, "torque." + joints[i], fmt::format("Torque in {} over the crank's angle", joints[i]),
                   "torque"));
  }
  for (const Trace& trace : front.traces->over_time) {
    if (trace.what == QuantityKind::position)
      add(over_time(
          results, trace.name,
          fmt::format("{} of {}", trace.unit == "m" ? "Position of the slider" : "Angle of the rocker", trace.of),
          trace.unit == "m" ? "position" : "angle"));
    if (trace.what == QuantityKind::velocity)
      add(over_time(results, trace.name,
                    fmt::format("Speed of the {} of {}", trace.unit == "m/s" ? "slider" : "rocker", trace.of),
                    trace.unit == "m/s" ? "slider speed" : "rocker speed"));
    if (trace.what == QuantityKind::load_torque) {
      add(over_time(results, trace.name, fmt::format("Load torque on the rocker of {}", trace.of), "torque"));
      add(over_angle(results, trace.name,
                     fmt::format("Load torque on the rocker of {} over the crank's angle", trace.of), "torque"));
    }
    if (trace.what == QuantityKind::force) {
      add(over_time(results, trace.name, fmt::format("Force on the slider of {}", trace.of), "force"));
      add(over_angle(results, trace.name, fmt::format("Force on the slider of {} over the crank's angle", trace.of),
                     "force"));
    }
    if (const auto [title, label] = of_joint_or_rod(trace); !title.empty())
      add(over_time(results, trace.name, title, label));
  }
  for (const Result* r : results) plots.push_back(energy_plot(*r));
  return plots;
}

}  // namespace kurbel
