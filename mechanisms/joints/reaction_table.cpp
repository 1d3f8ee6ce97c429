// reaction_table.cpp — tabulates those of the sampled reactions that vary; the signs that turn.
#include "mechanisms/joints/reaction_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "mechanisms/joints/reaction_sampler.h"
#include "mechanisms/reduced/periodic_table.h"
#include "mechanisms/reduced/reduced_mechanism.h"

namespace kurbel {
namespace {

using Rub = JointFriction::Joint;
using Sampler = ReactionSampler;

// A coefficient that never leaves this part of what those of its case are is none; one that varies by less is constant.
constexpr double nothing = 1e-13;
// Coefficients far below others of their case count by this part of these.
constexpr double least_part = 1e-3;

// What is constant over φ as a constant, the rest in a periodic table over part · φ, of a crank that rocks over σ.
class TabulatedReactions final : public ReactionTable {
 public:
  TabulatedReactions(const Sampler& sampler, CrankCycle cycle, Extraction extraction)
      : places_(sampler.places()), cycle_(std::move(cycle)), constant_(places_.size()) {
    std::vector<ChannelSpec> channels = sort_out(sampler);
    std::vector<double> all(places_.size());
    const bool first = extraction == Extraction::first;
    if (channels.empty()) return;
    table_ = PeriodicTable::build(
        [&](double part, std::span<double> values) {
          sampler(cycle_.angle_at(part), all.data());
          for (std::size_t k = 0; k < place_.size(); ++k) values[k] = all[place_[k]];
        },
        std::move(channels), (first ? 1 : fine_tolerance) * table_tolerance, table_max_pieces,
        first ? PeriodicTable::Cut() : fine_cut);
  }

  const ReactionPlaces& places() const override { return places_; }
  void read(double phi, double* values) const override {
    std::copy(constant_.begin(), constant_.end(), values);
    move(phi, values);
  }
  void move(double phi, double* values) const override {
    if (place_.empty()) return;
    const PeriodicTable::Cursor at = table_.locate(cycle_.part_of(phi));
    for (std::size_t k = 0; k < place_.size(); ++k) values[place_[k]] = PeriodicTable::value(at, k);
  }
  void read(double phi, double* values, double* slopes) const override {
    read(phi, values);
    std::fill_n(slopes, places_.size(), 0.0);
    if (place_.empty()) return;
    const PeriodicTable::Cursor at = table_.locate(cycle_.part_of(phi));
    const double rate = cycle_.part_rate(phi);
    for (std::size_t k = 0; k < place_.size(); ++k) slopes[place_[k]] = rate * PeriodicTable::slope(at, k);
  }
  One read_one(double phi, std::size_t place) const override {
    const auto found = std::lower_bound(place_.begin(), place_.end(), place);
    if (found == place_.end() || *found != place) return {constant_[place], 0};
    const PeriodicTable::Cursor at = table_.locate(cycle_.part_of(phi));
    const auto channel = static_cast<std::size_t>(found - place_.begin());
    return {PeriodicTable::value(at, channel), cycle_.part_rate(phi) * PeriodicTable::slope(at, channel)};
  }
  std::string describe() const override {
    if (place_.empty()) return "reactions that are constant";
    const TableReport& report = table_.report();
    double worst = 0;
    for (const TableReport::Channel& channel : report.channels) worst = std::max(worst, channel.error);
    return fmt::format("reactions: {} coefficients in {} pieces from {} samples, error {:.0e}{}", place_.size(),
                       report.pieces, report.samples, worst,
                       report.converged ? " (relative)" : "; the tolerance was not reached");
  }

 private:
  // Which places vary; their scales are those of their case, of forces and moments by themselves.
  std::vector<ChannelSpec> sort_out(const Sampler& sampler) {
    constexpr int samples = 48;
    const std::size_t size = places_.size();
    std::vector<double> least(size, HUGE_VAL), most(size, -HUGE_VAL), here(size);
    const bool rocks = cycle_.arc().has_value();
    Sampler::Greatest widest;
    for (int i = 0; i < samples; ++i) {
      const double phi = cycle_.angle_at(2 * std::numbers::pi * (i + 0.37) / samples);
      sampler(phi, here.data());
      sampler.widen(phi, widest);
      for (std::size_t k = 0; k < size; ++k)
        least[k] = std::min(least[k], here[k]), most[k] = std::max(most[k], here[k]);
    }
    const auto greatest = [&](std::size_t k) { return std::max(std::abs(least[k]), std::abs(most[k])); };
    const auto is_moment = [&](std::size_t k) {
      const std::size_t reaction = k % places_.reactions();
      return reaction >= places_.joints && sampler.joints[reaction - places_.joints].slides;
    };
    const auto pin_ratio = [&](std::size_t k) {
      return std::any_of(sampler.joints.begin(), sampler.joints.end(),
                         [&](const Rub& j) { return !j.slides && places_.ratio(j.load) == k; });
    };
    const auto group = [&](std::size_t k) {  // the largest of its case
      if (k >= places_.ratio(0)) return pin_ratio(k) ? 1.0 : greatest(k);
      return (is_moment(k) ? widest.moment : widest.force)[k / places_.reactions()];
    };
    std::vector<ChannelSpec> channels;
    for (std::size_t k = 0; k < size; ++k) {
      const double scale = group(k);
      constant_[k] = greatest(k) <= nothing * scale ? 0 : 0.5 * (least[k] + most[k]);
      if (most[k] - least[k] <= nothing * std::max(scale, greatest(k))) continue;
      place_.push_back(k);
      channels.push_back(
          {fmt::format("reaction {}", k), rocks ? ErrorScale::own_value : ErrorScale::own_maximum, least_part * scale});
    }
    return channels;
  }

  ReactionPlaces places_;
  CrankCycle cycle_;
  std::vector<double> constant_;
  std::vector<std::size_t> place_;  // of each channel
  PeriodicTable table_;
};

// Signs that turn: one for all ratios that are each other's or their opposites; the output's where a ratio is x′.
void put_signs(const Sampler& sampler, const CrankCycle& cycle, std::vector<Rub>& joints,
               std::vector<JointFriction::Turning>& turnings) {
  constexpr int samples = 96;
  constexpr double same = 1e-9;
  const ReactionPlaces& places = sampler.places();
  std::vector<std::vector<double>> ratio(joints.size());
  std::vector<double> output, here(places.size());
  for (int i = 0; i < samples; ++i) {
    const double phi = cycle.angle_at(2 * std::numbers::pi * (i + 0.37) / samples);
    sampler(phi, here.data());
    output.push_back(sampler.output_ratio(phi));
    for (std::size_t j = 0; j < joints.size(); ++j) ratio[j].push_back(here[places.ratio(joints[j].load)]);
  }
  const auto scale_of = [](const std::vector<double>& f) {
    double greatest = 0;
    for (const double value : f) greatest = std::max(greatest, std::abs(value));
    return greatest;
  };
  // 1, −1 where f = ± g; else 0.
  const auto sense_of = [&](const std::vector<double>& f, const std::vector<double>& g) {
    double plus = 0, minus = 0;
    for (std::size_t i = 0; i < f.size(); ++i)
      plus = std::max(plus, std::abs(f[i] - g[i])), minus = std::max(minus, std::abs(f[i] + g[i]));
    const double enough = same * scale_of(g);
    return plus <= enough ? 1 : minus <= enough ? -1 : 0;
  };
  std::vector<std::size_t> first;  // joint of each turning
  for (std::size_t j = 0; j < joints.size(); ++j) {
    if (!joints[j].slides && scale_of(ratio[j]) <= nothing) continue;  // a pin that never turns
    const auto [least, most] = std::minmax_element(ratio[j].begin(), ratio[j].end());
    if (*least > 0 || *most < 0) {  // always the same way
      const double scale = scale_of(ratio[j]);
      if (std::min(std::abs(*least), std::abs(*most)) > 0.02 * scale) continue;
    }
    if (const int sense = sense_of(ratio[j], output); sense != 0) {
      joints[j].sign = Rub::of_travel, joints[j].sense = sense;
      continue;
    }
    for (std::size_t k = 0; k < first.size() && joints[j].sign < 0; ++k)
      if (const int sense = sense_of(ratio[j], ratio[first[k]]); sense != 0)
        joints[j].sign = static_cast<int>(k), joints[j].sense = sense;
    if (joints[j].sign >= 0) continue;
    joints[j].sign = static_cast<int>(first.size());
    first.push_back(j);
    turnings.push_back({joints[j].load, scale_of(ratio[j])});
  }
}

}  // namespace

std::string refusal_of_joint_friction(const MechanismData& data, const CrankCycle& cycle) {
  if (const std::string why = data.undetermined(); !why.empty()) return why;
  if (!cycle.change_points().empty())
    return "it passes change points, where reactions have no bound and friction by them jams the crank";
  return {};
}

std::shared_ptr<const JointFriction> tabulate_joint_friction(const MechanismData& data,
                                                             const std::vector<RubbingJoint>& rubbing,
                                                             const OffThePin& off,
                                                             const std::vector<ActsWithin>& within,
                                                             Extraction extraction) {
  CrankCycle cycle(data);
  if (const std::string why = refusal_of_joint_friction(data, cycle); !why.empty()) throw std::invalid_argument(why);
  Sampler sampler(data, rubbing, off, within);
  std::vector<JointFriction::Turning> turnings;
  std::vector<Rub> joints = sampler.joints;
  if (joints.empty()) return nullptr;
  put_signs(sampler, cycle, joints, turnings);
  std::vector<std::string> names;
  for (const ActsWithin& acts : within) names.push_back(acts.name);
  return std::make_shared<JointFriction>(std::move(joints), std::move(turnings),
                                         std::make_shared<TabulatedReactions>(sampler, std::move(cycle), extraction),
                                         std::move(names));
}

}  // namespace kurbel
