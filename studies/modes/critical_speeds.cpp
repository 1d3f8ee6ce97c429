// critical_speeds.cpp — frequencies over orders; eigenvalues of the drive at each speed; responses.
#include "studies/modes/critical_speeds.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <stdexcept>

#include "engine/numerics/angles.h"
#include "engine/numerics/deadline.h"
#include "engine/scene/quantity_place.h"
#include "studies/claims/ranges.h"
#include "studies/modes/campbell.h"

namespace kurbel {
namespace {

constexpr int sweep_points = 240;
constexpr std::size_t most_solves = 400'000;  // of n-by-n systems in a sweep, over n
constexpr double hardly_vibrates = 0.5;       // ζ
constexpr int looks_at_a_peak = 2;            // each takes some two digits

constexpr Eigen::Index most_coordinates = 160;
constexpr double growth = 1e-6;  // of a turn's radian

std::size_t nearest_of(const std::vector<SpeedResponse>& sweep, double speed) {
  const auto apart = [speed](const SpeedResponse& s) { return std::abs(s.speed - speed); };
  const auto less = [&](const SpeedResponse& a, const SpeedResponse& b) { return apart(a) < apart(b); };
  return static_cast<std::size_t>(std::min_element(sweep.begin(), sweep.end(), less) - sweep.begin());
}

// The joint that the mode twists most.
std::size_t joint_of(const Mode& mode) {
  const std::vector<double>& share = mode.shares.joint;
  return static_cast<std::size_t>(std::max_element(share.begin(), share.end()) - share.begin());
}

// A point of the curve 1/|τ_r|², which is nearly a parabola of speed about a resonance.
struct Point {
  double speed = 0, value = 0;
};

// Vertex of the parabola through three points, the middle one the lowest.
double vertex(const Point& a, const Point& b, const Point& c) {
  const double left = (b.value - a.value) / (b.speed - a.speed), right = (c.value - b.value) / (c.speed - b.speed);
  const double bend = (right - left) / (c.speed - a.speed);
  return bend > 0 ? 0.5 * (a.speed + b.speed - left / bend) : b.speed;
}

// Response to one order in one joint over the speed.
class OrderCurve {
 public:
  OrderCurve(const CriticalSpeed& c, const std::vector<SpeedResponse>& sweep) : c_(c), sweep_(sweep) {}

  // The response at the maximum reached by climbing from a resonance over allowed speeds; empty if the climb ends at
  // the last of them, or leaves the resonance by more than `width`.
  std::optional<SpeedResponse> peak(double resonance, double width,
                                    const std::function<SpeedResponse(double speed)>& at) const {
    std::size_t i = nearest_of(sweep_, resonance);
    if (value(sweep_[i]) == 0) return sweep_[i];  // without damping it grows beyond bounds
    while (const int way = way_up(i)) i = way < 0 ? i - 1 : i + 1;
    if (i == 0 || i + 1 == sweep_.size() || std::abs(sweep_[i].speed - resonance) > width) return {};
    if (!sweep_[i - 1].kept || !sweep_[i].kept || !sweep_[i + 1].kept) return {};
    Point low = point(sweep_[i - 1]), middle = point(sweep_[i]), high = point(sweep_[i + 1]);
    SpeedResponse most = sweep_[i];
    for (int look = 0; look < looks_at_a_peak; ++look) {
      SpeedResponse next = at(vertex(low, middle, high));
      const Point found = point(next);
      if (found.speed == middle.speed) break;
      const bool above = found.speed > middle.speed;
      if (!(found.value < middle.value)) {
        (above ? high : low) = found;
        continue;
      }
      (above ? low : high) = middle;
      middle = found, most = std::move(next);
    }
    return most;
  }

 private:
  // Direction of the neighbour with the larger amplitude: −1, 1; 0: this is the maximum.
  int way_up(std::size_t i) const {
    const double here = value(sweep_[i]), below = i > 0 ? value(sweep_[i - 1]) : HUGE_VAL,
                 above = i + 1 < sweep_.size() ? value(sweep_[i + 1]) : HUGE_VAL;
    if (!(std::min(below, above) < here)) return 0;
    return below < above ? -1 : 1;
  }
  double value(const SpeedResponse& s) const {
    const double amplitude = std::abs(s.orders[c_.joint][c_.harmonic]);
    return std::isfinite(amplitude) ? 1 / (amplitude * amplitude) : 0;
  }
  Point point(const SpeedResponse& s) const { return {s.speed, value(s)}; }

  const CriticalSpeed& c_;
  const std::vector<SpeedResponse>& sweep_;
};

}  // namespace

double frequency_of_resonance(const LinearDrive& drive, const Mode& mode) {
  constexpr double twisted = 0.01;  // share of the mode's twist energy
  if (drive.internal_states() == 0 || mode.of_internal_states) return mode.omega;
  for (std::size_t j = 0; j < mode.shares.joint.size(); ++j)
    if (mode.shares.joint[j] > twisted && drive.joint_by_internal.row(static_cast<Eigen::Index>(j)).norm() > 0)
      return mode.magnitude();
  return mode.omega;
}

void find_critical_speeds(ModesStudy& found) {
  const Excitations& x = found.excitations;
  if (x.by_order.empty() || found.joint_names.empty()) return;
  const std::vector<char> acting = acting_harmonics(x, std::copysign(found.fastest, found.drive.at.speed));
  for (const Mode& mode : found.modes)
    for (std::size_t r = 1; r <= x.harmonics; ++r) {
      if (!acting[r]) continue;
      const double speed = frequency_of_resonance(found.drive, mode) / x.order(r);
      if (speed < found.slowest || speed > found.fastest) continue;
      found.critical.push_back({.speed = speed, .mode = mode.number, .order = x.order(r), .harmonic = r});
    }
  std::sort(found.critical.begin(), found.critical.end(),
            [](const CriticalSpeed& a, const CriticalSpeed& b) { return a.speed < b.speed; });
}

void measure_critical_speeds(const std::function<SpeedResponse(double speed)>& at,
                             const std::function<void(double part)>& progress, ModesStudy& found) {
  if (found.sweep.empty()) return;
  std::vector<SpeedResponse> peaks;
  for (CriticalSpeed& c : found.critical) {
    Deadline::check();
    progress(static_cast<double>(&c - found.critical.data()) / static_cast<double>(found.critical.size()));
    const Mode& mode = found.modes[static_cast<std::size_t>(c.mode) - 1];
    const std::size_t nearest = nearest_of(found.sweep, c.speed);
    c.joint = joint_of(mode);
    std::optional<SpeedResponse> peak;
    // The amplitude under a force is largest at √(1 − 2ζ²) of |λ|, and the torque transmitted by a joint less below it.
    const double damped = mode.magnitude() / c.order, width = (2 * mode.ratio * mode.ratio + 0.02) * damped;
    if (mode.ratio < hardly_vibrates) peak = OrderCurve(c, found.sweep).peak(damped, width, at);
    const SpeedResponse& there = peak ? *peak : found.sweep[nearest];
    if (peak) c.peak = peak->speed;
    c.amplitude = std::abs(there.orders[c.joint][c.harmonic]);
    c.mean = there.joints[c.joint].mean;
    if (peak) peaks.push_back(std::move(*peak));
  }
  std::move(peaks.begin(), peaks.end(), std::back_inserter(found.sweep));
  const auto slower = [](const SpeedResponse& a, const SpeedResponse& b) { return a.speed < b.speed; };
  const auto same = [](const SpeedResponse& a, const SpeedResponse& b) { return a.speed == b.speed; };
  std::stable_sort(found.sweep.begin(), found.sweep.end(), slower);
  found.sweep.erase(std::unique(found.sweep.begin(), found.sweep.end(), same), found.sweep.end());
}

std::vector<double> sweep_speeds(ModesStudy& found) {
  std::vector<double> speeds;
  for (int i = 0; i <= sweep_points; ++i)
    speeds.push_back(std::min(found.slowest + (found.fastest - found.slowest) * i / sweep_points, found.fastest));
  for (const CriticalSpeed& c : found.critical) {
    const Mode& mode = found.modes[static_cast<std::size_t>(c.mode) - 1];
    const double zeta = std::clamp(mode.ratio, 1e-4, 0.2), damped = mode.magnitude() / c.order;
    for (const double factor : {1 - 2 * zeta, 1 - zeta, 1 - 0.4 * zeta, 1.0, 1 + 0.4 * zeta, 1 + zeta, 1 + 2 * zeta})
      speeds.push_back(damped * factor);
    speeds.push_back(c.speed);
  }
  for (const double own : {std::abs(found.drive.at.speed), found.margins.speeds.slowest, found.margins.speeds.fastest})
    speeds.push_back(own);
  std::sort(speeds.begin(), speeds.end());
  std::erase_if(speeds, [&](double w) { return w < found.slowest || w > found.fastest; });
  const auto same = [](double a, double b) { return b - a <= 1e-9 * b; };  // but for rounding
  speeds.erase(std::unique(speeds.begin(), speeds.end(), same), speeds.end());
  const std::size_t solves = speeds.size() * found.excitations.harmonics * static_cast<std::size_t>(found.drive.size());
  if (solves <= 20 * most_solves) return speeds;
  const std::size_t keep = std::max<std::size_t>(20, speeds.size() * 20 * most_solves / solves);
  std::vector<double> fewer;
  for (std::size_t i = 0; i < keep; ++i) fewer.push_back(speeds[i * (speeds.size() - 1) / (keep - 1)]);
  found.notes.push_back(fmt::format("the drive is large: the sweep has {} speeds instead of {}", keep, speeds.size()));
  fewer.erase(std::unique(fewer.begin(), fewer.end()), fewer.end());
  return fewer;
}

double parametric_half_width(double variation, double damping_ratio) {
  const double rest = variation * variation / 16 - damping_ratio * damping_ratio;
  return rest > 0 ? std::sqrt(rest) : 0;
}

void find_zones(ModesStudy& found) {
  const auto& elements = found.drive.model->network.elements;
  if (found.rests_at || std::none_of(elements.begin(), elements.end(),
                                     [](const Network::ShaftElement& e) { return e.element->cycle > 0; }))
    return;
  for (const Mode& mode : found.modes) {
    if (mode.of_internal_states) continue;  // no spring holds it
    const std::vector<double> variation = inertia_variation(found.drive, mode.shape, found.excitations.harmonics);
    for (std::size_t r = 1; r < variation.size(); ++r) {
      ParametricZone zone{.mode = mode.number, .harmonic = r};
      zone.centre = 2 * frequency_of_resonance(found.drive, mode) / found.excitations.order(r);
      zone.variation = variation[r];
      zone.half_width = parametric_half_width(variation[r], std::max(0.0, mode.ratio));
      if (zone.variation > 1e-6 && zone.centre >= found.slowest && zone.centre <= found.fastest)
        found.zones.push_back(zone);
    }
  }
  std::sort(found.zones.begin(), found.zones.end(),
            [](const ParametricZone& a, const ParametricZone& b) { return a.centre < b.centre; });
}

bool grows(const LinearDrive& drive) {
  if (drive.size() + drive.internal_states() > most_coordinates) return false;
  const std::vector<DampedMode> modes = damped_modes(drive, undamped_modes(drive));
  const double pace = std::abs(drive.at.speed);
  return std::any_of(modes.begin(), modes.end(),
                     [&](const DampedMode& mode) { return mode.lambda.real() > std::max(growth * pace, mode.error); });
}

void judge_operating_speeds(const ModesStudy& found, const LinearDrive& drive, SpeedResponse& response) {
  if (!found.keeps_its_speed) return;
  double vibration = response.speed_amplitude;
  if (vibration >= std::abs(response.speed))
    if (const std::optional<LinearDrive> rigid = as_if_rigid(drive))
      vibration = std::min(vibration, respond(*rigid, found.excitations).speed_amplitude);
  response.kept = vibration < std::abs(response.speed) && !grows(drive);
}

std::vector<SpeedStretch> stretches(const std::vector<SpeedResponse>& sweep) {
  std::vector<SpeedStretch> list;
  for (std::size_t i = 0; i < sweep.size(); ++i) {
    if (list.empty() || list.back().kept != sweep[i].kept) list.push_back({i, i, sweep[i].kept});
    list.back().end = i + 1;
  }
  return list;
}

void omit_speeds_not_held(ModesStudy& found) {
  std::string where;
  for (const SpeedStretch& s : stretches(found.sweep))
    if (!s.kept)
      where += (where.empty() ? "" : ", ") +
               speed_range(found.sweep[s.begin].speed, found.sweep[s.end - 1].speed, found.speed_unit);
  if (where.empty()) return;
  const auto is_kept = [&](const CriticalSpeed& c) { return found.sweep[nearest_of(found.sweep, c.speed)].kept; };
  const auto kept = std::stable_partition(found.critical.begin(), found.critical.end(), is_kept);
  found.not_kept.assign(kept, found.critical.end());
  found.critical.erase(kept, found.critical.end());
  const std::size_t gone = found.not_kept.size();
  found.notes.push_back(fmt::format(
      "at {} the machine cannot run continuously: small deviations grow, or the speed would "
      "fluctuate by more than its mean; {}barred ranges there and spot checks are omitted. Passing these speeds "
      "during run-up is judged by the start",
      where, gone > 0 ? fmt::format("{} critical speed{} (with the margins), ", gone, gone == 1 ? "" : "s") : ""));
}

namespace {

// For orders, and at the operating point for laws of fixed frequency, in the joint that each mode twists most.
std::vector<CrossingResponse> responses_of(const ModesStudy& found) {
  std::vector<CrossingResponse> all;
  const auto add = [&](const CriticalSpeed& c, const char* why) {
    all.push_back({.mode = c.mode,
                   .harmonic = c.harmonic,
                   .joint = found.joint_names[c.joint],
                   .amplitude = c.amplitude,
                   .peak = c.peak,
                   .share = c.share,
                   .not_assessed = why});
  };
  for (const CriticalSpeed& c : found.critical) add(c, "");
  for (const CriticalSpeed& c : found.not_kept) add(c, "the machine cannot run continuously there");
  std::map<double, Forcing> laws;
  for (const FrequencySource& f : found.excitations.by_frequency)
    laws.try_emplace(f.omega, Forcing::none(found.drive)).first->second.add(f.kind, f.index, f.amplitude);
  if (laws.empty() || found.joint_names.empty()) return all;
  FrequencyResponse response(found.drive);
  for (const auto& [omega, forcing] : laws) {
    const std::vector<FrequencyResponse::JointVibration> vibrations = response.vibrations(omega, forcing);
    for (const Mode& mode : found.modes)
      if (const std::size_t j = joint_of(mode); !mode.of_internal_states)
        all.push_back({.mode = mode.number,
                       .fixed = omega,
                       .joint = found.joint_names[j],
                       .amplitude = std::abs(vibrations[j].torque)});
  }
  return all;
}

// Notes on margins that could not be determined.
void note_missing_margins(ModesStudy& found) {
  const Margins& m = found.margins;
  if (m.modes.empty()) return;
  double highest = 0;
  for (const ExcitationLine& line : m.lines) highest = std::max(highest, line.at(m.speeds.fastest));
  if (!found.undamped.complete && (1 + m.speeds.margin) * highest > m.modes.back().omega)
    found.notes.push_back(fmt::format(
        "margins: modes above {:.5g} Hz are not listed, and excitations reach {:.5g} Hz; --count gives more",
        m.modes.back().omega / turn, highest / turn));
  if (!found.excitations.by_order.empty())
    found.notes.push_back(
        fmt::format("margins: orders of the scene's laws are listed up to {:g} of {}; --orders gives more",
                    found.excitations.order(found.excitations.harmonics), found.link));
}

// Undamped frequencies in the order of the modes of `found`, with another value of a toleranced key; empty if not found.
std::vector<double> frequencies_with(const Tolerance& t, double value, Scene scene, const Effects& effects,
                                     const ModesOptions& options, const ModesStudy& found) {
  std::vector<double> omega;
  Setting* const setting = t.value != 0 ? quantity_at(scene.components, t.path) : nullptr;
  if (!setting) return omega;
  setting->number *= value / t.value;
  const ModesOptions same{.count = options.count,
                          .speed = found.drive.at.speed,
                          .at = options.at,
                          .angle = options.angle,
                          .modes_alone = true,
                          .start = false};
  try {
    for (const Mode& mode : find_modes(scene, effects, same).modes)
      if (!mode.of_internal_states) omega.push_back(mode.omega);
  } catch (const std::runtime_error&) {  // no machine, or no modes, with that value
  } catch (const std::logic_error&) {
  }
  return omega;
}

// By coordinate, the components on its shaft whose torque or inertia depends on the angle; without any, the shaft.
std::vector<std::string> names_of_exciters(const ModesStudy& found) {
  const Model& m = *found.drive.model;
  std::vector<std::string> names = found.shaft_names;
  for (std::size_t i = 0; i < names.size(); ++i) {
    const auto& nodes = m.shafts[static_cast<std::size_t>(found.drive.shaft[i])].nodes;
    std::vector<std::string> on_shaft;
    for (const Network::ShaftElement& e : m.network.elements)
      if (e.element->is.uses_angle && std::find(nodes.begin(), nodes.end(), e.node) != nodes.end() &&
          std::find(on_shaft.begin(), on_shaft.end(), e.component) == on_shaft.end())
        on_shaft.push_back(e.component);
    if (on_shaft.size() == 1) names[i] = on_shaft.front();
    if (on_shaft.size() == 2) names[i] = on_shaft[0] + " and " + on_shaft[1];
    if (on_shaft.size() > 2) names[i] = fmt::format("{} and {} more", on_shaft[0], on_shaft.size() - 1);
  }
  return names;
}

}  // namespace

void find_margins(const Scene& scene, const Effects& effects, const ModesOptions& options, ModesStudy& found) {
  Margins& m = found.margins;
  const bool by_shaft = found.drive.size() == static_cast<Eigen::Index>(found.shaft_names.size());
  const double speed = std::copysign(found.fastest, found.drive.at.speed);
  m.lines = excitation_lines(*found.drive.model, found.excitations, speed,
                             by_shaft ? names_of_exciters(found) : std::vector<std::string>{}, found.notes);
  for (const Mode& mode : found.modes)
    if (!mode.of_internal_states)
      m.modes.push_back(
          {.number = mode.number,
           .omega = frequency_of_resonance(found.drive, mode),
           .ratio = mode.ratio,
           .name = modes::name_of(found, mode),
           .damping = damping_of(found.drive, found.joint_names, mode.shape,
                                 mode.lambda.imag() > 0 ? std::optional(mode.lambda.real()) : std::nullopt)});
  find_rows(responses_of(found), found.slowest, found.fastest, m);
  if (m.rows.empty()) return;
  note_missing_margins(found);
  const auto frequencies = [&](const Tolerance& t, double value) {
    std::vector<double> omega = frequencies_with(t, value, scene, effects, options, found);
    if (omega.empty() && value == t.value)
      found.notes.push_back(fmt::format("margins: the tolerance of {} is not counted", t.path));
    return omega;
  };
  add_tolerances(tolerances_of(scene.text, scene.file), frequencies, m);
}

}  // namespace kurbel
