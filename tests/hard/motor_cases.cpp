// motor_cases.cpp — induction motors at their breakdown torque, against too much load, reversed, on the unstable
// branch; a series motor that runs away.
#include "tests/hard/families.h"
#include "tests/hard/machines.h"

namespace kurbel::hard {
namespace {

const std::string family = "Motor";

// Kloss' formula with a = 0 (theory 4.1).
struct Kloss {
  double synchronous = 100, rated = 96, power = 1500, ratio = 2.5;
  double breakdown() const { return ratio * power / rated; }
  double breakdown_slip() const { return (synchronous - rated) / synchronous * (ratio + std::sqrt(ratio * ratio - 1)); }
  long double torque(long double speed) const {
    const long double s = (synchronous - speed) / synchronous, sb = breakdown_slip();
    return 2 * breakdown() * s * sb / (s * s + sb * sb);
  }
  // Where it balances a load, on the stable branch or the other one.
  double speed_at(double load, bool stable) const {
    const double b = breakdown() / load,
                 s = breakdown_slip() * (stable ? b - std::sqrt(b * b - 1) : b + std::sqrt(b * b - 1));
    return synchronous * (1 - s);
  }
  std::string scene(double inertia, const std::string& load, const std::string& start, double until,
                    const std::string& more = "") const {
    return fmt::format(
        "line = [\"motor\", \"drum\"]\nmotor = {{ kind = \"induction motor\", rated_power = {}, rated_speed = {}, "
        "synchronous_speed = {}, breakdown_ratio = {}, inertia = {} }}\ndrum = {{ kind = \"load\", {} }}\n{}"
        "run = {{ start = {}, until = {} }}\n",
        quantity(power, "W"), quantity(rated, "rad/s"), quantity(synchronous, "rad/s"), ratio,
        quantity(inertia, "kg*m2"), load, more, start, quantity(until, "s"));
  }
};
const Kloss motor;

std::string constant(double torque) { return "torque = " + quantity(torque, "N*m"); }
std::string at_speed(double speed) { return fmt::format("{{ speed = {} }}", quantity(speed, "rad/s")); }

// Under its breakdown torque a load is carried: from above, the motor settles where both torques meet.
HardCase carries(double part) {
  const double inertia = 0.02, load = part * motor.breakdown(), end = motor.speed_at(load, true);
  const double slope = static_cast<double>(motor.torque(end + 1e-4) - motor.torque(end - 1e-4)) / 2e-4;
  return {.family = family,
          .name = fmt::format("CarriesALoadOf{:.0f}PerMillionOfBreakdown", part * 1e6),
          .parameter = fmt::format("M_c = {:g} M_b", part),
          .scene = motor.scene(inertia, constant(load), at_speed(96), 40 * inertia / -slope),
          .truths = {closed_form("s/s_b + s_b/s = 2 M_b/M_c", {{"final_speed.motor", end}})}};
}

// Over it the motor slips through the gap of M_c − M_b and stalls; the angle turned by then is ∫ ω J dω/(M_c − M).
HardCase stalls(double part) {
  const double inertia = 0.02, load = part * motor.breakdown();
  const auto rate = [&](long double w) { return inertia / (load - motor.torque(w)); };
  const auto turned = [&](long double w) { return w * rate(w); };
  const long double summit = motor.synchronous * (1 - motor.breakdown_slip());
  const double time = static_cast<double>(simpson(rate, 0, summit, 200000) + simpson(rate, summit, 96, 200000));
  const double angle = static_cast<double>(simpson(turned, 0, summit, 200000) + simpson(turned, summit, 96, 200000));
  HardCase c{
      .family = family,
      .name = fmt::format("StallsUnderALoadOf{:.0f}PerMillionOfBreakdown", part * 1e6),
      .parameter = fmt::format("M_c = {:g} M_b", part),
      .scene = motor.scene(inertia, constant(load), at_speed(96), 1.2 * time),
      .truths = {closed_form("φ = ∫ ω J dω/(M_c − M)", {{"final_angle.motor", angle}, {"final_speed.motor", 0}})}};
  // ∂φ/∂ ln M_c, by a millionth of what exceeds M_b
  const double more = load + 1e-6 * (part - 1) * motor.breakdown();
  const auto turned_more = [&](long double w) { return w * inertia / (more - motor.torque(w)); };
  const double moved =
      static_cast<double>(simpson(turned_more, 0, summit, 200000) + simpson(turned_more, summit, 96, 200000)) - angle;
  c.condition = std::abs(moved) / ((more - load) / load);
  c.condition_words = "∂φ/∂ ln M_c on the closed form: the load holds its last digit only";
  return c;
}

// A load that holds more than the starting torque keeps the shaft at rest, exactly and at no cost.
HardCase cannot_start(double part) {
  const double load = part * static_cast<double>(motor.torque(0));
  HardCase c{.family = family,
             .name = fmt::format("CannotStartAgainst{:.0f}PerMilleOfItsStartingTorque", part * 1e3),
             .parameter = fmt::format("M_c = {:g} M_start, 1000 s", part),
             .scene = motor.scene(0.02, constant(load), "\"rest\"", 1000),
             .truths = {closed_form("it stays", {{"final_angle.motor", 0, 1e-6}, {"final_speed.motor", 0, 1e-6}}),
                        residual("steps beyond 500, in a thousand", [](const Result& r) {
                          return std::max<double>(0, static_cast<double>(r.statistics.stepper.steps) - 500) / 1000;
                        })}};
  return c;
}

// Two phases swapped at speed: through zero into the other sense.
HardCase plugging() {
  const std::string scene = motor.scene(0.05, "torque = \"4 N*m\", damping = \"0.02 N*m*s/rad\"", at_speed(96), 1.5,
                                        "sequence = { steps = [{ at = \"0.1 s\", set = \"motor\", to = -1 }] }\n");
  return {.family = family,
          .name = "PluggedItTurnsRoundThroughRest",
          .parameter = "reversed at 96 rad/s against dry friction",
          .scene = scene,
          .truths = {converged(scene, {"final_speed.motor", "final_angle.motor"})}};
}

// Beside the point of balance where dM_d/dω > dM_c/dω, departures grow as e^(λt).
HardCase unstable(double off) {
  const double inertia = 0.05, load = 0.8 * motor.breakdown(), balance = motor.speed_at(load, false);
  const double slope = static_cast<double>(motor.torque(balance + 1e-4) - motor.torque(balance - 1e-4)) / 2e-4;
  const double until = std::log(5 / std::abs(off)) * inertia / slope;
  const std::string scene = motor.scene(inertia, constant(load), at_speed(balance + off), until);
  return {.family = family,
          .name = fmt::format("LeavesTheUnstableBranch{}From1e{:.0f}", off > 0 ? "Upwards" : "Downwards",
                              std::log10(std::abs(off))),
          .parameter = fmt::format("{:g} rad/s beside the balance", off),
          .scene = scene,
          .truths = {converged(scene, {"final_speed.motor", "final_angle.motor"})},
          .condition = 4 * balance * std::exp(until * slope / inertia) / 100,
          .condition_words = "e^(λT) of the departure, which the start speed holds to its last digit"};
}

// d(R + κω)³/dt = 3 κ² U²/J, without load.
std::string series(double until, double max_speed) {
  return fmt::format(
      "line = [\"motor\"]\nmotor = {{ kind = \"dc series motor\", voltage = \"100 V\", resistance = \"1 Ohm\", "
      "constant = "
      "\"0.02 N*m/A2\", inertia = \"0.5 kg*m2\", max_speed = {} }}\nrun = {{ until = {} }}\n",
      quantity(max_speed, "rad/s"), quantity(until, "s"));
}
HardCase runs_up() {
  const double r = 1, kappa = 0.02, u = 100, inertia = 0.5, until = 20;
  const double sum = std::cbrt(r * r * r + 3 * kappa * kappa * u * u * until / inertia);
  return {.family = family,
          .name = "SeriesMotorWithoutLoadGainsAsTheCubeRoot",
          .parameter = "20 s",
          .scene = series(until, 1e4),
          .truths = {closed_form("(R + κω)³ = R³ + 3 κ² U² t/J", {{"final_speed.motor", (sum - r) / kappa}})}};
}
HardCase runs_away() {
  return {.family = family,
          .name = "SeriesMotorThatRunsAwayIsToldInWords",
          .parameter = "past max_speed",
          .scene = series(20, 200),
          .refusal = {"ran away", "max_speed"}};
}

// Switched on at rest with its currents: 50 Hz torques of many times the rated one, over a run-up.
HardCase with_currents() {
  const std::string scene =
      "line = [\"motor\", \"drum\"]\nmotor = { kind = \"induction motor\", rated_power = \"4 kW\", rated_speed = "
      "\"1440 "
      "rpm\", synchronous_speed = \"1500 rpm\", breakdown_ratio = 2.6, resistance_ratio = 1, frequency = \"50 Hz\", "
      "inertia = \"0.014 "
      "kg*m2\" "
      "}\ndrum = { kind = \"load\", quadratic = \"0.0008 N*m*s2/rad2\", inertia = \"0.02 kg*m2\" }\nrun = { until = "
      "\"0.2 s\" }\n";
  return {.family = family,
          .name = "SwitchedOnWithItsCurrentsItRingsAtTheMains",
          .parameter = "two-axis circuit, 4 kW",
          .scene = scene,
          .truths = {converged(scene, {"final_speed.motor", "final_angle.motor"})}};
}

}  // namespace

std::vector<HardCase> motor_cases() {
  std::vector<HardCase> cases;
  for (const double part : {0.9, 0.999, 0.99999}) cases.push_back(carries(part));
  for (const double part : {1.1, 1.001, 1.00001}) cases.push_back(stalls(part));
  for (const double part : {1.001, 2.0}) cases.push_back(cannot_start(part));
  cases.push_back(plugging());
  for (const double off : {1e-2, -1e-2, 1e-6}) cases.push_back(unstable(off));
  cases.push_back(runs_up());
  cases.push_back(runs_away());
  cases.push_back(with_currents());
  for (HardCase& c : cases) c.budget = 2;
  return cases;
}

}  // namespace kurbel::hard
