// torque_history.cpp — runs the scene, reads the torque from its samples, and analyses it.
#include "studies/history/torque_history.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "engine/numerics/angles.h"
#include "studies/run/simulate.h"

namespace kurbel {
namespace {

constexpr std::size_t lines_reported = 6;

// Twenty samples a period of the highest frequency [rad/s], within reason.
Scene recorded(Scene scene, const HistoryWanted& wanted, const std::string& component) {
  const double samples = std::clamp(20 * (wanted.highest / (2 * pi)) * scene.run.until, 4096.0, 131072.0);
  scene.run.samples = static_cast<int>(samples);
  scene.run.output = {component};
  if (wanted.link != component) scene.run.output.push_back(wanted.link);
  return scene;
}

// Samples of the first of these channels that exists.
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

// Every second one, the last among them.
std::vector<double> every_second(const std::vector<double>& values) {
  std::vector<double> thinned;
  for (std::size_t i = (values.size() + 1) % 2; i < values.size(); i += 2) thinned.push_back(values[i]);
  return thinned;
}

// Bound on how far a smooth quantity exceeds the samples about its greatest (sense = 1) or least one (−1): the
// parabola through three has its vertex within half a step of the middle one, at most |second difference|/8 away.
double hidden(const std::vector<double>& values, double sense) {
  const auto less = [sense](double a, double b) { return sense * a < sense * b; };
  const auto i = static_cast<std::size_t>(std::max_element(values.begin(), values.end(), less) - values.begin());
  if (i == 0 || i + 1 == values.size()) return 0;
  return std::abs(values[i - 1] - 2 * values[i] + values[i + 1]) / 8;
}

// The run locates its peak on the continuous solution; the other extreme is taken from the samples.
void find_extremes(TorqueHistory& h, const Figure* peak) {
  const auto [low, high] = std::minmax_element(h.value.begin(), h.value.end());
  h.greatest = {*high, h.run_error};
  h.least = {*low, h.run_error};
  if (h.run_error) h.greatest.widen(hidden(h.value, 1)), h.least.widen(hidden(h.value, -1));
  if (!peak) return;
  // A later value that is larger by rounding belongs to the same peak.
  const double most = std::abs(peak->value);
  h.greatest.value = std::min(h.greatest.value, most);
  h.least.value = std::max(h.least.value, -most);
  (peak->value > 0 ? h.greatest : h.least) = *peak;
}

// Closed load cycles of the samples, and of the peak between them.
std::vector<LoadCycle> cycles_of(const TorqueHistory& h, const std::vector<double>& values, const Figure* peak) {
  std::vector<double> loads = values;
  if (peak && peak->at && h.time.back() > h.time.front()) {
    const double place = (*peak->at - h.time.front()) / (h.time.back() - h.time.front());
    const double after = std::ceil(std::clamp(place, 0.0, 1.0) * static_cast<double>(loads.size() - 1));
    loads.insert(loads.begin() + static_cast<std::ptrdiff_t>(after), peak->value);
  }
  std::vector<LoadCycle> cycles = rainflow(loads, h.resolution);
  std::sort(cycles.begin(), cycles.end(), [](const LoadCycle& a, const LoadCycle& b) { return a.range > b.range; });
  return cycles;
}

void count_cycles(TorqueHistory& h, const Figure* peak) {
  h.cycles = cycles_of(h, h.value, peak);
  h.equivalent_amplitude = {equivalent_amplitude(h.cycles, load_exponent), h.run_error};
  const double coarse = equivalent_amplitude(cycles_of(h, every_second(h.value), peak), load_exponent);
  if (h.run_error) h.equivalent_amplitude.widen_to({coarse}, 2);
}

std::vector<double> over_turns(std::vector<double> angle, const std::vector<double>& values, double turns) {
  if (angle.back() < angle.front())
    for (double& a : angle) a = -a;
  return resampled_over_angle(angle, values, 2 * pi * turns);
}

// Orders of the link's rotation; the change with half as many samples counts as error, too.
void find_orders(TorqueHistory& h) {
  constexpr double turns = 1.0 / 64;
  const std::vector<double> resampled = over_turns(h.angle, h.value, turns);
  if (resampled.size() < 16) return;
  h.orders = spectrum_of(resampled, turns);
  h.strongest_orders = strongest_lines(resampled, turns, lines_reported);
  const std::vector<double> coarse = over_turns(every_second(h.angle), every_second(h.value), turns);
  if (coarse.size() < 16) return;
  widen_errors(h.strongest_orders, spectrum_of(coarse, turns));
}

// Frequencies over the whole run and along it, orders over the link's turns, closed load cycles by their range.
void take_apart(TorqueHistory& h, const Figure* peak) {
  const double step = (h.time.back() - h.time.front()) / static_cast<double>(h.time.size() - 1);
  find_extremes(h, peak);
  h.spectrum = spectrum_of(h.value, step);
  h.strongest = strongest_lines(h.value, step, lines_reported);
  widen_errors(h.strongest, spectrum_of(every_second(h.value), 2 * step));
  h.lines = waterfall(h.time, h.speed, h.value, 12);
  find_orders(h);
  count_cycles(h, peak);
}

}  // namespace

TorqueHistory simulate_torque(const Scene& scene, const Effects& effects, const HistoryWanted& wanted) {
  const std::string component = wanted.torque.substr(0, wanted.torque.find('.'));
  if (!scene.find(component))
    throw std::invalid_argument(fmt::format("--torque {}: no such component in the scene", wanted.torque));
  SimulateOptions options;
  options.watch = wanted.watch;
  const Result result = simulate(recorded(scene, wanted, component), effects, "elastic", options);
  const auto samples = [&](const QuantityKind& what, const std::string& of, const std::string& part) {
    return column(*result.trajectory, {Name::make(what, of), Name::make(what, of + part)}, wanted.torque);
  };
  TorqueHistory history;
  history.component = wanted.torque;
  history.channel = Name::make(quantities::torque, wanted.torque).text;
  history.time = result.trajectory->time();
  history.value = samples(quantities::torque, wanted.torque, ".1");
  history.speed = samples(quantities::speed, wanted.link, ".in");
  history.angle = samples(quantities::angle, wanted.link, ".in");
  history.complete = result.complete;
  history.diagnosis = result.diagnosis;
  const Figure* peak = result.find(quantities::peak_torque, wanted.torque);
  if (!peak) peak = result.find(quantities::peak_torque, wanted.torque + ".1");
  double largest = 0;
  for (const double v : history.value) largest = std::max(largest, std::abs(v));
  if (peak)
    history.run_error = peak->error;
  else if (result.errors_measured)
    history.run_error = result.measured_accuracy * largest;
  history.resolution = 2 * history.run_error.value_or(result.accuracy * largest);
  if (history.time.size() >= 64) take_apart(history, peak);
  for (auto* lines : {&history.strongest, &history.strongest_orders})
    for (SpectralLine& line : *lines)
      history.run_error ? line.amplitude.widen(2 * *history.run_error) : line.amplitude.error.reset();
  return history;
}

}  // namespace kurbel
