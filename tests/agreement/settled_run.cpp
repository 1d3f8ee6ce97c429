// settled_run.cpp — runs of growing length until something repeats; then three periods, measured one after the other.
#include "tests/agreement/settled_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <stdexcept>

#include "engine/numerics/deadline.h"
#include "engine/numerics/index.h"
#include "studies/forces/machine_motion.h"
#include "studies/run/figures.h"
#include "tests/agreement/passings.h"

namespace kurbel::agreement {
namespace {

constexpr std::size_t most_places = 64;  // of one base within a period
constexpr double same = 1e-7;            // of rated values, from one period to the next
constexpr double near_enough = 1e-7;     // what the mean speed may still have to change, over itself
constexpr double looser = 100;
constexpr double looks = 61.803;  // at what may stand still, in the length of a run

RunOptions options_of(double tolerance, double until, double budget) {
  RunOptions run{.tolerance = tolerance,
                 .method = "auto",
                 .until = until,
                 .budget = budget,
                 .interrupted = nullptr,
                 .progress = {}};
  run.to_go_on = true;
  return run;
}

// What follows is measured by itself.
Checkpoint bare(Checkpoint checkpoint) {
  checkpoint.integrals.clear();
  checkpoint.observers.clear();
  return checkpoint;
}

double link_angle(const Model& m, const State& state) {
  return angle_with_turns(state.modes, at(m.reduction_angle), state.y);
}

std::string shaft_name(const Model& m, int node) {
  const std::string& component = m.network.nodes[at(node)].component;
  const Network::Ports& ports = m.network.ports.at(component);
  if (ports.in == ports.out) return component;
  return component + (node == ports.in ? ".in" : ".out");
}

// The longest period of a law over time [s]; 0: none.
double time_base(const Model& m) {
  double period = 0;
  for (const Network::ShaftElement& e : m.network.elements) period = std::max(period, e.element->time_period);
  for (const PrescribedSpeed& given : m.network.prescribed)
    if (given.amplitude != 0 && given.frequency != 0) period = std::max(period, 1 / std::abs(given.frequency));
  return period;
}

struct Repeat {
  std::size_t k = 0;  // places to a period; 0: does not repeat
  double period = 0;  // [s]
  double to_come = HUGE_VAL;
};

// The smallest k that the last places repeat with, seen over two periods and at three places at least.
Repeat repeat_of(const std::vector<Passing>& p) {
  for (std::size_t k = 1; k <= most_places && 2 * k + 3 <= p.size(); ++k) {
    const std::size_t last = p.size() - 1;
    const double period = p[last].t - p[last - k].t;
    double miss = 0;
    for (std::size_t back = 0; back < std::max<std::size_t>(3, k); ++back) {
      miss = std::max(miss, difference(p[last - back], p[last - back - k]));
      miss = std::max(miss, std::abs(p[last - back].t - p[last - back - k].t - period) / period);
    }
    if (miss > same) continue;
    std::vector<double> speeds;  // means over periods, oldest first
    for (std::size_t i = p.size() - 1; i >= k; i -= k)
      speeds.insert(speeds.begin(), (p[i].angle - p[i - k].angle) / (p[i].t - p[i - k].t));
    const double speed = std::abs(speeds.back());
    return {k, period, still_to_come(speeds, 1e-9 * speed) / std::max(speed, 1e-300)};
  }
  return {};
}

// Times at which the same component did the same thing, of what happened most lately.
std::vector<Passing> as_passings(const std::vector<Event>& events) {
  std::vector<Passing> list;
  if (events.empty()) return list;
  const Event& last = events.back();
  for (const Event& e : events) {
    if (e.component != last.component || e.kind != last.kind || e.what != last.what) continue;
    Passing p;
    p.t = e.t, p.angle = e.angle;
    list.push_back(std::move(p));
  }
  return list;
}

class Settling {
 public:
  Settling(const Scene& scene, const Effects& effects, const SettleSettings& settings) : settings_(settings) {
    run_.model = compile(scene, effects);
    run_.link = shaft_name(*run_.model, run_.model->reduction_node);
  }

  SettledRun find() {
    const double begin = processor_time();
    settle();
    if (run_.kind == Motion::repeats) measure();
    run_.cpu_seconds = processor_time() - begin;
    return std::move(run_);
  }

 private:
  // One machine, run on and on, each time as far again.
  void settle() {
    const double begin = processor_time();
    double until = run_.model->scene.run.until;
    Equations equations(run_.model, true);
    const double cycle = run_.model->cycle > 0 ? run_.model->cycle : 2 * std::numbers::pi;
    const double base_time = time_base(*run_.model);
    const bool neither_angle_nor_time = run_.model->cycle == 0 && base_time == 0;
    std::vector<Event> events;
    while (true) {
      Passings by_angle(Passings::Of::angle, cycle), by_time(Passings::Of::time, base_time > 0 ? base_time : 1),
          now_and_then(Passings::Of::time, (until - run_.time) / looks);
      RunOptions options = options_of(settings_.tolerance, until, settings_.budget);
      if (run_.time > 0) options.checkpoint = &run_.at;
      std::vector<Observer*> observers = {&by_angle, &now_and_then};
      if (base_time > 0) observers.push_back(&by_time);
      const RunOutcome outcome = integrate(equations, options, observers);
      if (!outcome.complete) {
        run_.words = outcome.diagnosis;
        return;
      }
      run_.at = bare(outcome.checkpoint);
      run_.time = outcome.t;
      events.insert(events.end(), outcome.events.begin(), outcome.events.end());
      if (rests(equations, outcome)) {
        run_.kind = Motion::rests;
        run_.words = "at rest";
        return;
      }
      if (found(by_angle.list(), Base::angle) || (base_time > 0 && found(by_time.list(), Base::time)) ||
          (neither_angle_nor_time && found(as_passings(events), Base::event)) ||
          (nothing_changes(now_and_then.list()) && found(now_and_then.list(), Base::none)))
        return;
      if (2 * run_.time > settings_.longest || processor_time() - begin > 0.5 * settings_.budget) {
        run_.words = fmt::format("does not repeat within {:.4g} s", run_.time);
        return;
      }
      until = 2 * run_.time;
    }
  }

  bool found(const std::vector<Passing>& places, Base base) {
    const Repeat repeat = repeat_of(places);
    if (repeat.k == 0 || repeat.to_come > near_enough) return false;
    run_.kind = Motion::repeats;
    run_.base = base;
    run_.period = repeat.period;
    run_.to_come = repeat.to_come;
    run_.words = fmt::format("period {:.9g} s: {} × {}", repeat.period, repeat.k,
                             base == Base::angle  ? "the link's cycle"
                             : base == Base::time ? "that of a law over time"
                             : base == Base::none ? "any time, nothing changes"
                                                  : "the same event");
    return true;
  }

  // Over the last quarter of the looks, which no cycle is in step with.
  static bool nothing_changes(const std::vector<Passing>& looks_at) {
    const std::size_t n = looks_at.size();
    if (n < 8) return false;
    for (std::size_t i = n - n / 4; i < n; ++i)
      if (difference(looks_at[i], looks_at[i - 1]) > same) return false;
    return true;
  }

  bool rests(Equations& equations, const RunOutcome& outcome) const {
    const std::vector<double> scale = equations.error_control(1).scale;
    for (std::size_t s = 0; s < run_.model->free_shafts; ++s) {
      const std::size_t i = equations.speed_index(static_cast<int>(s));
      if (std::abs(outcome.state[i]) > 1e-7 * scale[i]) return false;
    }
    return run_.model->free_shafts == run_.model->shafts.size();  // nothing is driven at a given speed
  }

  // --- figures of one period ---

  struct Window {
    Checkpoint end;
    std::vector<Measured> figures;
    double angle = 0;
  };

  Window window(const Checkpoint& from, double tolerance) const {
    const Model& m = *run_.model;
    Equations equations(run_.model, true);
    ExtremeRecorder extremes(extremes_of(m));
    RunOptions options = options_of(tolerance, from.state.t + run_.period, settings_.budget);
    options.checkpoint = &from;
    const RunOutcome outcome = integrate(equations, options, {&extremes});
    if (!outcome.complete) throw std::runtime_error(outcome.diagnosis);
    Window w;
    w.end = bare(outcome.checkpoint);
    w.angle = link_angle(m, outcome.checkpoint.state) - link_angle(m, from.state);
    add_speeds(w, extremes);
    add_torques(w, extremes, outcome.state, equations);
    add_works(w, outcome.state, equations);
    return w;
  }
  static void add(Window& w, Name name, double value, double scale, bool needed) {
    w.figures.push_back({std::move(name), value, scale, 0, needed});
  }
  void add_speeds(Window& w, const ExtremeRecorder& extremes) const {
    const double scale = run_.model->speed_scale;
    double most = 0, least = 0;
    for (std::size_t i = 0; i < extremes.wanted().size(); ++i) {
      if (extremes.wanted()[i].name.what == quantities::max_speed) most = extremes.found()[i].value;
      if (extremes.wanted()[i].name.what == quantities::min_speed) least = extremes.found()[i].value;
    }
    const double mid = 0.5 * (most + least);
    add(w, Name::make(quantities::cycle_time), run_.period, run_.period, run_.base != Base::none);
    add(w, Name::make(quantities::mean_speed, run_.link), w.angle / run_.period, scale, true);
    add(w, Name::own("mid_speed", run_.link), mid, scale, true);
    add(w, Name::make(quantities::max_speed, run_.link), most, scale, false);
    add(w, Name::make(quantities::min_speed, run_.link), least, scale, false);
    add(w, Name::make(quantities::delta, run_.link), mid == 0 ? 0 : (most - least) / std::abs(mid), 1, true);
  }
  void add_torques(Window& w, const ExtremeRecorder& extremes, std::span<const double> state,
                   const Equations& equations) const {
    const Model& m = *run_.model;
    for (std::size_t i = 0; i < extremes.wanted().size(); ++i) {
      const ExtremeOf& wanted = extremes.wanted()[i];
      if (!is_peak(wanted.name.what) || !extremes.found()[i].any) continue;
      const double value = extremes.found()[i].value;
      add(w, wanted.name, value, wanted.scale > 0 ? wanted.scale : std::abs(value),
          wanted.name.what == quantities::peak_torque);
    }
    for (std::size_t i = 0; i < m.torque_joints.size(); ++i)
      add(w, Name::make(quantities::rms_torque, m.torque_joints[i].component),
          std::sqrt(std::max(0.0, state[equations.square_index(i, false)]) / run_.period),
          m.torque_joints[i].torque_scale, true);
  }
  void add_works(Window& w, std::span<const double> state, const Equations& equations) const {
    const Model& m = *run_.model;
    const double scale = m.torque_scale * 2 * std::numbers::pi;
    std::map<Account, double> of_kind = {
        {Account::driving, 0}, {Account::useful, 0}, {Account::harmful, 0}, {Account::weight, 0}};
    std::map<std::string, double> of_account;  // two elements of a component may have accounts of one name
    for (std::size_t a = 0; a < m.accounts.size(); ++a) {
      const double work = state[equations.work_index(a)];
      of_kind[m.accounts[a].kind] += work;
      const std::string name = fmt::format("{} ({})", m.accounts[a].name, name_of(m.accounts[a].kind));
      of_account[name] += work;
    }
    for (const auto& [name, work] : of_account)
      add(w, Name::make(quantities::work_per_cycle, name), work, scale,
          run_.base != Base::none && std::abs(work) > 1e-6 * scale);
    for (const auto& [kind, work] : of_kind)
      add(w, Name::make(work_per_cycle_of(kind)), work, scale, run_.base != Base::none && kind != Account::weight);
  }

  // What a figure has still to change, from three periods: d₁, d₂ shrink geometrically or stay as they are.
  static double rest_of_change(double first, double second, double third) {
    const double before = std::abs(second - first), now = std::abs(third - second);
    const double ratio = now < 0.95 * before ? now / before : 0.95;
    return now * std::max(1.0, ratio / (1 - ratio));
  }
  static double value_in(const Window& w, const Measured& like) {
    for (const Measured& f : w.figures)
      if (f.name == like.name) return is_peak(like.name.what) ? std::copysign(f.value, like.value) : f.value;
    return 0;
  }
  void measure() {
    try {
      const Window loose = window(run_.at, looser * settings_.tolerance), first = window(run_.at, settings_.tolerance),
                   second = window(first.end, settings_.tolerance);
      Window third = window(second.end, settings_.tolerance);
      run_.angle = third.angle;
      for (Measured& f : third.figures) {
        const double a = value_in(first, f), b = value_in(second, f);
        f.error = rest_of_change(a, b, f.value) + std::abs(a - value_in(loose, f)) + run_.to_come * std::abs(f.value);
      }
      run_.figures = std::move(third.figures);
      run_.at = third.end;
    } catch (const std::runtime_error& error) {
      run_.kind = Motion::none;
      run_.words = fmt::format("settled, but a period more failed: {}", error.what());
    }
  }

  SettleSettings settings_;
  SettledRun run_;
};

}  // namespace

bool SettledRun::equilibrium() const {
  const Measured* delta = find(quantities::delta, link);
  return delta && std::abs(delta->value) <= 1e-7;
}

const Measured* SettledRun::find(const QuantityKind& what, const std::string& of) const {
  const auto found = std::find_if(figures.begin(), figures.end(),
                                  [&](const Measured& f) { return f.name.what == what && f.name.of == of; });
  return found == figures.end() ? nullptr : &*found;
}

SettledRun settle(const Scene& scene, const Effects& effects, const SettleSettings& settings) {
  return Settling(scene, effects, settings).find();
}

}  // namespace kurbel::agreement
