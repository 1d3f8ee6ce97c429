// joint_loads.cpp — integrates one more period of the steady motion; integrals by Gauss's rule within every step.
#include "studies/limits/joint_loads.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <numbers>
#include <stdexcept>

#include "drivetrain/couplings/coupling_keys.h"
#include "engine/base/find_by.h"
#include "engine/base/gauss.h"
#include "engine/numerics/index.h"
#include "engine/numerics/lobatto_element.h"
#include "engine/orbit/follow_period.h"
#include "engine/values/dense_tables.h"

namespace kurbel {
namespace {

DriveLimits stated_limits(const ComponentData& data, const std::string& component) {
  if (const auto* given = data.find<CouplingLimits>(component)) return {*given};
  const auto* shaft = data.find<ShaftKeys>(component);
  if (!shaft) return {};
  DriveLimits limits{{.application_factor = shaft->application_factor}};
  if (!shaft->judges_stress()) return limits;
  limits.shear_stress = shaft->allowable_shear_stress.value_or(0);
  limits.polar_modulus = shaft->polar_modulus(), limits.diameter = *shaft->diameter;
  limits.shaft = shaft->rating;
  return limits;
}

using std::numbers::pi;
using Complex = std::complex<double>;

constexpr double fine = 1e-11, loose = 1e-9;  // tolerances of the two passes
constexpr double rounding = 1e-10;            // of the rated torque
constexpr std::size_t harmonics = 96;         // of a cycle; what is above counts with the next one's frequency

double link_speed(const Model& m, const Snapshot& s) {
  const TrackedAngle& link = m.angles[at(m.reduction_angle)];
  return link.gain * s.now.speed[link.shaft];
}

// ∫τ dt, ∫τ² dt and ∫τ e^{−inωt} dt of joints, and the link's speed.
class Integrals final : public Observer {
 public:
  Integrals(const Model& m, const std::vector<LimitedJoint>& joints, double begin, double round)
      : m_(m), joints_(joints), begin_(begin), round_(round), sums_(joints.size()) {}

  struct Sums {
    double first = 0, square = 0;
    std::array<Complex, harmonics + 1> vibratory = {};
  };
  const std::vector<Sums>& sums() const { return sums_; }
  double turned() const { return turned_; }
  double slowest() const { return slowest_; }

  // Intervals in which the highest harmonic turns by at most half a turn.
  void step(StepView& view) override {
    const double a = view.t_previous(), h = view.t() - a;
    const int pieces = 1 + static_cast<int>(2 * harmonics * h / round_);
    for (int p = 0; p < pieces; ++p)
      gauss<6>.over(a + h * p / pieces, h / pieces, [&](double t, double weight) { add(t, view.snapshot(t), weight); });
  }

 private:
  void add(double t, const Snapshot& s, double weight) {
    const double omega = link_speed(m_, s);
    turned_ += weight * omega;
    slowest_ = std::min(slowest_, std::abs(omega));
    const Complex turn = std::polar(1.0, -2 * pi * (t - begin_) / round_);
    for (std::size_t i = 0; i < joints_.size(); ++i) {
      const double torque = joints_[i].reported(s.joint_torque, joints_[i].joint);
      Sums& sum = sums_[i];
      sum.first += weight * torque;
      sum.square += weight * torque * torque;
      Complex phase = turn;
      for (std::size_t n = 1; n <= harmonics; ++n, phase *= turn) sum.vibratory[n] += weight * torque * phase;
    }
  }

  const Model& m_;
  const std::vector<LimitedJoint>& joints_;
  double begin_, round_;
  std::vector<Sums> sums_;
  double turned_ = 0, slowest_ = HUGE_VAL;
};

// S_f and the strongest frequency of an alternating torque; the part above the harmonics (Parseval) counts as just above.
void add_frequencies(const Integrals::Sums& sums, double time, double noise, JointLoad& load) {
  const double mean = sums.first / time, rounded = 1e-12 * mean * mean;
  const double all = std::max(0.0, 2 * (sums.square / time - mean * mean));
  double known = 0, weighted = 0, strongest = 0;
  for (std::size_t n = 1; n <= harmonics; ++n) {
    const double f = static_cast<double>(n) / time, square = std::norm(2.0 * sums.vibratory[n] / time);
    known += square;
    weighted += square * std::max(1.0, f / 10);
    if (square > strongest) strongest = square, load.frequency = f;
  }
  const double rest = all - known > rounded ? all - known : 0;
  weighted += rest * std::max(1.0, (harmonics + 1) / time / 10);
  const double sum = known + rest;
  load.frequency_factor = sum > noise * noise ? std::sqrt(weighted / sum) : 1;
  if (!(sum > noise * noise)) load.frequency = 0;  // it does not vibrate
}

// One period from a fixed point.
SteadyLoads follow(const ReturnMap& map, const SteadyPoint& point, const std::vector<LimitedJoint>& joints,
                   double tolerance) {
  const Model& m = map.model();
  Equations equations(map.shared_model(), true);
  std::vector<ExtremeOf> wanted;
  for (const LimitedJoint& joint : joints)
    for (const auto which : {Functional::greatest, Functional::least})
      wanted.push_back(torque_extreme(m, joint, which));
  ExtremeRecorder extremes(std::move(wanted));
  Integrals integrals(m, joints, map.start_time(), point.time);
  const RunOutcome outcome = follow_period(map, point, equations, {.tolerance = tolerance}, {&extremes, &integrals});
  if (!outcome.diagnosis.empty()) return {.words = outcome.diagnosis};
  SteadyLoads loads{.found = true};
  const double time = loads.round = outcome.t - map.start_time();
  loads.speed = integrals.turned() / time, loads.slowest = integrals.slowest();
  for (std::size_t i = 0; i < joints.size(); ++i) {
    JointLoad load;
    load.mean.value = integrals.sums()[i].first / time;
    load.upper.value = std::max(extremes.found()[2 * i].value, load.mean.value);
    load.lower.value = std::min(extremes.found()[2 * i + 1].value, load.mean.value);
    load.vibratory.value = std::max(load.upper.value - load.mean.value, load.mean.value - load.lower.value);
    add_frequencies(integrals.sums()[i], time, 1e-8 * joints[i].rated, load);
    load.weighted.value = load.frequency_factor * load.vibratory.value;
    if (joints[i].loss_account >= 0)
      load.power.value = -outcome.state[equations.work_index(at(joints[i].loss_account))] / time;
    loads.joints.push_back(load);
  }
  return loads;
}

// The same with tolerances 100 × looser.
SteadyLoads follow_loosely(const Orbit& orbit, const std::vector<LimitedJoint>& joints) {
  const SteadyTwin twin = looser_twin(*orbit.map, orbit.point, loose);
  return twin.point.found ? follow(*twin.map, twin.point, joints, loose) : SteadyLoads{};
}

constexpr std::array<Estimate JointLoad::*, 6> measured = {&JointLoad::mean,     &JointLoad::upper,
                                                           &JointLoad::lower,    &JointLoad::vibratory,
                                                           &JointLoad::weighted, &JointLoad::power};

// `open`: fraction of the rated torque left uncertain by the search or by dense tables.
void add_errors(const SteadyLoads& other, double open, const std::vector<LimitedJoint>& joints, SteadyLoads& loads) {
  for (std::size_t i = 0; i < loads.joints.size(); ++i)
    for (const auto what : measured) {
      Estimate& value = loads.joints[i].*what;
      const double scale = what == &JointLoad::power ? std::abs(value.value) : joints[i].rated;
      value.error = (rounding + open) * std::max(scale, std::abs(value.value));
      // Without a second one the error of the figure is the accuracy of the search.
      value.widen(other.found ? std::abs(value.value - (other.joints[i].*what).value) : 1e-4 * std::abs(value.value));
    }
}

// All speeds are constant and nothing repeats: the torques of that moment.
SteadyLoads constant_loads(const Orbit& orbit, const std::shared_ptr<const Model>& machine,
                           const std::vector<LimitedJoint>& joints) {
  Equations equations(machine, false);
  equations.bind(orbit.state.modes);
  const Snapshot& s = equations.snapshot(orbit.state.t, orbit.state.y);
  SteadyLoads loads{.found = true};
  loads.speed = link_speed(*machine, s), loads.slowest = std::abs(loads.speed);
  for (const LimitedJoint& joint : joints) {
    JointLoad load;
    load.mean.value = load.upper.value = load.lower.value = joint.reported(s.joint_torque, joint.joint);
    loads.joints.push_back(load);
  }
  return loads;
}

}  // namespace

std::vector<std::string> names_of_joints(const Model& model) {
  std::vector<std::string> names = model.joint_names();
  for (std::size_t j = 0; j < names.size(); ++j) {
    const Network::Joint& joint = model.network.joints[at(model.elastic[j].joint)];
    if (joint.chain >= 0 && names[j] != joint.component)
      names[j] = joint.component + ", segment " + names[j].substr(joint.component.size() + 1);
  }
  return names;
}

std::vector<std::string> names_of_nodes(const Model& model) {
  std::vector<std::string> names;
  for (std::size_t n = 0; n < model.network.nodes.size(); ++n) names.push_back(model.node_label(static_cast<int>(n)));
  for (const Network::Chain& chain : model.network.chains) {
    const auto* shaft = model.network.data.find<ShaftKeys>(chain.component);
    const std::size_t parts = chain.nodes.size() - 1;
    for (std::size_t i = 1; i < parts; ++i) {
      const double place = chain.degree > 0 ? lobatto_element(chain.degree).place[i]
                                            : static_cast<double>(i) / static_cast<double>(parts);
      names[at(chain.nodes[i])] = chain.component + ", station at " +
                                  (shaft && shaft->length ? fmt::format("{:.4g} m", place * *shaft->length)
                                                          : fmt::format("{:.3g} % of its length", 100 * place));
    }
  }
  return names;
}

std::vector<LimitedJoint> limited_joints(const Model& model) {
  const std::vector<std::string> names = names_of_joints(model);
  std::vector<LimitedJoint> joints;
  for (const ElasticJoint& e : model.elastic) {
    const Network::Joint& joint = model.network.joints[at(e.joint)];
    LimitedJoint one{.name = names[joints.size()], .component = joint.component, .joint = e.joint};
    for (const TorqueJoint& known : model.torque_joints)
      if (known.joint == e.joint) one.reported = known.reported;
    one.stands = model.node_ratio[at(joint.a)] == 0;
    one.rated = model.torque_scale / model.scale_ratio[at(joint.a)];
    one.turns = std::abs(model.node_ratio[at(joint.a)]);
    one.loss_account = e.loss_account;
    one.beside_middle = joint.element->row && one.name != one.component;
    if (!one.beside_middle) {
      one.limits = stated_limits(model.network.data, joint.component);
      one.has_play = model.network.data.find<StatedPlay>(joint.component) != nullptr;
    }
    joints.push_back(std::move(one));
  }
  return joints;
}

std::vector<LimitedJoint> joints_of(const Model& other, const std::vector<LimitedJoint>& joints) {
  const std::vector<LimitedJoint> known = limited_joints(other);
  std::vector<LimitedJoint> found;
  for (const LimitedJoint& joint : joints) {
    const auto* const same = find_by(known, &LimitedJoint::name, joint.name);
    if (!same)
      throw std::logic_error(fmt::format("\"{}\" is elastic with some effects, and with others not", joint.name));
    found.push_back(*same);
  }
  return found;
}

bool any_limits(const std::vector<LimitedJoint>& joints) {
  return std::any_of(joints.begin(), joints.end(), [](const LimitedJoint& j) { return j.limits.any(); });
}

ExtremeOf torque_extreme(const Model& machine, const LimitedJoint& joint, Functional functional) {
  const int j = joint.joint;
  ExtremeOf extreme{.name = Name::make(quantities::peak_torque, joint.name),
                    .unit = "N*m",
                    .scale = joint.rated,
                    .value = [j](const Snapshot& s) { return s.joint_torque[j]; },
                    .rate = {}};
  for (const TorqueJoint& known : machine.torque_joints)
    if (known.joint == j)
      for (ExtremeOf& e : extremes_of(machine))
        if (e.name == Name::make(quantities::peak_torque, known.component)) extreme = std::move(e);
  extreme.functional = functional;
  return extreme;
}

SteadyLoads steady_loads(const Orbit& orbit, const std::shared_ptr<const Model>& machine,
                         const std::vector<LimitedJoint>& joints) {
  if (orbit.repeats()) {
    SteadyLoads loads = follow(*orbit.map, orbit.point, joints, fine);
    if (!loads.found) return loads;
    add_errors(follow_loosely(orbit, joints),
               (orbit.polished ? 0 : orbit.still_changes) + left_by_tables(machine->scene), joints, loads);
    return loads;
  }
  // A machine that comes to rest does its work before: that is no lasting load.
  if (orbit.kind != Orbit::Kind::equilibrium) return {.words = orbit.words};
  SteadyLoads loads = constant_loads(orbit, machine, joints);
  add_errors(loads, 1e-9, joints, loads);
  return loads;
}

}  // namespace kurbel
