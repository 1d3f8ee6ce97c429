// orders.cpp — integrates one more period, adding every step's contribution to the integrals.
#include "studies/steady/orders.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <utility>

#include "engine/base/gauss.h"
#include "engine/numerics/angles.h"
#include "engine/numerics/index.h"
#include "engine/orbit/follow_period.h"
#include "engine/run/recorders.h"
#include "studies/steady/cycle_figures.h"

namespace kurbel {
namespace {

constexpr double highest = 24;                              // order, per turn of the link
constexpr std::size_t fewest_waves = 24, most_waves = 240;  // of a period
constexpr double least_reported = 0.01;                     // of the largest
constexpr std::size_t most_reported = 12;                   // of one quantity
constexpr double below_rounding = 1e-11;                    // of the rated quantity
constexpr double most_parts = 128;                          // of two turns, after which a motion repeats
constexpr double slowest_part = 1e-6;                       // of the rated speed: below that the link stands
constexpr double whole_within = 1e-6;

// The lowest order: 1/n over n turns, n/2 over two nth of a turn; empty for other angles, and for angles so small
// that the link practically stands.
std::optional<double> lowest_order(double turned) {
  const double turns = std::abs(turned) / turn;
  const auto is_whole = [](double x) { return std::round(x) >= 1 && std::abs(x - std::round(x)) <= whole_within * x; };
  if (is_whole(turns)) return 1 / std::round(turns);
  if (2 / turns <= most_parts && is_whole(2 / turns)) return 0.5 * std::round(2 / turns);
  return {};
}

struct OrderChannel {
  OrdersOf reported;
  std::function<double(const Snapshot&)> value;
};

std::vector<OrderChannel> channels_with_orders(const Model& m) {
  std::vector<OrderChannel> list;
  std::vector<int> seen;
  for (const NamedShaft& shaft : shafts_of(m)) {
    const int s = m.shaft_of_node[at(shaft.node)];
    const double gain = m.gain_of_node[at(shaft.node)];
    const bool repeated = std::find(seen.begin(), seen.end(), s) != seen.end();
    seen.push_back(s);
    list.push_back({{.channel = Name::make(quantities::speed, shaft.name),
                     .unit = "rad/s",
                     .scale = m.speed_scale * m.scale_ratio[at(shaft.node)],
                     .repeated = repeated},
                    [=](const Snapshot& x) { return gain * x.now.speed[s]; }});
  }
  for (Channel& channel : channels_of(m, {})) {
    if (channel.name.what != quantities::torque) continue;
    double scale = m.torque_scale;
    for (const TorqueJoint& joint : m.torque_joints)
      if (joint.component == channel.name.of) scale = joint.torque_scale;
    for (const GearTorque& gear : m.gear_torques)
      if (gear.name == channel.name.of) scale = m.torque_scale / m.scale_ratio[at(gear.node)];
    list.push_back({{.channel = std::move(channel.name), .unit = std::move(channel.unit), .scale = scale},
                    std::move(channel.value)});
  }
  return list;
}

// A vibration: its orders are over time.
struct OverTime {
  double from = 0, period = 0;  // [s]
  double angle(double t) const { return turn * (t - from) / period; }
  double speed() const { return turn / period; }
};

// ∫x dφ, ∫x² dφ and ∫x e^(−irφ) dφ of every channel, and the link's least speed.
class OrderIntegrals final : public Observer {
 public:
  OrderIntegrals(const Model& m, const std::vector<OrderChannel>& channels, double lowest, double turned,
                 std::optional<OverTime> vibration)
      : m_(m),
        channels_(channels),
        vibration_(vibration),
        lowest_(lowest),
        sense_(turned < 0 ? -1 : 1),
        waves_(std::clamp(static_cast<std::size_t>(std::llround(highest / lowest)), fewest_waves, most_waves)),
        first_(channels.size()),
        square_(channels.size()),
        sums_(channels.size() * waves_),
        wave_(waves_) {}

  // Intervals in which the highest order turns by at most a quarter of a turn.
  void step(StepView& view) override {
    const double a = view.t_previous(), h = view.t() - a;
    const double from = angle(view, a), to = angle(view, view.t());
    const double way = std::abs(to - from);
    const int pieces = 1 + static_cast<int>(4 * static_cast<double>(waves_) * lowest_ * way / turn);
    for (int p = 0; p < pieces; ++p)
      gauss<6>.over(a + h * p / pieces, h / pieces, [&](double t, double weight) { add(view, t, weight); });
  }

  // Over the angle `turned`.
  OrdersOf orders(std::size_t channel, double turned) const {
    OrdersOf result = channels_[channel].reported;
    result.mean = first_[channel] / turned, result.mean_square = square_[channel] / turned;
    for (std::size_t n = 0; n < waves_; ++n)
      result.orders.push_back(
          {.order = static_cast<double>(n + 1) * lowest_, .wave = 2.0 * sums_[channel * waves_ + n] / turned});
    return result;
  }
  double slowest() const { return slowest_; }  // in the sense in which it turns [rad/s]

 private:
  double angle(StepView& view, double t) const {
    if (vibration_) return vibration_->angle(t);
    return view.equations().angle_with_turns(at(m_.reduction_angle), view.at(t));
  }
  void add(StepView& view, double t, double weight) {
    const double phi = angle(view, t);
    const Snapshot& s = view.snapshot(t);
    const TrackedAngle& link = m_.angles[at(m_.reduction_angle)];
    const double omega = vibration_ ? vibration_->speed() : link.gain * s.now.speed[link.shaft];
    slowest_ = std::min(slowest_, sense_ * omega);
    std::complex<double> wave = 1;
    const std::complex<double> longest = std::polar(1.0, -lowest_ * phi);
    for (std::complex<double>& next : wave_) next = wave *= longest;
    for (std::size_t k = 0; k < channels_.size(); ++k) {
      const double x = channels_[k].value(s), part = weight * omega * x;
      first_[k] += part, square_[k] += part * x;
      for (std::size_t n = 0; n < waves_; ++n) sums_[k * waves_ + n] += part * wave_[n];
    }
  }

  const Model& m_;
  const std::vector<OrderChannel>& channels_;
  std::optional<OverTime> vibration_;
  double lowest_, sense_;
  std::size_t waves_;
  std::vector<double> first_, square_;
  std::vector<std::complex<double>> sums_, wave_;  // channel after channel; e^(−irφ) at one point
  double slowest_ = HUGE_VAL;
};

// Orders of a shaft's angle in a vibration: those of its speed over i r 2π/T.
OrdersOf angle_of(const OrdersOf& speed, double of_vibration) {
  OrdersOf angle{.channel = Name::make(quantities::angle, speed.channel.of),
                 .unit = "rad",
                 .scale = 1,
                 .repeated = speed.repeated};
  for (const Order& o : speed.orders) {
    angle.orders.push_back({.order = o.order, .wave = o.wave / std::complex<double>(0, o.order * of_vibration)});
    angle.mean_square += 0.5 * std::norm(angle.orders.back().wave);
  }
  return angle;
}

Name name_of_order(const OrdersOf& of, Functional functional, double order) {
  return Name::numbered({of.channel.what.channel, functional, QuantityKind::Window::cycle}, fmt::format("{:g}", order),
                        of.channel.of);
}

}  // namespace

std::optional<Estimate> Order::phase() const {
  const double a = std::abs(wave);
  if (!(a > error.value_or(0))) return {};
  constexpr double almost_half_a_turn = std::numbers::pi - 1e-8;  // rounding would choose between −180° and 180°
  const double phase = -std::arg(wave);
  return Estimate{phase < -almost_half_a_turn ? phase + turn : phase,
                  error ? std::optional(std::asin(*error / a)) : std::nullopt};
}

std::vector<Order> OrdersOf::reporting() const {
  double largest = below_rounding * scale;
  for (const Order& o : orders) largest = std::max(largest, std::abs(o.wave));
  std::vector<Order> reported;
  for (const Order& o : orders)
    if (std::abs(o.wave) >= least_reported * largest &&
        std::abs(o.wave) > std::max(below_rounding * scale, o.error.value_or(0)))
      reported.push_back(o);
  std::sort(reported.begin(), reported.end(),
            [](const Order& a, const Order& b) { return std::abs(a.wave) > std::abs(b.wave); });
  if (reported.size() > most_reported) reported.resize(most_reported);
  std::sort(reported.begin(), reported.end(), [](const Order& a, const Order& b) { return a.order < b.order; });
  return reported;
}

double OrdersOf::captured(const std::vector<Order>& these) const {
  double sum = 0;
  for (const Order& o : these) sum += 0.5 * std::norm(o.wave);
  const double all = mean_square - mean * mean;
  return all > 0 ? std::min(sum / all, 1.0) : 1;
}

void widen_errors(std::vector<OrdersOf>& all, const std::vector<OrdersOf>& others, double resolved, double left) {
  constexpr double rounding = 8 * std::numeric_limits<double>::epsilon();
  for (OrdersOf& of : all)
    for (const OrdersOf& other : others) {
      if (!(of.channel == other.channel)) continue;
      double largest = 0;
      for (const Order& o : of.orders) largest = std::max(largest, std::abs(o.wave));
      for (std::size_t n = 0; n < std::min(of.orders.size(), other.orders.size()); ++n) {
        Order& o = of.orders[n];
        const double apart = std::abs(o.wave - other.orders[n].wave);
        o.error =
            o.error.value_or(0) + std::max({apart, rounding * std::abs(of.mean), resolved * of.scale}) + left * largest;
      }
    }
}

void drop_errors(std::vector<OrdersOf>& all) {
  for (OrdersOf& of : all)
    for (Order& o : of.orders) o.error.reset();
}

OrdersOfCycle orders_of_cycle(const ReturnMap& map, const SteadyPoint& point, double tolerance, double turned) {
  const Model& m = map.model();
  const std::string link = m.node_label(m.reduction_node);
  const std::string standing = fmt::format(
      "no orders: \"{}\" stands or turns back in the period of the motion, so that they have no angle", link);
  std::optional<OverTime> vibration;
  if (point.vibrates()) {
    vibration = {.from = map.has_own_period() ? map.start_time() : 0, .period = point.time};
    turned = turn;
  } else if (!(std::abs(turned) > slowest_part)) {
    return {.none = standing};
  }
  const std::optional<double> lowest = lowest_order(turned);
  if (!lowest)
    return {.none = fmt::format("no orders: in the period of the motion \"{}\" turns {:.6g} times, which is no whole "
                                "number, so that what repeats is at another angle each time",
                                link, std::abs(turned) / turn)};
  const std::vector<OrderChannel> channels = channels_with_orders(m);
  OrderIntegrals integrals(m, channels, *lowest, turned, vibration);
  Equations equations(map.shared_model(), true);  // its quadratures keep steps short that torques alone would require
  const RunOutcome outcome = follow_period(map, point, equations, {.tolerance = tolerance}, {&integrals});
  if (!outcome.diagnosis.empty()) return {.none = "no orders: " + outcome.diagnosis};
  if (!(integrals.slowest() > slowest_part * m.speed_scale)) return {.none = standing};
  OrdersOfCycle round;
  for (std::size_t k = 0; k < channels.size(); ++k) {
    round.all.push_back(integrals.orders(k, turned));
    if (vibration && round.all.back().channel.what == quantities::speed)
      round.all.push_back(angle_of(round.all.back(), vibration->speed()));
  }
  return round;
}

void report_orders(const std::vector<OrdersOf>& all, bool every_one, std::vector<Figure>& figures) {
  for (const OrdersOf& of : all)
    for (const Order& o : every_one ? of.orders : of.reporting()) {
      Figure amplitude = Figure::defined(name_of_order(of, Functional::order, o.order), std::abs(o.wave), of.scale);
      amplitude.error = o.error;
      figures.push_back(std::move(amplitude));
      const std::optional<Estimate> phase = o.phase();
      if (!phase) continue;
      Figure angle =
          Figure::defined(name_of_order(of, Functional::order_phase, o.order), phase->value * in_degrees, 360);
      if (phase->error) angle.error = *phase->error * in_degrees;
      figures.push_back(std::move(angle));
    }
}

}  // namespace kurbel
