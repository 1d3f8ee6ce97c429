// linearise.cpp — M, C, K from the equations' own Jacobian: at one angle, or averaged over the cycle.
#include "engine/analysis/linearise.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "engine/events/equations.h"
#include "engine/numerics/index.h"
#include "engine/rigid/rigid_machine.h"

namespace kurbel {
namespace {

class Lineariser {
 public:
  Lineariser(std::shared_ptr<const Model> model, const LinearisationPoint& point)
      : equations_(model, false), m_(*model) {
    drive_.model = std::move(model);
    drive_.at = point;
  }

  LinearDrive drive() {
    choose_positions();
    number_coordinates();
    average_torques();
    set_mean_twists();
    add_jacobians();
    describe();
    return std::move(drive_);
  }

 private:
  using Triplets = std::vector<Eigen::Triplet<double>>;

  void choose_positions() {
    const auto& elements = m_.network.elements;
    const bool turns = std::any_of(elements.begin(), elements.end(),
                                   [](const Network::ShaftElement& e) { return e.element->is.uses_angle; }) ||
                       std::any_of(m_.elastic.begin(), m_.elastic.end(), [&](const ElasticJoint& e) {
                         return m_.network.joints[at(e.joint)].element->is.uses_angle;
                       });
    const double cycle = cycle_of(m_).angle;
    if (drive_.at.angle || !turns) {
      angles_ = {drive_.at.angle.value_or(0)};
      return;
    }
    const int n = drive_.at.positions * static_cast<int>(std::lround(cycle / (2 * std::numbers::pi)));
    for (int i = 0; i < n; ++i) angles_.push_back((i + 0.5) * cycle / n);  // off the round angles of load edges
  }

  std::vector<double> state(double angle) { return equations_.modes_from_scratch(0, angle, drive_.at.speed); }

  void number_coordinates() {
    if (m_.elastic.empty())
      throw std::invalid_argument(
          "nothing is elastic, so the drive has no modes; switch elasticity on in [effects], or with --effects "
          "elasticity");
    if (!m_.relations.empty())
      throw std::invalid_argument(fmt::format(
          "\"{}\" ties shafts only while the machine runs (losses, a housing that moves, three free shafts); "
          "modes are sought without that: --effects elasticity leaves losses out, fixed holds a shaft of a "
          "planetary gear",
          m_.network.relations.front().component));
    state(angles_.front());
    drive_.coordinate.assign(m_.shafts.size(), -1);
    for (std::size_t s = 0; s < m_.free_shafts; ++s) {
      if (m_.shafts[s].directional && equations_.at_standstill(s)) continue;
      drive_.coordinate[s] = static_cast<int>(drive_.shaft.size());
      drive_.shaft.push_back(static_cast<int>(s));
      drive_.ratio.push_back(m_.node_ratio[at(m_.shafts[s].reference)]);
    }
    if (drive_.shaft.empty())
      throw std::invalid_argument(
          "every shaft is held by friction at rest, so nothing can swing; give a speed, e.g. --speed \"10 rpm\"");
    drive_.inertia.resize(static_cast<Eigen::Index>(drive_.shaft.size()));
    for (std::size_t i = 0; i < drive_.shaft.size(); ++i)
      drive_.inertia[static_cast<Eigen::Index>(i)] = m_.shafts[at(drive_.shaft[i])].mean_inertia;
  }

  // Mean torque of the elements on every shaft at uniform speed.
  void average_torques() {
    torque_ = drive_.at.added;
    torque_.resize(m_.shafts.size(), 0.0);
    for (const double angle : angles_) {
      const Snapshot& s = equations_.snapshot(0, state(angle));
      for (std::size_t e = 0; e < m_.network.elements.size(); ++e) {
        if (!drive_.at.angle_torques && m_.network.elements[e].element->is.uses_angle) continue;
        const std::size_t n = at(m_.network.elements[e].node);
        torque_[at(m_.shaft_of_node[n])] +=
            m_.gain_of_node[n] * s.sums.element_torque[e] / static_cast<double>(angles_.size());
      }
    }
  }

  // Torques that the joints must carry, from the leaves to a root that can take the rest: a held shaft, if there is
  // one. A machine out of balance accelerates as one.
  void set_mean_twists() {
    const std::size_t shafts = m_.shafts.size();
    std::vector<double> ratio(shafts), need(shafts, 0.0);
    double torque = 0, inertia = 0;
    int root = m_.shaft_of_node[at(m_.reduction_node)];
    bool free = true;
    std::vector<char> joined(shafts, 0);  // to the link; the frame that holds a gear's carrier is not
    joined[at(root)] = 1;
    for (const Step& step : walk_from(root)) joined[at(step.child)] = 1;
    for (std::size_t s = 0; s < shafts; ++s) {
      ratio[s] = m_.node_ratio[at(m_.shafts[s].reference)];
      torque += torque_[s] * ratio[s];
      inertia += m_.shafts[s].mean_inertia * ratio[s] * ratio[s];
      if (drive_.coordinate[s] < 0 && joined[s]) root = static_cast<int>(s), free = false;
    }
    drive_.mean_torque = torque;
    const double acceleration = free ? torque / inertia : 0;
    for (std::size_t s = 0; s < shafts; ++s) need[s] = m_.shafts[s].mean_inertia * ratio[s] * acceleration - torque_[s];
    mean_torque_.assign(m_.elastic.size(), 0.0);
    const std::vector<Step> steps = walk_from(root);
    for (auto step = steps.rbegin(); step != steps.rend(); ++step) {
      const ElasticJoint& e = m_.elastic[at(step->joint)];
      const double wanted = need[at(step->child)];
      const bool child_is_b = e.shaft_b == step->child;
      const double tau = child_is_b ? wanted / e.gain_b : -wanted / e.gain_a;
      mean_torque_[at(step->joint)] = tau;
      need[at(step->parent)] += child_is_b ? e.gain_a * tau : -e.gain_b * tau;
    }
    twist_.resize(m_.elastic.size());
    for (std::size_t i = 0; i < twist_.size(); ++i)
      twist_[i] = m_.network.joints[at(m_.elastic[i].joint)].element->twist_at(mean_torque_[i]);
  }

  struct Step {
    int joint, child, parent;
  };
  std::vector<Step> walk_from(int root) const {
    std::vector<std::vector<int>> joints_at(m_.shafts.size());
    for (std::size_t i = 0; i < m_.elastic.size(); ++i) {
      joints_at[at(m_.elastic[i].shaft_a)].push_back(static_cast<int>(i));
      joints_at[at(m_.elastic[i].shaft_b)].push_back(static_cast<int>(i));
    }
    std::vector<Step> steps;
    std::vector<char> seen(m_.shafts.size(), 0);
    std::vector<int> queue = {root};
    seen[at(root)] = 1;
    for (std::size_t next = 0; next < queue.size(); ++next) {
      const int here = queue[next];
      for (const int j : joints_at[at(here)]) {
        const int other = m_.elastic[at(j)].shaft_a == here ? m_.elastic[at(j)].shaft_b : m_.elastic[at(j)].shaft_a;
        if (seen[at(other)]) continue;
        seen[at(other)] = 1;
        steps.push_back({j, other, here});
        queue.push_back(other);
      }
    }
    return steps;
  }

  // Rows of the speeds times their inertia are derivatives of torques.
  void add_jacobians() {
    const SparsityPattern& pattern = equations_.jacobian_pattern();
    std::vector<double> values(pattern.row.size());
    const std::size_t first_twist = equations_.twist_index(0), first_speed = equations_.speed_index(0);
    const double share = 1.0 / static_cast<double>(angles_.size());
    std::vector<double> joint_stiffness(m_.elastic.size(), 0.0);
    Triplets damping, by_angle;
    for (const double angle : angles_) {
      std::vector<double> y = state(angle);
      for (std::size_t i = 0; i < twist_.size(); ++i) {
        const Network::Joint& joint = m_.network.joints[at(m_.elastic[i].joint)];
        y[first_twist + i] = twist_[i] + joint.element->rest_twist(angle * m_.node_ratio[at(joint.a)]);
      }
      equations_.modes_at(0, y);  // the pieces of laws that hold at these twists
      equations_.jacobian(0, y, values);
      const double* inertia = equations_.snapshot(0, y).sums.inertia;
      if (drive_.at.angle)
        for (std::size_t i = 0; i < drive_.shaft.size(); ++i)
          drive_.inertia[static_cast<Eigen::Index>(i)] = inertia[drive_.shaft[i]];
      for (std::size_t column = 0; column < m_.state_count(); ++column)
        for (auto k = pattern.column_start[column]; k < pattern.column_start[column + 1]; ++k) {
          const auto row = static_cast<std::size_t>(pattern.row[static_cast<std::size_t>(k)]);
          if (row < first_speed) continue;
          const std::size_t s = row - first_speed;
          if (s >= m_.free_shafts) continue;  // the elements' own states stand still
          const int i = drive_.coordinate[s];
          if (i < 0) continue;
          const double slope = -share * inertia[s] * values[static_cast<std::size_t>(k)];
          if (column >= first_speed) {
            const std::size_t of = column - first_speed;
            const int j = of < m_.free_shafts ? drive_.coordinate[of] : -1;
            if (j >= 0) damping.emplace_back(i, j, slope);
          } else if (column >= first_twist) {
            const std::size_t joint = column - first_twist;
            const ElasticJoint& e = m_.elastic[joint];
            const bool from_a = at(e.shaft_a) == s;
            // Either end tells the same stiffness: the free one, a first.
            if (from_a || drive_.coordinate[at(e.shaft_a)] < 0)
              joint_stiffness[joint] += from_a ? slope / e.gain_a : -slope / e.gain_b;
          } else if (drive_.at.angle) {
            const TrackedAngle& tracked = m_.angles[column];
            const int j = drive_.coordinate[at(tracked.shaft)];
            if (j >= 0) by_angle.emplace_back(i, j, slope * tracked.gain);
          }
        }
    }
    const Eigen::Index n = drive_.size();
    drive_.damping = SparseMatrix(n, n);
    drive_.damping.setFromTriplets(damping.begin(), damping.end());
    drive_.angle_stiffness = SparseMatrix(n, n);
    drive_.angle_stiffness.setFromTriplets(by_angle.begin(), by_angle.end());
    assemble_joints(joint_stiffness);
  }

  void assemble_joints(const std::vector<double>& stiffness) {
    Triplets entries;
    for (std::size_t i = 0; i < m_.elastic.size(); ++i) {
      const ElasticJoint& e = m_.elastic[i];
      const AnyConnection& element = *m_.network.joints[at(e.joint)].element;
      LinearDrive::Joint joint{drive_.coordinate[at(e.shaft_a)], drive_.coordinate[at(e.shaft_b)], e.gain_a, e.gain_b};
      joint.stiffness = stiffness[i];
      joint.damping = element.torque_rate(twist_[i], 0, 1);  // dτ/dθ̇
      joint.torque = mean_torque_[i];
      const double k = joint.stiffness;
      if (joint.a >= 0) entries.emplace_back(joint.a, joint.a, k * e.gain_a * e.gain_a);
      if (joint.b >= 0) entries.emplace_back(joint.b, joint.b, k * e.gain_b * e.gain_b);
      if (joint.a >= 0 && joint.b >= 0) {
        entries.emplace_back(joint.a, joint.b, -k * e.gain_a * e.gain_b);
        entries.emplace_back(joint.b, joint.a, -k * e.gain_a * e.gain_b);
      }
      drive_.joints.push_back(joint);
    }
    drive_.stiffness = SparseMatrix(drive_.size(), drive_.size());
    drive_.stiffness.setFromTriplets(entries.begin(), entries.end());
  }

  void describe() {
    std::string text;
    const bool variable = std::any_of(m_.shafts.begin(), m_.shafts.end(), [](const Shaft& s) { return s.variable; });
    if (drive_.at.angle) {
      text = fmt::format("mechanisms with their inertia at {:.4g}° of the reduction link",
                         *drive_.at.angle * 180 / std::numbers::pi);
    } else if (variable) {
      text = "mechanisms with the mean of their inertia over the cycle";
    } else {
      text = "constant inertias";
    }
    std::string held;
    for (std::size_t s = 0; s < m_.shafts.size(); ++s) {
      if (drive_.coordinate[s] >= 0) continue;
      held += fmt::format("; {} held ({})", m_.node_label(m_.shafts[s].reference),
                          s < m_.free_shafts ? "friction at rest" : "its speed is prescribed");
    }
    drive_.mode_set =
        text + held +
        (drive_.at.speed == 0 ? "" : fmt::format("; all turn {}", drive_.at.speed > 0 ? "forwards" : "backwards"));
  }

  Equations equations_;
  const Model& m_;
  LinearDrive drive_;
  std::vector<double> angles_;
  std::vector<double> torque_, mean_torque_, twist_;
};

}  // namespace

double LinearDrive::twist(std::size_t joint, const Eigen::VectorXd& q) const {
  const Joint& j = joints[joint];
  return (j.a >= 0 ? j.gain_a * q[j.a] : 0.0) - (j.b >= 0 ? j.gain_b * q[j.b] : 0.0);
}

LinearDrive linearise(std::shared_ptr<const Model> model, const LinearisationPoint& point) {
  return Lineariser(std::move(model), point).drive();
}

double usual_speed(const Model& model) {
  const StartSettings& start = model.scene.run.start;
  if (start.speed != 0) {
    const int on = start.on.empty() ? model.reduction_node : model.network.ports.at(start.on).in;
    return start.speed / model.node_ratio[at(on)];
  }
  return model.speed_scale;
}

}  // namespace kurbel
