// metamorphic_test.cpp — changes of a scene that change nothing, or what they must: whole turns at the start, inertia
// in two parts, one shaft as two, a gear on the other side of what it drives, laws as tables, all times later.
#include <set>

#include "tests/support/scenes.h"
#include "tests/twins/twin_gears.h"

namespace kurbel::metamorphic_test {
namespace {

using namespace test;  // NOLINT: the scenes' names

constexpr double allowed = 3e-6;

class Unchanged : public EveryScene {};

std::string replaced(std::string text, const std::string& what, const std::string& by) {
  const std::size_t at = text.find(what);
  if (at == std::string::npos) throw std::logic_error("nothing to replace: " + what);
  return text.replace(at, what.size(), by);
}

// --- of every scene --------------------------------------------------------------------------------------------------

// Whole cycles on, for all laws over the angle: 7 × 720°.
TEST_P(Unchanged, StartedWholeTurnsOn) {
  const TwinScene& s = scene();
  if (s.end.find("angle =") != std::string::npos && s.end.find("steps") != std::string::npos) return;
  const double turns = 28 * M_PI;
  const std::string text = direct(s, {}, {}), key = "start = { ";
  const std::size_t angle = text.find("angle = ", text.find(key));
  double before = 0;
  std::string later;
  if (angle != std::string::npos && angle < text.find('}', text.find(key))) {
    before = std::stod(text.substr(angle + 9));
    later = text.substr(0, angle) + fmt::format("angle = \"{:.17g} rad\"", before + turns) +
            text.substr(text.find('"', angle + 9) + 1);
  } else {
    later = replaced(text, key, key + fmt::format("angle = \"{:.17g} rad\", ", turns));
  }
  TwinMap map;
  map.turned = turns;
  map.travels = s.travels;
  SCOPED_TRACE(s.name);
  expect_same_run(run(text, false), run(later, false), map, allowed);
}

// The first component's shaft as two that a gear of 20:20 teeth joins, part of its inertia on the other side.
TEST_P(Unchanged, OneShaftAsTwoWithItsInertiaDivided) {
  const TwinScene& s = scene();
  const std::string key = s.near[0] == "crank" ? "" : "inertia = <J ";
  const std::size_t table = s.near_text.find("\n[" + s.near[0] + "]");
  const std::size_t at = key.empty() ? std::string::npos : s.near_text.find("inertia = <J ", table);
  if (at == std::string::npos) return;  // of a mechanism or an engine
  const double own = std::stod(s.near_text.substr(at + key.size()));
  TwinScene parted = s;
  parted.near_text.replace(at, s.near_text.find('>', at) + 1 - at, fmt::format("inertia = <J {}>", 0.5 * own));
  parted.near_text += fmt::format(
                          "\n[gear_to]\nkind = \"gearbox\"\nstages = [{{ teeth = [20, 20], inertia = [\"{0} kg*m2\", "
                          "\"{1} kg*m2\"] }}]\n",
                          0.1 * own, 0.15 * own) +
                      fmt::format("\n[gear_back]\nkind = \"flywheel\"\ninertia = \"{} kg*m2\"\n", 0.25 * own);
  parted.near.insert(parted.near.begin() + 1, {"gear_to", "gear_back"});
  SCOPED_TRACE(s.name);
  expect_same_run(run(direct(parted, {}, {}), false), run(direct(s, {}, {}), false), {}, allowed);
}

// The gear stands before the group, or behind any of its components: what is before it is then seen from its fast side.
TEST_P(Unchanged, GearMovedAcrossCouplings) {
  const TwinScene& s = scene();
  if (!s.rest.empty() || !s.far_besides.empty() || s.far.size() < 2) return;
  const IdealGear& gear = twin_gears()[0];
  const auto text = [&](std::size_t behind) {
    std::vector<std::string> before(s.far.begin(), s.far.begin() + static_cast<std::ptrdiff_t>(behind));
    std::vector<std::string> after(s.far.begin() + static_cast<std::ptrdiff_t>(behind), s.far.end());
    std::string tables = seen(s.near_text, {}, {}) + gear.text("gear_to", false);
    for (const auto& [name, table] : tables_in(s.far_text))
      tables += seen(table, std::count(before.begin(), before.end(), name) ? gear.view() : View{}, {});
    return line_of({s.near, before, {"gear_to"}, after}) + tables + seen(s.end, {}, {});
  };
  TwinMap map;
  for (std::size_t k = 0; k + 1 < s.far.size(); ++k) map.view[s.far[k]] = gear.view();
  SCOPED_TRACE(s.name);
  expect_same_run(run(text(0), false), run(text(s.far.size() - 1), false), map, allowed);
}

INSTANTIATE_TEST_SUITE_P(All, Unchanged, ::testing::Range<std::size_t>(0, twin_scenes().size()), name_of_twin);

// --- tables for formulas ---------------------------------------------------------------------------------------------

struct Law {
  std::string name, formula, table;  // of the component "law", driven and loaded by others
};
std::string with_law(const std::string& law, const std::string& run) {
  return "line = [\"wheel\", \"link\", \"law\"]\n[wheel]\nkind = \"flywheel\"\ninertia = \"0.7 kg*m2\"\n"
         "[link]\nkind = \"coupling\"\nstiffness = \"900 N*m/rad\"\ndamping_ratio = 0.06\n"
         "[shaking]\nkind = \"torque source\"\non = \"wheel\"\ntorque = \"9 N*m\"\namplitude = \"30 N*m\"\nfrequency = "
         "\"2.3 Hz\"\n"
         "[law]\n" +
         law + "\n[effects]\nelasticity = true\n[run]\naccuracy = 1e-8\nsamples = 31\n" + run;
}

TEST(TablesAndFormulas, DescribeOneMachine) {
  const std::string run_on = "until = \"1 s\"\nstart = { speed = \"11 rad/s\" }\n",
                    press =
                        "kind = \"slider-crank\"\nradius = \"90 mm\"\nrod = \"310 mm\"\noffset = \"20 "
                        "mm\"\ncrank_inertia = \"0.5 kg*m2\"\nslider_mass = \"5 kg\"\n";
  const double stroke = 1e3 * (std::sqrt(0.4 * 0.4 - 0.02 * 0.02) - std::sqrt(0.22 * 0.22 - 0.02 * 0.02));
  const std::vector<Law> laws = {
      {"shunt motor",
       "kind = \"dc shunt motor\"\nstall_torque = \"70 N*m\"\nno_load_speed = \"21 rad/s\"\ninertia = \"0.2 kg*m2\"",
       "kind = \"motor\"\ntorque = { over = \"speed\", unit = [\"rad/s\", \"N*m\"], points = [[-42, 210], [42, -70]] "
       "}\ninertia = \"0.2 kg*m2\""},
      {"viscous drag", "kind = \"load\"\ndamping = \"1.7 N*m*s/rad\"\ninertia = \"0.2 kg*m2\"",
       "kind = \"load\"\ntable = { over = \"speed\", unit = [\"rad/s\", \"N*m\"], points = [[-100, -170], [100, 170]] "
       "}\ninertia = \"0.2 kg*m2\""},
      {"ramped torque", "kind = \"torque source\"\ntorque = \"35 N*m\"\nramp = \"0.4 s\"\ninertia = \"0.2 kg*m2\"",
       "kind = \"torque source\"\ntable = { over = \"time\", unit = [\"s\", \"N*m\"], points = [[0, 0], [0.4, 35], [2, "
       "35]] }\ninertia = \"0.2 kg*m2\""},
      {"weight", "kind = \"load\"\ntorque = \"13 N*m\"\nacts = \"always\"\ninertia = \"0.2 kg*m2\"",
       "kind = \"load\"\ntable = { over = \"angle\", unit = [\"rad\", \"N*m\"], points = [[0, 13], [1, 13]] }\ninertia "
       "= \"0.2 kg*m2\""},
      {"press",
       press + "load = { kind = \"press\", nominal_force = \"1.1 kN\", nominal_travel = \"60 mm\", rise = \"15 mm\", "
               "breakthrough = \"20 mm\", drop = \"5 mm\" }",
       press + fmt::format("load = {{ kind = \"table\", force = {{ over = \"travel\", unit = [\"mm\", \"N\"], points = "
                           "[[0, 0], [15, 0], [20, 1100], [45, 1100], [60, 0], [{0:.17g}, 0]], return_points = [[0, "
                           "0], [{0:.17g}, 0]] }} }}",
                           stroke)},
      {"constant force", press + "load = { kind = \"constant\", force = \"-300 N\" }",
       press + fmt::format("load = {{ kind = \"table\", force = {{ over = \"travel\", unit = [\"mm\", \"N\"], points = "
                           "[[0, 300], [{0:.17g}, 300]] }} }}",
                           stroke)},
  };
  for (const Law& law : laws) {
    SCOPED_TRACE(law.name);
    Result a = run(with_law(law.formula, run_on), false), b = run(with_law(law.table, run_on), false);
    a.events.clear(), b.events.clear();  // a table's knots
    if (law.name == "weight") {          // a table over the angle makes a cycle, with figures of it
      std::erase_if(b.figures, [&](const Figure& f) { return !a.find(f.name); });
      b.cycles.clear(), b.periods = a.periods;
    }
    expect_same_run(a, b, {}, allowed);
  }
}

// --- later -----------------------------------------------------------------------------------------------------------

// At rest and without torque until Δt, then all that is given over time Δt later: the same machine Δt later.
TEST(TimeShift, EverythingThatIsReportedByTimeHappensThatMuchLater) {
  const auto text = [](double shift) {
    const auto at = [&](double t) { return fmt::format("\"{:.17g} s\"", t + shift); };
    return fmt::format(R"(
line = ["motor", "clutch", "wheel", "link", "sink"]
[motor]
kind = "induction motor"
rated_power = "2.3 kW"
rated_speed = "47 rad/s"
synchronous_speed = "50 rad/s"
breakdown_ratio = 2.6
starting = "star-delta"
switch_time = "0.3 s"
pause = "40 ms"
inertia = "0.3 kg*m2"
start = {0}
stop = {5}
[clutch]
kind = "clutch"
torque = "60 N*m"
static_torque = "75 N*m"
[wheel]
kind = "flywheel"
inertia = "0.4 kg*m2"
[link]
kind = "coupling"
stiffness = "900 N*m/rad"
damping_ratio = 0.06
[sink]
kind = "load"
torque = "5 N*m"
damping = "0.1 N*m*s/rad"
inertia = "0.5 kg*m2"
[push]
kind = "torque source"
on = "sink"
torque = "-9 N*m"
ramp = "0.2 s"
start = {1}
[brake]
kind = "brake"
on = "wheel"
torque = "20 N*m"
start = {2}
stop = {3}
[sequence]
steps = [
  {{ at = "0 s", set = "clutch", to = 0 }},
  {{ at = {4}, set = "clutch", to = 0.8, over = "0.1 s" }},
  {{ speed_above = "20 rad/s", of = "wheel", set = "clutch", to = 1 }},
  {{ after = "0.2 s", set = "clutch", to = 0 }},
]
[effects]
elasticity = true
[run]
accuracy = 1e-8
samples = 41
until = {6}
start = "rest"
)",
                       at(0.01), at(0.7), at(1.1), at(1.3), at(0.15), at(1.2), at(1.5));
  };
  const double shift = 0.37;
  const Result now = run(text(0), false), later = run(text(shift), false);
  ASSERT_TRUE(now.complete && later.complete) << now.diagnosis << later.diagnosis;
  for (const auto& [name, state] : now.final_state) {
    EXPECT_NEAR(state.angle.value, later.final_state.at(name).angle.value, 1e-5) << name;
    EXPECT_NEAR(state.speed.value, later.final_state.at(name).speed.value, 1e-5) << name;
  }
  for (const auto& [name, work] : now.energy.by_account)
    EXPECT_NEAR(work, later.energy.by_account.at(name), 1e-3) << name;
  const auto moved = [](const Result& r, double shift_back) {
    std::vector<std::pair<std::string, double>> events;
    for (const Event& e : r.events)
      if (e.t - shift_back > 1e-9) events.emplace_back(e.component + ": " + e.what, e.t - shift_back);
    return events;
  };
  const auto a = moved(now, 0), b = moved(later, shift);
  ASSERT_EQ(a.size(), b.size());
  EXPECT_GT(a.size(), 8u);
  for (std::size_t k = 0; k < a.size(); ++k) {
    EXPECT_EQ(a[k].first, b[k].first);
    EXPECT_NEAR(a[k].second, b[k].second, 1e-6) << a[k].first;
  }
  for (const Figure& f : now.figures)
    if (f.name.starts_with("peak_torque.")) {
      EXPECT_NEAR(std::abs(f.value), std::abs(figure(later, f.name)), 1e-4) << f.name;
    }
}

}  // namespace
}  // namespace kurbel::metamorphic_test
