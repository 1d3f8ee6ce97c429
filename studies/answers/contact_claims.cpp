// contact_claims.cpp — clutches, limiters, belts, brakes, joints that jam: by the final state and by records during the run.
#include "studies/answers/motion_claims.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>
#include <utility>

#include "engine/numerics/index.h"
#include "engine/run/run.h"
#include "mechanisms/reduced/mechanism.h"
#include "studies/answers/holders.h"

namespace kurbel {
namespace {

constexpr double slipping_from = 1e-3;   // of the usual speed: below it a shaft stands, or nothing slips
constexpr double transmits_from = 1e-6;  // of the usual torque
constexpr double most_of = 0.95;         // of a brake's torque

std::string so_often(int count) { return count == 1 ? "once" : count == 2 ? "twice" : fmt::format("{} times", count); }

class ContactJudge {
 public:
  ContactJudge(Equations& equations, const RunOutcome& outcome, const Result& result, const SlipRecorder& slips)
      : equations_(equations),
        m_(equations.model()),
        outcome_(outcome),
        result_(result),
        slips_(slips),
        now_(equations.snapshot(outcome.t, outcome.state)) {}

  Claims all() {
    brakes();
    for (const SlipRecorder::Joint& joint : slips_.joints()) slipping_joint(joint);
    slipping_belts();
    return std::move(claims_);
  }

 private:
  std::string text(double speed) const { return m_.scene.speed_unit.text(std::abs(speed)); }
  bool is_kind(const std::string& component, const char* kind) const { return m_.network.kind_of(component) == kind; }
  const std::string& owner_of(const ElasticJoint& joint) const { return m_.network.joints[at(joint.joint)].component; }

  // Error of the speeds of a component's shafts at the end; empty: not measured.
  std::optional<double> error_of_speeds(const std::string& component) const {
    const auto found = result_.final_state.find(component);
    if (found == result_.final_state.end() || !found->second.speed.error) return {};
    return *found->second.speed.error + (found->second.speed_out ? found->second.speed_out->error.value_or(0) : 0);
  }
  // Error of a speed during the run: the largest one of its speeds, and at most the usual value times the largest relative
  // error of its figures; an angle may be far off where all speeds are known.
  double error_on_the_way(double usual) const {
    if (!result_.errors_measured) return usual * result_.tolerance;
    double largest = 0;
    for (const Figure& f : result_.figures)
      if (f.unit == "rad/s") largest = std::max(largest, f.error.value_or(HUGE_VAL));
    return std::min(usual * result_.measured_accuracy, largest);
  }

  // --- what slips ---

  void slips_to_the_end(const ElasticJoint& joint, double slip) {
    const double torque = now_.joint_torque[joint.joint];
    const double usual = joint.gain_a * m_.shafts[at(joint.shaft_a)].speed_scale;
    if (!(std::abs(slip) > slipping_from * std::abs(usual)) || !(std::abs(torque) > transmits_from * m_.torque_scale))
      return;
    const std::string& component = owner_of(joint);
    slipping_.insert(component);
    add(claims_, claimed(Predicate::slips_to_the_end,
                         fmt::format("\"{}\" slips to the end, by {} under the {} N·m that it can transmit{}",
                                     component, text(slip), std::abs(torque), backwards(joint)),
                         component,
                         {.at = outcome_.t,
                          .value = std::abs(slip),
                          .limit = 0,
                          .error = error_of_speeds(component),
                          .unit = "rad/s"}));
  }
  // Of a machine without a cycle, whose loads do not pass: its far side turns against the side that drives it.
  std::string backwards(const ElasticJoint& joint) const {
    constexpr double turns_from = 1e-2;  // of the usual speed
    const double slow = turns_from * joint.gain_a * m_.shafts[at(joint.shaft_a)].speed_scale;
    const double a = joint.gain_a * now_.now.speed[joint.shaft_a], b = joint.gain_b * now_.now.speed[joint.shaft_b];
    if (m_.cycle > 0 || !(a * b < 0) || !(std::min(std::abs(a), std::abs(b)) > std::abs(slow))) return {};
    return fmt::format(", and what it drives turns backwards, at {}", m_.scene.speed_unit.text(b));
  }
  double slip_of(const ElasticJoint& joint) const {
    return joint.gain_a * now_.now.speed[joint.shaft_a] - joint.gain_b * now_.now.speed[joint.shaft_b];
  }
  void spell(Predicate predicate, const SlipRecorder::Joint& joint, const SlipRecorder::Spell& spell, std::string words,
             bool aside) {
    if (spell.times == 0) return;
    std::optional<Claim> claim = claimed(predicate, std::move(words), joint.component,
                                         {.at = spell.first,
                                          .value = spell.fastest,
                                          .limit = 0,
                                          .error = error_on_the_way(joint.usual_speed),
                                          .unit = "rad/s"});
    if (claim) claim->in_conclusion = !aside;
    add(claims_, std::move(claim));
  }
  void slipping_joint(const SlipRecorder::Joint& joint) {
    const ElasticJoint& e = m_.elastic[joint.elastic];
    const std::string& name = joint.component;
    if (joint.kind == "one-way clutch") {
      const double ahead_now = std::abs(slip_of(e));  // of a link that has come to rest
      const bool goes_on = result_.periods.standstill && ahead_now > slipping_from * std::abs(joint.usual_speed);
      for (const SlipRecorder::Spell* ahead : {&joint.engaging, &joint.let_go})
        spell(Predicate::freewheel_overruns, joint, *ahead,
              fmt::format("\"{}\" lets its driven side run ahead, first at {:.4g} s{}", name, ahead->first,
                          goes_on ? fmt::format(", by {} at the end", text(ahead_now)) : ""),
              !goes_on);
      return;
    }
    if (joint.closed && equations_.modes().slip[joint.elastic] != 0) slips_to_the_end(e, slip_of(e));
    const bool limiter = joint.kind == "torque limiter";
    if (!slipping_.count(name))
      spell(limiter ? Predicate::limiter_slips : Predicate::clutch_slips_closed, joint, joint.let_go,
            fmt::format("\"{}\" slips {}{}, first at {:.4g} s: the torque reaches the {:.4g} N·m that it holds", name,
                        so_often(joint.let_go.times), limiter ? "" : " although it is closed", joint.let_go.first,
                        m_.network.joints[at(e.joint)].element->capacity),
            false);
    const bool in_vain = !joint.gripped && joint.in_vain > 0 && !slipping_.count(name);
    spell(Predicate::clutch_slips_engaging, joint, joint.engaging,
          in_vain ? fmt::format("\"{}\" slips whenever it is closed, {}, first at {:.4g} s, and is opened each time "
                                "before its sides turn together",
                                name, so_often(joint.engaging.times), joint.engaging.first)
                  : fmt::format("\"{}\" slips while it engages, {}, first at {:.4g} s", name,
                                so_often(joint.engaging.times), joint.engaging.first),
          !in_vain);
    if (joint.open.times == 0) return;
    const bool to_the_end = joint.state == SlipRecorder::State::open && joint.open.times == 1 && joint.open.first == 0;
    add(claims_, claimed(Predicate::clutch_opened_by_command,
                         fmt::format("\"{}\" is open by command{}", name,
                                     to_the_end ? ", from the start to the end"
                                                : fmt::format(", first at {:.4g} s", joint.open.first)),
                         name, {.at = joint.open.first}));
    claims_.back().in_conclusion = to_the_end;
  }

  // Rigid belts are contacts; elastic ones have their slip as an internal state.
  void slipping_belts() {
    for (std::size_t e = 0; e < m_.elastic.size(); ++e)
      if (m_.elastic[e].slips && equations_.modes().slip[e] != 0 && is_kind(owner_of(m_.elastic[e]), "belt"))
        slips_to_the_end(m_.elastic[e], slip_of(m_.elastic[e]));
    for (std::size_t k = 0; k < m_.internal_states.size(); ++k) {
      if (m_.internal_states[k].state.name != "slipped_angle") continue;
      for (const ElasticJoint& joint : m_.elastic)
        if (owner_of(joint) == m_.internal_states[k].component) slips_to_the_end(joint, now_.sums.internal_rate[k]);
    }
    for (const std::string& component : m_.network.components)
      if (is_kind(component, "belt") && !slipping_.count(component)) slips_at_times(component);
  }
  // For an elastic or a rigid belt.
  void slips_at_times(const std::string& belt) {
    int count = 0;
    double first = 0, slipping = 0;
    std::optional<double> since;
    for (const Event& event : outcome_.events) {
      const bool slips = event.kind == EventKind::slip, ends = event.kind == EventKind::lock;
      if (event.component != belt || !(slips || ends)) continue;
      slipping += event.t - since.value_or(event.t);
      since = slips ? std::optional(event.t) : std::nullopt;
      if (slips && event.from != event.what && ++count == 1) first = event.t;
    }
    if (count == 0) return;
    add(claims_, claimed(Predicate::belt_slips,
                         fmt::format("\"{}\" slips {}, first at {:.4g} s, for {:.4g} s in all, and grips again", belt,
                                     so_often(count), first, slipping),
                         belt, {.at = first, .value = count}));
  }

  // --- brakes ---

  // An applied brake whose shaft still turns: applied by command, in its window of time, or from the start and acting
  // as a load only.
  void brakes() {
    for (std::size_t e = 0; e < m_.network.elements.size(); ++e) {
      const Network::ShaftElement& element = m_.network.elements[e];
      if (!is_kind(element.component, "brake")) continue;
      if (m_.scene.sequence.repeat) released_while_it_turns(element);
      if (!equations_.modes().active[e]) continue;
      const auto put = std::find_if(outcome_.events.rbegin(), outcome_.events.rend(), [&](const Event& event) {
        return event.kind == EventKind::command && event.component == element.component;
      });
      if (put != outcome_.events.rend() && !(put->value.value_or(0) > 0)) continue;
      const double put_on = put != outcome_.events.rend() ? put->t : element.window.first_on();
      const std::size_t shaft = at(m_.shaft_of_node[at(element.node)]);
      const double gain = m_.gain_of_node[at(element.node)], torque = now_.sums.element_torque[e];
      const double speed = gain * now_.now.speed[shaft], change = gain * now_.alpha[shaft];
      if (equations_.at_standstill(shaft) ||
          std::abs(speed) <= slipping_from * m_.speed_scale * m_.scale_ratio[at(element.node)])
        continue;
      if (!(std::abs(torque) > transmits_from * m_.torque_scale)) continue;
      const std::string slips =
          fmt::format("{}{}", text(speed), speed * m_.node_ratio[at(element.node)] < 0 ? ", backwards," : "");
      const double ratio = m_.node_ratio[at(element.node)];
      const bool driven =
          ratio != 0 && driving_torque(equations_, now_, shaft) * speed / ratio >= most_of * std::abs(torque * speed);
      if (put_on > 0 && is_full(element.component))
        does_not_stop(e, put_on, speed, change, std::abs(torque), driven, slips);
      else if (put_on > 0)
        continue;  // its ramp goes on
      else
        add(claims_, claimed(Predicate::slips_to_the_end,
                             fmt::format("\"{}\" is on and slips to the end, at {} under its {:.4g} N·m",
                                         element.component, slips, std::abs(torque)),
                             element.component,
                             {.at = outcome_.t,
                              .value = std::abs(speed),
                              .limit = 0,
                              .error = error_of_speeds(element.component),
                              .unit = "rad/s"}));
    }
  }
  // A sequence that repeats takes it off again whenever it was put on, and its shaft has never come to rest.
  void released_while_it_turns(const Network::ShaftElement& brake) {
    const std::string shaft = m_.node_label(m_.shafts[at(m_.shaft_of_node[at(brake.node)])].reference);
    int released = 0;
    double first = 0;
    bool on = false;
    for (const Event& event : outcome_.events) {
      if (event.component == shaft && (event.kind == EventKind::rest || event.kind == EventKind::motion)) return;
      if (event.component != brake.component || event.kind != EventKind::command) continue;
      const bool now = event.value.value_or(0) > 0;
      if (std::exchange(on, now) && !now && ++released == 1) first = event.t;
    }
    if (released < 2) return;
    add(claims_,
        claimed(Predicate::brake_has_not_stopped,
                fmt::format("\"{}\" is taken off {} while its shaft still turns, first at {:.4g} s, and has never "
                            "stopped it",
                            brake.component, so_often(released), first),
                brake.component, {.at = first, .value = released, .limit = 0}));
  }
  bool is_full(const std::string& brake) const {
    const int c = m_.command_of(brake);
    return c < 0 || equations_.modes().command[at(c)].holds_still();
  }
  // `driven`: what drives the shaft takes nearly all of the brake's torque, so that what is left does not stop it.
  void does_not_stop(std::size_t element, double put_on, double speed, double change, double torque, bool driven,
                     const std::string& slips) {
    const std::string& brake = m_.network.elements[element].component;
    // Shafts that run steadily with it slow down within a cycle only, unless a sequence repeats its braking. Whether they do
    // is not judged from a brake of the last moments.
    constexpr double long_enough = 0.25;  // of the run
    const bool goes_on = result_.periods.steady && !result_.periods.run_down_begin && !m_.scene.sequence.repeat &&
                         (driven || outcome_.t - put_on > long_enough * outcome_.t);
    const double braked = outcome_.t - put_on,
                 more = speed * change < 0 && !goes_on ? std::abs(speed / change) : HUGE_VAL;
    const Evidence evidence{
        .at = put_on, .value = std::abs(speed), .limit = 0, .error = error_of_speeds(brake), .unit = "rad/s"};
    const bool is_weak = more == HUGE_VAL || (driven && more > outcome_.t);
    if (const std::optional<std::string> held = until_it_broke_away(element, put_on)) {
      if (is_weak || is_done())
        add(claims_,
            claimed(is_weak ? Predicate::brake_does_not_stop : Predicate::brake_has_not_stopped,
                    fmt::format("\"{}\" {}; it slips at {} at the end", brake, *held, slips), brake, evidence));
      return;
    }
    if (is_weak)
      add(claims_, claimed(Predicate::brake_does_not_stop,
                           fmt::format("\"{}\" does not stop it: it slips at {} after {:.3g} s; its {:.4g} N·m are too "
                                       "weak for what drives",
                                       brake, slips, braked, torque),
                           brake, evidence));
    else if (is_done())  // while a sequence goes on it is a matter of time
      add(claims_, claimed(Predicate::brake_has_not_stopped,
                           fmt::format("\"{}\" has not stopped it by the end: {} are left after {:.3g} s, and {:.3g} s "
                                       "more are needed at this rate",
                                       brake, slips, braked, more),
                           brake, evidence));
  }
  // "stopped it at 4.2 s and held it until 13 s, when …": of a brake whose shaft has stood since it was put on, at first or
  // later, and moves again.
  std::optional<std::string> until_it_broke_away(std::size_t element, double put_on) const {
    const Network::ShaftElement& brake = m_.network.elements[element];
    const std::size_t shaft = at(m_.shaft_of_node[at(brake.node)]);
    const std::string name = m_.node_label(m_.shafts[shaft].reference);
    const auto last = [&](EventKind kind, double before) {
      return std::find_if(outcome_.events.rbegin(), outcome_.events.rend(), [&](const Event& event) {
        return event.kind == kind && event.component == name && event.t >= put_on && event.t <= before;
      });
    };
    const auto moves = last(EventKind::motion, outcome_.t);
    if (moves == outcome_.events.rend()) return {};
    const auto rests = last(EventKind::rest, moves->t);
    const bool stopped = rests != outcome_.events.rend();
    if (moves->t - (stopped ? rests->t : put_on) <= 0) return {};
    equations_.ties().find_holds(now_.now);
    const Hold hold = equations_.ties().element_hold()[element];
    return fmt::format("{}held it until {:.4g} s, when more acted on it than the {:.4g} N·m that it can hold",
                       stopped ? fmt::format("stopped it at {:.4g} s and ", rests->t) : "", moves->t,
                       std::max(std::abs(hold.low), hold.high));
  }
  bool is_done() const {
    return !m_.scene.sequence.repeat && equations_.modes().next_step >= m_.scene.sequence.steps.size();
  }

  Equations& equations_;
  const Model& m_;
  const RunOutcome& outcome_;
  const Result& result_;
  const SlipRecorder& slips_;
  const Snapshot& now_;
  Claims claims_;
  std::set<std::string> slipping_;  // to the end
};

}  // namespace

Claims contact_claims(Equations& equations, const RunOutcome& outcome, const Result& result,
                      const SlipRecorder& slips) {
  return ContactJudge(equations, outcome, result, slips).all();
}

std::string text_of_place(double angle) {
  const double degrees = angle * 180 / std::numbers::pi;
  return fmt::format("{:.1f}°", degrees - 360 * std::floor(degrees / 360));
}

// Gears that lock themselves jam, too, and hold their load.
std::optional<Claim> joints_jam(const Model& m, const RunOutcome& outcome) {
  for (const Event& e : outcome.events)
    for (const std::string& of : m.network.components) {
      const Mechanism* mechanism = e.kind == EventKind::jam ? find_mechanism(m.network, of) : nullptr;
      if (!mechanism || !mechanism->friction) continue;
      const int shaft = m.shaft_of_node[at(m.network.ports.at(of).in)];
      if (e.component != m.node_label(m.shafts[at(shaft)].reference)) continue;
      return claimed(
          Predicate::jams,
          fmt::format("\"{}\" jams at {} after {:.3g} s: no acceleration satisfies the friction in its joints "
                      "while it moves (Painlevé's inconsistency), and it stops at once",
                      of, text_of_place(e.angle), e.t),
          of, {.at = e.t, .value = e.angle, .unit = "rad"});
    }
  return {};
}

}  // namespace kurbel
