// claim.cpp — creation of claims, and the list of claims for people.
#include "studies/claims/claim.h"

#include <fmt/format.h>

#include <cmath>

#include "engine/base/enumerators.h"

namespace kurbel {
namespace {

bool is_shown(ClaimKind::Shows shows, const Evidence& e) {
  if (shows == ClaimKind::Shows::anything || !e.value) return true;
  const double limit = e.limit.value_or(0), error = e.error.value_or(0);
  return shows == ClaimKind::Shows::above ? *e.value - error > limit : *e.value + error <= limit;
}

// A table cell; "|" would end its column.
std::string cell(std::string text) {
  for (std::size_t i = text.find('|'); i != std::string::npos; i = text.find('|', i + 2)) text.insert(i, "\\");
  return text;
}

}  // namespace

const char* name_of(Predicate predicate) { return enumerator_name<last_predicate>(predicate); }
const char* name_of(Severity severity) { return enumerator_name<Severity::fault>(severity); }

double Claim::share() const {
  const double limit = evidence.limit.value_or(0);
  return limit != 0 && evidence.value ? std::abs(*evidence.value / limit) : 0;
}

std::optional<Claim> claimed(Predicate predicate, std::string text, std::string of, Evidence evidence) {
  if (text.empty() || !is_shown(kind_of(predicate).shows, evidence)) return {};
  return Claim(predicate, std::move(text), std::move(of), std::move(evidence));
}

std::optional<Claim> claimed_aside(Predicate predicate, std::string text, std::string of, Evidence evidence) {
  std::optional<Claim> claim = claimed(predicate, std::move(text), std::move(of), std::move(evidence));
  if (claim) claim->in_conclusion = false;
  return claim;
}

std::string claims_in_markdown() {
  std::string text =
      "# Claims\n\n"
      "Every sentence of a conclusion is a claim: a predicate that is evaluated on the motion that was computed. A "
      "claim\n"
      "whose evidence does not go beyond its own error is not made. `summary.json` has all of them under `claims`, "
      "with\n"
      "`name`, `of`, `at`, `value`, `limit`, `error`, `unit`, `severity`, `load_case`, `remedy` and the sentence, "
      "`text`;\n"
      "values are in SI.\n";
  static constexpr const char* questions[] = {"Does it run?", "Is it confirmed?", "Are the limits kept?",
                                              "What would change the answer?", "The figures"};
  std::optional<Topic> topic;
  for (const ClaimKind& kind : claim_kinds()) {
    if (topic != kind.topic) {
      topic = kind.topic;
      text += fmt::format(
          "\n## {}\n\n| claim | severity | when it is true | evidence | an example | where |\n"
          "|---|---|---|---|---|---|\n",
          questions[static_cast<std::size_t>(kind.topic)]);
    }
    text += fmt::format("| `{}` | {} | {} | {} | {} | {} |\n", name_of(kind.predicate), name_of(kind.severity),
                        cell(kind.when), cell(kind.evidence), cell(kind.sentence), kind.where);
  }
  return text;
}

}  // namespace kurbel
