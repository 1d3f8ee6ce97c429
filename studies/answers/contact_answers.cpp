// contact_answers.cpp — clutches, limiters, belts and brakes: by the state at the end, and by the events on the way.
#include "studies/answers/contact_answers.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "engine/numerics/index.h"

namespace kurbel {
namespace {

constexpr double slipping_from = 1e-3;   // of the usual speed: below it a shaft stands, or nothing slips
constexpr double transmits_from = 1e-6;  // of the usual torque

std::string so_often(int count) { return count == 1 ? "once" : count == 2 ? "twice" : fmt::format("{} times", count); }

// A clutch is open, closing or closed as the sequence last said; without a sequence it is closed.
struct Closing {
  double to = 1, since = -HUGE_VAL;  // [s]
};

class ContactJudge {
 public:
  ContactJudge(Equations& equations, const RunOutcome& outcome)
      : equations_(equations),
        m_(equations.model()),
        outcome_(outcome),
        now_(equations.snapshot(outcome.t, outcome.state)) {}

  std::vector<Answer> all() {
    brakes();
    slipping_joints();
    slipping_belts();
    let_go();
    return std::move(answers_);
  }

 private:
  std::string text(double speed) const { return m_.scene.speed_unit.text(std::abs(speed)); }
  bool is_kind(const std::string& component, const char* kind) const { return m_.network.kind_of(component) == kind; }
  const std::string& owner_of(const ElasticJoint& joint) const { return m_.network.joints[at(joint.joint)].component; }

  // --- to the end ---

  void slips_to_the_end(const ElasticJoint& joint, double slip) {
    const double torque = now_.joint_torque[joint.joint];
    const double usual = joint.gain_a * m_.shafts[at(joint.shaft_a)].speed_scale;
    if (!(std::abs(slip) > slipping_from * std::abs(usual)) || !(std::abs(torque) > transmits_from * m_.torque_scale))
      return;
    slipping_.insert(owner_of(joint));
    answers_.push_back({Topic::runs,
                        fmt::format("\"{}\" slips to the end, by {} under the {} N·m that it can transmit",
                                    owner_of(joint), text(slip), std::abs(torque)),
                        50});
  }
  double slip_of(const ElasticJoint& joint) const {
    return joint.gain_a * now_.now.speed[joint.shaft_a] - joint.gain_b * now_.now.speed[joint.shaft_b];
  }
  // Closed clutches whose sides turn differently; those that let go by themselves, too.
  void slipping_joints() {
    for (std::size_t e = 0; e < m_.elastic.size(); ++e) {
      const ElasticJoint& joint = m_.elastic[e];
      if (joint.slips && equations_.modes().slip[e] != 0 && !is_kind(owner_of(joint), "brake"))
        slips_to_the_end(joint, slip_of(joint));
    }
  }
  // Belts that stretch keep what they slipped as a state of their own.
  void slipping_belts() {
    for (std::size_t k = 0; k < m_.own_states.size(); ++k) {
      if (m_.own_states[k].state.name != "slipped_angle") continue;
      for (const ElasticJoint& joint : m_.elastic)
        if (owner_of(joint) == m_.own_states[k].component) slips_to_the_end(joint, now_.sums.own_rate[k]);
    }
  }

  // A brake that was put on last and whose shaft still turns.
  void brakes() {
    for (std::size_t e = 0; e < m_.network.elements.size(); ++e) {
      const Network::ShaftElement& element = m_.network.elements[e];
      if (!is_kind(element.component, "brake")) continue;
      const auto put = std::find_if(outcome_.events.rbegin(), outcome_.events.rend(), [&](const Event& event) {
        return event.kind == EventKind::command && event.component == element.component;
      });
      if (put == outcome_.events.rend() || !(put->value.value_or(0) > 0)) continue;
      const std::size_t shaft = at(m_.shaft_of_node[at(element.node)]);
      const double gain = m_.gain_of_node[at(element.node)], torque = now_.sums.element_torque[e];
      const double speed = gain * now_.now.speed[shaft], change = gain * now_.alpha[shaft];
      if (equations_.at_standstill(shaft) ||
          std::abs(speed) <= slipping_from * m_.speed_scale * m_.scale_ratio[at(element.node)])
        continue;
      if (!(std::abs(torque) > transmits_from * m_.torque_scale)) continue;
      does_not_stop(element.component, put->t, speed, change, std::abs(torque));
    }
  }
  void does_not_stop(const std::string& brake, double put_on, double speed, double change, double torque) {
    const double braked = outcome_.t - put_on, more = speed * change < 0 ? std::abs(speed / change) : HUGE_VAL;
    if (more > outcome_.t)
      answers_.push_back({Topic::runs,
                          fmt::format("\"{}\" does not stop it: it slips at {} after {:.3g} s; its {:.4g} N·m are too "
                                      "weak for what drives",
                                      brake, text(speed), braked, torque),
                          85});
    else if (is_done())  // while a sequence goes on it is a matter of time
      answers_.push_back({Topic::runs,
                          fmt::format("\"{}\" has not stopped it by the end: {} are left after {:.3g} s, and {:.3g} s "
                                      "more are needed at this rate",
                                      brake, text(speed), braked, more),
                          45});
  }
  bool is_done() const {
    return !m_.scene.sequence.repeat && equations_.modes().next_step >= m_.scene.sequence.steps.size();
  }

  // --- on the way ---

  // The longest ramp that closes a component [s].
  double ramp_of(const std::string& component) const {
    double longest = 0;
    for (const SequenceStep& step : m_.scene.sequence.steps)
      if (std::find(step.set.begin(), step.set.end(), component) != step.set.end())
        longest = std::max(longest, step.over);
    return longest;
  }
  void let_go() {
    for (const std::string& component : m_.network.components) {
      if (slipping_.count(component)) continue;
      if (is_kind(component, "clutch") || is_kind(component, "torque limiter")) lets_go(component);
      if (is_kind(component, "belt")) slips_at_times(component);
    }
  }
  void lets_go(const std::string& component) {
    Closing closing;
    const double ramp = ramp_of(component);
    int count = 0;
    double first = 0;
    for (const Event& event : outcome_.events) {
      if (event.component != component) continue;
      if (event.kind == EventKind::command) closing = {event.value.value_or(0), event.t};
      const bool breaks_away = event.kind == EventKind::slip && event.from == "locked";
      if (breaks_away && closing.to == 1 && event.t > closing.since + ramp && ++count == 1) first = event.t;
    }
    if (count == 0) return;
    answers_.push_back(
        {Topic::bears, fmt::format("\"{}\" lets go {} although it is closed, first at {:.4g} s: the torque reaches the "
                                   "{:.4g} N·m that it holds",
                                   component, so_often(count), first, capacity_of(component))});
  }
  double capacity_of(const std::string& component) const {
    for (const ElasticJoint& joint : m_.elastic)
      if (owner_of(joint) == component) return m_.network.joints[at(joint.joint)].element->capacity;
    return 0;
  }
  // Of a belt that stretches or not.
  void slips_at_times(const std::string& belt) {
    int count = 0;
    double first = 0;
    for (const Event& event : outcome_.events)
      if (event.component == belt && event.what.starts_with("slips") && event.from != event.what && ++count == 1)
        first = event.t;
    if (count == 0) return;
    answers_.push_back({Topic::bears, fmt::format("\"{}\" slips {}, first at {:.4g} s, and grips again", belt,
                                                  so_often(count), first)});
  }

  Equations& equations_;
  const Model& m_;
  const RunOutcome& outcome_;
  const Snapshot& now_;
  std::vector<Answer> answers_;
  std::set<std::string> slipping_;  // to the end
};

}  // namespace

std::vector<Answer> contact_answers(Equations& equations, const RunOutcome& outcome) {
  return ContactJudge(equations, outcome).all();
}

}  // namespace kurbel
