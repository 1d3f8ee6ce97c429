// orders.h — orders of speeds and torques over one period of steady motion, over the angle of the reduction link; for
// a vibration about a fixed position over time.
//
//     x(φ) = x̄ + Σ a_r cos(r φ − ψ_r),   a_r e^(−iψ_r) = (2/Φ) ∫ x(φ) e^(−irφ) dφ                    (theory 11.10)
// φ: the link's angle; Φ: its angle per period; r: multiples of 2π/Φ, halves for two turns. The integrals are evaluated
// on the solution itself, by Gauss points within every step. For a vibration about a fixed position with the period T,
// φ is 2π t/T, from the start of the period if no law defines it; and there are orders of the shafts' angles.
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
  // ψ [rad], −π < ψ ≤ π; empty if the amplitude is within its error.
  std::optional<Estimate> phase() const;
};

// For the speed of one shaft or for one torque.
struct OrdersOf {
  Name channel;  // "torque.main_coupling"
  std::string unit = {};
  double scale = 0;        // rated quantity that errors are related to
  bool repeated = false;   // a shaft that turns with another one listed before
  double mean = 0;         // x̄
  double mean_square = 0;  // of x
  std::vector<Order> orders = {};

  // The significant orders: at least 1 % of the largest, beyond their error, at most twelve; ascending.
  std::vector<Order> reporting() const;
  // Fraction of the mean square of x − x̄ in these orders; 1 for all of them: Σ ½ a_r².
  double captured(const std::vector<Order>& orders) const;
};

struct OrdersOfCycle {
  std::vector<OrdersOf> all = {};
  std::string none = {};  // reason if there are none
};

// One period from the map's fixed point, in which the link turns by `turned` [rad]. Speeds of all shafts, torques of all
// recorded joints, motors and loads; for a vibration angles of all shafts. None if the link rotates on average but stops or
// reverses, or if its angle per period is neither whole turns nor a whole fraction of two, and so defines no position.
OrdersOfCycle orders_of_cycle(const ReturnMap& map, const SteadyPoint& point, double tolerance, double turned);

// Increases errors to the differences to `others`, at least to the resolution of the steps, a fraction of the rated
// quantity, plus a fraction of each quantity's largest amplitude for other uncertainty.
void widen_errors(std::vector<OrdersOf>& all, const std::vector<OrdersOf>& others, double resolved = 0,
                  double left = 0);
void drop_errors(std::vector<OrdersOf>& all);

// "torque_order.0.5.main_coupling", "torque_order_phase.0.5.main_coupling" [deg]: of the significant orders, or of all.
void report_orders(const std::vector<OrdersOf>& all, bool every_one, std::vector<Figure>& figures);

}  // namespace kurbel
