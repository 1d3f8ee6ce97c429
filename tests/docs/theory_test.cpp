// theory_test.cpp — citations of docs/theory lead somewhere: in one form, to a page and an equation that exist.
//
//     page       # 5 Title                      in docs/theory/05-name.md
//     equation   <a id="eq-5.1"></a>, then a block whose label, 5.1 in parentheses, ends a line
//     citation   theory 5.1 · theory 2.1, 2.2 and 5 · on the pages themselves its label and page 5
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "studies/findings/report.h"
#include "studies/report/render.h"
#include "studies/report/theory.h"

namespace kurbel::theory_test {
namespace {

namespace fs = std::filesystem;

const fs::path root = KURBEL_SOURCE_DIR;
const fs::path folder = root / "docs/theory";

using Faults = std::vector<std::string>;

std::string content_of(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  EXPECT_TRUE(in) << file;
  return {std::istreambuf_iterator<char>(in), {}};
}

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines(1);
  for (const char c : text)
    if (c == '\n')
      lines.emplace_back();
    else
      lines.back() += c;
  return lines;
}

bool is_digit(char c) { return c >= '0' && c <= '9'; }
char at(const std::string& text, std::size_t i) { return i < text.size() ? text[i] : '\0'; }

// "12" or "12.3" that begins here; empty: no number. Two digits at most on either side: 0.25 and 1998 are none.
std::string number_at(const std::string& text, std::size_t begin) {
  std::size_t end = begin;
  while (is_digit(at(text, end))) ++end;
  if (end == begin || end > begin + 2 || text[begin] == '0') return {};
  if (at(text, end) != '.' || !is_digit(at(text, end + 1))) return text.substr(begin, end - begin);
  std::size_t after = end + 1;
  while (is_digit(at(text, after))) ++after;
  return after > end + 3 ? std::string() : text.substr(begin, after - begin);
}

std::size_t behind(const std::string& text, std::size_t begin, std::string_view skipped) {
  return std::min(text.find_first_not_of(skipped, begin), text.size());
}

// All numbers of a list "2.1, 2.2 and 5" that begins here.
std::vector<std::string> list_at(const std::string& text, std::size_t begin) {
  std::vector<std::string> numbers;
  for (std::size_t here = begin;;) {
    const std::string number = number_at(text, here);
    if (number.empty()) return numbers;
    numbers.push_back(number);
    here += number.size();
    const std::size_t gap = text.compare(here, 2, ", ") == 0 ? 2 : text.compare(here, 5, " and ") == 0 ? 5 : 0;
    if (gap == 0) return numbers;
    here += gap;
  }
}

struct Theory {
  std::map<std::string, std::string> title;  // by the page's number
  std::set<std::string> equation, figure;    // "5.1"; "twist.svg", as the pages name them
  Faults faults;

  bool has(const std::string& number) const { return title.contains(number) || equation.contains(number); }
  void read_page(const std::string& name, const std::string& text);
  void check_references(const std::string& name, const std::string& text);
};

// Heading, equations, figures.
void Theory::read_page(const std::string& name, const std::string& text) {
  const std::vector<std::string> lines = lines_of(text);
  const std::string number = number_at(lines[0], 2);
  if (!lines[0].starts_with("# ") || number.empty() || number.find('.') != std::string::npos)
    return faults.push_back(name + ": the first line must be \"# NUMBER Title\"");
  if (std::stoi(number) != std::stoi(name)) faults.push_back(name + ": file and heading have different numbers");
  if (!title.emplace(number, lines[0].substr(3 + number.size())).second)
    faults.push_back(name + ": page " + number + " is there twice");
  std::multiset<std::string> anchors, labels;
  for (const std::string& line : lines) {
    const std::string anchor = "<a id=\"eq-";
    if (line.starts_with(anchor))
      anchors.insert(line.substr(anchor.size(), line.find('"', anchor.size()) - anchor.size()));
    const std::size_t open = line.rfind('(');
    if (line.starts_with("    ") && open != std::string::npos) {
      const std::string label = number_at(line, open + 1);
      if (label.find('.') != std::string::npos && line.substr(open + 1) == label + ")") labels.insert(label);
    }
    for (std::size_t image = line.find("!["); image != std::string::npos; image = line.find("![", image + 1)) {
      const std::size_t begin = line.find("](", image) + 2;
      figure.insert(line.substr(begin, line.find(')', begin) - begin));
    }
  }
  if (anchors != labels) faults.push_back(name + ": every equation needs one anchor eq-N.M and one label (N.M)");
  for (const std::string& label : labels) {
    if (!label.starts_with(number + ".")) faults.push_back(name + ": (" + label + ") belongs on another page");
    if (!equation.insert(label).second) faults.push_back(name + ": (" + label + ") is defined twice");
  }
}

// Labels, lists of them, "page 5", "pages 2, 3" on a page.
void Theory::check_references(const std::string& name, const std::string& page) {
  std::string text = page;
  std::replace(text.begin(), text.end(), '\n', ' ');
  const auto check = [&](const std::vector<std::string>& numbers, bool equations) {
    for (const std::string& number : numbers)
      if (equations ? !equation.contains(number) : !title.contains(number))
        faults.push_back(name + ": " + (equations ? "(" + number + ")" : "page " + number) + " is nowhere");
  };
  for (std::size_t open = text.find('('); open != std::string::npos; open = text.find('(', open + 1)) {
    const std::vector<std::string> numbers = list_at(text, open + 1);
    if (numbers.empty() || numbers.front().find('.') == std::string::npos) continue;
    std::size_t length = 2 * numbers.size() - 2;
    for (const std::string& number : numbers) length += number.size();
    if (at(text, open + 1 + length) == ')') check(numbers, true);
  }
  for (const std::string word : {"page ", "pages "})
    for (std::size_t here = text.find(word); here != std::string::npos; here = text.find(word, here + 1))
      check(list_at(text, here + word.size()), false);
}

Theory read_theory() {
  Theory theory;
  std::map<std::string, std::string> pages;
  for (const auto& entry : fs::directory_iterator(folder)) {
    const std::string name = entry.path().filename().string();
    if (entry.path().extension() == ".md" && name != "README.md") pages[name] = content_of(entry.path());
  }
  for (const auto& [name, text] : pages) theory.read_page(name, text);
  for (const auto& [name, text] : pages) theory.check_references(name, text);
  return theory;
}

// --- citations in the sources ---

// What cites the theory in another form than "theory 5.1", or what is not there.
Faults faults_of_citations(const std::string& text, const Theory& theory) {
  Faults faults;
  std::string small = text;
  std::transform(small.begin(), small.end(), small.begin(), [](unsigned char c) { return std::tolower(c); });
  for (std::size_t here = small.find("theory"); here != std::string::npos; here = small.find("theory", here + 1)) {
    std::size_t end = behind(text, here + 6, " ,:(\n");
    if (text.compare(end, 2, "//") == 0) end = behind(text, end + 2, " ");  // on the comment's next line
    if (number_at(text, end).empty()) continue;                             // a word
    if (text.compare(here, 7, "theory ") != 0 || end != here + 7) {
      faults.push_back("\"" + text.substr(here, end - here + 4) + "\": write \"theory N.M\" on one line");
      continue;
    }
    for (const std::string& number : list_at(text, end))
      if (!theory.has(number)) faults.push_back("theory " + number + " is nowhere in docs/theory");
  }
  return faults;
}

// The label of an equation in a comment, which does not say of what.
Faults bare_numbers(const std::string& text, const Theory& theory) {
  Faults faults;
  for (const std::string& line : lines_of(text)) {
    const std::size_t comment = line.find("//");
    if (comment == std::string::npos) continue;
    for (std::size_t open = line.find('(', comment); open != std::string::npos; open = line.find('(', open + 1)) {
      const std::string number = number_at(line, open + 1);
      const bool called =
          open > 0 && (std::isalnum(static_cast<unsigned char>(line[open - 1])) || line[open - 1] == '_');
      if (!called && theory.equation.contains(number) && at(line, open + 1 + number.size()) == ')')
        faults.push_back("(" + number + ") in a comment: write theory " + number);
    }
  }
  return faults;
}

std::vector<fs::path> sources() {
  const std::set<std::string> kinds = {".h", ".cpp", ".md", ".toml", ".json", ".js", ".mjs", ".py", ".html", ".1"};
  const std::set<std::string> omitted = {"build", "results", "vendor", ".git", ".cache"};
  std::vector<fs::path> files;
  for (auto entry = fs::recursive_directory_iterator(root); entry != fs::recursive_directory_iterator(); ++entry) {
    if (entry->is_directory() && (omitted.contains(entry->path().filename().string()) || entry->path() == folder))
      entry.disable_recursion_pending();
    else if (entry->is_regular_file() && kinds.contains(entry->path().extension().string()))
      files.push_back(entry->path());
  }
  return files;
}

std::string joined(const Faults& faults) {
  std::string text;
  for (const std::string& fault : faults) text += fault + "\n";
  return text;
}

}  // namespace

TEST(Theory, EveryEquationIsDefinedOnceAndEveryReferenceOnItsPagesResolves) {
  const Theory theory = read_theory();
  EXPECT_GE(theory.title.size(), 15u);
  EXPECT_GE(theory.equation.size(), 100u);
  EXPECT_TRUE(theory.faults.empty()) << joined(theory.faults);
}

TEST(Theory, EveryCitationOfTheSourcesResolves) {
  const Theory theory = read_theory();
  std::size_t citing = 0;
  for (const fs::path& file : sources()) {
    const std::string text = content_of(file);
    citing += text.find("theory ") != std::string::npos;
    Faults faults = faults_of_citations(text, theory);
    if (file.extension() == ".h" || file.extension() == ".cpp")
      for (const std::string& fault : bare_numbers(text, theory)) faults.push_back(fault);
    EXPECT_TRUE(faults.empty()) << file << ":\n" << joined(faults);
  }
  EXPECT_GT(citing, 40u);  // the sources were found
}

TEST(Theory, FiguresThatPagesNameAreThereAndNoneIsLeftOver) {
  const Theory theory = read_theory();
  for (const auto& entry : fs::directory_iterator(folder)) {
    const std::string name = entry.path().filename().string();
    if (entry.path().extension() != ".svg") continue;
    EXPECT_TRUE(theory.figure.contains(name)) << name << ": no page shows it";
  }
  for (const std::string& name : theory.figure) EXPECT_TRUE(fs::exists(folder / name)) << name << " is not there";
}

// The table of contents links every page by its number and the beginning of its title; reports know the same titles.
TEST(Theory, TableOfContentsAndReportsKnowEveryPage) {
  const Theory theory = read_theory();
  const std::string contents = content_of(folder / "README.md");
  std::size_t pages = 0;
  for (const auto& entry : fs::directory_iterator(folder)) {
    const std::string name = entry.path().filename().string();
    if (entry.path().extension() != ".md" || name == "README.md") continue;
    ++pages;
    const std::size_t link = contents.find("](" + name + ")");
    ASSERT_NE(link, std::string::npos) << name << " is missing in the table of contents";
    const std::size_t open = contents.rfind('[', link) + 1;
    const std::string words = contents.substr(open, link - open), number = number_at(words, 0);
    ASSERT_TRUE(theory.title.contains(number)) << words;
    EXPECT_TRUE((number + " " + theory.title.at(number)).starts_with(words)) << words;
    const TheoryPage* page = theory_page(std::stoi(number));
    ASSERT_NE(page, nullptr) << number;
    EXPECT_EQ(number + " " + std::string(page->title), words);
    EXPECT_EQ(page->file, "docs/theory/" + name);
  }
  EXPECT_EQ(theory_page(static_cast<int>(pages) + 1), nullptr);
}

// What is broken on purpose is found.
TEST(Theory, BrokenCitationsPagesAndFiguresAreFound) {
  const std::string word = "theory ";
  const auto faults_of = [](const std::map<std::string, std::string>& pages) {
    Theory theory;
    for (const auto& [name, text] : pages) theory.read_page(name, text);
    for (const auto& [name, text] : pages) theory.check_references(name, text);
    return theory;
  };
  const std::string equation = "<a id=\"eq-1.1\"></a>\n\n    a = b                 (1.1)\n";
  const Theory valid = faults_of({{"01-a.md", "# 1 Signs\n" + equation + "by (1.1), page 1\n![x](x.svg)\n"}});
  EXPECT_TRUE(valid.faults.empty()) << joined(valid.faults);
  EXPECT_TRUE(valid.figure.contains("x.svg"));
  const auto count = [&](const std::string& page) { return faults_of({{"01-a.md", page}}).faults.size(); };
  EXPECT_EQ(count("# 1 Signs\n" + equation + equation), 1u);                            // twice
  EXPECT_EQ(count("# 1 Signs\n" + equation + "by (1.2)"), 1u);                          // no such equation
  EXPECT_EQ(count("# 1 Signs\n" + equation + "by (1.1, 3.4), page 7"), 2u);             // nor page
  EXPECT_EQ(count("# 1 Signs\n    a = b       (1.1)\n"), 1u);                           // no anchor
  EXPECT_EQ(count("# 2 Signs\n<a id=\"eq-1.1\"></a>\n\n    a = b       (1.1)\n"), 2u);  // number, other page
  EXPECT_TRUE(faults_of_citations("// (" + word + "1.1), " + word + "1", valid).empty());
  EXPECT_TRUE(faults_of_citations("a theory of 1998", valid).empty());
  EXPECT_EQ(faults_of_citations("// (" + word + "1.1, 1.2)", valid).size(), 1u);
  EXPECT_EQ(faults_of_citations("// " + word + "99", valid).size(), 1u);
  // Other forms, taken apart so that this file does not cite so itself.
  const std::string noun = "theory", loud = "THEORY";
  for (const std::string& form : {loud + " 1.1", noun + ", 1.1", noun + " (1.1)", noun + "\n// 1.1"})
    EXPECT_EQ(faults_of_citations("// (" + form + ")", valid).size(), 1u) << form;
  const std::string label = "(1.1)";
  EXPECT_EQ(bare_numbers("x;  // by " + label, valid).size(), 1u);
  EXPECT_TRUE(bare_numbers("f" + label + ";  // exp" + label, valid).empty());
}

// --- reports ---

TEST(Theory, CitationsOfAReportAreListedInOrderWithPageAndFile) {
  const std::string word = "theory ";
  const std::vector<std::string> notes = theory_notes("Wittenbauer (" + word + "3.2); " + word + "2.1, 2.2 and " +
                                                      word + "3.2; " + word + "77.1 of another book");
  ASSERT_EQ(notes.size(), 3u);
  EXPECT_EQ(notes[0], word + "2.1: Reduction and the equation of work, equation (2.1) in docs/theory/02-reduction.md");
  EXPECT_EQ(notes[2], word + "3.2: Flywheel, equation (3.2) in docs/theory/03-flywheel.md");
  EXPECT_EQ(theory_notes("by " + word + "6 alone").at(0), word + "6: Gear pairs, docs/theory/06-gear-pairs.md");
  EXPECT_TRUE(theory_notes("no theory at all").empty());
}

TEST(Theory, ReportsListWhatTheyCite) {
  const std::string word = "theory ";
  Report report{.title = "Press"};
  report.add("Size").cards.push_back(
      FormulaCard{.title = "Wittenbauer (" + word + "3.2)", .symbols = "", .numbers = ""});
  EXPECT_NE(
      html_of(report).find("\"theory\":[\"" + word + "3.2: Flywheel, equation (3.2) in docs/theory/03-flywheel.md\"]"),
      std::string::npos);
  EXPECT_EQ(html_of(Report{.title = "Press"}).find("\"theory\":"), std::string::npos);
}

}  // namespace kurbel::theory_test
