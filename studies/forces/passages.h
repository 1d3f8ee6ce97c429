// passages.h — observers of a crank: its motion and forces at given angles, and whether it turns back between them.
#pragma once

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "engine/numerics/deadline.h"
#include "engine/numerics/index.h"
#include "engine/numerics/roots.h"
#include "engine/orbit/follow_period.h"
#include "studies/forces/crank_motion.h"
#include "studies/forces/deformed_mechanism.h"

namespace kurbel {

inline constexpr double near_edge = 1e-7;  // of the crank: a run meets an edge this near to where its law has it [rad]

// Motion and forces of the crank when it passes given angles. A value on one side of an edge is taken on that side of
// the machine's event, wherever the run locates it within its tolerances: laws and motion change there together.
class PassageRecorder final : public Observer {
 public:
  PassageRecorder(std::size_t tracked, int node, const DeformedMechanism& forces, const std::vector<Abscissa>& where,
                  std::vector<double> targets, int direction)
      : tracked_(tracked),
        node_(node),
        forces_(forces),
        where_(where),
        targets_(std::move(targets)),
        direction_(direction) {}
  void step(StepView& view) override {
    Equations& equations = view.equations();
    const Model& m = equations.model();
    const int shaft = m.shaft_of_node[at(node_)];
    const double gain = m.gain_of_node[at(node_)];
    const auto beyond = [&](double t) {
      return direction_ * (equations.angle_with_turns(tracked_, view.at(t)) - targets_[passed.size()]);
    };
    // Each is located within the whole step, so that targets do not depend on others requested.
    const double from = view.t_previous();
    const bool is_between = direction_ * (equations.angle_with_turns(tracked_, view.y()) - targets_.front()) >= 0 &&
                            passed.size() < targets_.size();
    turns_back = turns_back || (is_between && turns_back_in(view, shaft, gain));
    while (passed.size() < targets_.size()) {
      Deadline::check();
      const double at_end = beyond(view.t()), at_begin = beyond(from);
      if (at_end < where_[passed.size()].side * near_edge) return;
      const double time = at_begin >= 0 ? from
                          : at_end < 0  ? view.t()
                                        : find_root(beyond, from, at_begin, view.t(), at_end);
      const Snapshot& s = view.snapshot(time);
      (passed.empty() ? first : last) = time;
      passed.push_back({gain * s.now.speed[shaft], gain * s.alpha[shaft], acting_loads(m, forces_.element(), s.now)});
      machine.push_back(forces_.at(s));
    }
  }
  // Where the speed at the step's ends is of one size, it has one sign between them.
  bool turns_back_in(StepView& view, int shaft, double gain) const {
    constexpr double rounding = 1e-9;
    constexpr int places = 16;
    if (at(shaft) >= view.equations().model().free_shafts) return false;
    const std::size_t state = view.equations().speed_index(shaft);
    const double ends[] = {direction_ * gain * view.y_previous()[state], direction_ * gain * view.y()[state]};
    const auto [least, most] = std::minmax(ends[0], ends[1]);
    if (least > 0.5 * most) return false;
    for (int k = 0; k <= places; ++k) {
      const double t = view.t_previous() + (view.t() - view.t_previous()) * k / places;
      if (direction_ * gain * view.at(t, state) < -rounding * std::max(std::abs(least), std::abs(most))) return true;
    }
    return false;
  }
  double first = 0, last = 0;  // when [s]
  bool turns_back = false;     // between the first and the last
  std::vector<CrankMotion> passed;
  std::vector<MachineForces> machine;

 private:
  std::size_t tracked_;
  int node_;
  const DeformedMechanism& forces_;
  const std::vector<Abscissa>& where_;
  std::vector<double> targets_;
  int direction_;
};

// Angles of the crank at the steps' ends: events are among them.
class StepEnds final : public Observer {
 public:
  explicit StepEnds(std::size_t tracked) : tracked_(tracked) {}
  void step(StepView& view) override {
    t_.push_back(view.t());
    angle_.push_back(view.equations().angle_with_turns(tracked_, view.y()));
  }
  double angle(double t) const {
    const auto after = std::lower_bound(t_.begin(), t_.end(), t);
    const auto i = static_cast<std::size_t>(after - t_.begin());
    if (i == t_.size()) return angle_.back();
    return angle_[i > 0 && t - t_[i - 1] < t_[i] - t ? i - 1 : i];
  }

 private:
  std::size_t tracked_;
  std::vector<double> t_, angle_;
};

}  // namespace kurbel
