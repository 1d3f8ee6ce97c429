// extreme_cases.cpp — very light and very heavy flywheels, ratios of ten thousand, negative ratios, speeds through
// zero.
#include "tests/hard/families.h"
#include "tests/hard/machines.h"

namespace kurbel::hard {
namespace {

const std::string family = "Extremes";

// --- a constant torque on J₁, J₂ behind a spring of natural frequency ω_n, both turning at ω₀ ---
//     ω₂ = ω₀ + a (t − sin ω_n t/ω_n),  ω₁ = ω₀ + a (t + J₂/J₁ sin ω_n t/ω_n),  a = M/(J₁ + J₂)
HardCase flywheel(double ratio) {
  const double j1 = 0.5, j2 = ratio * j1, natural = 200, torque = 30, start = 5, until = 0.5;
  const double k = natural * natural / (1 / j1 + 1 / j2), a = torque / (j1 + j2);
  const double sine = std::sin(natural * until) / natural;
  return {
      .family = family,
      .name = fmt::format("FlywheelOf1e{:.0f}TimesTheMotor", std::log10(ratio)),
      .parameter = fmt::format("J₂/J₁ = {:g}", ratio),
      .scene = fmt::format(
          "line = [\"motor\", \"shaft\", \"wheel\"]\nmotor = {{ kind = \"torque source\", torque = {}, inertia = {} "
          "}}\nshaft = {{ kind = \"coupling\", stiffness = {} }}\nwheel = {{ kind = \"flywheel\", inertia = {} }}\n"
          "effects = {{ elasticity = true }}\nrun = {{ start = {{ speed = {} }}, until = {} }}\n",
          quantity(torque, "N*m"), quantity(j1, "kg*m2"), quantity(k, "N*m/rad"), quantity(j2, "kg*m2"),
          quantity(start, "rad/s"), quantity(until, "s")),
      .truths = {
          closed_form("ω₀ + a (t ± … sin ω_n t/ω_n)", {{"final_speed.wheel", start + a * (until - sine)},
                                                       {"final_speed.motor", start + a * (until + ratio * sine)},
                                                       {"peak_spring_torque.shaft", 2 * torque * j2 / (j1 + j2)}})}};
}

// --- gears between, rigid behind a spring on the fast side ---
//     J₂′ = J₂/i², ω₂ = a (t − sin ω_n t/ω_n)/i
HardCase gears(int driving, int driven, double j2) {
  const double i = static_cast<double>(driven) / driving, j1 = 0.02, reduced = j2 / (i * i), natural = 150;
  const double k = natural * natural / (1 / j1 + 1 / reduced), torque = 3 * (j1 + reduced), until = 0.5, a = 3;
  const double sine = std::sin(natural * until) / natural;
  return {
      .family = family,
      .name = fmt::format("GearOf{}To{}", driving, driven),
      .parameter = fmt::format("i = {:g}", i),
      .scene = fmt::format(
          "line = [\"motor\", \"shaft\", \"gear\", \"drum\"]\nmotor = {{ kind = \"torque source\", torque = {}, "
          "inertia "
          "= {} }}\nshaft = {{ kind = \"coupling\", stiffness = {} }}\ngear = {{ kind = \"gearbox\", stages = [{{ "
          "teeth "
          "= [{}, {}] }}] }}\ndrum = {{ kind = \"inertia\", inertia = {} }}\neffects = {{ elasticity = true }}\nrun = "
          "{{ until = {} }}\n",
          quantity(torque, "N*m"), quantity(j1, "kg*m2"), quantity(k, "N*m/rad"), driving, driven,
          quantity(j2, "kg*m2"), quantity(until, "s")),
      .truths = {closed_form("a (t − sin ω_n t/ω_n)/i",
                             {{"final_speed.drum", a * (until - sine) / i},
                              {"final_speed.motor", a * (until + reduced / j1 * sine)},
                              {"peak_spring_torque.shaft", 2 * torque * reduced / (j1 + reduced)}})}};
}

// A planetary gear with its carrier held turns its ring backwards: i = −z_r/z_s.
HardCase negative_ratio() {
  const double i = -72.0 / 24, j1 = 0.02, j2 = 0.9, torque = 5, until = 0.5;
  const double a = torque / (j1 + j2 / (i * i));
  return {
      .family = family,
      .name = "NegativeRatio",
      .parameter = "i = −3",
      .scene = fmt::format(
          "line = [\"motor\", \"gear\", \"drum\"]\nmotor = {{ kind = \"torque source\", torque = {}, inertia = {} }}\n"
          "gear = {{ kind = \"planetary gear\", sun = 24, ring = 72, in = \"sun\", out = \"ring\", fixed = \"carrier\" "
          "}}\ndrum = {{ kind = \"inertia\", inertia = {} }}\nrun = {{ until = {} }}\n",
          quantity(torque, "N*m"), quantity(j1, "kg*m2"), quantity(j2, "kg*m2"), quantity(until, "s")),
      .truths = {closed_form("ω₂ = ω₁/i", {{"final_speed.motor", a * until},
                                           {"final_speed.drum", a * until / i},
                                           {"final_angle.drum", 0.5 * a * until * until / i}})}};
}

// Backwards against friction and drive, through zero, forwards: (M + M_f)/J until then, (M − M_f)/J after.
HardCase through_zero(double friction) {
  const double inertia = 0.4, drive = 10, speed = -20, until = 3;
  const double turn = -speed * inertia / (drive + friction), after = until - turn;
  const double a = friction < drive ? (drive - friction) / inertia : 0;
  return {
      .family = family,
      .name = fmt::format("ThroughZeroAgainst{:.0f}MillinewtonmetresOfFriction", friction * 1e3),
      .parameter = fmt::format("M_f = {:g} M", friction / drive),
      .scene = fmt::format(
          "line = [\"disc\"]\ndisc = {{ kind = \"inertia\", inertia = {} }}\ndrive = {{ on = \"disc\", kind = \"torque "
          "source\", torque = {} }}\nfriction = {{ on = \"disc\", kind = \"load\", torque = {} }}\nrun = {{ start = {{ "
          "speed = {} }}, until = {} }}\n",
          quantity(inertia, "kg*m2"), quantity(drive, "N*m"), quantity(friction, "N*m"), quantity(speed, "rad/s"),
          quantity(until, "s")),
      .truths = {closed_form("(M ± M_f)/J", {{"final_speed.disc", a * after},
                                             {"final_angle.disc", 0.5 * speed * turn + 0.5 * a * after * after}})}};
}

// ω = ω₀ − (ω₀ − ω_s) e^(−t/T), T = J ω₀/M_stall, from twice the no-load speed backwards.
HardCase started_backwards() {
  const double inertia = 0.3, stall = 40, no_load = 150, speed = -300, until = 4;
  const double time = inertia * no_load / stall;
  const double end = no_load - (no_load - speed) * std::exp(-until / time);
  return {.family = family,
          .name = "ShuntMotorStartedBackwards",
          .parameter = "from −2 ω₀",
          .scene = fmt::format("line = [\"motor\"]\nmotor = {{ kind = \"dc shunt motor\", stall_torque = {}, "
                               "no_load_speed = {}, inertia = {} "
                               "}}\nrun = {{ start = {{ speed = {} }}, until = {} }}\n",
                               quantity(stall, "N*m"), quantity(no_load, "rad/s"), quantity(inertia, "kg*m2"),
                               quantity(speed, "rad/s"), quantity(until, "s")),
          .truths = {closed_form(
              "ω = ω₀ − (ω₀ − ω_s) e^(−t/T)",
              {{"final_speed.motor", end},
               {"final_angle.motor", no_load * until - (no_load - speed) * time * (1 - std::exp(-until / time))}})}};
}

// A crank started backwards turns through its dead centres as the mirrored one does forwards.
HardCase crank_backwards() {
  const std::string scene = fmt::format(
      "line = [\"crank\"]\ncrank = {{ {} }}\nrun = {{ start = {{ speed = \"-25 rad/s\", angle = \"30 deg\" }}, until = "
      "\"2 "
      "s\" }}\n",
      Crank{.offset = 0.02}.keys());
  return {.family = family,
          .name = "CrankStartedBackwards",
          .parameter = "offset slider, −25 rad/s",
          .scene = scene,
          .truths = {converged(scene, {"final_speed.crank", "final_angle.crank"})}};
}

}  // namespace

std::vector<HardCase> extreme_cases() {
  std::vector<HardCase> cases;
  for (const double ratio : {1e-9, 1e-3, 1e3, 1e9}) cases.push_back(flywheel(ratio));
  cases.push_back(gears(10, 100000, 5e5));
  cases.push_back(gears(100000, 10, 1e-9));
  cases.push_back(negative_ratio());
  for (const double friction : {0.0, 4.0, 9.999, 10.0, 15.0}) cases.push_back(through_zero(friction));
  cases.push_back(started_backwards());
  cases.push_back(crank_backwards());
  for (HardCase& c : cases) c.budget = 2;
  return cases;
}

}  // namespace kurbel::hard
