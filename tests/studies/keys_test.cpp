// keys_test.cpp — the documents say what the reader does.
#include <cmath>
#include <fstream>
#include <numbers>
#include <regex>
#include <sstream>

#include "studies/run/compare.h"
#include "studies/run/run_findings.h"
#include "studies/scenes/kinds.h"
#include "tests/support/scenes.h"

namespace kurbel::keys_test {
namespace {

TEST(Documents, KeysAreThoseOfTheReader) {
  std::ifstream in(test::source_path("docs/keys.md"));
  std::stringstream text;
  text << in.rdbuf();
  EXPECT_EQ(text.str(), keys_in_markdown()) << "renew it: kurbel keys > docs/keys.md";
}

TEST(Documents, EveryFallbackIsWithinItsOwnDomain) {
  for (const Kind& kind : all_kinds())
    for (const Key& key : kind.keys) EXPECT_FALSE(key.doc.empty()) << kind.name << "." << key.name;
}

// The text of the first block of README.md behind these words.
std::string block_after(const std::string& text, const std::string& words) {
  const std::size_t begin = text.find('\n', text.find("```", text.find(words))) + 1;
  return text.substr(begin, text.find("```", begin) - begin);
}

std::string readme() {
  std::ifstream in(test::source_path("README.md"));
  std::stringstream text;
  text << in.rdbuf();
  return text.str();
}

// The small scene of README.md runs as it stands.
TEST(Documents, SceneOfTheReadmeRuns) {
  const Result r = test::run(test::scene_from(block_after(readme(), "A scene can be")));
  EXPECT_TRUE(r.complete) << r.diagnosis;
  EXPECT_TRUE(r.accuracy_confirmed);
}

// What stands behind "> " after these words, in one line.
std::string quote_after(const std::string& text, const std::string& words) {
  std::istringstream lines(text.substr(text.find(words) + words.size()));
  std::string quote;
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("> ")) quote += (quote.empty() ? "" : " ") + line.substr(2);
    if (line.empty() && !quote.empty()) break;
  }
  return quote;
}

std::string but_for_the_time(const std::string& text) {
  return std::regex_replace(text, std::regex("costs [0-9.]+ × the time"), "costs … × the time");
}

std::vector<std::string> sentences_of(const std::string& text) {
  std::vector<std::string> list;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t stop = text.find(". ", begin);
    const std::size_t end = stop == std::string::npos ? text.size() : stop + 1;
    list.push_back(text.substr(begin, end - begin));
    begin = end + 1;
  }
  return list;
}

// What the last place of a number as it is printed leaves open.
double rounding_of(const std::string& number) {
  const std::size_t point = number.find('.');
  return 0.5001 * std::pow(10, point == std::string::npos ? 0.0 : -static_cast<double>(number.size() - point - 1));
}

// What the first screen says of the press of its picture is true: its sentences, but for the time, and rows of
//     peak_torque.countershaft   5619.57473 ± 0.00001   8874.283 ± 0.003   N·m   1.579
// name, rigid, its error, elastic, its error, unit.
TEST(Documents, AnswerOfTheReadmeIsThatOfTheProgram) {
  const Scene scene = test::scene_file("docs/tasks/eccentric_press.toml");
  const Comparison both = compare(scene, models_to_compare(scene), {});
  const Result &rigid = both.a, &elastic = both.b;
  EXPECT_TRUE(elastic.complete) << elastic.diagnosis;
  EXPECT_TRUE(elastic.accuracy_confirmed);
  EXPECT_TRUE(rigid.accuracy_confirmed);
  const std::string said = but_for_the_time(findings_of(both).conclusion());
  for (const std::string& sentence : sentences_of(but_for_the_time(quote_after(readme(), "conclusion (shortened)"))))
    EXPECT_NE(said.find(sentence), std::string::npos) << sentence << "\nis not said in\n" << said;
  std::istringstream answer(block_after(readme(), "compare docs/tasks/eccentric_press.toml"));
  int rows = 0;
  for (std::string line; std::getline(answer, line);) {
    std::istringstream words(line);
    std::string name, sign, unit, rigid_text, elastic_text;
    double error_a = 0, error_b = 0;
    if (!(words >> name >> rigid_text >> sign >> error_a >> elastic_text >> sign >> error_b)) continue;
    const double a = std::stod(rigid_text), b = std::stod(elastic_text);
    error_a += rounding_of(rigid_text), error_b += rounding_of(elastic_text);
    words >> unit;
    const double in_unit = unit == "rpm" ? 30 / std::numbers::pi : 1;  // speeds stand in the scene's unit
    EXPECT_NEAR(in_unit * test::figure(rigid, name), a, error_a) << line;
    EXPECT_NEAR(in_unit * test::figure(elastic, name), b, error_b) << line;
    ++rows;
  }
  EXPECT_EQ(rows, 6);
}

// However many components a kind stands in, each of its tables is printed once.
TEST(Keys, AKindIsPrintedOnce) {
  for (const std::string& name : names_of_keys()) {
    const std::string text = keys_of(name), head = "\n" + name + " — ";
    for (std::size_t at = 0; at != std::string::npos; at = text.find(head, at + 1)) {
      const std::size_t end = text.find(head, at + 1);
      const std::string part = text.substr(at == 0 ? 0 : at + 1, end - (at == 0 ? 0 : at + 1));
      EXPECT_EQ(text.find(part, at + 2), std::string::npos) << name;
    }
  }
}

}  // namespace
}  // namespace kurbel::keys_test
