// rest_position.cpp — the state of a steady motion at rest, or a root of the torque at standstill, downhill from the start.
#include "engine/linear/rest_position.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "engine/linear/cycle_samples.h"
#include "engine/numerics/angles.h"
#include "engine/numerics/index.h"
#include "engine/numerics/roots.h"

namespace kurbel {
namespace {

// Over the two turns of a law; 0 if only rounding remains.
double within_a_cycle(double angle) {
  const double within = std::remainder(angle, 4 * std::numbers::pi);
  return std::abs(within) < 1e-9 ? 0 : within;
}

bool stands(const Orbit& orbit) { return orbit.kind == Orbit::Kind::at_rest; }

// Torque on the link by weights and all other loads at standstill [N·m].
double torque_at(const std::shared_ptr<const Model>& model, double angle) {
  return BaseMotion(model, {.speed = 0, .angle = angle}).left_over();
}

[[noreturn]] void refuse(const Model& model, const std::string& why) {
  throw std::invalid_argument(
      fmt::format("the crank rocks, so that modes are small vibrations about a position of rest, and {} from the start "
                  "of \"{}\" on; start it nearer to its rest, or give one with --angle",
                  why, model.node_label(model.reduction_node)));
}

// From near the start, which may be the top or the bottom itself, in the direction of the torque.
double downhill(const std::shared_ptr<const Model>& model, double start) {
  constexpr double step = 0.5 * degree;
  constexpr int turn = 720;
  try {
    double here = start + 1e-3, torque = torque_at(model, here);
    if (torque == 0) refuse(*model, "no torque that depends on the angle alone was found");
    for (int i = 0; i < turn; ++i) {
      const double next = here + std::copysign(step, torque), there = torque_at(model, next);
      if (there == 0) return next;
      if ((there > 0) != (torque > 0))
        return find_root([&](double angle) { return torque_at(model, angle); }, here, torque, next, there);
      here = next, torque = there;
    }
  } catch (const std::runtime_error& beyond) {  // the end of the arc
    refuse(*model, fmt::format("none was found ({})", beyond.what()));
  }
  refuse(*model, "none was found within a turn");
}

}  // namespace

bool has_rocking_crank(const Model& model) {
  const auto& elements = model.network.elements;
  return std::any_of(elements.begin(), elements.end(),
                     [](const Network::ShaftElement& e) { return std::isinf(e.element->cycle); });
}

bool rests_by_its_angle(const Model& model, const Orbit& orbit) {
  if (!stands(orbit)) return false;
  const auto& elements = model.network.elements;
  const bool by_angle = std::any_of(elements.begin(), elements.end(), [](const Network::ShaftElement& e) {
    return e.element->is.uses_angle && e.element->cycle > 0;
  });
  const std::vector<int>& sense = orbit.state.modes.direction;  // 0: held
  return by_angle && std::count(sense.begin(), sense.end(), 0) == 0;
}

RestPosition position_of_rest(const std::shared_ptr<const Model>& model, const Orbit& orbit) {
  if (stands(orbit)) {
    MeanMotion rest = *means_of_equilibrium(model, orbit.state);
    rest.speed = 0;
    return {within_a_cycle(rest.state.y[at(model->reduction_angle)]),
            std::make_shared<const MeanMotion>(std::move(rest))};
  }
  return {within_a_cycle(downhill(model, Equations(model, false).start(0)[at(model->reduction_angle)])), nullptr};
}

}  // namespace kurbel
