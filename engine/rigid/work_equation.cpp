// work_equation.cpp — panels of work and inertia over one cycle, and the motion that follows from them.
#include "engine/rigid/work_equation.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "engine/numerics/deadline.h"
#include "engine/numerics/period.h"
#include "engine/numerics/roots.h"

namespace kurbel {
namespace {

constexpr std::size_t n = 16;
using Row = std::array<double, n>;

// P₀ … P_n at x: (k + 1) P_{k+1} = (2k + 1) x P_k − k P_{k−1}
struct Recursion {
  Row by_x{}, back{};
  constexpr Recursion() {
    for (std::size_t k = 1; k < n; ++k) {
      const auto d = static_cast<double>(k);
      by_x[k] = (2 * d + 1) / (d + 1);
      back[k] = d / (d + 1);
    }
  }
};
constexpr Recursion recursion;

std::array<double, n + 1> legendre(double x) {
  std::array<double, n + 1> p{1, x};
  for (std::size_t k = 1; k < n; ++k) p[k + 1] = recursion.by_x[k] * x * p[k] - recursion.back[k] * p[k - 1];
  return p;
}

// Nodes and weights of Gauss and Legendre, and the matrix from values at the nodes to Legendre coefficients.
struct Gauss {
  Row x, w;
  std::array<Row, n> to_terms;  // row k gives coefficient k

  Gauss() {
    for (std::size_t i = 0; i < n; ++i) {
      double z = -std::cos(std::numbers::pi * (static_cast<double>(i) + 0.75) / (n + 0.5)), slope = 1;
      for (int round = 0; round < 8; ++round) {
        const auto p = legendre(z);
        slope = n * (z * p[n] - p[n - 1]) / (z * z - 1);
        z -= p[n] / slope;
      }
      x[i] = z;
      w[i] = 2 / ((1 - z * z) * slope * slope);
      const auto p = legendre(z);
      for (std::size_t k = 0; k < n; ++k) to_terms[k][i] = (static_cast<double>(k) + 0.5) * w[i] * p[k];
    }
  }
  Row terms(const Row& values) const {
    Row c{};
    for (std::size_t k = 0; k < n; ++k)
      for (std::size_t i = 0; i < n; ++i) c[k] += to_terms[k][i] * values[i];
    return c;
  }
};
const Gauss& gauss() {
  static const Gauss table;
  return table;
}

constexpr Row inverse_odd = [] {
  Row r{};
  for (std::size_t k = 0; k < n; ++k) r[k] = 1 / (2 * static_cast<double>(k) + 1);
  return r;
}();

double sum(const Row& terms, double x) {
  const auto p = legendre(x);
  double value = 0;
  for (std::size_t k = 0; k < n; ++k) value += terms[k] * p[k];
  return value;
}

// ∫ from −1 to x:  ∫P_k = (P_{k+1} − P_{k−1})/(2k + 1)
double integral(const Row& terms, double x) {
  const auto p = legendre(x);
  double value = terms[0] * (x + 1);
  for (std::size_t k = 1; k < n; ++k) value += terms[k] * inverse_odd[k] * (p[k + 1] - p[k - 1]);
  return value;
}

double largest(const Row& values) {
  double most = 0;
  for (const double v : values) most = std::max(most, std::abs(v));
  return most;
}

constexpr double tail_allowed = 3e-13;   // of the largest value, for the last two coefficients
constexpr double closes_within = 1e-12;  // work per cycle over turnover
// Near a change point I_r turns within √(2 (l − r)/r) of an angle: 4.5e-4 rad where the rod is a 10⁻⁷ longer than the
// crank. Panels are halved until they resolve that; in narrow ones what remains may be the tables' rounding.
constexpr double narrow = std::numbers::pi / 512;         // panel [rad]
constexpr double tail_of_narrow = 1e-11;                  // of the largest value: within 10⁻¹⁴ of a turn's work
constexpr double narrowest = std::numbers::pi * 0x1p-22;  // [rad]: a corner that is no edge of the machine
constexpr std::size_t many_panels = 8192;  // beyond so many none is halved below `narrow`: what is left is rounding
constexpr double rounding_torque = 1e-9;   // of the machine's scale: a machine without torques has nothing to resolve
constexpr double mildest = 4;              // T may vary by this factor: 16 nodes then give 1/√T to 5e-16
constexpr int deepest = 60;                // bisections of a panel towards a place of rest

}  // namespace

// ---------------------------------------------------------------------------------------------------------------------
// Panels

WorkOverAngle::WorkOverAngle(RigidMachine& machine, const std::vector<double>& edges, int direction)
    : direction_(direction >= 0 ? 1 : -1), cycle_(machine.cycle()) {
  std::vector<double> end = edges;
  for (double& e : end)
    if (direction_ < 0) e = e > 0 ? cycle_ - e : 0;
  std::sort(end.begin(), end.end());
  end.push_back(cycle_);
  double largest_torque = rounding_torque * machine.model().torque_scale;
  for (int i = 0; i < 360; ++i) {
    const double phi = direction_ * cycle_ * (i + 0.5) / 360;
    machine.set_modes(phi, direction_);
    largest_torque = std::max(largest_torque, std::abs(machine.at(phi, direction_).torque));
  }
  double begin = 0;
  for (const double e : end) {
    if (e - begin < 1e-11) continue;
    const int parts = static_cast<int>(std::ceil((e - begin) / (0.5 * std::numbers::pi) - 1e-9));
    for (int i = 0; i < parts; ++i)
      add_panels(machine, begin + (e - begin) * i / parts, begin + (e - begin) * (i + 1) / parts, largest_torque);
    begin = e;
  }
  close_cycle();
}

// One panel where 16 nodes resolve I_r and M, else two halves.
void WorkOverAngle::add_panels(RigidMachine& machine, double begin, double end, double largest_torque) {
  Deadline::check();
  Panel panel;
  panel.begin = begin;
  panel.half = 0.5 * (end - begin);
  Values torque{};
  machine.set_modes(direction_ * (begin + panel.half), direction_);
  for (std::size_t i = 0; i < nodes; ++i) {
    const RigidMachine::At at =
        machine.at(direction_ * (begin + panel.half * (1 + gauss().x[i])), static_cast<double>(direction_));
    panel.inertia[i] = at.inertia;
    torque[i] = direction_ * at.torque;
  }
  panel.inertia_term = gauss().terms(panel.inertia);
  panel.torque_term = gauss().terms(torque);
  const auto tail = [](const Values& c) { return std::abs(c[nodes - 1]) + std::abs(c[nodes - 2]); };
  const double allowed = end - begin > narrow ? tail_allowed : tail_of_narrow;
  const bool resolved = tail(panel.inertia_term) <= allowed * largest(panel.inertia) &&
                        tail(panel.torque_term) <= allowed * std::max(largest_torque, largest(torque));
  if (!resolved && end - begin > (panel_.size() < many_panels ? narrowest : narrow)) {
    add_panels(machine, begin, begin + panel.half, largest_torque);
    add_panels(machine, begin + panel.half, end, largest_torque);
    return;
  }
  panel.work_begin = per_cycle_;
  for (std::size_t i = 0; i < nodes; ++i) {
    panel.work[i] = panel.work_begin + panel.half * integral(panel.torque_term, gauss().x[i]);
    turnover_ += panel.half * gauss().w[i] * std::abs(torque[i]);
  }
  per_cycle_ = panel.work_begin + panel.half * integral(panel.torque_term, 1);
  panel_.push_back(panel);
}

// What the tables' rounding leaves of a cycle without work is spread over the cycle and taken away.
void WorkOverAngle::close_cycle() {
  if (std::abs(per_cycle_) > closes_within * turnover_) return;
  const double excess = per_cycle_ / cycle_;
  for (Panel& panel : panel_) {
    panel.torque_term[0] -= excess;
    panel.work_begin -= excess * panel.begin;
    for (std::size_t i = 0; i < nodes; ++i) panel.work[i] -= excess * (panel.begin + panel.half * (1 + gauss().x[i]));
  }
  per_cycle_ = 0;
}

const WorkOverAngle::Panel& WorkOverAngle::panel_at(double s) const {
  const auto after =
      std::upper_bound(panel_.begin(), panel_.end(), s, [](double x, const Panel& p) { return x < p.begin; });
  return after == panel_.begin() ? panel_.front() : *(after - 1);
}

double WorkOverAngle::work_in(const Panel& panel, double s) const {
  return panel.work_begin + panel.half * integral(panel.torque_term, (s - panel.begin) / panel.half - 1);
}

double WorkOverAngle::inertia_in(const Panel& panel, double s) const {
  return sum(panel.inertia_term, (s - panel.begin) / panel.half - 1);
}

double WorkOverAngle::work(double s) const {
  const double rest = place_within(s, cycle_), cycles = std::round((s - rest) / cycle_);
  return cycles * per_cycle_ + work_in(panel_at(rest), rest);
}

double WorkOverAngle::inertia(double s) const {
  const double rest = place_within(s, cycle_);
  return inertia_in(panel_at(rest), rest);
}

// ---------------------------------------------------------------------------------------------------------------------
// Motion

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
class WorkOverAngle::Walk {
 public:
  Walk(const WorkOverAngle& diagram, double s, double speed, double until) : diagram_(diagram), until_(until) {
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
      for (; k < diagram_.panel_.size() && !over_; ++k) walk_panel(diagram_.panel_[k], first);
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
      total += gauss().w[i] * std::sqrt(panel.inertia[i] / twice);
    }
    if (!(least > 0) || most > mildest * least) return false;
    const double last = 2 * (energy_ + panel.work_begin + panel.half * integral(panel.torque_term, 1));
    if (!(mildest * last > most)) return false;
    time = panel.half * total;
    return true;
  }

  void walk_panel(const Panel& panel, bool& first) {
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
    if (!over_ && from < end) walk_stretch(panel, {Stretch::Rest::none, from, end}, 0);
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
    for (const double u : gauss().x)
      if (!(kinetic(panel, stretch.s(u)) > 0)) return false;
    return kinetic(panel, stretch.end) > 0;
  }

  // Bisects until T is mild or its zero is bracketed.
  void walk_stretch(const Panel& panel, const Stretch& stretch, int depth) {
    double before = stretch.begin, least = HUGE_VAL, most = 0, stop = HUGE_VAL;
    const auto see = [&](double s) {
      const double t = kinetic(panel, s);
      if (!(t > 0) && stop == HUGE_VAL) stop = s;
      if (stop == HUGE_VAL) before = s;
      least = std::min(least, t);
      most = std::max(most, t);
    };
    for (const double u : gauss().x) see(stretch.s(u));
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
    walk_stretch(panel, {Stretch::Rest::none, stretch.begin, middle}, depth + 1);
    if (!over_) walk_stretch(panel, {Stretch::Rest::none, middle, stretch.end}, depth + 1);
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
      const double u = gauss().x[i], s = stretch.s(u);
      const double twice = 2 * std::max(kinetic(panel, s), 1e-300);
      rate[i] = stretch.ds_du(u) * std::sqrt(diagram_.inertia_in(panel, s) / twice);
      time += gauss().w[i] * rate[i];
    }
    if (motion_.t + time < until_) {
      motion_.t += time;
      motion_.s = stretch.end;
      return;
    }
    const double u = invert(gauss().terms(rate), until_ - motion_.t, time);
    motion_.s = stretch.s(u);
    motion_.speed = std::sqrt(2 * std::max(kinetic(panel, motion_.s), 0.0) / diagram_.inertia_in(panel, motion_.s));
    motion_.t = until_ + skipped_time_;
    over_ = true;
  }

  // u with ∫ from −1 to u = wanted, by Newton's method within [−1, 1]; the integrand is positive.
  static double invert(const Row& terms, double wanted, double whole) {
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
  return Walk(*this, s0, speed, until).run();
}

// ---------------------------------------------------------------------------------------------------------------------
// Tables of a model

std::string WorkTables::refusal(const std::shared_ptr<const Model>& model) {
  if (!model->elastic.empty())
    return fmt::format(
        "the machine is elastic ({} coordinates; effects: {}), and the work equation is that of one angle; "
        "switch the elasticity off or choose another method",
        model->free_shafts + model->twist_count(), model->effects.describe());
  if (!model->relations.empty())
    return fmt::format("\"{}\" ties shafts only while the machine runs; choose another method",
                       model->network.relations.front().component);
  if (model->free_shafts != 1)
    return "a prescribed speed leaves no coordinate free; replace it by a motor or choose another method";
  if (!model->own_states.empty())
    return fmt::format(
        "the {} of \"{}\" is a state besides angle and speed; switch that effect off or choose another "
        "method",
        model->own_states.front().state.name, model->own_states.front().component);
  if (!model->scene.sequence.steps.empty())
    return "the operating sequence switches at times or events, which over the angle nobody knows beforehand; choose "
           "another method";
  const RigidMachine machine(model);
  for (const Network::ShaftElement& e : model->network.elements)
    if (e.element->uses_time || e.window.start > Window{}.start || e.window.stop < Window{}.stop)
      return fmt::format(
          "the torque of \"{}\" depends on time, and over the angle nobody knows the time of an edge; choose "
          "another method",
          e.component);
  for (const auto& pool : model->pools)
    if (pool->reacts())
      return "joint friction depends on the acceleration, and its kinks lie at angles that nobody knows beforehand; "
             "choose another method";
  if (!machine.edges_are_of_angle())
    return "a torque given as a table over speed changes its piece at speeds, not at angles; choose another method";
  if (!machine.periodic())
    return "the elements' angles do not come back together within 24 turns, so that load edges have no fixed place; "
           "choose another method";
  return {};
}

WorkTables::WorkTables(std::shared_ptr<const Model> model)
    : machine_([&] {
        if (const std::string why = refusal(model); !why.empty()) throw std::invalid_argument(why);
        return RigidMachine(model);
      }()),
      of_angle_alone_(!machine_.uses_speed()) {}

const std::vector<double>& WorkTables::edges(int direction) {
  std::optional<std::vector<double>>& made = edges_[side(direction)];
  if (!made) {
    made = machine_.edges(direction);
    if (direction < 0) {
      for (double& e : *made) e = e > 0 ? machine_.cycle() - e : 0;
      std::sort(made->begin(), made->end());
    }
  }
  return *made;
}

const WorkOverAngle& WorkTables::diagram(int direction) {
  std::unique_ptr<WorkOverAngle>& made = diagram_[side(direction)];
  if (!made) {
    if (!of_angle_alone_) throw std::logic_error("the work diagram needs torques of the angle alone");
    made = std::make_unique<WorkOverAngle>(machine_, machine_.edges(direction), direction);
  }
  return *made;
}

}  // namespace kurbel
