#include "tests/support/validation.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <map>
#include <string_view>
#include <vector>

namespace kurbel::test {
namespace {

const char* const page = KURBEL_SOURCE_DIR "/docs/validation.md";
const char* const chapters[] = {"Published numbers", "Closed forms", "References of the tests' own"};

struct Row {
  Against against;
  std::string source, test, what;
  std::vector<std::string> cells;  // expected, found, its error, difference, allowed

  std::string key() const { return source + " | " + what; }
};

// Digits that distinguish a number within the allowed difference, and one more.
std::string up_to(double value, double within) {
  if (within <= 0 || value == 0) return fmt::format("{}", value);
  const int digits = static_cast<int>(std::floor(std::log10(std::abs(value))) - std::floor(std::log10(within))) + 2;
  return fmt::format("{:.{}g}", value, std::clamp(digits, 3, 16));
}

// A number as given or, if computed, with the digits compared.
std::string as_given(double value, double within) {
  const std::string shortest = fmt::format("{}", value);
  return std::count_if(shortest.begin(), shortest.end(), [](char c) { return c >= '0' && c <= '9'; }) <= 13
             ? shortest
             : up_to(value, 0.1 * within);
}

std::vector<std::string> cells_of(const std::string& line) {
  std::vector<std::string> cells;
  for (std::size_t from = line.find('|'); from != std::string::npos;) {
    const std::size_t to = line.find('|', from + 1);
    if (to == std::string::npos) break;
    const std::size_t first = line.find_first_not_of(' ', from + 1), last = line.find_last_not_of(' ', to - 1);
    cells.push_back(first < to ? line.substr(first, last - first + 1) : "");
    from = to;
  }
  return cells;
}

// Rows of the existing page, by source and quantity: expected and found.
const std::map<std::string, std::pair<std::string, std::string>>& rows_of_the_page() {
  static const auto rows = [] {
    std::map<std::string, std::pair<std::string, std::string>> found;
    std::ifstream in(page);
    std::string line, source;
    while (std::getline(in, line)) {
      if (line.starts_with("### ")) source = line.substr(4);
      const std::vector<std::string> cells = cells_of(line);
      if (cells.size() == 6) found[source + " | " + cells[0]] = {cells[1], cells[2]};
    }
    return found;
  }();
  return rows;
}

// The row on the page must equal this test's result.
void expect_on_the_page(const Row& row, double found, double within) {
  const auto at = rows_of_the_page().find(row.key());
  if (at == rows_of_the_page().end()) {
    ADD_FAILURE() << "docs/validation.md has no row \"" << row.key() << "\"; scripts/renew-docs writes it";
    return;
  }
  const auto& [expected, printed] = at->second;
  EXPECT_EQ(expected, row.cells[0]) << row.key() << ": docs/validation.md is out of date; scripts/renew-docs";
  EXPECT_LE(std::abs(std::strtod(printed.c_str(), nullptr) - found), 0.3 * within)
      << row.key() << ": docs/validation.md says " << printed << ", the test finds " << row.cells[1];
}

// Collects rows, and writes them as Markdown when the program ends, where KURBEL_VALIDATION names a file.
class Page : public ::testing::Environment {
 public:
  static Page& instance() {
    static Page* const made = new Page;
    return *made;
  }
  void add(Row row) {
    for (const Row& other : rows_)
      if (other.key() == row.key() && (other.test != row.test || other.cells != row.cells))
        ADD_FAILURE() << "two numbers with one name: " << row.key();
    rows_.push_back(std::move(row));
  }
  void TearDown() override {
    if (const char* const file = std::getenv("KURBEL_VALIDATION")) write(file);
  }

 private:
  using BySource = std::map<std::string, std::vector<const Row*>>;

  void write(const char* file) const {
    std::ofstream out(file);
    std::map<Against, BySource> all;
    for (const Row& row : rows_) all[row.against][row.source].push_back(&row);
    out << "| against | sources | numbers |\n|---|--:|--:|\n";
    for (const auto& [against, sources] : all) {
      std::size_t numbers = 0;
      for (const auto& [source, rows] : sources) numbers += rows.size();
      out << fmt::format("| {} | {} | {} |\n", chapters[static_cast<int>(against)], sources.size(), numbers);
    }
    out << '\n';
    for (const auto& [against, sources] : all) {
      out << fmt::format("## {}\n\n", chapters[static_cast<int>(against)]);
      for (const auto& [source, rows] : sources) write_source(out, source, rows);
    }
  }
  static void write_source(std::ofstream& out, const std::string& source, const std::vector<const Row*>& rows) {
    std::string tests;
    for (const Row* row : rows)
      if (const std::string name = fmt::format("`{}`", row->test); tests.find(name) == std::string::npos)
        tests += (tests.empty() ? "" : ", ") + name;
    out << fmt::format("### {}\n\nHeld by {}.\n\n", source, tests);
    out << "| quantity | expected | kurbel | its error | difference | allowed |\n|---|--:|--:|--:|--:|--:|\n";
    for (const Row* row : rows) {
      out << "| " << row->what;
      for (const std::string& cell : row->cells) out << " | " << cell;
      out << " |\n";
    }
    out << '\n';
  }
  std::vector<Row> rows_;
};

const auto* const registered = ::testing::AddGlobalTestEnvironment(&Page::instance());

}  // namespace

void Validation::near(const std::string& what, const std::string& unit, double found, double expected, double within,
                      std::optional<double> error) const {
  EXPECT_NEAR(found, expected, within) << source_ << ": " << what;
  const auto* const test = ::testing::UnitTest::GetInstance()->current_test_info();
  const double difference = found - expected;
  const Row row{against_,
                source_,
                fmt::format("{}.{}", test->test_suite_name(), test->name()),
                unit.empty() ? what : fmt::format("{} [{}]", what, unit),
                {as_given(expected, within), up_to(found, within), error ? fmt::format("{:.0e}", *error) : "—",
                 difference == 0 ? "0" : fmt::format("{:+.0e}", difference), fmt::format("{:.0e}", within)}};
  Page::instance().add(row);
  if (!std::getenv("KURBEL_VALIDATION")) expect_on_the_page(row, found, within);
}

void Validation::close(const std::string& what, const std::string& unit, double found, double expected, double relative,
                       std::optional<double> error) const {
  near(what, unit, found, expected, relative * std::abs(expected), error);
}

void Validation::near(const std::string& what, const std::string& unit, double scale, const Figure* figure,
                      double expected, double within) const {
  ASSERT_NE(figure, nullptr) << source_ << ": " << what;
  const std::optional<double> error = figure->error ? std::optional(*figure->error / scale) : std::nullopt;
  near(what, unit, figure->value / scale, expected, within, error);
}

}  // namespace kurbel::test
