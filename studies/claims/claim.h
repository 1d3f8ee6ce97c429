// claim.h — what a study says of a machine: a typed predicate that the motion shows, its evidence, and the sentence.
//
//     claimed(Predicate::limit_exceeded, "\"clutch\" gets too hot", "clutch", {.at = 1.2, .value = 1320, .limit = 1000, .error = 4, .unit = "J"})
//
// A claim is made by claimed() alone: none comes out where the evidence is not beyond its own error.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace kurbel {

// In the order in which an engineer asks.
enum class Topic {
  runs,     // does it do its work at all?
  sure,     // are its figures confirmed?
  bears,    // does it bear what it brings? By how much not, where, and what value would mend it?
  depends,  // which effect that is off would change the answer?
  figures   // then what was asked for
};

enum class Severity { note, warning, fault };

// What can be claimed; within a topic and a severity what is worse comes first. claim_kinds.cpp says when each is true.
enum class Predicate {
  // does it run?
  incomplete,
  stalls,
  does_not_start,
  brake_does_not_stop,
  turns_back,
  hangs_below_breakdown,
  runs_away,
  does_not_get_round,
  slips_to_the_end,
  brake_has_not_stopped,
  steady_motion_unstable,
  start_shafts_disagree,
  runs_steadily,
  vibrates,
  works_in_strokes,
  goes_through_sequence,
  does_not_move,
  at_rest,
  not_steady_yet,
  moves,
  starts,
  held_by,
  sticks_and_slips,
  // is it sure?
  not_confirmed,
  machines_failed,
  outside_data,
  // does it bear it?
  limit_exceeded,
  motor_overloaded,
  demand_missed,
  geometry_faulty,
  clutch_slips_closed,
  limiter_slips,
  belt_slips,
  geometry_doubtful,
  margin_missed,
  limit_undecided,
  limit_held,
  not_assessed,
  margin_kept,
  share_holds,
  speeds_barred,
  clutch_slips_engaging,
  clutch_opened_by_command,
  freewheel_overruns,
  // which effect matters?
  effect_matters,
  effects_suffice,
  // what was asked for
  figures_told
};
inline constexpr Predicate last_predicate = Predicate::figures_told;

// "clutch_slips_closed": stable, for programs.
const char* name_of(Predicate predicate);
const char* name_of(Severity severity);

// What shows a claim. Values in SI; `error` ≥ 0 is of the value; what is not known is empty.
struct Evidence {
  std::optional<double> at = {};     // [s]
  std::optional<double> value = {};  // that was found
  std::optional<double> limit = {};  // that it is held against
  std::optional<double> error = {};
  std::string unit = {};
};

// The value of a key with which the claim would be none. `tried`: the machine was computed with it and with one worse by
// 1 %; else it is an estimate.
struct Remedy {
  std::string key;  // "shaft.diameter"
  double value = 0;
  std::string unit = {};
  bool tried = false;
};

// What is said with this predicate, wherever it is said.
struct ClaimKind {
  // On which side of its limit the value must lie, error counted; without a limit the limit is zero.
  enum class Shows { anything, above, below };
  Predicate predicate;
  Topic topic;
  Severity severity;
  Shows shows;
  const char* when;      // its definition
  const char* evidence;  // what at, value, limit are
  const char* sentence;  // an example
  const char* where;     // commands that may say it
};
const ClaimKind& kind_of(Predicate predicate);
std::span<const ClaimKind> claim_kinds();
// docs/claims.md.
std::string claims_in_markdown();

struct Claim {
  Predicate predicate;
  std::string text;  // without a full stop, as it is to be read
  std::string of;    // component; empty: the machine
  Evidence evidence;
  std::string load_case = {};  // of a limit: "start", "steady", …
  std::string variant = {};    // of the machine that it is of: a [[case]]; empty: the machine as it is
  std::optional<Remedy> remedy = {};
  bool in_conclusion = true;  // false: it stands in the list of claims alone

  Topic topic() const { return kind_of(predicate).topic; }
  Severity severity() const { return kind_of(predicate).severity; }
  bool is_bad() const { return severity() != Severity::note; }
  // How many times its limit the value is; 0: it has none.
  double share() const;

 private:
  Claim(Predicate what, std::string words, std::string whom, Evidence shown)
      : predicate(what), text(std::move(words)), of(std::move(whom)), evidence(std::move(shown)) {}
  friend std::optional<Claim> claimed(Predicate, std::string, std::string, Evidence);
};

// None where nothing is said, or where the evidence does not lie on the side of its limit that the predicate asks for, by
// more than its error. An unknown error counts as none.
std::optional<Claim> claimed(Predicate predicate, std::string text, std::string of = {}, Evidence evidence = {});

// The same, in the list of claims alone.
std::optional<Claim> claimed_aside(Predicate predicate, std::string text, std::string of = {}, Evidence evidence = {});

using Claims = std::vector<Claim>;
// Takes what was claimed.
inline void add(Claims& claims, std::optional<Claim> claim) {
  if (claim) claims.push_back(std::move(*claim));
}

}  // namespace kurbel
