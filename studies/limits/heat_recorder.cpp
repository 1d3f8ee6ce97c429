// heat_recorder.cpp — heat by engagements, from the works that the run integrates anyway.
#include "studies/limits/heat_recorder.h"

namespace kurbel {
namespace {

double heat_of(const HeatRecorder::Heated& h, std::span<const double> y, const Equations& equations) {
  double heat = 0;
  for (const std::size_t k : h.accounts) heat -= y[equations.work_index(k)];
  return heat;
}

}  // namespace

HeatRecorder::HeatRecorder(const std::vector<std::string>& components) {
  for (const std::string& component : components) heated_.push_back({.component = component});
}

void HeatRecorder::begin(double /*t*/, std::span<const double> y, Equations& equations) {
  const auto& accounts = equations.model().accounts;
  for (Heated& h : heated_) {
    h.accounts.clear();
    for (std::size_t k = 0; k < accounts.size() && equations.audit(); ++k)
      if (accounts[k].name == h.component && accounts[k].kind == Account::harmful) h.accounts.push_back(k);
    h.before = heat_of(h, y, equations);
  }
}

void HeatRecorder::step(StepView& view) {
  // Below this fraction of the heat so far a step generates none: rounding of the quadrature.
  constexpr double nothing = 1e-13;
  for (Heated& h : heated_) {
    const double now = heat_of(h, view.y(), view.equations()), made = now - h.before;
    h.before = now;
    if (made > nothing * h.total) {
      h.slips += view.t() - view.t_previous();
      h.total += made;
      h.engagement += made;
      if (h.engagement > h.largest) h.largest = h.engagement, h.hottest_at = view.t();
    } else if (!(view.t() - view.t_previous() < 1e-9 * view.t())) {  // not a step so short that it could make none
      h.engagement = 0;
    }
  }
}

}  // namespace kurbel
