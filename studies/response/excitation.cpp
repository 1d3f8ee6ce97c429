// excitation.cpp — samples the residuals of the equations over the cycle and over time, and decomposes them into harmonics.
#include "studies/response/excitation.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <unsupported/Eigen/FFT>

#include "drivetrain/gears/gear_keys.h"
#include "engine/numerics/angles.h"
#include "engine/numerics/deadline.h"
#include "engine/numerics/index.h"
#include "engine/rigid/rigid_machine.h"

namespace kurbel {
namespace {

constexpr std::size_t many_shafts = 500, time_samples = 2048, most_samples = 65536;
// A multiple of 2 … 8, 10, 12, 14, 16, three times it of 9 and 18: what equal cylinders of that number cancel is cancelled
// in the samples, too, up to rounding.
constexpr std::size_t few_samples = 1680;
constexpr double nothing = 1e-12;       // of the torque scale: rounding of what does not change
constexpr double least_of_time = 1e-9;  // of the largest amplitude over time
constexpr double misfit_refined = 1e-4, misfit_reported = 1e-3;
constexpr double strong = 0.3;  // of the strongest order of the same torque
constexpr std::size_t few_speeds = 3, more_speeds = 9;

// A place of a possible residual, with its samples.
struct Track {
  LeftOver kind;
  int index;
  double scale;
  std::vector<double> samples;
  bool changes() const {
    const auto [least, most] = std::minmax_element(samples.begin(), samples.end());
    return *most - *least > nothing * scale || !std::isfinite(*most - *least);
  }
};

std::vector<std::size_t> numbered(std::size_t count) {
  std::vector<std::size_t> numbers(count);
  std::iota(numbers.begin(), numbers.end(), std::size_t{0});
  return numbers;
}

std::string name_of(const LinearDrive& drive, const BaseMotion& base, LeftOver kind, int index) {
  const Model& m = *drive.model;
  switch (kind) {
    case LeftOver::torque:
      return m.node_label(m.shafts[at(base.coordinates().shaft[at(index)])].reference);
    case LeftOver::internal_rate:
      return m.internal_states[at(index)].component;
    case LeftOver::twist:
    case LeftOver::joint_torque:
      break;
  }
  return m.network.joints[at(m.elastic[at(index)].joint)].component;
}

// Values of all places at one position, in the order of `places`.
void read_places(const BaseMotion::Residual& r, std::vector<double>& values) {
  values.assign(r.torque.begin(), r.torque.end());
  values.insert(values.end(), r.own.begin(), r.own.end());
  values.insert(values.end(), r.joint_torque.begin(), r.joint_torque.end());
}

// All residuals at these positions; constant ones are dropped, for large drives by a preliminary check.
std::vector<Track> tracks(BaseMotion& base, const std::vector<BaseMotion::Position>& positions, bool with_joints) {
  const Model& m = base.model();
  std::vector<Track> all;
  for (Eigen::Index i = 0; i < base.coordinates().size(); ++i)
    all.push_back({LeftOver::torque, static_cast<int>(i), m.torque_scale, {}});
  for (std::size_t i = 0; i < m.internal_states.size(); ++i)
    all.push_back({LeftOver::internal_rate, static_cast<int>(i), m.internal_states[i].state.scale * m.speed_scale, {}});
  for (std::size_t j = 0; with_joints && j < m.elastic.size(); ++j)
    all.push_back({LeftOver::joint_torque, static_cast<int>(j), m.torque_scale, {}});
  std::vector<std::size_t> looked_at = numbered(all.size());
  std::vector<double> values;
  const auto look = [&](std::size_t stride) {
    for (std::size_t k = 0; k < positions.size(); k += stride) {
      read_places(with_joints ? base.residual_with_joints(positions[k]) : base.residual(positions[k]), values);
      for (const std::size_t i : looked_at) all[i].samples.push_back(values[i]);
    }
    std::erase_if(looked_at, [&](std::size_t i) { return !all[i].changes(); });
  };
  if (all.size() > many_shafts) {
    look(positions.size() / 64);
    for (Track& t : all) t.samples.clear();
  }
  look(1);
  std::vector<Track> changing;
  for (const std::size_t i : looked_at) changing.push_back(std::move(all[i]));
  return changing;
}

// Twists at rest of joints with varying ratio: the kinematics of the base motion demand their opposite.
void add_rest_twists(BaseMotion& base, const std::vector<BaseMotion::Position>& positions, std::vector<Track>& all) {
  const Model& m = base.model();
  for (std::size_t j = 0; j < m.elastic.size(); ++j) {
    if (!m.network.joints[at(m.elastic[j].joint)].element->is.turns_unevenly) continue;
    Track t{LeftOver::twist, static_cast<int>(j), 1e-3, {}};
    for (const BaseMotion::Position& p : positions) t.samples.push_back(-base.rest_twist(j, p));
    if (t.changes()) all.push_back(std::move(t));
  }
}

using Orders = std::vector<OrderSource>;

// Over the cycle at one speed, by harmonics. Samples lie half a step off whole degrees, where edges are.
Orders orders_of(const LinearDrive& drive, BaseMotion& base, std::size_t samples, std::size_t harmonics) {
  const double step = base.cycle() / static_cast<double>(samples), sign = drive.at.speed < 0 ? -1 : 1;
  std::vector<BaseMotion::Position> positions(samples);
  for (std::size_t k = 0; k < samples; ++k) positions[k].angle = sign * (static_cast<double>(k) + 0.5) * step;
  std::vector<Track> all = tracks(base, positions, base.joints_change());
  add_rest_twists(base, positions, all);
  Orders orders;
  for (const Track& t : all) {
    std::vector<Complex> values = harmonics_of(t.samples);
    values.resize(harmonics + 1);
    for (std::size_t r = 1; r <= harmonics; ++r)
      values[r] *= std::polar(1.0, -pi * static_cast<double>(r) / static_cast<double>(samples));
    orders.push_back({name_of(drive, base, t.kind, t.index), t.kind, t.index, nullptr, {std::move(values)}});
  }
  return orders;
}

const OrderSource* find(const Orders& orders, const OrderSource& like) {
  for (const OrderSource& o : orders)
    if (o.kind == like.kind && o.index == like.index) return &o;
  return nullptr;
}

class SourceSearch {
 public:
  SourceSearch(const LinearDrive& drive, double fastest, double highest_order, bool further)
      : drive_(drive), m_(*drive.model), fastest_(fastest), highest_order_(highest_order), further_(further) {}

  Excitations find_all() {
    BaseMotion base(drive_.model, drive_.at);
    const CyclePeriod cycle = cycle_of(m_);
    found_.fundamental = 2 * pi / cycle.angle;
    found_.harmonics = static_cast<std::size_t>(std::max(1.0, std::floor(highest_order_ / found_.fundamental + 1e-9)));
    found_.speed = drive_.at.speed;
    samples_ = m_.shafts.size() > many_shafts ? few_samples : 3 * few_samples;
    const double turns = cycle.angle / (2 * pi);
    while (samples_ < 8 * found_.harmonics || (samples_ < most_samples && static_cast<double>(samples_) < 1024 * turns))
      samples_ *= 2;
    const bool stands = drive_.at.orbit ? drive_.at.orbit->speed == 0 : drive_.at.angle && drive_.at.speed == 0;
    if (base.turns() && !stands) find_orders(base, cycle.periodic);
    if (base.time_period() > 0) find_frequencies(base);
    find_meshes();
    return std::move(found_);
  }

 private:
  Orders orders_at(double speed) {
    Deadline::check();
    LinearDrive like;  // what orders_of reads of a drive
    like.model = drive_.model;
    like.at = drive_.at;
    like.at.speed = speed;
    like.at.positions = coarse_positions;
    like.at.added = nullptr;
    BaseMotion base(drive_.model, like.at);
    return orders_of(like, base, samples_, found_.harmonics);
  }

  void find_orders(BaseMotion& base, bool periodic) {
    if (!periodic)
      found_.notes.push_back(
          "no multiple of a turn is a period of all that depends on an angle: orders are those of the "
          "reduction link's own cycle, and what does not fit it is smeared over them");
    if (drive_.at.speed != 0) look_here(base);
    sample_speeds(few_speeds);
    if (found_.misfit > misfit_refined) sample_speeds(more_speeds);
    if (found_.misfit > misfit_reported)
      found_.notes.push_back(fmt::format(
          "excitation over the cycle is no smooth function of the speed: between the speeds at which it was "
          "found the orders are off by up to {:.1g} of the largest",
          found_.misfit));
  }

  void look_here(BaseMotion& base) {
    const std::size_t usual = found_.harmonics, all = further_ ? std::max(usual, samples_ / 8) : usual;
    found_.here = orders_of(drive_, base, samples_, all);
    found_.counts.assign(all + 1, 0);
    std::fill(found_.counts.begin(), found_.counts.begin() + static_cast<std::ptrdiff_t>(usual) + 1, 1);
    for (const OrderSource& source : found_.here) {
      const std::vector<Complex>& values = source.values.front();
      double strongest = 0;
      for (std::size_t r = 1; r <= all; ++r) strongest = std::max(strongest, std::abs(values[r]));
      for (std::size_t r = usual + 1; r <= all && source.kind == LeftOver::torque; ++r)
        if (std::abs(values[r]) > strong * strongest)
          found_.counts[r] = 1, found_.harmonics = std::max(found_.harmonics, r);
    }
    found_.counts.resize(found_.harmonics + 1);
    for (OrderSource& source : found_.here) source.values.front().resize(found_.harmonics + 1);
  }

  // At equidistant speeds up to the fastest, checked between the first two thirds.
  void sample_speeds(std::size_t count) {
    std::vector<double> speeds;
    for (std::size_t i = 1; i <= count; ++i)
      speeds.push_back(fastest_ * static_cast<double>(i) / static_cast<double>(count));
    const auto nodes = std::make_shared<const std::vector<double>>(speeds);
    found_.by_order.clear();
    for (std::size_t i = 0; i < count; ++i) {
      const Orders orders = orders_at(speeds[i]);
      for (const OrderSource& o : orders) {
        if (find(found_.by_order, o)) continue;
        found_.by_order.push_back({o.component, o.kind, o.index, nodes, {}});
        found_.by_order.back().values.assign(count, std::vector<Complex>(found_.harmonics + 1));
      }
      for (OrderSource& known : found_.by_order)
        if (const OrderSource* o = find(orders, known)) known.values[i] = o->values.front();
    }
    const double check = fastest_ * (count == few_speeds ? 0.5 : (0.5 + 0.5 * static_cast<double>(count / 2)) / 4.5);
    const Orders there = orders_at(check);
    double largest = 0, misfit = 0;
    for (const OrderSource& known : found_.by_order) {
      if (known.kind != LeftOver::torque) continue;
      const OrderSource* o = find(there, known);
      for (std::size_t r = 1; r <= found_.harmonics; ++r) {
        largest = std::max(largest, std::abs(known.values.back()[r]));
        misfit = std::max(misfit, std::abs(known.at(r, check) - (o ? o->values.front()[r] : Complex{})));
      }
    }
    found_.misfit = largest > 0 ? misfit / largest : 0;
  }

  // Over the common period of all functions of time, with the link at the start of the base motion.
  void find_frequencies(BaseMotion& base) {
    const double period = base.time_period(), begin = base.positions().front().angle;
    std::vector<BaseMotion::Position> positions(time_samples);
    for (std::size_t k = 0; k < time_samples; ++k)
      positions[k] = {begin, period * (static_cast<double>(k) + 0.5) / static_cast<double>(time_samples)};
    std::vector<Track> all = tracks(base, positions, true);
    add_prescribed_twists(base, positions, all);
    std::vector<FrequencySource> sources;
    double largest = 0;
    for (const Track& t : all) {
      const std::vector<Complex> values = harmonics_of(t.samples);
      for (std::size_t r = 1; r < time_samples / 8; ++r) {
        const double omega = 2 * pi * static_cast<double>(r) / period;
        // Phases refer to the time at which the base motion begins.
        Complex amplitude =
            values[r] * std::polar(1.0, -pi * static_cast<double>(r) / static_cast<double>(time_samples));
        if (t.kind == LeftOver::twist) amplitude /= Complex(0, omega);
        sources.push_back({name_of(drive_, base, t.kind, t.index), t.kind, t.index, omega, amplitude});
        if (t.kind != LeftOver::internal_rate) largest = std::max(largest, std::abs(amplitude) / t.scale);
      }
    }
    for (FrequencySource& s : sources) {
      const double scale = s.kind == LeftOver::twist           ? 1e-3
                           : s.kind == LeftOver::internal_rate ? scale_of(s.index)
                                                               : m_.torque_scale;
      if (std::abs(s.amplitude) > least_of_time * std::max(largest, 1e-6) * scale)
        found_.by_frequency.push_back(std::move(s));
    }
    check_split(base, positions);
  }
  double scale_of(int own) const { return m_.internal_states[at(own)].state.scale * m_.speed_scale; }

  // θ̇ demanded by the ripple of a prescribed speed; as a rate, per joint at that shaft.
  void add_prescribed_twists(BaseMotion& base, const std::vector<BaseMotion::Position>& positions,
                             std::vector<Track>& all) const {
    for (std::size_t j = 0; j < m_.elastic.size(); ++j) {
      const ElasticJoint& e = m_.elastic[j];
      if (at(e.shaft_a) < m_.free_shafts && at(e.shaft_b) < m_.free_shafts) continue;
      Track t{LeftOver::twist, static_cast<int>(j), 1e-3 * m_.speed_scale, {}};
      for (const BaseMotion::Position& p : positions)
        t.samples.push_back(base.residual_with_joints(p).twist_rate[static_cast<Eigen::Index>(j)]);
      if (t.changes()) all.push_back(std::move(t));
    }
  }

  // Dependence on angle and on time is separated; a dependence on both at once is noted. There are no orders for a held link.
  void check_split(BaseMotion& base, const std::vector<BaseMotion::Position>& over_time) {
    if (!base.turns() || drive_.at.angle) return;
    const BaseMotion::Position origin = over_time.front();
    const Eigen::VectorXd r0 = base.residual(origin).torque;
    double worst = 0, largest = 0;
    for (int k = 1; k <= 8; ++k) {
      const BaseMotion::Position both{k * base.cycle() / 8.3, over_time[at(200 * k)].time};
      const Eigen::VectorXd r = base.residual(both).torque, by_angle = base.residual({both.angle, origin.time}).torque,
                            by_time = base.residual({origin.angle, both.time}).torque;
      worst = std::max(worst, (r - by_angle - by_time + r0).cwiseAbs().maxCoeff());
      largest = std::max(largest, (r - r0).cwiseAbs().maxCoeff());
    }
    if (worst > misfit_reported * largest)
      found_.notes.push_back(fmt::format(
          "torques depend on angle and time together: split into orders and frequencies they are off by up to "
          "{:.1g} of the largest",
          worst / largest));
  }

  // Teeth of the driving wheel times the speed of its shaft, stage by stage.
  void find_meshes() {
    for (const auto& [gearbox, gears] : m_.network.data.all<GearStages>()) {
      double ratio = m_.scale_ratio[at(m_.network.ports.at(gearbox).in)];
      int k = 0;
      for (const GearStages::Stage& stage : gears.stages) {
        const auto [driving, driven] = stage.teeth;
        found_.meshes.push_back(
            {fmt::format("{}, stage {}: {:g}/{:g} teeth", gearbox, ++k, driving, driven), driving * ratio});
        ratio *= driving / driven;
      }
    }
  }

  const LinearDrive& drive_;
  const Model& m_;
  double fastest_, highest_order_;
  bool further_;
  std::size_t samples_ = 0;
  Excitations found_;
};

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

// Lagrange's polynomial through the values at the node speeds.
Complex OrderSource::at(std::size_t harmonic, double speed) const {
  if (!nodes) return values.front()[harmonic];
  const std::vector<double>& w = *nodes;
  Complex sum = 0;
  for (std::size_t i = 0; i < w.size(); ++i) {
    double weight = 1;
    for (std::size_t k = 0; k < w.size(); ++k)
      if (k != i) weight *= (speed - w[k]) / (w[i] - w[k]);
    sum += weight * values[i][harmonic];
  }
  return sum;
}

double Excitations::strength(std::size_t harmonic, double w) const {
  double sum = 0;
  for (const OrderSource& source : at_speed(w))
    if (source.kind == LeftOver::torque) sum += std::abs(source.at(harmonic, w));
  return sum;
}

Excitations find_excitations(const LinearDrive& drive, double fastest, double highest_order, bool further) {
  return SourceSearch(drive, fastest, highest_order, further).find_all();
}

std::shared_ptr<const Eigen::VectorXd> mean_missed(const LinearDrive& drive, const Excitations& excitations,
                                                   double speed) {
  auto mean = std::make_shared<Eigen::VectorXd>(Eigen::VectorXd::Zero(drive.size()));
  for (const OrderSource& source : excitations.by_order)
    if (source.kind == LeftOver::torque) (*mean)[source.index] += source.at(0, speed).real();
  return mean;
}

std::vector<double> inertia_variation(const LinearDrive& drive, const Eigen::VectorXd& shape, std::size_t harmonics) {
  const Model& m = *drive.model;
  const CyclePeriod cycle = cycle_of(m);
  std::size_t samples = 1024;
  while (samples < 8 * harmonics) samples *= 2;
  const Eigen::VectorXd moving = drive.motion * shape;
  std::vector<double> amplitude(m.shafts.size(), 0.0);
  for (std::size_t i = 0; i < drive.shaft.size(); ++i)
    amplitude[at(drive.shaft[i])] = moving[static_cast<Eigen::Index>(i)];
  std::vector<double> modal(samples, 0.0);
  for (const Network::ShaftElement& e : m.network.elements) {
    if (e.element->cycle == 0) continue;
    const double weight = std::pow(m.gain_of_node[at(e.node)] * amplitude[at(m.shaft_of_node[at(e.node)])], 2);
    const double ratio = m.node_ratio[at(e.node)];
    if (weight == 0) continue;
    Deadline::check();
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
