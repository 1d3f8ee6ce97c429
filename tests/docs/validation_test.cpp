// validation_test.cpp — docs/validation.md holds nothing that no test stands for. That each row is there and true is
// asked by every test that has one (support/validation.h).
#include <gtest/gtest.h>

#include <fstream>
#include <set>
#include <string>

namespace {

std::set<std::string> registered_tests() {
  std::set<std::string> names;
  const auto* const all = ::testing::UnitTest::GetInstance();
  for (int s = 0; s < all->total_test_suite_count(); ++s) {
    const auto* const suite = all->GetTestSuite(s);
    for (int t = 0; t < suite->total_test_count(); ++t)
      names.insert(std::string(suite->name()) + "." + suite->GetTestInfo(t)->name());
  }
  return names;
}

TEST(ValidationPage, EverySourceIsHeldByTestsThatExist) {
  const std::set<std::string> tests = registered_tests();
  std::ifstream page(KURBEL_SOURCE_DIR "/docs/validation.md");
  ASSERT_TRUE(page);
  std::string line;
  int sources = 0, rows = 0, held = 0;
  while (std::getline(page, line)) {
    sources += line.starts_with("### ");
    rows += line.starts_with("| ") && !line.starts_with("| quantity") && !line.starts_with("| against");
    if (!line.starts_with("Held by ")) continue;
    ++held;
    for (std::size_t from = line.find('`'); from != std::string::npos;) {
      const std::size_t to = line.find('`', from + 1);
      ASSERT_NE(to, std::string::npos) << line;
      const std::string name = line.substr(from + 1, to - from - 1);
      EXPECT_TRUE(tests.contains(name)) << name << " is no test; scripts/renew-docs writes the page anew";
      from = line.find('`', to + 1);
    }
  }
  EXPECT_EQ(sources, held);
  EXPECT_GE(sources, 50);
  EXPECT_GE(rows, 250);
}

}  // namespace
