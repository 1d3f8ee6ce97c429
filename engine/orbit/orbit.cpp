// orbit.cpp — the run period by period, and Newton's method when it is close to a steady motion.
#include "engine/orbit/orbit.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "engine/numerics/deadline.h"
#include "engine/numerics/index.h"
#include "engine/orbit/link_speeds.h"
#include "engine/orbit/recurrence.h"
#include "engine/orbit/settling.h"
#include "engine/return_map/family.h"
#include "engine/run/recorders.h"

namespace kurbel {
namespace {

constexpr double near_enough = 0.1;     // change per period, over the rated values, below which Newton is tried
constexpr double enough = 1e-11;        // residual of the map, over the rated values
constexpr double settling = 0.99;       // of a change from one period to the next: more is no decay
constexpr double enough_by_run = 1e-8;  // where Newton does not apply
constexpr double still = 1e-9;          // of the rated values, per radian of the link at rated speed
constexpr double far_beyond = 30;       // over the rated speed: the machine runs away

class Search {
 public:
  Search(std::shared_ptr<const Model> model, const OrbitOptions& options)
      : shared_(std::move(model)),
        m_(*shared_),
        options_(options),
        equations_(shared_, false),
        map_(new_map()),
        period_(map_->periodicity()),
        last_motion_(m_) {}

  // A clocked sequence takes longer than its clock, so that every repetition begins late; nothing is found.
  bool begins_late() const { return late_periods_ >= 8; }

  Orbit run() {
    state_.t = 0;
    state_.y = equations_.start(0);
    state_.modes = equations_.modes();
    try {
      while (!done_ && !begins_late() && run_periods_ < most_periods()) go_on();
    } catch (const std::runtime_error& error) {  // an element without solution, such as jamming joints
      end(Orbit::Kind::failed, error.what());
    }
    if (!done_ && !begins_late()) drift();
    out_.cost += map_->cost();
    if (out_.state.y.empty()) out_.state = state_;
    return std::move(out_);
  }

 private:
  void end(Orbit::Kind kind, std::string words) {
    out_.kind = kind;
    out_.words = std::move(words);
    done_ = true;
  }

  // --- state of the run ---

  double link_speed() {
    const TrackedAngle& link = m_.angles[at(m_.reduction_angle)];
    return link.gain * equations_.snapshot(state_.t, state_.y).now.speed[link.shaft];
  }
  std::string link() const { return m_.node_label(m_.reduction_node); }

  bool is_settled() const {
    return (m_.scene.sequence.repeat || !waits_for_angle(m_, state_.modes)) &&
           state_.t >= switched_until(m_, period_, state_);
  }
  // More for what changes slowly: a shaft that drag brings to the speed of another one takes its time.
  int most_periods() const {
    constexpr int times = 4;
    return options_.most_periods * (slow_ && options_.most_periods >= OrbitOptions{}.most_periods ? times : 1);
  }
  bool has_own_period() const { return kurbel::has_own_period(m_, period_, options_.clocked); }
  Pace pace() { return pace_of(equations_, state_); }

  // --- one period ---

  // From the present state of the run.
  RunOptions on_until(double until) const {
    RunOptions run{.tolerance = std::max(options_.tolerance, 1e-9),
                   .method = options_.method,
                   .until = until,
                   .budget = options_.budget,
                   .interrupted = options_.interrupted,
                   .progress = {}};
    run.from = {state_.t, state_.y};
    return run;
  }

  double round_angle() const { return period_.angle * options_.cycles; }
  double period_time() const { return period_.time * options_.cycles; }
  // Time limit for a period of the link at this speed [s].
  double patience(double omega) const { return 3 * round_angle() / std::max(std::abs(omega), 0.05 * m_.speed_scale); }

  // Of an incomplete period, by the rotation of the link, or by time if only time defines a cycle.
  double cycles_of(double time, double begin) const {
    if (period_.by_time) return time / period_.time;
    return std::abs(equations_.angle_with_turns(at(m_.reduction_angle), state_.y) - begin) / period_.angle;
  }

  // One period of the link, or the common period of time; if the link rests or creeps, some time.
  void go_on() {
    equations_.bind(state_.modes);
    const double omega = link_speed();
    const std::size_t angle = at(m_.reduction_angle);
    const double begin = equations_.angle_with_turns(angle, state_.y);
    const bool by_time = period_.by_time && is_settled();
    const bool aligning = by_time && !aligned_;  // start at a multiple of the period of time
    const double periods = std::floor(state_.t / period_time() + 1e-9) + 1;
    RunOptions run = on_until(aligning  ? periods * period_time()
                              : by_time ? state_.t + period_time()
                                        : state_.t + patience_factor_ * patience(omega));
    if (!period_.by_time)
      run.stop = [this, angle, begin](double, std::span<const double> y) {
        return std::min(1.0, round_angle() - std::abs(equations_.angle_with_turns(angle, y) - begin));
      };
    if (options_.progress) options_.progress(fmt::format("steady motion: cycle {}", out_.cycles + 1), 0);
    LinkSpeeds speeds(m_);
    const RunOutcome outcome = integrate(equations_, run, {&speeds, &last_motion_});
    ++run_periods_, out_.cycles += options_.cycles;
    const State before = std::exchange(state_, {outcome.t, outcome.state, equations_.modes()});
    if (!outcome.complete) {
      const bool stopped = options_.interrupted && options_.interrupted->load();
      return end(stopped ? Orbit::Kind::interrupted : Orbit::Kind::failed, outcome.diagnosis);
    }
    const bool round = outcome.stopped || by_time;
    out_.cost += round && !aligning ? options_.cycles : cycles_of(state_.t - before.t, begin);
    const Pace now = pace();
    if (now.speed > far_beyond) return run_away(now.speed);
    aligned_ = aligned_ || by_time;
    events_.add(outcome.events);
    if (is_settled() && is_late(outcome.events)) return;
    if (has_own_period() && is_settled() && find_own_period()) return;
    if (!round) return wait(now, speeds);
    patience_factor_ = 1;
    if (is_settled() && !aligning && !repeats_freely(m_.scene.sequence, options_.clocked)) look(before, now);
  }

  // In the last period; counted, as it makes the search begin anew.
  bool is_late(const EventLog& events) {
    late_periods_ = options_.clocked && begins_late_in(events, state_, m_.scene.sequence) ? late_periods_ + 1 : 0;
    return late_periods_ > 0;
  }

  // The link did not complete the period.
  void wait(const Pace& now, const LinkSpeeds& speeds) {
    patience_factor_ = std::min(2 * patience_factor_, 64.0);
    if (!is_settled() && state_.t < switched_until(m_, period_, state_)) return;
    if (is_settled() && !repeats_freely(m_.scene.sequence, options_.clocked) && swings_.as_before(speeds))
      return vibrate();
    if (now.rate > still || period_.by_time) return;
    if (now.speed <= still)
      return end(Orbit::Kind::at_rest, with_holders(rest_in_words(last_motion_, events_.last, m_)));
    const double omega = std::abs(link_speed());
    if (omega > still * m_.speed_scale) return;  // it creeps
    end(Orbit::Kind::equilibrium,
        with_holders(fmt::format("\"{}\" stands while other shafts turn, and no speed changes any more", link())));
  }
  std::string with_holders(std::string text) {
    for (const std::string& words : equations_.held(state_.t, state_.y)) text += "; " + words;
    return text;
  }
  void run_away(double speed) { end(Orbit::Kind::runaway, runaway_in_words(state_.t, speed, link_speed(), m_)); }

  // A period without switching: its change, and whether it is small enough.
  void look(const State& before, const Pace& now) {
    ++settled_periods_;
    speeds_.push_back(now.speed);
    PoincareSection section(equations_, before, {!period_.by_time, {}});
    const Eigen::VectorXd change = section.read(state_.modes, state_.y);
    Eigen::Index most = 0;
    out_.still_changes = change.size() > 0 ? change.cwiseAbs().maxCoeff(&most) : 0;
    constexpr double slow = 1e-3;
    slow_ = slow_ || out_.still_changes < slow;
    if (change.size() > 0) {
      changes_most_ = section.name(equations_, static_cast<std::size_t>(most));
      angle_changes_most_ = section.is_angle(static_cast<std::size_t>(most));
    }
    ends_.push_back(before);
    if (repeats_after_several()) return;
    const bool repeats = out_.still_changes <= enough_by_run, repeats_anew = repeats && !repeated_;
    if ((settled_periods_ < next_trial_ && !repeats_anew) || out_.still_changes > near_enough) return;
    next_trial_ = 2 * settled_periods_;
    repeated_ = repeats;
    polish();
    if (!done_ && !found_unstable_ && repeats) rest_on_run(new_map());
  }

  // A subharmonic motion: the state is that of several periods before, and not that of one before; these are then one period.
  bool repeats_after_several() {
    constexpr std::size_t most = most_cycles_of_a_period;
    constexpr double as_before = 1e-4;  // of the change over one period
    if (ends_.size() > most) ends_.erase(ends_.begin());
    if (settled_periods_ < next_look_back_ || out_.still_changes < as_before) return false;
    next_look_back_ = settled_periods_ + static_cast<int>(most);
    for (std::size_t k = 2; k <= ends_.size(); ++k) {
      PoincareSection section(equations_, ends_[ends_.size() - k], {!period_.by_time, {}});
      if (section.read(state_.modes, state_.y).cwiseAbs().maxCoeff() > as_before * out_.still_changes) continue;
      options_.cycles *= static_cast<int>(k);
      map_ = new_map();
      settled_periods_ = 0, next_trial_ = 1, next_look_back_ = most_periods();
      return true;
    }
    return false;
  }

  std::shared_ptr<ReturnMap> new_map() const { return std::make_shared<ReturnMap>(shared_, map_options(options_)); }

  // If Newton's method does not apply: the run is close enough.
  bool rest_on_run(const std::shared_ptr<ReturnMap>& map) {
    const ReturnMap::Image way = map->approach_from(state_);
    SteadyPoint point;
    if (way.end == ReturnMap::End::returned) point = find_by_periods(*map, way.z, 10 * enough_by_run);
    settles_ = m_.scene.sequence.repeat && point.periods > 1 && way.z.size() > 0 &&
               point.residual < settling * (point.first - way.z).cwiseAbs().maxCoeff();
    if (point.found && point.vibrates()) point.to_come += uncertainty_of_member(*map);
    spend(*map);
    if (!point.found || (settles_ && point.residual > 0.1 * enough_by_run)) return false;
    accept(map, point);
    out_.polished = out_.stable = false;
    return true;
  }

  // Continues to the middle of the widest gap between the events of the last period: a period must not begin with an event.
  bool go_where_least_happens(double last, double period) {
    const std::optional<double> quiet = middle_of_widest_gap(events_.last, last, period);
    if (!quiet) return true;
    const RunOptions run = on_until(*quiet + period * std::ceil((state_.t - *quiet) / period + 1e-6));
    equations_.bind(state_.modes);
    const RunOutcome outcome = integrate(equations_, run, {});
    if (outcome.complete) state_ = {outcome.t, outcome.state, equations_.modes()};
    events_.add(outcome.events);
    return outcome.complete;
  }

  // The same event recurs after the same time with the same state, with up to a number of its kind between. For a sequence
  // the same command of the same step.
  bool find_own_period() {
    if (events_.last.size() < 4 || events_.seen == looked_at_) return false;
    looked_at_ = events_.seen;
    const bool sequence = m_.scene.sequence.repeat;
    return comes_again(times_of_last_kind(events_.last, m_),
                       sequence ? "the operating sequence repeats" + late_in_words(m_.scene.sequence, options_.clocked)
                                : "self-excited vibration, no law sets this period");
  }

  // The link reverses repeatedly, and no event defines a period.
  void vibrate() {
    TurningTimes turning(m_);
    equations_.bind(state_.modes);
    const double as_long = 0.5 * patience_factor_ * patience(0);
    const RunOutcome outcome = integrate(equations_, on_until(state_.t + as_long), {&turning});
    if (outcome.complete) {
      state_ = {outcome.t, outcome.state, equations_.modes()};
      period_changes_ = 0;  // it has settled
      if (comes_again({turning.times().rbegin(), turning.times().rend()}, "no law sets this period")) return;
    }
    drift();
  }

  // Whether the motion is periodic, by the times of equal events, latest first, with up to a number of its kind between.
  bool comes_again(const std::vector<double>& times, const std::string& why) {
    constexpr double same_time = 1e-6, settled_time = 1e-10, fast = 0.9;
    for (std::size_t k = 1; k <= std::size_t{most_cycles_of_a_period} && 2 * k < times.size(); ++k) {
      const double period = times[0] - times[k], before = times[k] - times[2 * k];
      const double change = std::abs(period - before);
      if (!(period > 0) || change > same_time * period) continue;
      slow_ = true;
      // While it still converges this fast, more periods are computed before the period is accepted.
      if (change > settled_time * period && change < fast * std::exchange(period_changes_, change)) return false;
      if (period_.by_time && is_whole(period, period_.time) != repeats_freely(m_.scene.sequence, options_.clocked))
        continue;
      if (!go_where_least_happens(times[0], period)) return false;
      const double exact = events_.last.empty() ? by_whole_state(period) : period;
      const bool repeats = repeats_after(exact, why);
      if (!repeats && settles_) return false;
      if (!repeats) continue;
      // What was still settling may be accepted as several periods first: from where they led to, the fewest count.
      std::size_t n = k;
      while (n > 1 && !(k % n == 0 && repeats_after(exact / static_cast<double>(n), why))) --n;
      return true;
    }
    return false;
  }

  // Whether the whole state does, from where the run is; if not, what was found before is kept.
  bool repeats_after(double time, const std::string& why) {
    const Periodicity laws = period_;
    period_.by_time = true, period_.time = time;
    if (!rest_on_run(std::make_shared<ReturnMap>(shared_, map_options(options_), time))) return period_ = laws, false;
    out_.words = fmt::format("the motion repeats after {:.6g} s: {}", time, why);
    return true;
  }

  // The period by the rotation of the link, to the run's tolerance, corrected by the lag of the whole state.
  double by_whole_state(double period) {
    for (int twice = 0; twice < 2; ++twice) {
      ReturnMap map(shared_, map_options(options_), period);
      const ReturnMap::Image way = map.approach_from(state_);
      const ReturnMap::Image round = way.end == ReturnMap::End::returned ? map.image(way.z, false) : way;
      spend(map);
      if (round.end != ReturnMap::End::returned) break;
      const Eigen::VectorXd along = map.along_the_motion(way.z);
      if (along.squaredNorm() > 0) period -= along.dot(round.z - way.z) / along.squaredNorm();
    }
    return period;
  }

  void polish() {
    found_unstable_ = false;
    const auto map = new_map();
    const ReturnMap::Image way = map->approach_from(state_);
    if (way.end != ReturnMap::End::returned) return spend(*map);
    state_ = map->section().state();
    SteadyPoint point = find_steady(*map, way.z, enough);
    spend(*map);
    if (point.end == ReturnMap::End::interrupted) return end(Orbit::Kind::interrupted, "interrupted");
    if (!point.found) why_not_ = point.why;
    if (!point.found || !was_on_its_way(point) || sequence_goes_on(*map, point.z) || !keeps_its_member(*map, point))
      return;
    accept(map, point);
  }

  // The member of a family is that of the run: conserved quantities have their initial values.
  bool keeps_its_member(const ReturnMap& map, SteadyPoint& point) {
    constexpr int patient = 64;  // periods: without decay there is no convergence either
    if (!point.neutral() || is_member_of_run(map, point) || settled_periods_ >= patient) return true;
    why_not_ = "the motion is one of a family, and the run is still too far from it to decide which";
    return false;
  }
  void spend(const ReturnMap& map) { out_.cost += map.cost(); }

  // From z = 0, the state of the run, a period moves towards the point as predicted by the derivative.
  bool was_on_its_way(const SteadyPoint& point) {
    constexpr double off = 0.3, near_by = 1e-4;
    if (point.z.size() == 0) return true;
    const double distance = point.z.cwiseAbs().maxCoeff();
    if (point.unstable() && !point.grazed) {
      found_unstable_ = true;
      why_not_ = fmt::format("the motion that Newton's method finds is unstable (multiplier {:.3g})", point.largest());
      return false;
    }
    if (distance <= near_by) return true;
    const Eigen::VectorXd left = point.first - point.z, expected = -(point.derivative * point.z);
    if ((left - expected).cwiseAbs().maxCoeff() <= off * distance) return true;
    why_not_ = "what Newton's method finds is not what the run approaches";
    return false;
  }

  void accept(const std::shared_ptr<ReturnMap>& map, const SteadyPoint& point) {
    if (out_.map) spend(*out_.map);  // several periods, before
    map_ = map;
    out_.map = map;
    out_.point = point;
    out_.polished = true;
    out_.stable = !point.grazed;
    out_.state = {map->start_time(), map->place(equations_, point.z), equations_.modes()};
    out_.state.y.resize(equations_.state_count());
    out_.cost -= map->cost();  // counted at the end
    state_ = out_.state;
    const bool nothing_vibrates = !period_.angle_matters && !period_.by_time && pace().rate <= 100 * still;
    if (nothing_vibrates)
      return end(Orbit::Kind::equilibrium, "all speeds are constant: no law depends on an angle or on time");
    end(point.vibrates() ? Orbit::Kind::vibrating : Orbit::Kind::cycle, cycle_words());
  }
  std::string cycle_words() const {
    if (period_.by_time)
      return fmt::format("the motion repeats after {:.6g} s, the common period of all that depends on time{}{}",
                         period_time(), period_.angle_matters ? " and on an angle" : "",
                         late_in_words(m_.scene.sequence, options_.clocked));
    const double turns = round_angle() / (2 * std::numbers::pi);
    return fmt::format("the motion repeats after {:.6g} turn{} of \"{}\"", turns, turns == 1 ? "" : "s", link());
  }

  void drift() {
    const std::string where = fmt::format("after {} cycles, at {:.4g} s, ", out_.cycles, state_.t);
    if (settled_periods_ == 0 && is_settled() && !m_.scene.sequence.repeat)
      return end(
          Orbit::Kind::drifting,
          where + fmt::format("\"{}\" has neither completed a cycle nor come to rest: it moves to and fro", link()));
    if (settled_periods_ == 0)
      return end(Orbit::Kind::drifting,
                 where + (m_.scene.sequence.repeat ? "the operating sequence still repeats without the motion repeating"
                                                   : "something is still being switched"));
    if (grows(speeds_)) return run_away(speeds_.back());
    if (period_.by_time && angle_changes_most_)
      return end(
          Orbit::Kind::drifting,
          where +
              fmt::format(
                  "nothing has repeated: what repeats after {:.6g} s and what depends on the {} have no common period",
                  period_.time, changes_most_));
    end(Orbit::Kind::drifting,
        where + fmt::format(
                    "the motion still changes by {:.2g} of the rated values from cycle to cycle, most of all the {}{}",
                    out_.still_changes, changes_most_, why_not_.empty() ? "" : ": " + why_not_));
  }

  std::shared_ptr<const Model> shared_;
  const Model& m_;
  OrbitOptions options_;
  Equations equations_;
  std::shared_ptr<ReturnMap> map_;
  Periodicity period_;
  State state_;
  Orbit out_;
  bool done_ = false, aligned_ = false, angle_changes_most_ = false, found_unstable_ = false;
  bool slow_ = false, settles_ = false;  // a period has changed little; what did not repeat came nearer to it
  bool repeated_ = false;                // the run did, at the last trial
  double patience_factor_ = 1, period_changes_ = HUGE_VAL;  // change of the own period at the last check [s]
  int late_periods_ = 0;                                    // in succession
  int run_periods_ = 0, settled_periods_ = 0, next_trial_ = 1, next_look_back_ = 16;
  std::vector<State> ends_;  // of the last settled periods before this one
  LastOscillation swings_;
  LastMotion last_motion_;
  std::string why_not_, changes_most_;
  std::vector<double> speeds_;  // fastest shaft at the ends of settled periods, over its rated speed
  RecentEvents events_;
  std::size_t looked_at_ = 0;  // so many events
};

}  // namespace

OrbitOptions orbit_options(const RunSettings& run, const std::atomic<bool>* interrupted) {
  return {.method = run.method == "work" ? "auto" : run.method, .budget = run.budget, .interrupted = interrupted};
}

Orbit find_orbit(std::shared_ptr<const Model> model, const OrbitOptions& options) {
  Search search(model, options);
  Orbit found = search.run();
  if (!search.begins_late()) return found;
  OrbitOptions unclocked = options;
  unclocked.clocked = false;
  return Search(std::move(model), unclocked).run();
}

}  // namespace kurbel
