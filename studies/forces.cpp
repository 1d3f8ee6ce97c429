// forces.cpp — the two problems over a cycle: motion given or simulated, then d'Alembert position by position.
#include "studies/forces.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "engine/model.h"
#include "engine/rigid_machine.h"
#include "engine/run.h"
#include "engine/units.h"
#include "mechanisms/joint_keys.h"

namespace kurbel {
namespace {

constexpr double turn = 2 * std::numbers::pi;
constexpr int least_cells = 720;  // of a turn: peaks are sought on this grid, work is integrated between its points

std::size_t index(int i) { return static_cast<std::size_t>(i); }

// --- the mechanism and where it stands in the machine ---

const Section& chosen_slider_crank(const Scene& scene, const std::string& wanted) {
  std::vector<std::string> names;
  for (const Section& s : scene.components) {
    if (s.kind->name != "slider-crank") continue;
    if (wanted.empty() || s.name == wanted) return s;
    names.push_back(s.name);
  }
  if (names.empty())
    throw std::invalid_argument(fmt::format(
        "{}: forces are found for slider-cranks, and there is none on its lines; add one (kurbel keys slider-crank)",
        scene.file));
  throw std::invalid_argument(
      fmt::format("--mechanism {}: no slider-crank of that name; allowed: {}", wanted, listed(names)));
}

const Network::ShaftElement& element_of(const Network& network, const std::string& component) {
  for (const Network::ShaftElement& e : network.elements)
    if (e.component == component && e.element->cycle() > 0) return e;
  throw std::logic_error("slider-crank without an element");
}

// The loads on the slider, from the mechanism's own element on a shaft of its own: angle and speed are the crank's.
class SliderLoads {
 public:
  SliderLoads(const Scene& scene, const std::string& component) : SliderLoads(alone(scene, component)) {
    for (std::size_t k = 0; k < model().pool_channels.size(); ++k)
      if (model().pool_channels[k].name == "force." + component) channel_ = static_cast<int>(k);
  }
  const Model& model() const { return machine_.model(); }
  double cycle() const { return machine_.cycle(); }
  std::vector<double> edges(int direction) { return machine_.edges(direction); }

  // Sum of all forces along +x [N].
  double force(double phi, double omega) {
    if (channel_ < 0) return 0;
    const std::vector<double> y = equations_.modes_from_scratch(0, phi, omega);
    return model().pool_channels[index(channel_)].value(equations_.snapshot(0, y));
  }
  // Of each of model().accounts, reduced to the crank [N·m]; omega ≠ 0.
  std::span<const double> shares(double phi, double omega) {
    machine_.set_modes(phi, omega);
    return machine_.at(phi, omega, true).share;
  }

 private:
  explicit SliderLoads(const std::shared_ptr<const Model>& model) : machine_(model), equations_(model, false) {}
  static std::shared_ptr<const Model> alone(const Scene& scene, const std::string& component) {
    const Network whole = build_network(scene);
    Network network;
    const int node = network.add_node(component, "", 1);  // kg·m²; forces do not see it
    network.ports[component] = {node, node};
    network.components = {component};
    network.put_made(node, component, element_of(whole, component).element, {}, 0);
    Scene bare;
    bare.file = scene.file;
    return compile_network(std::move(network), bare, rigid_effects());
  }

  RigidMachine machine_;
  Equations equations_;
  int channel_ = -1;
};

// --- where the cycle is looked at ---

struct Abscissa {
  double phi = 0;
  double weight = 0;  // of the integral over the cycle
  bool grid = false;  // one of the even positions
};

constexpr double beside = 1e-9;  // rad: either side of an edge

// The grid, Gauss' three points between its points and the load edges, and a point on either side of each edge.
std::vector<Abscissa> abscissae(double cycle, int cells, const std::vector<double>& edges) {
  std::vector<double> knots;
  for (int i = 0; i <= cells; ++i) knots.push_back(cycle * i / cells);
  knots.insert(knots.end(), edges.begin(), edges.end());
  std::sort(knots.begin(), knots.end());
  std::vector<Abscissa> all;
  for (int i = 0; i <= cells; ++i) all.push_back({cycle * i / cells, 0, true});
  const double node = std::sqrt(0.6);
  for (std::size_t i = 0; i + 1 < knots.size(); ++i) {
    const double half = 0.5 * (knots[i + 1] - knots[i]), middle = 0.5 * (knots[i + 1] + knots[i]);
    if (half <= 1e-12) continue;
    all.push_back({middle - node * half, half * 5 / 9});
    all.push_back({middle, half * 8 / 9});
    all.push_back({middle + node * half, half * 5 / 9});
  }
  for (const double edge : edges)
    for (const double phi : {edge - beside, edge + beside})
      if (phi > 0 && phi < cycle) all.push_back({phi});
  std::stable_sort(all.begin(), all.end(), [](const Abscissa& a, const Abscissa& b) { return a.phi < b.phi; });
  return all;
}

struct Motion {
  double omega = 0, alpha = 0;
};

// --- one problem ---

class CycleBuilder {
 public:
  CycleBuilder(const SliderCrankStatics& statics, SliderLoads& loads, ForceCycle& cycle)
      : statics_(statics), geometry_(statics.data()), loads_(loads), cycle_(cycle) {
    for (const WorkAccount& account : loads.model().accounts)
      cycle_.work.push_back({account.name, name_of(account.kind), 0});
    cycle_.work.push_back({"balancing torque", "driving", 0});
    for (std::size_t k = 0; k < joint_count; ++k)
      cycle_.work.push_back({std::string("friction of ") + name_of(static_cast<Joint>(k)), "harmful", 0});
  }

  CyclePosition at(double phi, Motion motion) const {
    CyclePosition p;
    p.state = {phi, motion.omega, motion.alpha, loads_.force(phi, motion.omega)};
    const auto slider = geometry_.slider(phi);
    p.position = slider.value;
    p.velocity = slider.slope * motion.omega;
    p.rod_angle = geometry_.rod(phi).value;
    p.forces = statics_.solve(p.state);
    const auto inertia = geometry_.inertia(phi);
    const double w = motion.omega;
    p.power = {p.forces.torque * w,
               p.state.slider_force * p.velocity,
               geometry_.gravity_torque(phi).value * w,
               (inertia.value * motion.alpha + 0.5 * inertia.slope * w * w) * w,
               p.forces.friction_loss(),
               0};
    return p;
  }

  void add(const Abscissa& where, Motion motion) {
    const CyclePosition p = at(where.phi, motion);
    samples_.push_back(p);
    if (where.grid) cycle_.positions.push_back(p);
    if (where.weight == 0) return;
    // dA = M dφ, in the sense of the motion.
    const double dt = where.weight / std::abs(motion.omega);
    const auto share = loads_.shares(where.phi, motion.omega);
    std::size_t k = 0;
    for (; k < share.size(); ++k) cycle_.work[k].work += share[k] * motion.omega * dt;
    cycle_.work[k++].work += p.power.crank * dt;
    for (const double lost : p.forces.friction_power) cycle_.work[k++].work -= lost * dt;
    time_ += dt;
  }

  void finish() {
    cycle_.mean_speed = std::copysign(cycle_.cycle / time_, cycle_.positions.front().state.omega);
    find_extremes();
    find_harmonics();
    balance_powers();
    balance_work();
  }

 private:
  // Motion between the samples: cubic in z = ω²/2, whose slope is ε.
  Motion motion_at(double phi) const {
    const auto after = std::upper_bound(samples_.begin() + 1, samples_.end() - 1, phi,
                                        [](double x, const CyclePosition& p) { return x < p.state.phi; });
    const CrankState &a = (after - 1)->state, &b = after->state;
    const double h = b.phi - a.phi;
    if (!(h > 0)) return {a.omega, a.alpha};
    const double u = (phi - a.phi) / h, v = 1 - u, za = 0.5 * a.omega * a.omega, zb = 0.5 * b.omega * b.omega;
    const double z = v * v * (1 + 2 * u) * za + u * u * (1 + 2 * v) * zb + h * u * v * (v * a.alpha - u * b.alpha);
    const double slope = 6 * u * v * (zb - za) / h + v * (v - 2 * u) * a.alpha + u * (u - 2 * v) * b.alpha;
    return {std::copysign(std::sqrt(2 * std::max(0.0, z)), a.omega), slope};
  }

  // The largest magnitude of a function of the position: on the samples, then by the golden section between the
  // neighbours of the largest one. Of equal peaks of either sign (a crank's two strokes) the first one counts, however
  // rounding decides between them.
  template <class F>
  Peak peak_of(F&& value) const {
    constexpr double same_peak = 1e-9;
    std::size_t best = 0;
    for (std::size_t i = 0; i < samples_.size(); ++i)
      if (std::abs(value(samples_[i])) > (1 + same_peak) * std::abs(value(samples_[best]))) best = i;
    Peak peak{value(samples_[best]), samples_[best].state.phi, {}};
    const double sense = peak.value < 0 ? -1 : 1;
    for (const std::size_t i : {best, best + 1}) {  // the pieces before and after it
      if (i == 0 || i >= samples_.size()) continue;
      const auto seek = [&](double phi) { return sense * value(at(phi, motion_at(phi))); };
      const auto [phi, found] = highest(seek, samples_[i - 1].state.phi, samples_[i].state.phi);
      if (found > sense * peak.value) peak = {sense * found, phi, {}};
    }
    return peak;
  }
  // By the golden section.
  template <class F>
  static std::pair<double, double> highest(F&& f, double a, double b) {
    constexpr double part = 0.38196601125010515;
    double x = a + part * (b - a), y = b - part * (b - a), fx = f(x), fy = f(y);
    for (int i = 0; i < 40; ++i) {
      if (fx > fy) {
        b = y, y = x, fy = fx;
        fx = f(x = a + part * (b - a));
      } else {
        a = x, x = y, fx = fy;
        fy = f(y = b - part * (b - a));
      }
    }
    return fx > fy ? std::pair{x, fx} : std::pair{y, fy};
  }

  void find_extremes() {
    std::sort(samples_.begin(), samples_.end(),
              [](const CyclePosition& a, const CyclePosition& b) { return a.state.phi < b.state.phi; });
    cycle_.reaction[0] = peak_of([](const CyclePosition& p) { return p.forces.main_bearing.magnitude(); });
    cycle_.reaction[1] = peak_of([](const CyclePosition& p) { return p.forces.crank_pin.magnitude(); });
    cycle_.reaction[2] = peak_of([](const CyclePosition& p) { return p.forces.slider_pin.magnitude(); });
    cycle_.reaction[3] = peak_of([](const CyclePosition& p) { return p.forces.guide; });
    cycle_.torque = peak_of([](const CyclePosition& p) { return p.forces.torque; });
    cycle_.shaking_force = peak_of([](const CyclePosition& p) { return p.forces.shaking_force.magnitude(); });
    cycle_.shaking_moment = peak_of([](const CyclePosition& p) { return p.forces.shaking_moment; });
    // Speeds at both ends in the order of time.
    cycle_.closure = (cycle_.positions.back().state.omega - cycle_.positions.front().state.omega) / cycle_.mean_speed;
    std::sort(cycle_.positions.begin(), cycle_.positions.end(),
              [](const CyclePosition& a, const CyclePosition& b) { return a.state.phi < b.state.phi; });
    cycle_.least_speed = cycle_.greatest_speed = cycle_.positions.front().state.omega;
    for (const CyclePosition& p : cycle_.positions) {
      cycle_.least_speed = std::min(cycle_.least_speed, p.state.omega);
      cycle_.greatest_speed = std::max(cycle_.greatest_speed, p.state.omega);
      cycle_.both_edges += p.forces.both_edges ? 1 : 0;
      cycle_.friction_residual = std::max(cycle_.friction_residual, p.forces.residual);
      cycle_.most_iterations = std::max(cycle_.most_iterations, p.forces.iterations);
    }
  }

  template <class F>
  std::vector<ForceHarmonic> orders_of(F&& value, double* mean = nullptr) const {
    std::vector<double> values;
    for (const CyclePosition& p : cycle_.positions) values.push_back(value(p));
    return harmonics(values, static_cast<int>(std::lround(cycle_.cycle / turn)), mean);
  }
  void find_harmonics() {
    cycle_.shaking_x = orders_of([](const CyclePosition& p) { return p.forces.shaking_force.x; });
    cycle_.shaking_y = orders_of([](const CyclePosition& p) { return p.forces.shaking_force.y; });
    cycle_.shaking_couple = orders_of([](const CyclePosition& p) { return p.forces.shaking_moment; });
    cycle_.torque_orders = orders_of([](const CyclePosition& p) { return p.forces.torque; }, &cycle_.torque_mean);
  }

  void balance_powers() {
    double scale = 0;
    for (const CyclePosition& p : cycle_.positions)
      for (const double power : {p.power.crank, p.power.load, p.power.weight, p.power.kinetic_rate, p.power.friction})
        scale = std::max(scale, std::abs(power));
    for (CyclePosition& p : cycle_.positions) {
      const double left = p.power.crank + p.power.load + p.power.weight - p.power.friction - p.power.kinetic_rate;
      p.power.residual = scale > 0 ? left / scale : 0;
      cycle_.power_residual = std::max(cycle_.power_residual, std::abs(p.power.residual));
    }
  }

  // What goes in on balance over the cycle is input, what comes out is useful unless its account says harmful.
  void balance_work() {
    const auto kinetic = [&](const CyclePosition& p) {
      return 0.5 * geometry_.inertia(p.state.phi).value * p.state.omega * p.state.omega;
    };
    cycle_.kinetic_change =
        (kinetic(cycle_.positions.back()) - kinetic(cycle_.positions.front())) * (cycle_.mean_speed < 0 ? -1 : 1);
    double largest = 0;
    for (const CycleWork& w : cycle_.work) largest = std::max(largest, std::abs(w.work));
    for (CycleWork& w : cycle_.work) {
      if (std::abs(w.work) < 1e-12 * largest) w.work = 0;  // of weights round a cycle
      if (w.name == "balancing torque" && w.work < 0) w.kind = "useful";
      if (w.work > 0) cycle_.input += w.work;
      if (w.work < 0) (w.kind == "harmful" ? cycle_.harmful : cycle_.useful) -= w.work;
    }
    if (cycle_.input > 0) cycle_.efficiency = cycle_.useful / cycle_.input;
  }

  const SliderCrankStatics& statics_;
  SliderCrankGeometry geometry_;
  SliderLoads& loads_;
  ForceCycle& cycle_;
  std::vector<CyclePosition> samples_;  // every abscissa
  double time_ = 0;
};

// Cells a turn that hold the rows of the tables as well.
int stride_of(int positions) { return (least_cells + positions - 1) / positions; }

// --- first problem ---

ForceCycle first_problem(const SliderCrankStatics& statics, SliderLoads& loads, int positions, double speed) {
  ForceCycle cycle;
  cycle.label = "prescribed";
  cycle.description = fmt::format("crank turning at {} throughout", with_unit(speed * 60 / turn, "rpm"));
  cycle.cycle = loads.cycle();
  cycle.stride = stride_of(positions);
  const int cells = positions * cycle.stride * static_cast<int>(std::lround(cycle.cycle / turn));
  CycleBuilder builder(statics, loads, cycle);
  for (const Abscissa& a : abscissae(cycle.cycle, cells, loads.edges(speed < 0 ? -1 : 1))) builder.add(a, {speed, 0});
  builder.finish();
  return cycle;
}

// --- second problem ---

// Motion of the crank when it comes past given angles.
class PassageRecorder final : public Observer {
 public:
  PassageRecorder(std::size_t tracked, int node, std::vector<double> targets, int direction)
      : tracked_(tracked), node_(node), targets_(std::move(targets)), direction_(direction) {}
  void step(StepView& view) override {
    Equations& equations = view.equations();
    const Model& m = equations.model();
    const int shaft = m.shaft_of_node[index(node_)];
    const double gain = m.gain_of_node[index(node_)];
    const auto beyond = [&](double t) {
      return direction_ * (equations.angle_with_turns(tracked_, view.at(t)) - targets_[passed_.size()]);
    };
    double from = view.t_previous();
    while (passed_.size() < targets_.size()) {
      const double at_end = beyond(view.t());
      if (at_end < 0) return;
      const double at_begin = beyond(from);
      const double time = at_begin < 0 ? find_root(beyond, from, at_begin, view.t(), at_end) : from;
      const Snapshot& s = view.snapshot(time);
      passed_.push_back({gain * s.now.speed[shaft], gain * s.alpha[shaft]});
      from = time;
    }
  }
  const std::vector<Motion>& passed() const { return passed_; }

 private:
  std::size_t tracked_;
  int node_;
  std::vector<double> targets_;
  int direction_;
  std::vector<Motion> passed_;
};

struct Crank {
  int node = 0;
  std::size_t tracked = 0;
  double phase = 0;
};

Crank crank_in(const Model& model, const std::string& component) {
  const Network::ShaftElement& element = element_of(model.network, component);
  for (std::size_t i = 0; i < model.angles.size(); ++i)
    if (model.angles[i].node == element.node) return {element.node, i, element.phase};
  throw std::logic_error("the crank's angle is not tracked");
}

double crank_speed(const Model& model, Equations& equations, const Crank& crank, std::span<const double> y) {
  const Snapshot& s = equations.snapshot(0, y);
  return model.gain_of_node[index(crank.node)] * s.now.speed[model.shaft_of_node[index(crank.node)]];
}

class SecondProblem {
 public:
  SecondProblem(const Scene& scene, const Effects& effects, const std::string& component, const ForcesOptions& options)
      : options_(options),
        settings_(scene.run),
        model_(compile(scene, effects)),
        crank_(crank_in(*model_, component)) {}

  double start_speed() const {
    Equations equations(model_, false);
    const std::vector<double> y = equations.start(0);
    return crank_speed(*model_, equations, crank_, y);
  }
  double rated_speed() const { return model_->speed_scale * std::abs(model_->node_ratio[index(crank_.node)]); }

  // Empty with a note where the run holds no whole cycle.
  std::optional<ForceCycle> solve(const SliderCrankStatics& statics, SliderLoads& loads, Forces& out) {
    const double tolerance = std::max(settings_.accuracy, 1e-12) / 10;
    const auto [begin_angle, end_angle, outcome] = whole_run(30 * tolerance);
    if (!outcome.complete) {
      out.complete = false;
      out.diagnosis = outcome.diagnosis;
    }
    const double cycle = loads.cycle();
    const int direction = end_angle >= begin_angle ? 1 : -1;
    // The last cycle that begins and ends at a multiple of the cycle, in the crank's own angle.
    const double last = direction > 0 ? std::floor((end_angle - 1e-9) / cycle) : std::ceil((end_angle + 1e-9) / cycle);
    const double first = last - direction;
    if (direction * (first * cycle - begin_angle) < -1e-9) {
      out.notes.push_back(fmt::format(
          "second problem left out: within {} the crank turns by {:.4g}°, less than a whole cycle of {:.0f}° that "
          "begins "
          "at a multiple of it; simulate longer (run.until) or start the machine",
          with_unit(outcome.t, "s", 4), std::abs(end_angle - begin_angle) * 360 / turn, cycle * 360 / turn));
      return {};
    }
    const double origin = (direction > 0 ? first : last) * cycle;
    ForceCycle loose = one_run(statics, loads, origin, direction, 30 * tolerance);
    ForceCycle tight = one_run(statics, loads, origin, direction, tolerance);
    set_errors(loose, tight);
    tight.description = fmt::format("rigid machine as its torques drive it, cycle no. {:.0f} of a run of {}",
                                    std::abs(first) + 1, with_unit(settings_.until, "s", 4));
    if (std::abs(tight.closure) > 1e-3)
      out.notes.push_back(fmt::format(
          "the simulated motion is not steady: over the cycle shown the crank's speed changes by {:.2g} % of its mean; "
          "simulate longer (run.until)",
          100 * tight.closure));
    return tight;
  }

 private:
  struct WholeRun {
    double begin, end;  // crank's own angle [rad]
    RunOutcome outcome;
  };
  RunOptions run_options(double tolerance) const {
    return {.tolerance = tolerance,
            .method = settings_.model == "reduced" ? settings_.method : "auto",
            .until = settings_.until,
            .budget = settings_.budget,
            .interrupted = options_.interrupted,
            .progress = [this](double fraction) {
              if (options_.progress) options_.progress("simulating", fraction);
            }};
  }
  WholeRun whole_run(double tolerance) const {
    Equations equations(model_, false);
    const std::vector<double> y = equations.start(0);
    const double begin = equations.angle_with_turns(crank_.tracked, y) + crank_.phase;
    RunOutcome outcome = integrate(equations, run_options(tolerance), {});
    return {begin, equations.angle_with_turns(crank_.tracked, outcome.state) + crank_.phase, std::move(outcome)};
  }

  ForceCycle one_run(const SliderCrankStatics& statics, SliderLoads& loads, double origin, int direction,
                     double tolerance) const {
    ForceCycle cycle;
    cycle.label = "simulated";
    cycle.cycle = loads.cycle();
    cycle.stride = stride_of(options_.positions);
    const int cells = options_.positions * cycle.stride * static_cast<int>(std::lround(cycle.cycle / turn));
    std::vector<Abscissa> where = abscissae(cycle.cycle, cells, loads.edges(direction));
    if (direction < 0) std::reverse(where.begin(), where.end());
    std::vector<double> targets;
    for (const Abscissa& a : where) targets.push_back(origin + a.phi - crank_.phase);
    PassageRecorder passages(crank_.tracked, crank_.node, std::move(targets), direction);
    Equations equations(model_, false);
    integrate(equations, run_options(tolerance), {&passages});
    if (passages.passed().size() != where.size())
      throw std::runtime_error(
          "the simulated crank does not repeat its way between two tolerances; ask for more accuracy (run.accuracy)");
    CycleBuilder builder(statics, loads, cycle);
    for (std::size_t i = 0; i < where.size(); ++i) builder.add(where[i], passages.passed()[i]);
    builder.finish();
    return cycle;
  }

  static void set_errors(const ForceCycle& loose, ForceCycle& tight) {
    const auto set = [](const Peak& a, Peak& b) { b.error = std::abs(a.value - b.value); };
    for (std::size_t k = 0; k < joint_count; ++k) set(loose.reaction[k], tight.reaction[k]);
    set(loose.torque, tight.torque);
    set(loose.shaking_force, tight.shaking_force);
    set(loose.shaking_moment, tight.shaking_moment);
  }

  const ForcesOptions& options_;
  RunSettings settings_;
  std::shared_ptr<const Model> model_;
  Crank crank_;
};

void check(const ForcesOptions& options) {
  if (options.positions < 4 || options.positions > 3600)
    throw std::invalid_argument(fmt::format("--positions {}: must be 4 … 3600 of a turn", options.positions));
  if (options.speed && !(std::isfinite(*options.speed) && *options.speed != 0))
    throw std::invalid_argument(fmt::format("--speed {}: must be a speed ≠ 0, e.g. \"300 rpm\"", *options.speed));
}

Force2 direction_of(double phi) { return {std::cos(phi), std::sin(phi)}; }

}  // namespace

std::optional<double> PowerFlow::efficiency() const {
  double in = 0;
  for (const double power : {crank, load, weight, -kinetic_rate}) in += std::max(0.0, power);
  if (!(in > 0)) return {};
  return std::max(0.0, 1 - friction / in);  // what goes out is no less than nothing
}

// a_k = 2/n Σ f cos kφ over whole turns; both ends are given, so the last one is left out.
std::vector<ForceHarmonic> harmonics(const std::vector<double>& values, int turns, double* mean) {
  const std::size_t n = values.size() - 1;
  std::vector<ForceHarmonic> orders;
  for (int k = 0; k <= highest_order; ++k) {
    std::complex<double> sum = 0;
    for (std::size_t i = 0; i < n; ++i)
      sum += values[i] * std::polar(1.0, -k * turn * turns * static_cast<double>(i) / static_cast<double>(n));
    sum /= static_cast<double>(n);
    if (k == 0 && mean) *mean = sum.real();
    if (k > 0) orders.push_back({k, 2 * std::abs(sum), -std::arg(sum)});
  }
  return orders;
}

std::vector<Counterweight> propose_counterweights(const SliderCrankStatics& statics,
                                                  const std::vector<CyclePosition>& turn_of_crank) {
  const SliderCrankData& d = statics.data();
  const double share = d.rod_com / d.rod_length;  // of the rod's mass that goes with the slider
  const double rotating = d.crank_mass * d.crank_com + d.rod_mass * (1 - share) * d.radius;
  const double reciprocating = (d.slider_mass + d.rod_mass * share) * d.radius;
  // A counterweight opposite to the pin adds −U (ω² r̂ − ε t̂) to the shaking force.
  const auto added = [](double moment, const CyclePosition& p) {
    const double w = p.state.omega;
    return moment *
           (-w * w * direction_of(p.state.phi) + p.state.alpha * direction_of(p.state.phi + std::numbers::pi / 2));
  };
  const auto peak = [&](double moment) {
    double largest = 0;
    for (const CyclePosition& p : turn_of_crank)
      largest = std::max(largest, (p.forces.shaking_force + added(moment, p)).magnitude());
    return largest;
  };
  // The largest of norms of affine functions is convex.
  double a = rotating - 2 * reciprocating, b = rotating + 2 * reciprocating;
  constexpr double part = 0.38196601125010515;
  for (int i = 0; i < 100; ++i) {
    const double x = a + part * (b - a), y = b - part * (b - a);
    if (peak(x) < peak(y))
      b = y;
    else
      a = x;
  }
  std::vector<Counterweight> proposals;
  const auto propose = [&](const std::string& name, double moment) {
    Counterweight c;
    c.name = name;
    c.moment = moment;
    c.reciprocating_share = reciprocating > 0 ? (moment - rotating) / reciprocating : 0;
    std::vector<double> x, y;
    for (const CyclePosition& p : turn_of_crank) {
      const Force2 force = added(moment, p);
      c.shaking.push_back(p.forces.shaking_force + force);
      x.push_back(c.shaking.back().x);
      y.push_back(c.shaking.back().y);
      // The bearing carries it: the frame's force on the crank is less by the counterweight's inertia force.
      c.peak_bearing = std::max(c.peak_bearing, (p.forces.main_bearing - force).magnitude());
    }
    c.peak_force = peak(moment);
    const int turns =
        static_cast<int>(std::lround((turn_of_crank.back().state.phi - turn_of_crank.front().state.phi) / turn));
    c.first_x = harmonics(x, turns).front().amplitude;
    c.first_y = harmonics(y, turns).front().amplitude;
    proposals.push_back(std::move(c));
  };
  propose("as it is", 0);
  propose("rotating masses", rotating);
  propose("rotating masses and half the reciprocating ones", rotating + 0.5 * reciprocating);
  propose("least peak of the shaking force", 0.5 * (a + b));
  return proposals;
}

Forces find_forces(const Scene& scene, const ForcesOptions& options) {
  check(options);
  const Section& section = chosen_slider_crank(scene, options.mechanism);
  Forces out;
  out.title = scene.title;
  out.scene_file = scene.file;
  out.scene_text = scene.text;
  out.mechanism = section.name;
  out.data = slider_crank_data(section);
  out.joints = slider_crank_joints(section);
  // Rigid, with the joints' friction where they have any: motion and forces follow the same laws.
  Effects effects;
  effects.joint_friction = !out.joints.frictionless();
  SecondProblem machine(scene, effects, section.name, options);
  if (scene.effects.joint_clearance || scene.effects.flexible_rod)
    out.notes.push_back("joints count as ideal and the rod as rigid: joint clearance and flexible rod are left out");
  const SliderCrankStatics statics(out.data, out.joints);
  SliderLoads loads(scene, section.name);
  const double share = out.data.rod_com / out.data.rod_length;
  out.rotating_moment = out.data.crank_mass * out.data.crank_com + out.data.rod_mass * (1 - share) * out.data.radius;
  out.reciprocating_mass = out.data.slider_mass + out.data.rod_mass * share;

  double speed = options.speed.value_or(machine.start_speed());
  std::string source = options.speed ? "as asked for" : "the scene's start speed";
  if (speed == 0) speed = machine.rated_speed(), source = "rated speed, as the scene starts from rest";
  if (options.log)
    options.log(fmt::format("first problem: {} at {} ({})", section.name, with_unit(speed * 60 / turn, "rpm"), source));
  out.prescribed = first_problem(statics, loads, options.positions, speed);
  out.prescribed->description += ", " + source;
  out.counterweights = propose_counterweights(statics, out.prescribed->positions);
  if (options.simulate) {
    if (options.log) options.log("second problem: running the rigid machine");
    out.simulated = machine.solve(statics, loads, out);
  }
  return out;
}

}  // namespace kurbel
