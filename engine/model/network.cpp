// network.cpp — building blocks of the unmerged machine.
#include "engine/model/network.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/elements/piece_guard.h"
#include "engine/numerics/dual.h"

namespace kurbel {

int Network::add_node(const std::string& component, const std::string& label, double inertia) {
  nodes.push_back({component, label, inertia, -1});
  return static_cast<int>(nodes.size()) - 1;
}

double Network::Chain::wave_rate() const { return std::sqrt(stiffness / inertia); }

double Network::share_of_twist(const Joint& joint) const {
  if (joint.chain < 0) return 1;
  const Chain& shaft = chains[static_cast<std::size_t>(joint.chain)];
  return shaft.degree > 0 ? shaft.stiffness / joint.element->stiffness
                          : 1 / static_cast<double>(shaft.nodes.size() - 1);
}

std::string Network::kind_of(const std::string& component) const {
  const auto kind = kinds.find(component);
  return kind == kinds.end() ? "" : kind->second;
}

void Network::join(int a, int b, double ratio, const std::string& component) {
  joints.push_back({.a = a, .b = b, .ratio = ratio, .component = component});
}

void Network::put(int node, const std::string& component, ShaftForm element, Window window, double phase) {
  elements.push_back({node, component, std::move(element), window, phase, -1});
}

void Network::prescribe(int node, PrescribedSpeed speed) {
  nodes[static_cast<std::size_t>(node)].prescribed = static_cast<int>(prescribed.size());
  prescribed.push_back(std::move(speed));
}

int PrescribedSpeed::piece(double t) const {
  if (!law.empty()) return TimedPiece::at(law, t);
  return static_cast<int>(std::upper_bound(time.begin(), time.end(), t) - time.begin()) - 1;
}

double PrescribedSpeed::value(double t, int piece) const {
  const double sine = amplitude * std::sin(2 * M_PI * frequency * t + phase);
  if (!law.empty()) return law.value_in(piece, TimedPiece::near(law, piece, t)) + sine;
  const auto last = static_cast<int>(time.size()) - 1;
  const auto i = static_cast<std::size_t>(std::clamp(piece, 0, last));
  const double base = piece < 0 || piece >= last
                          ? speed[i]
                          : speed[i] + (t - time[i]) * (speed[i + 1] - speed[i]) / (time[i + 1] - time[i]);
  return base + sine;
}

double PrescribedSpeed::slope(double t, int piece) const {
  const auto last = static_cast<int>(time.size()) - 1;
  double base = 0;
  if (!law.empty())
    base = law.value_in(piece, Dual<1>::input(TimedPiece::near(law, piece, t), 0)).d[0];
  else if (piece >= 0 && piece < last) {
    const auto i = static_cast<std::size_t>(piece);
    base = (speed[i + 1] - speed[i]) / (time[i + 1] - time[i]);
  }
  return base + amplitude * 2 * M_PI * frequency * std::cos(2 * M_PI * frequency * t + phase);
}

bool PrescribedSpeed::is_nothing() const { return follows.empty() && amplitude == 0 && greatest() == 0; }

double PrescribedSpeed::greatest() const {
  double most = law.empty() ? 0 : law.max_abs();
  for (const double w : speed) most = std::max(most, std::abs(w));
  return most;
}

double PrescribedSpeed::settled_speed() const {
  if (law.empty()) return speed.back();
  if (law.period() == 0) return law.y().back();
  double sum = 0;
  for (std::size_t i = 0; i + 1 < law.x().size(); ++i) sum += law.area(static_cast<int>(i), law.x()[i], law.x()[i + 1]);
  return sum / law.period();
}

double PrescribedSpeed::settled_from() const {
  if (!law.empty()) return TimedPiece::settled_from(law);
  return time.empty() ? -HUGE_VAL : time.back();
}

double PrescribedSpeed::next_edge(double t) const {
  if (!law.empty()) return TimedPiece::next_edge(law, t);
  if (time.size() < 2) return std::numeric_limits<double>::infinity();
  const auto after = std::upper_bound(time.begin(), time.end(), t);
  return after == time.end() ? std::numeric_limits<double>::infinity() : *after;
}

void Network::limit(DataRange range, const Curve& curve, bool mirrored) {
  const auto is_said = [](Beyond beyond) { return beyond == Beyond::hold || beyond == Beyond::line; };
  if (curve.empty() || curve.period() > 0 || (is_said(curve.beyond_first()) && is_said(curve.beyond_last()))) return;
  range.low = mirrored ? -curve.x().back() : curve.x().front(), range.high = curve.x().back();
  range.below = curve.beyond_first(), range.above = curve.beyond_last();
  range.line_below = curve.follows_slope(false), range.line_above = curve.follows_slope(true);
  ranges.push_back(std::move(range));
}

}  // namespace kurbel
