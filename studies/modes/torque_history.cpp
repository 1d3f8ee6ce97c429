// torque_history.cpp — runs the scene, reads the torque off its samples, and takes it apart.
#include "studies/modes/torque_history.h"

#include <fmt/format.h>

#include <algorithm>
#include <numbers>
#include <stdexcept>

#include "engine/numerics/index.h"
#include "studies/run/simulate.h"

namespace kurbel {
namespace {

constexpr double pi = std::numbers::pi;

SimulateOptions simulate_options(const ModesOptions& asked) {
  SimulateOptions options;
  options.measure_error = false;
  options.watch = asked.watch;
  options.watch.progress = [&asked](const std::string& what, double f) { asked.watch.at(what, 0.8 + 0.2 * f); };
  return options;
}

// Enough samples for twice the highest frequency [rad/s], within reason.
Scene recorded(Scene scene, double highest, const std::string& component, const std::string& link) {
  const double wanted = std::clamp(5 * (highest / (2 * pi)) * scene.run.until, 4096.0, 131072.0);
  scene.run.samples = static_cast<int>(wanted);
  scene.run.output = {component};
  if (link != component) scene.run.output.push_back(link);
  return scene;
}

// Samples of the first of these channels that is there.
std::vector<double> column(const TrajectoryRecorder& t, const std::vector<Name>& names, const std::string& asked) {
  for (const Name& name : names)
    for (std::size_t k = 0; k < t.channels().size(); ++k)
      if (t.channels()[k].name == name) {
        std::vector<double> values;
        for (std::size_t row = 0; row < t.time().size(); ++row) values.push_back(t.value(row, k));
        return values;
      }
  throw std::invalid_argument(fmt::format(
      "--torque {}: the component carries no torque that is recorded; give a coupling, shaft, motor or load", asked));
}

// Frequencies over the whole run and along it, orders over the link's turns, closed load cycles by their range.
void take_apart(TorqueHistory& history) {
  const double step = (history.time.back() - history.time.front()) / static_cast<double>(history.time.size() - 1);
  history.spectrum = spectrum_of(history.value, step);
  history.lines = waterfall(history.time, history.speed, history.value, 12);
  const double turns = 1.0 / 64;
  std::vector<double> forwards = history.angle;
  if (forwards.back() < forwards.front())
    for (double& a : forwards) a = -a;
  const std::vector<double> resampled = resampled_over_angle(forwards, history.value, 2 * pi * turns);
  if (resampled.size() >= 16) history.orders = spectrum_of(resampled, turns);
  history.cycles = rainflow(history.value);
  std::sort(history.cycles.begin(), history.cycles.end(),
            [](const LoadCycle& a, const LoadCycle& b) { return a.range > b.range; });
  history.greatest = *std::max_element(history.value.begin(), history.value.end());
  history.least = *std::min_element(history.value.begin(), history.value.end());
}

}  // namespace

TorqueHistory simulate_torque(const Model& model, const Effects& effects, double highest, const ModesOptions& options) {
  const std::string component = options.torque.substr(0, options.torque.find('.'));
  if (!model.scene.find(component))
    throw std::invalid_argument(fmt::format("--torque {}: no such component in the scene", options.torque));
  const std::string link = model.network.nodes[at(model.reduction_node)].component;
  const Result result =
      simulate(recorded(model.scene, highest, component, link), effects, "elastic", simulate_options(options));
  const auto samples = [&](QuantityKind what, const std::string& of, const std::string& part) {
    return column(*result.trajectory, {Name::make(what, of), Name::make(what, of + part)}, options.torque);
  };
  TorqueHistory history;
  history.component = options.torque;
  history.channel = Name::make(QuantityKind::torque, options.torque).text;
  history.time = result.trajectory->time();
  history.value = samples(QuantityKind::torque, options.torque, ".1");
  history.speed = samples(QuantityKind::speed, link, ".in");
  history.angle = samples(QuantityKind::angle, link, ".in");
  history.complete = result.complete;
  history.diagnosis = result.diagnosis;
  if (history.time.size() >= 64) take_apart(history);
  return history;
}

}  // namespace kurbel
