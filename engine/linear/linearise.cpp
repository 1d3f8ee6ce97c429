// linearise.cpp — M, C, K and the elements' internal states from averages along the base motion.
#include "engine/linear/linearise.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "engine/numerics/index.h"
#include "engine/numerics/roots.h"

namespace kurbel {
namespace {

using Eigen::Index;
using Triplets = std::vector<Eigen::Triplet<double>>;

constexpr int positions_of_balance = 64;       // a turn: enough to find a speed
constexpr double left_by_differences = 1e-11;  // of the largest entry: rounding in a difference of equal ones

// At a given angle of the link, weights and loads that depend on it add stiffness.
void refuse_what_cannot_vibrate(const Model& m, const LinearisationPoint& point) {
  const auto& elements = m.network.elements;
  if (point.angle && std::any_of(elements.begin(), elements.end(),
                                 [](const Network::ShaftElement& e) { return e.element->is.uses_angle; }))
    return;
  const bool springs = std::any_of(m.elastic.begin(), m.elastic.end(), [&](const ElasticJoint& e) {
    return m.network.joints[at(e.joint)].element->is.has_spring();
  });
  if (!springs && m.internal_states.empty())
    throw std::invalid_argument(
        "nothing is elastic, so the drive has no modes; switch elasticity on in [effects], or with --effects "
        "elasticity");
}

class Lineariser {
 public:
  explicit Lineariser(BaseMotion& base) : base_(base), m_(base.model()) {}

  LinearDrive drive(std::shared_ptr<const Model> model) {
    drive_.model = std::move(model);
    drive_.at = base_.point();
    list_shafts();
    drive_.twists = base_.twists();
    drive_.inertia = base_.inertia();
    drive_.mean_torque = base_.left_over();
    take_slopes();
    take_torques();
    take_jacobian();
    describe();
    return std::move(drive_);
  }

 private:
  void list_shafts() {
    const SparseRows motion = base_.coordinates().motion;
    Triplets entries;
    for (Index s = 0; s < motion.rows(); ++s) {
      bool any = false;
      for (SparseRows::InnerIterator it(motion, s); it; ++it) {
        entries.emplace_back(static_cast<int>(drive_.shaft.size()), static_cast<int>(it.col()), it.value());
        any = true;
      }
      if (!any) continue;
      drive_.shaft.push_back(static_cast<int>(s));
      drive_.ratio.push_back(m_.node_ratio[at(m_.shafts[at(s)].reference)]);
    }
    drive_.motion = SparseMatrix(static_cast<Index>(drive_.shaft.size()), motion.cols());
    drive_.motion.setFromTriplets(entries.begin(), entries.end());
    drive_.shaft_inertia.resize(static_cast<Index>(drive_.shaft.size()));
    for (std::size_t i = 0; i < drive_.shaft.size(); ++i)
      drive_.shaft_inertia[static_cast<Index>(i)] = base_.shaft_inertia()[drive_.shaft[i]];
  }

  // Averaged derivatives of the joints' torques by their inputs.
  void take_slopes() {
    using By = TorqueSlope::By;
    drive_.joints.resize(m_.elastic.size());
    std::vector<TorqueSlope> slopes;
    Triplets by_twist, by_rate, by_internal;
    std::vector<double> of_a(m_.elastic.size(), 0.0);
    const double share = 1.0 / static_cast<double>(base_.positions().size());
    for (const BaseMotion::Position& position : base_.positions()) {
      const Instant now = base_.equations().instant(base_.time(position), base_.at(position));
      slopes.clear();
      for (const auto& pool : m_.pools) pool->add_torque_slopes(now, slopes);
      for (const TorqueSlope& slope : slopes) {
        const double value = share * slope.value;
        if (slope.by == By::twist) by_twist.emplace_back(slope.connection, slope.index, value);
        if (slope.by == By::rate) by_rate.emplace_back(slope.connection, slope.index, value);
        if (slope.by == By::own && value != 0) by_internal.emplace_back(slope.connection, slope.index, value);
        if (slope.by == By::speed_of_a) of_a[at(slope.connection)] += value;
      }
    }
    const auto joints = static_cast<Index>(m_.elastic.size()), shafts = static_cast<Index>(m_.shafts.size());
    SparseMatrix torque_by_twist(joints, joints), torque_by_rate(joints, joints);
    torque_by_twist.setFromTriplets(by_twist.begin(), by_twist.end());
    torque_by_rate.setFromTriplets(by_rate.begin(), by_rate.end());
    bool rows = false;
    Triplets of_rate, of_speed;
    for (std::size_t j = 0; j < m_.elastic.size(); ++j) {
      const ElasticJoint& e = m_.elastic[j];
      const AnyConnection& element = *m_.network.joints[at(e.joint)].element;
      const auto i = static_cast<Index>(j);
      // A part of a row separately: with the same torque in all parts at rest.
      drive_.joints[j].stiffness = element.row ? element.stiffness : torque_by_twist.coeff(i, i);
      drive_.joints[j].damping = element.row ? element.damping : torque_by_rate.coeff(i, i);
      rows = rows || element.row;
      of_rate.emplace_back(static_cast<int>(j), e.shaft_a, e.gain_a);
      of_rate.emplace_back(static_cast<int>(j), e.shaft_b, -e.gain_b);
      of_speed.emplace_back(static_cast<int>(j), e.shaft_a, e.gain_a * of_a[j]);
    }
    SparseMatrix rates(joints, shafts), of_shafts(joints, shafts);
    rates.setFromTriplets(of_rate.begin(), of_rate.end());
    of_shafts.setFromTriplets(of_speed.begin(), of_speed.end());
    of_shafts += SparseMatrix(torque_by_rate * rates);
    if (rows) drive_.row_stiffness = beyond_diagonal(torque_by_twist, &LinearDrive::Joint::stiffness);
    if (rows) drive_.row_damping = beyond_diagonal(torque_by_rate, &LinearDrive::Joint::damping);
    drive_.joint_by_speed = of_shafts * base_.coordinates().motion;
    drive_.joint_by_internal = SparseMatrix(joints, static_cast<Index>(m_.internal_states.size()));
    drive_.joint_by_internal.setFromTriplets(by_internal.begin(), by_internal.end());
  }

  SparseRows beyond_diagonal(const SparseMatrix& all, double LinearDrive::Joint::*own) const {
    Triplets entries;
    for (std::size_t j = 0; j < drive_.joints.size(); ++j)
      entries.emplace_back(static_cast<int>(j), static_cast<int>(j), drive_.joints[j].*own);
    SparseMatrix diagonal(all.rows(), all.cols());
    diagonal.setFromTriplets(entries.begin(), entries.end());
    SparseMatrix rest = all - diagonal;
    rest.prune(0.0);
    return rest;
  }

  void take_torques() {
    const Modes& modes = base_.equations().modes();
    const std::shared_ptr<const MeanMotion>& orbit = base_.point().orbit;
    const bool known = orbit && orbit->speed == base_.point().speed && !base_.point().angle;
    const Eigen::VectorXd mean = known ? Eigen::VectorXd() : base_.mean_joint_torques();
    for (std::size_t j = 0; j < m_.elastic.size(); ++j) {
      LinearDrive::Joint& joint = drive_.joints[j];
      const ConnectionTraits& is = m_.network.joints[at(m_.elastic[j].joint)].element->is;
      joint.torque = known ? orbit->joint_torque[j] : mean[static_cast<Index>(j)];
      joint.state = is.springless        ? LinearDrive::Joint::State::film
                    : !is.slips          ? LinearDrive::Joint::State::spring
                    : modes.slip[j] == 0 ? LinearDrive::Joint::State::sticks
                                         : LinearDrive::Joint::State::slips;
    }
  }

  void take_jacobian() {
    MeanDerivatives j = base_.mean_derivatives();
    const Index n = drive_.size();
    const SparseMatrix t = base_.twists();
    Eigen::VectorXd k(t.rows());
    for (Index i = 0; i < k.size(); ++i) k[i] = drive_.joints[at(i)].stiffness;
    drive_.stiffness = SparseMatrix(t.transpose()) * k.asDiagonal() * t;
    if (drive_.row_stiffness.nonZeros() > 0)
      drive_.stiffness += SparseMatrix(SparseMatrix(t.transpose()) * SparseMatrix(drive_.row_stiffness) * t);
    drive_.damping = -j.torque_by_speed;
    drive_.torque_by_twist = std::move(j.torque_by_twist);
    SparseMatrix rest = -(drive_.torque_by_twist * t) - drive_.stiffness;
    const double scale = largest(drive_.stiffness);
    rest.prune([&](Index, Index, double v) { return std::abs(v) > left_by_differences * scale; });
    if (base_.point().angle) rest -= j.torque_by_angle;
    drive_.other_stiffness = rest.nonZeros() > 0 ? rest : SparseMatrix(n, n);
    drive_.torque_by_internal = std::move(j.torque_by_internal);
    drive_.internal_by_twist = std::move(j.internal_by_twist);
    drive_.internal_by_speed = std::move(j.internal_by_speed);
    drive_.internal_by_angle = std::move(j.internal_by_angle);
    drive_.internal_by_internal = std::move(j.internal_by_internal);
    drive_.internal_scale.resize(static_cast<Index>(m_.internal_states.size()));
    for (std::size_t i = 0; i < m_.internal_states.size(); ++i)
      drive_.internal_scale[static_cast<Index>(i)] = m_.internal_states[i].state.scale;
  }
  static double largest(const SparseMatrix& m) {
    double most = 0;
    for (Index c = 0; c < m.outerSize(); ++c)
      for (SparseMatrix::InnerIterator it(m, c); it; ++it) most = std::max(most, std::abs(it.value()));
    return most;
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
    std::vector<char> moves(m_.shafts.size(), 0);
    for (const int s : drive_.shaft) moves[at(s)] = 1;
    for (std::size_t s = 0; s < m_.shafts.size(); ++s) {
      if (moves[s] || (s >= m_.free_shafts && m_.node_ratio[at(m_.shafts[s].reference)] == 0)) continue;
      held += fmt::format("; {} held ({})", m_.node_label(m_.shafts[s].reference),
                          s < m_.free_shafts ? "friction at rest" : "its speed is prescribed");
    }
    for (const auto& [state, words] : {std::pair(LinearDrive::Joint::State::sticks, "sticks"),
                                       std::pair(LinearDrive::Joint::State::slips, "slips: a damper")})
      for (std::size_t j = 0; j < drive_.joints.size(); ++j)
        if (drive_.joints[j].state == state)
          held += fmt::format("; {} {}", m_.network.joints[at(m_.elastic[j].joint)].component, words);
    drive_.mode_set =
        text + held +
        (drive_.at.speed == 0 ? "" : fmt::format("; all turn {}", drive_.at.speed > 0 ? "forwards" : "backwards")) +
        (base_.words().empty() ? "" : "; " + base_.words());
  }

  BaseMotion& base_;
  const Model& m_;
  LinearDrive drive_;
};

}  // namespace

namespace {

Eigen::VectorXcd torques(const std::vector<LinearDrive::Joint>& joints, double LinearDrive::Joint::*own,
                         const SparseRows& rows, const Eigen::VectorXcd& motion) {
  Eigen::VectorXcd torque(motion.size());
  for (Index j = 0; j < motion.size(); ++j) torque[j] = joints[at(j)].*own * motion[j];
  if (rows.nonZeros() > 0) torque += rows * motion;
  return torque;
}

}  // namespace

Eigen::VectorXcd LinearDrive::spring_torques(const Eigen::VectorXcd& twist) const {
  return torques(joints, &Joint::stiffness, row_stiffness, twist);
}

Eigen::VectorXcd LinearDrive::damper_torques(const Eigen::VectorXcd& rate) const {
  return torques(joints, &Joint::damping, row_damping, rate);
}

Eigen::VectorXd LinearDrive::spring_work(const Eigen::VectorXd& twist) const {
  return twist.cwiseProduct(spring_torques(twist.cast<std::complex<double>>()).real());
}

void LinearDrive::stiffen(double factor) {
  for (Joint& joint : joints) joint.stiffness *= factor;
  row_stiffness *= factor;
  stiffness *= factor;
  torque_by_twist *= factor;
}

LinearDrive linearise(BaseMotion& base) {
  refuse_what_cannot_vibrate(base.model(), base.point());
  return Lineariser(base).drive(base.equations().shared_model());
}

LinearDrive linearise(std::shared_ptr<const Model> model, const LinearisationPoint& point) {
  refuse_what_cannot_vibrate(*model, point);
  BaseMotion base(std::move(model), point);
  return linearise(base);
}

double usual_speed(const Model& model) {
  const StartSettings& start = model.scene.run.start;
  if (start.speed != 0) {
    const int on = start.on.empty() ? model.reduction_node : model.network.ports.at(start.on).in;
    return start.speed / model.node_ratio[at(on)];
  }
  return model.speed_scale;
}

double balanced_speed(const std::shared_ptr<const Model>& model) {
  const double rated = usual_speed(*model);
  if (model->scene.run.start.speed != 0 || model->free_shafts < model->shafts.size()) return rated;
  const auto left = [&](double speed) {
    return BaseMotion(model, {.speed = speed, .positions = positions_of_balance}).left_over();
  };
  double high = 1.05 * rated, above = left(high);
  for (int i = 1; i <= 60 && above <= 0; ++i) {
    const double low = rated * (1.05 - 0.01 * i), below = left(low);
    if (below > 0) return find_root(left, low, below, high, above);
    high = low;
    above = below;
  }
  return rated;
}

}  // namespace kurbel
