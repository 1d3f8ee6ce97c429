// directional.cpp — directional derivatives of an instance: rates by states from the exact Jacobian, outputs that are linear
// in the motion or are torques of springs, dampers and slipping contacts from the exact slopes of the same laws. What is
// left is by central differences of fourth order.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

#include "library/fmi/instance.h"

namespace kurbel {
namespace {

std::size_t at(int index) { return static_cast<std::size_t>(index); }

// The motion's derivative along a direction of the states, as a snapshot: what is linear in a snapshot has its own value
// there as its derivative. Torques are those of elastic joints that do not stick.
class Tangent {
 public:
  Tangent(Equations& flow, double t, const std::vector<double>& y, const std::vector<double>& along)
      : flow_(flow), m_(flow.model()) {
    const double* const twist = along.data() + flow.twists_begin();
    speed_.assign(m_.shafts.size(), 0);
    std::copy_n(along.begin() + static_cast<std::ptrdiff_t>(flow.speed_index(0)), m_.free_shafts, speed_.begin());
    std::vector<double> shaft_angle(m_.shafts.size(), 0);
    for (std::size_t k = m_.angles.size(); k-- > 0;) shaft_angle[at(m_.angles[k].shaft)] = along[k] / m_.angles[k].gain;
    flow.set_shaft_angles(twist, shaft_angle);
    for (std::size_t n = 0; n < m_.network.nodes.size(); ++n)
      node_angle_.push_back(m_.gain_of_node[n] * shaft_angle[at(m_.shaft_of_node[n])]);
    torque_.assign(m_.network.joints.size(), 0);
    std::vector<TorqueSlope> slopes;
    const Instant now = flow.instant(t, y);
    for (const auto& pool : m_.pools) pool->add_torque_slopes(now, slopes);
    for (const TorqueSlope& slope : slopes) {
      const ElasticJoint& of = m_.elastic[at(slope.by == TorqueSlope::By::rate ? slope.index : slope.connection)];
      torque_[at(m_.elastic[at(slope.connection)].joint)] += slope.value * moved(slope, of, along, twist);
    }
    snapshot_.now.angle = along.data(), snapshot_.now.twist = twist, snapshot_.now.speed = speed_.data();
    snapshot_.now.own = along.data() + flow.internal_begin();
    snapshot_.node_angle = node_angle_.data(), snapshot_.joint_torque = torque_.data();
  }
  Tangent(const Tangent&) = delete;
  Tangent& operator=(const Tangent&) = delete;

  const Snapshot& snapshot() const { return snapshot_; }
  bool knows(const Channel& channel) const {
    const QuantityKind& what = channel.name.what;
    if (what == quantities::angle || what == quantities::speed || what == quantities::twist || what == quantities::slip)
      return true;
    if (what == quantities::torque)
      return std::any_of(m_.torque_joints.begin(), m_.torque_joints.end(), [&](const TorqueJoint& joint) {
        return joint.component == channel.name.of && joint.elastic >= 0 &&
               !(m_.elastic[at(joint.elastic)].slips && flow_.modes().slip[at(joint.elastic)] == 0);
      });
    return std::any_of(m_.internal_states.begin(), m_.internal_states.end(), [&](const PlacedInternalState& own) {
      return Name::own(own.state.name, own.component).text == channel.name.text;
    });
  }

 private:
  double moved(const TorqueSlope& slope, const ElasticJoint& of, const std::vector<double>& along,
               const double* twist) const {
    const double a = of.gain_a * speed_[at(of.shaft_a)];
    switch (slope.by) {
      case TorqueSlope::By::twist:
        return twist[slope.index];
      case TorqueSlope::By::rate:
        return a - of.gain_b * speed_[at(of.shaft_b)];
      case TorqueSlope::By::own:
        return along[flow_.internal_begin() + at(slope.index)];
      case TorqueSlope::By::angle:
        return along[at(slope.index)];
      case TorqueSlope::By::speed_of_a:
        break;
    }
    return a;
  }

  const Equations& flow_;
  const Model& m_;
  std::vector<double> speed_, node_angle_, torque_;
  Snapshot snapshot_{};
};

}  // namespace

// Of all unknowns by differences along a direction, at −2h … 2h; move(0) goes back.
void Instance::add_differences(std::span<const std::uint32_t> unknowns, double h,
                               const std::function<void(double by)>& move, std::vector<double>& result) {
  std::vector<std::array<double, 4>> at(unknowns.size());
  try {
    for (int k = 0; k < 4; ++k) {
      move((k < 2 ? k - 2 : k - 1) * h);
      for (std::size_t u = 0; u < unknowns.size(); ++u) at[u][static_cast<std::size_t>(k)] = value(unknowns[u]);
    }
  } catch (...) {
    move(0);
    throw;
  }
  for (std::size_t u = 0; u < unknowns.size(); ++u)
    result[u] += (8 * (at[u][2] - at[u][1]) - (at[u][3] - at[u][0])) / (12 * h);
  move(0);
}

std::vector<double> Instance::directional(std::span<const std::uint32_t> unknowns,
                                          std::span<const std::uint32_t> knowns, std::span<const double> seed) {
  using enum ExportedVariable::Role;
  made();
  const std::size_t states = equations_->state_count();
  std::vector<double> along(states, 0), scale(states), inputs(s_.inputs.size(), 0);
  nominals(scale);
  double size_states = 0, size_inputs = 0;
  for (std::size_t k = 0; k < knowns.size(); ++k) {
    const ExportedVariable& v = variable(knowns[k]);
    if (v.role == state) {
      along[v.place] += seed[k];
      size_states = std::max(size_states, std::abs(seed[k]) / scale[v.place]);
    } else if (v.role == input) {
      inputs[v.place] += seed[k];
      using enum ExportedInput::What;
      const auto what = machine_.inputs[v.place].what;
      // A command stays on its side of 0: laws are of its square, by its sign.
      const double now = std::abs(s_.inputs[v.place]);
      const double usual = what == torque  ? equations_->model().torque_scale
                           : what == speed ? equations_->model().speed_scale
                           : now > 0       ? std::min(now, 1.0)
                                           : 1.0;
      size_inputs = std::max(size_inputs, std::abs(seed[k]) / (usual > 0 ? usual : 1));
    } else if (v.role != parameter) {
      throw std::invalid_argument(fmt::format("{} is no state and no input", v.name));
    } else {
      throw std::invalid_argument(fmt::format("no derivatives by parameters ({})", v.name));
    }
  }
  std::vector<double> result(unknowns.size(), 0);
  const State kept = s_.here.state;
  if (size_states > 0) {
    add_differences(
        unknowns, 1e-4 / size_states,
        [&](double by) {
          for (std::size_t k = 0; k < states; ++k) s_.here.state.y[k] = kept.y[k] + by * along[k];
        },
        result);
    const SparsityPattern& pattern = equations_->jacobian_pattern();
    std::vector<double> values(pattern.row.size()), rate(states, 0);
    equations_->jacobian(kept.t, kept.y, values);
    for (std::size_t column = 0; column < states; ++column)
      for (auto k = static_cast<std::size_t>(pattern.column_start[column]);
           k < static_cast<std::size_t>(pattern.column_start[column + 1]); ++k)
        if (const auto row = static_cast<std::size_t>(pattern.row[k]); row < states)
          rate[row] += values[k] * along[column];
    const Tangent tangent(*equations_, kept.t, kept.y, along);
    for (std::size_t k = 0; k < unknowns.size(); ++k) {
      const ExportedVariable& v = variable(unknowns[k]);
      if (v.role == derivative) result[k] = rate[v.place];
      if (v.role == state) result[k] = along[v.place];
      if (v.role == output && tangent.knows(view_->outputs[v.place]))
        result[k] = view_->outputs[v.place].value(tangent.snapshot());
    }
  }
  // Commands alone change: what is switched stays as it is. Laws are of first or second degree in them, of which these
  // differences leave nothing out; steps are long, so that little is lost by rounding.
  if (size_inputs > 0)
    add_differences(
        unknowns, 0x1p-8 / size_inputs,
        [&](double by) {
          for (std::size_t k = 0; k < inputs.size(); ++k)
            if (inputs[k] != 0) {
              Command moved = kept.modes.command[commands_[k]];
              moved.value += by * inputs[k], moved.to += by * inputs[k];
              equations_->changing_modes().command[commands_[k]] = moved;
            }
        },
        result);
  equations_->changing_modes().command = kept.modes.command;
  return result;
}

}  // namespace kurbel
