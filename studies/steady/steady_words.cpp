// steady_words.cpp — sentences of the steady study.
#include "studies/steady/steady_words.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "drivetrain/shared/rating_keys.h"
#include "engine/base/find_by.h"
#include "engine/numerics/angles.h"
#include "engine/scene/quantity_place.h"
#include "engine/scene/units.h"
#include "studies/answers/motion_claims.h"
#include "studies/answers/run_claims.h"
#include "studies/claims/headline.h"
#include "studies/findings/figure_text.h"
#include "studies/limits/ratings.h"

namespace kurbel {
namespace {

std::string number(double value, int digits = headline_digits) { return fmt::format("{:.{}g}", value, digits); }

std::string percent(double part) { return fmt::format("{:.4g} %", 100 * part); }

// Rounding errors relative to the other slope are set to zero.
std::string beside(double value, double other) {
  return number(std::abs(value) < 1e-9 * std::abs(other) ? 0.0 : value);
}

Figure renamed(const Figure& f, Name name) {
  Figure other = f;
  other.name = std::move(name.text), other.what = name.what, other.of = std::move(name.of);
  return other;
}

// For a rim at the largest speed of its shaft, with the relative error of the link's speed.
void add_rim_speeds(const SteadyCycle& c, Result& as_run) {
  const Figure* fastest = nullptr;
  for (const Figure& f : c.figures)
    if (f.what == quantities::cycle_max_speed) fastest = &f;
  for (const auto& [component, rating] : c.model->network.data.all<RimRating>()) {
    for (const ShaftFluctuation& shaft : c.shafts) {
      if (shaft.shaft != component) continue;
      const double speed = *rating.radius * std::max(std::abs(shaft.max), std::abs(shaft.min));
      Figure rim = Figure::of_name(Name::own("rim_speed", component), speed, "m/s");
      if (fastest && fastest->error && fastest->value != 0)
        rim.error = speed * *fastest->error / std::abs(fastest->value);
      as_run.figures.push_back(std::move(rim));
    }
  }
}

// Loads of joints in steady motion, by DIN 740-2 and the manufacturers' stresses, as in `modes`: instead of verdicts on
// peaks only. The start is assessed by `modes` and `run`.
void add_loads(const SteadyCycle& c, std::vector<Verdict>& verdicts) {
  if (!c.loads.found) return;
  RunUp none;
  none.words = "kurbel modes judges the start, kurbel run the load cases of its run";
  const std::vector<LimitedJoint> joints = limited_joints(*c.model);
  const auto head = [](const Verdict& v) { return v.requirement.substr(0, v.requirement.find(':')); };
  for (Verdict& v : judge(joints, c.loads, none, {}, c.model->scene.speed_unit)) {
    const auto* const joint = find_by(joints, &LimitedJoint::name, v.component);
    std::erase_if(verdicts, [&](const Verdict& other) {
      const bool same =
          other.component == v.component || (joint && other.component == joint->component);  // of its segments together
      return same && head(other) == head(v) && other.load_case == v.load_case;
    });
    verdicts.push_back(std::move(v));
  }
}

}  // namespace

std::string complex_text(std::complex<double> z) {
  if (z.imag() == 0) return fmt::format("{:.6g}", z.real());
  return fmt::format("{:.6g} {} {:.6g} i", z.real(), z.imag() < 0 ? "−" : "+", std::abs(z.imag()));
}

std::string why_not_held(const Scene& scene, const std::string& by, double value) {
  const Key* const key = quantity_place(scene.components, by).key;
  if (!key || key->domain.contains(value)) return {};
  return fmt::format("that speed would need {} = {}, which must be {}; take another speed or another quantity", by,
                     with_unit(value, key->unit, 4), key->domain.describe(key->unit));
}

std::vector<std::string> words_of(const SteadyCycle& c) {
  std::vector<std::string> words;
  if (!c.found) return {fmt::format("NOT found: {}", c.why)};
  words.push_back(c.stability);
  if (!c.orbit.empty()) words.push_back(fmt::format("{}: {}", name_of(c.kind), c.orbit));
  words.push_back(fmt::format(
      "{} unknown{} on the section at {:.4g}°; {}{} cycle{} of Newton's method ({} with derivative), cost {:.3g} "
      "cycles (target {:.0f}{}), {}; P(z) − z = {:.1e}; works of the cycle close to {:.1e}",
      c.unknowns, c.unknowns == 1 ? "" : "s", std::abs(c.section) < 1e-9 ? 0 : c.section * in_degrees,
      c.run_cycles > 0 ? fmt::format("a run of {} cycle{} from its start, ", c.run_cycles, c.run_cycles == 1 ? "" : "s")
                       : "",
      c.point.periods, c.point.periods == 1 ? "" : "s", c.point.derivatives, c.cost, c.cost_limit,
      c.cost > c.cost_limit && 2 * c.run_cycles > c.cost ? "; mostly the run-up" : "", duration_text(c.cpu_seconds),
      c.point.residual, c.work_residual));
  if (c.point.grazed)
    words.push_back("an event is only just touched on the way: there the multipliers depend on the side");
  const auto torque = [&c](double of_motor) {
    return short_text(without_rounding({of_motor}, c.model->torque_scale).value, "N*m");
  };
  for (const MotorUse& m : c.motors)
    words.push_back(fmt::format(
        "drive \"{}\": mean torque {}, RMS {}, peak {}{}", m.component, torque(m.mean), torque(m.rms), torque(m.peak),
        m.rated ? fmt::format("; thermal use RMS/rated = {} of {}", percent(*m.thermal()), short_text(*m.rated, "N*m"))
                : ""));
  if (!c.added_at.empty())
    words.push_back(fmt::format("the demanded speed needs {} N·m beside the scene's drive at \"{}\"{}",
                                number(c.added_torque), c.added_at,
                                std::abs(c.added_torque) < 1e-6 * c.model->torque_scale
                                    ? ": nothing, the machine has a cycle of this speed as it is"
                                    : ""));
  return words;
}

Claims claims_of(const SteadyStudy& s) {
  if (s.cycles.empty()) return {*claimed(Predicate::incomplete, s.conclusion, s.link)};  // interrupted before the first
  const SteadyCycle& last = s.cycles.back();
  Claims claims = last.model ? start_claims(last.model) : Claims{};
  const bool vibrates = last.kind == Orbit::Kind::vibrating;
  const Figure* reported = last.find(vibrates ? "vibration_frequency" : "mean_speed." + s.link);
  add(claims, claimed(!s.complete ? Predicate::incomplete
                      : vibrates  ? Predicate::vibrates
                                  : Predicate::runs_steadily,
                      s.conclusion, s.link,
                      s.complete && reported
                          ? Evidence{.value = reported->value, .error = reported->error, .unit = reported->unit}
                          : Evidence{}));
  for (const SteadyCycle& c : s.cycles)
    if (c.found && !c.uncertain && !c.neutral)
      add(claims,
          claimed(Predicate::steady_motion_unstable,
                  fmt::format("In the {} model the steady motion does not last: it is {}", c.label, c.stability), {},
                  {.value = c.point.largest(),
                   .limit = 1,
                   .error = c.multiplier_errors.empty() ? std::nullopt : std::optional(c.multiplier_errors.front())}));
  for (const std::string& sentence : last.outside_data)
    add(claims, claimed(Predicate::outside_data, capitalised(sentence)));
  claims.insert(claims.end(), last.starters.begin(), last.starters.end());
  for (const MotorUse& use : last.motors) {
    const Figure* rms = last.find("rms_drive_torque." + use.component);
    if (!use.rated) continue;
    Estimate share{*use.thermal()};
    if (rms && rms->error) share.error = *rms->error / *use.rated;
    add(claims, overload_claim(*last.model, use.component, share, true));
  }
  return claims;
}

std::vector<std::string> words_of_diagram(const SteadyStudy& s) {
  if (!s.diagram) return {"No operating diagram: " + s.no_diagram};
  std::vector<std::string> words;
  const OperatingDiagram& d = *s.diagram;
  for (const OperatingPoint& p : d.points)
    words.push_back(headline(
        fmt::format("Operating point {}{} at {}, {}: dM_d/dω = {} N·m·s/rad {} dM_c/dω = {} N·m·s/rad",
                    d.estimate ? "about " : "", with_error(p.speed / d.speed_unit.size, d.speed_unit.name),
                    p.torque.value == 0 ? "0 N·m" : with_error(p.torque, "N*m"), p.stable() ? "stable" : "unstable",
                    beside(p.drive_slope, p.load_slope), p.stable() ? "<" : "≥", beside(p.load_slope, p.drive_slope))));
  // A mean that suffices does not carry the machine over every peak: no margin of what stalls.
  const bool runs = std::any_of(s.cycles.begin(), s.cycles.end(), [](const SteadyCycle& c) { return c.found; });
  if (const OperatingPoint* p = d.working_point(); runs && p && d.margin(*p).value > 1 + 1e-6)
    words.push_back(headline(fmt::format(
        "Margin: the drive's mean torque is at most {} (at {}), {}", with_unit(d.strongest.value, "N*m"),
        std::abs(d.strongest_at) < 1e-4 * std::abs(p->speed.value) ? "standstill" : d.speed_unit.text(d.strongest_at),
        std::isfinite(d.margin(*p).value) ? with_error(d.margin(*p), "") + " times what the load needs"
                                          : "and the loads' mean torque is zero")));
  if (const std::string none = d.why_none(s.link); !none.empty() && d.uses_speed) words.push_back(none);
  return words;
}

Record operating_point(const OperatingDiagram& d, const OperatingPoint& p) {
  return {{"drive_slope", p.drive_slope}, {"load_slope", p.load_slope}, {"stable", p.stable()}, {"speed", p.speed},
          {"torque", p.torque},           {"margin", d.margin(p)}};
}

std::vector<std::string> words_of_start(const SteadyStudy& s) {
  std::vector<std::string> words;
  if (s.start)
    words.push_back(s.start->reached ? fmt::format("Start: from rest to 95 % of the steady speed in {}",
                                                   headline(with_error(s.start->time, "s")))
                                     : "Start: " + s.start->why);
  for (const RatioSearch& r : s.ratios)
    words.push_back(fmt::format(
        "The driven side of \"{}\" has 95 % of its present steady speed soonest with ratio {}{}: {}; {}", r.gearbox,
        number(r.best), r.at_bound ? " (the end of what was tried)" : "", short_text(r.best_time, "s"),
        r.present_time > 0 ? fmt::format("its ratio is {}: {}", number(r.present), short_text(r.present_time, "s"))
                           : fmt::format("with its ratio of {} the machine does not start", number(r.present))));
  return words;
}

std::string stability_text(const std::vector<std::complex<double>>& multipliers, std::optional<double>* halving,
                           double error, int period) {
  if (halving) halving->reset();
  const std::complex<double> slowest = multipliers.empty() ? 0 : multipliers.front();
  const double size = std::abs(slowest);
  const char* swinging = std::abs(slowest.imag()) > 1e-9 * size || slowest.real() < -1e-9 ? ", oscillating" : "";
  if (!multipliers.empty() && std::abs(size - 1) <= error)
    return "neutral: a deviation neither fades nor grows (multiplier 1), the cycle is one of a family";
  if (size > 1)
    return fmt::format("unstable: a deviation doubles in {:.3g} cycles{}", period * std::log(2.0) / std::log(size),
                       swinging);
  if (size < 1e-3)
    return fmt::format("stable: {} less than 0.1 % of any deviation",
                       period == 1 ? "a cycle leaves" : fmt::format("{} cycles leave", period));
  const double cycles = period * std::log(2.0) / -std::log(size);
  if (halving) *halving = cycles;
  return fmt::format("stable: the slowest deviation halves in {:.3g} cycles{}", cycles, swinging);
}

std::vector<Verdict> steady_ratings(const SteadyCycle& c) {
  if (!c.found || !c.model) return {};
  Result as_run;
  as_run.model = c.model;
  as_run.errors_measured =
      std::any_of(c.figures.begin(), c.figures.end(), [](const Figure& f) { return f.error.has_value(); });
  for (const Figure& f : c.figures) {
    if (f.what == quantities::cycle_peak_torque)
      as_run.figures.push_back(renamed(f, Name::make(quantities::peak_torque, f.of)));
    if (f.words() == "greatest_torque" || f.words() == "least_torque") as_run.figures.push_back(f);
    if (f.what == quantities::rms_drive_torque)
      as_run.figures.push_back(renamed(f, Name::own("motor_rms_torque", f.of)));
  }
  add_rim_speeds(c, as_run);
  std::vector<Figure> strands = rating_figures(*c.model, nullptr, as_run.figures, 0, 0);
  for (Figure& strand : strands) {
    const Figure* peak = as_run.find(quantities::peak_torque, strand.of);
    // F = F₀ + |τ|/(2 r₁): its error is that of the torque, by the same slope.
    if (peak && peak->error && peak->value != 0) {
      std::vector<Figure> moved = {*peak};
      moved.front().value += std::copysign(*peak->error, peak->value);
      for (const Figure& other : rating_figures(*c.model, nullptr, moved, 0, 0))
        if (other.name == strand.name) strand.error = std::abs(other.value - strand.value);
    }
    as_run.figures.push_back(std::move(strand));
  }
  std::vector<Verdict> verdicts = judge_ratings(as_run, load_case::steady);
  add_loads(c, verdicts);
  return verdicts;
}

}  // namespace kurbel
