// blow_cases.cpp — forces that come and go within microseconds: break-through, hammer blows, emergency brakes, jams.
#include <algorithm>

#include "tests/hard/families.h"
#include "tests/hard/machines.h"

namespace kurbel::hard {
namespace {

const std::string family = "Blow";

// A peak that is reached to either side: which side is ahead by a last digit means nothing.
Truth peak_of_either_sign(const std::string& words, const std::string& name, double value) {
  return residual(words, [name, value](const Result& result) {
    const Figure* figure = result.find(name);
    return figure ? std::abs(std::abs(figure->value) - value) / std::min(figure->scale, 10 * value) : HUGE_VAL;
  });
}

// --- a press blow out of a flywheel's energy; after the work the force falls to nothing within `drop` of travel ---
//     useful work F (s_n − s_b) + ½ F d, whatever the motion
HardCase breaks_through(double drop, bool elastic) {
  const double force = 50e3, travel = 0.02, through = 0.01;
  const Crank crank{.mass = 12};
  const std::string scene = fmt::format(
      "line = [\"flywheel\", \"shaft\", \"press\"]\n"
      "flywheel = {{ kind = \"flywheel\", inertia = \"20 kg*m2\" }}\n"
      "shaft = {{ kind = \"coupling\", stiffness = \"200 kN*m/rad\", damping_ratio = 0.01 }}\n"
      "press = {{ {}, load = {{ kind = \"press\", nominal_force = {}, nominal_travel = {}, breakthrough = {}, drop = "
      "{} "
      "}} }}\n"
      "run = {{ start = {{ speed = \"20 rad/s\", angle = \"180 deg\" }}, until = \"0.25 s\" }}\n",
      crank.keys(), quantity(force, "N"), quantity(travel, "m"), quantity(through, "m"), quantity(drop, "m"));
  std::vector<std::string> figures = {"final_speed.press", "final_angle.press"};
  if (elastic) figures.push_back("peak_torque.shaft");
  const std::string effects = elastic ? "elasticity" : "none";
  return {
      .family = family,
      .name = fmt::format("PressBreaksThrough{}In{:.0f}Micrometres", elastic ? "Elastically" : "", drop * 1e6),
      .parameter = fmt::format("force gone within {:g} mm, {}", drop * 1e3, elastic ? "elastic" : "rigid"),
      .scene = scene,
      .effects = effects,
      .truths = {closed_form("work F (s_n − s_b) + ½ F d", {{"work.useful", -force * (travel - through + 0.5 * drop)}}),
                 converged(scene, figures, "dop853", "verner6", effects)}};
}

// --- a triangular blow of impulse H on one of two free masses ---
//     θ = H/(J₁ ω_n) (sin ½ω_n w/(½ω_n w))² sin ω_n (t − t_m) after it
HardCase hammer(double width) {
  const double j1 = 0.5, j2 = 2, k = 2e4, impulse = 10, begin = 0.1, until = 0.3;
  const double natural = std::sqrt(k * (1 / j1 + 1 / j2)), half = 0.5 * natural * width;
  const double rate = impulse / j1 * std::pow(std::sin(half) / half, 2);
  const double relative = rate * std::cos(natural * (until - begin - width)), common = impulse / (j1 + j2);
  return {.family = family,
          .name = fmt::format("HammerOf{:.0f}NanosecondsRings", width * 1e9),
          .parameter = fmt::format("2 × {:g} s", width),
          .scene = fmt::format(
              "line = [\"a\", \"c\", \"b\"]\n"
              "a = {{ kind = \"inertia\", inertia = {} }}\nb = {{ kind = \"inertia\", inertia = {} }}\n"
              "c = {{ kind = \"coupling\", stiffness = {} }}\n"
              "blow = {{ on = \"a\", kind = \"torque source\", table = {{ over = \"time\", unit = [\"s\", \"N*m\"], "
              "points = [[0, 0], [{:.17g}, 0], [{:.17g}, {:.17g}], [{:.17g}, 0]] }} }}\n"
              "effects = {{ elasticity = true }}\nrun = {{ until = {} }}\n",
              quantity(j1, "kg*m2"), quantity(j2, "kg*m2"), quantity(k, "N*m/rad"), begin, begin + width,
              impulse / width, begin + 2 * width, quantity(until, "s")),
          .truths = {closed_form("θ = H/(J₁ ω_n) (sin ½ω_n w/(½ω_n w))² sin ω_n (t − t_m)",
                                 {by_its_size("final_speed.a", common + j2 / (j1 + j2) * relative),
                                  by_its_size("final_speed.b", common - j1 / (j1 + j2) * relative)}),
                     peak_of_either_sign("peak torque k θ_max", "peak_spring_torque.c", k * rate / natural)}};
}

// --- a brake that stops a shaft within J ω₀/M ---
HardCase emergency_brake(double torque) {
  const double inertia = 2, speed = 150, begin = 0.2;
  return {.family = family,
          .name = fmt::format("EmergencyBrakeOf{:.0f}NewtonmetresStops", torque),
          .parameter = fmt::format("stops within {:g} s", inertia * speed / torque),
          .scene = fmt::format("line = [\"disc\"]\ndisc = {{ kind = \"inertia\", inertia = {} }}\n"
                               "brake = {{ on = \"disc\", kind = \"brake\", torque = {}, start = {} }}\n"
                               "run = {{ start = {{ speed = {} }}, until = \"1.5 s\" }}\n",
                               quantity(inertia, "kg*m2"), quantity(torque, "N*m"), quantity(begin, "s"),
                               quantity(speed, "rad/s")),
          .truths = {closed_form("φ = ω₀ t_b + ½ J ω₀²/M, and it stays",
                                 {{"final_angle.disc", speed * begin + 0.5 * inertia * speed * speed / torque},
                                  {"final_speed.disc", 0}})}};
}

// --- the far end is stopped dead: the near mass winds up the shaft, k θ = ω₀ √(k J₁) ---
HardCase jam(double stiffness) {
  const double j1 = 1, j2 = 1e-3, speed = 100, brake = 1e9;
  const double at_stop = 0.5 * speed * j2 * speed / brake;  // twist by then
  return {.family = family,
          .name = fmt::format("JammedShaftOf1e{:.0f}WindsUpToAFiniteTorque", std::log10(stiffness)),
          .parameter = fmt::format("k = {:g} N·m/rad, stopped within {:g} s", stiffness, j2 * speed / brake),
          .scene = fmt::format("line = [\"rotor\", \"shaft\", \"end\"]\n"
                               "rotor = {{ kind = \"inertia\", inertia = {} }}\nend = {{ kind = \"inertia\", inertia = "
                               "{} }}\nshaft = {{ kind = \"coupling\", stiffness = {} }}\n"
                               "jam = {{ on = \"end\", kind = \"brake\", torque = {}, start = \"0.01 s\" }}\n"
                               "effects = {{ elasticity = true }}\n"
                               "run = {{ start = {{ speed = {} }}, until = \"0.1 s\" }}\n",
                               quantity(j1, "kg*m2"), quantity(j2, "kg*m2"), quantity(stiffness, "N*m/rad"),
                               quantity(brake, "N*m"), quantity(speed, "rad/s")),
          .truths = {closed_form("the end stands", {{"final_speed.end", 0}}),
                     peak_of_either_sign("½ k θ² = ½ J₁ ω₀²", "peak_spring_torque.shaft",
                                         stiffness * std::hypot(speed / std::sqrt(stiffness / j1), at_stop))}};
}

// The slider runs into an obstacle that gives way to no force of the machine.
HardCase blocked_slider() {
  const Crank crank{.mass = 12};
  const std::string scene = fmt::format(
      "line = [\"flywheel\", \"shaft\", \"press\"]\n"
      "flywheel = {{ kind = \"flywheel\", inertia = \"20 kg*m2\" }}\n"
      "shaft = {{ kind = \"coupling\", stiffness = \"200 kN*m/rad\", damping_ratio = 0.01 }}\n"
      "press = {{ {}, load = {{ kind = \"press\", nominal_force = \"5 MN\", nominal_travel = \"40 mm\" }} }}\n"
      "effects = {{ elasticity = true }}\n"
      "run = {{ start = {{ speed = \"20 rad/s\", angle = \"180 deg\" }}, until = \"0.25 s\" }}\n",
      crank.keys());
  return {.family = family,
          .name = "BlockedSliderLoadsTheShaftByItsElasticity",
          .parameter = "5 MN against 20 kg·m² at 20 rad/s",
          .scene = scene,
          .truths = {converged(scene, {"peak_torque.shaft", "final_angle.press", "final_speed.flywheel"})}};
}

}  // namespace

std::vector<HardCase> blow_cases() {
  std::vector<HardCase> cases;
  for (const double drop : {1e-3, 1e-5, 0.0}) cases.push_back(breaks_through(drop, false));
  for (const double drop : {1e-3, 1e-5, 0.0}) cases.push_back(breaks_through(drop, true));
  for (const double width : {1e-3, 1e-5, 1e-7}) cases.push_back(hammer(width));
  for (const double torque : {300.0, 3e4, 3e6}) cases.push_back(emergency_brake(torque));
  for (const double stiffness : {1e4, 1e6, 1e8}) cases.push_back(jam(stiffness));
  cases.push_back(blocked_slider());
  for (HardCase& c : cases) c.budget = 2;
  return cases;
}

}  // namespace kurbel::hard
