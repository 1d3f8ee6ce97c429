// time_scale_cases.cpp — circuits at microseconds beside mechanics at minutes; governors that hardly settle.
#include "tests/hard/families.h"
#include "tests/hard/machines.h"

namespace kurbel::hard {
namespace {

const std::string family = "TimeScales";

// --- L di/dt = U − R i − k ω, J dω/dt = k i − b ω, from rest: two exponentials ---
struct ShuntDrive {
  double voltage = 100, resistance = 1, constant = 0.5, damping = 0, inertia = 25;
  double electrical = 1e-6;  // L/R [s]

  // ω = ω_∞ + a e^{λ₁ t} + b e^{λ₂ t} with ω(0) = ω′(0) = 0; the roots without cancellation.
  double speed_at(double t) const {
    using Real = long double;
    const Real l = Real(electrical) * resistance, k = constant;
    const Real p = resistance / l, q = damping / static_cast<Real>(inertia);
    const Real sum = p + q, product = p * q + k * k / (l * inertia);
    const Real fast = -(sum + std::sqrt(sum * sum - 4 * product)) / 2, slow = product / fast;
    const Real end_speed = k * voltage / (resistance * Real(damping) + k * k);
    const Real a = end_speed * slow / (fast - slow), b = -end_speed * fast / (fast - slow);
    return static_cast<double>(end_speed + a * std::exp(fast * t) + b * std::exp(slow * t));
  }
  std::string scene(double until) const {
    return fmt::format(
        "line = [\"motor\"]\nmotor = {{ kind = \"dc shunt motor\", voltage = {}, resistance = {}, constant = {}, "
        "inductance = {}, inertia = {} }}\ndrag = {{ on = \"motor\", kind = \"bearing drag\", damping = {} }}\nrun = "
        "{{ "
        "until = {} }}\n",
        quantity(voltage, "V"), quantity(resistance, "Ohm"), quantity(constant, "N*m/A"),
        quantity(electrical * resistance, "H"), quantity(inertia, "kg*m2"), quantity(damping, "N*m*s/rad"),
        quantity(until, "s"));
  }
  HardCase run(double until) const {
    return {.family = family,
            .name = fmt::format("CircuitOf1e{:.0f}SecondsOver{:.0f}Milliseconds", std::log10(electrical), until * 1e3),
            .parameter = fmt::format("L/R = {:g} s, {:g} s", electrical, until),
            .scene = scene(until),
            .truths = {closed_form("two exponentials", {by_its_size("final_speed.motor", speed_at(until))})}};
  }
};

HardCase circuit(double electrical, double until) {
  const ShuntDrive drive{.damping = 0.01, .electrical = electrical};
  HardCase c = drive.run(until);
  c.heavy = until > 1e8 * electrical;
  // Stability holds explicit steps to some 6 L/R.
  const auto shortened = std::make_shared<const HardCase>(drive.run(2000 * electrical));
  if (until > 2e4 * electrical)
    for (const char* method : {"dopri5", "verner6", "dop853", "fehlberg8", "adams"}) c.variants[method] = shortened;
  return c;
}

// --- J ω̇ = K_p (ω_r − ω) + I + b ω − M_c, İ = K_i (ω_r − ω): e″ + (K_p − b)/J e′ + K_i/J e = 0 ---
HardCase governor(double damping_ratio) {
  const double inertia = 2, reference = 100, stiffness = 50, load = 30, offset = 2, slope = 0.5;
  const double natural = std::sqrt(stiffness / inertia), gain = 2 * damping_ratio * natural * inertia + slope;
  const double until = 200.2 * 2 * pi / natural / (damping_ratio < 0 ? 4 : 1);
  // e = ω_r − ω, e(0) = −offset, ė(0) = 0 by the initial torque
  const double decay = damping_ratio * natural, damped = natural * std::sqrt(1 - damping_ratio * damping_ratio);
  const double e =
      -offset * std::exp(-decay * until) * (std::cos(damped * until) + decay / damped * std::sin(damped * until));
  const double start = reference + offset;
  // The load falls with the speed: M_c = load − slope (ω − ω_r)
  const double initial = load - slope * offset + gain * offset;
  return {
      .family = family,
      .name = fmt::format("GovernorWith{}1e{:.0f}OfDamping", damping_ratio < 0 ? "Minus" : "",
                          std::log10(std::abs(damping_ratio))),
      .parameter = fmt::format("ζ = {:g}", damping_ratio),
      .scene = fmt::format(
          "line = [\"drive\"]\ndrive = {{ kind = \"governor\", speed = {}, proportional_gain = {}, integral_gain = {}, "
          "max_torque = \"1 kN*m\", min_torque = \"-1 kN*m\", initial_torque = {}, inertia = {} }}\n"
          "mill = {{ on = \"drive\", kind = \"load\", table = {{ over = \"speed\", unit = [\"rad/s\", \"N*m\"], points "
          "= "
          "[[0, {:.17g}], [200, {:.17g}]] }} }}\nrun = {{ start = {{ speed = {} }}, until = {} }}\n",
          quantity(reference, "rad/s"), quantity(gain, "N*m*s/rad"), quantity(stiffness, "N*m/rad"),
          quantity(initial, "N*m"), quantity(inertia, "kg*m2"), load + slope * reference, load - slope * reference,
          quantity(start, "rad/s"), quantity(until, "s")),
      .truths = {
          closed_form("e = e₀ e^(−ζω_n t) (cos ω_d t + ζ/√(1−ζ²) sin ω_d t)", {{"final_speed.drive", reference - e}})}};
}

}  // namespace

std::vector<HardCase> time_scale_cases() {
  std::vector<HardCase> cases = {circuit(1e-2, 1), circuit(1e-4, 1), circuit(1e-6, 100), circuit(1e-6, 1000),
                                 governor(1e-2),   governor(1e-4),   governor(-1e-3)};
  // Methods of low order need minutes for the last digits; their budget stops them, which is no wrong answer.
  for (HardCase& c : cases) c.budget = 1.5;
  return cases;
}

}  // namespace kurbel::hard
