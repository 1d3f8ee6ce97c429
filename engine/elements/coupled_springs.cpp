// coupled_springs.cpp — torques, derivatives and energy of coupled springs in a row.
#include "engine/elements/coupled_springs.h"

#include <fmt/format.h>

#include <utility>

#include "engine/numerics/index.h"

namespace kurbel {

void SpringRowPool::place(const std::shared_ptr<const SpringRow>& law, int part, const ConnectionPorts& ports) {
  if (part == 0) rows_.push_back({law, {}, {}});
  rows_.back().at.push_back(ports);
}

template <class Do>
void SpringRowPool::for_parts(const Placed& row, const Instant& now, Do&& action) {
  // Twists of a row are contiguous in the state.
  const double* const twist = now.twist + row.at.front().id;
  const std::size_t n = row.at.size();
  constexpr std::size_t most = 32;
  double rate[most];
  for (std::size_t k = 0; k < n; ++k) {
    const ConnectionPorts& p = row.at[k];
    rate[k] = p.gain_a * now.speed[p.shaft_a] - p.gain_b * now.speed[p.shaft_b];
  }
  const SpringRow& law = *row.law;
  for (std::size_t k = 0; k < n; ++k) {
    const int part = static_cast<int>(k);
    const double spring = law.spring_torque(part, twist);
    const double damper = law.retardation == 0 ? 0 : law.retardation * law.spring_torque(part, rate);
    action(row.at[k], twist[k], rate[k], spring, spring + damper);
  }
}

void SpringRowPool::add(const Instant& now, Sums& sums) const {
  for (const Placed& row : rows_)
    for_parts(row, now, [&](const ConnectionPorts& p, double, double rate, double spring, double torque) {
      sums.twist_rate[p.id] = rate;
      sums.connection_torque[p.id] = torque;
      sums.torque[p.shaft_a] -= p.gain_a * torque;
      sums.torque[p.shaft_b] += p.gain_b * torque;
      if (!sums.work_rate) return;
      sums.spring_torque[p.id] = spring;
      sums.work_rate[p.loss_account] -= (torque - spring) * rate;
    });
}

void SpringRowPool::register_jacobian(JacobianPattern& pattern) {
  for (Placed& row : rows_) {
    row.slots.clear();
    for (const ConnectionPorts& k : row.at)
      for (const ConnectionPorts& l : row.at)
        for (const int of : {pattern.speed(k.shaft_a), pattern.speed(k.shaft_b)})
          for (const int by : {pattern.twist(l.id), pattern.speed(l.shaft_a), pattern.speed(l.shaft_b)})
            row.slots.push_back(pattern.entry(of, by));
  }
}

void SpringRowPool::add_jacobian(const Instant&, const double*, double* slots) const {
  for (const Placed& row : rows_) {
    const int* slot = row.slots.data();
    const double* s = row.law->stiffness.data();
    const double late = row.law->retardation;
    for (const ConnectionPorts& k : row.at)
      for (const ConnectionPorts& l : row.at) {
        for (const double gain : {-k.gain_a, k.gain_b}) {
          slots[slot[0]] += gain * *s;
          slots[slot[1]] += gain * *s * late * l.gain_a;
          slots[slot[2]] -= gain * *s * late * l.gain_b;
          slot += 3;
        }
        ++s;
      }
  }
}

void SpringRowPool::add_torque_slopes(const Instant&, std::vector<TorqueSlope>& slopes) const {
  using By = TorqueSlope::By;
  for (const Placed& row : rows_) {
    const double* s = row.law->stiffness.data();
    for (const ConnectionPorts& k : row.at)
      for (const ConnectionPorts& l : row.at) {
        slopes.push_back({k.id, By::twist, l.id, *s});
        slopes.push_back({k.id, By::rate, l.id, *s * row.law->retardation});
        ++s;
      }
  }
}

double SpringRowPool::energy(const Instant& now) const {
  double sum = 0;
  for (const Placed& row : rows_) {
    const double* const twist = now.twist + row.at.front().id;
    for (int k = 0; k < row.law->size; ++k) sum += 0.5 * row.law->spring_torque(k, twist) * twist[k];
  }
  return sum;
}

namespace {

struct RowShape {
  ConnectionForm whole;
  std::vector<double> share, stiffness, compliance;
};

class RowPart final : public AnyConnection {
 public:
  RowPart(std::shared_ptr<const RowShape> shape, int part, const AnyConnection* settled_whole = nullptr)
      : shape_(std::move(shape)) {
    is = shape_->whole->is;
    row_part = part;
    if (!settled_whole) return;
    const double k = settled_whole->stiffness, share = shape_->share[at(part)];
    auto law = std::make_shared<SpringRow>();
    law->size = static_cast<int>(shape_->share.size());
    law->retardation = settled_whole->damping / k;
    for (const double s : shape_->stiffness) law->stiffness.push_back(k * s);
    for (const double s : shape_->compliance) law->compliance.push_back(s / k);
    row = std::move(law);
    stiffness = k / share;
    damping = settled_whole->damping / share;
  }

  double twist_at(double torque, double) const override { return torque / stiffness; }
  double torque_rate(double, double, double) const override { return 0; }
  double rest_twist(double) const override { return 0; }
  double rest_ratio(double) const override { return 1; }
  double rest_ratio_slope(double) const override { return 0; }
  double share_of_a(double, double) const override { return 1; }
  std::string describe() const override {
    const std::size_t parts = shape_->share.size();
    return row_part > 0 || parts == 1 ? std::string()
                                      : fmt::format("of a continuous shaft: a spectral element of degree {}", parts);
  }
  bool damping_hangs_on_inertia() const override { return shape_->whole->damping_hangs_on_inertia(); }
  ConnectionForm settled(double inertia) const override {
    const ConnectionForm whole = shape_->whole->settled(inertia);
    return std::make_shared<RowPart>(shape_, row_part, whole ? whole.get() : shape_->whole.get());
  }
  ConnectionForm form_under(const Effects&) const override { return nullptr; }
  void place(PoolSet& pools, const ConnectionPorts& ports, const ConnectionExtras&) const override {
    pools.of<SpringRowPool>().place(row, row_part, ports);
  }

 private:
  std::shared_ptr<const RowShape> shape_;
};

}  // namespace

ConnectionForm spring_row_part(ConnectionForm whole, int part, std::vector<double> share, std::vector<double> stiffness,
                               std::vector<double> compliance) {
  auto shape = std::make_shared<RowShape>(
      RowShape{std::move(whole), std::move(share), std::move(stiffness), std::move(compliance)});
  return std::make_shared<RowPart>(std::move(shape), part);
}

}  // namespace kurbel
