// orders.h — orders of speeds and torques over one period of steady motion, over the angle of the reduction link; of a
// vibration about a place over its time.
//
//     x(φ) = x̄ + Σ a_r cos(r φ − ψ_r),   a_r e^(−iψ_r) = (2/Φ) ∫ x(φ) e^(−irφ) dφ                    (theory 11.10)
// φ: the link's angle; Φ: what it turns in a period of the motion; r: whole multiples of 2π/Φ, halves over two turns. The
// integrals are those of the solution itself, by Gauss's points within every step. Of a vibration about a place with the
// period T φ is 2π t/T, from where the period begins where no law gives it; and there are orders of the shafts' angles.
#pragma once

#include <complex>
#include <optional>
#include <string>
#include <vector>

#include "engine/base/estimate.h"
#include "engine/return_map/return_map.h"
#include "studies/findings/result.h"

namespace kurbel {

struct Order {
  double order = 0;                  // r, per turn of the link, or per period of a vibration
  std::complex<double> wave = {};    // a e^(−iψ)
  std::optional<double> error = {};  // of the wave; empty: not measured

  Estimate amplitude() const { return {std::abs(wave), error}; }
  // ψ [rad], −π < ψ ≤ π; none where the amplitude is within its error.
  std::optional<Estimate> phase() const;
};

// Of the speed of one shaft or of one torque.
struct OrdersOf {
  Name channel;  // "torque.main_coupling"
  std::string unit = {};
  double scale = 0;        // rated quantity that errors are judged by
  bool repeated = false;   // a shaft that turns as one with another that stands before it
  double mean = 0;         // x̄
  double mean_square = 0;  // of x
  std::vector<Order> orders = {};

  // Those that matter: at least 1 % of the largest, beyond its error, at most twelve; ascending.
  std::vector<Order> telling() const;
  // What these hold of the mean square of x − x̄: 1 of all that there are, Σ ½ a_r².
  double captured(const std::vector<Order>& orders) const;
};

struct OrdersOfRound {
  std::vector<OrdersOf> all = {};
  std::string none = {};  // why there are none, in words
};

// Goes once round from the map's fixed point, in which the link turns by `turned` [rad]. Speeds of all shafts, torques of
// all joints, motors and loads that a run records; of a vibration angles of all shafts. None where the link turns in the mean,
// but stands or turns back on its way, or where it turns by no whole number of turns and by no whole part of two, so that its angle does not say where the motion is.
OrdersOfRound orders_of_round(const ReturnMap& map, const SteadyPoint& point, double tolerance, double turned);

// Adds to the errors what others have found otherwise: at least what the steps resolve, a part of the rated quantity, and a
// part of each quantity's largest amplitude that is left open besides.
void widen_errors(std::vector<OrdersOf>& all, const std::vector<OrdersOf>& others, double resolved = 0,
                  double left = 0);
void drop_errors(std::vector<OrdersOf>& all);

// "torque_order.0.5.main_coupling", "torque_order_phase.0.5.main_coupling" [deg]: of the orders that matter, or of all.
void tell_orders(const std::vector<OrdersOf>& all, bool every_one, std::vector<Figure>& figures);

}  // namespace kurbel
