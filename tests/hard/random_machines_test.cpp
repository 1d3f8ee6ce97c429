// random_machines_test.cpp — what holds for every machine: energy, symmetry, scaling, over thousands of random drives.
//
// Seeds are fixed. A machine that fails is shrunk: parts are taken away as long as it still fails, and the scene that
// is left is printed.
#include "engine/linear/eigen_modes.h"
#include "engine/linear/linearise.h"
#include "engine/run/run.h"
#include "tests/hard/random_machine.h"
#include "tests/support/scenes.h"

namespace kurbel::random_machines_test {
namespace {

using namespace test;  // NOLINT: the machines' names

struct Ran {
  RunOutcome outcome;
  std::vector<double> angle, speed;  // of the nodes s0, s1, …
};
Ran run_of(const std::string& text, double tolerance = 1e-9) {
  const Scene scene = scene_from(text);
  const auto model = compile(scene, scene.effects);
  Equations equations(model, false);
  Ran ran;
  ran.outcome = integrate(equations, {.tolerance = tolerance, .until = scene.run.until, .progress = {}}, {});
  if (ran.outcome.state.empty()) return ran;
  const Snapshot& s = equations.snapshot(ran.outcome.t, ran.outcome.state);
  for (int i = 0; model->network.ports.count(fmt::format("s{}", i)); ++i) {
    const int node = model->network.ports.at(fmt::format("s{}", i)).in;
    ran.angle.push_back(s.node_angle[node]);
    ran.speed.push_back(model->gain_of_node[static_cast<std::size_t>(node)] *
                        s.now.speed[model->shaft_of_node[static_cast<std::size_t>(node)]]);
  }
  return ran;
}

// The largest difference of the angles, in rad and of themselves.
double difference(const Ran& a, const Ran& b) {
  double largest = 0;
  for (std::size_t i = 0; i < a.angle.size(); ++i) {
    const double here = std::abs(a.angle[i] - b.angle[i]) / std::max(1.0, std::abs(a.angle[i]));
    if (!(here <= largest)) largest = here;
    if (std::isnan(largest)) return largest;
  }
  return largest;
}

// What a relative change of all speeds at the start becomes by the end: rattle and grazing multiply it.
double condition(const Machine& m) {
  constexpr double small = 1e-10;
  Machine other = m;
  if (other.start == 0) return 1;
  other.start *= 1 + small;
  return std::max(1.0, difference(run_of(text_of(m)), run_of(text_of(other))) / small);
}

// Two runs of one machine that may differ by rounding alone.
std::string differ(const Machine& m, const Ran& one, const Ran& other) {
  if (!one.outcome.complete || !other.outcome.complete) return one.outcome.diagnosis + other.outcome.diagnosis;
  const double found = difference(one, other);
  if (found <= 1e-9) return "";
  const double allowed = 1e-12 * condition(m);
  return found <= allowed ? "" : fmt::format("angles differ by {:.2g}; {:.2g} allowed", found, allowed);
}

// --- what holds ------------------------------------------------------------------------------------------------------

// What was put in is what moves, what is stored and what was taken out; and friction never drives.
TEST(RandomMachines, EnergyBalanceHolds) {
  expect_for_all(1000, 600, false, [](const Machine& m) -> std::string {
    const Result r = run(scene_from(text_of(m)), false);
    if (!r.complete) return r.diagnosis;
    for (const Figure& f : r.figures)
      if (!std::isfinite(f.value)) return f.name + " is not finite";
    double turnover = std::max(std::abs(r.energy.kinetic_end), std::abs(r.energy.kinetic_start));
    for (const auto& [line, work] : r.energy.by_line) turnover = std::max(turnover, std::abs(work));
    if (r.energy.by_line.count("harmful") && r.energy.by_line.at("harmful") > 1e-6 * turnover)
      return fmt::format("friction put {:.2g} J in, of {:.2g} J", r.energy.by_line.at("harmful"), turnover);
    return r.energy.relative < 1e-5 ? ""  // ten times the requested accuracy
                                    : fmt::format("energy balance off by {:.2g}", r.energy.relative);
  });
}

// The order in which a file names its components means nothing, to the last bit.
TEST(RandomMachines, OrderInTheFileMeansNothing) {
  expect_for_all(2000, 250, false, [](const Machine& m) -> std::string {
    std::vector<std::string> tables = tables_of(m);
    const Ran one = run_of(text_of(m, tables), 1e-6);
    std::shuffle(tables.begin(), tables.end(), std::mt19937(7));
    const Ran other = run_of(text_of(m, tables), 1e-6);
    if (one.outcome.state != other.outcome.state) return "another order, another result";
    if (one.outcome.events.size() != other.outcome.events.size()) return "another order, other events";
    for (std::size_t i = 0; i < one.outcome.events.size(); ++i)
      if (one.outcome.events[i].t != other.outcome.events[i].t ||
          one.outcome.events[i].component != other.outcome.events[i].component)
        return "another order, other events";
    return "";
  });
}

// Any rigid shaft may be cut in two.
TEST(RandomMachines, SplittingARigidShaftChangesNothing) {
  expect_for_all(3000, 250, false, [](const Machine& m) -> std::string {
    const Ran one = run_of(text_of(m));
    const int shaft = static_cast<int>(m.parts.size() % m.inertia.size());
    return differ(m, one, run_of(text_of(m, tables_of(m, {}, shaft), {}, shaft)));
  });
}

// In units of 4096 kg and 1/4 s the same machine turns by the same angles: nothing in the program knows the kilogram,
// the second, or a number that has a unit.
TEST(RandomMachines, UnitsOfMassAndTimeMeanNothing) {
  expect_for_all(4000, 250, false, [](const Machine& m) -> std::string {
    const Units units{4096, 0.25};
    return differ(m, run_of(text_of(m)), run_of(text_of(m, tables_of(m, units), units)));
  });
}

// Springs, gears and cranks without friction: with all speeds reversed the machine runs back to where it came from.
TEST(RandomMachines, AConservativeMachineRunsBackwards) {
  expect_for_all(5000, 250, true, [](const Machine& m) -> std::string {
    const Scene scene = scene_from(text_of(m));
    const auto model = compile(scene, scene.effects);
    Equations equations(model, false);
    std::vector<double> y = equations.start(0);
    const bool tied = !model->relations.empty();                   // speeds may not be set one by one
    for (std::size_t s = 0; s < model->free_shafts && !tied; ++s)  // something must vibrate
      y[equations.speed_index(static_cast<int>(s))] *= 1 + 0.3 * static_cast<double>(s % 3);
    const std::vector<double> begin = y;
    const auto run_from = [&](const std::vector<double>& from) {
      return integrate(equations,
                       {.tolerance = 1e-12, .until = 0.75 * m.until, .progress = {}, .from = RunStart{0, from}}, {});
    };
    const auto apart = [&](const std::vector<double>& a, const std::vector<double>& b) {  // speeds over their scales
      double largest = 0;
      for (std::size_t s = 0; s < model->free_shafts; ++s) {
        const std::size_t i = equations.speed_index(static_cast<int>(s));
        largest = std::max(largest, std::abs(a[i] - b[i]) / model->shafts[s].speed_scale);
      }
      return largest;
    };
    const auto reversed_state = [&](std::vector<double> state) {
      for (std::size_t s = 0; s < model->free_shafts; ++s) state[equations.speed_index(static_cast<int>(s))] *= -1;
      return state;
    };
    const RunOutcome there = run_from(begin);
    if (!there.complete) return there.diagnosis;
    const RunOutcome back = run_from(reversed_state(there.state));
    if (!back.complete) return back.diagnosis;
    const double found = apart(reversed_state(back.state), begin);
    if (found <= 1e-7) return "";
    // Vibrations far beyond a spring's rated torque multiply every error on their way.
    constexpr double small = 1e-9;
    std::vector<double> beside = begin;
    for (std::size_t s = 0; s < model->free_shafts; ++s)
      beside[equations.speed_index(static_cast<int>(s))] += small * model->shafts[s].speed_scale;
    const double allowed = 1e-10 * apart(run_from(beside).state, there.state) / small;
    return found <= allowed ? "" : fmt::format("{:.2g} apart after there and back; {:.2g} allowed", found, allowed);
  });
}

// All stiffnesses times s: every natural frequency times √s.
TEST(RandomMachines, StiffnessShiftsModesByItsRoot) {
  expect_for_all(6000, 400, true, [](const Machine& m) -> std::string {
    const auto frequencies = [](const Machine& machine) {
      const Scene scene = scene_from(text_of(machine));
      const auto model = compile(scene, scene.effects);
      if (model->elastic.empty()) return std::vector<double>{};
      const UndampedModes modes = undamped_modes(linearise(model, {}));
      return std::vector<double>(modes.omega.data(), modes.omega.data() + modes.omega.size());
    };
    Machine soft = m, stiff = m;
    for (Machine* machine : {&soft, &stiff})
      for (Joint& j : machine->joints)
        if (j.kind == Joint::Kind::planetary) j.kind = Joint::Kind::gear;  // whose stiffness is that of no spring
    for (Joint& j : stiff.joints) j.stiffness *= 9;
    const std::vector<double> one = frequencies(soft), other = frequencies(stiff);
    if (one.size() != other.size()) return "another number of modes";
    const double greatest = one.empty() ? 0 : *std::max_element(one.begin(), one.end());
    for (std::size_t k = 0; k < one.size(); ++k)
      if (std::abs(other[k] - 3 * one[k]) > 1e-7 * greatest)
        return fmt::format("mode {}: {} and {}", k, one[k], other[k]);
    return "";
  });
}

}  // namespace
}  // namespace kurbel::random_machines_test
