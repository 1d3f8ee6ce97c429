// trials_findings.cpp — effects that are off, by the changes that they would cause.
#include "studies/trials/trials_findings.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "studies/claims/headline.h"
#include "studies/findings/figure_text.h"
#include "studies/run/run_findings.h"

namespace kurbel {
namespace {

// A change in readable form.
struct MovedFigure {
  std::string effect, name, figure, off, on, change;
};

std::string words_of(const OffEffect& effect) {
  return effect.gives_way.empty() ? effect.words : fmt::format("{} (in place of {})", effect.words, effect.gives_way);
}

// About four digits, and none beyond the error.
std::string in_short(double value, double error, const std::string& unit, const SpeedUnit& speed) {
  const double factor = unit == "rad/s" ? speed.of(1) : 1, shown = factor * value;
  const std::string text = figure_text({shown, std::max(std::abs(factor * error), 1e-3 * std::abs(shown))}).value;
  const std::string its = unit == "rad/s" ? speed.name : pretty_unit(unit);
  return its.empty() ? text : text + " " + its;
}

std::string percent(double relative) {
  const double size = std::abs(100 * relative);
  return size >= 10  ? fmt::format("{:+.0f} %", 100 * relative)
         : size >= 1 ? fmt::format("{:+.1f} %", 100 * relative)
                     : fmt::format("{:+.1g} %", 100 * relative);
}

std::string change_in_words(const TrialChange& c) {
  if (c.gone) return "not found";
  if (c.change.from_nothing) return "from zero";
  return c.relative > 9 ? fmt::format("{:.3g} ×", std::abs(c.change.without / c.change.full)) : percent(c.relative);
}

bool moves(const TrialChange& c) { return c.gone || c.change.reported(); }
bool worth_a_line(const TrialChange& c) {
  return c.gone || (c.change.reported() && c.change.relative > least_worth_a_line);
}

bool changes_the_answer(const TrialChange& c) {
  return c.gone || (c.change.reported() && c.change.relative >= least_that_changes_the_answer);
}

template <class Which>
bool any(const Trial& trial, const Which& which) {
  return std::any_of(trial.changes.begin(), trial.changes.end(), which);
}

std::string in_words(const FigureChange& change, const Trial& trial) {
  const Figure* figure = trial.result.find(change.figure);
  return figure ? in_words(*figure) : change.figure;
}

std::vector<MovedFigure> moved_by(const Trial& trial, const SpeedUnit& speed) {
  std::vector<MovedFigure> list;
  for (const TrialChange& c : trial.changes) {
    if (!worth_a_line(c)) continue;
    const double size = std::abs(c.change.full), error = c.change.error * size;
    list.push_back({words_of(trial.effect), c.change.figure, in_words(c.change, trial),
                    in_short(c.change.full, error, c.change.unit, speed),
                    c.gone ? "—" : in_short(c.change.without, c.error_on.value_or(0), c.change.unit, speed),
                    change_in_words(c)});
  }
  return list;
}

std::string one_line(const MovedFigure& moved) {
  if (moved.on == "—") return fmt::format("{}: on, the run would have no {}", moved.effect, moved.figure);
  return fmt::format("{}: on would change {} from {} to {} ({})", moved.effect, moved.figure, moved.off, moved.on,
                     moved.change);
}

// Effects without a significant change of a key figure, failed and untried ones: by the reason.
std::vector<std::string> other_words(const Trials& trials) {
  std::vector<std::string> lines, slight, none;
  for (const Trial& trial : trials.tried) {
    if (!trial.failed.empty() || any(trial, worth_a_line)) continue;
    (any(trial, moves) ? slight : none).push_back(words_of(trial.effect));
  }
  if (!slight.empty())
    lines.push_back(
        fmt::format("less than {:g} % in every key figure: {}", 100 * least_worth_a_line, fmt::join(slight, "; ")));
  if (!none.empty()) lines.push_back(fmt::format("no effect on the key figures: {}", fmt::join(none, "; ")));
  for (const Trial& trial : trials.tried)
    if (!trial.failed.empty())
      lines.push_back(fmt::format("{}: the trial failed: {}", words_of(trial.effect), trial.failed));
  std::vector<std::pair<std::string, std::vector<std::string>>> reasons;
  for (const NotTried& n : trials.not_tried) {
    if (reasons.empty() || reasons.back().first != n.because) reasons.push_back({n.because, {}});
    reasons.back().second.push_back(n.words);
  }
  for (const auto& [because, words] : reasons)
    lines.push_back(fmt::format("not tried: {} ({})", fmt::join(words, "; "), because));
  return lines;
}

// Trials with a significant change of a key figure.
std::vector<const Trial*> moving_most_first(const Trials& trials) {
  std::vector<const Trial*> moving;
  for (const Trial& trial : trials.tried)
    if (any(trial, worth_a_line)) moving.push_back(&trial);
  const auto most = [](const Trial* t) {
    return t->changes.front().gone ? HUGE_VAL : t->changes.front().change.sure();
  };
  std::stable_sort(moving.begin(), moving.end(), [&](const Trial* a, const Trial* b) { return most(a) > most(b); });
  return moving;
}

// The same for people; with the effect's name if there are several.
Rows moved_table(const std::string& title, std::vector<MovedFigure> moved, const char* before, const char* after,
                 bool names_effect) {
  auto table = table_of("", title, std::move(moved)).text_in(names_effect ? 2 : 1);
  table.explained_by(&MovedFigure::name).not_on_terminal();
  if (names_effect) table.only_for_people("effect", &MovedFigure::effect);
  return table.only_for_people("key figure", &MovedFigure::figure)
      .only_for_people(before, &MovedFigure::off)
      .only_for_people(after, &MovedFigure::on)
      .only_for_people("change", &MovedFigure::change);
}

// For programs.
Field changes_of(const Trial& trial, const char* before, const char* after) {
  return {"changes", each(trial.changes, [&](const TrialChange& c) {
            Record change = {{"figure", c.change.figure}, {"unit", c.change.unit}, {before, c.change.full}};
            if (c.gone) return change;
            change.push_back({after, c.change.without});
            change.push_back({"change", c.relative});
            change.push_back({"error", c.change.error});
            return change;
          })};
}

// --- the rigid machine ---

// Differences of the rigid model, largest certain change first.
void conclude_rigid(Findings& f, const Trial& rigid, const SpeedUnit& speed) {
  const auto differs = std::find_if(rigid.changes.begin(), rigid.changes.end(), changes_the_answer);
  if (!rigid.failed.empty()) {
    if (f.brief) f.brief->words.push_back("the rigid machine: its run failed: " + rigid.failed);
  } else if (differs == rigid.changes.end()) {
    if (f.brief)
      f.brief->words.push_back(fmt::format("the rigid model is sufficient: its key figures differ by less than {:g} %",
                                           100 * least_that_changes_the_answer));
  } else {
    // A figure that both machines have, where one differs.
    const std::vector<MovedFigure> all = moved_by(rigid, speed);
    const auto both = std::find_if(all.begin(), all.end(), [](const MovedFigure& m) { return m.on != "—"; });
    const MovedFigure& moved = both == all.end() ? all.front() : *both;
    f.claim(Predicate::effect_matters, moved.on == "—"
                                           ? fmt::format("The rigid model has no {}", moved.figure)
                                           : fmt::format("The rigid model gives {} instead of {} for {} ({})", moved.on,
                                                         moved.off, moved.figure, moved.change));
  }
}

void show_rigid(Findings& f, const Trial& rigid, const SpeedUnit& speed) {
  conclude_rigid(f, rigid, speed);
  if (!rigid.failed.empty()) {
    f.record("rigid", Record{{"failed", rigid.failed}});
    return;
  }
  f.say(f.chapter_named(chapter_of_rigid), moved_table("Key figures that differ in the rigid machine (grey curves)",
                                                       moved_by(rigid, speed), "elastic", "rigid", false));
  f.record("rigid", Record{changes_of(rigid, "elastic", "rigid")});
}

// --- effects that are off ---

Record trial_record(const Trial& trial) {
  Record record = {{"effect", trial.effect.name}};
  if (!trial.effect.gives_way.empty()) record.push_back({"in_place_of", trial.effect.gives_way});
  if (!trial.failed.empty()) {
    record.push_back({"failed", trial.failed});
    return record;
  }
  record.push_back(changes_of(trial, "off", "on"));
  return record;
}

// The effect that is off and would change the result most; the number of trials.
void conclude(Findings& f, const Trials& trials, const SpeedUnit& speed) {
  const std::vector<const Trial*> moving = moving_most_first(trials);
  std::size_t count = 0;
  for (const Trial* trial : moving) count += any(*trial, changes_the_answer);
  if (count > 0) {
    const MovedFigure moved = moved_by(*moving.front(), speed).front();
    f.claim(Predicate::effect_matters,
            moved.on == "—" ? capitalised(fmt::format("{}, which is off, would give no {}", moved.effect, moved.figure))
                            : capitalised(fmt::format("{}, which is off, would change {} from {} to {} ({})",
                                                      moved.effect, moved.figure, moved.off, moved.on, moved.change)));
  }
  if (!f.brief) return;
  std::string words = fmt::format("effects that are off: {} of {} tried would change a key figure by {:g} % or more",
                                  count, trials.tried.size(), 100 * least_that_changes_the_answer);
  if (!trials.not_tried.empty()) words += fmt::format("; {} not tried (report)", trials.not_tried.size());
  f.brief->words.push_back(std::move(words));
}

void show(Findings& f, const Trials& trials, const SpeedUnit& speed) {
  if (trials.tried.empty() && trials.not_tried.empty()) return;
  conclude(f, trials, speed);
  const Chapter in = f.chapter_named(chapter_of_trials);
  f.say(in, Sentences{.lines = words_of(trials, speed),
                      .heading = "effects that are off:",
                      .indent = "  ",
                      .page = false,
                      .apart = true});
  std::vector<MovedFigure> moved;
  for (const Trial& trial : trials.tried)
    for (MovedFigure& figure : moved_by(trial, speed)) moved.push_back(std::move(figure));
  f.say(in, moved_table("Key figures with one effect more, a trial each (theory 14.1)", std::move(moved), "off", "on",
                        true));
  f.say(in, Sentences{.lines = other_words(trials), .terminal = false});
  f.record("trials", Record{{"tried", each(trials.tried, trial_record)},
                            {"not_tried", each(trials.not_tried, [](const NotTried& n) {
                               return Record{{"effect", n.effect}, {"because", n.because}};
                             })}});
}

}  // namespace

std::vector<std::string> words_of(const Trials& trials, const SpeedUnit& speed) {
  std::vector<std::string> lines;
  for (const Trial* trial : moving_most_first(trials)) lines.push_back(one_line(moved_by(*trial, speed).front()));
  for (std::string& line : other_words(trials)) lines.push_back(std::move(line));
  return lines;
}

Findings findings_of(const WithTrials<Result>& s) {
  const std::optional<Trial>& rigid = s.trials.rigid;
  Findings f = findings_of(s.study, rigid && rigid->failed.empty() ? &rigid->result : nullptr);
  if (rigid) show_rigid(f, *rigid, speed_unit_of(s.study));
  show(f, s.trials, speed_unit_of(s.study));
  return f;
}

Findings findings_of(const WithTrials<Comparison>& s) {
  Findings f = findings_of(s.study);
  show(f, s.trials, speed_unit_of(s.study.b));
  return f;
}

}  // namespace kurbel
