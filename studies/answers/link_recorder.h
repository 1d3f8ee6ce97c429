// link_recorder.h — an observer of the reduction link: its angle, when it last turned, whether it oscillates.
#pragma once

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/run/run.h"
#include "engine/run/sources.h"

namespace kurbel {

// Evaluated at the ends of steps; reversals, the last turning and the speeds of a vibration are located on the solution. The
// link turns above 1e-3 of its usual speed; its sense of rotation is updated above 1e-2 of it.
class LinkRecorder final : public Observer {
 public:
  LinkRecorder(const Model& model, double until) : m_(model), sources_(model), until_(until) {}
  void begin(double t, std::span<const double> y, Equations& equations) override;
  void step(StepView& view) override;
  void remember(Tape& tape) override {
    tape(began_, first_, angle_, foremost_, hindmost_, driven_back_, driven_to_, begin_, turned_at_, sense_,
         backwards_since_, fell_before_, driven_, driven_since_, late_from_, late_begin_, late_sense_, changes_, way_,
         low_, high_, fastest_, late_fastest_, reversal_, first_change_, last_change_, extreme_, turned_back_,
         first_swing_, last_swing_, swing_before_last_, half_swing_, swing_fastest_, swing_before_, turning_,
         turns_back_, last_turn_, turn_before_);
  }

  // Its greatest angle minus the angle at the end, turns counted [rad]: since it last came forwards by half of what it had
  // fallen, more than half a turn; while it turns forwards, since the drive was last switched off.
  double fell_back() const { return foremost_ - angle_; }
  // The deepest of those falls since then [rad]; 0: there was none.
  double fell_before() const { return fell_before_; }
  // Greatest speed of that rotation while anything drove, and in the first cycle after it [rad/s, ≤ 0].
  double driven_back() const { return driven_back_; }
  double driven_since() const { return driven_since_; }        // when the drive was last switched on [s]
  double backwards_since() const { return backwards_since_; }  // start of the last backward rotation [s]
  double turned_at() const { return turned_at_; }              // when it last turned, or the begin [s]
  double began_at() const { return begin_; }                   // the recording [s]
  bool turned() const { return turned_at_ > begin_; }
  // It has not turned for the last fiftieth of the recorded time up to t, nor for the time between its last two
  // reversals: an oscillation stands where it turns.
  bool rests(double t) const { return t - turned_at_ > std::max(0.02 * (t - begin_), half_swing_); }
  // In the last quarter of the time it reversed at least twice, and advanced by less than a quarter of the path covered
  // there or in its last whole oscillation, which need not fit into that quarter.
  bool swings() const {
    const double swing = last_swing_ + swing_before_last_;
    if (last_swing_ > 0 && std::abs(angle_ - turned_back_) > swing) return false;  // it has left the swing
    return changes_ >= 2 && (std::abs(angle_ - late_begin_) < 0.25 * way_ ||
                             (changes_ > 2 && std::abs(last_swing_ - swing_before_last_) < 0.25 * swing));
  }
  // It oscillates, and reached more than a twentieth of its greatest speed in that quarter.
  bool vibrates() const { return swings() && late_fastest_ > 0.05 * fastest_; }
  // It has turned back twice at least, and is between the places of the last two times: these places [rad].
  bool rocks() const { return turns_back_ >= 2 && last_swing().first <= angle_ && angle_ <= last_swing().second; }
  // It turns the faster the longer: in the last quarter, on average, by a fifth than in the whole time up to t; and from rest a
  // constant torque of more than `least` would have brought it as far [N·m].
  bool gathers_speed(double t, double least) const;
  // Since its last reversal it is faster by half than between that and the one before.
  bool leaves_its_swing() const { return swing_fastest_ > 1.5 * swing_before_; }
  double last_reversal() const { return reversal_; }  // [s]
  std::pair<double, double> last_swing() const { return std::minmax(last_turn_, turn_before_); }
  double fastest() const { return fastest_; }            // |speed| at the end of any step [rad/s]
  double fastest_late() const { return late_fastest_; }  // |speed| in the last quarter of the time [rad/s]
  // Greatest |speed| since its last reversal but one [rad/s]; 0: it does not oscillate.
  double speed_of_swing() const { return swings() ? std::max(swing_fastest_, swing_before_) : 0; }
  // Extreme angles in that quarter [rad], and frequency of its reversals there [Hz].
  double lowest() const { return low_; }
  double highest() const { return high_; }
  double frequency() const { return 0.5 * (changes_ - 1) / (last_change_ - first_change_); }
  // Half the angle between two reversals, for the first two and the last two of that quarter [rad]; 0 below three reversals.
  double first_amplitude() const { return 0.5 * first_swing_; }
  double last_amplitude() const { return 0.5 * last_swing_; }
  double time_of_swings() const { return last_change_ - first_change_; }  // from the first reversal to the last [s]

 private:
  const Model& m_;
  Sources sources_;
  double until_;
  bool began_ = false;
  bool driven_ = false;                                         // at the end of the last step
  double first_ = 0, angle_ = 0, foremost_ = 0, hindmost_ = 0;  // hindmost: since it was foremost
  double driven_back_ = 0, fell_before_ = 0;
  double driven_to_ = 0;  // the angle at which the drive was last switched off [rad]
  double begin_ = 0, turned_at_ = 0, backwards_since_ = 0, driven_since_ = 0;
  int sense_ = 0, turning_ = 0, turns_back_ = 0;  // turning: the sense in which it last turned
  double last_turn_ = 0, turn_before_ = 0;        // angles at which it turned back
  double late_from_ = 0, late_begin_ = 0;
  int late_sense_ = 0, changes_ = 0;
  double way_ = 0, low_ = 0, high_ = 0, fastest_ = 0, late_fastest_ = 0;
  double reversal_ = 0, first_change_ = 0, last_change_ = 0;  // [s]
  double extreme_ = 0, turned_back_ = 0;                      // the angles at reversal_ and at last_change_
  double first_swing_ = 0, last_swing_ = 0, swing_before_last_ = 0;
  double half_swing_ = 0;                        // between the last two reversals [s]
  double swing_fastest_ = 0, swing_before_ = 0;  // since the last reversal, and between that and the one before [rad/s]
};

}  // namespace kurbel
