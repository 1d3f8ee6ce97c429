// motion_answers.cpp — stalls, runaways, motors that hang: judged by the state at the end and by what led there.
#include "studies/answers/motion_answers.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "drivetrain/induction/induction_law.h"
#include "engine/numerics/index.h"
#include "studies/answers/contact_answers.h"

namespace kurbel {
namespace {

constexpr double stands = 1e-3;   // of the usual speed: below it a shaft stands
constexpr double drives = 1e-6;   // of the usual torque: above it something drives
constexpr double far_away = 1.5;  // times the usual speed: nothing in the scene tells of such a one
constexpr double nearly = 0.2;    // of the largest speed so far: below it the link has come to a stop

std::string where(const Stall& s) {
  const double degrees = s.angle * 180 / std::numbers::pi;
  return fmt::format("\"{}\" stalls at {:.1f}° after {:.3g} s: ", s.link, degrees - 360 * std::floor(degrees / 360),
                     s.time);
}

class Judge {
 public:
  Judge(Equations& equations, const RunOutcome& outcome)
      : equations_(equations),
        m_(equations.model()),
        outcome_(outcome),
        shaft_(at(m_.shaft_of_node[at(m_.reduction_node)])),
        now_(equations.snapshot(outcome.t, outcome.state)) {}

  std::string link() const { return m_.network.nodes[at(m_.reduction_node)].component; }
  double angle() const { return now_.node_angle[m_.reduction_node]; }
  double speed() const { return m_.gain_of_node[at(m_.reduction_node)] * now_.now.speed[shaft_]; }
  bool is_held() const { return equations_.at_standstill(shaft_) && now_.now.speed[shaft_] == 0; }
  bool is_commanded() const { return !m_.commands.empty(); }
  // Of all that drives, reduced to the link [N·m].
  double drive() const {
    double torque = 0;
    for (std::size_t e = 0; e < m_.network.elements.size(); ++e)
      if (m_.network.elements[e].element->account == Account::driving)
        torque += now_.sums.element_torque[e] * m_.node_ratio[at(m_.network.elements[e].node)];
    return torque;
  }
  // A motor under torque whose own shaft stands.
  const MotorTorque* standing_motor() const {
    for (const MotorTorque& motor : m_.motors)
      if (!motor.prescribed && std::abs(torque_of(motor)) > drives * motor.rated_torque &&
          std::abs(speed_of(motor)) < stands * std::abs(motor.rated_speed))
        return &motor;
    return nullptr;
  }
  double torque_of(const MotorTorque& motor) const { return motor.torque(now_); }
  double speed_of(const MotorTorque& motor) const {
    return m_.gain_of_node[at(motor.node)] * now_.now.speed[m_.shaft_of_node[at(motor.node)]];
  }
  std::optional<double> rest() const {
    const auto stop = std::find_if(outcome_.events.rbegin(), outcome_.events.rend(),
                                   [](const Event& e) { return e.kind == EventKind::rest; });
    return stop == outcome_.events.rend() ? std::nullopt : std::optional(stop->t);
  }

  std::optional<Stall> stall() const {
    const MotorTorque* motor = standing_motor();
    const std::optional<double> since = rest();
    if (!is_held() || !since || (is_commanded() && !motor)) return {};
    const double torque = drive();
    if (torque == 0) return {};
    return Stall{link(), motor ? motor->component : "", angle(), *since, torque};
  }
  // Where a clutch slips meanwhile, what drives is what that passes on.
  std::string words_of(const Stall& stall) const {
    for (std::size_t e = 0; e < m_.elastic.size(); ++e) {
      const double passed_on = std::abs(now_.joint_torque[m_.elastic[e].joint]);
      if (m_.elastic[e].slips && equations_.modes().slip[e] != 0 && passed_on > drives * m_.torque_scale)
        return fmt::format("{}\"{}\" slips to the end under the {:.4g} N·m that it can transmit", where(stall),
                           m_.network.joints[at(m_.elastic[e].joint)].component, passed_on);
    }
    return in_words(stall);
  }

  // Turned back by more than half a turn, against what drove it from the start.
  std::optional<Answer> backwards(double begins_at) const {
    if (is_commanded() || begins_at > 0 || !(speed() < -stands * m_.speed_scale)) return {};
    Equations first(equations_.shared_model(), false);
    const std::vector<double> y = first.start(0);
    const double before = first.snapshot(0, y).node_angle[m_.reduction_node];
    if (m_.scene.run.start.speed < 0 || before - angle() < std::numbers::pi) return {};
    if (!(drive() > drives * m_.torque_scale)) return {};
    return Answer{Topic::runs,
                  fmt::format("\"{}\" turns backwards, at {} at the end: its loads are stronger than the {} N·m that "
                              "drive it forwards",
                              link(), m_.scene.speed_unit.text(speed()), drive()),
                  80};
  }

  std::optional<Answer> runs_away(const Periods& p) const {
    if (is_commanded() || p.steady || p.run_down_begin) return {};
    if (!(std::abs(speed()) > far_away * m_.speed_scale) || !p.without_limit) return {};
    return Answer{Topic::runs,
                  fmt::format("\"{}\" runs away: {} at the end, {:.3g} times the speed that its data tell of, and {}",
                              link(), m_.scene.speed_unit.text(speed()), std::abs(speed()) / m_.speed_scale, p.verdict),
                  70};
  }

  // Held from the start, although something drives.
  std::optional<Answer> never_starts(double fastest) const {
    if (is_commanded() || !is_held() || rest() || fastest > stands * m_.speed_scale) return {};
    if (!(std::abs(drive()) > drives * m_.torque_scale)) return {};
    return Answer{Topic::runs,
                  fmt::format("\"{}\" does not start: its loads hold the {} N·m that drive it", link(), drive()), 90};
  }

  // Not once round, and hardly any speed left, although something drives.
  std::optional<Answer> never_gets_round(const Periods& p, bool any_cycle, double fastest) const {
    if (is_commanded() || any_cycle || m_.cycle == 0 || p.run_down_begin) return {};
    if (std::abs(speed()) > nearly * fastest || !(std::abs(drive()) > drives * m_.torque_scale)) return {};
    return Answer{Topic::runs,
                  fmt::format("\"{}\" does not get round: it is at {:.1f}° at the end, with {}, where {} N·m drive it",
                              link(), angle() * 180 / std::numbers::pi, m_.scene.speed_unit.text(speed()), drive()),
                  60};
  }

  // An induction motor that its loads keep below its breakdown speed, where it gives less and less the slower it is.
  std::optional<Answer> hangs(const Periods& p) const {
    if (!p.steady || p.run_down_begin) return {};
    for (const MotorTorque& motor : m_.motors) {
      const auto* data = m_.network.data.find<InductionData>(motor.component);
      if (!data || data->by_converter || !(torque_of(motor) > drives * motor.rated_torque)) continue;
      const double breakdown = data->synchronous_speed * (1 - data->breakdown_slip), now = speed_of(motor);
      const double mean = p.steady_speed * m_.node_ratio[at(motor.node)];
      if (!(std::max(now, mean) < breakdown) || !(now > stands * motor.rated_speed)) continue;
      return Answer{
          Topic::runs,
          fmt::format("\"{}\" does not come up to speed: it hangs at {}, below the {} at which it gives most; "
                      "its loads take all that it gives there",
                      motor.component, m_.scene.speed_unit.text(mean), m_.scene.speed_unit.text(breakdown)),
          75};
    }
    return {};
  }

 private:
  Equations& equations_;
  const Model& m_;
  const RunOutcome& outcome_;
  std::size_t shaft_;
  const Snapshot& now_;
};

}  // namespace

std::optional<Stall> stalled(Equations& equations, const RunOutcome& outcome) {
  if (outcome.state.empty()) return {};
  return Judge(equations, outcome).stall();
}

std::string in_words(const Stall& s) {
  return fmt::format("{}the load can hold the {:.4g} N·m that drive there, and holds them to the end", where(s),
                     s.torque);
}

std::vector<Answer> motion_answers(Equations& equations, const RunOutcome& outcome, const Periods& periods,
                                   const std::vector<Figure>& figures, bool any_cycle, double begins_at) {
  std::vector<Answer> answers;
  if (!outcome.complete || outcome.state.empty()) return answers;
  const Judge judge(equations, outcome);
  if (const std::optional<Stall> stall = judge.stall()) {
    answers.push_back({Topic::runs, judge.words_of(*stall), 90});
    return answers;
  }
  double fastest = 0;
  for (const Figure& f : figures)
    if (f.what == quantities::max_speed || f.what == quantities::min_speed)
      fastest = std::max(fastest, std::abs(f.value));
  if (const std::optional<Answer> answer = judge.never_starts(fastest)) {
    answers.push_back(*answer);
    return answers;
  }
  for (const std::optional<Answer>& answer :
       {judge.backwards(begins_at), judge.runs_away(periods), judge.hangs(periods),
        judge.never_gets_round(periods, any_cycle, fastest)})
    if (answer) answers.push_back(*answer);
  for (Answer& answer : contact_answers(equations, outcome)) answers.push_back(std::move(answer));
  return answers;
}

}  // namespace kurbel
