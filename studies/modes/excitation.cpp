// excitation.cpp — samples the elements over the cycle at uniform speed, with the pieces of their laws that hold there.
#include "studies/modes/excitation.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <unsupported/Eigen/FFT>

#include "engine/events/equations.h"
#include "engine/numerics/index.h"
#include "engine/rigid/rigid_machine.h"

namespace kurbel {
namespace {

constexpr double pi = std::numbers::pi;
constexpr std::size_t many_shafts = 500;

// Coordinate and gain of what an element sits on.
struct Place {
  int coordinate;
  double gain;
};
Place place_of(const LinearDrive& drive, int node) {
  const Model& m = *drive.model;
  return {drive.coordinate[at(m.shaft_of_node[at(node)])], m.gain_of_node[at(node)]};
}

// Harmonics of every element of an angle at one speed. Samples lie half a step off the round angles of edges.
std::vector<std::vector<Complex>> sampled(const LinearDrive& drive, const std::vector<std::size_t>& elements,
                                          double cycle, double speed, std::size_t samples, std::size_t harmonics) {
  Equations equations(drive.model, false);
  std::vector<std::vector<double>> torque(elements.size(), std::vector<double>(samples));
  const double step = cycle / static_cast<double>(samples), sign = speed < 0 ? -1 : 1;
  for (std::size_t k = 0; k < samples; ++k) {
    const double phi = sign * (static_cast<double>(k) + 0.5) * step;
    const Snapshot& s = equations.snapshot(0, equations.modes_from_scratch(0, phi, speed));
    for (std::size_t e = 0; e < elements.size(); ++e) torque[e][k] = s.sums.element_torque[elements[e]];
  }
  std::vector<std::vector<Complex>> result;
  for (const std::vector<double>& t : torque) {
    std::vector<Complex> all = harmonics_of(t);
    all.resize(harmonics + 1);
    for (std::size_t r = 1; r <= harmonics; ++r)
      all[r] *= std::polar(1.0, -pi * static_cast<double>(r) / static_cast<double>(samples));
    result.push_back(std::move(all));
  }
  return result;
}

// T = a + bΩ + cΩ² through three speeds.
OrderSource through(const std::vector<Complex>& t1, const std::vector<Complex>& t2, const std::vector<Complex>& t3,
                    const double (&w)[3]) {
  OrderSource source;
  for (std::size_t r = 0; r < t1.size(); ++r) {
    const Complex first = (t2[r] - t1[r]) / (w[1] - w[0]), second = (t3[r] - t2[r]) / (w[2] - w[1]);
    const Complex c = (second - first) / (w[2] - w[0]);
    const Complex b = first - c * (w[0] + w[1]);
    source.c.push_back(c);
    source.b.push_back(b);
    source.a.push_back(t1[r] - w[0] * (b + w[0] * c));
  }
  return source;
}

void find_orders(const LinearDrive& drive, double fastest, double highest_order, Excitations& found) {
  const Model& m = *drive.model;
  const CyclePeriod cycle = cycle_of(m);
  found.fundamental = 2 * pi / cycle.angle;
  found.harmonics = static_cast<std::size_t>(std::max(1.0, std::floor(highest_order / found.fundamental + 1e-9)));
  std::vector<std::size_t> elements;
  for (std::size_t e = 0; e < m.network.elements.size(); ++e)
    if (m.network.elements[e].element->is.uses_angle) elements.push_back(e);
  if (elements.empty()) return;
  if (!cycle.periodic)
    found.notes.push_back(
        "no multiple of a turn is a period of all that depends on an angle: orders are those of the "
        "reduction link's own cycle, and what does not fit it is smeared over them");
  std::size_t samples = m.shafts.size() > many_shafts ? 1024 : 4096;
  while (samples < 8 * found.harmonics) samples *= 2;
  const double w[3] = {fastest / 3, fastest * 2 / 3, fastest};
  std::vector<std::vector<Complex>> t[3];
  for (int i = 0; i < 3; ++i) t[i] = sampled(drive, elements, cycle.angle, w[i], samples, found.harmonics);
  const double check = 0.5 * fastest;
  const auto checked = sampled(drive, elements, cycle.angle, check, samples, found.harmonics);
  double largest = 0, misfit = 0;
  for (std::size_t e = 0; e < elements.size(); ++e) {
    const Network::ShaftElement& element = m.network.elements[elements[e]];
    const Place place = place_of(drive, element.node);
    OrderSource source = through(t[0][e], t[1][e], t[2][e], w);
    source.component = element.component;
    source.coordinate = place.coordinate;
    for (std::size_t r = 1; r <= found.harmonics; ++r) {
      largest = std::max(largest, std::abs(t[2][e][r]));
      misfit = std::max(misfit, std::abs(source.at(r, check) - checked[e][r]));
    }
    for (auto* list : {&source.a, &source.b, &source.c})
      for (Complex& x : *list) x *= place.gain;
    if (place.coordinate >= 0) found.by_order.push_back(std::move(source));
  }
  found.misfit = largest > 0 ? misfit / largest : 0;
  if (found.misfit > 1e-3)
    found.notes.push_back(
        fmt::format("torques over the cycle are no quadratic function of the speed: at half of the "
                    "fastest speed the orders are off by up to {:.1g} of the largest",
                    found.misfit));
}

void find_frequencies(const LinearDrive& drive, Excitations& found) {
  const Model& m = *drive.model;
  for (const Section& section : m.scene.components) {
    if (!section.kind || section.kind->name != "torque source" || !m.network.ports.contains(section.name)) continue;
    const Place place = place_of(drive, m.network.ports.at(section.name).in);
    if (place.coordinate < 0) continue;
    if (const double amplitude = section.number_or("amplitude", 0); amplitude != 0)
      // A sin(ωt + ψ) = Re(−i A e^{iψ} e^{iωt})
      found.by_frequency.push_back({section.name, place.coordinate, 2 * pi * section.number("frequency"),
                                    place.gain * amplitude * std::polar(1.0, section.number("phase") - pi / 2)});
    if (section.has("table") && section["table"].curve.over == "time" && section["table"].curve.period > 0) {
      const CurveData& data = section["table"].curve;
      const Curve curve(data.x, data.y, data.form, data.period);
      std::vector<double> samples(1024);
      for (std::size_t k = 0; k < samples.size(); ++k)
        samples[k] = curve.value(data.period * static_cast<double>(k) / 1024);
      const std::vector<Complex> all = harmonics_of(samples);
      for (std::size_t r = 1; r <= 64; ++r)
        if (std::abs(all[r]) > 1e-6 * curve.max_abs())
          found.by_frequency.push_back(
              {section.name, place.coordinate, 2 * pi * static_cast<double>(r) / data.period, place.gain * all[r]});
    }
  }
  for (const Network::Node& node : m.network.nodes)
    if (node.prescribed >= 0 && m.network.prescribed[at(node.prescribed)].amplitude != 0)
      found.notes.push_back(
          fmt::format("the ripple of the prescribed speed \"{}\" is no torque and is not counted "
                      "among the excitations",
                      node.component));
}

// Teeth of the driving wheel times the speed of its shaft, stage by stage.
void find_meshes(const LinearDrive& drive, Excitations& found) {
  const Model& m = *drive.model;
  for (const Section& section : m.scene.components) {
    if (!section.kind || section.kind->name != "gearbox" || !section.has("stages")) continue;
    double ratio = m.scale_ratio[at(m.network.ports.at(section.name).in)];
    int k = 0;
    for (const Section& stage : section["stages"].sections) {
      if (!stage.has("teeth") || stage["teeth"].numbers.size() != 2) continue;
      const std::vector<double>& teeth = stage["teeth"].numbers;
      found.meshes.push_back(
          {fmt::format("{}, stage {}: {:g}/{:g} teeth", section.name, ++k, teeth[0], teeth[1]), teeth[0] * ratio});
      ratio *= teeth[0] / teeth[1];
    }
  }
}

}  // namespace

std::vector<Complex> harmonics_of(const std::vector<double>& samples) {
  Eigen::FFT<double> fft;
  std::vector<Complex> spectrum;
  fft.fwd(spectrum, samples);
  spectrum.resize(samples.size() / 2 + 1);
  for (Complex& x : spectrum) x *= 2.0 / static_cast<double>(samples.size());
  spectrum.front() *= 0.5;
  spectrum.back() *= 0.5;
  return spectrum;
}

double Excitations::strength(std::size_t harmonic, double speed) const {
  double sum = 0;
  for (const OrderSource& source : by_order) sum += std::abs(source.at(harmonic, speed));
  return sum;
}

Excitations find_excitations(const LinearDrive& drive, double fastest, double highest_order) {
  Excitations found;
  find_orders(drive, fastest, highest_order, found);
  find_frequencies(drive, found);
  find_meshes(drive, found);
  return found;
}

std::vector<double> mean_beyond_start(const LinearDrive& drive, const Excitations& excitations) {
  std::vector<double> added(drive.model->shafts.size(), 0.0);
  for (const FrequencySource& source : excitations.by_frequency)
    added[at(drive.shaft[at(source.coordinate)])] -= source.amplitude.real();
  return added;
}

std::vector<double> mean_of_angle(const LinearDrive& drive, const Excitations& excitations, double speed) {
  std::vector<double> mean(drive.model->shafts.size(), 0.0);
  for (const OrderSource& source : excitations.by_order)
    mean[at(drive.shaft[at(source.coordinate)])] += source.at(0, speed).real();
  return mean;
}

std::vector<double> inertia_variation(const LinearDrive& drive, const Eigen::VectorXd& shape, std::size_t harmonics) {
  const Model& m = *drive.model;
  const CyclePeriod cycle = cycle_of(m);
  std::size_t samples = 1024;
  while (samples < 8 * harmonics) samples *= 2;
  std::vector<double> modal(samples, 0.0);
  for (const Network::ShaftElement& e : m.network.elements) {
    const Place place = place_of(drive, e.node);
    if (e.element->cycle == 0 || place.coordinate < 0) continue;
    const double weight = std::pow(place.gain * shape[place.coordinate], 2), ratio = m.node_ratio[at(e.node)];
    for (std::size_t k = 0; k < samples; ++k) {
      const double phi = cycle.angle * static_cast<double>(k) / static_cast<double>(samples);
      modal[k] += weight * e.element->inertia_at(ratio * phi + e.phase).value;
    }
  }
  const std::vector<Complex> all = harmonics_of(modal);
  std::vector<double> result(harmonics + 1, 0.0);
  for (std::size_t r = 1; r <= harmonics; ++r) result[r] = std::abs(all[r]);
  return result;
}

}  // namespace kurbel
