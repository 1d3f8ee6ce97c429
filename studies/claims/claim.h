// claim.h — a statement about a machine: a typed predicate shown by the motion, its evidence, and the sentence.
//
//     claimed(Predicate::limit_exceeded, "\"clutch\" gets too hot", "clutch", {.at = 1.2, .value = 1320, .limit = 1000, .error = 4, .unit = "J"})
//
// Claims are made by claimed() only; the result is empty if the evidence does not exceed its own error.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace kurbel {

// Topics, in order of priority.
enum class Topic {
  runs,     // does it do its work at all?
  sure,     // are its figures confirmed?
  bears,    // are its limits kept? If not: by how much, where, and which value would remedy it?
  depends,  // which effect that is off would change the answer?
  figures   // then the requested figures
};

enum class Severity { note, warning, fault };

// Possible claims; within a topic and a severity the worst come first. claim_kinds.cpp defines when each is true.
enum class Predicate {
  // does it run?
  incomplete,
  jams,
  stalls,
  does_not_start,
  brake_does_not_stop,
  turns_back,
  hangs_below_breakdown,
  starter_waits,
  runs_away,
  does_not_get_round,
  slips_to_the_end,
  brake_has_not_stopped,
  steady_motion_unstable,
  start_shafts_disagree,
  start_unstable,
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
  // are limits kept?
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
  // requested figures
  figures_told
};
inline constexpr Predicate last_predicate = Predicate::figures_told;

// "clutch_slips_closed": stable, for programs.
const char* name_of(Predicate predicate);
const char* name_of(Severity severity);

// The evidence of a claim. Values in SI; `error` ≥ 0 belongs to the value; unknown entries are empty.
struct Evidence {
  std::optional<double> at = {};     // [s]
  std::optional<double> value = {};  // value found
  std::optional<double> limit = {};  // value allowed
  std::optional<double> error = {};
  std::string unit = {};
};

// The value of a key that removes the claim. `tried`: confirmed by computing the machine with it, and with one worse
// by 1 %; otherwise an estimate.
struct Remedy {
  std::string key;  // "shaft.diameter"
  double value = 0;
  std::string unit = {};
  bool tried = false;
};

// The kind of claim of a predicate, common to all commands.
struct ClaimKind {
  // Side of the limit on which the value must lie by more than its error; without a limit the limit is zero.
  enum class Shows { anything, above, below };
  Predicate predicate;
  Topic topic;
  Severity severity;
  Shows shows;
  const char* when;      // its definition
  const char* evidence;  // meaning of at, value, limit
  const char* sentence;  // an example
  const char* where;     // commands that may make it
};
const ClaimKind& kind_of(Predicate predicate);
std::span<const ClaimKind> claim_kinds();
// docs/claims.md.
std::string claims_in_markdown();

struct Claim {
  Predicate predicate;
  std::string text;  // without a full stop, as displayed
  std::string of;    // component; empty: the machine
  Evidence evidence;
  std::string clause = {};     // the statement within a sentence on the same component: "held by …"; empty: none
  std::string load_case = {};  // of a limit: "start", "steady", …
  std::string variant = {};    // the [[case]] that it belongs to; empty: the machine as it is
  std::optional<Remedy> remedy = {};
  bool in_conclusion = true;  // false: only in the list of claims

  Topic topic() const { return kind_of(predicate).topic; }
  Severity severity() const { return kind_of(predicate).severity; }
  bool is_bad() const { return severity() != Severity::note; }
  // Value over limit; 0: it has no limit.
  double share() const;

 private:
  Claim(Predicate what, std::string words, std::string whom, Evidence shown)
      : predicate(what), text(std::move(words)), of(std::move(whom)), evidence(std::move(shown)) {}
  friend std::optional<Claim> claimed(Predicate, std::string, std::string, Evidence);
};

// Empty if the text is empty, or if the evidence is not on the side of its limit that the predicate requires by more
// than its error. An unknown error counts as zero.
std::optional<Claim> claimed(Predicate predicate, std::string text, std::string of = {}, Evidence evidence = {});

// The same, only for the list of claims.
std::optional<Claim> claimed_aside(Predicate predicate, std::string text, std::string of = {}, Evidence evidence = {});

using Claims = std::vector<Claim>;
// Adds the claim if there is one.
inline void add(Claims& claims, std::optional<Claim> claim) {
  if (claim) claims.push_back(std::move(*claim));
}

}  // namespace kurbel
