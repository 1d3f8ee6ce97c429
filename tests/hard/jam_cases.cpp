// jam_cases.cpp — machines that cannot go on: they end at rest and held, or are thrown back and held.
#include "tests/hard/families.h"
#include "tests/hard/machines.h"

namespace kurbel::hard {
namespace {

const std::string family = "Jams";

// A press whose force stands without an edge's rise from d before the extended end on.
struct Press {
  Crank crank;
  double force = 4000, travel = 0.03, start = 3.4;  // [N], [m], [rad]

  double extended() const { return crank.radius + crank.rod; }
  double edge() const {  // the angle at which the slider meets the work
    return static_cast<double>(
        bisect([&](Crank::Real phi) { return crank.position(phi) - (extended() - travel); }, pi, 2 * pi));
  }
  std::string keys(const std::string& more = "") const {
    return fmt::format("{}, load = {{ kind = \"press\", nominal_force = {}, nominal_travel = {} }}{}", crank.keys(),
                       quantity(force, "N"), quantity(travel, "m"), more);
  }
};

// A crank under a constant torque runs into the work and stops where its energy is spent:
//     ½ I_r(φ₀) ω₀² + M (φ − φ₀) = F (x − x_edge)
HardCase stops_in_the_work(double torque, double speed) {
  const Press press;
  using Real = long double;
  const Real kinetic = 0.5L * press.crank.reduced_inertia(press.start) * speed * speed, edge = press.edge();
  const Real stop = bisect(
      [&](Real phi) {
        return kinetic + torque * (phi - press.start) -
               press.force * (press.crank.position(phi) - (press.extended() - press.travel));
      },
      edge, 2 * pi - 0.05);
  return {.family = family,
          .name = fmt::format("ACrankUnder{:.0f}NmRunsIntoTheWorkAndIsHeld", torque),
          .parameter = fmt::format("M = {:g} N·m, held by F |x′|", torque),
          .scene = fmt::format(
              "line = [\"source\", \"crank\"]\nsource = {{ kind = \"torque source\", torque = {} }}\ncrank = {{ {} "
              "}}\nrun = {{ start = {{ angle = {}, speed = {} }}, until = \"3 s\" }}\n",
              quantity(torque, "N*m"), press.keys(), quantity(press.start, "rad"), quantity(speed, "rad/s")),
          .truths = {closed_form("½ I_r ω₀² + M Δφ = F Δx",
                                 {{"final_angle.crank", static_cast<double>(stop)}, {"final_speed.crank", 0}})}};
}

struct Motor {
  std::string name, keys;
  double stall;  // torque at standstill [N·m]
};
std::vector<Motor> motors() {
  const double rated = 100 / (0.94 * 2 * pi), sb = 0.06 * (3 + std::sqrt(8.0));
  const std::string cage = fmt::format(
      "kind = \"induction motor\", rated_power = \"100 W\", rated_speed = {}, synchronous_speed = {}, "
      "breakdown_ratio = 3, inertia = \"0.1 kg*m2\"",
      quantity(0.94 * 2 * pi, "rad/s"), quantity(2 * pi, "rad/s"));
  return {
      {"Kloss", cage, 2 * 3 * rated * sb / (1 + sb * sb)},
      {"CataloguePoints",
       cage + ", starting_ratio = 2.2, pull_up_ratio = 1.8, pull_up_speed = " + quantity(0.25 * 2 * pi, "rad/s"),
       2.2 * rated},
      {"DcShunt",
       "kind = \"dc shunt motor\", stall_torque = \"40 N*m\", no_load_speed = \"6 rad/s\", inertia = \"0.1 kg*m2\"",
       40},
      {"DcShuntWithInductance",
       "kind = \"dc shunt motor\", voltage = \"12 V\", resistance = \"0.6 Ohm\", constant = \"2 N*m/A\", inductance = "
       "\"6 mH\", inertia = \"0.1 kg*m2\"",
       40},
      {"DcSeries",
       "kind = \"dc series motor\", voltage = \"10 V\", resistance = \"0.5 Ohm\", constant = \"0.1 N*m/A2\", "
       "inertia = \"0.1 kg*m2\"",
       40},
      {"ByTable",
       "kind = \"motor\", torque = { over = \"speed\", unit = [\"rad/s\", \"N*m\"], points = [[-6, 40], [0, 40], [4, "
       "45], [6, 0], [8, -40]] }, inertia = \"0.1 kg*m2\"",
       40},
  };
}

const std::string joints =
    ", main_bearing = { radius = \"20 mm\", friction = 0.05, static_friction = 0.1 }, guide = { friction = 0.1, "
    "static_friction = 0.15 }";

// The motor pushes on while the press holds. Rigid: at rest. Elastic: thrown back and on until the coupling carries
// just the motor's torque at standstill, k θ = M₀.
HardCase stalls(const Motor& motor, bool elastic, bool friction) {
  const Press press;
  const double stiffness = 900;
  const std::string scene = fmt::format(
      "line = [\"motor\", \"coupling\", \"crank\"]\nmotor = {{ {} }}\ncoupling = {{ kind = \"coupling\", stiffness = "
      "{}, damping_ratio = 0.3 }}\ncrank = {{ {} }}\neffects = {{ elasticity = {}, joint_friction = {} }}\nrun = {{ "
      "start = {{ angle = {} }}, until = \"{} s\" }}\n",
      motor.keys, quantity(stiffness, "N*m/rad"), press.keys(joints), elastic, friction, quantity(press.start, "rad"),
      elastic ? 4 : 3);  // after 3 s the motor still rings by 1e-7 of its torque
  std::vector<Truth> truths;
  if (elastic) {
    truths.push_back(
        residual("at rest the coupling carries the motor's torque at standstill, k θ = M₀", [=](const Result& r) {
          const double twist = r.find("final_angle.motor")->value - r.find("final_angle.crank")->value;
          return std::abs(twist * stiffness / motor.stall - 1) + std::abs(r.find("final_speed.crank")->value);
        }));
  } else {
    truths.push_back(converged(scene, {"final_angle.crank", "final_speed.crank"}));
  }
  return {.family = family,
          .name = fmt::format("{}{}{}StallsInThePress", motor.name, elastic ? "Elastic" : "Rigid",
                              friction ? "WithFriction" : ""),
          .parameter = fmt::format("{:.3g} N·m at standstill, {:g} kN", motor.stall, 1e-3 * press.force),
          .scene = scene,
          .truths = truths,
          .heavy = elastic || friction};
}

// A screw whose lead angle is above its friction angle by next to nothing: left alone, its load runs it down, ever so
// slowly, and never sticks; below by as little it stays.
//     (J + m k r t) α = m g r t,   t = tan(γ − ρ′), r = d₂/2
HardCase runs_down_a_screw(double above) {
  const double lead = 0.01, radius = 0.02, mass = 2000, inertia = 0.05, gravity = 9.80665, time = 1;
  const double angle = std::atan(lead / (2 * pi * radius));
  const double friction = std::tan(angle - above);
  const double t = std::tan(angle - std::atan(friction)), k = lead / (2 * pi);
  const double acceleration = above > 0 ? mass * gravity * radius * t / (inertia + mass * k * radius * t) : 0;
  const std::string scene = fmt::format(
      "line = [\"wheel\", \"screw\"]\nwheel = {{ kind = \"inertia\", inertia = {} }}\nscrew = {{ kind = \"screw\", "
      "lead "
      "= {}, mean_diameter = {}, thread_angle = \"0 deg\", friction_coefficient = {:.17g}, mass = {}, inclination = "
      "\"-90 deg\" }}\nrun = {{ until = \"{} s\" }}\n",
      quantity(inertia, "kg*m2"), quantity(lead, "m"), quantity(2 * radius, "m"), friction, quantity(mass, "kg"), time);
  // t is a small difference of angles: what rounding of the friction changes it by.
  return {.family = family,
          .name = above > 0 ? "AScrewBarelyAboveItsFrictionAngleRunsDown" : "AScrewBarelyBelowItsFrictionAngleStays",
          .parameter = fmt::format("γ − ρ′ = {:g} rad", above),
          .scene = scene,
          .truths = {closed_form(
              "α = m g r tan(γ − ρ′)/(J + m k r tan(γ − ρ′))",
              above > 0 ? std::vector<Known>{by_its_size("final_speed.wheel", acceleration * time),
                                             by_its_size("final_angle.wheel", 0.5 * acceleration * time * time)}
                        : std::vector<Known>{{"final_speed.wheel", 0, 1}, {"final_angle.wheel", 0, 1}})},
          .energy = above > 0,
          .condition = std::abs(friction / above),
          .condition_words = "tan(γ − ρ′) by μ"};
}

}  // namespace

std::vector<HardCase> jam_cases() {
  std::vector<HardCase> cases;
  for (const auto& [torque, speed] : std::vector<std::pair<double, double>>{{0, 18}, {20, 10}, {40, 0}})
    cases.push_back(stops_in_the_work(torque, speed));
  for (const Motor& motor : motors())
    for (const bool elastic : {false, true})
      for (const bool friction : {false, true}) cases.push_back(stalls(motor, elastic, friction));
  for (const double above : {1e-6, -1e-6}) cases.push_back(runs_down_a_screw(above));
  return cases;
}

}  // namespace kurbel::hard
