// summary_schema_test.cpp — what every command reports to programs is what docs/summary.schema.json says, nothing more.
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>
#include <vector>

#include "drivetrain/gears/bevel_worm.h"
#include "engine/scene/effects.h"
#include "studies/accuracy/accuracy.h"
#include "studies/advise/advise.h"
#include "studies/dictionary/dictionary.h"
#include "studies/effects/effect_study.h"
#include "studies/forces/forces_findings.h"
#include "studies/gears/bevel_worm.h"
#include "studies/gears/gears.h"
#include "studies/modes/modes.h"
#include "studies/question/question.h"
#include "studies/reduce/reduce.h"
#include "studies/run/run_findings.h"
#include "studies/size/size.h"
#include "studies/steady/steady.h"
#include "studies/sweep/sweep_findings.h"
#include "studies/uncertainty/uncertainty.h"
#include "tests/support/conclusions.h"
#include "tests/support/files.h"
#include "tests/support/program.h"
#include "tests/support/scenes.h"
#include "tests/support/thorough.h"

namespace kurbel::summary_schema_test {
namespace {

using Json = nlohmann::json;

const Json& schema() {
  static const Json read = Json::parse(std::ifstream(KURBEL_SOURCE_DIR "/docs/summary.schema.json"));
  return read;
}

bool is_of_type(const Json& value, const std::string& type) {
  if (type == "null") return value.is_null();
  if (type == "number") return value.is_number();
  if (type == "integer") return value.is_number_integer();
  if (type == "string") return value.is_string();
  if (type == "boolean") return value.is_boolean();
  return type == "array" ? value.is_array() : value.is_object();
}

Json::json_pointer place_of(const Json& ref) { return Json::json_pointer(ref.get<std::string>().substr(1)); }

// The part of JSON Schema that the file uses. Returns the first place that does not fit.
std::string misfit(const Json& rule, const Json& value, const std::string& at) {
  for (const auto& [keyword, meaning] : rule.items())
    if (static const std::set<std::string> known = {"$schema", "$defs", "title", "description", "$ref", "anyOf",
                                                    "const", "enum", "type", "required", "properties",
                                                    "additionalProperties", "items"};
        !known.contains(keyword))
      return at + ": the test does not know the keyword " + keyword;
  if (rule.contains("$ref")) return misfit(schema().at(place_of(rule["$ref"])), value, at);
  if (const Json any = rule.value("anyOf", Json::array()); !any.empty()) {
    const auto fits = [&](const Json& one) { return misfit(one, value, at).empty(); };
    if (std::none_of(any.begin(), any.end(), fits)) return at + " is none of those allowed";
  }
  if (const Json allowed = rule.value("enum", Json::array()); !allowed.empty())
    if (std::find(allowed.begin(), allowed.end(), value) == allowed.end()) return at + " is not of " + allowed.dump();
  if (rule.contains("const") && value != rule["const"]) return at + " is not " + rule["const"].dump();
  if (rule.contains("type")) {
    const Json types = rule["type"].is_array() ? rule["type"] : Json::array({rule["type"]});
    bool fits = false;
    for (const Json& type : types) fits = fits || is_of_type(value, type);
    if (!fits) return at + " is " + value.dump().substr(0, 40) + ", not " + types.dump();
  }
  for (const Json& key : rule.value("required", Json::array()))
    if (!value.contains(key)) return at + "/" + key.get<std::string>() + " is missing";
  const Json known = rule.value("properties", Json::object()), others = rule.value("additionalProperties", Json(true));
  if (value.is_object())
    for (const auto& [key, item] : value.items()) {
      if (!known.contains(key) && others == false) return at + "/" + key + " is not in the schema";
      if (known.contains(key) || others.is_object())
        if (std::string place = misfit(known.contains(key) ? known[key] : others, item, at + "/" + key); !place.empty())
          return place;
    }
  if (value.is_array() && rule.contains("items"))
    for (const Json& item : value)
      if (std::string place = misfit(rule["items"], item, at + "[]"); !place.empty()) return place;
  return {};
}

// Its key figures and its tables of figures say what they mean, and the dictionary knows that the command reports them.
void expect_explained(const std::string& verb, const Findings& findings) {
  for (const KeyFigure& figure : findings.figures) {
    const Definition* d = definition_of(figure.means);
    EXPECT_TRUE(d && d->is_printed_by(verb)) << verb << ": " << figure.name << " (" << figure.means << ")";
  }
  for (const Statement& s : findings.statements) {
    const Rows* rows = std::get_if<Rows>(&s.what);
    for (const std::string& name : rows ? rows->means : std::vector<std::string>{}) {
      const Definition* d = definition_of(name);
      EXPECT_TRUE(d && d->is_printed_by(verb)) << verb << ": " << name;
    }
  }
}

// What a program reads: it fits the command's own definition, and the file as a whole.
void expect_fits(const std::string& verb, const std::string& text, const std::string& of = "") {
  const Json value = Json::parse(text);
  EXPECT_EQ(misfit(schema().at("$defs").at(verb), value, verb), "") << of;
  EXPECT_EQ(misfit(schema(), value, verb), "") << of;
}

void expect_met(const std::string& verb, const Findings& findings) {
  expect_explained(verb, findings);
  test::expect_valid_conclusion(findings, verb);
  expect_fits(verb, json_text(summary_of(findings)));
}
template <class Study>
void expect_reported(const std::string& verb, const Study& study) {
  expect_met(verb, findings_of(study));
}

Scene short_press() {
  Scene scene = test::scene_file("scenes/crank_press.toml");
  scene.run.until = 1;
  return scene;
}

TEST(SummarySchema, HoldsForRunsAndComparisons) {
  const Scene scene = short_press();
  expect_reported("run", simulate(scene, scene.effects, "elastic", {}));
  SimulateOptions unsure;
  unsure.measure_error = false;
  expect_reported("run", simulate(test::scene_file("scenes/stick_slip.toml"), {}, "rigid", unsure));
  expect_reported("compare", compare(scene, {{}, scene.effects, "rigid", "elastic"}, unsure));
}

TEST(SummarySchema, HoldsForStudiesOfTheCycle) {
  const Scene scene = short_press();
  expect_reported("steady", steady(scene, {Effects{}, scene.effects}, {}));
  expect_reported("modes", find_modes(scene, scene.effects, {.torque = "main_coupling"}));
  expect_reported("forces", find_forces(scene, {}));
  expect_reported("forces", find_forces(test::scene_file("scenes/four_bar_rocker.toml"), {}));
  SizeOptions size;
  size.delta = 0.05;
  size.simulate = false;
  expect_reported("size", size_flywheel(scene, size));
  expect_reported("reduce", reduce(scene, {}));
  ReduceOptions to_the_slider;
  to_the_slider.to = "press.slider";
  expect_reported("reduce", reduce(scene, to_the_slider));
}

// Its figures are those of the questions that it asks, and are explained there.
TEST(SummarySchema, HoldsForTheReportOfATrain) {
  const Scene scene = test::scene_file("docs/tasks/gear_fan.toml");
  const StudyOutput report =
      question_named("report").answer({.scene = scene, .text = scene.text, .file = scene.file, .settings = {}}, {});
  test::expect_valid_conclusion(report, "report");
  expect_fits("report", report.json());
}

TEST(SummarySchema, HoldsForGears) {
  GearsOptions turning;
  turning.speed = 100;
  expect_reported("gears", find_gears(test::scene_file("scenes/gear_pair.toml"), turning));
  expect_reported("bevel_pair", BevelPair{.teeth = {19, 40}, .module = 0.004, .shaft_angle = 1.5});
  expect_met("worm_pair", findings_of(WormPair{.starts = 1, .teeth = 40, .module = 0.004, .worm_diameter = 0.05}, 150));
}

TEST(SummarySchema, HoldsForStudiesOfTheModel) {
  Scene scene = test::scene_file("scenes/stick_slip.toml");
  scene.run.until = 1;
  expect_reported("effects", study_effects(scene, {}));
  expect_reported("advise", advise(scene, {}));
  AccuracyOptions brief;
  brief.time = 0.1;
  expect_reported("accuracy", measure_accuracy(scene, brief));
}

// The check itself finds what is missing, unknown, or of another type.
TEST(SummarySchema, IsNotMetByWhatIsElse) {
  const Json& rule = schema().at("$defs").at("figure");
  const Json valid = {{"name", "a"}, {"value", 1.5}, {"unit", "m"}, {"error", nullptr}};
  EXPECT_EQ(misfit(rule, valid, ""), "");
  Json less = valid, more = valid, other = valid;
  less.erase("unit");
  more["colour"] = "red";
  other["value"] = "1.5 m";
  EXPECT_EQ(misfit(rule, less, ""), "/unit is missing");
  EXPECT_EQ(misfit(rule, more, ""), "/colour is not in the schema");
  EXPECT_NE(misfit(rule, other, ""), "");
}

// Their figures are those of the study that they ask, and are explained there.
TEST(SummarySchema, HoldsForSweepsAndTolerances) {
  SweepIdentity identity;
  identity.meta = {
      {"title", "Two masses"}, {"scene file", "two.toml"}, {"of", "run"}, {"design", "random:20"}, {"seed", "1"}};
  identity.parameters = {parse_parameter("a.b=1..2 m")};
  identity.figures = {{"peak_torque.c", "N*m"}};
  identity.rows = 20;
  std::vector<SweepRow> rows;
  for (std::size_t i = 0; i < 20; ++i)
    rows.push_back({.row = i,
                    .parameters = {1.0 + 0.05 * static_cast<double>(i)},
                    .figures = {{{3.0 * static_cast<double>(i)}, 0}}});
  rows[3].state = RowState::failed, rows[3].diagnosis = "it stops";
  const test::ScratchFolder folder;
  const std::filesystem::path file = folder / "sweep.db";
  SweepStore(file, identity).write(rows);
  const SweepStudyResult sweep = study_of(SweepStore(file), {"peak_torque.c <= 30 N*m"});
  expect_fits("sweep", json_text(summary_of(findings_of(sweep))));

  MachineQuestion question;
  question.text = test::scene_file("scenes/crank_press.toml").text;
  question.file = "press.toml";
  question.settings = {"run.until=0.3 s", "flywheel.inertia={ value = \"420 kg*m2\", tolerance = \"5 %\" }"};
  const UncertaintyStudy uncertainty = study_uncertainty(
      question, {.figures = {"peak_torque"}, .limits = {"peak_torque.main_coupling <= 8 kN*m"}, .samples = 20});
  expect_fits("uncertainty", json_text(summary_of(findings_of(uncertainty))));
}

// Answers of a command, as `--json` prints them.
void expect_answer_fits(const std::string& verb, const std::string& file, const GivenOptions& given) {
  const Scene scene = test::scene_file(file);
  const StudyOutput output =
      question_named(verb).answer({.scene = scene, .text = scene.text, .file = scene.file, .page = false}, given);
  expect_fits(verb, output.json(), file);
}

TEST(SummarySchema, HoldsForMeasuredRecords) {
  const test::ScratchFolder folder;
  const std::string file = (folder / "test.csv").string();
  std::ofstream(file) << "time [s],T1 [N*m]\n0,0\n0.1,120\n0.2,80\n0.3,10\n0.4,20\n";
  const GivenOptions laid_over = {{"measured", file}, {"map", "T1=torque.main_coupling"}, {"offset", "fit"}};
  GivenOptions of_run = laid_over;
  of_run.insert(of_run.end(), {{"until", "0.5 s"}, {"no_error", "true"}, {"no_trials", "true"}});
  expect_answer_fits("run", "scenes/crank_press.toml", of_run);
  expect_answer_fits("steady", "scenes/crank_press.toml", laid_over);
}

TEST(SummarySchema, HoldsForFits) {
  const std::string tasks = test::source_path("docs/tasks/");
  GivenOptions given = {{"measured", tasks + "fit_set_1500.csv"},
                        {"map", "c*=speed.engine"},
                        {"hold", "mean speed by load.torque"},
                        {"free", "rotor.inertia=0.05..0.8 kg*m2"},
                        {"free", "engine.crank_inertia=0..0.05 kg*m2"}};
  expect_answer_fits("fit", "docs/tasks/fit_set.toml", given);  // without orders: by frequency
  given.insert(given.end(), {{"orders", "0.5,1.5,2.5"},
                             {"predict", tasks + "fit_set.toml at 1200 rpm against " + tasks + "fit_set_1200.csv"}});
  expect_answer_fits("fit", "docs/tasks/fit_set.toml", given);
}

TEST(SummarySchema, HoldsForExports) {
  expect_answer_fits("export", "docs/tasks/hoist_control.toml",
                     {{"kind", "cs"}, {"input", "motor.command"}, {"parameter", "drum.inertia"}});
}

// Without a scene: the list, for people in words, for programs as data.
TEST(SummarySchema, HoldsForTheListOfEffects) {
  const test::Said said = test::said_by("'" KURBEL_EXECUTABLE "' effects --json");
  EXPECT_EQ(said.code, 0);
  expect_fits("effect_list", said.text);
  const Json effects = Json::parse(said.text).at("effects");
  EXPECT_EQ(effects[0]["effect"], "elasticity");
  EXPECT_EQ(effects.size(), effect_flags().size() + 1);
}

// Parts that few machines have: films of oil, cranks that rock. Thoroughly: all scenes.
TEST(SummarySchema, HoldsForTheScenesOfTheFolder) {
  std::vector<std::string> files = {"scenes/compressor.toml", "scenes/pendulum_balance.toml", "scenes/walking_leg.toml",
                                    "scenes/worn_crank_pin.toml", "scenes/wedge_lift.toml"};
  if (test::thorough()) {
    files.clear();
    for (const auto& entry : std::filesystem::directory_iterator(test::source_path("scenes")))
      if (entry.path().extension() == ".toml") files.push_back("scenes/" + entry.path().filename().string());
  }
  const std::vector<std::pair<std::string, GivenOptions>> asked = {
      {"forces", {{"no_run", "true"}}},
      {"reduce", {}},
      {"gears", {}},
      {"size", {{"delta", "0.02"}, {"no_run", "true"}}},
      {"modes", {{"spot_checks", "0"}, {"no_misfires", "true"}, {"cases", "none"}}},
      {"run", {{"no_error", "true"}, {"no_trials", "true"}}}};
  std::size_t answers = 0;
  for (const std::string& file : files)
    for (const auto& [verb, given] : asked) {
      if (verb == "run" && !test::thorough()) continue;
      try {
        expect_answer_fits(verb, file, given);
        ++answers;
      } catch (const std::invalid_argument&) {  // the machine has nothing of that kind
      }
    }
  EXPECT_GT(answers, 2 * files.size());
}

// What the schema itself refers to is there, once.
TEST(SummarySchema, RefersToWhatItDefines) {
  std::vector<std::set<std::string>> open;
  const auto once = [&](int, Json::parse_event_t event, Json& parsed) {
    if (event == Json::parse_event_t::object_start) open.emplace_back();
    if (event == Json::parse_event_t::object_end) open.pop_back();
    if (event == Json::parse_event_t::key) {
      EXPECT_TRUE(open.back().insert(parsed.get<std::string>()).second) << parsed << " stands twice in an object";
    }
    return true;
  };
  const Json read = Json::parse(std::ifstream(KURBEL_SOURCE_DIR "/docs/summary.schema.json"), once);
  std::set<std::string> named;
  const auto follow = [&](const auto& self, const Json& rule) -> void {
    if (rule.is_object() && rule.contains("$ref") && rule["$ref"].is_string()) {
      const Json::json_pointer place = place_of(rule["$ref"]);
      EXPECT_TRUE(read.contains(place)) << place;
      named.insert(place.to_string().substr(0, place.to_string().find('/', 7)));
    }
    if (rule.is_structured())
      for (const Json& part : rule) self(self, part);
  };
  follow(follow, read);
  for (const auto& [name, rule] : read.at("$defs").items()) EXPECT_TRUE(named.contains("/$defs/" + name)) << name;
  for (const Question& question : questions())
    if (question.of_scene) {
      EXPECT_TRUE(named.contains("/$defs/" + question.name)) << question.name;
    }
}

}  // namespace
}  // namespace kurbel::summary_schema_test
