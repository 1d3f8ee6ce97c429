// duty_recorder.cpp — the square of motor torques over time.
#include "studies/limits/duty_recorder.h"

#include <array>
#include <cmath>
#include <utility>

namespace kurbel {

void DutyRecorder::begin(double /*t*/, std::span<const double> /*y*/, Equations& equations) {
  const auto& elements = equations.model().network.elements;
  for (Motor& m : motors_) {
    m.elements.clear();
    for (std::size_t e = 0; e < elements.size(); ++e)
      if (elements[e].component == m.component && elements[e].element->account == Account::driving)
        m.elements.push_back(e);
  }
}

void DutyRecorder::step(StepView& view) {
  const double root = std::sqrt(0.6);
  const std::array<std::pair<double, double>, 3> gauss = {{{-root, 5.0 / 18}, {0, 8.0 / 18}, {root, 5.0 / 18}}};
  const double middle = 0.5 * (view.t_previous() + view.t()), length = view.t() - view.t_previous();
  for (const auto& [place, weight] : gauss) {
    const Snapshot& s = view.snapshot(middle + 0.5 * length * place);
    for (Motor& m : motors_) {
      double torque = 0;
      for (const std::size_t e : m.elements) torque += s.sums.element_torque[e];
      m.square += weight * length * torque * torque;
    }
  }
}

}  // namespace kurbel
