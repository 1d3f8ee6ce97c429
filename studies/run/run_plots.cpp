// run_plots.cpp — speeds, torques, motion of the mechanism and energies over time and over the crank's angle.
#include "engine/numerics/index.h"
#include "studies/run/compare.h"
#include "studies/run/run_findings.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <set>
#include <utility>

#include "mechanisms/reduced/mechanism.h"
#include "studies/answers/measured_names.h"
#include "studies/claims/headline.h"
#include "studies/claims/ranges.h"
#include "studies/findings/figure_text.h"
#include "studies/findings/plots.h"
#include "studies/findings/trace.h"

namespace kurbel {
namespace {

Role role_of(const Result& r, const Results& all) {
  const bool elastic = r.model && is_elastic(*r.model);
  if (!elastic) return Role::rigid;
  // With two elastic models the first is drawn in orange.
  return all.size() > 1 && &r == all.front() ? Role::orange : Role::elastic;
}

// Events too close to be distinguished are one mark, with the first few of them named.
std::vector<EventMark> marks_of(const Result& r) {
  constexpr double apart = 1.0 / 300;  // of the time shown
  constexpr std::size_t most_reported = 3;
  std::vector<EventMark> marks;
  std::vector<std::string> reported;
  std::size_t count = 0;
  for (const Event& e : r.events) {
    const std::string words = e.component + ": " + e.what;
    if (marks.empty() || e.t - marks.back().x > apart * (r.until - r.begins_at))
      marks.push_back({e.t, words}), reported = {words}, count = 1;
    else if (++count, std::find(reported.begin(), reported.end(), words) == reported.end())
      reported.push_back(words);
    if (count < 2) continue;
    marks.back().text = fmt::format("{} events: ", count);
    for (std::size_t k = 0; k < reported.size() && k < most_reported; ++k)
      marks.back().text += fmt::format("{}{}", k ? ", " : "", reported[k]);
    if (reported.size() > most_reported) marks.back().text += ", …";
  }
  return marks;
}

double largest(const std::vector<const Trace*>& traces) {
  double value = 0;
  for (const Trace* trace : traces)
    for (const double y : trace->y) value = std::max(value, std::abs(y));
  return value;
}

Series series_of(const Trace& trace, const std::string& name, Role role) {
  return {.name = name, .role = role, .x = trace.x, .y = trace.y};
}

// One quantity over time, the models superposed. Empty if no model has it.
std::optional<Plot> over_time(const Results& results, const std::string& channel, const std::string& title,
                              const std::string& label) {
  Plot plot{.title = title, .x = {"time", "s"}, .y = {label, ""}, .marks = marks_of(*results.back())};
  std::string si_unit;
  for (const Result* r : results)
    if (const Trace* trace = r->traces->find(channel)) {
      if (plot.series.empty()) si_unit = trace->unit;
      plot.series.push_back(series_of(*trace, r->label, role_of(*r, results)));
    }
  if (plot.series.empty()) return {};
  const double most = largest_of(plot);
  if (const Trace* measured = results.back()->traces->find(measured_trace(channel)))
    plot.series.push_back(dashed(series_of(*measured, "measured", Role::reference)));
  return in_readable_unit(std::move(plot), si_unit, most, speed_unit_of(*results.back()));
}

std::string link_of(const Result& r) {
  return r.model->network.nodes[static_cast<std::size_t>(r.model->reduction_node)].component;
}

// Over the angle there are no periods of time, and turns that do not follow each other are not joined.
std::string cycle_of_traces(const Result& r) {
  const int joined = r.traces->last_cycles.empty() ? 1 : r.traces->last_cycles.back().cycles;
  return joined == 1 ? "cycle" : cycle_of_figures(r);
}

// Of the reduction link, in the last whole cycle of each model.
std::optional<Plot> over_angle(const Results& results, const std::string& channel, const std::string& title,
                               const std::string& label) {
  Plot plot{.title = title, .x = {angle_of_link(*results.back()), "°"}, .y = {label, ""}};
  std::string si_unit;
  for (const Result* r : results) {
    if (r->traces->last_cycles.empty()) continue;
    const CycleTraces& last = r->traces->last_cycles.back();
    for (const Trace& trace : last.traces) {
      if (trace.name != channel) continue;
      if (plot.series.empty()) si_unit = trace.unit;
      plot.note =
          fmt::format("Last whole {} ({}: {} s).", cycle_of_traces(*r), r->label, range_text(last.begin, last.end));
      Series& series = plot.series.emplace_back(series_of(trace, r->label, role_of(*r, results)));
      for (double& x : series.x) x *= 180 / std::numbers::pi;
    }
  }
  if (plot.series.empty()) return {};
  return in_readable_unit(std::move(plot), si_unit, speed_unit_of(*results.back()));
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
  Plot plot{.title = fmt::format("Where the energy goes, {} model", r.label),
            .x = {"time", "s"},
            .y = {"energy, work since the start", ""},
            .marks = marks_of(r)};
  for (const Line& line : lines) {
    const Trace* const trace = r.traces->find(line.channel);
    if (trace && largest({trace}) > 0) plot.series.push_back(series_of(*trace, line.name, line.role));
  }
  plot = in_readable_unit(std::move(plot), "J");
  if (r.energy.checks == 0 || nothing_turned_over(r.energy)) return plot;
  plot.note =
      fmt::format("Kinetic and spring energy less all work since the start stays the same{}.",
                  r.energy.relative > 0 ? fmt::format(" to {:.1e} of the energy converted", r.energy.relative) : "");
  return plot;
}

// Speed over time with its periods marked, instead of all events; empty if there are no periods.
std::optional<Plot> tachogram(const Results& results, const std::string& channel) {
  const Result& r = *results.back();
  std::optional<Plot> plot = over_time(results, channel, "", "speed");
  if (!plot) return {};
  const Periods& p = r.periods;
  if (!p.steady && !p.run_up_end && !p.run_down_begin && !p.standstill) return {};
  const SpeedUnit speed = speed_unit_of(r);
  plot->marks.clear();
  const auto mark = [&](const std::optional<double>& t, const char* words) {
    if (t) plot->marks.push_back({*t, fmt::format("{}: {}", words, short_text(*t, "s"))});
  };
  mark(p.run_up_end, "steady from here on");
  mark(p.run_down_begin, "run-down begins");
  mark(p.standstill, "rests from here on");
  const std::string link = link_of(r);
  if (p.steady) {
    const double from = p.run_up_end.value_or(r.begins_at), to = p.run_down_begin.value_or(r.until);
    plot->series.push_back({.name = "middle of its vibration",
                            .role = Role::reference,
                            .x = {from, to},
                            .y = {speed.of(p.steady_speed), speed.of(p.steady_speed)},
                            .dashed = true});
    const Figure* mean = r.find(quantities::mean_speed, link);
    plot->title = fmt::format("Tachogram: {} runs steadily at {}{}", link,
                              short_text(mean ? mean->value : p.steady_speed, "rad/s", speed),
                              p.run_up_end ? " from " + short_text(*p.run_up_end, "s") + " on" : "");
  } else {
    plot->title = fmt::format("Tachogram: {}, no steady motion", link);
  }
  plot->note = p.verdict;
  return plot;
}

// The gas force on a mechanism with a compressor as its only load; else null.
const CompressorForce* compressor_of(const Network& network, const std::string& name) {
  const Mechanism* mechanism = find_mechanism(network, name);
  return mechanism && mechanism->loads.size() == 1 ? std::get_if<CompressorForce>(&mechanism->loads.front().law)
                                                   : nullptr;
}
// η_v = 1 + ε − ε (p₂/p₁)^(1/n), n of the re-expansion.
double volumetric_efficiency(const CompressorForce& gas) {
  return 1 + gas.clearance - gas.clearance * std::pow(gas.delivery / gas.suction, 1 / gas.expansion_exponent);
}

// Force on the output over its travel: the loop of the last whole cycle, whose area is the work.
std::optional<Plot> indicator_diagram(const Results& results, const std::string& mechanism, bool rocks) {
  Plot plot{.title = "", .x = {rocks ? "angle" : "travel", ""}, .y = {rocks ? "torque" : "force", ""}};
  double farthest = 0, largest = 0;
  for (const Result* r : results) {
    if (r->traces->last_cycles.empty()) continue;
    const Trace *travel = nullptr, *force = nullptr;
    for (const Trace& t : r->traces->last_cycles.back().traces) {
      if (t.of == mechanism && t.what == quantities::position) travel = &t;
      if (t.of == mechanism && (t.what == quantities::force || t.what == quantities::load_torque)) force = &t;
    }
    if (!travel || !force) continue;
    plot.series.push_back({.name = r->label, .role = role_of(*r, results), .x = travel->at(force->x), .y = force->y});
    for (const double x : travel->y) farthest = std::max(farthest, std::abs(x));
    for (const double y : force->y) largest = std::max(largest, std::abs(y));
  }
  if (plot.series.empty() || largest == 0) return {};
  const Result& front = *results.back();
  const Figure* work = front.find(Name::own("loop_work", mechanism).text);
  const bool is_drawn = work && cycle_of_traces(front) == cycle_of_figures(front);
  plot.title = fmt::format("{} of {} over its {}{}", rocks ? "Torque" : "Force", mechanism, rocks ? "swing" : "stroke",
                           is_drawn ? fmt::format(": {} a {} within the loop", short_text(std::abs(work->value), "J"),
                                                  cycle_of_figures(front))
                                    : "");
  const ReadableUnit way = readable_unit(farthest, rocks ? "rad" : "m"),
                     size = readable_unit(largest, rocks ? "N*m" : "N");
  plot.x.unit = way.unit, plot.y.unit = size.unit;
  for (Series& s : plot.series) {
    for (double& x : s.x) x *= way.factor;
    for (double& y : s.y) y *= size.factor;
  }
  plot.note = fmt::format("Indicator diagram of the last whole {}: ∮ F dx is the work of the loads{}.",
                          cycle_of_traces(front), is_drawn ? " (loop_work)" : "");
  if (const auto* gas = compressor_of(front.model->network, mechanism)) {
    plot.title.replace(0, plot.title.find(" of "), "Pressure");
    plot.y = {"absolute pressure", "bar"};
    for (Series& s : plot.series)
      for (double& y : s.y) y = 1e-5 * (gas->outside - gas->end.side * y / size.factor / gas->area);
    plot.note += fmt::format(" Volumetric efficiency of the diagram 1 + ε − ε (p₂/p₁)^(1/n) = {}.",
                             headline_number(volumetric_efficiency(*gas)));
  }
  return plot;
}

// Title and label of quantities of clearance or a flexible rod; empty: another trace.
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

// Product of two traces of each model over time, at the times of the first; empty if a model does not have both.
std::optional<Plot> product_over_time(const Results& results, const std::string& channel, const std::string& times,
                                      const std::string& title, const std::string& label) {
  Plot plot{.title = title, .x = {"time", "s"}, .y = {label, ""}, .marks = marks_of(*results.back())};
  for (const Result* r : results) {
    const Trace *first = r->traces->find(channel), *second = r->traces->find(times);
    if (!first || !second || first->x.empty() || second->x.empty()) continue;
    Series s{.name = r->label, .role = role_of(*r, results), .x = first->x, .y = second->at(first->x)};
    for (std::size_t i = 0; i < s.y.size(); ++i) s.y[i] *= first->y[i];
    plot.series.push_back(std::move(s));
  }
  if (plot.series.empty() || largest_of(plot) == 0) return {};
  return in_readable_unit(std::move(plot), "W");
}

std::string reported_figure(const Result& r, const std::string& name, const char* words) {
  const Figure* figure = r.find(name);
  return figure ? fmt::format("{} {}", words, short_text(figure->value, figure->unit, speed_unit_of(r)))
                : std::string();
}

}  // namespace

bool drawable(const Results& results) {
  return std::all_of(results.begin(), results.end(), [](const Result* r) {
    return r->traces && r->model && r->traces->find("angle")->x.size() > 1 && r->traces->find("angle")->x.back() > 0;
  });
}

std::vector<std::string> couplings(const Result& r) {
  std::vector<std::pair<double, const TorqueJoint*>> sorted;
  for (const TorqueJoint& joint : r.model->torque_joints) {
    const Figure* peak = r.find(quantities::peak_torque, joint.component);
    if (r.traces->find("torque." + joint.component)) sorted.emplace_back(peak ? -std::abs(peak->value) : 0, &joint);
  }
  std::stable_sort(sorted.begin(), sorted.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<std::string> names;
  std::set<std::string> shafts;  // that are divided: the place with the largest torque
  for (const auto& [peak, joint] : sorted) {
    const Network::Joint& of = r.model->network.joints[at(joint->joint)];
    if ((of.chain < 0 && !of.reported) || shafts.insert(of.component).second) names.push_back(joint->component);
  }
  return names;
}

std::vector<Plot> motion_plots(const Results& results) {
  std::vector<Plot> plots;
  if (!drawable(results)) return plots;
  const auto add = [&](std::optional<Plot> plot) {
    if (plot) plots.push_back(std::move(*plot));
  };
  const Result& front = *results.back();
  const std::string link = link_of(front);
  std::optional<Plot> periods = tachogram(results, "speed." + link);
  const bool is_reported = periods.has_value();
  add(std::move(periods));
  for (const char* end : {"", ".out"})
    if (!is_reported || *end) add(over_time(results, "speed." + link + end, fmt::format("Speed of {}", link), "speed"));
  add(over_angle(results, "speed." + link, fmt::format("Speed of {} over its angle", link), "speed"));
  const std::string over = " over the " + angle_of_link(front);
  const std::vector<std::string> joints = couplings(front);
  for (std::size_t i = 0; i < joints.size() && i < most_torque_plots; ++i) {
    add(over_time(results, "torque." + joints[i], fmt::format("Torque in {}", joints[i]), "torque"));
    add(over_angle(results, "torque." + joints[i], fmt::format("Torque in {}", joints[i]) + over, "torque"));
  }
  for (const Trace& trace : front.traces->over_time) {
    const std::string part = moved_part(*front.model, trace.of), output = part + " of " + trace.of;
    if (trace.what == quantities::position)
      add(over_time(results, trace.name, fmt::format("{} of the {}", trace.unit == "m" ? "Position" : "Angle", output),
                    trace.unit == "m" ? "position" : "angle"));
    if (trace.what == quantities::velocity)
      add(over_time(results, trace.name, "Speed of the " + output, part + " speed"));
    if (trace.what == quantities::load_torque || trace.what == quantities::force) {
      const bool is_force = trace.what == quantities::force;
      const std::string title = fmt::format("{} on the {}", is_force ? "Force" : "Load torque", output);
      add(over_time(results, trace.name, title, is_force ? "force" : "torque"));
      add(over_angle(results, trace.name, title + over, is_force ? "force" : "torque"));
    }
    if (const auto [title, label] = of_joint_or_rod(trace); !title.empty())
      add(over_time(results, trace.name, title, label));
  }
  for (const Trace& trace : front.traces->over_time)
    if (trace.what == quantities::position) add(indicator_diagram(results, trace.of, trace.unit != "m"));
  for (const Result* r : results) plots.push_back(energy_plot(*r));
  return plots;
}

std::vector<Plot> drive_plots(const Results& results) {
  std::vector<Plot> plots;
  if (!drawable(results)) return plots;
  constexpr std::size_t most = 16;
  const auto add = [&](std::optional<Plot> plot, const std::string& note = {}) {
    if (!plot || plots.size() >= most) return;
    plot->note = note;
    plots.push_back(std::move(*plot));
  };
  const Result& front = *results.back();
  std::set<std::string> drawn;  // a drive may have several accounts: a torque, and what shakes it
  for (const WorkAccount& account : front.model->accounts) {
    const std::string& name = account.name;
    if (account.kind != Account::driving || !front.traces->find("torque." + name) || !drawn.insert(name).second)
      continue;
    add(over_time(results, "torque." + name, fmt::format("Torque of {}", name), "torque"),
        reported_figure(front, "motor_rms_torque." + name, "RMS over the run:"));
    add(product_over_time(results, "torque." + name, "speed." + name, fmt::format("Power of {}", name), "power"),
        reported_figure(front, "motor_mean_power." + name, "Mean over the run:"));
  }
  std::vector<const Trace*> speeds;
  for (const Trace& trace : front.traces->over_time)
    if (trace.what == quantities::speed) speeds.push_back(&trace);
  constexpr double no_slip = 1e-9;  // of the fastest shaft: rounding is left of what sticks
  const double fastest = largest(speeds);
  for (const Trace& trace : front.traces->over_time) {
    if (trace.unit == "A")
      add(over_time(results, trace.name, fmt::format("Current of {}", trace.of), "current"),
          reported_figure(front, "motor_rms_current." + trace.of, "RMS over the run:"));
    if (trace.what != quantities::slip || !(largest({&trace}) > no_slip * fastest)) continue;
    add(over_time(results, trace.name, fmt::format("Slip of {}", trace.of), "speed of one side against the other"));
    add(product_over_time(results, "torque." + trace.of, trace.name,
                          fmt::format("What slip turns into heat in {}", trace.of), "power"),
        reported_figure(front, Name::make(quantities::slip_heat, trace.of).text, "Heat over the run:"));
  }
  return plots;
}

}  // namespace kurbel
