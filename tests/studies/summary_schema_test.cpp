// summary_schema_test.cpp — what every command reports to programs is what docs/summary.schema.json says, nothing more.
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "drivetrain/gears/bevel_worm.h"
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
#include "tests/support/scenes.h"

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

// The part of JSON Schema that the file uses. Returns the first place that does not fit.
std::string misfit(const Json& rule, const Json& value, const std::string& at) {
  if (rule.contains("$ref"))
    return misfit(schema().at(Json::json_pointer(rule["$ref"].get<std::string>().substr(1))), value, at);
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

void expect_met(const std::string& verb, const Findings& findings) {
  expect_explained(verb, findings);
  test::expect_valid_conclusion(findings, verb);
  EXPECT_EQ(misfit(schema().at("$defs").at(verb), Json::parse(json_text(summary_of(findings))), verb), "");
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
  EXPECT_EQ(misfit(schema().at("$defs").at("report"), Json::parse(report.json()), "report"), "");
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
  EXPECT_EQ(misfit(schema().at("$defs").at("sweep"), Json::parse(json_text(summary_of(findings_of(sweep)))), "sweep"),
            "");

  MachineQuestion question;
  question.text = test::scene_file("scenes/crank_press.toml").text;
  question.file = "press.toml";
  question.settings = {"run.until=0.3 s", "flywheel.inertia={ value = \"420 kg*m2\", tolerance = \"5 %\" }"};
  const UncertaintyStudy uncertainty = study_uncertainty(
      question, {.figures = {"peak_torque"}, .limits = {"peak_torque.main_coupling <= 8 kN*m"}, .samples = 20});
  EXPECT_EQ(misfit(schema().at("$defs").at("uncertainty"), Json::parse(json_text(summary_of(findings_of(uncertainty)))),
                   "uncertainty"),
            "");
}

}  // namespace
}  // namespace kurbel::summary_schema_test
