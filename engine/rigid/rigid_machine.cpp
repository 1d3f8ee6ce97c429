// rigid_machine.cpp — evaluates the rigid machine at angles and speeds, and finds the edges of its torques' laws.
#include "engine/rigid/rigid_machine.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <stdexcept>

#include "engine/numerics/angles.h"
#include "engine/numerics/deadline.h"
#include "engine/numerics/index.h"
#include "engine/numerics/period.h"
#include "engine/numerics/roots.h"

namespace kurbel {
namespace {

constexpr double ahead = 1e-11;        // rad: an edge so near ahead counts as here
constexpr double farthest = 1e-5;      // rad: look-ahead if rounding hides the next piece
constexpr int cells_a_turn = 720;      // of the search for edges
constexpr double below_zero = -1e-11;  // of a guard of order one: a touch within the tables' error is no edge

std::shared_ptr<const Model> checked(std::shared_ptr<const Model> model, bool has_range) {
  if (!model->elastic.empty())
    throw std::invalid_argument(fmt::format(
        "the machine is elastic (effects: {}); one angle and its speed describe it only with elasticity off",
        model->effects.describe()));
  if (!model->relations.empty())
    throw std::invalid_argument(fmt::format(
        "\"{}\" ties shafts only while the machine runs, so one angle does not describe it; simulate it with "
        "kurbel run, or hold a shaft of a planetary gear (fixed)",
        model->network.relations.front().component));
  if (model->free_shafts != 1)
    throw std::invalid_argument(
        "the rigid machine has no free coordinate: a prescribed speed fixes its motion; replace it by a motor");
  if (!model->internal_states.empty())
    throw std::invalid_argument(fmt::format(
        "the {} of \"{}\" is a state besides angle and speed, which this question does not include; replace \"{}\" "
        "by a motor or a load, or switch its effect off",
        model->internal_states.front().state.name, model->internal_states.front().component,
        model->internal_states.front().component));
  for (const Network::ShaftElement& e : model->network.elements)
    if (std::isinf(e.element->cycle) && !has_range)
      throw std::invalid_argument(
          fmt::format("the crank of \"{}\" rocks and never turns fully, so that there is no cycle over its angle; "
                      "follow its motion with kurbel run",
                      e.component));
  return model;
}

// Where f is smallest within [a, b], to a part in 10⁸ of the interval, or where it is negative.
double lowest(const std::function<double(double)>& f, double a, double b) {
  return find_maximum([&](double x) { return -f(x); }, a, b, 40, -below_zero).at;
}

}  // namespace

Effects rigid_effects() {
  Effects effects;
  effects.locked = true;
  return effects;
}

RigidMachine::RigidMachine(const Scene& scene) : RigidMachine(compile(scene, rigid_effects())) {}

RigidMachine::RigidMachine(std::shared_ptr<const Model> model) : RigidMachine(std::move(model), std::nullopt) {}

RigidMachine::RigidMachine(std::shared_ptr<const Model> model, const std::optional<AngleRange>& range)
    : model_(checked(std::move(model), range.has_value())),
      equations_(model_, false),
      has_range_(range.has_value()),
      share_(model_->accounts.size()) {
  for (const Network::ShaftElement& e : model_->network.elements)
    if (e.element->cycle > 0) mechanisms_.push_back({e.element.get(), model_->node_ratio[kurbel::at(e.node)], e.phase});
  const CyclePeriod cycle = cycle_of(*model_);
  cycle_ = cycle.angle;
  periodic_ = cycle.periodic && !range;
  if (range) begin_ = range->from, cycle_ = range->to - range->from;
  const double somewhere = range ? begin_ + 0.5 * cycle_ : 0;
  set_modes(somewhere, 1);
  // Both computations of the inertia must agree, to detect a mechanism without inertia_at. At the same angle: for a heavy
  // slider on a light crank the inertia at 0 is a thousandth of that at the angle of the modes.
  fill_state(somewhere, 1);
  const double whole = equations_.shaft_balance(0, 0, state_).inertia;
  if (std::abs(constant_inertia() + mechanism_inertia(somewhere).value - whole) > 1e-9 * whole)
    throw std::logic_error("a mechanism states another reduced inertia than its equations");
}

bool RigidMachine::uses_time() const {
  const auto& elements = model_->network.elements;
  return std::any_of(elements.begin(), elements.end(), [](const Network::ShaftElement& e) {
    return e.element->uses_time || e.window.start > Window{}.start || e.window.stop < Window{}.stop;
  });
}

bool RigidMachine::uses_speed() const {
  const auto& elements = model_->network.elements;
  return std::any_of(elements.begin(), elements.end(),
                     [](const Network::ShaftElement& e) { return e.element->uses_speed; });
}

bool RigidMachine::edges_are_of_angle() const {
  return std::all_of(model_->pools.begin(), model_->pools.end(),
                     [](const auto& pool) { return pool->guards_are_of_angle(); });
}

double RigidMachine::constant_inertia() const { return model_->shafts[0].inertia; }

// I = Σ i² I_own(i φ + ψ),  I′ = Σ i³ I′_own with i = ω_own/ω
RigidMachine::Inertia RigidMachine::mechanism_inertia(double phi) const {
  Inertia sum;
  for (const auto& [element, ratio, phase] : mechanisms_) {
    const auto own = element->inertia_at(ratio * phi + phase);
    sum.value += ratio * ratio * own.value;
    sum.slope += ratio * ratio * ratio * own.slope;
  }
  return sum;
}

void RigidMachine::fill_state(double phi, double omega) {
  const Model& m = *model_;
  for (std::size_t i = 0; i < m.angles.size(); ++i) state_[i] = m.angles[i].gain * phi;
  state_[equations_.speed_index(0)] = omega;
}

void RigidMachine::set_modes(double phi, double omega) { look_ahead(phi, omega, ahead); }

void RigidMachine::look_ahead(double phi, double omega, double distance) {
  const double further = std::copysign(distance * std::max(1.0, std::abs(phi)), omega);
  state_ = equations_.modes_from_scratch(0, phi + further, omega);
}

// M = Σ torques of the equations, which hold −½ I_r′ ω² for the mechanisms.
RigidMachine::At RigidMachine::at(double phi, double omega, bool shares) {
  fill_state(phi, omega);
  const auto [torque, inertia] = equations_.shaft_balance(0, 0, state_, shares ? share_.data() : nullptr);
  At result{inertia, mechanism_inertia(phi).slope, 0, {}};
  result.torque = torque + 0.5 * result.slope * omega * omega;
  if (shares) {
    for (double& share : share_) share /= omega;
    result.share = share_;
  }
  return result;
}

const Snapshot& RigidMachine::snapshot(double phi, double omega) {
  set_modes(phi, omega);
  fill_state(phi, omega);
  return equations_.snapshot(0, state_);
}

// Follows a cycle with valid modes; a guard that falls below zero marks an edge, even if it rises again within the same
// cell. s increases in the direction of motion.
class RigidMachine::EdgeSearch {
 public:
  EdgeSearch(RigidMachine& machine, int direction)
      : machine_(machine), sign_(direction >= 0 ? 1 : -1), guard_(machine.equations_.guard_count()) {
    std::size_t next = 0;
    for (const auto& pool : machine.model().pools) {
      const auto count = static_cast<std::size_t>(pool->guard_count());
      if (pool->guards_are_of_angle())
        for (std::size_t i = 0; i < count; ++i) watched_.push_back(next + i);
      next += count;
    }
  }

  std::vector<double> run() {
    if (!watched_.empty()) visit_one_period();
    std::sort(found_.begin(), found_.end());
    const auto same = [](double a, double b) { return b - a < 1e-12; };
    found_.erase(std::unique(found_.begin(), found_.end(), same), found_.end());
    return std::move(found_);
  }

 private:
  static constexpr double nowhere = HUGE_VAL;
  // Where the first guard falls through zero, and its value at the begin of the stretch.
  struct Fall {
    double s = nowhere, value_at_begin = 1;
  };

  void visit_one_period() {
    // Starts off whole degrees, where edges often lie.
    const double cell = turn / cells_a_turn, range = sign_ > 0 ? machine_.begin_ : -machine_.begin_ - machine_.cycle_,
                 begin = machine_.has_range_ ? range : -0.37 * cell, end = begin + machine_.cycle_;
    machine_.set_modes(sign_ * begin, sign_);
    double here = begin, looked = ahead;
    while (here < end) {
      Deadline::check();
      // One grid for the whole cycle, so that cells avoid whole degrees also after an edge.
      const double to = std::min(begin + cell * (std::floor((here - begin) / cell + 1e-6) + 1), end);
      const Fall fall = first_fall(here, to);
      if (fall.s == nowhere) {
        here = to;
        looked = ahead;
        continue;
      }
      // Above zero only by rounding: at a dead centre the slider's position determines the piece only further
      // ahead.
      if (fall.value_at_begin < -below_zero && looked < farthest) {
        looked *= 10;
        machine_.look_ahead(sign_ * here, sign_, looked);
        continue;
      }
      looked = ahead;
      const double edge = std::max(fall.s, here);
      note(edge);
      machine_.set_modes(sign_ * edge, sign_);
      here = std::max(edge, std::nextafter(here, end));
      // Past the edge by what counts as here, so that its own guard is found above zero.
      here += 2 * ahead * std::max(1.0, std::abs(here));
    }
  }

  Fall first_fall(double begin, double end) {
    const double middle = 0.5 * (begin + end);
    const std::vector<double> at_begin = guards_at(begin), at_middle = guards_at(middle), at_end = guards_at(end);
    Fall first;
    for (const std::size_t i : watched_) {
      const double lesser = std::min(at_begin[i], at_end[i]), greater = std::max(at_begin[i], at_end[i]);
      double below = nowhere;  // where the guard is negative, first guess
      if (at_middle[i] < below_zero) {
        below = middle;
      } else if (at_end[i] < below_zero) {
        below = end;
      } else if (at_middle[i] < 1 && (at_middle[i] <= lesser || lesser < 0.1 * greater)) {
        const double low = lowest(guard(i), begin, end);
        if (guards_at(low)[i] < below_zero) below = low;
      }
      if (below == nowhere) continue;
      const double root = at_begin[i] > 0 ? find_root(guard(i), begin, at_begin[i], below, guards_at(below)[i]) : begin;
      if (root < first.s) first = {root, at_begin[i]};
    }
    return first;
  }

  void note(double s) {
    const double phi = sign_ * s, cycle = machine_.cycle_;
    if (machine_.has_range_) return found_.push_back(phi);
    const double angle = machine_.periodic_ ? place_within(phi, cycle) : phi;
    found_.push_back(cycle - angle < 1e-13 ? 0 : angle);
  }

  const std::vector<double>& guards_at(double s) {
    machine_.fill_state(sign_ * s, sign_);
    machine_.equations_.guards(0, machine_.state_, guard_);
    return guard_;
  }
  std::function<double(double)> guard(std::size_t i) {
    return [this, i](double s) { return guards_at(s)[i]; };
  }

  RigidMachine& machine_;
  double sign_;
  std::vector<std::size_t> watched_;  // guards that change at angles
  std::vector<double> guard_, found_;
};

std::vector<double> RigidMachine::edges(int direction) { return EdgeSearch(*this, direction).run(); }

}  // namespace kurbel
