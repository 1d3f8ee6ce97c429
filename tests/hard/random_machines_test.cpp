// random_machines_test.cpp — what holds for every machine: energy, symmetry, scaling, over thousands of random drives.
//
// Seeds are fixed. A machine that fails is shrunk: parts are taken away as long as it still fails, and the scene that
// is left is printed.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>

#include "engine/eigen_modes.h"
#include "engine/linearise.h"
#include "engine/run.h"
#include "tests/support/scenes.h"

namespace kurbel {
namespace {

// --- machines --------------------------------------------------------------------------------------------------------

struct Joint {
  enum class Kind { coupling, gap, clutch, one_way, gear };
  Kind kind = Kind::coupling;
  double a = 0, b = 0;  // stiffness and damping ratio; torque and static excess; ratio
};
struct Part {  // on a shaft
  enum class Kind { motor, dry, drag, fan, shaking, brake };
  Kind kind = Kind::motor;
  int shaft = 0;
  double a = 0, b = 0;
};
struct Machine {
  std::vector<double> inertia;
  std::vector<Joint> joints;  // between neighbours
  std::vector<Part> parts;
  double start = 0;
  bool conservative = false;
};

class Dice {
 public:
  explicit Dice(unsigned seed) : random_(seed) {}
  double uniform(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random_); }
  double over_decades(double low, double high) { return std::exp(uniform(std::log(low), std::log(high))); }
  int number(int low, int high) { return std::uniform_int_distribution<int>(low, high)(random_); }
  std::mt19937& engine() { return random_; }

 private:
  std::mt19937 random_;
};

Machine some_machine(unsigned seed, bool conservative) {
  Dice dice(seed);
  Machine m;
  m.conservative = conservative;
  const int shafts = dice.number(2, 6);
  for (int i = 0; i < shafts; ++i) m.inertia.push_back(dice.over_decades(0.01, 10));
  for (int i = 1; i < shafts; ++i) {
    Joint j;
    j.kind = static_cast<Joint::Kind>(conservative ? (dice.number(0, 3) == 0 ? 4 : 0) : dice.number(0, 4));
    switch (j.kind) {
      case Joint::Kind::coupling:
      case Joint::Kind::gap:
        j.a = dice.over_decades(1e2, 1e5);
        j.b = conservative ? 0 : dice.over_decades(0.005, 0.2);
        break;
      case Joint::Kind::clutch:
        j.a = dice.over_decades(5, 200);
        j.b = dice.uniform(1, 1.5);
        break;
      case Joint::Kind::one_way:
        break;
      case Joint::Kind::gear:
        j.a = dice.number(10, 60);
        j.b = dice.number(10, 60);
        break;
    }
    m.joints.push_back(j);
  }
  m.start = dice.uniform(5, 60);
  if (conservative) return m;
  m.parts.push_back({Part::Kind::motor, 0, dice.over_decades(20, 400), dice.uniform(60, 160)});
  const int more = dice.number(1, 4);
  for (int i = 0; i < more; ++i) {
    Part p{static_cast<Part::Kind>(dice.number(1, 5)), dice.number(0, shafts - 1), dice.over_decades(1, 60),
           dice.uniform(1, 12)};
    m.parts.push_back(p);
  }
  return m;
}

// Tables in an order of their own, so that a file can be shuffled.
std::vector<std::string> tables_of(const Machine& m, double scale = 1, bool split = false) {
  std::vector<std::string> tables;
  for (std::size_t i = 0; i < m.inertia.size(); ++i) {
    const double own = scale * m.inertia[i] * (split && i == 0 ? 0.25 : 1);
    tables.push_back(fmt::format("s{} = {{ kind = \"inertia\", inertia = \"{:.17g} kg*m2\" }}\n", i, own));
  }
  if (split)
    tables.push_back(
        fmt::format("rest = {{ kind = \"inertia\", inertia = \"{:.17g} kg*m2\" }}\n", scale * 0.75 * m.inertia[0]));
  for (std::size_t i = 0; i < m.joints.size(); ++i) {
    const Joint& j = m.joints[i];
    std::string text;
    switch (j.kind) {
      case Joint::Kind::coupling:
        text = fmt::format("kind = \"coupling\", stiffness = \"{:.17g} N*m/rad\", damping_ratio = {:.17g}", scale * j.a,
                           j.b);
        break;
      case Joint::Kind::gap:
        text = fmt::format(
            "kind = \"coupling\", stiffness = \"{:.17g} N*m/rad\", damping_ratio = {:.17g}, backlash = \"0.5 deg\"",
            scale * j.a, j.b);
        break;
      case Joint::Kind::clutch:
        text = fmt::format("kind = \"clutch\", torque = \"{:.17g} N*m\", static_torque = \"{:.17g} N*m\"", scale * j.a,
                           scale * j.a * j.b);
        break;
      case Joint::Kind::one_way:
        text = "kind = \"one-way clutch\"";
        break;
      case Joint::Kind::gear:
        text = fmt::format("kind = \"gearbox\", stages = [{{ teeth = [{:.0f}, {:.0f}] }}]", j.a, j.b);
        break;
    }
    tables.push_back(fmt::format("j{} = {{ {} }}\n", i, text));
  }
  for (std::size_t i = 0; i < m.parts.size(); ++i) {
    const Part& p = m.parts[i];
    std::string text;
    switch (p.kind) {
      case Part::Kind::motor:
        text = fmt::format(
            "kind = \"dc shunt motor\", stall_torque = \"{:.17g} N*m\", no_load_speed = \"{:.17g} rad/s\", "
            "inertia = \"0 kg*m2\"",
            scale * p.a, p.b);
        break;
      case Part::Kind::dry:
        text = fmt::format("kind = \"load\", torque = \"{:.17g} N*m\"", scale * p.a);
        break;
      case Part::Kind::drag:
        text = fmt::format("kind = \"bearing drag\", damping = \"{:.17g} N*m*s/rad\"", scale * 0.01 * p.a);
        break;
      case Part::Kind::fan:
        text = fmt::format("kind = \"load\", quadratic = \"{:.17g} N*m*s2/rad2\"", scale * 1e-4 * p.a);
        break;
      case Part::Kind::shaking:
        text = fmt::format("kind = \"torque source\", amplitude = \"{:.17g} N*m\", frequency = \"{:.17g} Hz\"",
                           scale * p.a, p.b);
        break;
      case Part::Kind::brake:
        text = fmt::format("kind = \"brake\", torque = \"{:.17g} N*m\", start = \"0.2 s\"", scale * p.a);
        break;
    }
    tables.push_back(fmt::format("p{} = {{ on = \"s{}\", {} }}\n", i, p.shaft, text));
  }
  return tables;
}

std::string text_of(const Machine& m, const std::vector<std::string>& tables, bool split = false) {
  std::string line = "line = [\"s0\"";
  if (split) line += ", \"rest\"";
  for (std::size_t i = 0; i < m.joints.size(); ++i) line += fmt::format(", \"j{}\", \"s{}\"", i, i + 1);
  std::string text = line + "]\n";
  for (const std::string& table : tables) text += table;
  return text + fmt::format(
                    "effects = {{ elasticity = true }}\nrun = {{ until = \"0.4 s\", start = {{ speed = \"{:.17g} "
                    "rad/s\" }} }}\n",
                    m.start);
}
std::string text_of(const Machine& m) { return text_of(m, tables_of(m)); }

struct Ran {
  RunOutcome outcome;
  std::vector<double> angle, speed;  // of the nodes s0, s1, …
};
Ran run_of(const std::string& text, double tolerance = 1e-9) {
  const Scene scene = test::scene_from(text);
  const auto model = compile(scene, scene.effects);
  Equations equations(model, false);
  Ran ran;
  ran.outcome = integrate(equations, {.tolerance = tolerance, .until = scene.run.until, .progress = {}}, {});
  if (!ran.outcome.complete) return ran;
  const Snapshot& s = equations.snapshot(ran.outcome.t, ran.outcome.state);
  for (int i = 0; model->network.ports.count(fmt::format("s{}", i)); ++i) {
    const int node = model->network.ports.at(fmt::format("s{}", i)).in;
    ran.angle.push_back(s.node_angle[node]);
    ran.speed.push_back(model->gain_of_node[static_cast<std::size_t>(node)] *
                        s.now.speed[model->shaft_of_node[static_cast<std::size_t>(node)]]);
  }
  return ran;
}

// --- shrinking -------------------------------------------------------------------------------------------------------

using Fault = std::function<std::string(const Machine&)>;  // what is wrong; empty: nothing

Machine without_part(const Machine& m, std::size_t i) {
  Machine less = m;
  less.parts.erase(less.parts.begin() + static_cast<std::ptrdiff_t>(i));
  return less;
}
Machine without_last_shaft(const Machine& m) {
  Machine less = m;
  less.inertia.pop_back();
  less.joints.pop_back();
  const int last = static_cast<int>(less.inertia.size()) - 1;
  for (Part& p : less.parts) p.shaft = std::min(p.shaft, last);
  return less;
}

void expect_for_all(unsigned first, int count, bool conservative, const Fault& fault) {
  for (int k = 0; k < count; ++k) {
    Machine m = some_machine(first + static_cast<unsigned>(k), conservative);
    std::string wrong = fault(m);
    if (wrong.empty()) continue;
    for (bool smaller = true; smaller;) {
      smaller = false;
      std::vector<Machine> candidates;
      if (m.inertia.size() > 2) candidates.push_back(without_last_shaft(m));
      for (std::size_t i = 0; i < m.parts.size(); ++i) candidates.push_back(without_part(m, i));
      for (const Machine& less : candidates)
        if (const std::string still = fault(less); !still.empty()) {
          m = less;
          wrong = still;
          smaller = true;
          break;
        }
    }
    ADD_FAILURE() << "seed " << first + static_cast<unsigned>(k) << ": " << wrong << "\n" << text_of(m);
    return;
  }
}

// --- what holds ------------------------------------------------------------------------------------------------------

TEST(RandomMachines, EnergyBalanceHolds) {
  expect_for_all(1000, 250, false, [](const Machine& m) -> std::string {
    const Result r = test::run(test::scene_from(text_of(m)), false);
    if (!r.complete) return r.diagnosis;
    return r.energy.relative < 1e-5 ? ""  // ten times the accuracy asked for
                                     : fmt::format("energy balance off by {:.2g}", r.energy.relative);
  });
}

// The order in which a file names its components means nothing, to the last bit.
TEST(RandomMachines, OrderInTheFileMeansNothing) {
  expect_for_all(2000, 120, false, [](const Machine& m) -> std::string {
    std::vector<std::string> tables = tables_of(m);
    const Ran one = run_of(text_of(m, tables), 1e-7);
    std::shuffle(tables.begin(), tables.end(), std::mt19937(7));
    const Ran other = run_of(text_of(m, tables), 1e-7);
    return one.outcome.state == other.outcome.state ? "" : "another order, another result";
  });
}

// A rigid shaft may be cut in two.
TEST(RandomMachines, SplittingARigidShaftChangesNothing) {
  expect_for_all(3000, 120, false, [](const Machine& m) -> std::string {
    const Ran one = run_of(text_of(m)), other = run_of(text_of(m, tables_of(m, 1, true), true));
    if (one.outcome.complete != other.outcome.complete) return one.outcome.diagnosis + other.outcome.diagnosis;
    for (std::size_t i = 0; i < one.angle.size(); ++i)
      if (std::abs(one.angle[i] - other.angle[i]) > 1e-6 * std::max(1.0, std::abs(one.angle[i])))
        return fmt::format("angle of s{}: {} and {}", i, one.angle[i], other.angle[i]);
    return "";
  });
}

// Inertias, stiffnesses and torques times one factor: the motion is the same (ω² = k/J, α = M/J).
TEST(RandomMachines, ScalingForcesAndMassesLeavesTheMotion) {
  expect_for_all(4000, 120, false, [](const Machine& m) -> std::string {
    const Ran one = run_of(text_of(m)), other = run_of(text_of(m, tables_of(m, 4096)));
    for (std::size_t i = 0; i < one.angle.size(); ++i)
      if (std::abs(one.angle[i] - other.angle[i]) > 1e-6 * std::max(1.0, std::abs(one.angle[i])))
        return fmt::format("angle of s{}: {} and {}", i, one.angle[i], other.angle[i]);
    return "";
  });
}

// Springs alone: with all speeds turned round the machine runs back to where it came from.
TEST(RandomMachines, AConservativeMachineRunsBackwards) {
  expect_for_all(5000, 120, true, [](const Machine& m) -> std::string {
    const Scene scene = test::scene_from(text_of(m));
    const auto model = compile(scene, scene.effects);
    Equations equations(model, false);
    std::vector<double> y = equations.start(0);
    // Something must swing.
    for (std::size_t s = 0; s < model->free_shafts; ++s)
      y[equations.speed_index(static_cast<int>(s))] *= 1 + 0.3 * static_cast<double>(s % 3);
    const std::vector<double> begin = y;
    for (int way = 0; way < 2; ++way) {
      const RunOutcome out =
          integrate(equations, {.tolerance = 1e-11, .until = 0.3, .progress = {}, .from = RunStart{0, y}}, {});
      if (!out.complete) return out.diagnosis;
      y = out.state;
      for (std::size_t s = 0; s < model->free_shafts; ++s) y[equations.speed_index(static_cast<int>(s))] *= -1;
    }
    for (std::size_t s = 0; s < model->free_shafts; ++s) {
      const std::size_t i = equations.speed_index(static_cast<int>(s));
      if (std::abs(y[i] - begin[i]) > 1e-6 * model->shafts[s].speed_scale)
        return fmt::format("{} after there and back: {} instead of {}", equations.state_name(i), y[i], begin[i]);
    }
    return "";
  });
}

// All stiffnesses times s: every natural frequency times √s.
TEST(RandomMachines, StiffnessShiftsModesByItsRoot) {
  expect_for_all(6000, 120, true, [](const Machine& m) -> std::string {
    const auto frequencies = [](const Machine& machine) {
      const Scene scene = test::scene_from(text_of(machine));
      const auto model = compile(scene, scene.effects);
      if (model->elastic.empty()) return std::vector<double>{};
      const UndampedModes modes = undamped_modes(linearise(model, {}));
      return std::vector<double>(modes.omega.data(), modes.omega.data() + modes.omega.size());
    };
    Machine stiff = m;
    for (Joint& j : stiff.joints)
      if (j.kind == Joint::Kind::coupling) j.a *= 9;
    const std::vector<double> one = frequencies(m), other = frequencies(stiff);
    if (one.size() != other.size()) return "another number of modes";
    const double greatest = one.empty() ? 0 : *std::max_element(one.begin(), one.end());
    for (std::size_t k = 0; k < one.size(); ++k)
      if (std::abs(other[k] - 3 * one[k]) > 1e-7 * greatest)
        return fmt::format("mode {}: {} and {}", k, one[k], other[k]);
    return "";
  });
}

}  // namespace
}  // namespace kurbel
