// backlash_cases.cpp — gaps between flanks from wide to nothing, stiff flanks, rattle, grazing contact.
#include <algorithm>

#include "tests/hard/families.h"
#include "tests/hard/machines.h"

namespace kurbel::hard {
namespace {

const std::string family = "Backlash";
constexpr double first = 1, second = 2, reduced = first * second / (first + second);

struct Gap {
  double stiffness = 1e4, damping = 0, gap = 0.01;
  std::string scene(const std::string& source, const std::string& start, double until) const {
    return fmt::format(
        "line = [\"source\", \"a\", \"k\", \"b\"]\nsource = {{ {} }}\na = {{ kind = \"inertia\", inertia = \"1 kg*m2\" "
        "}}\n"
        "b = {{ kind = \"inertia\", inertia = \"2 kg*m2\" }}\nk = {{ kind = \"coupling\", stiffness = {}, damping = "
        "{}, "
        "backlash = {} }}\neffects = {{ elasticity = true, backlash = true }}\nrun = {{ start = {}, until = {} }}\n",
        source, quantity(stiffness, "N*m/rad"), quantity(damping, "N*m*s/rad"), quantity(gap, "rad"), start,
        quantity(until, "s"));
  }
};

std::string step_of(double torque) {
  return fmt::format("kind = \"torque source\", torque = {}", quantity(torque, "N*m"));
}
std::string sine_of(double amplitude, double hertz) {
  return fmt::format("kind = \"torque source\", amplitude = {}, frequency = {}", quantity(amplitude, "N*m"),
                     quantity(hertz, "Hz"));
}

// J₁ ω₁ + J₂ ω₂ is the impulse of the source, whatever the flanks do.
Truth impulse(double of_source) {
  return residual("impulse balance J₁ ω₁ + J₂ ω₂ = ∫M dt", [of_source](const Result& r) {
    const Figure &a = *r.find("final_speed.a"), &b = *r.find("final_speed.b");
    return std::abs(first * a.value + second * b.value - of_source) / ((first + second) * a.scale);
  });
}

// How often flanks meet, against the same scene by DOP853 at local tolerances of 1e-12; found when first requested.
Truth meets_as_often(const std::string& scene, double within) {
  const auto meetings = [](const Result& r) {
    return static_cast<double>(
        std::count_if(r.events.begin(), r.events.end(), [](const Event& e) { return e.what.starts_with("on the "); }));
  };
  const auto known = std::make_shared<double>(-1);
  return residual(fmt::format("flanks meet as often as in the reference, within {:g} %", 100 * within),
                  [=](const Result& r) {
                    if (*known < 0) {
                      HardCase same;
                      same.scene = scene;
                      *known = meetings(single_run(same, "dop853", 1e-11));
                    }
                    return std::abs(meetings(r) - *known) <= within * *known ? 0.0 : HUGE_VAL;
                  });
}

// Torque step from rest in mid-gap: Δ = b/2 to close, then half a cycle of contact; peak M′ (1 + √(1 + 2 k Δ/M′)).
//     In contact u = b/2 + p, p'' = M/J₁ − ω² p, p(0) = 0, p'(0) = √(2 Δ M/J₁).
HardCase closing(int decades, int stiffness_decades) {
  const double torque = 20, b = std::pow(10.0, decades), k = std::pow(10.0, stiffness_decades);
  const double travel = b / 2, omega = std::sqrt(k / reduced), mean = torque * second / (first + second);
  const double t1 = std::sqrt(2 * travel * first / torque), speed = torque / first * t1;
  const double p0 = torque / first / (omega * omega);
  const double in_contact = 1.3 * (pi - std::atan2(speed, omega * p0)) / omega;  // beyond the peak, before they part
  const double rate = p0 * omega * std::sin(omega * in_contact) + speed * std::cos(omega * in_contact);
  const double until = t1 + in_contact, momentum = torque * until;
  const double twice = mean * (1 + std::sqrt(1 + 2 * k * travel / mean));
  const Gap gap{.stiffness = k, .gap = b};
  return {.family = family,
          .name = fmt::format("AGapOf1em{:02d}RadBeforeStiffness1e{:02d}RaisesThePeak", -decades, stiffness_decades),
          .parameter = fmt::format("b = 1e{} rad, k = 1e{} N·m/rad", decades, stiffness_decades),
          .scene = gap.scene(step_of(torque), "\"rest\"", until),
          .truths = {closed_form("peak M′ (1 + √(1 + 2 k Δ/M′)); contact as an oscillator",
                                 {{"peak_spring_torque.k", twice},
                                  {"final_speed.a", (momentum + second * rate) / (first + second)},
                                  {"final_speed.b", (momentum - first * rate) / (first + second)}})}};
}

// A gap of 1e-12 rad against no gap at all: the motion differs by its order only.
HardCase no_gap(int decades) {
  const double torque = 20, k = 1e4, omega = std::sqrt(k / reduced), until = 0.7 * 2 * pi / omega;
  const double b = decades == 0 ? 0 : std::pow(10.0, decades), rigid = torque * until / 3;
  const double swing = torque / 3 / omega * std::sin(omega * until);
  return {.family = family,
          .name = decades == 0 ? "AGapOfNothingEqualsNone" : fmt::format("AGapOf1em{}RadEqualsNone", -decades),
          .parameter = decades == 0 ? "b = 0" : fmt::format("b = 1e{} rad", decades),
          .scene = Gap{.gap = b}.scene(step_of(torque), "\"rest\"", until),
          .truths = {closed_form("two inertias without a gap", {{"peak_spring_torque.k", 2 * torque * 2 / 3},
                                                                {"final_speed.a", rigid + 2 * swing},
                                                                {"final_speed.b", rigid - swing}})}};
}

// A reversing torque over stiff flanks: contact, flight, impact on the other flank, with damping.
HardCase reversing(int gap_decades, int stiffness_decades, double until) {
  const double k = std::pow(10.0, stiffness_decades), hertz = 5, amplitude = 40;
  const Gap gap{.stiffness = k, .damping = 2 * 0.1 * std::sqrt(k * reduced), .gap = std::pow(10.0, gap_decades)};
  const std::string scene = gap.scene(sine_of(amplitude, hertz), "\"rest\"", until);
  return {.family = family,
          .name = fmt::format("ReversingTorqueOverAGapOf1em{}AndStiffness1e{}", -gap_decades, stiffness_decades),
          .parameter = fmt::format("b = 1e{} rad, k = 1e{} N·m/rad", gap_decades, stiffness_decades),
          .scene = scene,
          .truths = {converged(scene, {"final_speed.a", "final_speed.b", "rms_spring_torque.k"}),
                     impulse(amplitude * (1 - std::cos(2 * pi * hertz * until)) / (2 * pi * hertz))}};
}

// Rattle without damping. The first contacts are as the reference has them; after some more the trajectory is chance,
// and energy, impulse and how often the flanks meet (over 10 s) hold.
Gap rattling() { return {.stiffness = 1e6, .gap = 2e-3}; }
std::string rattle_scene(double until) {
  return rattling().scene(sine_of(30, 7), "{ a = { speed = \"1 rad/s\" }, b = { speed = \"0.3 rad/s\" } }", until);
}
Truth rattle_impulse(double until) {
  return impulse(first * 1 + second * 0.3 + 30 * (1 - std::cos(2 * pi * 7 * until)) / (2 * pi * 7));
}
HardCase rattle(double until) {
  return {.family = family,
          .name = fmt::format("RattleOver{:.0f}SecondsKeepsEnergyAndImpulse", until),
          .parameter = fmt::format("b = 2 mrad, undamped, {:g} s", until),
          .scene = rattle_scene(until),
          .truths = {rattle_impulse(until), meets_as_often(rattle_scene(until), 0.02)},
          .heavy = until > 1,
          .budget = 2};
}
HardCase first_contacts(double until) {
  return {.family = family,
          .name = fmt::format("RattleBeginsAsTheReferenceFor{:.0f}Milliseconds", 1e3 * until),
          .parameter = fmt::format("b = 2 mrad, undamped, {:g} s", until),
          .scene = rattle_scene(until),
          .truths = {converged(rattle_scene(until), {"final_speed.a", "final_speed.b", "peak_spring_torque.k"}),
                     rattle_impulse(until)}};
}

// In the gap under a constant torque that brakes: v² = 2 M/J₁ · b/2 · (1 + part) would take the flank to b/2 (1 +
// part).
//     Missed: a parabola. Touched: p'' = −M/J₁ − ω² p with p'(0) = √(v² − 2 (M/J₁) b/2), back out with the same speed.
HardCase grazing(double part) {
  const double torque = 10, b = 0.02, k = 1e6, a = torque / first;
  const double v = std::sqrt(2 * a * 0.5 * b * (1 + part)), omega = std::sqrt(k / reduced);
  double until = 1.5 * v / a, speed_a = v - a * until, speed_b = 0;
  if (part > 0) {
    const double inward = std::sqrt(v * v - a * b), t1 = (v - inward) / a;
    // p = −p₀ + p₀ cos ωt + (inward/ω) sin ωt, back at 0 after t₂ with ωt₂ = 2 atan(inward ω/a)
    const double contact = 2 * std::atan2(inward * omega, a) / omega, flight = 0.5 * v / a;
    until = t1 + contact + flight;
    const double relative = -inward, momentum = first * v - torque * (t1 + contact);
    speed_a = (momentum + second * relative) / (first + second) - a * flight;
    speed_b = (momentum - first * relative) / (first + second);
  }
  return {.family = family,
          .name = fmt::format("{}TheFlankBy{}", part < 0 ? "Misses" : "Grazes",
                              fmt::format("1em{:.0f}OfItsWay", -std::log10(std::abs(part)))),
          .parameter =
              fmt::format("reaches {:.0e} of the way {} the flank", std::abs(part), part < 0 ? "before" : "beyond"),
          .scene = Gap{.stiffness = k, .gap = b}.scene(
              step_of(-torque),
              fmt::format("{{ a = {{ speed = {} }}, b = {{ speed = \"0 rad/s\" }} }}", quantity(v, "rad/s")), until),
          .truths = {closed_form(part < 0 ? "v − M t/J" : "parabola, contact as an oscillator, parabola",
                                 {{"final_speed.a", speed_a}, {"final_speed.b", speed_b}})},
          .condition = part > 0 ? 1 / std::sqrt(part) : 0,
          .condition_words = "the speed at the flank is √(v² − a b): its change over that of v"};
}

}  // namespace

std::vector<HardCase> backlash_cases() {
  std::vector<HardCase> cases;
  for (const int decades : {-1, -3, -6, -9}) cases.push_back(closing(decades, 4));
  for (const int stiffness : {6, 8, 10}) cases.push_back(closing(-4, stiffness));
  for (const int decades : {0, -12, -15}) cases.push_back(no_gap(decades));
  cases.push_back(reversing(-3, 5, 0.45));
  cases.push_back(reversing(-5, 7, 0.45));
  cases.push_back(reversing(-7, 9, 0.45));
  for (const double until : {0.05, 0.1}) cases.push_back(first_contacts(until));
  for (const double until : {1, 10}) cases.push_back(rattle(until));
  for (const double part : {-1e-3, -1e-6, -1e-9, 1e-3, 1e-6, 1e-9}) cases.push_back(grazing(part));
  return cases;
}

}  // namespace kurbel::hard
