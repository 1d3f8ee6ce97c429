// limits_findings.cpp — tables and sentences of limits.
#include "studies/limits/limits_findings.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "engine/scene/text.h"
#include "studies/claims/ranges.h"
#include "studies/findings/figure_text.h"

namespace kurbel {
namespace {

std::string use_of(const Verdict& v) {
  const Compliance state = v.state();
  if (state == Compliance::not_assessed) return "not assessed";
  if (v.gives_way) return "EXCEEDED";
  const std::string share = std::isfinite(v.value) ? fmt::format("{:.0f} %", 100 * v.share()) : "unbounded";
  return share + (state == Compliance::holds ? " holds" : state == Compliance::exceeded ? " EXCEEDED" : " UNDECIDED");
}

Tone tone_of(Compliance state) {
  return state == Compliance::holds          ? Tone::good
         : state == Compliance::exceeded     ? Tone::bad
         : state == Compliance::not_assessed ? Tone::aside
                                             : Tone::fair;
}

// The load without its factors, with its error if visible beside it or beside a thousandth of the limit.
std::string load_text(const Verdict& v) {
  if (!v.assessed) return "—";
  const ReadableUnit unit = readable_unit(v.limit, v.unit);
  const bool is_rounding = !v.bound && std::abs(v.value) <= v.known_error();
  const double load = is_rounding ? 0 : v.load(), error = v.known_error() + (is_rounding ? std::abs(v.value) : 0);
  const std::string value = read_as(unit.factor * load, {.digits = 5, .otherwise = "unbounded"});
  if (v.bound) return fmt::format("≤ {} {}", value, unit.unit);
  if (!(error > 1e-4 * std::max(std::abs(v.value), 1e-3 * v.limit))) return fmt::format("{} {}", value, unit.unit);
  return with_error({unit.factor * load, unit.factor * error / v.factor}, unit.unit, 5);
}

// A rule that bars all speeds gives no range to avoid; it is in the notes.
bool is_reported_first(const BarredRange& b) { return !(b.everywhere && b.by == BarredRange::By::rule); }

// ": up to 939.9 N·m where 75 N·m are allowed": by a limit that is given.
std::string excess_text(const BarredRange& b) {
  if (b.by != BarredRange::By::limit || !std::isfinite(b.peak) || !(b.peak > b.limit)) return "";
  return fmt::format(": up to {} where {} are allowed", short_text(b.peak, "N*m"), short_text(b.limit, "N*m"));
}

// Overlapping ranges of several joints count as one.
std::size_t number_apart(std::vector<BarredRange> ranges) {
  std::sort(ranges.begin(), ranges.end(), [](const BarredRange& a, const BarredRange& b) { return a.from < b.from; });
  std::size_t number = 0;
  double end = 0;
  for (const BarredRange& b : ranges) {
    if (number == 0 || b.from > end) ++number;
    end = std::max(number == 0 ? b.to : end, b.to);
  }
  return number;
}

}  // namespace

std::string reason_in_words(const BarredRange& range) { return as_words(range.reason); }

Rows verdict_table(const std::vector<Verdict>& verdicts) {
  // The most important column first, as a narrow page shows the left part.
  constexpr std::size_t at_use = 1;
  Rows table =
      table_of("verdicts", "Limits of the components", verdicts)
          .headed("limits")
          .text_in(4)
          .column("component", "component", &Verdict::component)
          .only_for_people("use", use_of)
          .column("requirement", "requirement", &Verdict::requirement)
          .column("load_case", "load case", &Verdict::load_case)
          .only_for_programs("value", &Verdict::value)
          .only_for_programs("error", &Verdict::known_error)
          .only_for_programs("bound", &Verdict::bound)
          .only_for_programs("limit", &Verdict::limit)
          .only_for_programs("unit", &Verdict::unit)
          .only_for_programs("holds", &Verdict::holds)
          .only_for_programs("verdict", [](const Verdict& v) { return std::string(name_of(v.state())); })
          .only_for_people("load", load_text)
          .column("factor", "factors", &Verdict::factor,
                  [](double factor) { return factor == 1 ? std::string() : fmt::format("{:.4g}", factor); })
          .only_for_people("of the standard", [](const Verdict& v) { return v.factors; })
          .only_for_people("limit",
                           [](const Verdict& v) {
                             const ReadableUnit unit = readable_unit(v.limit, v.unit);
                             return fmt::format("{} {}", read_as(unit.factor * v.limit, {.digits = 5}), unit.unit);
                           })
          .column("note", "note", &Verdict::note);
  // On the page the use has the colour of its verdict.
  for (const Verdict& v : verdicts) {
    table.tones.emplace_back(table.headings().size(), Tone::none);
    table.tones.back()[at_use] = tone_of(v.state());
  }
  return table;
}

Rows barred_table(const std::vector<BarredRange>& ranges, const std::vector<LimitedJoint>& joints,
                  const SpeedUnit& unit) {
  const ReadAs speed{.factor = unit.of(1), .digits = 5}, torque{.digits = 5, .otherwise = "unbounded"};
  return table_of("barred", "Barred speed ranges", ranges)
      .headed("barred speed ranges")
      .text_in(2)
      .column("joint", "joint", [&joints](const BarredRange& b) { return joints[b.joint].name; })
      .column("reason", "barred because of", &BarredRange::reason,
              [](const std::string& reason) { return as_words(reason); })
      .only_for_programs("by", [](const BarredRange& b) { return std::string(name_of(b.by)); })
      .only_for_programs("everywhere", &BarredRange::everywhere)
      .column("from", fmt::format("from [{}]", unit.name), &BarredRange::from, speed)
      .column("to", fmt::format("to [{}]", unit.name), &BarredRange::to, speed)
      .column("peak", "largest [N·m]", &BarredRange::peak, torque)
      .column("limit", "limit there [N·m]", &BarredRange::limit, torque);
}

std::optional<Claim> barred_claim(const std::vector<BarredRange>& ranges, const std::vector<LimitedJoint>& joints,
                                  const SpeedUnit& unit) {
  std::vector<BarredRange> reported;
  std::copy_if(ranges.begin(), ranges.end(), std::back_inserter(reported), is_reported_first);
  const BarredRange* b = worst_of(reported);
  if (!b) return {};
  const std::size_t number = number_apart(reported);
  const std::string& joint = joints[b->joint].name;
  const bool known = std::isfinite(b->peak);
  return claimed(Predicate::speeds_barred,
                 b->everywhere && number == 1
                     ? fmt::format("{} at every speed of {} ({})",
                                   b->by == BarredRange::By::sign ? "a joint with play hammers" : "barred",
                                   speed_range(b->from, b->to, unit), joint)
                     : fmt::format("{} barred range{}, worst {} ({}{})", number, number == 1 ? "" : "s",
                                   speed_range(b->from, b->to, unit), joint, excess_text(*b)),
                 joint, {.value = known ? std::optional(b->peak) : std::nullopt, .limit = b->limit, .unit = "N*m"});
}

std::vector<std::string> limits_notes(const std::vector<Verdict>& verdicts, const std::vector<BarredRange>& ranges,
                                      const std::vector<LimitedJoint>& joints, const SteadyLoads& loads,
                                      const RunUp& run_up) {
  std::vector<std::string> notes;
  for (const BarredRange& b : ranges) {
    if (!b.everywhere) continue;
    const std::string& name = joints[b.joint].name;
    if (b.by == BarredRange::By::limit)
      notes.push_back(fmt::format(
          "\"{}\" is beyond its {} at every speed examined, by up to {:.3g} times: no range of speed is free of it",
          name, reason_in_words(b), b.peak / b.limit));
    else if (b.by == BarredRange::By::rule)
      notes.push_back(
          fmt::format("\"{}\" oscillates by more than {} at every speed examined, by up to {:.3g} times: that rule "
                      "gives no barred range; give the limits of \"{}\"",
                      name, b.reason, b.peak / b.limit, name));
    else
      notes.push_back(
          fmt::format("the torque of \"{}\", which has play, changes sign at every speed examined: it hammers", name));
  }
  if (!verdicts.empty())
    notes.push_back(fmt::format("limits: {}{}; peaks {}", loads.found ? "steady loads of " : "no steady loads, as ",
                                loads.words,
                                run_up.found ? "of " + run_up.words : "without a run-up: " + run_up.words));
  return notes;
}

}  // namespace kurbel
