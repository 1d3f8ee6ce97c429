// advise_screens.cpp — estimates for each effect from the full model's run and its linearisation, before any other run.
#include "studies/advise/advise_screens.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "engine/numerics/deadline.h"
#include "mechanisms/deforming/deforming_mechanism.h"
#include "studies/modes/modes.h"

namespace kurbel {
namespace {

constexpr double near_a_mode = 0.3;    // of the mode's frequency: an order as near as that makes it vibrate
constexpr double part_of_mode = 0.05;  // of its potential energy: a joint with more takes part in it
constexpr double audible = 0.01;       // of the strongest order: weaker ones excite nothing

std::optional<std::size_t> channel_of(const Result& r, const Name& name) {
  if (!r.trajectory) return {};
  const auto& channels = r.trajectory->channels();
  for (std::size_t k = 0; k < channels.size(); ++k)
    if (channels[k].name == name) return k;
  return {};
}

double work_of(const Result& r, const std::string& line) {
  const auto found = r.energy.by_line.find(line);
  return found == r.energy.by_line.end() ? 0 : found->second;
}
// Reference of work shares: the driving work; for an undriven machine the energy that it has or releases.
struct EnergyBase {
  double energy = 0;  // [J], > 0
  std::string name;
};
EnergyBase energy_base(const Result& r) {
  constexpr double hardly = 1e-6;
  const double driving = std::abs(work_of(r, "driving")), useful = std::abs(work_of(r, "useful"));
  const double motion = std::max(std::abs(r.energy.kinetic_start), std::abs(r.energy.kinetic_end));
  if (driving > hardly * std::max(useful, motion)) return {driving, "the driving work"};
  if (useful > hardly * motion) return {useful, "the useful work"};
  return {std::max(motion, 1e-300), "the energy of the motion"};
}

// The drive with every elastic element flexible and no other effect; empty if it cannot be linearised.
std::optional<ModesStudy> frequency_domain(const Scene& scene, const std::vector<EffectUnit>& units) {
  Effects effects;
  for (const EffectUnit& unit : units)
    if (!unit.component.empty()) effects.elastic.push_back(unit.component);
  if (effects.elastic.empty()) return {};
  try {
    return find_modes(scene, effects, {});
  } catch (const OutOfTime&) {
    throw;
  } catch (const std::exception&) {
    return {};
  }
}

class Screening {
 public:
  Screening(const Result& full, const std::optional<ModesStudy>& modes, double within)
      : full_(full), modes_(modes), within_(within), base_(energy_base(full)) {
    if (modes_) find_quasi_static();
  }

  std::vector<Screen> of(const EffectUnit& unit) {
    if (!unit.component.empty()) return of_elasticity(unit.component);
    if (unit.name == "backlash") return {reversals()};
    if (unit.name == "gear_losses" || unit.name == "bearing_friction" || unit.name == "joint_friction")
      return {losses()};
    if (unit.name == "joint_clearance") return {impacts()};
    if (unit.name == "flexible_rod") return rods();
    return {};
  }

 private:
  std::vector<Screen> of_elasticity(const std::string& component) const {
    std::vector<Screen> screens;
    const auto twist = channel_of(full_, Name::make(quantities::twist, component)),
               torque = channel_of(full_, Name::make(quantities::torque, component));
    if (twist && torque) {
      const auto [share, amplitude] = activity_and_amplitude(*twist, *torque);
      const bool about_zero = !std::isfinite(amplitude);
      screens.push_back(
          {"activity", share,
           fmt::format("∫|τ dθ| is {:.2g} % of {}: {}", 100 * share, base_.name,
                       share > within_ ? "it takes part in the motion" : "little energy passes through it"),
           share > within_});
      screens.push_back(
          {"swing", amplitude,
           about_zero ? std::string("its torque alternates about zero")
                      : fmt::format("the largest torque is {:.3g} × its mean: {}", amplitude,
                                    amplitude > 1.5 ? "it vibrates, or is loaded by shocks" : "it follows the mean"),
           amplitude > 1.5});
    }
    for (std::size_t j = 0; modes_ && j < modes_->joint_names.size(); ++j) {
      if (modes_->joint_names[j] != component) continue;
      if (const auto screen = orders_against_modes(j)) screens.push_back(*screen);
      if (const auto screen = amplification(j)) screens.push_back(*screen);
    }
    return screens;
  }

  // ∫|τ dθ| over the energy transmitted, and the largest torque over its mean; ∞ for zero mean.
  std::pair<double, double> activity_and_amplitude(std::size_t twist, std::size_t torque) const {
    const TrajectoryRecorder& t = *full_.trajectory;
    double activity = 0, mean = 0, largest = 0;
    const std::size_t n = t.time().size();
    for (std::size_t i = 0; i < n; ++i) {
      const double m = t.value(i, torque);
      mean += m / static_cast<double>(n);
      largest = std::max(largest, std::abs(m));
      if (i > 0) activity += std::abs(0.5 * (m + t.value(i - 1, torque)) * (t.value(i, twist) - t.value(i - 1, twist)));
    }
    constexpr double about_zero = 1e-6;
    if (largest == 0) return {0, 1};
    return {activity / base_.energy, std::abs(mean) > about_zero * largest ? largest / std::abs(mean) : HUGE_VAL};
  }

  // min |1 − rΩ/ω_n| over the orders that excite and the modes that this joint takes part in.
  std::optional<Screen> orders_against_modes(std::size_t joint) const {
    const double speed = std::abs(modes_->drive.at.speed);
    double strongest = 0, nearest = HUGE_VAL, order = 0, frequency = 0, exciting = 0;
    const Excitations& e = modes_->excitations;
    for (std::size_t h = 1; h <= e.harmonics; ++h) strongest = std::max(strongest, e.strength(h, speed));
    const auto consider = [&](double omega, double which) {
      for (const Mode& mode : modes_->modes) {
        if (mode.shares.joint[joint] < part_of_mode || omega <= 0) continue;
        const double distance = std::abs(1 - omega / mode.omega);
        if (distance < nearest) nearest = distance, order = which, frequency = mode.omega, exciting = omega;
      }
    };
    if (speed > 0 && strongest > 0)
      for (std::size_t h = 1; h <= e.harmonics; ++h)
        if (e.strength(h, speed) > audible * strongest) consider(e.order(h) * speed, e.order(h));
    for (const FrequencySource& source : e.by_frequency) consider(source.omega, 0);
    if (!std::isfinite(nearest)) return {};
    const double hertz = 1 / (2 * std::numbers::pi);
    const std::string what = order > 0 ? fmt::format("order {:g} ({:.3g} Hz)", order, exciting * hertz)
                                       : fmt::format("the excitation of {:.3g} Hz", exciting * hertz);
    return Screen{"orders against modes", nearest,
                  fmt::format("{} is the nearest to a mode: {:.2g} % from {:.3g} Hz, {}", what, 100 * nearest,
                              frequency * hertz, nearest < near_a_mode ? "it is excited" : "far from resonance"),
                  nearest < near_a_mode};
  }

  // The same response with all joints 10⁴ times as stiff: the torques transmitted without twist.
  void find_quasi_static() {
    LinearDrive stiff = modes_->drive;
    constexpr double factor = 1e4;
    stiff.stiffness *= factor, stiff.row_stiffness *= factor;
    for (LinearDrive::Joint& joint : stiff.joints) joint.stiffness *= factor;
    try {
      quasi_static_ = respond(stiff, modes_->excitations);
    } catch (const OutOfTime&) {
      throw;
    } catch (const std::exception&) {
    }
  }
  std::optional<Screen> amplification(std::size_t joint) const {
    if (quasi_static_.joints.size() <= joint || modes_->here.joints.size() <= joint) return {};
    const double amplitude = modes_->here.joints[joint].peak, still = quasi_static_.joints[joint].peak;
    if (!(still > 0) || !std::isfinite(amplitude)) return {};
    const double ratio = amplitude / still;
    // Its contribution to the greatest torque, including the mean.
    const double mean = std::abs(modes_->here.joints[joint].mean), share = std::abs(amplitude - still) / (mean + still);
    return Screen{
        "quasi-static amplification", ratio,
        fmt::format("the forced amplitude at the operating point is {:.3g} × the quasi-static one, a difference of "
                    "{:.2g} % of its torque: {}",
                    ratio, 100 * share, share > within_ ? "elasticity changes it" : "it twists quasi-statically"),
        share > within_};
  }

  Screen reversals() const {
    int count = 0;
    std::string where;
    for (std::size_t k = 0; full_.trajectory && k < full_.trajectory->channels().size(); ++k) {
      const Channel& channel = full_.trajectory->channels()[k];
      if (channel.name.what != quantities::spring_torque) continue;
      int own = 0;
      double last = 0;
      for (std::size_t i = 0; i < full_.trajectory->time().size(); ++i) {
        const double m = full_.trajectory->value(i, k);
        if (m == 0) continue;
        if (m * last < 0) ++own;
        last = m;
      }
      if (own > 0) where = channel.name.of;
      count += own;
    }
    return {"torque reversals", static_cast<double>(count),
            count ? fmt::format("the torque changes its sign {} times (in {}): flanks separate", count, where)
                  : std::string("no torque changes its sign: flanks stay in contact once closed"),
            count > 0};
  }
  Screen losses() const {
    const double share = std::abs(work_of(full_, "harmful")) / base_.energy;
    return {"share of losses", share, fmt::format("harmful work is {:.2g} % of {}", 100 * share, base_.name),
            share > within_};
  }

  Screen impacts() const {
    double count = 0;
    for (const Figure& f : full_.figures)
      if (f.what == quantities::impacts) count += f.value;
    return {"impacts", count,
            count > 0 ? fmt::format("contact is regained {:.0f} times after separation", count)
                      : std::string("no joint loses contact"),
            count > 0};
  }
  // The rod under its own inertia, mainly of orders 1 and 2.
  std::vector<Screen> rods() const {
    double fastest = 0;  // of the link
    for (const Figure& f : full_.figures)
      if (f.what == quantities::max_speed || f.what == quantities::min_speed)
        fastest = std::max(fastest, std::abs(f.value));
    std::vector<Screen> screens;
    for (const Network::ShaftElement& e : full_.model->network.elements) {
      const SliderCrankDynamics* const dynamics = dynamics_of(e);
      if (!dynamics || dynamics->rod().bending == 0) continue;
      const double crank = fastest * std::abs(full_.model->node_ratio[static_cast<std::size_t>(e.node)]);
      const double ratio = dynamics->rod().frequency(1) / std::max(crank, 1e-300);
      const double more = ratio > 2 ? 1 / (1 - 4 / (ratio * ratio)) - 1 : HUGE_VAL;
      screens.push_back(
          {"rod frequency", ratio,
           fmt::format("the rod of {} bends at {:.3g} × the crank's speed: at order 2 it {}", e.component, ratio,
                       std::isfinite(more) ? fmt::format("amplifies by {:.2g}", more) : "is at or beyond resonance"),
           more > within_});
    }
    return screens;
  }

  const Result& full_;
  const std::optional<ModesStudy>& modes_;
  double within_;
  EnergyBase base_;
  SpeedResponse quasi_static_;
};

}  // namespace

std::vector<std::vector<Screen>> screens_of(const Scene& scene, const std::vector<EffectUnit>& units,
                                            const Result& full, double within) {
  const std::optional<ModesStudy> modes = frequency_domain(scene, units);
  Screening screening(full, modes, within);
  std::vector<std::vector<Screen>> screens;
  for (const EffectUnit& unit : units) screens.push_back(screening.of(unit));
  return screens;
}

}  // namespace kurbel
