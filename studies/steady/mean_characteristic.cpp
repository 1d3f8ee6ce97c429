// mean_characteristic.cpp — mean torques by quadrature, with the torque that keeps the speed of a machine with losses.
#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "engine/base/gauss.h"
#include "engine/numerics/index.h"
#include "studies/steady/operating_points.h"

namespace kurbel {
namespace {

constexpr double widest_interval = std::numbers::pi / 12;

}  // namespace

Effects rigid_with_losses(const Effects& effects) {
  Effects rigid = rigid_effects();
  rigid.gear_losses = effects.gear_losses;
  rigid.joint_friction = effects.joint_friction;
  rigid.bearing_friction = effects.bearing_friction;
  return rigid;
}

namespace {

// A part of the torque that keeps the speed.
struct SharedTorque {
  static constexpr ShaftTraits is{.account = Account::driving};
  std::shared_ptr<const double> on_link = {};
  double gain = 1;
  template <class T>
  T torque(const ShaftState<T>&) const {
    return T(gain * *on_link);
  }
  bool uses_time() const { return false; }
  bool uses_speed() const { return false; }
  Rated rated() const { return {}; }
};

}  // namespace

LossyMachine machine_with_losses(const Network& network, const Scene& scene, const Effects& effects) {
  const Effects rigid = rigid_with_losses(effects);
  if (rigid.describe() == rigid_effects().describe()) return {};
  LossyMachine lossy{compile_network(network, scene, rigid), std::make_shared<double>(0)};
  std::map<int, std::string> drives;
  for (const Network::ShaftElement& e : network.elements)
    if (e.element->account == Account::driving && lossy.model->node_ratio[at(e.node)] != 0)
      drives[e.node] = e.component;
  if (drives.empty()) return lossy;
  Network held = network;
  for (const auto& [node, component] : drives)
    held.put(node, component,
             SharedTorque{lossy.holding, 1 / (lossy.model->node_ratio[at(node)] * static_cast<double>(drives.size()))});
  lossy.model = compile_network(held, scene, rigid);
  return lossy;
}

MeanCharacteristic::MeanCharacteristic(RigidMachine& machine, int direction, int finer, LossyMachine lossy)
    : machine_(machine),
      lossy_(std::move(lossy)),
      moving_(lossy_.model ? std::make_unique<Equations>(lossy_.model, true) : nullptr),
      direction_(direction) {
  std::vector<double> ends = machine.edges(direction);
  ends.push_back(0);
  ends.push_back(machine.cycle());
  std::sort(ends.begin(), ends.end());
  for (std::size_t i = 0; i + 1 < ends.size(); ++i) {
    const double length = ends[i + 1] - ends[i];
    if (length < 1e-12) continue;
    const int parts = finer * static_cast<int>(std::ceil(length / widest_interval));
    for (int k = 0; k < parts; ++k) {
      begin_.push_back(ends[i] + length * k / parts);
      width_.push_back(length / parts);
    }
  }
}

// With losses the net torque grows with the holding torque by pieces of lines: secants, from the solution at the last speed.
MeanTorques MeanCharacteristic::at(double omega) {
  if (!moving_) return with_losses(omega, 0);
  constexpr int most_secants = 12;
  constexpr double enough = 1e-12;  // of the turnover
  double holding = holding_, before = 0, net_before = 0;
  for (int i = 0; i < most_secants; ++i) {
    MeanTorques mean = with_losses(omega, holding);
    const double net = mean.net();
    if (!std::isfinite(net)) break;
    if (i > 0 && holding != before) slope_ = std::clamp((net - net_before) / (holding - before), 0.01, 100.0);
    if (std::abs(net) <= enough * mean.turnover) {
      holding_ = holding;
      mean.drive -= holding;
      return mean;
    }
    before = holding, net_before = net;
    holding -= net / slope_;
  }
  holding_ = 0, slope_ = 1;
  return with_losses(omega, 0);  // what jams there: with the acceleration of the motion
}

MeanTorques MeanCharacteristic::with_losses(double omega, double holding) {
  MeanTorques mean{direction_ * std::abs(omega), 0, 0, 0};
  if (moving_) *lossy_.holding = direction_ * holding;
  for (std::size_t i = 0; i < begin_.size(); ++i) moving_ ? add_moving(mean, i) : add_static(mean, i);
  if (moving_) *lossy_.holding = 0;
  return mean;
}

namespace {

// Shares of the accounts, reduced to the link.
void add_shares(MeanTorques& mean, const std::vector<WorkAccount>& accounts, std::span<const double> share,
                double weight) {
  for (std::size_t a = 0; a < accounts.size(); ++a) {
    (accounts[a].kind == Account::driving ? mean.drive : mean.load) +=
        weight * (accounts[a].kind == Account::driving ? share[a] : -share[a]);
    mean.turnover += std::abs(weight * share[a]);
  }
}

}  // namespace

void MeanCharacteristic::add_static(MeanTorques& mean, std::size_t i) {
  machine_.set_modes(begin_[i] + 0.5 * width_[i], mean.omega);
  gauss<5>.over(begin_[i], width_[i], [&](double phi, double weight) {
    const RigidMachine::At here = machine_.at(phi, mean.omega, true);
    add_shares(mean, machine_.model().accounts, here.share, weight / machine_.cycle() * direction_);
  });
}

// Powers of the accounts over the link's speed, with the flanks in contact at the torques of the motion.
void MeanCharacteristic::add_moving(MeanTorques& mean, std::size_t i) try {
  const Model& m = moving_->model();
  std::vector<double> rate(moving_->size()), share(m.accounts.size());
  gauss<5>.over(begin_[i], width_[i], [&](double phi, double weight) {
    StartSettings settings{};
    settings.angle = phi;
    settings.speed = mean.omega;
    std::vector<double> y = moving_->start(0, settings);
    y.resize(moving_->size(), 0.0);
    moving_->flow(0, y, rate);
    for (std::size_t a = 0; a < share.size(); ++a) share[a] = rate[moving_->work_index(a)] / mean.omega;
    add_shares(mean, m.accounts, share, weight / machine_.cycle() * direction_);
  });
} catch (const std::runtime_error&) {  // joints that jam
  mean.drive = mean.load = std::nan("");
}

}  // namespace kurbel
