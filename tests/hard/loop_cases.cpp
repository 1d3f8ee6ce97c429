// loop_cases.cpp — closed loops of shafts: ways of very different stiffness, what is locked in over long runs, almost
// massless wheels within a loop, ratios that clash by little.
#include "tests/hard/families.h"
#include "tests/hard/machines.h"

namespace kurbel::hard {
namespace {

const std::string family = "Loop";
constexpr double speed = 10;  // of both ends at the start [rad/s]

struct TwoWays {
  double inertia = 1;  // of each end [kg·m²]
  double a = 100, b = 100, locked_in = 0.02;

  std::string scene(double until) const {
    return fmt::format(
        "line = [\"j0\", \"a\", \"j1\"]\nj0 = {{ kind = \"flywheel\", inertia = {0} }}\n"
        "a = {{ kind = \"coupling\", stiffness = {1} }}\nj1 = {{ kind = \"flywheel\", inertia = {0} }}\n"
        "b = {{ kind = \"coupling\", stiffness = {2} }}\nbranch = [{{ from = \"j0\", line = [\"b\"], to = \"j1\" }}]\n"
        "effects = {{ elasticity = true }}\n"
        "run = {{ start = {{ speed = {3}, a = {{ twist = {4} }} }}, until = {5} }}\n",
        quantity(inertia, "kg*m2"), quantity(a, "N*m/rad"), quantity(b, "N*m/rad"), quantity(speed, "rad/s"),
        quantity(locked_in, "rad"), quantity(until, "s"));
  }
  // The ends' twist x against the loop, from 0: x = x₀ (1 − cos Ωt), x₀ = −θ₀ a/(a + b), Ω² = 2 (a + b)/J.
  HardCase released(const std::string& name, const std::string& parameter, double until) const {
    const long double sum = static_cast<long double>(a) + b, omega = std::sqrt(2 * sum / inertia);
    const long double middle = -locked_in * a / sum, phase = omega * static_cast<long double>(until);
    const long double x = middle * (1 - std::cos(phase)), rate = middle * omega * std::sin(phase);
    const auto half = [](long double mean, long double difference) {
      return static_cast<double>(mean + difference / 2);
    };
    const double other = static_cast<double>(2 * b * middle);  // the greatest torque of the other way
    return {.family = family,
            .name = name,
            .parameter = parameter,
            .scene = scene(until),
            .truths = {closed_form("x = x₀ (1 − cos Ωt), Ω² = 2 (a + b)/J",
                                   {{"final_speed.j0", half(speed, rate)},
                                    {"final_speed.j1", half(speed, -rate)},
                                    {"final_angle.j0", half(speed * static_cast<long double>(until), x)},
                                    {"peak_torque.a", locked_in * a},
                                    {"peak_torque.b", other}})}};
  }
};

HardCase ways_of_ratio(int decades) {
  TwoWays ways;
  ways.b = ways.a * std::pow(10.0, decades);
  return ways.released(fmt::format("WaysOfStiffnessOneTo1e{:02d}", decades), fmt::format("k ratio 1e{}", decades),
                       20 / std::sqrt(2 * (ways.a + ways.b)));
}

// 2000 vibrations: what is locked in neither fades nor grows.
HardCase locked_in_for_long() {
  const TwoWays ways{.inertia = 1, .a = 100, .b = 300, .locked_in = 0.02};
  return ways.released("LockedInTorqueSwingsForLong", "200 swings", 200.25 * 2 * pi / std::sqrt(800.0));
}

// A rig: two gears of 1 : 3 back to back, wheels of 1e-9 kg·m² between shaft and mesh, damped shafts, clamped by a twist.
// Started in balance it turns on under no load for ever: speeds and torques stay.
HardCase almost_massless_wheels(double inertia) {
  const double twist = 0.01, k = 2e4;
  // Springs on the fast side k/9 … of the slow shaft and k in series along the loop.
  const double torque = twist * k * (k / 9) / (k + k / 9);
  const std::string gear = fmt::format(
      "{{ kind = \"gearbox\", stages = [{{ teeth = [20, 60], inertia = [{0}, {0}] }}] }}", quantity(inertia, "kg*m2"));
  const std::string shaft =
      fmt::format("{{ kind = \"coupling\", stiffness = {}, damping = \"1 N*m*s/rad\" }}", quantity(k, "N*m/rad"));
  const std::string scene = fmt::format(
      "line = [\"wheel\", \"one\", \"slow\"]\nwheel = {{ kind = \"flywheel\", inertia = \"0.5 kg*m2\" }}\n"
      "one = {0}\nslow = {1}\ntwo = {0}\nfast = {1}\n"
      "branch = [{{ from = \"one.in\", line = [\"fast\", \"two\"], to = \"slow.out\" }}]\n"
      "effects = {{ elasticity = true }}\nrun = {{ start = {{ speed = \"30 rad/s\", on = \"wheel\", equilibrium = "
      "true, "
      "fast = {{ twist = \"10 mrad\" }} }}, until = \"1 s\" }}\n",
      gear, shaft);
  return {.family = family,
          .name = fmt::format("WheelsOf1em{:.0f}InTheLoop", -std::log10(inertia)),
          .parameter = fmt::format("J = {:.0e} kg·m²", inertia),
          .scene = scene,
          .truths = {closed_form(
              "springs in series around the loop",
              {{"final_speed.wheel", 30}, {"peak_torque.fast", torque}, {"peak_torque.slow", -3 * torque}})},
          .heavy = true};
}

// Two ways from end to end by gears of 1 : 3 and 1001 : 3003.
HardCase ratios(bool clash) {
  const std::string scene = fmt::format(
      "line = [\"wheel\", \"one\", \"end\"]\nwheel = {{ kind = \"flywheel\", inertia = \"0.5 kg*m2\" }}\n"
      "one = {{ kind = \"gearbox\", stages = [{{ teeth = [1000, 3000] }}] }}\nend = {{ kind = \"flywheel\", inertia = "
      "\"1 "
      "kg*m2\" }}\ntwo = {{ kind = \"gearbox\", stages = [{{ teeth = [{}, {}] }}] }}\n"
      "soft = {{ kind = \"coupling\", stiffness = \"10 kN*m/rad\" }}\neffects = {{ elasticity = true }}\n"
      "branch = [{{ from = \"wheel\", line = [\"two\", \"soft\"], to = \"end\" }}]\n"
      "run = {{ start = {{ speed = \"30 rad/s\", on = \"wheel\" }}, until = \"1 s\" }}\n",
      1001, clash ? 3004 : 3003);
  HardCase c{.family = family,
             .name = clash ? "RatiosThatClashByThreeInTenThousandAreTold" : "RatiosThatAgreeByOtherTeethGoTogether",
             .parameter = clash ? "i = 3 and 3004/1001" : "i = 3 and 3003/1001",
             .scene = scene};
  if (clash)
    c.refusal = {"ratio"};
  else
    c.truths = {closed_form("ω stays", {{"final_speed.wheel", 30}, {"final_angle.wheel", 30}})};
  return c;
}

}  // namespace

std::vector<HardCase> loop_cases() {
  std::vector<HardCase> cases;
  for (const int decades : {3, 6, 9}) cases.push_back(ways_of_ratio(decades));
  cases.push_back(locked_in_for_long());
  for (const double inertia : {1e-6, 1e-9}) cases.push_back(almost_massless_wheels(inertia));
  for (const bool clash : {false, true}) cases.push_back(ratios(clash));
  return cases;
}

}  // namespace kurbel::hard
