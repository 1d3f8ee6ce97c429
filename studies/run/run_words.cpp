// run_words.cpp — sentences about one run.
#include "engine/scene/text.h"
#include "studies/run/run_findings.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "engine/scene/units.h"
#include "mechanisms/reduced/mechanism.h"
#include "studies/answers/run_claims.h"
#include "studies/dictionary/dictionary.h"
#include "studies/findings/figure_text.h"
#include "studies/limits/load_cases.h"

namespace kurbel {
namespace {

// The time of a period's end, from the figure of that time if there is one.
std::string time_text(const Result& r, double t) {
  for (const Figure& f : r.figures)
    if (f.at && *f.at == t && (f.name == "run_up_time" || f.name == "run_down_time"))
      return with_error({t, f.error}, "s");
  return with_unit(t, "s", 6);
}

// The cycle that figures belong to, if there are any.
std::string of_last_cycle(const Result& r) {
  return first_of(r, quantities::cycle_fluctuation) ? " (figures of a cycle are those of the last whole one)" : "";
}

}  // namespace

bool reverses_within_cycle(const Result& r) {
  if (!r.model) return false;
  const auto last = std::find_if(r.cycles.rbegin(), r.cycles.rend(),
                                 [&](const CycleRecord& c) { return c.end <= r.periods.judged_until; });
  double least = 0, greatest = 0;
  for (auto c = last; c != r.cycles.rend() && c - last < r.periods.cycles; ++c)
    least = std::min(least, c->omega_min), greatest = std::max(greatest, c->omega_max);
  const double rounding = 1e-6 * r.model->speed_scale;
  return least < -rounding && greatest > rounding;
}

bool nothing_turned_over(const EnergyBalance& e) {
  return e.kinetic_start == e.kinetic_end && e.stored_start == e.stored_end &&
         std::all_of(e.by_account.begin(), e.by_account.end(), [](const auto& account) { return account.second == 0; });
}

bool is_reported(const Figure& f, const Result& r) {
  if (!r.complete && !std::isfinite(f.value)) return false;
  return !is_one_of(f.what, {quantities::delta, quantities::cycle_fluctuation, quantities::run_up_time}) ||
         !reverses_within_cycle(r);
}

bool has_works(const Result& r) {
  const auto finite = [](const auto& line) { return std::isfinite(line.second); };
  return r.energy.checks > 0 && (r.complete || (!nothing_turned_over(r.energy) && std::isfinite(r.energy.relative) &&
                                                std::all_of(r.energy.by_line.begin(), r.energy.by_line.end(), finite)));
}

std::string reported(const EnergyBalance& e) {
  if (!nothing_turned_over(e))
    return e.relative > 0 ? fmt::format("energy balance closed to {:.1e} of the energy converted", e.relative)
                          : std::string("energy balance closed exactly");
  return e.kinetic_end > 0
             ? fmt::format("no work is done and the kinetic energy stays {}: there is no energy balance to check",
                           with_unit(e.kinetic_end, "J", 5))
             : std::string("nothing moves and no work is done: there is no energy balance to check");
}

std::string in_words(const Figure& f) {
  std::string words = as_words(std::string(f.words()));
  if (is_one_of(f.what, {quantities::delta, quantities::cycle_fluctuation})) words = definition_of(f.what)->words;
  return f.of.empty() ? words : words + ", " + f.of;
}

std::string sure(const Figure& f) { return with_error(f, f.unit); }
SpeedUnit speed_unit_of(const Result& r) { return r.model ? r.model->scene.speed_unit : SpeedUnit{}; }
bool has_known_time(const Figure& f) { return f.at && f.at_error.value_or(0) <= 0.5 * std::abs(*f.at); }
std::string at_time(const Figure& f) { return has_known_time(f) ? "at " + with_error({*f.at, f.at_error}, "s") : ""; }

std::optional<double> largest_after_start(const Result& r, const Figure& peak) {
  constexpr double nearly = 0.98;
  if (!r.model || !r.trajectory || r.begins_at > 0 || !r.periods.steady || r.periods.run_down_begin ||
      r.cycles.empty() || r.model->scene.run.start.speed == 0 || !r.model->commands.empty())
    return {};
  const double first = r.cycles.front().end, half = 0.5 * (first + r.cycles.back().end);
  if (!peak.at || *peak.at >= first) return {};
  const std::optional<double> after = largest_sample_from(r, peak, first);
  return after && *after < nearly * std::abs(peak.value) ? largest_sample_from(r, peak, half) : std::nullopt;
}

const Figure* largest_peak(const Result& r) {
  const Figure* peak = nullptr;
  for (const Figure& f : r.figures)
    if (f.what == quantities::peak_torque && is_reported(f, r) && (!peak || std::abs(f.value) > std::abs(peak->value)))
      peak = &f;
  return peak;
}

std::string words_of_start(const Result& r, const Figure& peak) {
  const std::optional<double> later = largest_after_start(r, peak);
  return later ? fmt::format(", in the vibration with which the run begins; in its second half at most {}",
                             short_text(*later, peak.unit))
               : "";
}

const Figure* first_of(const Result& r, const QuantityKind& what) {
  for (const Figure& f : r.figures)
    if (f.what == what && is_reported(f, r)) return &f;
  return nullptr;
}

std::string angle_of_link(const Result& r) {
  const Network& net = r.model->network;
  const std::string& link = net.nodes[static_cast<std::size_t>(r.model->reduction_node)].component;
  return find_mechanism(net, link) ? "crank angle" : "angle of " + link;
}

std::string cycle_of_figures(const Result& r) {
  const std::string period = r.model ? period_in_words(r.periods, r.model->cycle) : "";
  return period.empty() ? "cycle" : "period of " + period;
}

std::string moved_part(const Model& model, const std::string& component) {
  const Mechanism* mechanism = find_mechanism(model.network, component);
  if (!mechanism) return "output";
  const LinkageDrawing& drawing = mechanism->data.drawing();
  const bool slides = std::any_of(drawing.links.begin(), drawing.links.end(), [&](const auto& link) {
    return link.shape == "slider" && link.joints.front() == drawing.output;
  });
  return drawing.rocks ? "rocker" : slides ? "slider" : "output";
}

std::vector<std::string> notes_on_arcs(const Model& model) {
  std::vector<std::string> notes;
  for (const Network::ShaftElement& e : model.network.elements)
    if (const MechanismElement* element = mechanism_of(e); element && element->mechanism().arc())
      notes.push_back(fmt::format("\"{}\" cannot turn: its {}", e.component, words_of_arc(element->mechanism())));
  return notes;
}

std::string figures_in_words(const Result& r) {
  if (!r.complete) return {};
  const SpeedUnit speed = speed_unit_of(r);
  const auto reported = [&](const Figure& f) { return short_text(f.value, f.unit, speed); };
  std::string text;
  if (const Figure* peak = largest_peak(r); peak && peak->value != 0)
    text = fmt::format("the torque in \"{}\" reaches {}{}{}", peak->of, reported(*peak),
                       peak->at ? " at " + short_text(*peak->at, "s") : "", words_of_start(r, *peak));
  const auto more = [&](const std::string& words) { text += (text.empty() ? "" : "; ") + words; };
  constexpr double stands_within_the_cycle = 2;
  // Over a cycle the force is a datum; a mechanism without one turns kinetic energy into it.
  if (const Figure* force = first_of(r, quantities::peak_force);
      force && force->at.value_or(0) > 0 && r.model->cycle == 0)
    more(fmt::format("the force on \"{}\" reaches {}{}", force->of,
                     short_text(std::abs(force->value), force->unit, speed),
                     force->at ? " at " + short_text(*force->at, "s") : ""));
  if (const Figure* delta = first_of(r, quantities::delta); delta && delta->value < stands_within_the_cycle)
    more(fmt::format("the speed of \"{}\" fluctuates by δ = {}", delta->of, reported(*delta)));
  constexpr double none = 1e-12;  // of a prescribed speed
  if (const Figure* cycle = first_of(r, quantities::cycle_fluctuation);
      cycle && cycle->value < stands_within_the_cycle && cycle->value > cycle->error.value_or(0) + none)
    more(fmt::format("the speed of \"{}\" changes by {} of its mid value in the last cycle, {}", cycle->of,
                     reported(*cycle),
                     r.periods.steady                                 ? "part of which is drift"
                     : r.periods.remaining || r.periods.without_limit ? "which is not steady"
                                                                      : "whose steadiness is not judged"));
  for (const Figure& f : r.figures)
    if (f.words() == "thermal_use" && f.value <= 1)  // a greater one is reported before
      more(fmt::format("the thermal load of \"{}\" {}is {:.0f} % (RMS over rated torque{})", f.of,
                       r.model && r.model->commands.empty() ? "in its steady motion " : "", 100 * f.value,
                       r.model && !r.model->commands.empty() && f.at
                           ? fmt::format(", {} {:.4g} s",
                                         r.model->cycle > 0 || r.periods.time > 0
                                             ? fmt::format("in its heaviest {}, up to", cycle_of_figures(r))
                                             : "at",
                                         *f.at)
                           : ""));
  if (has_works(r) && nothing_turned_over(r.energy)) more("no work is done and no energy is converted");
  return text;
}

std::vector<std::string> model_words(const Result& r) {
  std::vector<std::string> lines = {
      fmt::format("{}: {} coordinate{}, {} — {}", r.label, r.coordinates, r.coordinates == 1 ? "" : "s",
                  r.effects == "none" ? "no effects on" : "effects: " + r.effects, r.statistics.method),
      fmt::format("  {}; {} steps, {} of processor time a run, {} run{}", r.statistics.reason,
                  r.statistics.stepper.steps, duration_text(r.statistics.cpu_seconds), r.runs, r.runs == 1 ? "" : "s")};
  if (const std::string limits = reported(r.statistics.limits); !limits.empty())
    lines.push_back("  what kept the steps short: " + limits);
  if (!r.complete) lines.push_back("  INCOMPLETE: " + r.diagnosis);
  return lines;
}

std::vector<std::string> balance_words(const Result& r) {
  std::vector<std::string> lines;
  const EnergyBalance& e = r.energy;
  if (has_works(r)) {
    std::string works;
    for (const auto& [line, work] : e.by_line)
      works += fmt::format("{} {} {}", works.empty() ? "" : ",", line, with_unit(work, "J", 5));
    lines.push_back("  work:" + works);
    lines.push_back(
        "  " + reported(e) +
        (e.reduction_residual > 0 ? fmt::format("; bodies against reduced inertia {:.1e}", e.reduction_residual) : "") +
        (e.free_bodies > 0 ? fmt::format("; torques of joints by both sides {:.1e}", e.free_bodies) : ""));
  }
  if (r.errors_measured)
    lines.push_back(fmt::format("  accuracy: {:.1e} requested, {:.1e} measured{}", r.accuracy, r.measured_accuracy,
                                r.accuracy_confirmed ? "" : " — NOT confirmed"));
  else if (r.complete)
    lines.push_back(r.unconfirmed() ? "  accuracy: errors could not be measured — NOT confirmed"
                                    : "  errors were not measured (--no-error): digits are not what is sure");
  const Periods& p = r.periods;
  if (p.run_up_end)
    lines.push_back(fmt::format("  run-up to {}", time_text(r, *p.run_up_end)) +
                    (p.run_down_begin
                         ? fmt::format(", steady to {}, then run-down{}", with_unit(*p.run_down_begin, "s", 6),
                                       p.standstill ? " to standstill at " + time_text(r, *p.standstill) : "")
                         : ", then steady motion"));
  if (r.complete && r.trajectory)
    lines.push_back(fmt::format("  {}{}: {}", p.steady ? "steady motion" : "no steady motion within the time simulated",
                                of_last_cycle(r), p.verdict));
  return lines;
}

}  // namespace kurbel
