// speed_history.cpp — stretches of the speed, and the last time outside a band among them.
#include "engine/run/speed_history.h"
#include "engine/numerics/roots.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <tuple>

namespace kurbel {
namespace {

constexpr std::size_t last_point = BandHistory::points - 1;

// −1 … 1
const std::array<double, BandHistory::points>& chebyshev() {
  static const auto made = [] {
    std::array<double, BandHistory::points> x{};
    for (std::size_t k = 0; k < x.size(); ++k) x[k] = -std::cos(static_cast<double>(k) * std::numbers::pi / last_point);
    x[last_point / 2] = 0;
    return x;
  }();
  return made;
}

// Minima that differ by less are one minimum that repeats: the later one counts.
constexpr double same_extreme = 1e-9;
// Of the golden section, to 3e-6 of two points' distance: round-off hides nearer ones from each other.
constexpr int extreme_steps = 26;

// Where g ≥ 0 for good within the stretch, if g(inside_out) < 0 at a known time. The end where it is negative there.
template <class G>
double enters(const BandHistory::Stretch& s, const G& g, double negative_at) {
  if (g(s.end) < 0) return s.end;
  constexpr int places = 32;
  double right = s.end, value = g(right);
  for (int k = places - 1; k >= 0; --k) {
    double t = s.begin + (s.end - s.begin) * k / places;
    if (t < negative_at && right > negative_at) t = negative_at;
    const double there = g(t);
    if (there < 0) return find_root(g, t, there, right, value);
    right = t;
    value = there;
  }
  return s.begin;
}

}  // namespace

double BandHistory::Stretch::time(std::size_t point) const {
  return point == 0            ? begin
         : point == last_point ? end
                               : 0.5 * (begin + end) + 0.5 * (end - begin) * chebyshev()[point];
}

// Barycentric: weights ±1, half at the ends (Berrut, Trefethen 2004).
double BandHistory::Stretch::at(double t) const {
  if (t >= end) return value[last_point];
  if (t <= begin) return value[0];
  const double x = (2 * t - begin - end) / (end - begin);
  double above = 0, below = 0;
  for (std::size_t k = 0; k < points; ++k) {
    const double distance = x - chebyshev()[k];
    if (distance == 0) return value[k];
    const double weight = (k % 2 == 0 ? 1.0 : -1.0) * (k == 0 || k == last_point ? 0.5 : 1.0) / distance;
    above += weight * value[k];
    below += weight;
  }
  return above / below;
}

Works BandHistory::Stretch::work_at(double t) const {
  constexpr std::size_t last = points / 2;
  if (t >= end) return work[last];
  if (t <= begin) return work[0];
  const double x = (2 * t - begin - end) / (end - begin);
  Works above{};
  double below = 0;
  for (std::size_t k = 0; k <= last; ++k) {
    const double distance = x - chebyshev()[2 * k];
    if (distance == 0) return work[k];
    const double weight = (k % 2 == 0 ? 1.0 : -1.0) * (k == 0 || k == last ? 0.5 : 1.0) / distance;
    for (std::size_t i = 0; i < above.size(); ++i) above[i] += weight * work[k][i];
    below += weight;
  }
  for (double& sum : above) sum /= below;
  return above;
}

void BandHistory::Stretch::find_extremes() {
  const auto extreme = [&](double sign, double& value_there, double& time_there) {
    std::size_t best = 0;
    for (std::size_t k = 1; k < points; ++k)
      if (sign * value[k] < sign * value[best]) best = k;
    value_there = value[best];
    time_there = time(best);
    // Towards an end only where the curve's next point does not rise as fast as it did before.
    if (begin == end) return;
    const double from = time(best == 0 ? 0 : best - 1), to = time(best == last_point ? last_point : best + 1);
    const double inside = best == 0 ? time(0) + 1e-3 * (to - time(0)) : time(best) - 1e-3 * (time(best) - from);
    if ((best == 0 || best == last_point) && sign * at(inside) >= sign * value[best]) return;
    const Maximum found = find_maximum([&](double x) { return -sign * at(x); }, from, to, extreme_steps);
    if (-found.value < sign * value_there) {
      value_there = -sign * found.value;
      time_there = found.at;
    }
  };
  extreme(1, lowest, lowest_at);
  extreme(-1, highest, highest_at);
}

void BandHistory::add(const Stretch& s) {
  const double slack = same_extreme * std::max(std::abs(s.lowest), std::abs(s.highest));
  while (!low_.empty() && low_.back().lowest >= s.lowest - slack) low_.pop_back();
  while (!high_.empty() && high_.back().highest <= s.highest + slack) high_.pop_back();
  low_.push_back(s);
  high_.push_back(s);
}

void BandHistory::append(const BandHistory& later) {
  if (later.empty()) return;
  while (!low_.empty() && low_.back().lowest >= later.low_.front().lowest) low_.pop_back();
  while (!high_.empty() && high_.back().highest <= later.high_.front().highest) high_.pop_back();
  low_.insert(low_.end(), later.low_.begin(), later.low_.end());
  high_.insert(high_.end(), later.high_.begin(), later.high_.end());
}

void BandHistory::clear() {
  low_.clear();
  high_.clear();
}

std::optional<double> BandHistory::last_outside(double low, double high) const {
  asked_.insert(asked_.end(), {low, high});
  std::optional<double> last;
  const auto below = std::partition_point(low_.begin(), low_.end(), [&](const Stretch& s) { return s.lowest < low; });
  if (below != low_.begin()) {
    const Stretch& s = *std::prev(below);
    last = enters(
        s, [&](double t) { return s.at(t) - low; }, s.lowest_at);
  }
  const auto above =
      std::partition_point(high_.begin(), high_.end(), [&](const Stretch& s) { return s.highest > high; });
  if (above != high_.begin()) {
    const Stretch& s = *std::prev(above);
    const double t = enters(
        s, [&](double x) { return high - s.at(x); }, s.highest_at);
    last = std::max(t, last.value_or(t));
  }
  return last;
}

const BandHistory::Stretch* BandHistory::stretch_at(double t) const {
  for (const auto* list : {&low_, &high_})
    for (const Stretch& s : *list)
      if (s.begin <= t && t <= s.end) return &s;
  return nullptr;
}

// ---------------------------------------------------------------------------------------------------------------------

namespace {

Works works_in(const Equations& equations, std::span<const double> y) {
  Works sums{};
  const std::vector<WorkAccount>& accounts = equations.model().accounts;
  for (std::size_t k = 0; k < accounts.size(); ++k)
    sums[static_cast<std::size_t>(accounts[k].kind)] += y[equations.work_index(k)];
  return sums;
}

}  // namespace

void SpeedRecorder::begin(double t, std::span<const double> y, Equations& equations) {
  const Model& m = equations.model();
  const auto node = static_cast<std::size_t>(m.reduction_node);
  shaft_ = static_cast<std::size_t>(m.shaft_of_node[node]);
  gain_ = m.gain_of_node[node];
  angle_ = static_cast<std::size_t>(m.reduction_angle);
  free_ = shaft_ < m.free_shafts;
  sources_.emplace(m);
  audited_ = equations.audit() && m.cycle > 0;
  if (m.cycle == 0 && t == 0 && angles_.empty()) angles_.push_back(equations.angle_with_turns(angle_, y));
}

// Elements are switched between steps only, at events and edges.
bool SpeedRecorder::is_driven(StepView& view) const {
  if (!view.begins_anew()) return on_;
  return sources_->none() || sources_->drive(view.equations().modes().active);
}

double SpeedRecorder::speed_at(StepView& view, double t) const {
  if (!free_) return gain_ * view.snapshot(t).now.speed[shaft_];
  return gain_ * view.at(t, view.equations().speed_index(static_cast<int>(shaft_)));
}

// Of itself: levels of a run repeated at another tolerance differ by far less, steady motion is 1 % from its band's edges.
constexpr double near_level = 1e-3;

std::vector<double> SpeedRecorder::asked() const {
  std::vector<double> levels = driven_.asked();
  levels.insert(levels.end(), coasting_.asked().begin(), coasting_.asked().end());
  return levels;
}

bool SpeedRecorder::answered() const {
  const std::vector<double> levels = asked();
  return !levels_ || std::all_of(levels.begin(), levels.end(), [&](double level) {
    return std::any_of(levels_->begin(), levels_->end(),
                       [&](double known) { return std::abs(level - known) <= near_level * std::abs(known); });
  });
}

// The speed exceeds its ends within a step by at most 4/27 h (|α₀| + |α₁|) as a cubic; the limit used is some seven times
// as large.
bool SpeedRecorder::stays_away(StepView& view) const {
  if (!levels_ || !free_) return false;
  const std::size_t state = view.equations().speed_index(static_cast<int>(shaft_));
  const auto [low, high] = std::minmax({gain_ * view.y_previous()[state], gain_ * view.y()[state]});
  const double slopes = std::abs(view.ydot_previous()[state]) + std::abs(view.ydot()[state]);
  const double reach = (view.t() - view.t_previous()) * std::abs(gain_) * slopes;
  return std::none_of(levels_->begin(), levels_->end(), [&, low = low, high = high](double level) {
    const double slack = reach + near_level * std::abs(level);
    return low - slack <= level && level <= high + slack;
  });
}

// Stands for all between, as no requested level lies there.
BandHistory::Stretch SpeedRecorder::ends_of(StepView& view) const {
  BandHistory::Stretch s{.begin = view.t_previous(), .end = view.t()};
  const double first = speed_at(view, s.begin), last = speed_at(view, s.end);
  s.value.fill(first);
  s.value.back() = last;
  const bool rises = last > first;
  std::tie(s.lowest, s.highest) = std::minmax(first, last);
  s.lowest_at = rises ? s.begin : s.end;
  s.highest_at = rises ? s.end : s.begin;
  if (audited_) {
    s.work.front() = works_in(view.equations(), view.y_previous());
    s.work.back() = works_in(view.equations(), view.y());
  }
  return s;
}

BandHistory::Stretch SpeedRecorder::stretch_of(StepView& view) const {
  if (stays_away(view)) return ends_of(view);
  BandHistory::Stretch s{.begin = view.t_previous(), .end = view.t()};
  for (std::size_t k = 0; k < BandHistory::points; ++k) s.value[k] = speed_at(view, s.time(k));
  s.find_extremes();
  for (std::size_t k = 0; k < s.work.size() && audited_; ++k) {
    const bool first = k == 0, last = k + 1 == s.work.size();
    s.work[k] = works_in(view.equations(), first ? view.y_previous() : last ? view.y() : view.at(s.time(2 * k)));
  }
  return s;
}

std::optional<Works> SpeedRecorder::works_at(double t) const {
  if (!audited_) return {};
  if (t == off_since_) return works_off_;
  for (const BandHistory* history : {&driven_, &coasting_})
    if (const BandHistory::Stretch* s = history->stretch_at(t)) return s->work_at(t);
  return {};
}

void SpeedRecorder::step(StepView& view) {
  on_ = is_driven(view);
  if (on_ && off_since_) {  // the pause belongs to the drive's time
    driven_.append(coasting_);
    coasting_.clear();
    off_since_.reset();
  }
  if (!on_ && !off_since_) {
    off_since_ = view.t_previous();
    if (audited_) works_off_ = works_in(view.equations(), view.y_previous());
  }
  (on_ ? driven_ : coasting_).add(stretch_of(view));
  while (!angles_.empty() && angles_.size() <= grid) {
    const double t = angles_.size() == grid ? until_ : interval() * static_cast<double>(angles_.size());
    if (t > view.t()) break;
    angles_.push_back(view.equations().angle_with_turns(angle_, view.at(t)));
  }
}

}  // namespace kurbel
