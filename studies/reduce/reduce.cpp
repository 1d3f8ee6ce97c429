// reduce.cpp — reduction of inertias and torques at positions of the cycle, harmonics, elastic chain.
#include "studies/reduce/reduce.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "engine/numerics/deadline.h"
#include "engine/numerics/index.h"
#include "engine/scene/units.h"

namespace kurbel {
namespace {

constexpr double turn = 2 * std::numbers::pi;

// x′ and x″ of a slider, or of a rocker's angle, by the link's angle, from the model's own channels at ω = 1.
class SliderRatio {
 public:
  struct At {
    double first = 0, second = 0;  // x′ [m/rad], x″ [m/rad²]
  };
  SliderRatio(std::shared_ptr<const Model> model, const std::string& mechanism)
      : model_(std::move(model)), equations_(model_, false) {
    for (const Channel& channel : model_->pool_channels) {
      if (channel.name.of != mechanism) continue;
      if (channel.name.what == QuantityKind::velocity) {
        velocity_ = channel.value;
        rocks_ = channel.unit == "rad/s";
      }
      if (channel.name.what == QuantityKind::acceleration) acceleration_ = channel.value;
    }
  }
  bool found() const { return velocity_ && acceleration_; }
  bool rocks() const { return rocks_; }
  // v = x′ ω,  a = x″ ω² + x′ ε
  At operator()(double phi) {
    const std::vector<double> y = equations_.modes_from_scratch(0, phi, 1.0);
    const Snapshot& s = equations_.snapshot(0, y);
    const auto node = at(model_->reduction_node);
    const double alpha = s.alpha[model_->shaft_of_node[node]] * model_->gain_of_node[node];
    const double first = velocity_(s);
    return {first, acceleration_(s) - first * alpha};
  }

 private:
  std::shared_ptr<const Model> model_;
  Equations equations_;
  std::function<double(const Snapshot&)> velocity_, acceleration_;
  bool rocks_ = false;
};

std::vector<std::string> sliders_of(const Model& model) {
  std::vector<std::string> names;
  for (const Channel& channel : model.pool_channels)
    if (channel.name.what == QuantityKind::velocity)
      names.push_back(channel.name.of + (channel.unit == "rad/s" ? ".rocker" : ".slider"));
  return names;
}

std::vector<std::string> shafts_of(const Model& model) {
  std::vector<std::string> names;
  for (const std::string& component : model.network.components) {
    const Network::Ports& ports = model.network.ports.at(component);
    if (ports.in == ports.out) {
      names.push_back(component);
    } else {
      names.push_back(component + ".in");
      names.push_back(component + ".out");
    }
  }
  return names;
}

[[noreturn]] void refuse_target(const Model& model, const std::string& to) {
  std::vector<std::string> names = shafts_of(model);
  for (const std::string& slider : sliders_of(model)) names.push_back(slider);
  const auto near = nearest(to, names);
  throw std::invalid_argument(fmt::format("--to {}: no such shaft{}; allowed: {}", in_quotes(to),
                                          near ? fmt::format(" — did you mean {}?", in_quotes(*near)) : "",
                                          listed(names)));
}

// Where torques depend on speed: the speed given, the operating speed, the scene's start, or the rated speed.
void choose_speed(RigidMachine& machine, const ReduceOptions& options, MachineReduction& r) {
  const Model& m = machine.model();
  if (options.speed) {
    r.speed = *options.speed;
    r.speed_source = "given";
    return;
  }
  if (machine.uses_speed() && machine.periodic()) {
    try {
      r.speed = operating_speed(machine).speed;
      r.speed_source = "operating speed: there the mean torques of drive and load balance";
      return;
    } catch (const std::invalid_argument& error) {
      r.notes.push_back(fmt::format("no operating speed: {}", error.what()));
    }
  }
  r.speed = m.speed_scale;
  r.speed_source = machine.uses_speed() ? "rated speed" : "no torque depends on it";
}

class Reducer {
 public:
  Reducer(const Scene& scene, const ReduceOptions& options) : machine_(scene), options_(options) {
    if (options.positions < 1 || options.positions > 100000)
      throw std::invalid_argument(fmt::format("--positions {}: must be 1 … 100000", options.positions));
    if (options.orders < 0 || options.orders > 1000)
      throw std::invalid_argument(fmt::format("--orders {}: must be 0 … 1000", options.orders));
    if (options.speed && !(*options.speed > 0 && std::isfinite(*options.speed)))
      throw std::invalid_argument("--speed: must be > 0");
    r_.title = scene.heading();
    r_.speed_unit = scene.speed_unit;
    r_.scene_file = scene.file;
  }

  MachineReduction run() {
    const Model& m = model();
    r_.link = m.node_label(m.reduction_node);
    r_.cycle = machine_.cycle();
    choose_target();
    choose_speed(machine_, options_, r_);
    for (const WorkAccount& account : m.accounts)
      r_.accounts.push_back(fmt::format("{} ({})", account.name, name_of(account.kind)));
    r_.constant_inertia = machine_.constant_inertia() / square(r_.to_ratio);
    for (int k = 0; k < options_.positions; ++k) r_.positions.push_back(position(k, r_.cycle * k / options_.positions));
    add_curve();
    add_spectra();
    r_.chain = elastic_chain(m, target_node_);
    add_notes();
    return std::move(r_);
  }

 private:
  const Model& model() const { return machine_.model(); }
  static double square(double x) { return x * x; }

  void choose_target() {
    target_node_ = model().reduction_node;
    r_.to = r_.link;
    if (options_.to.empty()) return;
    const std::string& to = options_.to;
    if (to.ends_with(".slider") || to.ends_with(".rocker")) {
      slider_ = std::make_unique<SliderRatio>(compile(model().scene, rigid_effects()), to.substr(0, to.size() - 7));
      if (!slider_->found() || slider_->rocks() != to.ends_with(".rocker")) refuse_target(model(), to);
      r_.to = to;
      r_.to_output = true;
      r_.to_rocker = slider_->rocks();
      return;
    }
    target_node_ = node_named(model(), to);
    r_.to = to;
    r_.to_ratio = model().node_ratio[at(target_node_)];
  }

  // On the link first; then all inertias over the square of the ratio, all torques over the ratio.
  ReducedPosition position(int number, double phi) {
    machine_.set_modes(phi, r_.speed);
    const RigidMachine::At on_link = machine_.at(phi, r_.speed, true);
    ReducedPosition p;
    p.number = number;
    p.phi = phi;
    double ratio = r_.to_ratio, second = 0;
    if (slider_) {
      const SliderRatio::At x = (*slider_)(phi);
      ratio = x.first, second = x.second;
      p.ratio = ratio;
      if (std::abs(ratio) < 1e-9 * largest_ratio()) {
        p.singular = "dead centre: it stands still, so what is reduced to it is infinite";
        return p;
      }
    }
    const double squared = square(ratio);
    p.inertia = on_link.inertia / squared;
    p.mechanism_inertia = machine_.mechanism_inertia(phi).value / squared;
    p.drive_inertia = machine_.constant_inertia() / squared;
    // By the angle (way) of what all is reduced to: d(I/x′²)/dx = (I′ − 2 I x″/x′)/x′³.
    p.slope = (on_link.slope - 2 * on_link.inertia * second / ratio) / (squared * ratio);
    for (std::size_t k = 0; k < on_link.share.size(); ++k) {
      const double share = on_link.share[k] / ratio;
      p.share.push_back(share);
      (model().accounts[k].kind == Account::driving ? p.drive : p.load) += share;
    }
    p.load = -p.load + 0.0;
    return p;
  }

  double largest_ratio() {
    if (largest_ratio_ == 0)
      for (int k = 0; k < 64; ++k)
        largest_ratio_ = std::max(largest_ratio_, std::abs((*slider_)(turn * (k + 0.3) / 64).first));
    return largest_ratio_;
  }

  // Both sides of every edge are points of the curve.
  void add_curve() {
    constexpr int points = 720;
    std::vector<double> phis;
    for (int k = 0; k <= points; ++k) phis.push_back(r_.cycle * k / points);
    if (machine_.periodic())
      for (const double edge : cycle_edges(machine_)) {
        phis.push_back(edge - 1e-7);
        phis.push_back(edge + 1e-7);
      }
    std::sort(phis.begin(), phis.end());
    for (const double phi : phis) {
      if (phi < 0 || phi > r_.cycle) continue;
      ReducedPosition p = position(0, phi);
      // Near a dead centre the reduced mass leaves the plot.
      if (slider_ && std::abs(*p.ratio) < 0.15 * largest_ratio()) continue;
      r_.curve.push_back(std::move(p));
    }
  }

  void add_spectra() {
    if (!machine_.periodic()) return;
    const MachineCycle c = machine_cycle(machine_, r_.speed);
    const Piecewise inertia = c.mechanism.value + c.mechanism.value.constant(machine_.constant_inertia());
    const int orders = static_cast<int>(std::lround(options_.orders * r_.cycle / turn));
    r_.spectra.push_back(spectrum("reduced inertia I_r", "kg*m2", inertia, orders));
    r_.spectra.push_back(spectrum("driving torque M_d", "N*m", c.drive, orders));
    r_.spectra.push_back(spectrum("resisting torque M_c", "N*m", c.load, orders));
    r_.mean_drive = c.drive.mean();
    r_.mean_load = c.load.mean();
  }

  void add_notes() {
    if (machine_.uses_time()) r_.notes.push_back("some torque depends on time; the torques are those at t = 0");
    if (!machine_.periodic())
      r_.notes.push_back("the machine has no cycle, its parts never come back together; there are no harmonics");
    add_note_on_peaks();
    if (slider_)
      r_.notes.push_back(
          fmt::format("forces on {} count along its way: they drive where they have the sign of its speed x′", r_.to));
    if (slider_) {
      std::string left_out;
      for (const ReducedPosition& p : r_.positions)
        if (!p.singular.empty())
          left_out += fmt::format("{}{} ({:.4g}°)", left_out.empty() ? "" : ", ", p.number, p.phi * 360 / turn);
      if (!left_out.empty())
        r_.notes.push_back(fmt::format(
            "left out: position {}: a dead centre, where {} stands still; {} are infinite there", left_out, r_.to,
            r_.to_rocker ? "reduced inertia I_r/x′² and torque M/x′"
                         : "reduced mass m_r = I_r/x′² and force F_r = M/x′"));
    }
  }

  // Twelve positions may miss a blow that lasts ten degrees.
  void add_note_on_peaks() {
    double seen = 0;
    for (const ReducedPosition& p : r_.positions) seen = std::max(seen, std::abs(p.load));
    const auto peak = std::max_element(r_.curve.begin(), r_.curve.end(), [](const auto& a, const auto& b) {
      return std::abs(a.load) < std::abs(b.load);
    });
    if (peak == r_.curve.end() || std::abs(peak->load) <= 1.05 * seen) return;
    r_.notes.push_back(
        fmt::format("between the positions the resistance reaches {} at {:.5g}°; more --positions show it",
                    with_unit(peak->load, r_.to_output && !r_.to_rocker ? "N" : "N*m"), peak->phi * 360 / turn));
  }

  RigidMachine machine_;
  const ReduceOptions& options_;
  MachineReduction r_;
  int target_node_ = 0;
  std::unique_ptr<SliderRatio> slider_;
  double largest_ratio_ = 0;
};

}  // namespace

int node_named(const Model& model, const std::string& name) {
  const std::size_t dot = name.rfind('.');
  const std::string end = dot == std::string::npos ? "" : name.substr(dot + 1);
  const bool port = end == "in" || end == "out";
  const auto found = model.network.ports.find(port ? name.substr(0, dot) : name);
  if (found == model.network.ports.end()) refuse_target(model, name);
  const Network::Ports& ports = found->second;
  if (!port && ports.in != ports.out)
    throw std::invalid_argument(fmt::format("--to {}: it has two shafts; write {} or {}", in_quotes(name),
                                            in_quotes(name + ".in"), in_quotes(name + ".out")));
  return end == "in" ? ports.in : ports.out;
}

Spectrum spectrum(const std::string& name, const std::string& unit, const Piecewise& f, int orders) {
  Spectrum s{name, unit, {}, 0, 1};
  const double base = turn / f.length();  // order of the first harmonic
  // Integrals of the polynomials times cos, sin: pieces short against the wave are integrated to rounding.
  const int parts = 1 + static_cast<int>(orders * base * f.length() / static_cast<double>(f.pieces()) / 2);
  std::vector<double> breaks;
  for (std::size_t i = 0; i < f.pieces(); ++i)
    for (int k = 0; k < parts; ++k) breaks.push_back(f.breaks()[i] + (f.breaks()[i + 1] - f.breaks()[i]) * k / parts);
  breaks.push_back(f.end());
  const auto mean_of = [&](auto&& factor) {
    std::vector<double> samples;
    for (std::size_t i = 0; i + 1 < breaks.size(); ++i)
      for (std::size_t k = 0; k < Piecewise::nodes; ++k) {
        const double x = breaks[i] + 0.5 * (breaks[i + 1] - breaks[i]) * (1 + Piecewise::node(k));
        samples.push_back(factor(f.value_in(i / at(parts), x), x));
      }
    return Piecewise::through(breaks, samples).mean();
  };
  s.mean_square = mean_of([](double y, double) { return y * y; });
  double sum = 0;
  for (int n = 0; n <= orders; ++n) {
    const double order = n * base, factor = n == 0 ? 1 : 2;
    const double a = factor * mean_of([&](double y, double x) { return y * std::cos(order * x); });
    const double b = factor * mean_of([&](double y, double x) { return y * std::sin(order * x); });
    s.harmonics.push_back({order, n == 0 ? a : std::hypot(a, b), n == 0 ? 0 : std::atan2(b, a)});
    sum += (n == 0 ? 1 : 0.5) * (a * a + b * b);
  }
  s.captured = s.mean_square > 0 ? sum / s.mean_square : 1;
  return s;
}

double Chain::total() const {
  double sum = 0;
  for (const ChainInertia& i : inertias) sum += i.reduced;
  return sum;
}

Chain elastic_chain(const Model& model, int node) {
  const Network& net = model.network;
  const double target = model.node_ratio[at(node)];
  // Nodes that no elastic element parts are one inertia; it is counted on its first node.
  std::vector<int> group(net.nodes.size(), -1);
  Chain chain;
  for (std::size_t first = 0; first < net.nodes.size(); ++first) {
    if (group[first] >= 0) continue;
    const int number = static_cast<int>(chain.inertias.size());
    chain.inertias.push_back({"", 0, model.node_ratio[first] / target, 0, false});
    group[first] = number;
    for (bool grown = true; grown;) {
      grown = false;
      for (const Network::Joint& joint : net.joints) {
        if (joint.element) continue;
        if ((group[at(joint.a)] == number) == (group[at(joint.b)] == number)) continue;
        group[at(joint.a)] = group[at(joint.b)] = number;
        grown = true;
      }
    }
  }
  const auto add = [&](std::size_t n, double inertia, const std::string& label) {
    ChainInertia& i = chain.inertias[at(group[n])];
    const double ratio = model.node_ratio[n] / target;
    i.reduced += inertia * ratio * ratio;
    if (i.ratio == 0) i.own += inertia;  // stands in the usual motion, such as a housing
    if (inertia > 0 && i.name.find(label) == std::string::npos) i.name += (i.name.empty() ? "" : ", ") + label;
  };
  for (std::size_t n = 0; n < net.nodes.size(); ++n)
    add(n, net.nodes[n].inertia, model.node_label(static_cast<int>(n)));
  for (const Network::ShaftElement& e : net.elements)
    if (e.element->cycle > 0) {
      add(at(e.node), e.element->mean_inertia, e.component);
      chain.inertias[at(group[at(e.node)])].mechanism = true;
    }
  for (ChainInertia& i : chain.inertias)
    if (i.ratio != 0) i.own = i.reduced / (i.ratio * i.ratio);
  for (const Network::Joint& joint : net.joints) {
    if (!joint.element) continue;
    const double ratio = model.node_ratio[at(joint.a)] / target, k = joint.element->stiffness,
                 c = joint.element->damping;
    chain.springs.push_back({joint.component, at(group[at(joint.a)]), at(group[at(joint.b)]), k, c, ratio,
                             k * ratio * ratio, c * ratio * ratio});
  }
  return chain;
}

MachineReduction reduce(const Scene& scene, const ReduceOptions& options) {
  const Deadline deadline(scene.run.budget);
  return Reducer(scene, options).run();
}

}  // namespace kurbel
