// elements_bench.cpp — what does one element cost per evaluation, and how many events a second go through?
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <string>
#include <vector>

#include "bench/benches.h"
#include "bench/machines.h"

namespace kurbel::bench {
namespace {

constexpr int copies = 10;

struct ElementCase {
  const char* name;
  const char* table;   // as in a scene, without its braces
  bool joins = false;  // two shafts
};

const ElementCase cases[] = {
    {"coupling", "kind = \"coupling\", stiffness = \"4 kN*m/rad\", damping = \"2 N*m*s/rad\"", true},
    {"backlash, no pulling",
     "kind = \"coupling\", stiffness = \"4 kN*m/rad\", damping = \"2 N*m*s/rad\", backlash = \"0.2 deg\"", true},
    {"backlash, Hunt–Crossley",
     "kind = \"coupling\", stiffness = \"4 kN*m/rad\", backlash = \"0.2 deg\", contact = \"Hunt-Crossley\", "
     "contact_damping = \"0.1 s/rad\"",
     true},
    {"clutch, slipping", "kind = \"clutch\", torque = \"5 N*m\"", true},
    {"one-way clutch", "kind = \"one-way clutch\", drag = \"0.1 N*m\"", true},
    {"brake", "kind = \"brake\", torque = \"5 N*m\""},
    {"load, dry and quadratic", "kind = \"load\", torque = \"5 N*m\", quadratic = \"0.01 N*m*s2/rad2\""},
    {"bearing drag", "kind = \"bearing drag\", damping = \"0.1 N*m*s/rad\""},
    {"dc shunt motor",
     "kind = \"dc shunt motor\", stall_torque = \"20 N*m\", no_load_speed = \"150 rad/s\", inertia = \"0 "
     "kg*m2\""},
    {"induction motor (Kloss)",
     "kind = \"induction motor\", rated_power = \"1 kW\", rated_speed = \"1440 rpm\", synchronous_speed = \"1500 "
     "rpm\", "
     "breakdown_ratio = 2.5, inertia = \"0 kg*m2\""},
    {"dc shunt motor with its circuit",
     "kind = \"dc shunt motor\", voltage = \"220 V\", resistance = \"0.5 Ohm\", constant = \"1.4 N*m/A\", inductance = "
     "\"10 "
     "mH\", inertia = \"0 kg*m2\""},
    {"induction motor, two axes",
     "kind = \"induction motor\", rated_power = \"1 kW\", rated_speed = \"1440 rpm\", synchronous_speed = \"1500 "
     "rpm\", "
     "breakdown_ratio = 2.5, resistance_ratio = 1, frequency = \"50 Hz\", inertia = \"0 kg*m2\""},
    {"bearing, exact",
     "kind = \"bearing\", torque = \"2 N*m\", static_torque = \"3 N*m\", stribeck_speed = \"1 rad/s\""},
    {"bearing, LuGre",
     "kind = \"bearing\", torque = \"2 N*m\", static_torque = \"3 N*m\", stribeck_speed = \"1 rad/s\", model = "
     "\"LuGre\", "
     "bristle_stiffness = \"1 kN*m/rad\""},
    {"rubber coupling, one branch",
     "kind = \"rubber coupling\", stiffness = \"4 kN*m/rad\", damping = \"2 N*m*s/rad\", branches = [{ stiffness = \"1 "
     "kN*m/rad\", relaxation_time = \"5 ms\" }]",
     true},
    {"gear stage with losses",
     "kind = \"gearbox\", efficiency = 0.97, stages = [{ teeth = [20, 30], inertia = [\"0.01 kg*m2\", \"0.02 kg*m2\"] "
     "}]",
     true},
    {"shaft of steel", "kind = \"shaft\", length = \"1 m\", diameter = \"40 mm\"", true},
    {"progressive coupling",
     "kind = \"progressive coupling\", table = { over = \"twist\", unit = [\"deg\", \"N*m\"], points = [[0, 0], [2, "
     "100], [4, "
     "400]] }, damping = \"1 N*m*s/rad\"",
     true},
    {"universal joint", "kind = \"universal joint\", stiffness = \"4 kN*m/rad\", angle = \"20 deg\"", true},
    {"torque limiter, slipping", "kind = \"torque limiter\", torque = \"5 N*m\"", true},
    {"belt with slip",
     "kind = \"belt\", diameter_in = \"200 mm\", diameter_out = \"200 mm\", centre_distance = \"0.7 m\", pretension = "
     "\"900 N\", friction_coefficient = 0.5",
     true},
    {"fluid coupling",
     "kind = \"fluid coupling\", diameter = \"0.4 m\", lambda = { over = \"speed ratio\", unit = [\"1\", \"1\"], "
     "points = [[0, 0.003], [0.8, 0.002], [1, 0]] }",
     true},
    {"viscous damper with its ring",
     "kind = \"viscous damper\", ring_inertia = \"0.1 kg*m2\", damping = \"2 N*m*s/rad\""},
    {"gear mesh of varying stiffness",
     "kind = \"gear mesh\", teeth = [20, 20], module = \"4 mm\", stiffness = \"4 MN*m/rad\", mesh_variation = [0.2], "
     "damping_ratio "
     "= 0.05",
     true},
    {"planetary gear, free ring", "kind = \"planetary gear\", sun = 30, ring = 80, ring_inertia = \"0.1 kg*m2\"", true},
    {"worm gear", "kind = \"worm gear\", starts = 2, teeth = 40, lead_angle = \"10 deg\", friction_coefficient = 0.05",
     true},
    {"dc series motor",
     "kind = \"dc series motor\", voltage = \"220 V\", resistance = \"0.5 Ohm\", constant = \"0.05 N*m/A2\", inertia = "
     "\"0 "
     "kg*m2\""},
    {"motor by table",
     "kind = \"motor\", torque = { over = \"speed\", unit = [\"rpm\", \"N*m\"], points = [[0, 20], [1000, 30], [1500, "
     "0]] }, "
     "inertia = \"0 kg*m2\""},
    {"governor with its integral",
     "kind = \"governor\", speed = \"100 rad/s\", proportional_gain = \"5 N*m*s/rad\", integral_gain = \"2 N*m/rad\", "
     "max_torque = \"50 N*m\""},
    {"slider-crank with a press force",
     "kind = \"slider-crank\", radius = \"50 mm\", rod = \"420 mm\", crank_inertia = \"2 kg*m2\", slider_mass = \"300 "
     "kg\", "
     "load = { kind = \"press\", nominal_force = \"100 kN\", nominal_travel = \"6 mm\" }"},
    {"four-bar",
     "kind = \"four-bar\", crank = \"50 mm\", coupler = \"200 mm\", rocker = \"120 mm\", ground = \"210 mm\", "
     "rocker_inertia = \"0.2 kg*m2\""},
    {"torque source, sine", "kind = \"torque source\", amplitude = \"3 N*m\", frequency = \"5 Hz\""},
};

// A chain of inertias with elements between them, or one inertia with elements on it.
std::string scene_of(const ElementCase& c, int n) {
  std::string line = "line = [\"s0\"", tables = "s0 = { kind = \"inertia\", inertia = \"1 kg*m2\" }\n";
  for (int k = 1; k <= n; ++k) {
    if (c.joins) {
      line += fmt::format(", \"e{0}\", \"s{0}\"", k);
      tables += fmt::format("s{} = {{ kind = \"inertia\", inertia = \"1 kg*m2\" }}\ne{} = {{ {} }}\n", k, k, c.table);
    } else {
      tables += fmt::format("e{} = {{ on = \"s0\", {} }}\n", k, c.table);
    }
  }
  return line + "]\n" + tables + "effects = { elasticity = true }\n";
}

// Speeds that differ from shaft to shaft, so that clutches slip and one-way clutches run free.
std::vector<double> state_of(Equations& equations) {
  const Model& m = equations.model();
  std::vector<double> twists(m.twist_count(), 0.01), speeds(m.free_shafts);
  for (std::size_t s = 0; s < speeds.size(); ++s) speeds[s] = 100 + static_cast<double>(s);
  return equations.state_of(0, 0, twists, speeds);
}

// Least time of one call over several repetitions [ns].
template <class Call>
double nanoseconds(Call call) {
  double least = HUGE_VAL;
  for (int round = 0; round < 15; ++round) {
    constexpr int calls = 2000;
    const auto begin = std::chrono::steady_clock::now();
    for (int i = 0; i < calls; ++i) call();
    const std::chrono::duration<double, std::nano> passed = std::chrono::steady_clock::now() - begin;
    least = std::min(least, passed.count() / calls);
  }
  return least;
}

struct Cost {
  double flow = 0, jacobian = 0;
  std::size_t states = 0;
};
Cost cost_of(const ElementCase& c, int n) {
  const Scene scene = parse_scene(scene_of(c, n), "bench.toml", all_kinds());
  Equations equations(compile(scene, scene.effects), false);
  const std::vector<double> y = state_of(equations);
  std::vector<double> rate(y.size()), values(equations.jacobian_pattern().row.size());
  return {nanoseconds([&] { equations.flow(0.01, y, rate); }),
          nanoseconds([&] { equations.jacobian(0.01, y, values); }), equations.model().state_count()};
}

void many_events(BenchBook& book) {
  const Scene scene = read_scene(std::string(KURBEL_SOURCE_DIR) + "/bench/scenes/twelve_shafts.toml", all_kinds());
  const auto model = compile(scene, scene.effects);
  const TimedRun t = timed(3, [&] { return bare_run(model, 1e-7); });
  const auto events = static_cast<double>(t.outcome.statistics.events);
  book.tables.push_back(
      {.title = "Twelve shafts with clutches, brakes and gaps: the event mechanism",
       .columns = {"events", "steps", "restarts per event", "time [s]", "events a second"},
       .rows = {{fmt::format("{:.0f}", events), fmt::format("{}", t.outcome.statistics.stepper.steps),
                 fmt::format("{:.3f}", static_cast<double>(t.outcome.statistics.stepper.restarts) / events),
                 fmt::format("{:.3g}", t.median_seconds), fmt::format("{:.0f}", events / t.median_seconds)}}});
}

}  // namespace

void costs_of_elements(BenchBook& book) {
  Table table{.title = "One element, per evaluation (ten of them against none, least of 15 repetitions)",
              .columns = {"element", "right-hand side [ns]", "Jacobian [ns]", "states"},
              .rows = {}};
  for (const ElementCase& c : cases) {
    try {
      const Cost none = cost_of(c, 0), many = cost_of(c, copies);
      table.rows.push_back({c.name, fmt::format("{:.1f}", (many.flow - none.flow) / copies),
                            fmt::format("{:.1f}", (many.jacobian - none.jacobian) / copies),
                            fmt::format("{}", (many.states - none.states) / copies)});
    } catch (const std::exception& error) {
      throw std::runtime_error(fmt::format("{}: {}", c.name, error.what()));
    }
  }
  book.tables.push_back(table);
  many_events(book);
}

}  // namespace kurbel::bench
