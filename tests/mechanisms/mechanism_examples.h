// mechanism_examples.h — slider-cranks that the tests share.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "tests/mechanisms/slider_crank_geometry.h"

namespace kurbel {

// The reference machine of the accuracy-versus-time problems: r = 0.1 m, l = 0.35 m, crank balanced on its axis.
inline SliderCrankData reference_mechanism() {
  SliderCrankData d;
  d.radius = 0.10;
  d.rod_length = 0.35;
  d.crank_inertia = 0.55;
  d.rod_mass = 2;
  d.rod_com = 0.1225;
  d.rod_inertia = 0.020;
  d.slider_mass = 3;
  return d;
}

// All effects on: offset [m], counterweight, weights, an inclined stroke; l = ratio (r + |e|).
inline SliderCrankData full_mechanism(double ratio, double offset) {
  SliderCrankData d = reference_mechanism();
  d.offset = offset;
  d.rod_length = ratio * (d.radius + std::fabs(offset));
  d.rod_com = 0.35 * d.rod_length;
  d.crank_mass = 5;
  d.crank_com = -0.03;
  d.gravity = 9.80665;
  d.stroke_angle = 0.7;
  return d;
}

// Anything valid: l/(r + |e|) from 1.001 to 10, every mass absent now and then.
inline SliderCrankData random_mechanism(std::mt19937& random) {
  const auto uniform = [&](double from, double to) { return std::uniform_real_distribution<double>(from, to)(random); };
  const auto sometimes_zero = [&](double value) { return uniform(0, 1) < 0.25 ? 0.0 : value; };
  SliderCrankData d;
  d.radius = std::exp(uniform(std::log(0.01), std::log(1.0)));
  d.offset = sometimes_zero(uniform(-0.5, 0.5) * d.radius);
  d.rod_length = (d.radius + std::fabs(d.offset)) * (1 + std::exp(uniform(std::log(1e-3), std::log(9.0))));
  d.crank_mass = sometimes_zero(uniform(0.1, 20));
  d.crank_com = sometimes_zero(uniform(-1, 1) * d.radius);
  d.crank_inertia = d.crank_mass * d.crank_com * d.crank_com + sometimes_zero(uniform(0.1, 5) * d.radius * d.radius);
  d.rod_mass = sometimes_zero(uniform(0.1, 10));
  d.rod_com = uniform(-0.2, 1.2) * d.rod_length;
  d.slider_mass = sometimes_zero(uniform(0.1, 10));
  d.rod_inertia = d.rod_mass + d.slider_mass > 0 ? sometimes_zero(uniform(0.01, 1) * d.rod_length * d.rod_length) : 0;
  d.gravity = sometimes_zero(9.80665);
  d.stroke_angle = uniform(-3.2, 3.2);
  return d;
}

// The closed form in long double at one angle, in the order of ReducedMechanism's channels.
constexpr int channels = 8;
struct Truth {
  explicit Truth(const SliderCrankGeometry& geometry, double phi) {
    const auto exact = static_cast<long double>(phi);
    const auto inertia = geometry.inertia(exact), slider = geometry.slider(exact);
    const auto weight = geometry.gravity_torque(exact);
    const long double all[channels] = {inertia.value, inertia.slope,    inertia.curvature, slider.value,
                                       slider.slope,  slider.curvature, weight.value,      weight.slope};
    std::copy(all, all + channels, value);
  }
  long double value[channels];
};

// Largest magnitude of each channel over the period; angles crowd where the rod is steepest.
struct Maxima {
  explicit Maxima(const SliderCrankGeometry& geometry) {
    for (int i = 0; i < 600; ++i) {
      const double u = i / 300.0 - 1;  // −1 … 1
      for (const double phi : {std::numbers::pi * (1 + u), std::numbers::pi / 2 * (1 + u * u * u * u * u),
                               std::numbers::pi / 2 * (3 + u * u * u * u * u)}) {
        const Truth truth(geometry, phi);
        for (int c = 0; c < channels; ++c)
          value[c] = std::max(value[c], static_cast<double>(std::fabs(truth.value[c])));
      }
    }
  }
  double value[channels] = {};
};

// Random angles, half of them crowded about the steepest rod at ±π/2.
inline double random_angle(std::mt19937& random) {
  std::uniform_real_distribution<double> unit(0, 1);
  if (unit(random) < 0.5) return 2 * std::numbers::pi * unit(random);
  const double distance = 0.5 * std::pow(10.0, -4 * unit(random));
  return (unit(random) < 0.5 ? 0.5 : 1.5) * std::numbers::pi + (unit(random) < 0.5 ? distance : -distance);
}

}  // namespace kurbel
