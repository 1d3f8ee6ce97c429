// modes_output.cpp — words, tables and plots of modes, critical speeds, forced response and a torque's spectrum.
#include "studies/modes/modes_output.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "engine/numerics/index.h"
#include "engine/scene/units.h"
#include "studies/findings/json_text.h"
#include "studies/findings/text_table.h"

namespace kurbel {
namespace {

using Json = nlohmann::ordered_json;
using Rows = std::vector<std::vector<std::string>>;

constexpr double pi = std::numbers::pi;
constexpr std::size_t shapes_shown = 6, lines_shown = 12, critical_shown = 16;

double rpm(double omega) { return omega * 30 / pi; }
double hertz(double omega) { return omega / (2 * pi); }
std::string number(double value, int digits = 6) {
  return std::isfinite(value) ? fmt::format("{:.{}g}", value == 0 ? 0.0 : value, digits) : std::string("unbounded");
}
std::string torque_text(double value) {
  if (!std::isfinite(value)) return "unbounded";
  const ReadableUnit unit = readable_unit(value, "N*m");
  return fmt::format("{:.5g} {}", unit.factor * value, unit.unit);
}

// Worst barred range: the one that exceeds its limit most.
const BarredRange* worst_of(const ModesStudy& m) {
  const BarredRange* worst = nullptr;
  for (const BarredRange& b : m.barred)
    if (!worst || b.peak / b.limit > worst->peak / worst->limit) worst = &b;
  return worst;
}

std::size_t joint_with_largest_swing(const SpeedResponse& s) {
  std::size_t best = 0;
  for (std::size_t j = 0; j < s.joints.size(); ++j)
    if (s.joints[j].peak > s.joints[best].peak) best = j;
  return best;
}

bool is_forced(const ModesStudy& m) { return !m.excitations.by_order.empty() || !m.excitations.by_frequency.empty(); }

std::string conclusion_of(const ModesStudy& m) {
  std::string text;
  if (m.modes.empty()) {
    text = "The drive has no mode with twist.";
  } else {
    text = fmt::format("First mode at {:.6g} Hz{}", hertz(m.modes.front().omega),
                       m.modes.front().lambda.imag() > 0 ? fmt::format(" (ζ = {:.3g})", m.modes.front().ratio)
                                                         : " undamped (it does not swing: ζ ≥ 1)");
    if (m.modes.size() > 1) text += fmt::format(", second at {:.6g} Hz", hertz(m.modes[1].omega));
  }
  if (is_forced(m)) {
    const std::size_t j = joint_with_largest_swing(m.here);
    text += fmt::format("; at {:.5g} 1/min {} swings by {} about {}", rpm(std::abs(m.drive.at.speed)), m.joint_names[j],
                        torque_text(m.here.joints[j].peak), torque_text(m.here.joints[j].mean));
  }
  if (const BarredRange* b = worst_of(m))
    text += fmt::format("; {} barred range{}, worst {:.5g} … {:.5g} 1/min ({})", m.barred.size(),
                        m.barred.size() == 1 ? "" : "s", rpm(b->from), rpm(b->to), m.joint_names[b->joint]);
  std::size_t failed = 0;
  for (const Verdict& v : m.verdicts) failed += !v.holds();
  if (!m.verdicts.empty())
    text += failed ? fmt::format("; {} of {} limits exceeded", failed, m.verdicts.size())
                   : fmt::format("; all {} limits hold", m.verdicts.size());
  return text + ".";
}

// --- tables ---

// Names with the largest shares, as "rear 61 %, web34 22 %".
std::string largest_shares(const std::vector<double>& share, const std::vector<std::string>& name) {
  std::vector<std::size_t> order(share.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  const std::size_t shown = std::min<std::size_t>(2, order.size());
  std::partial_sort(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(shown), order.end(),
                    [&](std::size_t a, std::size_t b) { return share[a] > share[b]; });
  std::string text;
  for (std::size_t i = 0; i < shown; ++i)
    if (share[order[i]] > 0.05)
      text += fmt::format("{}{} {:.0f} %", text.empty() ? "" : ", ", name[order[i]], 100 * share[order[i]]);
  return text;
}

Rows mode_rows(const ModesStudy& m) {
  Rows rows = {{"mode", "f [Hz]", "f damped [Hz]", "ζ", "twist energy in", "kinetic energy in"}};
  for (const Mode& mode : m.modes)
    rows.push_back({std::to_string(mode.number), number(hertz(mode.omega), 8),
                    mode.lambda.imag() > 0 ? number(hertz(mode.lambda.imag()), 8) : "does not swing",
                    mode.lambda.imag() > 0 ? number(mode.ratio, 4) : "≥ 1",
                    largest_shares(mode.shares.joint, m.joint_names),
                    largest_shares(mode.shares.coordinate, m.shaft_names)});
  return rows;
}

Rows response_rows(const ModesStudy& m) {
  Rows rows = {{"joint", "mean [N·m]", "peak of swing [N·m]", "Σ of amplitudes", "RMS", "strongest order",
                "its amplitude", "dissipated [W]"}};
  for (std::size_t j = 0; j < m.here.joints.size() && j < 40; ++j) {
    const JointResponse& r = m.here.joints[j];
    rows.push_back({m.joint_names[j], number(r.mean, 5), number(r.peak, 6), number(r.amplitude_sum, 5),
                    number(r.rms, 5), r.dominant ? number(m.excitations.order(r.dominant), 4) : "—",
                    number(r.dominant_amplitude, 5), number(r.power, 4)});
  }
  return rows;
}

std::vector<CriticalSpeed> strongest_critical(const ModesStudy& m, std::size_t count) {
  std::vector<CriticalSpeed> list = m.critical;
  std::stable_sort(list.begin(), list.end(),
                   [](const CriticalSpeed& a, const CriticalSpeed& b) { return a.amplitude > b.amplitude; });
  if (list.size() > count) list.resize(count);
  std::sort(list.begin(), list.end(), [](const CriticalSpeed& a, const CriticalSpeed& b) { return a.speed < b.speed; });
  return list;
}

Rows critical_rows(const ModesStudy& m, std::size_t count) {
  Rows rows = {{"speed [1/min]", "mode", "order", "amplitude of that order [N·m]", "in"}};
  for (const CriticalSpeed& c : strongest_critical(m, count))
    rows.push_back({number(rpm(c.speed), 6), std::to_string(c.mode), number(c.order, 4), number(c.amplitude, 5),
                    m.joint_names[c.joint]});
  return rows;
}

Rows barred_rows(const ModesStudy& m) {
  Rows rows = {{"joint", "barred because of", "from [1/min]", "to [1/min]", "largest [N·m]", "limit there [N·m]"}};
  for (const BarredRange& b : m.barred)
    rows.push_back({m.joint_names[b.joint], b.reason, number(rpm(b.from), 5), number(rpm(b.to), 5), number(b.peak, 5),
                    number(b.limit, 5)});
  return rows;
}

Rows zone_rows(const ModesStudy& m) {
  Rows rows = {{"mode", "order of the inertia", "around [1/min]", "variation ε", "half width [1/min]", "state"}};
  for (const ParametricZone& z : m.zones)
    rows.push_back({std::to_string(z.mode), number(m.excitations.order(z.harmonic), 4), number(rpm(z.centre), 6),
                    number(z.variation, 4), number(rpm(z.centre * z.half_width), 4),
                    z.half_width > 0 ? "unstable inside" : "closed by damping"});
  return rows;
}

Rows verdict_rows(const ModesStudy& m) {
  Rows rows = {{"component", "requirement", "note", "value", "limit", "use"}};
  for (const Verdict& v : m.verdicts) {
    const ReadableUnit unit = readable_unit(v.limit, v.unit);
    rows.push_back({v.component, v.requirement, v.note,
                    fmt::format("{} {}", number(unit.factor * v.value, 5), unit.unit),
                    fmt::format("{} {}", number(unit.factor * v.limit, 5), unit.unit),
                    fmt::format("{:.0f} % {}", 100 * v.value / v.limit, v.holds() ? "holds" : "EXCEEDED")});
  }
  return rows;
}

Rows rainflow_rows(const TorqueHistory& h) {
  Rows rows = {{"range from [N·m]", "to [N·m]", "cycles", "mean [N·m]"}};
  if (h.cycles.empty() || h.cycles.front().range <= 0) return rows;
  constexpr int classes = 10;
  const double width = h.cycles.front().range / classes;
  for (int k = classes - 1; k >= 0; --k) {
    double count = 0, mean = 0;
    for (const LoadCycle& c : h.cycles) {
      if (std::clamp(static_cast<int>(c.range / width), 0, classes - 1) != k) continue;
      count += c.count;
      mean += c.count * c.mean;
    }
    rows.push_back({number(k * width, 5), number((k + 1) * width, 5), number(count, 6),
                    count > 0 ? number(mean / count, 5) : "—"});
  }
  return rows;
}

std::string point_text(const ModesStudy& m) {
  return fmt::format("linearised at {:.6g} 1/min of {}; {}", rpm(m.drive.at.speed), m.link, m.drive.mode_set);
}

std::string method_text(const ModesStudy& m) {
  return fmt::format("{}, {} coordinate{}; residual {:.1e}; {} motion{} without twist; counted up to the last mode: {}",
                     m.undamped.basis ? fmt::format("shift and invert, {} vectors", m.undamped.basis) : "dense solver",
                     m.drive.size(), m.drive.size() == 1 ? "" : "s", m.undamped.residual, m.undamped.rigid,
                     m.undamped.rigid == 1 ? "" : "s", m.undamped.counted_below);
}

std::string table_of(const ModesStudy& m, const std::string& conclusion) {
  std::string text =
      conclusion + "\n\n  " + point_text(m) + "\n\n" + aligned(mode_rows(m), 0) + "  " + method_text(m) + "\n";
  if (is_forced(m)) text += "\nforced response at that speed\n" + aligned(response_rows(m), 1);
  if (!m.critical.empty())
    text += fmt::format("\ncritical speeds ({} of {}, by amplitude)\n", std::min(critical_shown, m.critical.size()),
                        m.critical.size()) +
            aligned(critical_rows(m, critical_shown), 0);
  if (!m.barred.empty()) text += "\nbarred speed ranges\n" + aligned(barred_rows(m), 2);
  if (!m.zones.empty())
    text += "\nparametric instability by the varying inertia, first order\n" + aligned(zone_rows(m), 0);
  if (!m.verdicts.empty()) text += "\nlimits\n" + aligned(verdict_rows(m), 3);
  if (m.history)
    text += fmt::format("\nrainflow count of the simulated {} (ASTM E1049), equivalent amplitude at m = 5: {}\n",
                        m.history->channel, torque_text(equivalent_amplitude(m.history->cycles, 5))) +
            aligned(rainflow_rows(*m.history), 0);
  for (const std::string& note : m.notes) text += "  note: " + note + "\n";
  if (!m.complete) text += "  INCOMPLETE: " + m.diagnosis + "\n";
  return text;
}

// --- JSON and CSV ---

Json finite(double v) { return std::isfinite(v) ? Json(v) : Json(); }

std::string json_of(const ModesStudy& m, const std::string& conclusion) {
  Json j = {{"title", m.title}, {"scene", m.scene_file}, {"complete", m.complete}};
  if (!m.complete) j["diagnosis"] = m.diagnosis;
  j["conclusion"] = conclusion;
  j["operating_point"] = {{"speed", m.drive.at.speed},
                          {"link", m.link},
                          {"mode_set", m.drive.mode_set},
                          {"torque_left_over", m.drive.mean_torque}};
  j["shafts"] = m.shaft_names;
  j["joints"] = Json::array();
  for (std::size_t i = 0; i < m.joint_names.size() && i < 1000; ++i)
    j["joints"].push_back({{"name", m.joint_names[i]},
                           {"stiffness", m.drive.joints[i].stiffness},
                           {"damping", m.drive.joints[i].damping},
                           {"mean_torque", m.drive.joints[i].torque}});
  j["modes"] = Json::array();
  for (const Mode& mode : m.modes) {
    Json one = {{"number", mode.number},
                {"omega", mode.omega},
                {"frequency", hertz(mode.omega)},
                {"damped", {{"real", mode.lambda.real()}, {"imaginary", mode.lambda.imag()}}},
                {"damping_ratio", mode.ratio}};
    if (m.drive.size() <= 1000) {
      one["shape"] = std::vector<double>(mode.shape.data(), mode.shape.data() + mode.shape.size());
      one["potential_energy"] = mode.shares.joint;
      one["kinetic_energy"] = mode.shares.coordinate;
    }
    j["modes"].push_back(std::move(one));
  }
  j["count_of_modes_up_to_the_last"] = m.undamped.counted_below;
  j["response"] = Json::array();
  for (std::size_t i = 0; i < m.here.joints.size() && i < 1000; ++i) {
    const JointResponse& r = m.here.joints[i];
    j["response"].push_back({{"joint", m.joint_names[i]},
                             {"mean", r.mean},
                             {"peak", finite(r.peak)},
                             {"amplitude_sum", finite(r.amplitude_sum)},
                             {"rms", finite(r.rms)},
                             {"power", finite(r.power)},
                             {"order", m.excitations.order(r.dominant)}});
  }
  j["critical_speeds"] = Json::array();
  for (const CriticalSpeed& c : m.critical)
    j["critical_speeds"].push_back({{"speed", c.speed},
                                    {"mode", c.mode},
                                    {"order", c.order},
                                    {"amplitude", finite(c.amplitude)},
                                    {"joint", m.joint_names[c.joint]}});
  j["barred"] = Json::array();
  for (const BarredRange& b : m.barred)
    j["barred"].push_back({{"joint", m.joint_names[b.joint]},
                           {"from", b.from},
                           {"to", b.to},
                           {"limit", b.limit},
                           {"peak", finite(b.peak)},
                           {"reason", b.reason}});
  j["parametric_zones"] = Json::array();
  for (const ParametricZone& z : m.zones)
    j["parametric_zones"].push_back({{"mode", z.mode},
                                     {"order", m.excitations.order(z.harmonic)},
                                     {"speed", z.centre},
                                     {"variation", z.variation},
                                     {"relative_half_width", z.half_width}});
  j["verdicts"] = Json::array();
  for (const Verdict& v : m.verdicts)
    j["verdicts"].push_back({{"component", v.component},
                             {"requirement", v.requirement},
                             {"value", finite(v.value)},
                             {"limit", v.limit},
                             {"unit", v.unit},
                             {"holds", v.holds()},
                             {"note", v.note}});
  if (m.history)
    j["history"] = {{"channel", m.history->channel},
                    {"greatest", m.history->greatest},
                    {"least", m.history->least},
                    {"equivalent_amplitude", equivalent_amplitude(m.history->cycles, 5)}};
  j["notes"] = m.notes;
  return json_text(j);
}

std::string shapes_csv(const ModesStudy& m) {
  std::string text = "shaft,ratio,inertia [kg*m2]";
  for (const Mode& mode : m.modes) text += fmt::format(",mode {} at {:.8g} Hz", mode.number, hertz(mode.omega));
  text += "\n";
  for (Eigen::Index i = 0; i < m.drive.size(); ++i) {
    text += fmt::format("{},{:.12g},{:.12g}", m.shaft_names[static_cast<std::size_t>(i)],
                        m.drive.ratio[static_cast<std::size_t>(i)], m.drive.inertia[i]);
    for (const Mode& mode : m.modes) text += fmt::format(",{:.9g}", mode.shape[i]);
    text += "\n";
  }
  return text;
}

std::string response_csv(const ModesStudy& m) {
  std::string text = "speed [rad/s]";
  for (const std::string& name : m.joint_names) text += fmt::format(",mean {0} [N*m],peak {0} [N*m]", name);
  text += "\n";
  for (const SpeedResponse& s : m.sweep) {
    text += fmt::format("{:.12g}", s.speed);
    for (const JointResponse& r : s.joints)
      text += fmt::format(",{:.9g},{}", r.mean, std::isfinite(r.peak) ? fmt::format("{:.9g}", r.peak) : "");
    text += "\n";
  }
  return text;
}

// --- report ---

Table table_card(const std::string& title, Rows rows, std::size_t text_columns, bool folded = false) {
  Table table{.title = title, .columns = rows.front(), .rows = {}, .folded = folded, .text_columns = text_columns};
  table.rows.assign(rows.begin() + 1, rows.end());
  return table;
}

// Amplitudes reduced to the reduction link, so that a rigid motion would be a level line.
Plot shape_plot(const ModesStudy& m) {
  Plot plot{.title = "Mode shapes along the drive, reduced to one shaft",
            .x = {"shaft", ""},
            .y = {"relative amplitude", ""},
            .series = {}};
  for (std::size_t k = 0; k < m.modes.size() && k < shapes_shown; ++k) {
    Series s{.name = fmt::format("mode {}, {:.4g} Hz", m.modes[k].number, hertz(m.modes[k].omega)),
             .role = further_role(k),
             .x = {},
             .y = {}};
    s.points = m.drive.size() <= 60;
    double largest = 0;
    for (Eigen::Index i = 0; i < m.drive.size(); ++i) {
      s.x.push_back(static_cast<double>(i + 1));
      s.y.push_back(m.modes[k].shape[i] / m.drive.ratio[static_cast<std::size_t>(i)]);
      if (std::abs(s.y.back()) > std::abs(largest)) largest = s.y.back();
    }
    for (double& y : s.y) y /= largest;
    plot.series.push_back(std::move(s));
  }
  for (std::size_t i = 0; i < m.shaft_names.size() && i < 24; ++i)
    plot.note += fmt::format("{}{} {}", i ? ", " : "Shafts: ", i + 1, m.shaft_names[i]);
  plot.note += m.shaft_names.size() > 24 ? ", …" : ".";
  return plot;
}

Plot energy_plot(const ModesStudy& m, bool kinetic) {
  Plot plot{.title = kinetic ? "Where the kinetic energy of each mode sits" : "Which elastic element each mode twists",
            .x = {kinetic ? "shaft" : "elastic element", ""},
            .y = {"share of the energy", "%"},
            .series = {}};
  plot.bars = true;
  const std::vector<std::string>& names = kinetic ? m.shaft_names : m.joint_names;
  for (std::size_t k = 0; k < m.modes.size() && k < shapes_shown; ++k) {
    Series s{.name = fmt::format("mode {}", m.modes[k].number), .role = further_role(k), .x = {}, .y = {}};
    const std::vector<double>& share = kinetic ? m.modes[k].shares.coordinate : m.modes[k].shares.joint;
    for (std::size_t i = 0; i < share.size() && i < 200; ++i) {
      s.x.push_back(static_cast<double>(i + 1));
      s.y.push_back(100 * share[i]);
    }
    plot.series.push_back(std::move(s));
  }
  for (std::size_t i = 0; i < names.size() && i < 24; ++i)
    plot.note += fmt::format("{}{} {}", i ? ", " : "", i + 1, names[i]);
  return plot;
}

// Harmonics with the largest torque at the operating point; those that lead to the strongest critical speeds first.
std::vector<std::size_t> orders_shown(const ModesStudy& m) {
  std::vector<std::size_t> shown;
  const auto show = [&](std::size_t r) {
    if (shown.size() < lines_shown && std::find(shown.begin(), shown.end(), r) == shown.end()) shown.push_back(r);
  };
  for (const CriticalSpeed& c : strongest_critical(m, 8)) show(c.harmonic);
  std::vector<std::pair<double, std::size_t>> strength;
  for (std::size_t r = 1; r <= m.excitations.harmonics; ++r)
    strength.emplace_back(-m.excitations.strength(r, m.drive.at.speed), r);
  std::sort(strength.begin(), strength.end());
  for (const auto& [negative, r] : strength)
    if (negative < 0) show(r);
  std::sort(shown.begin(), shown.end());
  return shown;
}

Plot campbell_plot(const ModesStudy& m) {
  Plot plot{.title = "Campbell diagram: where excitation orders meet the modes",
            .x = {"speed of " + m.link, "1/min"},
            .y = {"frequency", "Hz"},
            .series = {},
            .note =
                "Level lines are modes, rays are orders of the reduction link's turn; circles mark critical speeds, "
                "dashed rays tooth meshes."};
  const double from = rpm(m.slowest), to = rpm(m.fastest);
  double top = 0;
  const std::vector<std::size_t> orders = orders_shown(m);
  for (const std::size_t r : orders) top = std::max(top, m.excitations.order(r) * hertz(m.fastest));
  if (!m.modes.empty()) top = std::max(top, 1.2 * hertz(m.modes.front().omega));
  for (const Mode& mode : m.modes)
    if (hertz(mode.omega) <= top)
      plot.series.push_back({.name = fmt::format("mode {}", mode.number),
                             .role = Role::elastic,
                             .x = {from, to},
                             .y = {hertz(mode.omega), hertz(mode.omega)}});
  // All rays in one series: each comes back to the origin.
  Series rays{.name = "orders", .role = Role::rigid, .x = {}, .y = {}};
  for (const std::size_t r : orders) {
    rays.name += fmt::format("{} {:g}", rays.x.empty() ? "" : ",", m.excitations.order(r));
    rays.x.insert(rays.x.end(), {0, to, 0});
    rays.y.insert(rays.y.end(), {0, m.excitations.order(r) * to / 60, 0});
  }
  if (!rays.x.empty()) plot.series.push_back(std::move(rays));
  Series meshes{.name = "tooth meshes", .role = Role::reference, .x = {}, .y = {}, .dashed = true};
  for (const GearMesh& mesh : m.excitations.meshes) {
    const double end = std::min(to, 60 * top / mesh.order);
    meshes.x.insert(meshes.x.end(), {0, end, 0});
    meshes.y.insert(meshes.y.end(), {0, mesh.order * end / 60, 0});
    plot.note += fmt::format(" Mesh of {}: order {:.5g}.", mesh.name, mesh.order);
  }
  if (!meshes.x.empty()) plot.series.push_back(std::move(meshes));
  for (const FrequencySource& f : m.excitations.by_frequency)
    if (hertz(f.omega) <= top)
      plot.series.push_back({.name = "frequency of " + f.component,
                             .role = Role::vermillion,
                             .x = {from, to},
                             .y = {hertz(f.omega), hertz(f.omega)},
                             .dashed = true});
  Series crossings{.name = "critical speeds", .role = Role::orange, .x = {}, .y = {}};
  crossings.points = true;
  crossings.line = false;
  for (const CriticalSpeed& c : m.critical)
    if (std::find(orders.begin(), orders.end(), c.harmonic) != orders.end()) {
      crossings.x.push_back(rpm(c.speed));
      crossings.y.push_back(hertz(c.order * c.speed));
    }
  if (!crossings.x.empty()) plot.series.push_back(std::move(crossings));
  for (const ParametricZone& z : m.zones)
    if (z.half_width > 0) plot.marks.push_back({rpm(z.centre), fmt::format("parametric, mode {}", z.mode)});
  return plot;
}

Plot sweep_plot(const ModesStudy& m, std::size_t j) {
  Plot plot{.title = fmt::format("Swinging torque in {} over the speed", m.joint_names[j]),
            .x = {"speed of " + m.link, "1/min"},
            .y = {"torque", ""},
            .series = {}};
  Series peak{.name = "peak of the sum of orders", .role = Role::elastic, .x = {}, .y = {}};
  Series sum{.name = "sum of amplitudes", .role = Role::rigid, .x = {}, .y = {}, .dashed = true};
  Series mean{.name = "mean torque", .role = Role::reference, .x = {}, .y = {}, .dashed = true};
  double largest = 0;
  for (const SpeedResponse& s : m.sweep) {
    const JointResponse& r = s.joints[j];
    if (!std::isfinite(r.peak)) continue;
    for (Series* series : {&peak, &sum, &mean}) series->x.push_back(rpm(s.speed));
    peak.y.push_back(r.peak);
    sum.y.push_back(r.amplitude_sum);
    mean.y.push_back(std::abs(r.mean));
    largest = std::max(largest, r.peak);
  }
  const ReadableUnit unit = readable_unit(largest, "N*m");
  plot.y.unit = unit.unit;
  for (Series* series : {&peak, &sum, &mean}) {
    for (double& y : series->y) y *= unit.factor;
    plot.series.push_back(*series);
  }
  if (m.limits[j].vibratory > 0)
    plot.series.push_back({.name = "allowed",
                           .role = Role::vermillion,
                           .x = {rpm(m.slowest), rpm(m.fastest)},
                           .y = {unit.factor * m.limits[j].vibratory, unit.factor * m.limits[j].vibratory},
                           .dashed = true});
  for (const BarredRange& b : m.barred) {
    if (b.joint != j) continue;
    plot.marks.push_back({rpm(b.from), "barred from"});
    plot.marks.push_back({rpm(b.to), "to"});
    plot.note += fmt::format("{}Barred {:.5g} … {:.5g} 1/min by {}.", plot.note.empty() ? "" : " ", rpm(b.from),
                             rpm(b.to), b.reason);
  }
  return plot;
}

Plot order_plot(const ModesStudy& m) {
  const std::size_t j = joint_with_largest_swing(m.here);
  Plot plot{.title = fmt::format("Orders of the torque in {} at {:.5g} 1/min", m.joint_names[j],
                                 rpm(std::abs(m.drive.at.speed))),
            .x = {"order of the turn of " + m.link, ""},
            .y = {"amplitude", "N·m"},
            .series = {}};
  plot.bars = true;
  Series response{.name = "in the joint", .role = Role::elastic, .x = {}, .y = {}};
  for (std::size_t r = 1; r < m.here.orders[j].size(); ++r) {
    response.x.push_back(m.excitations.order(r));
    response.y.push_back(std::abs(m.here.orders[j][r]));
  }
  plot.series.push_back(std::move(response));
  return plot;
}

void mark_modes(const ModesStudy& m, Plot& plot, double factor, double end) {
  for (const Mode& mode : m.modes)
    if (factor * hertz(mode.omega) <= end)
      plot.marks.push_back({factor * hertz(mode.omega), fmt::format("mode {}", mode.number)});
}

// Up to a little above the highest mode that still shows.
double end_of_spectrum(const ModesStudy& m, const AmplitudeSpectrum& s) {
  double largest = 0, end = 0;
  for (const double a : s.amplitude) largest = std::max(largest, a);
  for (std::size_t i = 0; i < s.frequency.size(); ++i)
    if (s.amplitude[i] > 2e-3 * largest) end = s.frequency[i];
  if (!m.modes.empty()) end = std::max(end, 1.3 * hertz(m.modes.front().omega));
  return std::min(1.1 * end, s.frequency.back());
}

Plot spectrum_plot(const ModesStudy& m, const TorqueHistory& h) {
  Plot plot{.title = fmt::format("Spectrum of the simulated {}, modes marked", h.channel),
            .x = {"frequency", "Hz"},
            .y = {"amplitude", "N·m"},
            .series = {}};
  const double end = end_of_spectrum(m, h.spectrum);
  Series s{.name = h.channel, .role = Role::elastic, .x = {}, .y = {}};
  for (std::size_t i = 0; i < h.spectrum.frequency.size() && h.spectrum.frequency[i] <= end; ++i) {
    s.x.push_back(h.spectrum.frequency[i]);
    s.y.push_back(h.spectrum.amplitude[i]);
  }
  plot.series.push_back(std::move(s));
  mark_modes(m, plot, 1, end);
  plot.note = fmt::format("Hann window, lines {:.3g} Hz apart; from the end of the run.", h.spectrum.resolution);
  return plot;
}

Plot history_orders_plot(const ModesStudy& m, const TorqueHistory& h) {
  Plot plot{.title = fmt::format("Order analysis of the simulated {}", h.channel),
            .x = {"order of the turn of " + m.link, ""},
            .y = {"amplitude", "N·m"},
            .series = {}};
  Series s{.name = h.channel, .role = Role::elastic, .x = {}, .y = {}};
  for (std::size_t i = 0; i < h.orders.frequency.size() && h.orders.frequency[i] <= m.highest_order; ++i) {
    s.x.push_back(h.orders.frequency[i]);
    s.y.push_back(h.orders.amplitude[i]);
  }
  plot.series.push_back(std::move(s));
  plot.note = fmt::format("Resampled over the angle; lines {:.3g} orders apart.", h.orders.resolution);
  return plot;
}

// Lines one above the other, each set off by the speed at which its window was taken.
Plot waterfall_plot(const ModesStudy& m, const TorqueHistory& h) {
  Plot plot{.title = fmt::format("Waterfall of {}: spectra along the run, modes marked", h.channel),
            .x = {"frequency", "Hz"},
            .y = {"speed of " + m.link + "; height of a line: amplitude", "1/min"},
            .series = {}};
  double largest = 0, low = HUGE_VAL, high = -HUGE_VAL, end = 0;
  for (const WaterfallLine& line : h.lines) {
    for (const double a : line.spectrum.amplitude) largest = std::max(largest, a);
    low = std::min(low, rpm(line.speed));
    high = std::max(high, rpm(line.speed));
    end = std::max(end, end_of_spectrum(m, line.spectrum));
  }
  const double height = 0.25 * std::max(high - low, 0.05 * std::abs(high)) / std::max(largest, 1e-300);
  for (const WaterfallLine& line : h.lines) {
    Series s{.name = fmt::format("{:.3g} s, {:.4g} 1/min", line.time, rpm(line.speed)),
             .role = Role::elastic,
             .x = {},
             .y = {}};
    for (std::size_t i = 0; i < line.spectrum.frequency.size() && line.spectrum.frequency[i] <= end; ++i) {
      s.x.push_back(line.spectrum.frequency[i]);
      s.y.push_back(rpm(line.speed) + height * line.spectrum.amplitude[i]);
    }
    plot.series.push_back(std::move(s));
  }
  mark_modes(m, plot, 1, end);
  plot.note = fmt::format("The highest peak stands for {}.", torque_text(largest));
  return plot;
}

void add_modes(Report& report, const ModesStudy& m) {
  ReportSection& section = report.add("Modes (theory 12.2, 12.3)");
  section.cards.push_back(table_card("Natural frequencies, damping, energies", mode_rows(m), 1));
  if (m.modes.empty()) return;
  section.cards.push_back(shape_plot(m));
  section.cards.push_back(energy_plot(m, false));
  section.cards.push_back(energy_plot(m, true));
  const Mode& first = m.modes.front();
  double potential = 0;
  for (std::size_t j = 0; j < m.drive.joints.size(); ++j)
    potential += m.drive.joints[j].stiffness * std::pow(m.drive.twist(j, first.shape), 2);
  const double kinetic = m.drive.inertia.dot(first.shape.cwiseAbs2());
  section.cards.push_back(Formula{.title = "First mode by its energies (Rayleigh, theory 12.4)",
                                  .symbols = "ω² = Σ k θ² / Σ J φ²",
                                  .numbers = fmt::format("ω² = {:.7g} / {:.7g} → ω = {:.7g} 1/s, f = {:.7g} Hz",
                                                         potential, kinetic, first.omega, hertz(first.omega)),
                                  .note = point_text(m) + "."});
  section.cards.push_back(Text{.title = "", .body = "Check: " + method_text(m) + " (Sylvester's law of inertia)."});
}

void add_response(Report& report, const ModesStudy& m) {
  if (!is_forced(m)) return;
  ReportSection& campbell = report.add("Critical speeds (theory 12.6)");
  campbell.cards.push_back(campbell_plot(m));
  if (!m.critical.empty())
    campbell.cards.push_back(table_card("Strongest critical speeds", critical_rows(m, critical_shown), 0));
  if (!m.zones.empty()) {
    campbell.cards.push_back(table_card("Parametric instability by the varying inertia, first order", zone_rows(m), 0));
    const ParametricZone& z = m.zones.back();
    const double zeta = m.modes[at(z.mode - 1)].ratio;
    campbell.cards.push_back(Formula{
        .title = "Half width of a zone (theory 12.8)",
        .symbols = "ΔΩ/Ω = √(ε²/16 − ζ²) around Ω = 2 ω/r",
        .numbers = z.variation > 4 * zeta ? fmt::format("√({:.4g}²/16 − {:.4g}²) · {:.5g} 1/min = {:.4g} 1/min",
                                                        z.variation, zeta, rpm(z.centre), rpm(z.centre * z.half_width))
                                          : fmt::format("{:.4g} ≤ 4 · {:.4g}: closed by damping, around {:.5g} 1/min",
                                                        z.variation, zeta, rpm(z.centre)),
        .note = "ε: harmonic r of the reduced inertia in the mode, over its modal inertia. ε ≤ 4 ζ: closed."});
  }
  ReportSection& forced = report.add("Forced response (theory 12.7)");
  forced.cards.push_back(
      table_card(fmt::format("At {:.5g} 1/min of {}", rpm(std::abs(m.drive.at.speed)), m.link), response_rows(m), 1));
  if (!m.here.joints.empty() && m.excitations.harmonics > 0 && !m.excitations.by_order.empty())
    forced.cards.push_back(order_plot(m));
  for (std::size_t j = 0; j < m.joint_names.size() && j < 12 && !m.sweep.empty(); ++j)
    forced.cards.push_back(sweep_plot(m, j));
  if (!m.barred.empty()) forced.cards.push_back(table_card("Barred speed ranges", barred_rows(m), 2));
}

void add_history(Report& report, const ModesStudy& m) {
  if (!m.history || m.history->lines.empty()) return;
  ReportSection& section = report.add("Simulated torque");
  section.cards.push_back(waterfall_plot(m, *m.history));
  section.cards.push_back(spectrum_plot(m, *m.history));
  if (!m.history->orders.frequency.empty()) section.cards.push_back(history_orders_plot(m, *m.history));
  section.cards.push_back(table_card("Rainflow count (ASTM E1049)", rainflow_rows(*m.history), 0));
}

Report report_of(const ModesStudy& m, const std::string& conclusion) {
  Report report{.title = fmt::format("{}: modes and critical speeds", m.title),
                .subtitle = point_text(m),
                .conclusion = conclusion};
  report.complete = m.complete;
  for (std::size_t k = 0; k < m.modes.size() && k < 4; ++k)
    report.figures.push_back({fmt::format("mode {}", m.modes[k].number),
                              hertz(m.modes[k].omega),
                              "Hz",
                              {},
                              m.modes[k].lambda.imag() > 0 ? fmt::format("ζ = {:.3g}", m.modes[k].ratio) : "",
                              6});
  if (is_forced(m)) {
    const std::size_t j = joint_with_largest_swing(m.here);
    if (std::isfinite(m.here.joints[j].peak))
      report.figures.push_back({"largest swing at that speed", m.here.joints[j].peak, "N*m", {}, m.joint_names[j], 5});
  }
  if (!m.verdicts.empty())
    report.add("Limits (theory 12.9)").cards.push_back(table_card("What the components may bear", verdict_rows(m), 3));
  add_modes(report, m);
  add_response(report, m);
  add_history(report, m);
  std::string notes;
  for (const std::string& note : m.notes) notes += note + "\n";
  if (!m.complete) notes += "incomplete: " + m.diagnosis + "\n";
  if (!notes.empty()) report.add("Notes").cards.push_back(Text{.title = "", .body = notes});
  report.add("Scene").cards.push_back(
      Text{.title = m.scene_file, .body = m.scene_text, .verbatim = true, .folded = true});
  report.footer = report_footer();
  return report;
}

}  // namespace

StudyOutput output_of(const ModesStudy& m) {
  StudyOutput output;
  output.conclusion = conclusion_of(m);
  output.table = table_of(m, output.conclusion);
  output.json = json_of(m, output.conclusion);
  output.report = [&m, conclusion = output.conclusion] { return report_of(m, conclusion); };
  output.csv.push_back({"mode_shapes.csv", [&m] { return shapes_csv(m); }});
  if (!m.sweep.empty()) output.csv.push_back({"forced_response.csv", [&m] { return response_csv(m); }});
  output.complete = m.complete;
  output.diagnosis = m.diagnosis;
  return output;
}

}  // namespace kurbel
