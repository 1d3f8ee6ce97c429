// link_recorder.cpp — the link's angle and speed from step to step.
#include "studies/answers/link_recorder.h"

#include <numbers>
#include <utility>

#include "engine/numerics/index.h"
#include "engine/numerics/roots.h"
#include "engine/numerics/straight.h"
#include "engine/numerics/turns.h"

namespace kurbel {
namespace {

constexpr double least_turning = 1e-3, least_sense = 1e-2;  // of the usual speed
constexpr double late = 0.75;                               // of the time

}  // namespace

void LinkRecorder::begin(double t, std::span<const double> y, Equations& equations) {
  if (began_) return;
  began_ = true;
  first_ = angle_ = foremost_ = hindmost_ = late_begin_ = low_ = high_ =
      equations.angle_with_turns(at(m_.reduction_angle), y);
  begin_ = turned_at_ = t, late_from_ = t + late * (until_ - t);
}

bool LinkRecorder::gathers_speed(double t, double least) const {
  if (!(t > late_from_)) return false;
  const double advance = angle_ - first_, time = t - begin_;
  const double now = (angle_ - late_begin_) / (t - late_from_), whole = advance / time;
  double inertia = 0;  // of all shafts, on the link
  for (const Shaft& s : m_.shafts) inertia += s.mean_inertia * std::pow(m_.node_ratio[at(s.reference)], 2);
  return now * whole > 0 && std::abs(now) > 1.2 * std::abs(whole) &&
         inertia * 2 * std::abs(advance) / (time * time) > least;
}

void LinkRecorder::step(StepView& view) {
  const TrackedAngle& link = m_.angles[at(m_.reduction_angle)];
  if (at(link.shaft) >= m_.free_shafts) {  // prescribed: it rests nowhere
    turned_at_ = view.t();
    return;
  }
  Equations& equations = view.equations();
  const std::size_t state = equations.speed_index(link.shaft);
  const auto angle_in = [&](std::span<const double> y) {
    return equations.angle_with_turns(at(m_.reduction_angle), y);
  };
  const double speed = link.gain * view.y()[state], before = angle_in(view.y_previous());
  const int sense = speed > 0 ? 1 : -1;
  angle_ = angle_in(view.y());
  hindmost_ = angle_ > foremost_ ? angle_ : std::min(hindmost_, angle_);
  foremost_ = std::max(foremost_, angle_), fastest_ = std::max(fastest_, std::abs(speed));
  if (std::abs(speed) > least_sense * m_.speed_scale) {
    const double fell = foremost_ - hindmost_;
    if (sense > 0 && fell > std::numbers::pi && fell_back() < 0.5 * fell)
      fell_before_ = std::max(fell_before_, fell), foremost_ = hindmost_ = angle_;
  }
  const bool drives = sources_.drive(equations.modes().active);
  if (drives && !driven_) driven_since_ = view.t_previous();
  if (std::exchange(driven_, drives) && !drives) {
    fell_before_ = 0, driven_to_ = angle_;
    if (speed > 0) foremost_ = hindmost_ = angle_;
  }
  const double least = least_turning * m_.speed_scale;
  const auto speed_at = [&](double t) { return view.at(t, state); };
  const double from = speed_at(view.t_previous()), to = speed_at(view.t());
  const bool turns = std::abs(speed) > least, reverses = from * to < 0;
  constexpr int parts = 8;
  if (speed >= 0)
    driven_back_ = 0;
  else if (drives)
    driven_back_ = std::min(driven_back_, speed);
  else if (driven_to_ - angle_ < m_.cycle)  // a mechanism's speed varies within its cycle
    for (int k = 1; k <= parts; ++k)
      driven_back_ = std::min(
          driven_back_, link.gain * speed_at(std::lerp(view.t_previous(), view.t(), static_cast<double>(k) / parts)));
  if (reverses) {
    reversal_ = find_root(speed_at, view.t_previous(), from, view.t(), to);
    extreme_ = angle_in(view.at(reversal_));
    hindmost_ = extreme_ > foremost_ ? extreme_ : std::min(hindmost_, extreme_);
    foremost_ = std::max(foremost_, extreme_);
  }
  if (from == 0 && to != 0) reversal_ = view.t_previous(), extreme_ = before;  // it rested where it may turn back
  if (std::abs(speed) > least_sense * m_.speed_scale) {
    if (sense < 0 && sense_ >= 0) backwards_since_ = reversal_;
    sense_ = sense;
  }
  const auto beyond = [&](double t) { return std::abs(link.gain * speed_at(t)) - least; };
  double after = view.t(), beyond_after = std::abs(speed) - least;
  if (turns) {
    turned_at_ = after;
    if (std::exchange(turning_, sense) == -sense) turn_before_ = std::exchange(last_turn_, extreme_), ++turns_back_;
  }
  bool turned = turns;
  for (int k = parts - 1; k >= 0 && !turned; --k) {
    const double t = std::lerp(view.t_previous(), view.t(), static_cast<double>(k) / parts), now = beyond(t);
    turned = now > 0;
    if (turned) turned_at_ = find_root(beyond, t, now, after, beyond_after);
    after = t, beyond_after = now;
  }
  if (view.t() < late_from_) return;
  // An oscillation may have its greatest speeds within steps; a cubic exceeds its ends by at most 4/27 of this.
  double reached = std::abs(speed);
  const double duration = view.t() - view.t_previous(), first = view.ydot_previous()[state], last = view.ydot()[state];
  const double beyond_ends = duration * std::abs(link.gain) * (std::abs(first) + std::abs(last));
  const bool swings_back = late_sense_ == -sense && turns;
  if (std::max(reached, std::abs(link.gain * from)) + beyond_ends > (swings_back ? 0 : swing_fastest_) &&
      !runs_straight(first, last, (to - from) / duration, closely))
    for_each_turn_within(view.t_previous(), view.t(), speed_at,
                         [&](double t) { reached = std::max(reached, std::abs(link.gain * speed_at(t))); });
  if (view.t_previous() < late_from_) late_begin_ = low_ = high_ = before;
  way_ += std::abs(angle_ - before), late_fastest_ = std::max(late_fastest_, std::abs(speed));
  low_ = std::min(low_, angle_), high_ = std::max(high_, angle_);
  if (reverses) low_ = std::min(low_, extreme_), high_ = std::max(high_, extreme_);
  if (swings_back) swing_before_ = std::exchange(swing_fastest_, 0);
  swing_fastest_ = std::max(swing_fastest_, reached);
  if (!turns) return;
  if (late_sense_ == -sense) {
    if (changes_ > 0) half_swing_ = reversal_ - last_change_;
    if (++changes_ == 1)
      first_change_ = reversal_;
    else
      swing_before_last_ = std::exchange(last_swing_, std::abs(extreme_ - turned_back_));
    if (changes_ == 2) first_swing_ = last_swing_;
    last_change_ = reversal_, turned_back_ = extreme_;
  }
  late_sense_ = sense;
}

}  // namespace kurbel
