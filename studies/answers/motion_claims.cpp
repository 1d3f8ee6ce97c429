// motion_claims.cpp — stalls, runaways, motors below breakdown speed: from the final state and the preceding motion.
#include "studies/answers/motion_claims.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "drivetrain/induction/induction_law.h"
#include "engine/model/model.h"
#include "engine/numerics/index.h"
#include "engine/orbit/stated_speed.h"
#include "engine/return_map/periodicity.h"
#include "engine/run/sources.h"
#include "mechanisms/reduced/mechanism.h"
#include "studies/answers/higher_speeds.h"
#include "studies/answers/holders.h"
#include "studies/answers/starter_claims.h"

namespace kurbel {
namespace {

constexpr double stands = 1e-3;           // of the usual speed: below it a shaft stands
constexpr double drives = 1e-6;           // of the usual torque: above it something drives
constexpr double turns_back_from = 1e-2;  // of the usual speed
constexpr double changes_by = 0.1;        // of an amplitude: less is a lasting vibration
constexpr double nearly = 0.2;            // of the largest speed so far: below it the link has come to a stop
constexpr double pushes = 0.1;            // of a motor's rated torque: what holds it is reported
constexpr double slowed = 0.8;            // of a speed: it is being stopped
constexpr double short_while = 0.02;      // of the time, of a torque
constexpr double dust = 1e-9;             // of the usual speed: rounding
constexpr double same_speed = 1e-3;       // of a speed: no other one
constexpr double gains = 1.3;             // times its speed: one known from few cycles grows

class Judge {
 public:
  Judge(Equations& equations, const RunOutcome& outcome, const LinkRecorder& recorder, const Watch& watch,
        double budget)
      : equations_(equations),
        m_(equations.model()),
        outcome_(outcome),
        recorder_(recorder),
        watch_(watch),
        budget_(budget),
        shaft_(at(m_.shaft_of_node[at(m_.reduction_node)])),
        now_(equations.snapshot(outcome.t, outcome.state)),
        holders_(equations, outcome.t, shaft_) {}

  std::string link() const { return m_.network.nodes[at(m_.reduction_node)].component; }
  std::string speed_in_words() const {
    return std::abs(speed()) < dust * m_.speed_scale ? "at rest" : "with " + m_.scene.speed_unit.text(speed());
  }
  double duration() const { return outcome_.t - recorder_.began_at(); }
  double angle() const { return now_.node_angle[m_.reduction_node]; }
  double gain() const { return m_.gain_of_node[at(m_.reduction_node)]; }
  double speed() const { return gain() * now_.now.speed[shaft_]; }
  bool is_held() const { return equations_.at_standstill(shaft_) && now_.now.speed[shaft_] == 0; }
  // Held, or at the end of springs that are held: small vibration is allowed.
  bool rests() const { return is_held() || recorder_.rests(outcome_.t); }
  bool slows_down() const { return speed() * gain() * now_.alpha[shaft_] < 0; }
  // Slower than 1 % of its usual speed, and by so little slower than before that it comes to a balance: no reversal.
  bool creeps() const {
    const double slow = turns_back_from * m_.speed_scale;
    if (recorder_.rocks() && recorder_.fastest_late() > slow) return false;
    return std::abs(speed()) < slow && slows_down() && std::abs(now_.alpha[shaft_]) * short_while * duration() < slow;
  }
  bool is_commanded() const { return !m_.commands.empty(); }
  double drive() const { return driving_torque(equations_, now_, shaft_); }  // on the link [N·m]
  // A motor under more than this part of its rated torque whose shaft is slower than that part of its rated speed: stands;
  // or that oscillates with the link.
  const MotorTorque* standing_motor(double torque = drives, double slower = stands, bool link_swings = false) const {
    for (const MotorTorque& motor : m_.motors)
      if (!motor.prescribed && std::abs(torque_of(motor)) > torque * motor.rated_torque &&
          (std::abs(speed_of(motor)) < slower * std::abs(motor.rated_speed) ||
           (link_swings && at(m_.shaft_of_node[at(motor.node)]) == shaft_)))
        return &motor;
    return nullptr;
  }
  double torque_of(const MotorTorque& motor) const { return motor.torque(now_); }
  double speed_of(const MotorTorque& motor) const {
    return m_.gain_of_node[at(motor.node)] * now_.now.speed[m_.shaft_of_node[at(motor.node)]];
  }
  // Of the link; empty: it never turned.
  std::optional<double> rest() const {
    if (!recorder_.turned()) return {};
    const std::string shaft = m_.node_label(m_.shafts[shaft_].reference);
    const auto stop = std::find_if(outcome_.events.rbegin(), outcome_.events.rend(),
                                   [&](const Event& e) { return e.kind == EventKind::rest && e.component == shaft; });
    return is_held() && stop != outcome_.events.rend() ? stop->t : recorder_.turned_at();
  }
  // Nothing drives any more.
  bool is_off() const {
    const Sources sources(m_);
    return !sources.none() && !sources.drive(equations_.modes().active);
  }

  // --- claims ---

  // The next step of the sequence waits for an angle of a shaft that is held.
  bool waits_in_vain() const {
    const std::size_t next = equations_.modes().next_step;
    const int angle = next < m_.trigger_angle.size() ? m_.trigger_angle[next] : -1;
    return angle >= 0 && equations_.at_standstill(at(m_.angles[at(angle)].shaft));
  }

  // At rest although something drives, and not by an applied brake: it never turned, or stalls. `contacts`: a clutch that
  // slips meanwhile is the one that no longer holds. A motor behind springs may still tremble where the sequence waits for
  // the link that is held.
  std::optional<Claim> halts(Claims& contacts) const {
    const MotorTorque* motor = standing_motor(is_held() && waits_in_vain() ? turns_back_from : stands);
    const double torque = drive();
    if (!rests() || (is_commanded() && !motor) || holders_.brake() || !(std::abs(torque) > drives * m_.torque_scale))
      return {};
    // Just begun: what is switched on at the end, or has begun to turn by more than a balance leaves.
    const bool is_free = !is_held() && !holders_.any();
    const double left = std::abs(now_.sums.torque[shaft_] / gain());
    if (outcome_.t - recorder_.driven_since() < short_while * duration()) return {};
    if (is_free && recorder_.gathers_speed(outcome_.t, short_while * std::abs(torque))) return {};
    if (!recorder_.turned() && is_free && std::abs(speed()) > 0.5 * recorder_.fastest() &&
        left > short_while * std::abs(torque))
      return {};
    if (leaves()) return {};
    const Evidence evidence{.at = rest(), .value = std::abs(torque), .limit = 0, .unit = "N*m"};
    if (!recorder_.turned()) {
      const std::string holders = holders_.beside("its loads");
      const bool one = holders.starts_with('"') && holders.find(',') == std::string::npos;
      return claimed(Predicate::does_not_start,
                     fmt::format("\"{}\" does not {}: {} {} the {} N·m that drive it{}", link(),
                                 recorder_.began_at() > 0 ? "turn" : "start", holders, one ? "holds" : "hold",
                                 std::abs(torque), torque < 0 ? " backwards" : ""),
                     link(), evidence);
    }
    if (!is_held() && !motor) return {};
    const std::string drives_there =
        fmt::format("the {:.4g} N·m that drive {}there", std::abs(torque), torque < 0 ? "backwards " : "");
    std::string why =
        !is_free ? fmt::format(
                       "{} can hold {}, and holds them to the end",
                       holders_.beside(m_.effects.joint_friction ? "the loads and the friction in joints" : "the load"),
                       drives_there)
                 : "its loads balance " + drives_there;
    for (Claim& claim : contacts)
      if (claim.predicate == Predicate::slips_to_the_end && m_.network.kind_of(claim.of) != "brake")
        why = claim.text, claim.in_conclusion = false;
    return claimed(
        Predicate::stalls,
        fmt::format("\"{}\" stalls at {} after {:.3g} s: {}", link(), text_of_place(angle()), *evidence.at, why),
        link(), evidence);
  }

  // It never turned and nothing holds it, but it is faster than ever, and gains by more than it has on average: it comes to no
  // balance. What gains less hardly begins, and comes to one.
  bool leaves() const {
    const double gains = gain() * now_.alpha[shaft_] * duration();
    return !recorder_.turned() && !is_held() && !holders_.any() && !recorder_.swings() &&
           std::abs(speed()) > std::max(dust * m_.speed_scale, (1 - same_speed) * recorder_.fastest()) &&
           gains * speed() > (1 + changes_by) * speed() * speed();
  }
  std::optional<Claim> gathers_speed(const Result& r) const {
    if (is_commanded() || !leaves() || !(std::abs(drive()) > drives * m_.torque_scale)) return {};
    Evidence evidence = of_speed(r, speed(), 0);
    evidence.limit.reset();
    return claimed(Predicate::moves,
                   fmt::format("\"{}\" moves at {} after {:.4g} s, and still gathers speed", link(),
                               m_.scene.speed_unit.text(speed(), 4), outcome_.t),
                   link(), std::move(evidence));
  }

  // By more than half a turn from its foremost position, and by more than it fell and came forwards again before; or, with
  // nothing on, faster than its usual speed. Without a drive backwards. Motion commanded by a sequence may be intended, as
  // long as anything drives. `contacts`: a brake that is too weak is named.
  std::optional<Claim> backwards(const Result& r, const Claims& contacts) const {
    if (r.begins_at > 0 || m_.scene.run.start.speed < 0 || Sources(m_).none() || recorder_.swings()) return {};
    if (!(speed() < -turns_back_from * m_.speed_scale) || (is_commanded() && !is_off())) return {};
    const bool far = recorder_.fell_back() >= std::max(std::numbers::pi, (1 + changes_by) * recorder_.fell_before());
    if (!far && !(is_off() && speed() < -m_.speed_scale)) return {};
    const double torque = drive(), least = drives * m_.torque_scale;
    const bool since_off = r.periods.run_down_begin && recorder_.backwards_since() > *r.periods.run_down_begin;
    if (torque < -least || (torque <= least && speed() >= (1 + same_speed) * recorder_.driven_back() && !since_off))
      return {};
    // What drives forwards has slowed it in the last quarter of the time, or will stop it within half a turn: no load is
    // stronger.
    const double slowing = std::abs(gain() * now_.alpha[shaft_]);
    if (torque > least && slows_down() &&
        (speed() * speed() < 2 * std::numbers::pi * slowing || std::abs(speed()) < slowed * recorder_.fastest_late()))
      return {};
    return claimed(
        Predicate::turns_back,
        fmt::format("\"{}\" turns backwards, at {} at the end: {}", link(), m_.scene.speed_unit.text(speed()),
                    torque > least
                        ? fmt::format("its loads are stronger than the {} N·m that drive it forwards", torque)
                        : driven_by_loads(contacts)),
        link(), of_speed(r, speed(), 0));
  }

  // What drives it where no source does, and which brake that is on does not hold that, or not yet.
  std::string driven_by_loads(const Claims& contacts) const {
    const auto weak = std::find_if(contacts.begin(), contacts.end(),
                                   [](const Claim& c) { return c.predicate == Predicate::brake_does_not_stop; });
    const std::string* const brake = weak != contacts.end() ? &weak->of : holders_.slipping_brake();
    if (!brake) return "its loads drive it, and nothing holds them";
    return fmt::format("its loads drive it, and \"{}\" {}", *brake,
                       weak == contacts.end() && slows_down() ? "has not stopped it yet" : "does not hold them");
  }

  // `fastest`: of the run; what nothing drives any more, and gains, is then driven by its loads.
  std::optional<Claim> runs_away(const Result& r, double fastest, const Claims& contacts) const {
    const Periods& p = r.periods;
    const double limit = far_away * m_.speed_scale;
    const bool too_few = !p.without_limit && !p.remaining;  // cycles to judge by
    if (!(std::abs(speed()) > limit)) return {};
    const bool gains_speed = gain() * now_.alpha[shaft_] * duration() > short_while * speed();
    const bool by_loads = is_off() && speed() >= (1 - same_speed) * fastest && gains_speed;
    if (!by_loads) {
      if (is_commanded() || p.steady || p.run_down_begin || !(p.without_limit || too_few)) return {};
      if (settles_at_a_higher_speed(m_, outcome_.t, speed()) ||
          settles_later(equations_, outcome_, speed(), watch_, budget_, too_few ? gains : 0))
        return {};
    }
    return claimed(
        Predicate::runs_away,
        fmt::format("\"{}\" runs away: {} at the end{}{}", link(), m_.scene.speed_unit.text(speed()),
                    times_the_speed_of_its_data(m_, speed()),
                    by_loads ? ": " + driven_by_loads(contacts)
                    : too_few
                        ? ", and it goes on to gain, no less from each doubling of the time than from the one before"
                        : ", and " + p.verdict),
        link(), of_speed(r, std::abs(speed()), limit));
  }
  // By an applied brake, or by friction against the acting torque; a link that never moved is reported as such.
  std::optional<Claim> held(double fastest) const {
    const bool moves = std::abs(speed()) > dust * m_.speed_scale, ever = fastest > dust * m_.speed_scale;
    if (!rests() && (moves || (ever && holders_.gears().empty()))) return {};
    const double acts = std::abs(holders_.torque());
    const bool moved = fastest > stands * m_.speed_scale, anything_acts = acts > drives * m_.torque_scale;
    const std::string holders = holders_.components();
    std::optional<Claim> claim;
    if (!holders.empty() && (anything_acts || holders_.brake())) {
      const std::string against = anything_acts ? fmt::format(" against the {:.4g} N·m that act on it", acts) : "";
      claim = claimed(Predicate::held_by, fmt::format("\"{}\" is held by {}{}", link(), holders, against), link(),
                      {.at = rest(), .value = acts, .unit = "N*m"});
      if (claim && anything_acts) claim->clause = "held by " + holders + against;
    } else if (!moved && (is_held() || !ever))
      claim = claimed(Predicate::does_not_move, fmt::format("\"{}\" does not move", link()), link());
    if (claim) claim->in_conclusion = !moved;
    return claim;
  }

  // While the link still moves: by an applied brake on its own shaft, or, where the link only trembles or creeps, by what
  // stands, or by loads that balance it.
  std::optional<Claim> motor_held() const {
    const bool trembles = recorder_.swings() && recorder_.speed_of_swing() < turns_back_from * m_.speed_scale;
    const bool nearly_rests = trembles || (!recorder_.swings() && creeps());
    const MotorTorque* motor =
        standing_motor(pushes, nearly_rests ? turns_back_from : stands, recorder_.vibrates() && holders_.any());
    if (!motor || rests()) return {};
    const std::string* brake = holders_.brake();
    const int shaft = m_.shaft_of_node[at(motor->node)];
    const bool own = brake && shaft == m_.shaft_of_node[at(m_.network.ports.at(*brake).in)];
    const bool swings = recorder_.vibrates() && at(shaft) == shaft_;
    std::string holders = own || nearly_rests || swings ? holders_.components() : std::string();
    if (holders.empty() && nearly_rests) holders = "its loads";
    if (holders.empty()) return {};
    const std::string clause =
        fmt::format("held by {} against the {:.4g} N·m that it gives", holders, std::abs(torque_of(*motor)));
    std::optional<Claim> claim =
        claimed_aside(Predicate::held_by, fmt::format("\"{}\" is {}", motor->component, clause), motor->component,
                      {.value = std::abs(torque_of(*motor)), .unit = "N*m"});
    if (claim) claim->clause = clause;
    return claim;
  }

  // Less than one turn, and nearly at rest or to and fro, although something drives, but no law that repeats by the clock; a
  // brake put on meanwhile is meant to stop it.
  std::optional<Claim> never_completes_a_cycle(const Result& r, double fastest) const {
    const auto is_whole = [&](const CycleRecord& c) { return std::abs(c.turned) > 0.5 * m_.cycle; };
    if (is_commanded() || std::any_of(r.cycles.begin(), r.cycles.end(), is_whole) || m_.cycle == 0 ||
        r.periods.run_down_begin || holders_.brake(true))
      return {};
    const MechanismElement* const mechanism =
        m_.reduction_element < 0 ? nullptr : mechanism_of(m_.network.elements[at(m_.reduction_element)]);
    if (mechanism && mechanism->mechanism().arc()) return {};  // a crank that rocks
    const bool rocks = recorder_.rocks() && recorder_.fastest_late() > nearly * fastest &&
                       recorder_.driven_since() < recorder_.last_reversal() && !recorder_.leaves_its_swing();
    if (rocks ? clock_of(m_) > 0 : std::abs(speed()) > nearly * fastest) return {};
    if (!(std::abs(drive()) > drives * m_.torque_scale)) return {};
    constexpr double degree = std::numbers::pi / 180;
    const auto [low, high] = recorder_.last_swing();
    const std::string place =
        rocks ? fmt::format("turns to and fro, between {:.1f}° and {:.1f}° at the end", low / degree, high / degree)
              : fmt::format("is at {:.1f}° at the end, {}", angle() / degree, speed_in_words());
    const std::string* brake = holders_.brake();
    return claimed(Predicate::does_not_get_round,
                   fmt::format("\"{}\" does not complete a cycle: it {}, where {} N·m drive it{}", link(), place,
                               drive(), brake ? fmt::format(" and \"{}\" holds it", *brake) : ""),
                   link(), {.at = outcome_.t, .value = std::abs(drive()), .limit = 0, .unit = "N*m"});
  }

  // Oscillation to the end of a motion that should become steady and has no commands.
  std::optional<Claim> vibrates(const Periods& p) const {
    if (is_commanded() || p.steady || rests() || !recorder_.vibrates()) return {};
    return claimed(Predicate::vibrates, fmt::format("\"{}\" vibrates {}", link(), course_of_vibration()), link(),
                   {.at = outcome_.t, .value = recorder_.frequency(), .unit = "Hz"});
  }
  // Nearly at rest for a moment only, where that is not said of the whole motion.
  std::optional<Claim> swings() const {
    const double reached = recorder_.speed_of_swing();
    if (rests() || std::abs(speed()) > turns_back_from * m_.speed_scale || reached < stands * m_.speed_scale) return {};
    const std::string up_to = ", at up to " + m_.scene.speed_unit.text(reached, 4);
    std::optional<Claim> claim =
        claimed_aside(Predicate::vibrates, fmt::format("\"{}\" vibrates at the end{}", link(), up_to), link(),
                      {.at = outcome_.t, .value = recorder_.frequency(), .unit = "Hz"});
    if (claim) claim->clause = "vibrating" + up_to;
    return claim;
  }
  // A lasting vibration by its range, one that decays or grows by its amplitudes.
  std::string course_of_vibration() const {
    const double first = recorder_.first_amplitude(), last = recorder_.last_amplitude();
    const bool alone =
        recorder_.highest() - recorder_.lowest() < 4 * std::max(first, last);  // no ripple on a larger one
    const double degree = std::numbers::pi / 180, low = recorder_.lowest() / degree,
                 high = recorder_.highest() / degree;
    if (first == 0 || !alone || std::abs(last - first) < changes_by * first)
      return fmt::format("to the end, between {:.1f}° and {:.1f}°", low, high);
    return fmt::format("about {:.1f}°; the vibration {}: its amplitude {} from {:.3g}° to {:.3g}° in the last {:.3g} s",
                       0.5 * (low + high), last < first ? "decays" : "grows", last < first ? "falls" : "rises",
                       first / degree, last / degree, recorder_.time_of_swings());
  }

  // An induction motor held by its loads below its breakdown speed, where its torque falls with the speed.
  std::optional<Claim> hangs(const Periods& p) const {
    if (!p.steady || p.run_down_begin) return {};
    for (const MotorTorque& motor : m_.motors) {
      const auto* data = m_.network.data.find<InductionData>(motor.component);
      if (!data || data->by_converter || !(torque_of(motor) > drives * motor.rated_torque)) continue;
      const double breakdown = data->synchronous_speed * (1 - data->breakdown_slip), now = speed_of(motor);
      const double mean = p.steady_speed * m_.node_ratio[at(motor.node)];
      if (!(std::max(now, mean) < breakdown) || !(now > stands * motor.rated_speed)) continue;
      return claimed(Predicate::hangs_below_breakdown,
                     fmt::format("\"{}\" does not come up to speed: it stays at {}, below the {} of its breakdown "
                                 "torque; its loads take all its torque there",
                                 motor.component, m_.scene.speed_unit.text(mean), m_.scene.speed_unit.text(breakdown)),
                     motor.component, {.value = mean, .limit = breakdown, .unit = "rad/s"});
    }
    return {};
  }

  // From rest, and driven.
  std::optional<Claim> starts(const Result& r, double fastest) const {
    if (r.begins_at > 0 || !(fastest > stands * m_.speed_scale) || m_.motors.empty()) return {};
    Equations first(equations_.shared_model(), false);
    const std::vector<double> y = first.start(0);
    if (std::abs(first.snapshot(0, y).now.speed[shaft_]) > stands * m_.shafts[shaft_].speed_scale) return {};
    return claimed_aside(Predicate::starts, fmt::format("\"{}\" starts from rest", link()), link(),
                         {.at = r.periods.run_up_end, .value = fastest, .unit = "rad/s"});
  }

 private:
  Evidence of_speed(const Result& r, double value, double limit) const {
    const auto state = r.final_state.find(link());
    const std::optional<double> error = state == r.final_state.end() ? std::nullopt : state->second.speed.error;
    return {.at = outcome_.t, .value = value, .limit = limit, .error = error, .unit = "rad/s"};
  }

  Equations& equations_;
  const Model& m_;
  const RunOutcome& outcome_;
  const LinkRecorder& recorder_;
  const Watch& watch_;
  double budget_;
  std::size_t shaft_;
  const Snapshot& now_;
  Holders holders_;
};

}  // namespace

Claims motion_claims(Equations& equations, const RunOutcome& outcome, const Result& result, const SlipRecorder& slips,
                     const LinkRecorder& link, const Watch& watch, double budget) {
  Claims claims;
  if (outcome.state.empty()) return claims;
  const Judge judge(equations, outcome, link, watch, budget);
  Claims contacts = contact_claims(equations, outcome, result, slips);
  std::optional<Claim> jams = joints_jam(equations.model(), outcome), halts = judge.halts(contacts);
  if (jams && judge.rests()) halts = std::move(jams);
  if (!outcome.complete)
    return halts && halts->predicate != Predicate::does_not_start ? Claims{std::move(*halts)} : claims;
  double fastest = 0;
  for (const Figure& f : result.figures)
    if (f.what == quantities::max_speed || f.what == quantities::min_speed)
      fastest = std::max(fastest, std::abs(f.value));
  if (halts) {
    add(claims, std::move(halts));
  } else {
    for (std::optional<Claim> claim : std::array{
             judge.backwards(result, contacts), judge.runs_away(result, fastest, contacts), judge.hangs(result.periods),
             judge.never_completes_a_cycle(result, fastest), judge.held(fastest), judge.starts(result, fastest)})
      add(claims, std::move(claim));
    if (result.periods.steady && !result.periods.run_down_begin)
      for (Claim& waits : starter_claims(equations, outcome.t, outcome.state, result.periods.steady_speed))
        claims.push_back(std::move(waits));
    if (std::none_of(claims.begin(), claims.end(), [](const Claim& c) { return c.is_bad(); })) {
      std::optional<Claim> vibrates = judge.vibrates(result.periods), held = judge.motor_held();
      if (held) held->in_conclusion = vibrates.has_value();  // else it is said with the link's speed
      const bool is_said = vibrates.has_value();
      add(claims, vibrates ? std::move(vibrates) : judge.swings());
      if (!is_said) add(claims, judge.gathers_speed(result));
      add(claims, std::move(held));
    }
  }
  if (jams && !judge.rests()) add(claims, std::move(jams));
  for (Claim& claim : contacts) claims.push_back(std::move(claim));
  return claims;
}

std::string times_the_speed_of_its_data(const Model& model, double speed) {
  if (!states_speed(model)) return {};
  return fmt::format(", {:.3g} times the speed of its data", std::abs(speed) / model.speed_scale);
}

}  // namespace kurbel
