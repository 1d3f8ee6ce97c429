// run_claims.cpp — the result of a run in a sentence; and what is wrong with it.
#include "studies/answers/run_claims.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "drivetrain/shared/rating_keys.h"
#include "engine/numerics/index.h"
#include "studies/answers/motion_claims.h"
#include "studies/claims/headline.h"
#include "studies/findings/figure_text.h"

namespace kurbel {
namespace {

std::string first_line(const std::string& text) { return text.substr(0, text.find('\n')); }

// The final motion of a run without faults.
class RunWords {
 public:
  explicit RunWords(const Result& result) : r_(result), p_(result.periods) {}

  std::optional<Claim> all() const {
    if (p_.steady) return stands_within_the_cycle() ? strokes() : steady();
    const Figure* last = figure(quantities::final_speed);
    const bool rests = last && last->value == 0;
    const std::string end = !last                  ? std::string()
                            : rests                ? "at rest"
                            : !swing().empty()     ? swing()
                            : all_but_rests(*last) ? "nearly at rest" + trembling(last->value)
                                                   : "at " + speed_and_sense(last->value);
    const Evidence at_end = last ? of(*last) : Evidence{.at = r_.until};
    if (r_.model && !r_.model->commands.empty())
      return claimed(Predicate::goes_through_sequence,
                     fmt::format("\"{}\" goes through its operating sequence{}{}", link(),
                                 end.empty() ? "" : " and ends " + end, held()),
                     link(), at_end);
    if ((p_.remaining || p_.without_limit || p_.unsettled) &&
        (p_.run_down_begin || (swing().empty() && held().empty())))
      return claimed(
          Predicate::not_steady_yet,
          fmt::format(
              "\"{}\" has not reached a steady motion by {}: {}{}{}", link(),
              p_.run_down_begin ? seconds(*p_.run_down_begin) + ", where it begins to run down" : seconds(r_.until),
              p_.verdict, p_.standstill ? fmt::format("; it rests at {}{}", seconds(*p_.standstill), held()) : "",
              at_the_end()),
          link(), {.at = p_.run_down_begin.value_or(r_.until), .value = p_.remaining, .unit = "rad/s"});
    if (end.empty()) return {};
    if (const Event* const rest = rests ? came_to_rest() : nullptr) {
      Evidence evidence = at_end;
      evidence.at = rest->t;
      return claimed(Predicate::at_rest, fmt::format("\"{}\" comes to rest at {}{}", link(), seconds(rest->t), held()),
                     link(), std::move(evidence));
    }
    return claimed(
        rests ? Predicate::at_rest : Predicate::moves,
        fmt::format("\"{}\" is {} after {}{}{}", link(), end, seconds(r_.until), beyond(last->value), held()), link(),
        at_end);
  }

 private:
  // The event with which the link came to rest, and after which it has not moved; null: none is known.
  const Event* came_to_rest() const {
    const Model& m = *r_.model;
    const std::string shaft = m.node_label(m.shafts[at(m.shaft_of_node[at(m.reduction_node)])].reference);
    const auto last = std::find_if(r_.events.rbegin(), r_.events.rend(), [&](const Event& e) {
      return e.component == shaft && (e.kind == EventKind::rest || e.kind == EventKind::motion);
    });
    return last != r_.events.rend() && last->kind == EventKind::rest && last->t > r_.begins_at ? &*last : nullptr;
  }
  // Residual vibration in shafts that are held.
  bool all_but_rests(const Figure& last) const {
    return r_.model && std::abs(last.value) < 0.01 * r_.model->speed_scale;
  }
  std::string trembling(double value) const {
    constexpr double rounding = 1e-9;  // of the usual speed
    return std::abs(value) > rounding * r_.model->speed_scale ? fmt::format(" ({})", speed(value)) : "";
  }
  // The last repetition of a clocked sequence began late.
  std::string late() const {
    const double every = r_.model ? r_.model->scene.sequence.every : 0;
    const auto last = std::find_if(r_.events.rbegin(), r_.events.rend(), [](const Event& e) {
      return e.kind == EventKind::note && e.component == "sequence";
    });
    if (every == 0 || last == r_.events.rend() || last->t + last->value.value_or(0) < r_.until - every) return {};
    return fmt::format(" instead of {}, as its sequence takes longer", seconds(every));
  }
  // Nothing in the scene gives such a speed, and the cycles are too few to decide whether it goes on.
  std::string beyond(double speed) const {
    return r_.model && std::abs(speed) > far_away * r_.model->speed_scale
               ? times_the_speed_of_its_data(*r_.model, speed)
               : std::string();
  }
  // The link stops or reverses in every cycle: such a motion repeats but has no steady speed.
  bool stands_within_the_cycle() const {
    const Figure* delta = figure(quantities::delta);
    return delta && delta->value + delta->error.value_or(0) >= 2;
  }
  // Within the last period, in both senses by more than rounding, and on the whole not through a cycle.
  bool turns_back() const {
    const auto end = std::find_if(r_.cycles.rbegin(), r_.cycles.rend(),
                                  [&](const CycleRecord& c) { return c.end <= p_.judged_until; });
    double least = 0, greatest = 0, turned = 0;
    for (auto c = end; c != r_.cycles.rend() && c - end < p_.cycles; ++c) {
      least = std::min(least, c->omega_min), greatest = std::max(greatest, c->omega_max);
      turned += c->turned;
    }
    const double rounding = 1e-6 * r_.model->speed_scale;
    const bool gets_on = r_.model->cycle > 0 && std::abs(turned) > 0.5 * r_.model->cycle;
    return least < -rounding && greatest > rounding && !gets_on;
  }
  std::optional<Claim> strokes() const {
    const Figure* time = figure(quantities::cycle_time);
    if (!time) time = r_.find(quantities::period, "");
    if (time && turns_back())
      return claimed(Predicate::works_in_strokes,
                     fmt::format("\"{}\" moves to and fro with a period of {}", link(), seconds(time->value)), link(),
                     of(*time));
    return claimed(Predicate::works_in_strokes,
                   fmt::format("\"{}\" makes single strokes{}, and rests between them", link(),
                               time ? fmt::format(", one every {}{}", seconds(time->value), late()) : ""),
                   link(), time ? of(*time) : Evidence{});
  }
  std::optional<Claim> steady() const {
    const Figure* mean = figure(quantities::mean_speed);
    std::string text =
        fmt::format("\"{}\" runs steadily at {}", link(), speed_and_sense(mean ? mean->value : p_.steady_speed));
    if (p_.run_up_end) text += fmt::format(" from {} on", seconds(*p_.run_up_end));
    const std::string period = r_.model ? period_in_words(p_, r_.model->cycle) : "";
    if (!period.empty()) text += fmt::format(", where its motion repeats every {}{}", period, late());
    if (p_.run_down_begin) text += fmt::format(", runs down from {}", seconds(*p_.run_down_begin));
    if (p_.standstill) text += fmt::format(" and rests at {}{}", seconds(*p_.standstill), held());
    if (p_.run_down_begin) text += at_the_end();
    Evidence evidence = mean ? of(*mean) : Evidence{.value = p_.steady_speed, .unit = "rad/s"};
    evidence.at = p_.run_up_end;
    return claimed(Predicate::runs_steadily, std::move(text), link(), std::move(evidence));
  }
  // "vibrating, at up to 5 rpm": where it passes through rest, the speed of that moment has no meaning.
  std::string swing() const {
    for (const Claim& c : r_.claims)
      if (c.predicate == Predicate::vibrates && !c.clause.empty()) return c.clause;
    return {};
  }
  // "; it turns backwards at the end, at −21 rad/s"; or faster than ever before, after its drive was switched off.
  std::string at_the_end() const {
    constexpr double least = 0.01, same = 1e-3, faster = 1.1;  // of the usual speed, of a speed, than before
    const Figure *last = figure(quantities::final_speed), *fastest = figure(quantities::max_speed);
    if (p_.standstill || !last || !fastest || r_.model->scene.run.start.speed < 0) return {};
    const double slow = least * r_.model->speed_scale;
    if (last->value < -slow && (!p_.run_down_begin || fastest->value > slow))
      return fmt::format("; it turns backwards at the end, at {}", speed(last->value));
    if (!p_.run_down_begin || last->value < std::max(slow, (1 - same) * fastest->value) || p_.steady_speed == 0 ||
        last->value < faster * std::abs(p_.steady_speed))
      return {};
    return fmt::format("; its loads drove it on, to {} at the end", speed(last->value));
  }
  // ", held by "brake" against the 147 N·m that act on it": for a link at rest with a torque on it; a motor's is another
  // sentence.
  std::string held() const {
    for (const Claim& c : r_.claims)
      if (c.predicate == Predicate::held_by && !c.clause.empty())
        return c.of == link() ? ", " + c.clause : "; " + c.text;
    return {};
  }
  // A motion that began forwards, or at rest, may be backwards.
  std::string speed_and_sense(double value) const {
    return speed(value) + (value < 0 && r_.model && r_.model->scene.run.start.speed >= 0 ? " (backwards)" : "");
  }
  static Evidence of(const Figure& f) { return {.at = f.at, .value = f.value, .error = f.error, .unit = f.unit}; }
  std::string link() const { return r_.model ? r_.model->network.nodes[at(r_.model->reduction_node)].component : "it"; }
  const Figure* figure(const QuantityKind& what) const { return r_.model ? r_.find(what, link()) : nullptr; }
  std::string speed(double value) const {
    return short_text(value, "rad/s", r_.model ? r_.model->scene.speed_unit : SpeedUnit{});
  }
  static std::string seconds(double t) { return short_text(t, "s"); }

  const Result& r_;
  const Periods& p_;
};

// Of a motor without a duty the rated torque is a limit of steady motion.
void motors_not_assessed(const Result& r, Claims& claims) {
  if (!r.model || r.periods.steady) return;
  for (const MotorTorque& motor : r.model->motors) {
    const auto* rating = r.model->network.data.find<MotorRating>(motor.component);
    if (!rating || !rating->torque || rating->states_duty() || r.find("thermal_use." + motor.component)) continue;
    std::optional<Claim> claim =
        claimed_aside(Predicate::not_assessed,
                      fmt::format("\"{}\", RMS torque ({}): not assessed", motor.component, load_case::steady),
                      motor.component, {.limit = *rating->torque, .unit = "N*m"});
    claim->load_case = load_case::steady;
    add(claims, std::move(claim));
  }
}

// Alternate rest and motion of a shaft other than the link, in one sense, while the link turns.
void sticking_shafts(const Result& r, Claims& claims) {
  if (!r.model || !r.model->commands.empty() || !r.periods.steady) return;
  const std::string& link = r.model->network.nodes[at(r.model->reduction_node)].component;
  struct Rests {
    int count = 0;
    double first = 0;
    bool forwards = false, backwards = false;
  };
  std::map<std::string, Rests> shafts;
  for (const Event& e : r.events) {
    if (e.component == link) continue;
    Rests& rests = shafts[e.component];
    if (e.kind == EventKind::rest && rests.count++ == 0) rests.first = e.t;
    if (e.kind == EventKind::motion) (e.value.value_or(0) < 0 ? rests.backwards : rests.forwards) = true;
  }
  for (const auto& [shaft, rests] : shafts)
    if (!(rests.forwards && rests.backwards))
      add(claims, claimed(Predicate::sticks_and_slips,
                          fmt::format("\"{}\" sticks and slips: it rests {} times, first at {}, while \"{}\" turns",
                                      shaft, rests.count, short_text(rests.first, "s"), link),
                          shaft, {.at = rests.first, .value = rests.count, .limit = 2}));
}

void overloaded_motors(const Result& r, Claims& claims) {
  for (const Figure& f : r.figures) {
    const bool by_torque = f.words() == "thermal_use";
    if (!r.model || (!by_torque && f.words() != "current_use")) continue;
    const std::string period = period_in_words(r.periods, r.model->cycle);
    const std::string of = r.model->commands.empty() ? "its steady motion"
                           : period.empty()          ? "its heaviest cycle"
                                                     : "its heaviest period of " + period;
    add(claims, overload_claim(*r.model, f.of, f, by_torque, of));
  }
}

}  // namespace

std::string period_in_words(const Periods& p, double cycle) {
  if (p.time > 0) return fmt::format("{:.6g} s", p.cycles * p.time);
  if (p.cycles == 1) return {};
  const double turns = p.cycles * cycle / (2 * std::numbers::pi);
  const bool whole = std::abs(turns - std::round(turns)) < 1e-9;
  return whole ? fmt::format("{:.0f} turns", turns) : fmt::format("{} cycles", p.cycles);
}

std::optional<Claim> overload_claim(const Model& model, const std::string& motor, const Estimate& use, bool by_torque,
                                    const std::string& of) {
  const auto* rating = model.network.data.find<MotorRating>(motor);
  if (!rating || rating->states_duty()) return {};
  const double rated = by_torque ? rating->torque.value_or(0) : 0;
  const double most = use.value + use.error.value_or(0);
  std::optional<Claim> claim =
      claimed(Predicate::motor_overloaded,
              fmt::format("\"{}\" gets too hot: the {} of {} is {:.0f} % of the rated one{}", motor,
                          by_torque ? "RMS torque" : "RMS current", of, 100 * use.value,
                          rated > 0 ? fmt::format("; by an estimate it holds from a rated torque of {:.4g} N·m on",
                                                  enough(rated * most))
                                    : ""),
              motor, {.value = use.value, .limit = 1, .error = use.error});
  if (claim) claim->load_case = load_case::steady;
  return claim;
}

Claims run_claims(const Result& r, const std::string& whose) {
  Claims claims = r.claims;
  if (!r.complete) {
    add(claims, claimed(Predicate::incomplete, "INCOMPLETE: " + first_line(r.diagnosis)));
    for (Claim& c : claims) c.text = capitalised(whose) + c.text;
    return claims;
  }
  if (std::none_of(claims.begin(), claims.end(),
                   [](const Claim& c) { return c.topic() == Topic::runs && c.in_conclusion; }))
    add(claims, RunWords(r).all());
  overloaded_motors(r, claims);
  motors_not_assessed(r, claims);
  sticking_shafts(r, claims);
  if (r.unconfirmed())
    add(claims,
        claimed(Predicate::not_confirmed, "NOT confirmed: " + r.accuracy_in_words(), {},
                {.value = r.errors_measured ? std::optional(r.measured_accuracy) : std::nullopt, .limit = r.accuracy}));
  for (Claim& c : claims) c.text = capitalised(whose + c.text);
  return claims;
}

}  // namespace kurbel
