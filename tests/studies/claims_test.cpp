// claims_test.cpp — what is said is a claim: typed, shown by evidence beyond its error, and true of the motion.
#include "studies/claims/claim.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <numbers>
#include <set>
#include <sstream>

#include "engine/orbit/orbit.h"
#include "studies/answers/run_claims.h"
#include "studies/duty/work_periods.h"
#include "studies/limits/ratings.h"
#include "studies/modes/modes.h"
#include "studies/run/run_findings.h"
#include "studies/steady/steady.h"
#include "studies/steady/steady_words.h"
#include "studies/trials/trials_findings.h"
#include "tests/support/conclusions.h"
#include "tests/support/scenes.h"

namespace kurbel::claims_test {
namespace {

constexpr double pi = std::numbers::pi;

using test::find;
using test::has;
using test::said;

// --- claims are made by one function ---

TEST(Claim, IsNotMadeWhereItsEvidenceIsBelowItsError) {
  const auto exceeded = [](double value, std::optional<double> error) {
    return claimed(Predicate::limit_exceeded, "it is too much", "shaft",
                   {.value = value, .limit = 100, .error = error, .unit = "Pa"});
  };
  EXPECT_TRUE(exceeded(103, 2));
  EXPECT_FALSE(exceeded(103, 4));
  EXPECT_FALSE(exceeded(99, {}));
  const auto held = [](double value, double error) {
    return claimed(Predicate::limit_held, "it holds", "shaft", {.value = value, .limit = 100, .error = error});
  };
  EXPECT_TRUE(held(97, 2));
  EXPECT_FALSE(held(97, 4));
  EXPECT_FALSE(claimed(Predicate::figures_told, ""));
}

TEST(Claim, NamesAreStableAndEachHasItsDefinition) {
  EXPECT_STREQ(name_of(Predicate::clutch_slips_closed), "clutch_slips_closed");
  EXPECT_STREQ(name_of(Predicate::figures_told), "figures_told");
  std::set<std::string> names;
  for (const ClaimKind& kind : claim_kinds()) {
    EXPECT_TRUE(names.insert(name_of(kind.predicate)).second);
    for (const char* words : {kind.when, kind.evidence, kind.sentence, kind.where}) EXPECT_NE(std::string(words), "");
    EXPECT_EQ(&kind, &kind_of(kind.predicate));
  }
}

TEST(Documents, ClaimsAreThoseOfTheProgram) {
  std::ifstream in(test::source_path("docs/claims.md"));
  std::stringstream text;
  text << in.rdbuf();
  EXPECT_EQ(text.str(), claims_in_markdown()) << "renew it: kurbel explain --claims > docs/claims.md";
}

TEST(Claim, StandsTypedBesideTheWordsInJson) {
  const Result r = test::run(test::scene_file("scenes/belt_mill.toml"), false);
  const Findings f = findings_of(r);
  const auto json = nlohmann::json::parse(json_text(summary_of(f)));
  ASSERT_EQ(json["claims"].size(), f.claims.size());
  bool exceeded = false;
  for (const auto& claim : json["claims"]) {
    for (const char* key : {"name", "of", "at", "value", "limit", "error", "unit", "severity", "text"})
      EXPECT_TRUE(claim.contains(key)) << key;
    if (claim["name"] != "limit_exceeded") continue;
    exceeded = true;
    EXPECT_EQ(claim["of"], "belts");
    EXPECT_EQ(claim["severity"], "fault");
    EXPECT_GT(claim["value"].get<double>(), claim["limit"].get<double>());
    EXPECT_TRUE(has(json["conclusion"], claim["text"].get<std::string>().substr(0, 30)));
  }
  EXPECT_TRUE(exceeded);
}

// --- contacts ---

// Open by command from its first moment on, of which the events hold nothing.
TEST(ContactClaims, AnOpenClutchLetsNothingGo) {
  const Result r = test::run(test::scene_file("tests/cases/reports/open_clutch.toml"));
  EXPECT_FALSE(find(r.claims, Predicate::clutch_slips_closed));
  const Claim* open = find(r.claims, Predicate::clutch_opened_by_command, "clutch");
  ASSERT_TRUE(open);
  EXPECT_EQ(open->evidence.at, 0);
  EXPECT_TRUE(has(said(r), "\"clutch\" is open by command, from the start to the end")) << said(r);
  EXPECT_FALSE(r.find("torque_reserve.clutch"));
}

// Blows of 60 N·m over 40° a turn behind a clutch of 20 N·m.
std::string blows(const std::string& clutch, const std::string& until) {
  return fmt::format(R"(
    line = ["motor", "clutch", "wheel"]
    motor = {{ kind = "dc shunt motor", stall_torque = "60 N*m", no_load_speed = "40 rad/s", inertia = "0.5 kg*m2" }}
    clutch = {{ kind = "clutch", torque = "20 N*m"{} }}
    wheel = {{ kind = "flywheel", inertia = "0.3 kg*m2", rim_radius = "200 mm", allowable_rim_speed = "100 m/s" }}
    [blow]
    kind = "load"
    on = "wheel"
    acts = "always"
    table = {{ over = "angle", unit = ["deg", "N*m"], points = [[0, 0], [300, 0], [305, 60], [345, 60], [350, 0], [360, 0]] }}
    [run]
    until = "{}"
    start = {{ speed = "30 rad/s" }}
  )",
                     clutch, until);
}

TEST(ContactClaims, AClutchThatSlipsAtEveryStrokeIsBadNewsAndNoSentenceSaysThatAllHolds) {
  const Result r = test::run(blows("", "2 s"));
  const Claim* slips = find(r.claims, Predicate::clutch_slips_closed, "clutch");
  ASSERT_TRUE(slips) << said(r);
  EXPECT_EQ(slips->severity(), Severity::warning);
  EXPECT_GT(*slips->evidence.value, 0.1);
  const std::string text = said(r);
  EXPECT_TRUE(has(text, "\"clutch\" slips ")) << text;
  EXPECT_TRUE(has(text, "not assessed: \"clutch\", heat of slipping")) << text;
  EXPECT_TRUE(has(text, "1 of 2 ratings EXCEEDED, worst \"clutch\", holding torque")) << text;
  EXPECT_FALSE(has(text, "ratings hold")) << text;
  // With its heat rated it is judged.
  const std::string rated = said(test::run(blows(", allowable_heat = \"10 kJ\"", "2 s")));
  EXPECT_FALSE(has(rated, "not assessed")) << rated;
  EXPECT_TRUE(has(rated, "1 of 3 ratings EXCEEDED, worst \"clutch\", holding torque")) << rated;
}

// An engagement is none: it slips from its closing to its locking.
TEST(ContactClaims, AClutchThatEngagesDoesNotLetGo) {
  const Result r = test::run(R"(
    line = ["a", "clutch", "b"]
    a = { kind = "inertia", inertia = "1 kg*m2" }
    b = { kind = "inertia", inertia = "1 kg*m2" }
    clutch = { kind = "clutch", torque = "40 N*m" }
    sequence = { steps = [{ at = "0 s", set = "clutch", to = 0 }, { at = "0.5 s", set = "clutch", to = 1, over = "0.2 s" }] }
    run = { until = "4 s", start = { a = { speed = "50 rad/s" }, b = { speed = "0 rad/s" } } }
  )");
  EXPECT_FALSE(find(r.claims, Predicate::clutch_slips_closed));
  const Claim* engages = find(r.claims, Predicate::clutch_slips_engaging, "clutch");
  ASSERT_TRUE(engages);
  EXPECT_NEAR(*engages->evidence.at, 0.5, 1e-9);
  EXPECT_TRUE(find(r.claims, Predicate::clutch_opened_by_command, "clutch"));
}

TEST(ContactClaims, AFreewheelThatOverrunsDoesNotSlip) {
  const Result r = test::run(R"(
    line = ["motor", "freewheel", "wheel"]
    motor = { kind = "torque source", torque = "0 N*m", inertia = "0.1 kg*m2" }
    drag = { kind = "load", on = "motor", torque = "1 N*m" }
    freewheel = { kind = "one-way clutch", drag = "0.01 N*m" }
    wheel = { kind = "flywheel", inertia = "5 kg*m2" }
    run = { until = "2 s", start = { speed = "50 rad/s" } }
  )");
  EXPECT_TRUE(find(r.claims, Predicate::freewheel_overruns, "freewheel")) << said(r);
  EXPECT_FALSE(find(r.claims, Predicate::slips_to_the_end));
}

// --- the machine's motion ---

// A press that stands within each cycle: ω from 0 to 65 rpm is no steady running, and δ = 2 says nothing.
TEST(MotionClaims, SingleStrokesAreNoSteadyRunning) {
  Result r;
  r.model = compile(test::scene_file("scenes/crank_press.toml"), {});
  r.periods.steady = true, r.periods.steady_speed = 3.2, r.until = 20;
  const auto add = [&](const QuantityKind& what, double value) {
    r.figures.push_back(Figure::defined(Name::make(what, "press"), value));
    r.figures.back().error = 1e-9;
  };
  add(quantities::delta, 2.063), add(quantities::mean_speed, 3.2), add(quantities::cycle_time, 1.961);
  const Claims claims = run_claims(r);
  ASSERT_TRUE(find(claims, Predicate::works_in_strokes));
  EXPECT_EQ(find(claims, Predicate::works_in_strokes)->text,
            "\"press\" makes single strokes, one every 1.961 s, and rests between them");
  EXPECT_FALSE(find(claims, Predicate::runs_steadily));
  EXPECT_FALSE(has(figures_in_words(r), "δ")) << figures_in_words(r);
  r.figures.front().value = 0.2;
  EXPECT_TRUE(find(run_claims(r), Predicate::runs_steadily));
}

// The torque rises up to 200 rad/s and stays; the drag holds it at √(50/1e-3) = 224 rad/s, far beyond the data.
std::string engine(const std::string& drag) {
  return fmt::format(R"(
    line = ["engine", "wheel"]
    wheel = {{ kind = "flywheel", inertia = "1 kg*m2" }}
    {}
    [engine]
    kind = "torque source"
    inertia = "0.1 kg*m2"
    table = {{ over = "speed", unit = ["rad/s", "N*m"], points = [[0, 5], [200, 50]], beyond = "hold" }}
    [run]
    until = "6 s"
    start = {{ speed = "10 rad/s" }}
  )",
                     drag);
}

TEST(MotionClaims, WhatItsDragSettlesDoesNotRunAway) {
  const auto after = [](double until, const std::string& drag) {
    Scene scene = test::scene_from(engine(drag));
    scene.run.until = until;
    return test::run(scene, false);
  };
  const Result free = after(30, "");
  EXPECT_TRUE(find(free.claims, Predicate::runs_away)) << said(free);
  for (const double until : {2.0, 4.0, 6.0, 8.0, 10.0, 30.0}) {
    const Result held = after(until, "drag = { kind = \"load\", on = \"wheel\", quadratic = \"1e-3 N*m*s2/rad2\" }");
    EXPECT_FALSE(find(held.claims, Predicate::runs_away)) << until << " s: " << said(held);
  }
}

// A weight on a drum behind a gear that locks itself, and the same behind a brake that is on.
std::string hoist(const std::string& gear, const std::string& more) {
  return fmt::format(R"(
    line = ["motor", "gear", "drum"]
    motor = {{ kind = "torque source", torque = "2 N*m", inertia = "0.1 kg*m2" }}
    gear = {{ kind = "gearbox", stages = [{{ teeth = [20, 800] }}]{} }}
    drum = {{ kind = "flywheel", inertia = "5 kg*m2" }}
    weight = {{ kind = "load", on = "drum", torque = "200 N*m", acts = "always" }}
    {}
    run = {{ start = "rest", until = "2 s" }}
  )",
                     gear, more);
}

TEST(MotionClaims, WhatIsHeldIsHeldBySomething) {
  const Result gear = test::run(hoist(", efficiency_forwards = 0.45, efficiency_backwards = -0.2",
                                      "sequence = { steps = [{ at = \"0 s\", set = \"motor\", to = 0 }] }"));
  const Claim* by_gear = find(gear.claims, Predicate::held_by);
  ASSERT_TRUE(by_gear) << said(gear);
  EXPECT_TRUE(has(by_gear->text, "is held by \"gear\"")) << by_gear->text;
  EXPECT_NEAR(*by_gear->evidence.value, 200.0 / 40, 1e-9);
  for (const char* brake : {"brake = { kind = \"brake\", on = \"motor\", torque = \"50 N*m\" }",
                            "brake = { kind = \"brake\", on = \"motor\", torque = \"50 N*m\" }\n"
                            "sequence = { steps = [{ at = \"0 s\", set = \"brake\", to = 1 }] }"}) {
    const Result r = test::run(hoist("", brake));
    const Claim* held = find(r.claims, Predicate::held_by);
    ASSERT_TRUE(held) << said(r);
    EXPECT_TRUE(has(held->text, "is held by \"brake\"")) << held->text;
    EXPECT_FALSE(find(r.claims, Predicate::does_not_start)) << said(r);
    EXPECT_TRUE(said(r).starts_with("\"motor\" is held by \"brake\"")) << said(r);
  }
}

TEST(MotionClaims, WhatNeverMovedDoesNotComeToRest) {
  const Scene scene = test::scene_from(R"(
    line = ["wheel"]
    wheel = { kind = "flywheel", inertia = "5 kg*m2" }
    rub = { kind = "load", on = "wheel", torque = "3 N*m" }
    run = { start = "rest", until = "400 s" }
  )");
  const Result r = test::run(scene);
  EXPECT_TRUE(find(r.claims, Predicate::does_not_move)) << said(r);
  EXPECT_TRUE(said(r).starts_with("\"wheel\" does not move")) << said(r);
  const std::string words = find_orbit(compile(scene, {}), {}).words;
  EXPECT_FALSE(has(words, "comes to rest")) << words;
}

// One side of a spring is set to turn, the other one to stand by silence.
TEST(MotionClaims, AStartWhoseShaftsDisagreeIsWarnedOf) {
  const auto run = [](const std::string& start) {
    return test::run(fmt::format(R"(
      line = ["motor", "coupling", "wheel"]
      motor = {{ kind = "inertia", inertia = "1 kg*m2" }}
      coupling = {{ kind = "coupling", stiffness = "10 kN*m/rad", relative_damping = 0.8 }}
      wheel = {{ kind = "flywheel", inertia = "4 kg*m2" }}
      effects = {{ elasticity = true }}
      run = {{ until = "0.5 s", start = {{ {} }} }}
    )",
                                 start),
                     false);
  };
  const Result one = run("motor = { speed = \"1455 rpm\" }");
  const Claim* claim = find(one.claims, Predicate::start_shafts_disagree, "coupling");
  ASSERT_TRUE(claim) << said(one);
  EXPECT_NEAR(*claim->evidence.value, 1455 * pi / 30, 1e-9);
  EXPECT_FALSE(find(run("motor = { speed = \"1455 rpm\" }, wheel = { speed = \"0 rpm\" }").claims,
                    Predicate::start_shafts_disagree));
  EXPECT_FALSE(find(run("speed = \"1455 rpm\"").claims, Predicate::start_shafts_disagree));
}

// A pendulum upside down, m g r = 1.5 kg·0.2 m·9.81 m/s², I = 0.06 kg·m² at the crank alone: λ² = m g r/I. Rounding, 1e-13 rad
// at most, is 1e-9 rad after ln 1e4/λ = 1.3 s.
TEST(StartClaims, UnstableEquilibriumIsSaid) {
  const auto run = [](const char* until, const char* more, const char* line = "", const char* others = "") {
    return test::run(fmt::format(R"(
      line = [{} "crank"]
      crank = {{ kind = "slider-crank", radius = "0.2 m", rod = "0.6 m", crank_mass = "1.5 kg", crank_com = "0.2 m", crank_inertia = "0.06 kg*m2", slider_mass = "0 kg", gravity = "9.81 m/s2", stroke_angle = "90 deg" }}
      {}
      run = {{ until = "{}"{} }}
    )",
                                 line, others, until, more));
  };
  const double growth = std::sqrt(1.5 * 0.2 * 9.81 / 0.06), decides = std::log(1e4) / growth;
  const char* const up = ", start = { angle = \"0 deg\" }";
  const auto is_said = [&](const Result& r) {
    const Claim* claim = find(r.claims, Predicate::start_unstable, "crank");
    if (!claim) return false;
    EXPECT_NEAR(*claim->evidence.value, growth, 1e-6);
    EXPECT_NEAR(*claim->evidence.at, decides, 1e-6);
    return true;
  };
  const auto error_at_end = [](const Result& r) { return r.find("final_speed.crank")->error; };
  const Result soon = run("0.1 s", up);  // long before rounding matters
  EXPECT_TRUE(is_said(soon));
  EXPECT_TRUE(error_at_end(soon) && soon.accuracy_confirmed);
  const Result late = run("6 s", up);
  EXPECT_TRUE(is_said(late)) << said(late);
  EXPECT_FALSE(error_at_end(late) || late.accuracy_confirmed || late.errors_measured);
  EXPECT_TRUE(find(late.claims, Predicate::moves) == nullptr || !find(late.claims, Predicate::moves)->evidence.error);
  EXPECT_TRUE(has(said(late), "NOT confirmed")) << said(late);
  EXPECT_TRUE(has(late.unconfirmed_in_words(), "another angle")) << late.unconfirmed_in_words();
  for (const Figure& f : late.figures) EXPECT_EQ(f.error.has_value(), f.exact) << f.name;
  // Behind an open clutch, too; not where a torque moves it before, or it begins elsewhere.
  EXPECT_TRUE(is_said(
      run("0.1 s", ", start = { angle = \"0 deg\", wheel = { speed = \"10 rad/s\" } }", "\"wheel\", \"clutch\",", R"(
      wheel = { kind = "flywheel", inertia = "1 kg*m2" }
      clutch = { kind = "clutch", torque = "50 N*m" }
      sequence = { steps = [{ at = "0 s", set = "clutch", to = 0 }] })")));
  const Result pushed =
      run("6 s", up, "", "push = { kind = \"torque source\", on = \"crank\", torque = \"1 N*m\", start = \"0.1 s\" }");
  EXPECT_FALSE(is_said(pushed));
  EXPECT_TRUE(error_at_end(pushed) && pushed.accuracy_confirmed);
  // Shafts that a spring joins leave it together: λ² = m g r/(I + i² J) behind a gear of i = 3 at the wheel.
  const Result joined = run("0.1 s", up, "\"wheel\", \"shaft\", \"gear\",", R"(
      wheel = { kind = "flywheel", inertia = "0.05 kg*m2" }
      shaft = { kind = "coupling", stiffness = "1e5 N*m/rad", damping_ratio = 0.05 }
      gear = { kind = "gearbox", stages = [{ teeth = [20, 60] }] }
      effects = { elasticity = true })");
  const Claim* together = find(joined.claims, Predicate::start_unstable, "crank");
  ASSERT_TRUE(together) << said(joined);
  EXPECT_NEAR(*together->evidence.value, std::sqrt(1.5 * 0.2 * 9.81 / (0.06 + 9 * 0.05)), 1e-6);
  EXPECT_FALSE(is_said(run("0.1 s", ", start = { angle = \"0.1 deg\" }")));
  EXPECT_FALSE(is_said(run("0.1 s", ", start = { angle = \"180 deg\" }")));
  EXPECT_FALSE(is_said(run("0.1 s", ", start = { angle = \"0 deg\", speed = \"1 rad/s\" }")));
}

// --- the three periods ---

TEST(Periods, AreTheSameInWordsTablesAndWorks) {
  const Result r = test::run(test::scene_file("tests/cases/reports/motor_switched_off.toml"), false);
  const std::vector<WorkPeriod> reported = three_periods(r.periods, 0, r.until);
  ASSERT_EQ(reported.size(), 3u);
  EXPECT_EQ(reported[0].begin, 0);
  EXPECT_EQ(reported[0].end, test::figure(r, "run_up_time"));
  EXPECT_EQ(reported[1].begin, reported[0].end);
  EXPECT_NEAR(reported[1].end, 20, 1e-12);
  EXPECT_EQ(reported[2].begin, reported[1].end);
  EXPECT_EQ(reported[2].end, *r.periods.standstill);
  // Nothing drives in the run-down; all works of the periods are those of the run, and each closes.
  EXPECT_EQ(test::figure(r, "work_of_run_down.driving"), 0);
  for (const char* kind : {"driving", "useful", "harmful"}) {
    double sum = 0;
    for (const char* period : {"run_up", "steady_motion", "run_down"})
      sum += test::figure(r, fmt::format("work_of_{}.{}", period, kind));
    EXPECT_NEAR(sum, test::figure(r, std::string("work.") + kind), 1e-6 * std::abs(sum)) << kind;
  }
  for (const char* period : {"run_up", "steady_motion", "run_down"}) {
    double open = -test::figure(r, fmt::format("work_of_{}.energy", period));
    for (const char* kind : {"driving", "useful", "harmful", "weight"})
      open += test::figure(r, fmt::format("work_of_{}.{}", period, kind));
    EXPECT_NEAR(open, 0, 1e-3) << period;
  }
  // The driving work of the run-up, by a run that ends there.
  Scene scene = test::scene_file("tests/cases/reports/motor_switched_off.toml");
  scene.run.until = reported[0].end;
  EXPECT_NEAR(test::figure(test::run(scene, false), "work.driving"), test::figure(r, "work_of_run_up.driving"),
              1e-4 * test::figure(r, "work_of_run_up.driving"));
}

// --- verdicts ---

// A blow at the start, and a steady motion that hardly vibrates, in a shaft whose endurance limit the blow alone exceeds.
std::string rated_shaft(const std::string& more) {
  return fmt::format(R"(
    line = ["motor", "shaft", "wheel"]
    motor = {{ kind = "dc shunt motor", stall_torque = "400 N*m", no_load_speed = "100 rad/s", inertia = "0.5 kg*m2" }}
    wheel = {{ kind = "load", damping = "0.2 N*m*s/rad", inertia = "1.5 kg*m2" }}
    effects = {{ elasticity = true }}
    [shaft]
    kind = "shaft"
    length = "300 mm"
    diameter = "30 mm"
    inertia = "0 kg*m2"
    damping_ratio = 0.02
    {}
    [run]
    until = "3 s"
  )",
                     more);
}

TEST(Verdicts, TheExtremesOfOneStartAreNoEndlessAlternation) {
  const Scene scene = test::scene_from(
      rated_shaft("tensile_strength = \"700 MPa\"\nendurance_limit = \"70 MPa\"\nnotch_factor = 1.4\nsafety = 1.2"));
  const std::vector<Verdict> by_run = judge_ratings(test::run(scene));
  ASSERT_EQ(by_run.size(), 1u);
  EXPECT_GT(by_run[0].share(), 1);
  EXPECT_EQ(by_run[0].state(), Compliance::not_assessed);
  EXPECT_EQ(by_run[0].load_case, load_case::steady);
  const SteadyStudy s = steady(scene, {scene.effects}, {.start_search = false});
  ASSERT_TRUE(s.complete) << s.diagnosis;
  for (const Verdict& v : steady_ratings(s.cycles.back())) EXPECT_EQ(v.state(), Compliance::holds) << v.requirement;
}

// T_KN, T_KW and P_KW are of the steady motion, which `run` does not judge; T_Kmax of a start is none of `steady`.
TEST(Verdicts, NameTheirLoadCaseAndWhatIsNotAssessed) {
  const Scene scene = test::scene_from(R"(
    line = ["motor", "coupling", "wheel"]
    motor = { kind = "dc shunt motor", stall_torque = "60 N*m", no_load_speed = "100 rad/s", inertia = "0.5 kg*m2" }
    coupling = { kind = "coupling", stiffness = "2 kN*m/rad", relative_damping = 0.8, nominal_torque = "100 N*m", maximum_torque = "300 N*m" }
    wheel = { kind = "load", damping = "0.2 N*m*s/rad", inertia = "4 kg*m2" }
    effects = { elasticity = true }
    run = { until = "20 s" }
  )");
  const Result r = test::run(scene);
  const auto state_of = [](const std::vector<Verdict>& all, const std::string& head, const std::string& of_case) {
    for (const Verdict& v : all)
      if (v.requirement.starts_with(head) && v.load_case == of_case) return std::string(name_of(v.state()));
    return std::string("none");
  };
  const std::vector<Verdict> by_run = judge_ratings(r);
  EXPECT_EQ(state_of(by_run, "maximum", load_case::start), "holds");
  EXPECT_EQ(state_of(by_run, "nominal", load_case::steady), "not assessed");
  EXPECT_TRUE(has(said(r), "not assessed: \"coupling\", nominal torque (steady)")) << said(r);
  EXPECT_FALSE(has(said(r), "all ")) << said(r);
  const SteadyStudy s = steady(scene, {scene.effects}, {.start_search = false});
  const std::vector<Verdict> by_steady = steady_ratings(s.cycles.back());
  EXPECT_EQ(state_of(by_steady, "nominal", load_case::steady), "holds");
  EXPECT_EQ(state_of(by_steady, "maximum", load_case::steady), "holds");
  EXPECT_EQ(state_of(by_steady, "maximum", load_case::start), "not assessed");
  const std::vector<Verdict> by_modes = find_modes(scene, scene.effects, {}).verdicts;
  for (const char* head : {"nominal", "maximum"})
    EXPECT_EQ(state_of(by_modes, head, load_case::steady), state_of(by_steady, head, load_case::steady)) << head;
  EXPECT_EQ(state_of(by_modes, "maximum", load_case::start), state_of(by_run, "maximum", load_case::start));
}

// Steel has no S_f: 20 Hz count as they are, and torques that are shown are torques.
TEST(Verdicts, FactorsStandBesideTorquesAndSteelHasNone) {
  const auto modes = [](const char* type) {
    const Scene scene = test::scene_from(fmt::format(R"(
      line = ["motor", "coupling", "wheel"]
      motor = {{ kind = "torque source", torque = "20 N*m", amplitude = "10 N*m", frequency = "40 Hz", inertia = "0.5 kg*m2" }}
      coupling = {{ kind = "coupling", stiffness = "2 kN*m/rad", relative_damping = 0.8, vibratory_torque = "30 N*m"{} }}
      wheel = {{ kind = "load", damping = "0.2 N*m*s/rad", inertia = "4 kg*m2" }}
      effects = {{ elasticity = true }}
      run = {{ until = "200 s" }}
    )",
                                                     type));
    for (const Verdict& v : find_modes(scene, scene.effects, {}).verdicts)
      if (v.requirement.starts_with("vibratory torque")) return v;
    throw std::logic_error("no verdict");
  };
  const Verdict rubber = modes(""), disc = modes(", type = \"disc\"");
  EXPECT_NEAR(rubber.factor, 2, 1e-3);  // √(40/10)
  EXPECT_NEAR(rubber.load(), disc.value, 1e-6 * disc.value);
  EXPECT_EQ(disc.factor, 1);
  EXPECT_EQ(disc.factors, "");
  EXPECT_THROW(compile(test::scene_from(R"(
    line = ["motor", "coupling", "wheel"]
    motor = { kind = "inertia", inertia = "1 kg*m2" }
    wheel = { kind = "inertia", inertia = "1 kg*m2" }
    coupling = { kind = "coupling", stiffness = "2 kN*m/rad", type = "gear", temperature_factor = 1.3 }
  )"),
                       {}),
               SceneError);
}

// A shaft that is too thin: the diameter that is stated was computed, and 1 % less does not hold.
TEST(Remedies, AreTriedBeforeTheyAreSaid) {
  const Scene scene = test::scene_from(rated_shaft("allowable_shear_stress = \"70 MPa\""));
  const Result bare = test::run(scene);
  const std::vector<Verdict> before = judge_ratings(bare);
  ASSERT_EQ(before.size(), 1u);
  ASSERT_EQ(before[0].state(), Compliance::exceeded);
  EXPECT_TRUE(has(before[0].note, "by an estimate it holds from diameter = ")) << before[0].note;
  Result run = bare;
  run.cpu_total = 60;  // for as many values as it takes
  const auto tried = with_trials(std::move(run), {});
  const std::vector<Verdict> after = judge_ratings(tried.study);
  ASSERT_TRUE(after[0].remedy && after[0].remedy->tried) << after[0].note;
  EXPECT_TRUE(has(after[0].note, "it holds from diameter = ")) << after[0].note;
  EXPECT_TRUE(has(after[0].note, "and does not 1 % below")) << after[0].note;
  for (const double factor : {1.0, 0.99}) {
    Scene other = scene;
    for (Section& s : other.components)
      for (Setting& setting : s.settings)
        if (s.name == "shaft" && setting.key == "diameter") setting.number = factor * after[0].remedy->value;
    EXPECT_EQ(judge_ratings(test::run(other))[0].holds(), factor == 1) << factor;
  }
}

}  // namespace
}  // namespace kurbel::claims_test
