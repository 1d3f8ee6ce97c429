// train_report_test.cpp — kurbel report says what its questions say, word for word, each once, in the order of its sections;
// Markdown and JSON are of the same document.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>

#include "studies/findings/figure_text.h"
#include "studies/limits/limits_findings.h"
#include "studies/question/question.h"
#include "studies/train_report/sections.h"
#include "tests/support/scenes.h"

namespace kurbel::train_report_test {
namespace {

using Json = nlohmann::json;

struct Asked {
  Scene scene = test::scene_file("docs/tasks/gear_fan.toml");
  Inquiry inquiry{.scene = scene, .text = scene.text, .file = scene.file, .settings = {}, .author = "A. Engineer"};
  StudyOutput answer(const std::string& question, const GivenOptions& given = {}) const {
    return question_named(question).answer(inquiry, given);
  }
};

// Tables by their titles.
std::multimap<std::string, const Table*> tables_of(const Report& page) {
  std::multimap<std::string, const Table*> tables;
  for (const ReportSection& section : page.sections)
    for (const Card& card : section.cards)
      if (const Table* table = std::get_if<Table>(&card)) tables.emplace(table->title, table);
  return tables;
}

TEST(TrainReport, SaysWhatItsQuestionsSay) {
  const Asked asked;
  const StudyOutput report = asked.answer("report", {{"document", "4711"}, {"revision", "B"}});
  const Report page = report.report(), modes = asked.answer("modes").report();
  ASSERT_EQ(page.sections.size(), train_report::section_names.size());
  for (std::size_t s = 0; s < page.sections.size(); ++s)
    EXPECT_EQ(page.sections[s].title, train_report::section_names[s].title);
  EXPECT_EQ(page.subtitle, "document 4711 · revision B · by A. Engineer");
  const auto here = tables_of(page);
  for (const auto& [title, table] : tables_of(modes)) {
    const auto [first, last] = here.equal_range(title);
    EXPECT_TRUE(std::any_of(first, last, [t = table](const auto& other) {
      return other.second->columns == t->columns && other.second->rows == t->rows && !other.second->folded;
    })) << title;
  }
  // Each table once, the appendix holds all figures and the scene.
  for (const char* title : {"Natural frequencies, damping, energies", "Separation margins", "Scope"})
    EXPECT_EQ(here.count(title), 1U) << title;
  const auto& input = page.sections.back().cards;
  EXPECT_TRUE(std::any_of(input.begin(), input.end(), [&](const Card& card) {
    const Text* text = std::get_if<Text>(&card);
    return text && text->body == asked.scene.text && !text->folded;
  }));

  // Markdown and JSON: the same tables and the same conclusion.
  const Json json = Json::parse(report.json());
  EXPECT_EQ(json["conclusion"], report.conclusion());
  EXPECT_EQ(json["document"]["number"], "4711");
  EXPECT_EQ(json["modes"]["conclusion"], asked.answer("modes").conclusion());
  ASSERT_EQ(report.files.size(), 1U);
  const std::string& markdown = report.files.front().second;
  for (std::size_t s = 0; s < page.sections.size(); ++s) {
    EXPECT_EQ(json["sections"][s]["title"], page.sections[s].title);
    ASSERT_EQ(json["sections"][s]["parts"].size(), page.sections[s].cards.size());
    EXPECT_NE(markdown.find("## " + page.sections[s].title), std::string::npos);
    for (std::size_t k = 0; k < page.sections[s].cards.size(); ++k)
      if (const Table* table = std::get_if<Table>(&page.sections[s].cards[k])) {
        EXPECT_EQ(json["sections"][s]["parts"][k]["rows"].size(), table->rows.size());
        EXPECT_NE(markdown.find(table->title), std::string::npos) << table->title;
      }
  }
}

// Referred to the motor by the square of the ratio: J i², k i².
TEST(TrainReport, RefersTheTrainToOneShaft) {
  const Asked asked;
  const StudyOutput report = asked.answer("report", {{"sections", "train"}});
  const Report page = report.report();
  const auto tables = tables_of(page);
  const auto found =
      std::find_if(tables.begin(), tables.end(), [](const auto& t) { return t.first.starts_with("Drive as"); });
  ASSERT_NE(found, tables.end());
  const auto fan = std::find_if(found->second->rows.begin(), found->second->rows.end(),
                                [](const auto& row) { return row[1].find("fan") != std::string::npos; });
  ASSERT_NE(fan, found->second->rows.end());
  const auto cell = [&](const char* column) {
    const auto& columns = found->second->columns;
    return std::stod(
        fan->at(static_cast<std::size_t>(std::find(columns.begin(), columns.end(), column) - columns.begin())));
  };
  const double own = cell("own"), ratio = cell("speed ratio i"), reduced = cell("reduced");
  EXPECT_NEAR(ratio, 31.0 / 93, 1e-6);
  EXPECT_NEAR(reduced, own * ratio * ratio, 1e-5 * reduced);
  EXPECT_NEAR(own, 140, 0.5);  // and half of its shaft
}

// Of limits that the run leaves open and `modes` assesses, the document says the verdict alone; one that both judge alike
// stands once in its conclusion.
TEST(TrainReport, ContradictsItselfInNoLimit) {
  const Scene scene = test::scene_file("docs/tasks/two_cylinder_compressor.toml");
  const StudyOutput report =
      question_named("report").answer({.scene = scene, .text = scene.text, .file = scene.file, .settings = {}}, {});
  const Report page = report.report();
  std::size_t tables = 0;
  for (const auto& [title, table] : tables_of(page))
    if (title.starts_with("Limits of the components")) {
      ++tables;
      for (const auto& row : table->rows)
        for (const auto& cell : row) EXPECT_EQ(cell.find("not assessed"), std::string::npos) << title << ": " << row[0];
    }
  EXPECT_EQ(tables, 2u);
  const std::string said = report.conclusion();
  EXPECT_EQ(said.find("that is assessed"), std::string::npos) << said;
}

// What the run leaves open and `modes` assesses is not "not assessed", neither in the conclusion nor in the list.
TEST(TrainReport, CallsNoLimitOpenThatOneOfItsPartsAssesses) {
  using train_report::Part;
  const auto part = [](const char* question, const char* key, const std::vector<Verdict>& verdicts) {
    Part made{question};
    Findings& f = made.output;
    Rows rows = verdict_table(verdicts);
    rows.key = key;
    f.say(f.chapter("limits"), std::move(rows));
    f.claim(limit_claims(verdicts, "limit"));
    return made;
  };
  const auto open = [](const char* requirement) {
    return not_assessed("shaft", requirement, 30e6, "Pa", load_case::steady, "kurbel modes");
  };
  Verdict held{{10e6, 0}, "shaft", requirement::continuous, 30e6, "Pa", ""};
  held.load_case = load_case::steady;
  const auto text_of = [](const std::vector<Part>& parts) {
    std::string text;
    for (const std::string& sentence : concluded(train_report::claims_of(parts))) text += sentence + "\n";
    for (const std::string& line : train_report::not_assessed(parts)) text += line + "\n";
    return text;
  };
  const Part modes = part("modes", "verdicts", {held});
  const std::string judged = text_of({modes, part("compare", "ratings", {open(requirement::continuous)})});
  EXPECT_EQ(judged, "Its limit holds, \"shaft\", UR M68, continuous (steady): 33 % of the limit.\n");
  const std::string one = text_of(
      {modes, part("compare", "ratings", {open(requirement::continuous), open(requirement::vibratory_stress)})});
  EXPECT_NE(one.find("Not assessed: \"shaft\", vibratory stress (steady)."), std::string::npos) << one;
  EXPECT_EQ(one.find("more"), std::string::npos) << one;
  Verdict other = held;
  other.component = "coupling", other.load_case = load_case::run;
  const std::string mixed = text_of({modes, part("compare", "ratings", {other, open(requirement::continuous)})});
  EXPECT_NE(mixed.find("The one limit holds"), std::string::npos) << mixed;
  EXPECT_EQ(mixed.find("ssessed"), std::string::npos) << mixed;
  other.value = 40e6;
  const std::string beyond = text_of({modes, part("compare", "ratings", {other})});
  EXPECT_NE(beyond.find("In the frequency domain its limit holds"), std::string::npos) << beyond;
}

TEST(TrainReport, SaysWhatWasNotAssessed) {
  const Asked asked;
  const auto open = [](const StudyOutput& output) {
    return Json::parse(output.json())["not_assessed"].get<std::vector<std::string>>();
  };
  const auto says = [](const std::vector<std::string>& lines, const std::string& words) {
    return std::any_of(lines.begin(), lines.end(),
                       [&](const std::string& line) { return line.find(words) != std::string::npos; });
  };
  const std::vector<std::string> few = open(asked.answer("report", {{"sections", "scope,margins"}, {"cases", "none"}}));
  EXPECT_TRUE(says(few, "omitted by --sections: train, modes, response, time, assumptions, input"));
  EXPECT_TRUE(says(few, "omitted by --cases"));
  EXPECT_TRUE(says(few, "pairs of a mode and an excitation"));
  const Scene rigid = test::scene_from(R"(
line = ["motor", "fan"]
motor = { kind = "torque source", torque = "20 N*m", inertia = "1 kg*m2" }
fan = { kind = "load", damping = "0.2 N*m*s/rad", inertia = "1 kg*m2" }
run = { until = "1 s" }
)");
  const StudyOutput output =
      question_named("report").answer({.scene = rigid, .text = rigid.text, .file = rigid.file, .settings = {}}, {});
  const std::vector<std::string> lines = open(output);
  EXPECT_TRUE(says(lines, "Results of kurbel modes: "));
  EXPECT_TRUE(says(lines, "range of operating speeds"));
  EXPECT_TRUE(says(lines, "the scene names none ([[case]])"));
  EXPECT_THROW(asked.answer("report", {{"sections", "margin"}}), std::invalid_argument);
}

// Nothing is elastic: no comparison with an elastic machine, no model of that name, and a word for every empty section.
TEST(TrainReport, OfAMachineWithoutElasticPartComparesNothing) {
  const Scene rigid = test::scene_from(R"(
line = ["motor", "fan"]
motor = { kind = "torque source", torque = "20 N*m", inertia = "1 kg*m2" }
fan = { kind = "load", damping = "0.2 N*m*s/rad", inertia = "1 kg*m2" }
run = { until = "1 s" }
)");
  const StudyOutput output =
      question_named("report").answer({.scene = rigid, .text = rigid.text, .file = rigid.file, .settings = {}}, {});
  const std::string& markdown = output.files.front().second;
  for (const char* words : {"against elastic", "elastic machine |", "Same model", "same model", "Both models"})
    EXPECT_EQ(markdown.find(words), std::string::npos) << words;
  EXPECT_NE(markdown.find("| verdict | none is possible: the scene states no limit"), std::string::npos);
  const Report page = output.report();
  ASSERT_EQ(page.sections.size(), train_report::section_names.size());
  for (const ReportSection& section : page.sections) EXPECT_FALSE(section.cards.empty()) << section.title;
  const Text* const modes = std::get_if<Text>(&page.sections[2].cards.front());
  ASSERT_TRUE(modes);
  EXPECT_EQ(modes->body, "Does not apply: the machine has no elastic part.");
  EXPECT_TRUE(Json::parse(output.json()).contains("run"));
}

// Of a customer's report: no hint at an option, no more than four digits in its tiles.
TEST(TrainReport, HasNoHintsForTheAnalyst) {
  Asked asked;
  asked.scene = test::scene_file("docs/tasks/ship_shaft_line.toml");
  const Scene& scene = asked.scene;
  const Inquiry inquiry{.scene = scene, .text = scene.text, .file = scene.file, .settings = {}, .author = ""};
  const auto said = [&](const char* question, const GivenOptions& given) {
    return page_of(question_named(question).answer(inquiry, given));
  };
  const auto hints = [](const Report& page) {
    int count = 0;
    for (const ReportSection& section : page.sections)
      for (const Card& card : section.cards)
        if (const Text* text = std::get_if<Text>(&card); text && !text->verbatim)
          count += text->body.find("; --") != std::string::npos || text->body.find("samples = ") != std::string::npos;
    return count;
  };
  const Report report = said("report", {{"cases", "none"}, {"sections", "modes,assumptions"}});
  EXPECT_GT(hints(said("modes", {{"cases", "none"}, {"no_misfires", ""}, {"spot_checks", "0"}})), 0);
  EXPECT_EQ(hints(report), 0);
  ASSERT_GE(report.figures.size(), 4u);
  for (const KeyFigure& figure : report.figures) {
    EXPECT_TRUE(tile_text(figure, figure.digits).known.empty()) << figure.name;
    EXPECT_FALSE(figure.error) << figure.name;
    EXPECT_EQ(figure.name.find("peak torque"), std::string::npos) << figure.name;  // of the start's vibration
  }
}

}  // namespace
}  // namespace kurbel::train_report_test
