// margins.cpp — margins in closed form; the effect of tolerances by a Latin hypercube.
#include "studies/margins/margins.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

#include "drivetrain/induction/induction_law.h"
#include "engine/numerics/deadline.h"
#include "engine/numerics/index.h"

namespace kurbel {
namespace {

constexpr double rounding = 1e-9;          // a margin that is met but for this is kept
constexpr double visible = 5e-4;           // of a speed: that of the largest response is stated
constexpr std::size_t samples = 8192;      // of all tolerances together
constexpr double moves = 1e-12;            // of a natural frequency: less is rounding
constexpr double of_weight = 0.02;         // share of a mode's damping that is reported
constexpr std::size_t parts_reported = 3;  // of it, by name
constexpr double outside_interval = 0.025;

// ln ω over x, the ln of the value if that is positive: a parabola through the ends and the middle, where it is 0.
struct Parabola {
  double slope = 0, bend = 0;
  double at(double x) const { return x * (slope + bend * x); }
};

Parabola parabola(double x_low, double y_low, double x_high, double y_high) {
  if (x_low == 0) return {y_high / x_high, 0};
  if (x_high == 0) return {y_low / x_low, 0};
  const double a = y_low / x_low, b = y_high / x_high;
  return {(a * x_high - b * x_low) / (x_high - x_low), (b - a) / (x_high - x_low)};
}

double place_of(const Tolerance& t, double value) {
  return t.low > 0 ? std::log(std::max(value, 1e-3 * t.low) / t.value) : value - t.value;
}

double share_of(std::vector<double>& sorted, double share) {
  return sorted[std::min(sorted.size() - 1, static_cast<std::size_t>(share * static_cast<double>(sorted.size())))];
}

// One row's interval, and how often the required margin is kept.
void count(const std::vector<double>& factor, double omega, const ExcitationLine& line, const OperatingSpeeds& speeds,
           Margin& row) {
  std::vector<double> margins;
  std::size_t kept = 0;
  for (const double f : factor) {
    margins.push_back(margin_of(f * omega, line, speeds));
    kept += std::abs(margins.back()) >= speeds.margin * (1 - rounding);
  }
  std::sort(margins.begin(), margins.end());
  row.low = share_of(margins, outside_interval), row.high = share_of(margins, 1 - outside_interval);
  const double n = static_cast<double>(samples), p = static_cast<double>(kept) / n;
  row.kept = Estimate{p, std::max(1 / n, 2 * std::sqrt(p * (1 - p) / n))};
}

double distance(double speed, const OperatingSpeeds& s) {
  return std::max({0.0, s.slowest - speed, speed - s.fastest});
}

}  // namespace

OperatingSpeeds operating_speeds(const Model& m, std::optional<double> asked, std::optional<double> otherwise) {
  const Operation& o = m.scene.operation;
  OperatingSpeeds speeds{.margin = o.margin};
  const auto one = [&](double speed, std::string words) {
    speeds.slowest = speeds.fastest = std::abs(speed), speeds.words = std::move(words);
    return speeds;
  };
  if (!o.speeds.empty()) {
    const double ratio = o.on.empty() ? 1 : std::abs(m.node_ratio[at(m.network.ports.at(o.on).in)]);
    speeds.said = true, speeds.words = "of [operation]";
    if (ratio > 0) speeds.slowest = o.speeds.front() / ratio, speeds.fastest = o.speeds.back() / ratio;
    return speeds;
  }
  if (asked && *asked != 0) return one(*asked, "requested");
  // Only induction motors have a rated speed; that of others is the scale of their data, without load or at a table's end.
  for (const bool by_data : {true, false}) {
    for (const MotorTorque& motor : m.motors) {
      const InductionData* data = m.network.data.find<InductionData>(motor.component);
      const double speed = data ? data->rated_speed : motor.rated_speed, ratio = std::abs(m.node_ratio[at(motor.node)]);
      if (speed != 0 && ratio > 0 && !motor.prescribed && (data != nullptr) == by_data)
        return one(speed / ratio, (data ? "rated speed of " : "reference speed of ") + motor.component);
    }
    if (by_data && otherwise && *otherwise != 0) return one(*otherwise, "of the steady motion");
  }
  if (m.scene.run.start.speed != 0) return one(usual_speed(m), "of the start");
  return speeds;
}

double margin_of(double omega, const ExcitationLine& line, const OperatingSpeeds& s) {
  const double first = line.order * s.slowest + line.fixed, last = line.order * s.fastest + line.fixed;
  const double high = std::max(std::abs(first), std::abs(last));
  const double low = first * last < 0 ? 0 : std::min(std::abs(first), std::abs(last));
  return omega > high ? omega / high - 1 : omega < low ? omega / low - 1 : 0;
}

std::vector<double> crossings(double omega, const ExcitationLine& line) {
  std::vector<double> speeds;
  if (line.order == 0) return speeds;
  for (const double sign : {1.0, -1.0})
    if (const double speed = (sign * omega - line.fixed) / line.order; speed > 0) speeds.push_back(speed);
  std::sort(speeds.begin(), speeds.end());
  return speeds;
}

namespace {

// The response of the drive there, or why it is not known.
void find_response(const std::vector<CrossingResponse>& responses, double slowest, double fastest, const Margins& of,
                   Margin& row) {
  const ExcitationLine& line = of.lines[row.line];
  const MarginMode& mode = of.modes[row.mode];
  for (const CrossingResponse& r : responses) {
    const bool same_line = line.harmonic ? r.harmonic == *line.harmonic
                                         : r.harmonic == 0 && line.order == 0 && line.in_scene &&
                                               std::abs(r.fixed - line.fixed) <= 1e-6 * line.fixed;
    if (r.mode == mode.number && same_line) row.response = r;
  }
  row.not_assessed = row.response                              ? row.response->not_assessed
                     : !line.in_scene                          ? "the scene as it is has no such torque"
                     : !(mode.ratio < 1)                       ? "the mode is damped away"
                     : row.crossing && *row.crossing < slowest ? "below the speeds examined"
                     : row.crossing && *row.crossing > fastest ? "above the speeds examined"
                                                               : "no response was computed there";
}

}  // namespace

void find_rows(const std::vector<CrossingResponse>& responses, double slowest, double fastest, Margins& margins) {
  if (!margins.speeds.known()) return;
  for (std::size_t m = 0; m < margins.modes.size(); ++m)
    for (std::size_t l = 0; l < margins.lines.size(); ++l) {
      const double omega = margins.modes[m].omega;
      std::vector<double> meets = crossings(omega, margins.lines[l]);
      std::stable_sort(meets.begin(), meets.end(),
                       [&](double a, double b) { return distance(a, margins.speeds) < distance(b, margins.speeds); });
      Margin row{.mode = m, .line = l};
      if (!meets.empty()) row.crossing = meets.front();
      if (meets.size() > 1) row.further_crossing = meets.back();
      find_response(responses, slowest, fastest, margins, row);
      if (row.not_assessed.empty() && row.crossing && row.response->peak &&
          std::abs(*row.response->peak / *row.crossing - 1) > visible)
        row.largest = row.response->peak;
      row.margin = margin_of(omega, margins.lines[l], margins.speeds);
      row.at_largest =
          row.largest ? margin_of(margins.lines[l].at(*row.largest), margins.lines[l], margins.speeds) : row.margin;
      row.within = std::min(std::abs(row.margin), std::abs(row.at_largest)) < margins.speeds.margin * (1 - rounding);
      margins.rows.push_back(std::move(row));
    }
  const auto place = [&](const Margin& row) {
    return std::tuple(!row.within, std::abs(row.margin), row.crossing ? distance(*row.crossing, margins.speeds) : 0.0);
  };
  std::stable_sort(margins.rows.begin(), margins.rows.end(),
                   [&](const Margin& a, const Margin& b) { return place(a) < place(b); });
}

namespace {

// "shaft" of "shaft, segment 4", and of "belt.2".
std::string whole(const std::string& joint) {
  const std::size_t dot = joint.find_last_of('.');
  const bool piece = dot != std::string::npos && joint.find_first_not_of("0123456789", dot + 1) == std::string::npos;
  return joint.substr(0, piece ? dot : joint.find(", segment "));
}

}  // namespace

std::string damping_of(const LinearDrive& drive, const std::vector<std::string>& joints, const Eigen::VectorXd& shape,
                       std::optional<double> real_part) {
  const Eigen::VectorXd rate = drive.twists * shape;
  const Eigen::VectorXcd damper = drive.damper_torques(rate.cast<Complex>());
  std::vector<std::pair<std::string, double>> parts;
  double of_joints = 0;
  for (Eigen::Index j = 0; j < rate.size(); ++j) {
    const double power = rate[j] * damper[j].real();
    of_joints += power;
    const std::string name = whole(joints[static_cast<std::size_t>(j)]);
    const auto known = std::find_if(parts.begin(), parts.end(), [&](const auto& part) { return part.first == name; });
    if (known == parts.end())
      parts.emplace_back(name, power);
    else
      known->second += power;
  }
  const double all = shape.dot(drive.damping * shape);
  parts.emplace_back("torques that follow speeds", all - of_joints);
  if (real_part && drive.internal_states() > 0) parts.emplace_back("internal states", -2 * *real_part - all);
  double sum = 0;
  for (const auto& [name, power] : parts) sum += std::abs(power);
  std::stable_sort(parts.begin(), parts.end(),
                   [](const auto& a, const auto& b) { return std::abs(a.second) > std::abs(b.second); });
  std::string text;
  std::size_t reported = 0, others = 0;
  double of_others = 0;
  for (const auto& [name, power] : parts) {
    if (!(std::abs(power) > of_weight * sum && std::abs(power) > 1e-12 * std::abs(all))) continue;
    const double share = 100 * power / sum;
    if (++reported > parts_reported)
      ++others, of_others += share;
    else if (share < 0)
      text += fmt::format("{}excited by {} with {:.0f} %", text.empty() ? "" : ", ", name, -share);
    else
      text += fmt::format("{}{} {:.0f} %", text.empty() ? "" : ", ", name, share);
  }
  if (others > 0) text += fmt::format(", {} more {:.0f} %", others, of_others);
  return text.empty() ? "none" : text;
}

void add_tolerances(const std::vector<Tolerance>& tolerances,
                    const std::function<std::vector<double>(const Tolerance&, double value)>& frequencies,
                    Margins& margins) {
  const std::size_t count_of_modes = margins.modes.size();
  std::vector<std::vector<double>> log_factor(count_of_modes, std::vector<double>(samples, 0.0));
  std::mt19937_64 random(1);
  for (const Tolerance& t : tolerances) {
    Deadline::check();
    const std::vector<double> low = frequencies(t, t.low), usual = frequencies(t, t.value),
                              high = frequencies(t, t.high);
    if (std::min({low.size(), usual.size(), high.size()}) < count_of_modes) continue;
    std::vector<Parabola> effect;
    double most = 0;
    for (std::size_t m = 0; m < count_of_modes; ++m) {
      const double below = std::log(low[m] / usual[m]), above = std::log(high[m] / usual[m]);
      most = std::max({most, std::abs(below), std::abs(above)});
      effect.push_back(parabola(place_of(t, t.low), below, place_of(t, t.high), above));
    }
    if (most < moves) continue;
    margins.tolerances.push_back(t.path);
    std::vector<std::size_t> order(samples);
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::shuffle(order.begin(), order.end(), random);
    for (std::size_t k = 0; k < samples; ++k) {
      const double share = (static_cast<double>(order[k]) + 0.5) / static_cast<double>(samples);
      const double x = place_of(t, quantile(t, share));
      for (std::size_t m = 0; m < count_of_modes; ++m) log_factor[m][k] += effect[m].at(x);
    }
  }
  if (margins.tolerances.empty()) return;
  for (std::vector<double>& of_mode : log_factor)
    for (double& f : of_mode) f = std::exp(f);
  for (Margin& row : margins.rows)
    count(log_factor[row.mode], margins.modes[row.mode].omega, margins.lines[row.line], margins.speeds, row);
}

}  // namespace kurbel
