// modes_plots.cpp — shapes, response over the speed, spectra.
#include "studies/modes/modes_plots.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

#include "engine/numerics/index.h"
#include "engine/scene/text.h"
#include "studies/claims/ranges.h"
#include "studies/findings/plots.h"
#include "studies/findings/rows.h"
#include "studies/limits/limits_findings.h"
#include "studies/modes/campbell.h"

namespace kurbel::modes {
namespace {

constexpr std::size_t shapes_shown = 6;

// "Shafts: 1 motor, 2 rear, …"
std::string numbered(const std::vector<std::string>& names, const std::string& begin = "") {
  std::string text;
  for (std::size_t i = 0; i < names.size() && i < 24; ++i)
    text += fmt::format("{}{} {}", i ? ", " : begin, i + 1, names[i]);
  return text;
}

// Parts along an axis: by name, or by number if there are too many.
Axis axis_of(const std::string& label, std::vector<std::string> names) {
  if (names.size() > 40) return {.label = label};
  for (std::string& name : names) name = as_words(name);
  return {.label = label, .names = std::move(names)};
}

// Amplitudes of a spectrum's lines up to `end`.
Series lines_of(const std::string& name, const AmplitudeSpectrum& s, double end) {
  Series series{.name = name, .role = Role::elastic};
  for (std::size_t i = 0; i < s.frequency.size() && s.frequency[i] <= end; ++i)
    series.add(s.frequency[i], s.amplitude[i]);
  return series;
}

// Over the whole speed range.
Series level(const ModesStudy& m, const std::string& name, Role role, double y) {
  return {.name = name, .role = role, .x = {m.speed_unit.of(m.slowest), m.speed_unit.of(m.fastest)}, .y = {y, y}};
}

// Whether springs hold each shaft: a damper's ring is not held, and a line through it would show a false node.
std::vector<char> held_by_springs(const LinearDrive& drive) {
  std::vector<char> held(drive.ratio.size(), 0);
  for (Eigen::Index c = 0; c < drive.motion.outerSize(); ++c)
    if (drive.stiffness.col(c).norm() > 0)
      for (SparseMatrix::InnerIterator it(drive.motion, c); it; ++it)
        if (it.value() != 0) held[static_cast<std::size_t>(it.row())] = 1;
  return held;
}

// Coordinates from one end of the drive to the others, joint by joint, short branches first.
class AlongTheDrive {
 public:
  explicit AlongTheDrive(const LinearDrive& drive) : next_(static_cast<std::size_t>(drive.size())) {
    for (Eigen::Index j = 0; j < drive.twists.outerSize(); ++j) {
      std::vector<std::size_t> ends;
      for (SparseRows::InnerIterator it(drive.twists, j); it; ++it)
        if (it.value() != 0) ends.push_back(static_cast<std::size_t>(it.col()));
      for (const std::size_t a : ends)
        for (const std::size_t b : ends)
          if (a != b) next_[a].push_back(b);
    }
    for (const std::size_t most : {std::size_t{1}, next_.size()})  // ends first
      for (std::size_t c = 0; c < next_.size(); ++c)
        if (next_[c].size() <= most) visit(c);
  }
  // Of each coordinate.
  std::vector<std::size_t> places() const {
    std::vector<std::size_t> places(order_.size());
    for (std::size_t i = 0; i < order_.size(); ++i) places[order_[i]] = i;
    return places;
  }

 private:
  // What is connected with it, as a tree.
  void visit(std::size_t begin) {
    if (seen_[begin]) return;
    std::vector<std::size_t> found = {begin};
    seen_[begin] = 1;
    for (std::size_t i = 0; i < found.size(); ++i)
      for (const std::size_t to : next_[found[i]])
        if (!std::exchange(seen_[to], 1)) further_[found[i]].push_back(to), found.push_back(to);
    for (std::size_t i = found.size(); i > 0; --i)
      for (const std::size_t to : further_[found[i - 1]]) behind_[found[i - 1]] += 1 + behind_[to];
    std::vector<std::size_t> left = {begin};
    while (!left.empty()) {
      const std::size_t c = left.back();
      left.pop_back();
      order_.push_back(c);
      std::ranges::stable_sort(further_[c], std::greater{}, [this](std::size_t to) { return behind_[to]; });
      left.insert(left.end(), further_[c].begin(), further_[c].end());
    }
  }

  std::vector<std::vector<std::size_t>> next_, further_ = std::vector<std::vector<std::size_t>>(next_.size());
  std::vector<std::size_t> order_, behind_ = std::vector<std::size_t>(next_.size());  // behind each: how many
  std::vector<char> seen_ = std::vector<char>(next_.size());
};

// Shafts and joints in the order in which they stand along the drive.
struct DriveOrder {
  std::vector<std::size_t> shafts, joints;
};
DriveOrder along_the_drive(const ModesStudy& m) {
  const std::vector<std::size_t> place = AlongTheDrive(m.drive).places();
  std::vector<double> of_shaft(m.shaft_names.size()), of_joint(m.joint_names.size());
  const auto mean_place = [&](auto entry) {
    double sum = 0, count = 0;
    for (; entry; ++entry)
      if (entry.value() != 0) sum += static_cast<double>(place[static_cast<std::size_t>(entry.col())]), count += 1;
    return count > 0 ? sum / count : static_cast<double>(place.size());
  };
  const SparseRows motion = m.drive.motion;
  for (std::size_t i = 0; i < of_shaft.size(); ++i)
    of_shaft[i] = mean_place(SparseRows::InnerIterator(motion, static_cast<Eigen::Index>(i)));
  for (std::size_t j = 0; j < of_joint.size(); ++j)
    of_joint[j] = mean_place(SparseRows::InnerIterator(m.drive.twists, static_cast<Eigen::Index>(j)));
  const auto ordered = [](const std::vector<double>& places) {
    std::vector<std::size_t> order = numbers_below(places.size());
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return places[a] < places[b]; });
    return order;
  };
  return {ordered(of_shaft), ordered(of_joint)};
}
std::vector<std::string> names_in(const std::vector<std::string>& names, const std::vector<std::size_t>& order) {
  std::vector<std::string> ordered;
  for (const std::size_t i : order) ordered.push_back(names[i]);
  return ordered;
}

// Amplitudes reduced to the reduction link, so that a rigid motion is a horizontal line.
Plot shape_plot(const ModesStudy& m) {
  const std::vector<std::size_t> order = along_the_drive(m).shafts;
  const std::vector<std::string> names = names_in(m.shaft_names, order);
  Plot plot{.title = "Mode shapes along the drive, reduced to one shaft",
            .x = axis_of("shaft", names),
            .y = {"relative amplitude", ""},
            .wide = m.shaft_names.size() > 8};
  const std::vector<char> held = held_by_springs(m.drive);
  for (std::size_t k = 0; k < m.modes.size() && k < shapes_shown; ++k) {
    Series s{.name = fmt::format("mode {}, {:.4g} Hz: {}", m.modes[k].number, hertz(m.modes[k].omega),
                                 name_of(m, m.modes[k])),
             .role = further_role(k)};
    const Eigen::VectorXd shape = shaft_shape(m, m.modes[k]);
    s.points = shape.size() <= 60;
    double largest = 0;
    for (std::size_t n = 0; n < order.size(); ++n) {
      const std::size_t i = order[n];
      if (!held[i]) continue;
      const double ratio = m.drive.ratio[i], amplitude = shape[static_cast<Eigen::Index>(i)];
      s.add(static_cast<double>(n + 1), ratio != 0 ? amplitude / ratio : amplitude);
      if (std::abs(s.y.back()) > std::abs(largest)) largest = s.y.back();
    }
    if (largest == 0) continue;  // only what no spring holds moves in it
    for (double& y : s.y) y /= largest;
    plot.series.push_back(std::move(s));
  }
  if (plot.x.names.empty()) plot.note = numbered(names, "Shafts: ") + ", …";
  for (std::size_t i = 0; i < held.size() && i < m.shaft_names.size(); ++i)
    if (!held[i])
      plot.note += fmt::format("{}No spring holds {}: omitted.", plot.note.empty() ? "" : " ", m.shaft_names[i]);
  return plot;
}

Plot energy_plot(const ModesStudy& m, bool kinetic) {
  const DriveOrder along = along_the_drive(m);
  const std::vector<std::size_t>& order = kinetic ? along.shafts : along.joints;
  Plot plot{
      .title = kinetic ? "Where the kinetic energy of each mode sits" : "Which elastic element each mode twists",
      .x = axis_of(kinetic ? "shaft" : "elastic element", names_in(kinetic ? m.shaft_names : m.joint_names, order)),
      .y = {"share of the energy", "%"},
      .bars = true};
  for (std::size_t k = 0; k < m.modes.size() && k < shapes_shown; ++k) {
    Series s{.name = fmt::format("mode {}", m.modes[k].number), .role = further_role(k)};
    const std::vector<double>& share = kinetic ? m.modes[k].shares.shaft : m.modes[k].shares.joint;
    for (std::size_t n = 0; n < std::min(order.size(), share.size()) && n < 200; ++n)
      s.add(static_cast<double>(n + 1), 100 * share[order[n]]);
    plot.series.push_back(std::move(s));
  }
  return plot;
}

// Amplitude of the joint in a rigid machine.
Series rigid_curve(const ModesStudy& m, std::size_t j) {
  Series curve{.name = "rigid machine", .role = Role::rigid};
  for (const SpeedResponse& s : m.rigid) {
    if (!s.kept || !std::isfinite(s.joints[j].peak)) continue;
    curve.add(m.speed_unit.of(s.speed), s.joints[j].peak);
  }
  return curve;
}

Plot sweep_plot(const ModesStudy& m, std::size_t j) {
  std::vector<const SpeedResponse*> finite;
  double largest = 0;
  for (const SpeedResponse& s : m.sweep) {
    if (!s.kept || !std::isfinite(s.joints[j].peak)) continue;
    finite.push_back(&s);
    largest = std::max(largest, s.joints[j].peak);
  }
  const auto curve = [&](const char* name, Role role, auto value) {
    return series_of(
        name, role, finite, [&m](const SpeedResponse* s) { return m.speed_unit.of(s->speed); },
        [&](const SpeedResponse* s) { return value(s->joints[j]); });
  };
  Plot plot{.title = fmt::format("Alternating torque in {} over the speed", m.joint_names[j]),
            .x = {"speed of " + m.link, m.speed_unit.name},
            .y = {"torque", ""},
            .series = {
                curve("peak of the sum of orders", Role::elastic, [](const JointResponse& r) { return r.peak; }),
                dashed(curve("sum of amplitudes", Role::sky, [](const JointResponse& r) { return r.amplitude_sum; }))}};
  // A mean far above would press the curves down.
  constexpr double far = 1.5;
  const double sum = largest_of(plot);
  Series mean = dashed(curve("mean torque", Role::reference, [](const JointResponse& r) { return std::abs(r.mean); }));
  const double most = mean.y.empty() ? 0 : *std::max_element(mean.y.begin(), mean.y.end());
  if (most <= far * sum)
    plot.series.push_back(std::move(mean));
  else
    plot.note = fmt::format("The mean torque, up to {}, is not drawn.", torque_text(most));
  if (!m.rigid.empty()) plot.series.insert(plot.series.begin(), rigid_curve(m, j));
  mark_spots(m, j, plot);
  if (const DriveLimits& limits = m.limited[j].limits; limits.vibratory > 0 && !finite.empty()) {
    const double allowed = limits.vibratory / limits.temperature_factor;
    Series line = dashed(level(m, "allowed at 10 Hz", Role::vermillion, allowed));
    line.x = {m.speed_unit.of(finite.front()->speed), m.speed_unit.of(finite.back()->speed)};
    plot.series.push_back(std::move(line));
  }
  for (const BarredRange& b : m.barred) {
    if (b.joint != j) continue;
    plot.bands.push_back({m.speed_unit.of(b.from), m.speed_unit.of(b.to), "barred", Role::vermillion});
    plot.note += fmt::format("{}Barred {} by {}.", plot.note.empty() ? "" : " ",
                             speed_range(b.from, b.to, m.speed_unit), reason_in_words(b));
  }
  return in_readable_unit(std::move(plot), "N*m", largest);
}

Plot order_plot(const ModesStudy& m) {
  const std::size_t j = joint_with_largest_amplitude(m.here);
  Plot plot{.title = fmt::format("Orders of the torque in {} at {}", m.joint_names[j],
                                 m.speed_unit.text(std::abs(m.drive.at.speed), 5)),
            .x = {"order of the turn of " + m.link, ""},
            .y = {"amplitude", "N·m"}};
  plot.bars = true;
  Series response{.name = "in the joint", .role = Role::elastic};
  for (std::size_t r = 1; r < m.here.orders[j].size(); ++r)
    response.add(m.excitations.order(r), std::abs(m.here.orders[j][r]));
  plot.series.push_back(std::move(response));
  if (!m.cycle) return in_readable_unit(std::move(plot), "N*m");
  plot.series.back().name = "linear drive";
  Series really{.name = "steady motion", .role = Role::orange};
  const std::vector<Complex>& orders = m.cycle->orders[j];
  const double end = m.excitations.order(m.excitations.harmonics);
  for (std::size_t r = 1; r < orders.size() && static_cast<double>(r) * m.cycle_order <= end * (1 + 1e-9); ++r)
    really.add(static_cast<double>(r) * m.cycle_order, std::abs(orders[r]));
  plot.series.push_back(std::move(really));
  return in_readable_unit(std::move(plot), "N*m");
}

void mark_modes(const ModesStudy& m, Plot& plot, double end) {
  for (const Mode& mode : m.modes)
    if (hertz(mode.magnitude()) <= end)
      plot.marks.push_back({hertz(mode.magnitude()), fmt::format("mode {}", mode.number)});
}

Plot spectrum_plot(const ModesStudy& m, const TorqueHistory& h) {
  const double end = end_of_spectrum(m, h.spectrum);
  Plot plot{.title = fmt::format("Spectrum of the simulated {}, modes marked", h.channel),
            .x = {"frequency", "Hz"},
            .y = {"amplitude", "N·m"},
            .series = {lines_of(h.channel, h.spectrum, end)},
            .note = fmt::format("Hann window, lines {:.3g} Hz apart; from the end of the run.", h.spectrum.resolution)};
  mark_modes(m, plot, end);
  return in_readable_unit(std::move(plot), "N*m");
}

Plot history_orders_plot(const ModesStudy& m, const TorqueHistory& h) {
  return in_readable_unit(
      Plot{.title = fmt::format("Order analysis of the simulated {}", h.channel),
           .x = {"order of the turn of " + m.link, ""},
           .y = {"amplitude", "N·m"},
           .series = {lines_of(h.channel, h.orders, m.highest_order)},
           .note = fmt::format("Resampled over the angle; lines {:.3g} orders apart.", h.orders.resolution)},
      "N*m");
}

}  // namespace

std::string torque_text(double value) {
  if (!std::isfinite(value)) return "unbounded";
  const ReadableUnit unit = readable_unit(value, "N*m");
  return fmt::format("{:.5g} {}", unit.factor * value, unit.unit);
}

std::size_t joint_with_largest_amplitude(const SpeedResponse& s) {
  const auto less = [](const JointResponse& a, const JointResponse& b) { return a.peak < b.peak; };
  return static_cast<std::size_t>(std::max_element(s.joints.begin(), s.joints.end(), less) - s.joints.begin());
}

std::vector<std::size_t> joints_drawn(const ModesStudy& m) {
  const auto component = [&](std::size_t j) {
    return m.drive.model->network.joints[at(m.drive.model->elastic[j].joint)].component;
  };
  const auto most = [&](std::size_t j) {
    double peak = 0;
    for (const SpeedResponse& s : m.sweep)
      if (s.kept && std::isfinite(s.joints[j].peak)) peak = std::max(peak, s.joints[j].peak);
    return peak;
  };
  std::vector<std::size_t> drawn;
  for (std::size_t j = 0; j < m.joint_names.size(); ++j) {
    const auto same =
        std::find_if(drawn.begin(), drawn.end(), [&](std::size_t k) { return component(k) == component(j); });
    if (same == drawn.end())
      drawn.push_back(j);
    else if (most(j) > most(*same) * (1 + 1e-9))
      *same = j;
  }
  return drawn;
}

double end_of_spectrum(const ModesStudy& m, const AmplitudeSpectrum& s) {
  double largest = 0, end = 0;
  for (const double a : s.amplitude) largest = std::max(largest, a);
  for (std::size_t i = 0; i < s.frequency.size(); ++i)
    if (s.amplitude[i] > 2e-3 * largest) end = s.frequency[i];
  if (!m.modes.empty()) end = std::max(end, 1.3 * hertz(m.modes.front().omega));
  return std::min(1.1 * end, s.frequency.back());
}

std::vector<Plot> mode_plots(const ModesStudy& m) {
  if (m.shaft_names.size() < 2) return {};  // one shaft that oscillates by weights alone has neither shape nor shares
  return {shape_plot(m), energy_plot(m, false), energy_plot(m, true)};
}

std::vector<Plot> response_plots(const ModesStudy& m) {
  std::vector<Plot> plots;
  if (!m.here.joints.empty() && m.excitations.harmonics > 0 && !m.excitations.by_order.empty())
    plots.push_back(order_plot(m));
  for (const std::size_t j : m.sweep.empty() ? std::vector<std::size_t>{} : joints_drawn(m))
    if (plots.size() < 13) plots.push_back(sweep_plot(m, j));
  return plots;
}

std::vector<Plot> history_plots(const ModesStudy& m, const TorqueHistory& h) {
  std::vector<Plot> plots = {waterfall_plot(m, h), spectrum_plot(m, h)};
  if (!h.orders.frequency.empty()) plots.push_back(history_orders_plot(m, h));
  return plots;
}

}  // namespace kurbel::modes
