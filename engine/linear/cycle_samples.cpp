// cycle_samples.cpp — integrates the period again and samples the dense output.
#include "engine/linear/cycle_samples.h"

#include <stdexcept>

#include "engine/numerics/index.h"
#include "engine/orbit/follow_period.h"

namespace kurbel {
namespace {

class Sampler final : public Observer {
 public:
  Sampler(const Model& m, CycleSamples& out, double begin, std::size_t count)
      : m_(m), out_(out), begin_(begin), count_(count), mean_(m.state_count(), 0.0) {
    for (auto* values : {&out_.torque, &out_.twist}) values->assign(m.elastic.size(), std::vector<double>(count, 0.0));
  }

  void step(StepView& view) override {
    for (; next_ < count_; ++next_) {
      const double t = begin_ + (static_cast<double>(next_) + 0.5) / static_cast<double>(count_) * out_.time;
      if (t > view.t()) break;
      take(view, std::max(t, view.t_previous()));
    }
  }
  // Samples beyond the last step, which ends at the period to rounding.
  bool is_full() const { return next_ >= count_; }
  std::vector<double> means() const {
    std::vector<double> all = mean_;
    for (double& v : all) v /= static_cast<double>(count_);
    return all;
  }

 private:
  void take(StepView& view, double t) {
    Equations& equations = view.equations();
    const std::span<const double> now = view.at(t);
    y_.assign(now.begin(), now.begin() + static_cast<std::ptrdiff_t>(equations.size()));
    const Snapshot& s = equations.snapshot(t, y_);
    for (std::size_t i = 0; i < mean_.size(); ++i) mean_[i] += y_[i];
    for (std::size_t j = 0; j < m_.elastic.size(); ++j) {
      const Network::Joint& joint = m_.network.joints[at(m_.elastic[j].joint)];
      const double rest = joint.element->is.turns_unevenly ? joint.element->rest_twist(s.node_angle[joint.a]) : 0;
      out_.torque[j][next_] = s.sums.connection_torque[j];
      out_.twist[j][next_] = s.now.twist[j] - rest;
      mean_[equations.twist_index(static_cast<int>(j))] -= rest;
    }
    for (const TorqueJoint& joint : m_.torque_joints)
      if (joint.elastic >= 0)
        out_.torque[at(joint.elastic)][next_] = joint.reported(s.sums.connection_torque, joint.elastic);
  }

  const Model& m_;
  CycleSamples& out_;
  double begin_;
  std::size_t count_, next_ = 0;
  std::vector<double> mean_, y_;
};

}  // namespace

CycleSamples sample_cycle(const Orbit& orbit, std::size_t count, double tolerance) {
  const ReturnMap& map = *orbit.map;
  const Model& m = map.model();
  Equations equations(map.shared_model(), false);
  const std::vector<double> y = map.place(equations, orbit.point.z);
  CycleSamples out;
  out.time = orbit.point.time;
  out.link_angle = equations.angle_with_turns(at(m.reduction_angle), y);
  MeanMotion mean{.state = {map.start_time(), y, equations.modes()}, .speed = 0, .mean = {}, .joint_torque = {}};
  Sampler sampler(m, out, map.start_time(), count);
  const RunOutcome outcome = follow_period(map, orbit.point, equations, {.tolerance = tolerance}, {&sampler});
  if (!outcome.diagnosis.empty()) throw std::invalid_argument(outcome.diagnosis);
  if (!sampler.is_full()) throw std::invalid_argument("the cycle of the steady motion ended before its period");
  out.events = outcome.events;
  mean.mean = sampler.means();
  mean.speed = (equations.angle_with_turns(at(m.reduction_angle), outcome.state) - out.link_angle) / out.time;
  for (const std::vector<double>& torque : out.torque) {
    double sum = 0;
    for (const double v : torque) sum += v;
    mean.joint_torque.push_back(sum / static_cast<double>(count));
  }
  out.mean = std::make_shared<const MeanMotion>(std::move(mean));
  return out;
}

std::shared_ptr<const MeanMotion> means_of_equilibrium(std::shared_ptr<const Model> shared, const State& state) {
  const Model& model = *shared;
  Equations equations(std::move(shared), false);
  equations.bind(state.modes);
  std::vector<double> y = state.y;
  y.resize(equations.size(), 0.0);
  const Snapshot& s = equations.snapshot(state.t, y);
  const TrackedAngle& link = model.angles[at(model.reduction_angle)];
  MeanMotion mean{.state = state, .speed = link.gain * s.now.speed[link.shaft], .mean = y, .joint_torque = {}};
  mean.state.y = y;
  mean.joint_torque.assign(s.sums.connection_torque, s.sums.connection_torque + model.elastic.size());
  return std::make_shared<const MeanMotion>(std::move(mean));
}

}  // namespace kurbel
