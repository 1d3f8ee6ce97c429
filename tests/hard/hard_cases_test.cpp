// hard_cases_test.cpp — every hard case ends with the right answer or with the words that belong there. What the program
// chooses ("auto") and every third of the other methods, in the thorough form all of them, each at one accuracy that changes
// from case to case; kurbel_bench hard runs them all at all accuracies.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cctype>
#include <cmath>

#include "tests/hard/families.h"
#include "tests/support/sanitized.h"
#include "tests/support/thorough.h"

namespace kurbel::hard::hard_cases_test {
namespace {

// Methods of low order need ten times the steps for three digits more: less is requested of them.
double accuracy_for(std::size_t which_case, std::size_t which_method, const std::string& method) {
  const bool low_order = method == "esdirk3" || method == "bdf" || method == "esdirk" || method == "multibody";
  const std::size_t count = low_order ? 3 : all_accuracies().size();
  return all_accuracies()[(which_case + 3 * which_method) % count];
}

class HardCases : public ::testing::TestWithParam<std::size_t> {};

TEST_P(HardCases, EndRight) {
  // Budgets are the bench's. Here an answer must be right however slow the machine is.
  HardCase hard_case = all_cases()[GetParam()];
  hard_case.budget *= 2 * test::slower;
  for (std::size_t m = 0; m < all_methods().size(); ++m) {
    const std::string& method = all_methods()[m];
    const bool taken = !hard_case.heavy && (test::thorough() || (GetParam() + m) % 3 == 0);
    if (method != "auto" && !taken) continue;
    const double accuracy = accuracy_for(GetParam(), m, method);
    const CaseOutcome outcome = run_case(hard_case, method, accuracy);
    EXPECT_TRUE(outcome.verdict != Verdict::failed && outcome.verdict != Verdict::unfinished) << fmt::format(
        "{} at {:.0e}, {}: {}; error {:.2e}, {:.2e} allowed; {} steps, {:.3g} s of processor time", method, accuracy,
        hard_case.parameter, outcome.words, outcome.error, outcome.allowed, outcome.steps, outcome.cpu_seconds);
  }
}

std::vector<std::size_t> numbers() {
  std::vector<std::size_t> all;
  for (std::size_t i = 0; i < all_cases().size(); ++i) all.push_back(i);
  return all;
}

INSTANTIATE_TEST_SUITE_P(All, HardCases, ::testing::ValuesIn(numbers()), [](const auto& which) {
  const HardCase& hard_case = all_cases()[which.param];
  std::string name = hard_case.family + "_" + hard_case.name;
  for (char& c : name)
    if (!std::isalnum(static_cast<unsigned char>(c))) c = '_';
  return name;
});

}  // namespace
}  // namespace kurbel::hard::hard_cases_test
