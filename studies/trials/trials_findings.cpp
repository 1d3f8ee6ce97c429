// trials_findings.cpp — what is said of effects that are off: one line for each that matters, one for the rest.
#include <fmt/format.h>

#include <cmath>

#include "engine/scene/units.h"
#include "studies/run/run_findings.h"
#include "studies/trials/trials.h"

namespace kurbel {
namespace {

// Digits that tell the two apart.
int digits_of(const FigureChange& c) { return std::abs(c.relative) < 0.05 ? 4 : 3; }

std::string value_text(double value, const FigureChange& c, const SpeedUnit& speed) {
  if (c.unit == "rad/s") return speed.text(value, digits_of(c));
  return with_unit(value, c.unit, digits_of(c));
}

// Of the figure as it is now; empty: from nothing.
std::string percent_of(const FigureChange& c) {
  if (c.without == 0 || c.from_nothing) return "";
  const double change = c.full / c.without - 1;
  return std::abs(change) < 10 ? fmt::format("{:+.2g} %", 100 * change) : fmt::format("× {:.2g}", c.full / c.without);
}

std::string move_text(const Trial& trial, const FigureChange& c, const SpeedUnit& speed) {
  const std::string percent = percent_of(c);
  return fmt::format("{} is off: on, {} would be {} instead of {}{}", trial.effect.words, c.figure,
                     value_text(c.full, c, speed), value_text(c.without, c, speed),
                     percent.empty() ? "" : " (" + percent + ")");
}

std::vector<std::string> lines_of(const Trials& trials, const SpeedUnit& speed) {
  std::vector<std::string> lines, idle;
  for (const Trial& trial : trials.tried) {
    if (!trial.failed.empty())
      lines.push_back(fmt::format("{} is off; with it the machine does not run: {}", trial.effect.words, trial.failed));
    else if (const FigureChange* c = trial.move(Trials::least_move))
      lines.push_back(move_text(trial, *c, speed));
    else
      idle.push_back(trial.effect.words);
  }
  if (!idle.empty())
    lines.push_back(fmt::format("off, and on would surely move no figure by {:g} %: {}", 100 * Trials::least_move,
                                shortened_list(idle, "and")));
  for (const std::string& left : trials.left_out) lines.push_back("off, not tried: " + left);
  return lines;
}

Rows table_of_trials(const Trials& trials, const SpeedUnit& speed) {
  using T = const Trial&;
  static const FigureChange none;
  const auto shown = [](T t) -> const FigureChange& { return t.changes.empty() ? none : t.changes.front(); };
  const auto moved = [shown](T t) -> const FigureChange& {
    const FigureChange* c = t.move(Trials::least_move);
    return c ? *c : shown(t);
  };
  const auto told = [](T t) { return t.failed.empty() && !t.changes.empty(); };
  return table_of("trials", "Effects that are off, tried one by one", trials.tried)
      .not_on_terminal()
      .column("effect", "effect", [](T t) { return t.effect.words; })
      .column("figure", "moves most", [=](T t) { return moved(t).figure; })
      .only_for_programs("off", [=](T t) { return told(t) ? std::optional(moved(t).without) : std::nullopt; })
      .only_for_programs("on", [=](T t) { return told(t) ? std::optional(moved(t).full) : std::nullopt; })
      .only_for_programs("unit", [=](T t) { return moved(t).unit; })
      .only_for_people("off", [=](T t) { return told(t) ? value_text(moved(t).without, moved(t), speed) : "—"; })
      .only_for_people("on", [=](T t) { return told(t) ? value_text(moved(t).full, moved(t), speed) : "—"; })
      .only_for_programs("change", [=](T t) { return told(t) ? std::optional(moved(t).relative) : std::nullopt; })
      .only_for_programs("change_error", [=](T t) { return told(t) ? std::optional(moved(t).error) : std::nullopt; })
      .only_for_people("change", [=](T t) { return told(t) ? percent_of(moved(t)) : std::string("—"); })
      .column("failed", "", [](T t) { return t.failed; });
}

void tell(Findings& f, const Trials& trials, const SpeedUnit& speed) {
  if (trials.tried.empty() && trials.left_out.empty()) return;
  const Chapter chapter = f.chapter("Effects that are off");
  f.say(chapter, Sentences{.lines = lines_of(trials, speed), .indent = "  ", .apart = false});
  if (!trials.tried.empty()) f.say(chapter, table_of_trials(trials, speed));
}

}  // namespace

Findings findings_of(const TriedRun& tried) {
  Findings f = findings_of(tried.run);
  tell(f, tried.trials, speed_unit_of(tried.run));
  return f;
}

Findings findings_of(const TriedComparison& tried) {
  Findings f = findings_of(tried.comparison);
  tell(f, tried.trials, speed_unit_of(tried.comparison.b));
  return f;
}

}  // namespace kurbel
