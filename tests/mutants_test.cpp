// The list of mutants (tests/mutants.txt, scripts/mutate) names places in the sources by their text, which changes.
#include <gtest/gtest.h>

#include <cctype>
#include <fstream>
#include <iterator>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace kurbel::mutants_test {
namespace {

struct Mutant {
  std::string number, file, context, original, mutated;  // without white space
};

std::string squeezed(const std::string& text) {
  std::string result;
  for (const char c : text)
    if (!std::isspace(static_cast<unsigned char>(c))) result += c;
  return result;
}

std::string content_of(const std::string& name) {
  std::ifstream file(std::string(KURBEL_SOURCE_DIR "/") + name);
  EXPECT_TRUE(file) << name;
  return {std::istreambuf_iterator<char>(file), {}};
}

std::vector<Mutant> listed_mutants() {
  std::vector<Mutant> all;
  std::ifstream list(KURBEL_SOURCE_DIR "/tests/mutants.txt");
  std::string file;
  for (std::string line; std::getline(list, line);) {
    if (line.starts_with("== ")) file = line.substr(3);
    if (!line.empty() && std::isdigit(static_cast<unsigned char>(line.front())))
      all.push_back({line.substr(0, line.find(' ')), file, {}, {}, {}});
    if (line.starts_with("@ ")) all.back().context += squeezed(line.substr(2));
    if (line.starts_with("- ")) all.back().original += squeezed(line.substr(2));
    if (line.starts_with("+ ")) all.back().mutated += squeezed(line.substr(2));
  }
  return all;
}

int count(const std::string& text, const std::string& part, std::size_t from = 0) {
  int found = 0;
  for (std::size_t at = text.find(part, from); at != std::string::npos; at = text.find(part, at + 1)) ++found;
  return found;
}

void erase_all(std::string& text, const std::string& part) {
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at)) text.erase(at, part.size());
}

}  // namespace

// An entry whose text has changed would no longer be judged: bring it up to date in tests/mutants.txt, see
// scripts/mutate --check.
TEST(Mutants, EveryOriginalTextStandsOnceInItsFile) {
  std::map<std::string, std::string> source;
  std::set<std::string> numbers;
  const std::vector<Mutant> mutants = listed_mutants();
  EXPECT_GE(mutants.size(), 150u);
  for (const Mutant& m : mutants) {
    SCOPED_TRACE("mutant " + m.number + " of " + m.file);
    EXPECT_TRUE(numbers.insert(m.number).second);
    EXPECT_FALSE(m.mutated.empty());
    if (!source.contains(m.file)) source[m.file] = squeezed(content_of(m.file));
    const std::string& text = source[m.file];
    std::string original = m.original;
    erase_all(original, "«");
    erase_all(original, "»");
    ASSERT_FALSE(original.empty());
    if (m.context.empty()) {
      EXPECT_EQ(count(text, original), 1) << original;
    } else {
      ASSERT_EQ(count(text, m.context), 1) << m.context;
      EXPECT_GE(count(text, original, text.find(m.context) + m.context.size()), 1) << original;
    }
  }
}

}  // namespace kurbel::mutants_test
