// reduced_mechanism.cpp — tabulates the reduced functions of a mechanism and keeps the tables that were made.
#include "mechanisms/reduced_mechanism.h"

#include <array>
#include <cmath>
#include <map>
#include <mutex>
#include <span>
#include <utility>

namespace kurbel {

namespace {

std::vector<ChannelSpec> channel_specs(const ReducedMechanism::NoiseScales& noise) {
  using enum ErrorScale;
  return {{"inertia", own_value, 10 * noise.inertia},
          {"inertia_slope", own_maximum, noise.inertia},
          {"inertia_curvature", own_maximum, noise.inertia},
          {"slider_position", own_maximum, 0},
          {"slider_velocity_ratio", own_maximum, 0},
          {"slider_acceleration_ratio", own_maximum, 0},
          {"gravity_torque", own_maximum, noise.gravity_torque},
          {"gravity_torque_slope", own_maximum, noise.gravity_torque}};
}

void write_channels(const ReducedSample& sample, std::span<double> values) {
  using enum ReducedMechanism::Channel;
  values[inertia_channel] = sample.inertia;
  values[inertia_slope] = sample.inertia_slope;
  values[inertia_curvature] = sample.inertia_curvature;
  values[slider_position_channel] = sample.slider_position;
  values[slider_velocity_ratio] = sample.slider_velocity_ratio;
  values[slider_acceleration_ratio] = sample.slider_acceleration_ratio;
  values[gravity_torque_channel] = sample.gravity_torque;
  values[gravity_torque_slope] = sample.gravity_torque_slope;
}

// Rounding leaves 1e-16 of the inertia in I_r′ and of the weights' torques in M_g even where these vanish identically
// (masses balanced, weights carried by the guide).
ReducedMechanism::NoiseScales noise_scales(const SliderCrankData& d) {
  const double moving = d.rod_mass + d.slider_mass, rod_ratio = d.radius / d.rod_length;
  return {1e-4 * (d.crank_inertia + moving * d.radius * d.radius + d.rod_inertia * rod_ratio * rod_ratio),
          0.1 * d.gravity * (d.crank_mass * std::fabs(d.crank_com) + moving * d.radius)};
}

using CacheKey = std::array<double, 14>;

CacheKey cache_key(const SliderCrankData& d, double tolerance, std::size_t max_pieces) {
  return {d.radius,      d.rod_length,
          d.offset,      d.crank_mass,
          d.crank_com,   d.crank_inertia,
          d.rod_mass,    d.rod_com,
          d.rod_inertia, d.slider_mass,
          d.gravity,     d.stroke_angle,
          tolerance,     static_cast<double>(max_pieces)};
}

}  // namespace

ReducedMechanism::ReducedMechanism(const std::function<ReducedSample(double phi)>& sampler, NoiseScales noise,
                                   double tolerance, std::size_t max_pieces)
    : table_(PeriodicTable::build([&](double phi, std::span<double> values) { write_channels(sampler(phi), values); },
                                  channel_specs(noise), tolerance, max_pieces)) {}

ReducedMechanism extract_slider_crank(const SliderCrankData& data, double tolerance, std::size_t max_pieces) {
  SliderCrankBodies bodies(data);
  return ReducedMechanism([&](double phi) { return bodies.sample(phi); }, noise_scales(data), tolerance, max_pieces);
}

std::shared_ptr<const ReducedMechanism> reduce_slider_crank(const SliderCrankData& data, double tolerance,
                                                            std::size_t max_pieces) {
  static std::mutex mutex;
  static std::map<CacheKey, std::shared_ptr<const ReducedMechanism>> cache;
  constexpr std::size_t capacity = 256;  // a table is 20 kB … 1 MB
  validate(data);                        // no NaN may become a key

  const std::scoped_lock lock(mutex);
  const CacheKey key = cache_key(data, tolerance, max_pieces);
  if (const auto found = cache.find(key); found != cache.end()) return found->second;
  if (cache.size() == capacity) cache.clear();
  return cache[key] = std::make_shared<const ReducedMechanism>(extract_slider_crank(data, tolerance, max_pieces));
}

}  // namespace kurbel
