// load_cases.cpp — the sequence and the three periods of a run as load cases.
#include "studies/limits/load_cases.h"

#include <fmt/format.h>

#include <algorithm>

#include "studies/limits/verdicts.h"

namespace kurbel {

std::string load_case_at(const Result& r, std::optional<double> at) {
  const Periods& p = r.periods;
  if (!at || !r.model || r.begins_at > 0) return load_case::run;
  const std::vector<SequenceStep>& steps = r.model->scene.sequence.steps;
  std::size_t taken = 0, given = 0;  // steps; commands of the one under way
  // Steps due at the start have no event.
  const auto due_at_once = [](const SequenceStep& step) {
    return (step.when == SequenceStep::When::at || step.when == SequenceStep::When::after) && step.value <= 0;
  };
  while (taken < steps.size() && due_at_once(steps[taken])) ++taken;
  for (const Event& e : r.events) {
    if (e.kind != EventKind::command || e.t > *at || steps.empty()) continue;
    if (++given == steps[taken % steps.size()].set.size()) ++taken, given = 0;
  }
  if (taken > 0) return fmt::format("after step {} of the sequence", (taken - 1) % steps.size() + 1);
  const bool starts =
      std::any_of(r.claims.begin(), r.claims.end(), [](const Claim& c) { return c.predicate == Predicate::starts; });
  if (!p.steady)
    return starts && begins_at_rest(r.model) ? load_case::start : load_case::run;  // it is still on its way
  if (p.run_down_begin && *at > *p.run_down_begin) return load_case::run_down;
  if (!p.run_up_end || *at > *p.run_up_end) return load_case::steady;
  return begins_at_rest(r.model) ? load_case::start : load_case::run;
}

}  // namespace kurbel
