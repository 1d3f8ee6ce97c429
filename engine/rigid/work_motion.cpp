// work_motion.cpp — motion over the work diagram: time by quadrature from panel to panel, to rest and from it.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "engine/base/gauss.h"
#include "engine/base/legendre.h"
#include "engine/numerics/deadline.h"
#include "engine/numerics/period.h"
#include "engine/numerics/roots.h"
#include "engine/rigid/work_equation.h"

namespace kurbel {
namespace {

using legendre::integral, legendre::sum, legendre::terms;

constexpr double mildest = 4;  // T may vary by this factor: 16 nodes then give 1/√T to 5e-16
constexpr int deepest = 60;    // bisections of a panel towards a place of rest

}  // namespace

double WorkOverAngle::Stretch::s(double u) const {
  const double v = 0.5 * (1 + u), w = 0.5 * (1 - u);
  if (rest == Rest::at_begin) return begin + (end - begin) * v * v;
  if (rest == Rest::at_end) return end - (end - begin) * w * w;
  return begin + (end - begin) * v;
}

double WorkOverAngle::Stretch::ds_du(double u) const {
  if (rest == Rest::at_begin) return 0.5 * (end - begin) * (1 + u);
  if (rest == Rest::at_end) return 0.5 * (end - begin) * (1 - u);
  return 0.5 * (end - begin);
}

// Walks through the panels with a constant E = T − W, adding up time until it is over or the machine at rest.
class WorkOverAngle::Traversal {
 public:
  Traversal(const WorkOverAngle& diagram, double s, double speed, double until) : diagram_(diagram), until_(until) {
    motion_.s = place_within(s, diagram.cycle_);
    motion_.cycles = static_cast<std::int64_t>(std::round((s - motion_.s) / diagram.cycle_));
    motion_.speed = speed;
    const Panel& panel = diagram.panel_at(motion_.s);
    energy_ = 0.5 * diagram.inertia_in(panel, motion_.s) * speed * speed - diagram.work_in(panel, motion_.s);
    from_rest_ = speed == 0;
  }

  Motion run() {
    if (until_ <= 0) return motion_;
    // The rest of the first cycle, whole cycles, and the last one.
    bool first = true;
    while (!over_) {
      Deadline::check();
      if (motion_.s == 0 && !from_rest_) skip_cycles();
      auto k = static_cast<std::size_t>(&diagram_.panel_at(motion_.s) - diagram_.panel_.data());
      for (; k < diagram_.panel_.size() && !over_; ++k) cross_panel(diagram_.panel_[k], first);
      if (over_) break;
      motion_.s = 0;
      ++motion_.cycles;
      energy_ += diagram_.per_cycle_;
    }
    return motion_;
  }

 private:
  // All cycles take the same time where a cycle does no work.
  void skip_cycles() {
    if (diagram_.per_cycle_ != 0 || skipped_) return;
    skipped_ = true;
    double period = 0;
    for (const Panel& panel : diagram_.panel_) {
      double time = 0;
      if (!whole_panel(panel, time)) return;  // too near to rest for the plain rule
      period += time;
    }
    const double count = std::floor((until_ - motion_.t) / period);
    if (!(count >= 1)) return;
    motion_.cycles += static_cast<std::int64_t>(count);
    until_ = std::fma(-count, period, until_);
    skipped_time_ = count * period;
  }

  // ∫dt over a panel from the values at its nodes; false where T varies too much for them.
  bool whole_panel(const Panel& panel, double& time) const {
    double least = HUGE_VAL, most = 0, total = 0;
    for (std::size_t i = 0; i < nodes; ++i) {
      const double twice = 2 * (energy_ + panel.work[i]);
      least = std::min(least, twice);
      most = std::max(most, twice);
      total += gauss<nodes>.w[i] * std::sqrt(panel.inertia[i] / twice);
    }
    if (!(least > 0) || most > mildest * least) return false;
    const double last = 2 * (energy_ + panel.work_begin + panel.half * integral(panel.torque_term, 1));
    if (!(mildest * last > most)) return false;
    time = panel.half * total;
    return true;
  }

  void cross_panel(const Panel& panel, bool& first) {
    const double end = panel.begin + 2 * panel.half;
    double time = 0;
    if (!first && whole_panel(panel, time) && motion_.t + time < until_) {
      motion_.t += time;
      motion_.s = end;
      return;
    }
    const double begin = first ? motion_.s : panel.begin;
    first = false;
    if (end - begin <= 0) return;
    double from = begin;
    if (from_rest_) from = leave_rest(panel, begin, end);
    if (!over_ && from < end) cross_stretch(panel, {Stretch::Rest::none, from, end}, 0);
  }

  // From rest T = ∫M ds: as far as the torque drives all along, at most the whole panel.
  double leave_rest(const Panel& panel, double begin, double end) {
    from_rest_ = false;
    Stretch stretch{Stretch::Rest::at_begin, begin, end};
    for (int i = 0; i < deepest; ++i) {
      if (all_moving(panel, stretch)) {
        cross(panel, stretch);
        return stretch.end;
      }
      stretch.end = begin + 0.25 * (stretch.end - begin);
    }
    stop_at(begin);
    return begin;
  }

  double kinetic(const Panel& panel, double s) const { return energy_ + diagram_.work_in(panel, s); }

  bool all_moving(const Panel& panel, const Stretch& stretch) const {
    for (const double u : gauss<nodes>.x)
      if (!(kinetic(panel, stretch.s(u)) > 0)) return false;
    return kinetic(panel, stretch.end) > 0;
  }

  // Bisects until T is mild or its zero is bracketed.
  void cross_stretch(const Panel& panel, const Stretch& stretch, int depth) {
    double before = stretch.begin, least = HUGE_VAL, most = 0, stop = HUGE_VAL;
    const auto see = [&](double s) {
      const double t = kinetic(panel, s);
      if (!(t > 0) && stop == HUGE_VAL) stop = s;
      if (stop == HUGE_VAL) before = s;
      least = std::min(least, t);
      most = std::max(most, t);
    };
    for (const double u : gauss<nodes>.x) see(stretch.s(u));
    see(stretch.end);
    if (stop == HUGE_VAL && (most <= mildest * least || depth >= deepest)) {
      cross(panel, stretch);
      return;
    }
    if (stop < HUGE_VAL && (depth >= 3 || stretch.end - stretch.begin < narrow)) {
      approach_rest(panel, stretch.begin, before, stop);
      return;
    }
    const double middle = 0.5 * (stretch.begin + stretch.end);
    cross_stretch(panel, {Stretch::Rest::none, stretch.begin, middle}, depth + 1);
    if (!over_) cross_stretch(panel, {Stretch::Rest::none, middle, stretch.end}, depth + 1);
  }

  // T falls to zero between `moving` and `beyond`.
  void approach_rest(const Panel& panel, double begin, double moving, double beyond) {
    const auto energy = [&](double s) { return kinetic(panel, s); };
    const double t0 = energy(moving), t1 = energy(beyond);
    const double stop = t0 > 0 && t1 < 0 ? find_root(energy, moving, t0, beyond, t1) : (t0 > 0 ? beyond : moving);
    if (stop > begin) cross(panel, {Stretch::Rest::at_end, begin, stop});
    if (!over_) stop_at(stop);
  }

  void stop_at(double s) {
    motion_.s = s;
    motion_.speed = 0;
    motion_.stalled = over_ = true;
    motion_.t += skipped_time_;
  }

  // Time over a stretch; ends within it where the time is over.
  void cross(const Panel& panel, const Stretch& stretch) {
    Values rate;  // dt/du
    double time = 0;
    for (std::size_t i = 0; i < nodes; ++i) {
      const double u = gauss<nodes>.x[i], s = stretch.s(u);
      const double twice = 2 * std::max(kinetic(panel, s), 1e-300);
      rate[i] = stretch.ds_du(u) * std::sqrt(diagram_.inertia_in(panel, s) / twice);
      time += gauss<nodes>.w[i] * rate[i];
    }
    if (motion_.t + time < until_) {
      motion_.t += time;
      motion_.s = stretch.end;
      return;
    }
    const double u = invert(terms(rate), until_ - motion_.t, time);
    motion_.s = stretch.s(u);
    motion_.speed = std::sqrt(2 * std::max(kinetic(panel, motion_.s), 0.0) / diagram_.inertia_in(panel, motion_.s));
    motion_.t = until_ + skipped_time_;
    over_ = true;
  }

  // u with ∫ from −1 to u = wanted, by Newton's method within [−1, 1]; the integrand is positive.
  static double invert(const Values& terms, double wanted, double whole) {
    double low = -1, high = 1, u = whole > 0 ? 2 * wanted / whole - 1 : 1;
    for (int i = 0; i < 60; ++i) {
      const double error = integral(terms, u) - wanted;
      (error > 0 ? high : low) = u;
      double better = u - error / sum(terms, u);
      if (!(better >= low && better <= high)) better = 0.5 * (low + high);
      if (std::abs(better - u) <= 2e-16 || better == u) return better;
      u = better;
    }
    return u;
  }

  const WorkOverAngle& diagram_;
  double until_, energy_ = 0, skipped_time_ = 0;
  bool from_rest_ = false, over_ = false, skipped_ = false;
  Motion motion_;
};

WorkOverAngle::Motion WorkOverAngle::advance(double s0, double speed, double until) const {
  if (!(std::isfinite(s0) && std::isfinite(speed) && speed >= 0 && std::isfinite(until)))
    throw std::invalid_argument(
        fmt::format("work diagram: start at s = {} rad with {} rad/s until {} s; must be numbers, the speed ≥ 0", s0,
                    speed, until));
  return Traversal(*this, s0, speed, until).run();
}

}  // namespace kurbel
