// default_moment.cpp — the motion at the end of all switching, and before one step after the other of it.
#include "engine/orbit/default_moment.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

namespace kurbel {
namespace {

// Moments before something is switched for the last time, latest first.
std::vector<Moment> earlier_moments(const Scene& scene) {
  std::vector<Moment> moments;
  const Sequence& sequence = scene.sequence;
  if (sequence.repeat) return moments;
  for (std::size_t k = sequence.steps.size(); k-- > 0;) moments.push_back({.after_step = k, .time = {}});
  if (!moments.empty()) return moments;
  constexpr double never = 1e299;
  std::vector<double> edges = {0};
  for (const Network::ShaftElement& e : build_network(scene).elements)
    for (const double edge : {e.window.start, e.window.stop})
      if (edge > 0 && edge < never) edges.push_back(edge);
  std::sort(edges.begin(), edges.end());
  for (std::size_t k = edges.size() - 1; k > 0; --k)
    if (edges[k] > edges[k - 1]) moments.push_back({.after_step = {}, .time = 0.5 * (edges[k - 1] + edges[k])});
  return moments;
}

Orbit orbit_at(const Scene& scene, const Effects& effects, const Moment& moment, const OrbitOptions& options) {
  const Scene then = as_of(scene, effects, moment);
  return find_orbit(compile_network(network_as_of(then, moment), then, effects), options);
}

// None of what has no period in common then.
bool keeps_a_motion(const Scene& scene, const Effects& effects, const Moment& moment, const OrbitOptions& options) try {
  return orbit_at(scene, effects, moment, options).repeats();
} catch (const std::invalid_argument&) {
  return false;
}

}  // namespace

std::string choose_default_moment(const Scene& scene, const Effects& effects, const OrbitOptions& options, Moment& at,
                                  const Orbit* known) {
  if (at.any()) return {};
  const std::vector<Moment> earlier = earlier_moments(scene);
  if (earlier.empty()) return {};
  const Orbit last = known ? *known : orbit_at(scene, effects, {}, options);
  if (last.repeats() || (last.kind != Orbit::Kind::at_rest && last.kind != Orbit::Kind::equilibrium)) return {};
  for (const Moment& moment : earlier) {
    if (!keeps_a_motion(scene, effects, moment, options)) continue;
    at = moment;
    return fmt::format("{}; shown is the motion that it keeps {}", last.words.substr(0, last.words.find(';')),
                       moment.describe());
  }
  return {};
}

}  // namespace kurbel
