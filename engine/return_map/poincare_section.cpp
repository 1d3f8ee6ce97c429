// poincare_section.cpp — the coordinates of a section: independent angles and twists, speeds, internal states.
#include "engine/return_map/poincare_section.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "engine/matrices/linear_algebra.h"
#include "engine/model/cycle_of.h"
#include "engine/numerics/angles.h"
#include "engine/numerics/index.h"

namespace kurbel {
namespace {

using Eigen::Index;
Index row(std::size_t i) { return static_cast<Index>(i); }

constexpr double independent = 1e-9;  // of a row's length, that is not in the span of those before

// Rows that each add a direction to those before, of a matrix whose rows count alike.
std::vector<Index> independent_rows(const Eigen::MatrixXd& rows) {
  std::vector<Index> chosen;
  Eigen::MatrixXd basis(rows.rows(), rows.cols());
  Index found = 0;
  for (Index i = 0; i < rows.rows() && found < rows.cols(); ++i) {
    const double length = rows.row(i).norm();
    if (length == 0) continue;
    Eigen::RowVectorXd rest = rows.row(i) / length;
    for (int twice = 0; twice < 2; ++twice)
      for (Index k = 0; k < found; ++k) rest -= rest.dot(basis.row(k)) * basis.row(k);
    if (rest.norm() < independent) continue;
    basis.row(found++) = rest.normalized();
    chosen.push_back(i);
  }
  return chosen;
}

// A basis of the motions that the rows allow; columns.
Eigen::MatrixXd motions(const Eigen::MatrixXd& rows, Index shafts) {
  if (rows.rows() == 0) return Eigen::MatrixXd::Identity(shafts, shafts);
  return FullLu(rows, independent).kernel();
}

// The common period of all that reads an angle, as an angle of its own shaft; 0: nothing reads it.
double period_of(const Model& m, std::size_t tracked) {
  std::vector<double> periods;
  const TrackedAngle& angle = m.angles[tracked];
  const auto same = [&](int node) {
    return m.shaft_of_node[at(node)] == angle.shaft && m.gain_of_node[at(node)] == angle.gain;
  };
  for (const Network::ShaftElement& e : m.network.elements)
    if (e.element->is.uses_angle && e.element->angle_period > 0 && same(e.node))
      periods.push_back(e.element->angle_period);
  for (const ElasticJoint& e : m.elastic) {
    const Network::Joint& joint = m.network.joints[at(e.joint)];
    if (joint.element->is.uses_angle && same(joint.a)) periods.push_back(turn);
  }
  for (const int trigger : m.trigger_angle)
    if (trigger == static_cast<int>(tracked)) periods.push_back(turn);
  if (periods.empty()) return 0;
  const CommonPeriod common = common_period(periods);
  if (common.value > 0) return common.value;
  throw std::invalid_argument(
      fmt::format("what repeats after {:.9g} rad and after {:.9g} rad of \"{}\" never meets within 1000 periods: there "
                  "is no steady cycle. Make the ratio of the two a fraction, or simulate a long time with kurbel run",
                  periods.front(), periods[common.odd], m.node_label(angle.node)));
}

}  // namespace

class PoincareSection::Maker {
 public:
  Maker(PoincareSection& section, Equations& equations, const SectionOptions& options)
      : section_(section), equations_(equations), m_(equations.model()), options_(options) {
    const auto shafts = row(m_.free_shafts);
    const std::vector<Contact> contacts = contacts_of(m_);
    Rows always(shafts), now(shafts);
    for (const ShaftRelation& relation : m_.relations) always.add(relation.motion), now.add(relation.motion);
    for (std::size_t c = 0; c < contacts.size(); ++c) {
      if (sense_of(contacts[c], section.state_.modes) != 0 || section.state_.modes.regularised[c]) continue;
      now.add(contacts[c].motion);
      if (c < options.sticks_throughout.size() && options.sticks_throughout[c]) always.add(contacts[c].motion);
    }
    if (options.by_angle) {
      const TrackedAngle& link = m_.angles[at(m_.reduction_angle)];
      always.add({{link.shaft, link.gain}});
    }
    section_.directions_.resize(row(equations.state_count()), 0);
    add_angles(motions(always.matrix(), shafts));
    add_speeds(motions(now.matrix(), shafts));
    add_internal_states();
  }

 private:
  class Rows {
   public:
    explicit Rows(Index shafts) : matrix_(0, shafts) {}
    void add(const std::vector<ShaftGain>& motion) {
      Eigen::RowVectorXd r = Eigen::RowVectorXd::Zero(matrix_.cols());
      for (const ShaftGain& g : motion)
        if (g.shaft < matrix_.cols()) r[g.shaft] += g.gain;  // given ones do not vary
      const double length = r.norm();
      if (length == 0) return;
      matrix_.conservativeResize(matrix_.rows() + 1, Eigen::NoChange);
      matrix_.row(matrix_.rows() - 1) = r / length;
    }
    const Eigen::MatrixXd& matrix() const { return matrix_; }

   private:
    Eigen::MatrixXd matrix_;
  };

  void push(Coordinate coordinate, const Eigen::VectorXd& direction) {
    section_.coordinates_.push_back(std::move(coordinate));
    section_.directions_.conservativeResize(Eigen::NoChange, section_.directions_.cols() + 1);
    section_.directions_.col(section_.directions_.cols() - 1) = direction;
  }

  // All tracked angles and twists by the shafts' angles.
  Eigen::MatrixXd angles_and_twists() const {
    Eigen::MatrixXd by_shaft = Eigen::MatrixXd::Zero(row(m_.angles.size() + m_.elastic.size()), row(m_.free_shafts));
    const auto add = [&](std::size_t i, int shaft, double gain) {
      if (at(shaft) < m_.free_shafts) by_shaft(row(i), shaft) += gain;
    };
    for (std::size_t i = 0; i < m_.angles.size(); ++i) add(i, m_.angles[i].shaft, m_.angles[i].gain);
    for (std::size_t k = 0; k < m_.elastic.size(); ++k) {
      add(m_.angles.size() + k, m_.elastic[k].shaft_a, m_.elastic[k].gain_a);
      add(m_.angles.size() + k, m_.elastic[k].shaft_b, -m_.elastic[k].gain_b);
    }
    return by_shaft;
  }

  // What laws read: twists of springs, then angles.
  std::vector<std::pair<std::size_t, Coordinate>> read_rows() const {
    std::vector<std::pair<std::size_t, Coordinate>> read;
    for (std::size_t k = 0; k < m_.elastic.size(); ++k) {
      const ElasticJoint& e = m_.elastic[k];
      if (!e.slips && !e.springless)
        read.push_back({m_.angles.size() + k, {{{equations_.twist_index(static_cast<int>(k)), 1}}, e.twist_scale, 0}});
    }
    for (std::size_t i = 0; i < m_.angles.size(); ++i)
      if (const double period = period_of(m_, i); period > 0) read.push_back({i, {{{i, 1}}, 1, period}});
    return read;
  }

  void add_angles(const Eigen::MatrixXd& allowed) {
    const Eigen::MatrixXd by_motion = product(angles_and_twists(), allowed);
    const auto read = read_rows();
    Eigen::MatrixXd rows(row(read.size()), allowed.cols());
    for (std::size_t i = 0; i < read.size(); ++i) rows.row(row(i)) = by_motion.row(row(read[i].first));
    const std::vector<Index> chosen = independent_rows(rows);
    if (chosen.empty()) return;
    Eigen::MatrixXd picked(row(chosen.size()), rows.cols());
    for (std::size_t i = 0; i < chosen.size(); ++i) picked.row(row(i)) = rows.row(chosen[i]);
    const Eigen::MatrixXd inverse =  // the least motion that moves one of them alone
        transposed_product(
            picked,
            FullLu(product_transposed(picked, picked)).solve(Eigen::MatrixXd::Identity(picked.rows(), picked.rows())));
    const Eigen::MatrixXd moved = product(by_motion, inverse);
    for (std::size_t i = 0; i < chosen.size(); ++i) {
      Coordinate coordinate = read[static_cast<std::size_t>(chosen[i])].second;
      Eigen::VectorXd direction = Eigen::VectorXd::Zero(section_.directions_.rows());
      direction.head(moved.rows()) = moved.col(row(i)) * coordinate.scale;
      push(std::move(coordinate), direction);
    }
  }

  void add_speeds(const Eigen::MatrixXd& allowed) {
    Eigen::MatrixXd rows = allowed;
    const std::vector<Index> chosen = independent_rows(rows);
    if (chosen.empty()) return;
    Eigen::MatrixXd picked(row(chosen.size()), rows.cols());
    for (std::size_t i = 0; i < chosen.size(); ++i) picked.row(row(i)) = rows.row(chosen[i]);
    const Eigen::MatrixXd moved = product(allowed, FullLu(picked).inverse());
    for (std::size_t i = 0; i < chosen.size(); ++i) {
      const auto shaft = static_cast<std::size_t>(chosen[i]);
      const double scale = m_.shafts[shaft].speed_scale;
      Eigen::VectorXd direction = Eigen::VectorXd::Zero(section_.directions_.rows());
      for (std::size_t s = 0; s < m_.free_shafts; ++s)
        direction[row(equations_.speed_index(static_cast<int>(s)))] = moved(row(s), row(i)) * scale;
      push({{{equations_.speed_index(static_cast<int>(shaft)), 1}}, scale, 0}, direction);
    }
  }

  void add_internal_states() {
    const std::vector<int> joint = joints_of_internal_states();
    for (std::size_t k = 0; k < m_.internal_states.size(); ++k) {
      const std::size_t state = equations_.internal_begin() + k;
      if (joint[k] >= 0 && m_.internal_states[k].state.unit == "rad" && drifts_along(joint[k], state)) continue;
      const double scale = m_.internal_states[k].state.scale;
      Eigen::VectorXd direction = Eigen::VectorXd::Zero(section_.directions_.rows());
      direction[row(state)] = scale;
      push({{{state, 1}}, scale, 0}, direction);
    }
  }

  // The elastic joint that brings each internal state; −1: a shaft element. In the order in which they were placed.
  std::vector<int> joints_of_internal_states() const {
    std::vector<int> joint;
    for (std::size_t k = 0; k < m_.elastic.size(); ++k)
      joint.insert(joint.end(), m_.network.joints[at(m_.elastic[k].joint)].element->internal_states.size(),
                   static_cast<int>(k));
    joint.resize(m_.internal_states.size(), -1);
    return joint;
  }

  // Twist and internal state together move nothing: then the twist is read relative to the state.
  bool drifts_along(int elastic, std::size_t state) {
    const std::size_t twist = equations_.twist_index(elastic);
    const double t = section_.state_.t, step = m_.elastic[at(elastic)].twist_scale;
    std::vector<double> y = section_.state_.y;
    y.resize(equations_.size(), 0.0);
    std::vector<double> here(equations_.size()), there(here), apart(here);
    equations_.flow(t, y, here);
    y[twist] += step, y[state] += step;
    equations_.flow(t, y, there);
    y[state] -= step;
    equations_.flow(t, y, apart);
    double together = 0, alone = 0;
    for (std::size_t i = 0; i < equations_.state_count(); ++i) {
      if (!std::isfinite(there[i] - here[i]) || !std::isfinite(apart[i] - here[i])) return false;
      together = std::max(together, std::abs(there[i] - here[i]));
      alone = std::max(alone, std::abs(apart[i] - here[i]));
    }
    if (!(together <= 1e-6 * alone)) return false;
    for (Coordinate& c : section_.coordinates_)
      if (c.terms.size() == 1 && c.terms.front().first == twist) c.terms.push_back({state, -1.0});
    return true;
  }

  PoincareSection& section_;
  Equations& equations_;
  const Model& m_;
  const SectionOptions& options_;
};

PoincareSection::PoincareSection(Equations& equations, State state, const SectionOptions& options)
    : state_(std::move(state)), options_(options), link_(at(equations.model().reduction_angle)) {
  equations.bind(state_.modes);
  Maker(*this, equations, options);
}

void bind_beside(Equations& equations, const State& state, std::span<const double> y) {
  constexpr double fallen = -1e-9;
  equations.bind(state.modes);
  std::vector<double> guards(equations.guard_count());
  equations.guards(state.t, y, guards);
  if (std::any_of(guards.begin(), guards.end(), [](double g) { return g < fallen; })) equations.modes_at(state.t, y);
}

std::vector<double> PoincareSection::place(Equations& equations, const Eigen::VectorXd& z) const {
  std::vector<double> y = state_.y;
  for (Index j = 0; j < z.size(); ++j)
    if (z[j] != 0)
      for (std::size_t i = 0; i < y.size(); ++i) y[i] += directions_(row(i), j) * z[j];
  y.resize(equations.size(), 0.0);
  bind_beside(equations, state_, y);
  return y;
}

Eigen::VectorXd PoincareSection::read(const Modes& modes, std::span<const double> y) const {
  Eigen::VectorXd z(row(size()));
  for (std::size_t j = 0; j < size(); ++j) {
    const Coordinate& c = coordinates_[j];
    double sum = 0;
    for (const auto& [state, weight] : c.terms)
      sum +=
          weight * (c.period > 0 ? angle_with_turns(modes, state, y) - angle_with_turns(state_.modes, state, state_.y)
                                 : y[state] - state_.y[state]);
    if (c.period > 0) sum -= c.period * std::round(sum / c.period);
    z[row(j)] = sum / c.scale;
  }
  return z;
}

double PoincareSection::missed(const Equations& equations, const Eigen::VectorXd& z, std::span<const double> y) const {
  double most = 0;
  for (std::size_t s = 0; s < equations.model().free_shafts; ++s) {
    const std::size_t i = equations.speed_index(static_cast<int>(s));
    const double predicted = z.size() > 0 ? directions_.row(row(i)).dot(z) : 0;
    most = std::max(most, std::abs(y[i] - state_.y[i] - predicted) / equations.model().shafts[s].speed_scale);
  }
  return most;
}

Eigen::MatrixXd PoincareSection::read_directions(const Eigen::MatrixXd& of_y) const {
  Eigen::MatrixXd z = Eigen::MatrixXd::Zero(row(size()), of_y.cols());
  for (std::size_t j = 0; j < size(); ++j)
    for (const auto& [state, weight] : coordinates_[j].terms)
      z.row(row(j)) += weight / coordinates_[j].scale * of_y.row(row(state));
  return z;
}

// dT = −δφ/φ̇.
Eigen::MatrixXd PoincareSection::read_at_end(Eigen::MatrixXd directions, std::span<const double> rate,
                                             Eigen::RowVectorXd& slowing) const {
  slowing = Eigen::RowVectorXd::Zero(directions.cols());
  if (options_.by_angle) {
    slowing = -directions.row(row(link_)) / rate[link_];
    for (Index i = 0; i < directions.rows(); ++i) directions.row(i) += rate[static_cast<std::size_t>(i)] * slowing;
  }
  return read_directions(directions);
}

double PoincareSection::magnitude() const {
  double largest = 0;
  for (const Coordinate& c : coordinates_)
    if (c.period == 0) largest = std::max(largest, std::abs(state_.y[c.terms.front().first]) / c.scale);
  return largest;
}

std::string PoincareSection::name(const Equations& equations, std::size_t coordinate) const {
  return equations.state_name(coordinates_[coordinate].terms.front().first);
}

}  // namespace kurbel
