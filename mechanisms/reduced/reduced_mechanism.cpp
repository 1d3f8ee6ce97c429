// reduced_mechanism.cpp — tabulates the reduced functions of a mechanism and keeps the tables that were made.
#include "mechanisms/reduced/reduced_mechanism.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <condition_variable>
#include <map>
#include <mutex>
#include <numbers>
#include <set>
#include <span>
#include <stdexcept>
#include <utility>
#include <vector>

#include "engine/numerics/deadline.h"

namespace kurbel {

namespace {

std::vector<ChannelSpec> channel_specs(const ReducedMechanism::NoiseScales& noise) {
  using enum ErrorScale;
  return {{"inertia", own_value, 10 * noise.inertia},
          {"inertia_slope", own_maximum, noise.inertia},
          {"inertia_curvature", own_maximum, noise.inertia},
          {"output_position", own_maximum, 0},
          {"output_velocity_ratio", own_maximum, 0},
          {"output_acceleration_ratio", own_maximum, noise.output},
          {"gravity_torque", own_maximum, noise.gravity_torque},
          {"gravity_torque_slope", own_maximum, noise.gravity_torque}};
}

// On an arc the channels grow by orders towards the ends: each counts by itself, and where it passes zero by what it is
// usually, which follows from the inertia in the middle, the arc and the output.
std::vector<ChannelSpec> arc_specs(const ReducedSample& middle, const CrankArc& arc, double reach) {
  using enum ErrorScale;
  const double inertia = middle.inertia / arc.half;
  const double ratio = std::max(std::abs(middle.output_velocity_ratio), 0.1 * reach);
  const double weight = middle.gravity_torque_scale;
  return {{"inertia", own_value, 0},
          {"inertia_slope", own_value, inertia},
          {"inertia_curvature", own_value, inertia / arc.half},
          {"output_position", own_value, reach},
          {"output_velocity_ratio", own_value, ratio},
          {"output_acceleration_ratio", own_value, ratio / arc.half},
          {"gravity_torque", own_value, weight},
          {"gravity_torque_slope", own_value, weight / arc.half}};
}

void write_channels(const ReducedSample& sample, std::span<double> values) {
  using enum ReducedMechanism::Channel;
  values[inertia_channel] = sample.inertia;
  values[inertia_slope] = sample.inertia_slope;
  values[inertia_curvature] = sample.inertia_curvature;
  values[output_position_channel] = sample.output_position;
  values[output_velocity_ratio] = sample.output_velocity_ratio;
  values[output_acceleration_ratio] = sample.output_acceleration_ratio;
  values[gravity_torque_channel] = sample.gravity_torque;
  values[gravity_torque_slope] = sample.gravity_torque_slope;
}

// Rounding leaves 1e-16 of the inertia in I_r′ and of the weights' torques in M_g even where these vanish identically
// (masses balanced, weights carried by the guide).
ReducedMechanism::NoiseScales noise_scales(const std::function<ReducedSample(double phi)>& sampler,
                                           const CrankCycle& cycle, bool slides) {
  constexpr int n = 16;
  const double part =
      cycle.change_points().empty() && !cycle.arc() ? 1e-4 : 0.1;  // beside those derivatives have fewer digits
  ReducedMechanism::NoiseScales noise;
  if (slides) noise.reach = 0;
  for (int i = 0; i < n; ++i) {
    const ReducedSample sample = sampler(cycle.angle_at(2 * std::numbers::pi * (i + 0.5) / n));
    noise.inertia += part * sample.inertia / n;
    noise.gravity_torque += 0.1 * sample.gravity_torque_scale / n;
    noise.output += part * std::abs(sample.output_velocity_ratio) / n;
    if (slides) noise.reach += std::abs(sample.output_position) / n;
  }
  return noise;
}

using CacheKey = std::pair<std::type_index, std::vector<double>>;

CacheKey cache_key(const MechanismData& data, double tolerance, std::size_t max_pieces, Extraction extraction) {
  std::vector<double> values = data.values();
  values.insert(values.end(), {tolerance, static_cast<double>(max_pieces), static_cast<double>(extraction)});
  return {data.kind(), std::move(values)};
}

// Tables requested lately. Each is made once, without a lock: a request for another one does not wait.
class TableCache {
 public:
  using Table = std::shared_ptr<const ReducedMechanism>;

  template <class Make>
  Table get(const CacheKey& key, const Make& make) {
    std::unique_lock lock(mutex_);
    for (; in_work_.count(key); Deadline::check()) done_.wait_for(lock, std::chrono::milliseconds(20));
    if (const auto found = entries_.find(key); found != entries_.end()) {
      found->second.asked = ++asked_;
      return found->second.table;
    }
    in_work_.insert(key);
    lock.unlock();
    Table table;
    try {
      table = make();
    } catch (...) {  // whoever waited tries it, too
      finish(key, nullptr);
      throw;
    }
    finish(key, table);
    return table;
  }

 private:
  struct Entry {
    Table table;
    std::uint64_t asked;
  };

  void finish(const CacheKey& key, Table table) {
    const std::scoped_lock lock(mutex_);
    in_work_.erase(key);
    if (table) {
      const auto longest_ago = [](const auto& a, const auto& b) { return a.second.asked < b.second.asked; };
      if (entries_.size() >= capacity) entries_.erase(std::min_element(entries_.begin(), entries_.end(), longest_ago));
      entries_[key] = {std::move(table), ++asked_};
    }
    done_.notify_all();
  }

  static constexpr std::size_t capacity = 256;  // a table is 20 kB … 1 MB
  std::mutex mutex_;
  std::condition_variable done_;
  std::map<CacheKey, Entry> entries_;
  std::set<CacheKey> in_work_;
  std::uint64_t asked_ = 0;
};

// The page of a book that this is on; null: none.
const TableBook::Page* page_of(const TableBook& book, const CacheKey& key) {
  for (const TableBook::Page& page : book.pages)
    if (page.kind == key.first.name() && page.of == key.second) return &page;
  return nullptr;
}
thread_local TableBook* open_book = nullptr;

std::atomic<bool> rough_tables{false};
constexpr double rough_tolerance = 1e-3;
constexpr std::size_t rough_pieces = 16;

}  // namespace

TableBook::Open::Open(TableBook& book) : before_(std::exchange(open_book, &book)) {}
TableBook::Open::~Open() { open_book = before_; }

void take_rough_tables(bool rough) { rough_tables = rough; }

ReducedMechanism::ReducedMechanism(const Sampler& sampler, NoiseScales noise, double tolerance, std::size_t max_pieces,
                                   const PeriodicTable::Cut& cut, CrankCycle cycle, const Sampler& other)
    : cycle_(std::move(cycle)),
      rocks_(cycle_.arc().has_value()),
      part_(1.0 / cycle_.turns()),
      winding_(cycle_.winding()),
      table_(PeriodicTable::build(
          in_table(sampler),
          rocks_ ? arc_specs(sampler(cycle_.arc()->middle), *cycle_.arc(), noise.reach) : channel_specs(noise),
          tolerance, max_pieces, cut, other ? in_table(other) : PeriodicTable::Sampler())) {}

PeriodicTable::Sampler ReducedMechanism::in_table(const Sampler& sampler) const {
  return [this, &sampler](double part, std::span<double> values) {
    const double phi = cycle_.angle_at(part);
    write_channels(sampler(phi), values);
    double& output = values[output_position_channel];
    output = cycle_.periodic_part(phi, output);
  };
}

ReducedMechanism::ReducedMechanism(PeriodicTable table, CrankCycle cycle)
    : cycle_(std::move(cycle)),
      rocks_(cycle_.arc().has_value()),
      part_(1.0 / cycle_.turns()),
      winding_(cycle_.winding()),
      table_(std::move(table)) {}

ReducedMechanism extract_mechanism(const MechanismData& data, double tolerance, std::size_t max_pieces,
                                   Extraction extraction) {
  const ReducedMechanism::Sampler closed = [&](double phi) { return closed_sample(data, phi); };
  data.bodies_of();  // finds the data's faults
  const CrankCycle cycle(data);
  const auto noise = noise_scales(closed, cycle, !data.rocks());
  if (extraction == Extraction::first || !has_bodies)
    return ReducedMechanism(closed, noise, fine_tolerance * tolerance, max_pieces, fine_cut, cycle);

  const std::unique_ptr<MechanismBodies> bodies = data.make_bodies();
  double turns = 0;  // an output that rocks may count whole turns from another place [rad]
  const ReducedMechanism::Sampler by_bodies = [&](double phi) {
    ReducedSample sample = bodies->sample(phi);
    sample.output_position -= turns;
    return sample;
  };
  if (const double phi = cycle.angle_at(1); data.rocks()) {
    const double apart = by_bodies(phi).output_position - closed(phi).output_position;
    turns = apart - std::remainder(apart, 2 * std::numbers::pi);
  }
  ReducedMechanism confirmed(closed, noise, tolerance, max_pieces, {}, cycle, by_bodies);
  const auto agrees = [&](const TableReport::Channel& channel) { return channel.error <= tolerance; };
  if (const auto& channels = confirmed.report().channels; std::all_of(channels.begin(), channels.end(), agrees))
    return confirmed;
  return ReducedMechanism(by_bodies, noise, tolerance, max_pieces, {}, cycle, closed);
}

std::shared_ptr<const ReducedMechanism> reduce_mechanism(const MechanismData& data, double tolerance,
                                                         std::size_t max_pieces, Extraction extraction) {
  if (rough_tables) tolerance = rough_tolerance, max_pieces = rough_pieces, extraction = Extraction::first;
  const CacheKey key = cache_key(data, tolerance, max_pieces, extraction);
  for (const double value : key.second)
    if (std::isnan(value)) throw std::invalid_argument("reduce_mechanism: a value is no number");  // nor a key
  if (open_book)
    if (const TableBook::Page* page = page_of(*open_book, key))
      return std::make_shared<const ReducedMechanism>(
          PeriodicTable::from_numbers(page->numbers, ReducedMechanism::channel_count), CrankCycle(data));
  static TableCache cache;
  auto made = cache.get(key, [&] {
    return std::make_shared<const ReducedMechanism>(extract_mechanism(data, tolerance, max_pieces, extraction));
  });
  if (open_book) open_book->pages.push_back({key.first.name(), key.second, made->numbers()});
  return made;
}

}  // namespace kurbel
