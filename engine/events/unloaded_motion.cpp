// unloaded_motion.cpp — one walk through all that ties shafts together.
#include "engine/events/unloaded_motion.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/numerics/index.h"

namespace kurbel {
namespace {

constexpr double fits = 1e-12;  // of its terms: the usual motion obeys a relation

// x of an input with x − rest_twist(x) = output: the left side is monotone, its slope the joint's ratio.
double input_at(const AnyConnection& joint, double output) {
  double low = output - std::numbers::pi, high = output + std::numbers::pi, x = output;
  for (int pass = 0; pass < 200; ++pass) {
    const double off = x - joint.rest_twist(x) - output;
    (off > 0 ? high : low) = x;
    const double newton = x - off / joint.rest_ratio(x);
    const double next = newton > low && newton < high ? newton : 0.5 * (low + high);
    if (next == x || !(low < high)) break;
    x = next;
  }
  return x;
}

class Traversal {
 public:
  Traversal(const Model& model, const KnownMotion& known)
      : m_(model),
        given_(known),
        joints_at_(model.shafts.size()),
        reached_(model.shafts.size(), 0),
        done_(model.relations.size(), 0) {
    motion_.angle = known.angles;
    motion_.angle.resize(m_.shafts.size());
    motion_.speed.resize(m_.shafts.size());
    motion_.bend.resize(m_.shafts.size());
    motion_.twist.resize(m_.elastic.size());
    usual_turn_ = known.angle / usual(known.shaft);
    if (!std::isfinite(usual_turn_)) usual_turn_ = 0;
    for (std::size_t j = 0; j < m_.elastic.size(); ++j)
      for (const int s : {m_.elastic[j].shaft_a, m_.elastic[j].shaft_b}) joints_at_[at(s)].push_back(j);
    reach(known.shaft, usual(known.shaft) == 0 ? known.angle : usual(known.shaft) * usual_turn_, usual(known.shaft));
  }

  UnloadedMotion motion() {
    for (;;) {
      for (; next_ < order_.size(); ++next_)
        for (const std::size_t j : joints_at_[at(order_[next_])]) pass_elastic_joint(j);
      if (pass_relation()) continue;
      const auto left = std::find(reached_.begin(), reached_.end(), 0);
      if (left == reached_.end()) break;
      const int s = static_cast<int>(left - reached_.begin());
      reach(s, usual(s) * usual_turn_, usual(s));
    }
    for (std::size_t j = 0; j < m_.elastic.size(); ++j) set_twist(j);
    return std::move(motion_);
  }

 private:
  double usual(int shaft) const { return m_.node_ratio[at(m_.shafts[at(shaft)].reference)]; }
  bool is_usual(int shaft) const {
    return motion_.speed[at(shaft)] == usual(shaft) && motion_.bend[at(shaft)] == 0 &&
           motion_.angle[at(shaft)] == usual(shaft) * usual_turn_;
  }
  // Held in the usual motion, too.
  bool stands(int shaft) const {
    const int p = m_.shafts[at(shaft)].prescribed;
    return p >= 0 && m_.network.prescribed[at(p)].is_nothing() && usual(shaft) == 0;
  }
  void reach(int shaft, double angle, double speed, double bend = 0) {
    reached_[at(shaft)] = 1;
    order_.push_back(shaft);
    if (given_.angles.empty()) motion_.angle[at(shaft)] = angle;
    motion_.speed[at(shaft)] = speed;
    motion_.bend[at(shaft)] = bend;
  }

  // From the side that is reached to the other: unloaded.
  void pass_elastic_joint(std::size_t j) {
    const ElasticJoint& e = m_.elastic[j];
    if (reached_[at(e.shaft_a)] && reached_[at(e.shaft_b)]) return;
    const bool forward = reached_[at(e.shaft_a)];
    const int from = forward ? e.shaft_a : e.shaft_b, to = forward ? e.shaft_b : e.shaft_a;
    const AnyConnection& element = *m_.network.joints[at(e.joint)].element;
    const std::optional<double> own = given_twist(j);
    if (!element.is.uses_angle && !own && is_usual(from)) return reach(to, usual(to) * usual_turn_, usual(to));
    const double known = (forward ? e.gain_a : e.gain_b) * motion_.angle[at(from)];
    double input = known;  // angle of a at the joint
    if (!given_.angles.empty())
      input = e.gain_a * motion_.angle[at(e.shaft_a)];
    else if (!forward)
      input = own ? known + *own : element.is.uses_angle ? input_at(element, known) : known;
    // ω_b = g′ ω_a and ε_b = g′ ε_a + g″ ω_a² at the joint
    const double twist = own ? *own : element.rest_twist(input), ratio = element.rest_ratio(input);
    const double slope = element.rest_ratio_slope(input);
    const double speed = motion_.speed[at(from)], bend = motion_.bend[at(from)];
    if (forward) {
      const double speed_a = e.gain_a * speed;
      reach(to, (input - twist) / e.gain_b, ratio * e.gain_a * speed / e.gain_b,
            (ratio * e.gain_a * bend + slope * speed_a * speed_a) / e.gain_b);
    } else {
      const double speed_a = e.gain_b * speed / ratio;
      reach(to, input / e.gain_a, e.gain_b * speed / (ratio * e.gain_a),
            (e.gain_b * bend - slope * speed_a * speed_a) / (ratio * e.gain_a));
    }
  }

  // Of the relations that a reached shaft belongs to, the one with the fewest unknown members: its last one, or where
  // more are unknown the first of them by its usual share.
  bool pass_relation() {
    const ShaftRelation* next = nullptr;
    std::size_t fewest = 0;
    for (std::size_t r = 0; r < m_.relations.size(); ++r) {
      const auto& members = m_.relations[r].motion;
      std::size_t unknown = 0;
      bool any = false;
      for (const ShaftGain& g : members) {
        any = any || reached_[at(g.shaft)];
        if (!reached_[at(g.shaft)] && !stands(g.shaft) && g.gain != 0) ++unknown;
      }
      if (done_[r] || !any) continue;
      if (unknown == 0) {
        done_[r] = 1;
        for (const ShaftGain& g : members)
          if (!reached_[at(g.shaft)]) reach(g.shaft, usual(g.shaft) * usual_turn_, usual(g.shaft));
        return true;
      }
      if (!next || unknown < fewest) next = &m_.relations[r], fewest = unknown;
    }
    if (!next) return false;
    const ShaftGain* unknown = nullptr;  // what usually stands is to stand
    for (const ShaftGain& g : next->motion)
      if (!reached_[at(g.shaft)] && !stands(g.shaft) && g.gain != 0 &&
          (!unknown || (usual(g.shaft) == 0 && usual(unknown->shaft) != 0)))
        unknown = &g;
    if (fewest == 1)
      solve_for(*next, *unknown);
    else
      share(*next, unknown->shaft);
    return true;
  }

  void solve_for(const ShaftRelation& relation, const ShaftGain& member) {
    double angle = 0, speed = 0, bend = 0, usual_sum = 0, size = 0;
    bool all_usual = true;
    for (const ShaftGain& g : relation.motion) {
      usual_sum += g.gain * usual(g.shaft), size += std::abs(g.gain * usual(g.shaft));
      if (g.shaft == member.shaft || !reached_[at(g.shaft)]) continue;
      angle += g.gain * motion_.angle[at(g.shaft)];
      speed += g.gain * motion_.speed[at(g.shaft)];
      bend += g.gain * motion_.bend[at(g.shaft)];
      all_usual = all_usual && is_usual(g.shaft);
    }
    if (all_usual && std::abs(usual_sum) <= fits * size)
      reach(member.shaft, usual(member.shaft) * usual_turn_, usual(member.shaft));
    else
      reach(member.shaft, -angle / member.gain, -speed / member.gain, -bend / member.gain);
  }

  // What a member that is known turns more or less than usual the others do in proportion.
  void share(const ShaftRelation& relation, int shaft) {
    double angle = usual(shaft) * usual_turn_, speed = usual(shaft), bend = 0;
    for (const ShaftGain& g : relation.motion) {
      if (!reached_[at(g.shaft)] || usual(g.shaft) == 0 || is_usual(g.shaft)) continue;
      const double part = usual(shaft) / usual(g.shaft);
      angle += part * (motion_.angle[at(g.shaft)] - usual(g.shaft) * usual_turn_);
      speed = part * motion_.speed[at(g.shaft)], bend = part * motion_.bend[at(g.shaft)];
      break;
    }
    reach(shaft, angle, speed, bend);
  }

  std::optional<double> given_twist(std::size_t joint) const {
    return joint < given_.twists.size() ? given_.twists[joint] : std::nullopt;
  }
  void set_twist(std::size_t j) {
    const ElasticJoint& e = m_.elastic[j];
    const AnyConnection& element = *m_.network.joints[at(e.joint)].element;
    const double a = e.gain_a * motion_.angle[at(e.shaft_a)];
    if (const auto own = given_twist(j))
      motion_.twist[j] = *own;
    else if (!given_.angles.empty())
      motion_.twist[j] = a - e.gain_b * motion_.angle[at(e.shaft_b)];
    else
      motion_.twist[j] = element.is.uses_angle ? element.rest_twist(a) : 0;
  }

  const Model& m_;
  const KnownMotion& given_;
  double usual_turn_ = 0;                            // of the reduction link in the usual motion [rad]
  std::vector<std::vector<std::size_t>> joints_at_;  // per shaft: elastic joints
  std::vector<int> order_;                           // in which the shafts were reached
  std::size_t next_ = 0;                             // of them, to go on from
  std::vector<char> reached_, done_;
  UnloadedMotion motion_;
};

}  // namespace

UnloadedMotion unloaded_motion(const Model& model, const KnownMotion& known) {
  return Traversal(model, known).motion();
}

}  // namespace kurbel
