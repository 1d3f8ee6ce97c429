// step_limits.cpp — from counts by state and guard to elements, ranked.
#include "engine/run/step_limits.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/events/equations.h"
#include "engine/numerics/index.h"

namespace kurbel {
namespace {

// The elements behind states, with the Jacobian evaluated once.
class ErrorShares {
 public:
  ErrorShares(Equations& equations, double t, std::span<const double> y)
      : m_(equations.model()), pattern_(equations.jacobian_pattern()) {
    values_.resize(pattern_.row.size());
    equations.jacobian(t, y.first(equations.size()), values_);
    begin_twists_ = m_.angle_count();
    begin_speeds_ = begin_twists_ + m_.twist_count();
    begin_internal_ = begin_speeds_ + m_.free_shafts;
  }

  std::string of(std::size_t state) {
    if (state >= m_.state_count()) return of_quadrature(state - m_.state_count());
    if (state >= begin_internal_) return m_.internal_states[state - begin_internal_].component;
    if (state >= begin_speeds_) return of_speed(state);
    if (state >= begin_twists_) return joint(state - begin_twists_);
    return of_speed(begin_speeds_ + at(m_.angles[state].shaft));
  }

 private:
  std::string of_quadrature(std::size_t k) const {
    if (k < m_.accounts.size()) return m_.accounts[k].name;
    const std::size_t torque = (k - m_.accounts.size()) / 2;
    if (torque < m_.torque_joints.size()) return m_.torque_joints[torque].component;
    const std::size_t motor = torque - m_.torque_joints.size();
    return motor < m_.motors.size() ? m_.motors[motor].component : std::string();
  }
  std::string joint(std::size_t elastic) const { return m_.network.joints[at(m_.elastic[elastic].joint)].component; }

  // The rate at which the speed answers itself through state j, √|J_ij J_ji|: of a spring its natural frequency; and
  // |J_ii| less what dampers towards other shafts put there.
  std::string of_speed(std::size_t state) {
    const std::size_t shaft = state - begin_speeds_;
    if (shaft >= m_.free_shafts) return m_.node_label(m_.shafts[shaft].reference);
    if (rows_.empty()) sort_by_rows();
    std::string largest = own_label(shaft);
    double most = 0, own = 0, towards_others = 0;
    for (const auto& [column, value] : rows_[state]) {
      const double size = column == state ? std::abs(value) : std::sqrt(std::abs(value * entry(column, state)));
      std::string name;
      if (column == state || column < begin_twists_) {
        own += column == state ? size : 0;
        if (column < begin_twists_) name = own_label(shaft);
      } else if (column < begin_speeds_) {
        name = joint(column - begin_twists_);
      } else if (column < begin_internal_) {
        name = between(shaft, column - begin_speeds_);
        towards_others += size;
      } else {
        name = m_.internal_states[column - begin_internal_].component;
      }
      if (!name.empty() && size > most) most = size, largest = name;
    }
    return own - towards_others > most ? own_label(shaft) : largest;
  }
  // The mechanism on the shaft, or its first node's component.
  std::string own_label(std::size_t shaft) const {
    const Shaft& s = m_.shafts[shaft];
    if (s.variable)
      for (const Network::ShaftElement& e : m_.network.elements)
        if (m_.shaft_of_node[at(e.node)] == static_cast<int>(shaft) && e.element->is.uses_angle) return e.component;
    return m_.network.nodes[at(s.reference)].component;
  }
  std::string between(std::size_t a, std::size_t b) const {
    for (std::size_t j = 0; j < m_.elastic.size(); ++j) {
      const auto x = at(m_.elastic[j].shaft_a), y = at(m_.elastic[j].shaft_b);
      if ((x == a && y == b) || (x == b && y == a)) return joint(j);
    }
    return {};
  }
  double entry(std::size_t row, std::size_t column) const {
    for (const auto& [c, value] : rows_[row])
      if (c == column) return value;
    return 0;
  }
  void sort_by_rows() {
    rows_.resize(pattern_.size);
    for (std::size_t column = 0; column < pattern_.size; ++column)
      for (auto k = pattern_.column_start[column]; k < pattern_.column_start[column + 1]; ++k)
        rows_[static_cast<std::size_t>(pattern_.row[static_cast<std::size_t>(k)])].emplace_back(
            column, values_[static_cast<std::size_t>(k)]);
  }

  const Model& m_;
  const SparsityPattern& pattern_;
  std::vector<double> values_;
  std::vector<std::vector<std::pair<std::size_t, double>>> rows_;
  std::size_t begin_twists_ = 0, begin_speeds_ = 0, begin_internal_ = 0;
};

}  // namespace

void StepLimits::begin(std::size_t states, std::size_t guards) {
  by_accuracy_.resize(std::max(by_accuracy_.size(), states));
  by_stability_.resize(by_accuracy_.size());
  by_guard_.resize(std::max(by_guard_.size(), guards));
}

std::vector<LimitedSteps> StepLimits::ranked(Equations& equations, double t, std::span<const double> y) const {
  std::vector<LimitedSteps> list;
  std::int64_t all = 0;
  const auto add = [&](const std::string& element, const std::string& by, const std::string& state,
                       std::int64_t steps) {
    if (steps == 0) return;
    all += steps;
    auto known = std::find_if(list.begin(), list.end(),
                              [&](const LimitedSteps& l) { return l.element == element && l.by == by; });
    if (known == list.end()) known = list.insert(list.end(), {element, by, {}, 0, 0});
    known->steps += steps;
    if (!state.empty()) known->states.push_back(state);
  };

  // By states, most often first: so the first state of an element is the one that held it most.
  struct OfState {
    std::int64_t steps;
    std::size_t state;
    bool stability;
  };
  std::vector<OfState> states;
  for (std::size_t i = 0; i < by_accuracy_.size(); ++i) {
    if (by_accuracy_[i] > 0) states.push_back({by_accuracy_[i], i, false});
    if (by_stability_[i] > 0) states.push_back({by_stability_[i], i, true});
  }
  std::stable_sort(states.begin(), states.end(), [](const OfState& a, const OfState& b) { return a.steps > b.steps; });
  if (!states.empty()) {
    constexpr std::size_t most_named = 200;  // of a chain of thousands
    ErrorShares blame(equations, t, y);
    for (std::size_t k = 0; k < states.size(); ++k) {
      const bool of_machine = states[k].state < equations.size();
      const bool named = k < most_named && of_machine;
      add(named        ? blame.of(states[k].state)
          : of_machine ? "others"
                       : "sensitivities",
          states[k].stability ? "stability" : "accuracy", named ? equations.state_name(states[k].state) : "",
          states[k].steps);
    }
  }
  for (std::size_t g = 0; g < by_guard_.size(); ++g)
    if (by_guard_[g] > 0)
      add(g < equations.guard_count() ? equations.guard_owner(g) : "", equations.is_knot(g) ? "knots" : "events", "",
          by_guard_[g]);
  add("", "growth after starts", "", growth_);
  add("", "edges in time", "", by_bound_[static_cast<std::size_t>(Bound::edge)]);
  add("", "quarter turns", "", by_bound_[static_cast<std::size_t>(Bound::turn)]);
  add("", "end of the run", "", by_bound_[static_cast<std::size_t>(Bound::until)]);

  for (LimitedSteps& l : list) l.share = static_cast<double>(l.steps) / static_cast<double>(all);
  std::stable_sort(list.begin(), list.end(),
                   [](const LimitedSteps& a, const LimitedSteps& b) { return a.steps > b.steps; });
  return list;
}

std::string element_behind(Equations& equations, std::size_t state, double t, std::span<const double> y) {
  return ErrorShares(equations, t, y).of(state);
}

std::string reported(const std::vector<LimitedSteps>& limits) {
  constexpr std::size_t most_reported = 5;
  std::string text;
  for (std::size_t k = 0; k < limits.size() && k < most_reported; ++k) {
    const LimitedSteps& l = limits[k];
    if (l.share < 0.005 && k > 0) break;
    text += fmt::format("{}{}{:.0f} %", text.empty() ? "" : ", ",
                        l.element.empty()                     ? l.by + " "
                        : l.by == "events" || l.by == "knots" ? fmt::format("{} of \"{}\" ", l.by, l.element)
                                                              : fmt::format("\"{}\" ", l.element),
                        100 * l.share);
    if (!l.states.empty())
      text += fmt::format(" ({}{}{})", l.by == "stability" ? "stability; " : "", l.states[0],
                          l.states.size() > 1 ? ", …" : "");
  }
  return text;
}

}  // namespace kurbel
