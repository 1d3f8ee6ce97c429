// nameplate.cpp — three conditions for three reactances and resistances: by nested bisections, each of a monotone
// function.
#include "drivetrain/induction/nameplate.h"

#include <fmt/format.h>

#include <cmath>
#include <complex>
#include <numbers>

#include "engine/scene/units.h"

namespace kurbel {
namespace {

// Where a function of the logarithm that falls passes through zero.
double falls_through(double low, double high, const auto& function) {
  for (int i = 0; i < 200; ++i) {
    const double middle = std::sqrt(low * high);
    (function(middle) > 0 ? low : high) = middle;
  }
  return std::sqrt(low * high);
}

class Estimate {
 public:
  explicit Estimate(const Nameplate& plate) : plate_(plate) {
    const double losses = plate.input_power - plate.rated_torque() * plate.synchronous_speed();
    stator_ = plate.stator_share * losses / (3 * plate.current * plate.current);
    base_ = plate.voltage / std::sqrt(3.0) / plate.current;
  }
  double stator_resistance() const { return stator_; }
  double base() const { return base_; }  // impedance of a phase at rated current [Ω]

  // M_b, whatever the rotor's resistance: falls as X rises.
  double breakdown(double leakage, double magnetising) const {
    return of(leakage, magnetising, 1).characteristic().breakdown_torque;
  }
  // With M_b and M(s_n) as the catalogue has them.
  EquivalentCircuit at(double magnetising) const {
    const double leakage = falls_through(1e-6 * base_, 10 * base_,
                                         [&](double x) { return breakdown(x, magnetising) - plate_.breakdown_torque; });
    EquivalentCircuit c = of(leakage, magnetising, 1);
    const std::complex<double> z = c.thevenin_impedance();
    const double reach = std::hypot(z.real(), z.imag() + leakage), q = z.real() / reach;  // a s_b
    // M_n = 2 M_b (1 + q) s s_b/(s² + s_b² + 2 q s_b s)
    const double ratio = plate_.breakdown_torque / plate_.rated_torque(), b = ratio * (1 + q) - q;
    c.rotor_resistance = plate_.rated_slip() * (b + std::sqrt(b * b - 1)) * reach;
    return c;
  }

 private:
  EquivalentCircuit of(double leakage, double magnetising, double rotor) const {
    return {.voltage = plate_.voltage,
            .frequency = plate_.frequency,
            .pole_pairs = plate_.pole_pairs,
            .stator_resistance = stator_,
            .rotor_resistance = rotor,
            .stator_leakage = leakage,
            .rotor_leakage = leakage,
            .magnetising = magnetising};
  }

  const Nameplate& plate_;
  double stator_ = 0, base_ = 0;
};

}  // namespace

double Nameplate::synchronous_speed() const { return 2 * std::numbers::pi * frequency / pole_pairs; }

NameplateCircuit circuit_of(const Nameplate& plate) {
  const Estimate estimate(plate);
  const double base = estimate.base();
  if (estimate.stator_resistance() <= 0)
    return {{},
            fmt::format("takes {} from the mains, but its field alone hands M_n ω_s = {} to the rotor; power_factor, "
                        "efficiency or rated_current is too small",
                        with_unit(plate.input_power / 1e3, "kW", 4),
                        with_unit(plate.rated_torque() * plate.synchronous_speed() / 1e3, "kW", 4))};
  // Weak fields leave no room for M_b: the least X_m with which it is reached even without leakage.
  const double most = 1e4 * base, reached = estimate.breakdown(1e-6 * base, most);
  if (reached < plate.breakdown_torque)
    return {{},
            fmt::format("cannot reach its breakdown torque of {} over the stator's resistance of {} (at most {}); a "
                        "smaller stator_loss_share, or a greater efficiency, may be meant",
                        with_unit(plate.breakdown_torque, "N*m", 4), with_unit(estimate.stator_resistance(), "Ohm", 4),
                        with_unit(reached, "N*m", 4))};
  const double least = falls_through(
      1e-3 * base, most, [&](double x) { return plate.breakdown_torque - estimate.breakdown(1e-6 * base, x); });
  const auto excess = [&](double x) {
    return line_current(estimate.at(x), plate.rated_slip()).current - plate.current;
  };
  if (excess(most) > 0)
    return {{},
            fmt::format("would take {} at rated torque without any current for its field, which is more than the rated "
                        "{}; rated_current, voltage or breakdown_ratio does not fit",
                        with_unit(line_current(estimate.at(most), plate.rated_slip()).current, "A", 4),
                        with_unit(plate.current, "A", 4))};
  if (excess(1.001 * least) < 0)
    return {{},
            fmt::format("cannot take its rated current of {} at rated torque; check power_factor and voltage",
                        with_unit(plate.current, "A", 4))};
  return {estimate.at(falls_through(1.001 * least, most, excess)), {}};
}

}  // namespace kurbel
