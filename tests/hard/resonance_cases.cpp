// resonance_cases.cpp — torques exactly at a natural frequency, runs through resonance, parametric resonance.
#include "tests/hard/families.h"
#include "tests/hard/machines.h"

namespace kurbel::hard {
namespace {

const std::string family = "Resonance";

// --- M sin ω_n t on one of two free masses: θ = M/(2 J₁ ω_n²) (sin ω_n t − ω_n t cos ω_n t) ---
HardCase at_the_natural_frequency(int periods, double damping_ratio) {
  const double j1 = 0.5, j2 = 2, k = 2e4, torque = 20;
  const double natural = std::sqrt(k * (1 / j1 + 1 / j2)), until = (periods + 0.3) * 2 * pi / natural;
  const std::string scene = fmt::format(
      "line = [\"a\", \"c\", \"b\"]\na = {{ kind = \"inertia\", inertia = {} }}\nb = {{ kind = \"inertia\", inertia = "
      "{} "
      "}}\nc = {{ kind = \"coupling\", stiffness = {}, damping_ratio = {:.17g} }}\n"
      "shaker = {{ on = \"a\", kind = \"torque source\", amplitude = {}, frequency = {} }}\n"
      "effects = {{ elasticity = true }}\nrun = {{ until = {} }}\n",
      quantity(j1, "kg*m2"), quantity(j2, "kg*m2"), quantity(k, "N*m/rad"), damping_ratio, quantity(torque, "N*m"),
      quantity(natural / (2 * pi), "Hz"), quantity(until, "s"));
  HardCase c{.family = family,
             .name = fmt::format("At{}{}PeriodsOfTheNaturalFrequency", damping_ratio > 0 ? "Damped" : "", periods),
             .parameter = fmt::format("{} periods, ζ = {:g}", periods, damping_ratio),
             .scene = scene,
             .truths = {}};
  if (damping_ratio > 0) {
    c.truths.push_back(converged(scene, {"final_speed.a", "final_speed.b", "peak_torque.c"}));
    return c;
  }
  // J₂ ω₂ = ∫ k θ dt, J₁ ω₁ = ∫ M sin ω_n t dt − J₂ ω₂
  const double x = natural * until, amplitude = torque / (2 * j1 * natural * natural);
  const double momentum = k * amplitude / natural * (2 * (1 - std::cos(x)) - x * std::sin(x));
  const double given = torque / natural * (1 - std::cos(x));
  c.truths.push_back(closed_form("θ = M/(2 J₁ ω_n²) (sin ω_n t − ω_n t cos ω_n t)",
                                 {{"final_speed.b", momentum / j2}, {"final_speed.a", (given - momentum) / j1}}));
  return c;
}

// --- a slow run-up whose second order crosses the torsional resonance, 0.01 % of damping ---
HardCase through_resonance(double torque) {
  const Crank crank{.radius = 0.05, .rod = 0.2, .inertia = 0.4, .mass = 3};
  const std::string scene = fmt::format(
      "line = [\"motor\", \"shaft\", \"crank\"]\n"
      "motor = {{ kind = \"torque source\", torque = {}, inertia = \"0.3 kg*m2\" }}\n"
      "shaft = {{ kind = \"coupling\", stiffness = \"1500 N*m/rad\", damping_ratio = 1e-4 }}\n"
      "crank = {{ {} }}\neffects = {{ elasticity = true }}\n"
      "run = {{ start = {{ speed = \"35 rad/s\" }}, until = {} }}\n",
      quantity(torque, "N*m"), crank.keys(), quantity(12 / torque, "s"));
  return {.family = family,
          .name = fmt::format("RunUpWith{:.0f}NewtonmetresPassesResonance", torque),
          .parameter = fmt::format("{:g} N·m, ζ = 1e-4", torque),
          .scene = scene,
          .truths = {converged(scene, {"peak_torque.shaft", "final_speed.crank", "final_angle.motor"})}};
}

// --- I_r(φ) varies at twice the speed, 2 ω = 2 ω_n/n: the twist grows by itself ---
HardCase parametric(int zone) {
  const Crank crank{.radius = 0.08, .rod = 0.4, .inertia = 0.3, .mass = 20};
  const double mean = crank.inertia + 0.5 * crank.mass * crank.radius * crank.radius, j = 5, k = 2000;
  const double natural = std::sqrt(k * (1 / mean + 1 / j));
  const std::string scene = fmt::format(
      "line = [\"rotor\", \"shaft\", \"crank\"]\nrotor = {{ kind = \"inertia\", inertia = {} }}\n"
      "shaft = {{ kind = \"coupling\", stiffness = {}, damping_ratio = 1e-4 }}\ncrank = {{ {} }}\n"
      "effects = {{ elasticity = true }}\nrun = {{ start = {{ speed = {} }}, until = \"0.8 s\" }}\n",
      quantity(j, "kg*m2"), quantity(k, "N*m/rad"), crank.keys(), quantity(natural / zone, "rad/s"));
  return {.family = family,
          .name = fmt::format("ReducedInertiaExcitesInZone{}", zone),
          .parameter = fmt::format("ω = ω_n/{}", zone),
          .scene = scene,
          .truths = {converged(scene, {"peak_torque.shaft", "final_speed.crank"})}};
}

}  // namespace

std::vector<HardCase> resonance_cases() {
  std::vector<HardCase> cases = {at_the_natural_frequency(3, 0),
                                 at_the_natural_frequency(20, 0),
                                 at_the_natural_frequency(10, 1e-4),
                                 through_resonance(20),
                                 through_resonance(60),
                                 parametric(1),
                                 parametric(2)};
  // Methods of low order need minutes for the last digits; their budget stops them, which is no wrong answer.
  for (HardCase& c : cases) c.budget = 1.5;
  return cases;
}

}  // namespace kurbel::hard
