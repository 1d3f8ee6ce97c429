// linkage_range.cpp — the driving link is turned from the sketch on until all stands where it stood, or until it locks.
#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "mechanisms/linkage/linkage.h"
#include "mechanisms/linkage/parallel_group.h"

namespace kurbel {
namespace {

const long double whole_turn = 2 * std::acos(-1.0L);
constexpr int steps_of_turn = 360;
constexpr long double least_step = 1e-13L;  // [rad]: how well the place of a lock is found
constexpr long double least_way = 1e-3L;    // [rad]
// sin² of a transmission angle; of a group closed by Newton's method (least pivot/its greatest over the turn)². A relative
// change δ of a length changes rates by about δ/margin: below this a few millionths of a length decide how the links continue,
// and the rounding of lengths costs ten digits.
constexpr long double least_margin = 1e-6L;

std::string in_degrees_of(long double phi) {
  const double degrees = static_cast<double>(phi * 360 / whole_turn);
  return fmt::format("{:.4g}°", std::round(1e3 * degrees) / 1e3 + 0.0);
}

}  // namespace

// Pins that the rounding of coordinates alone keeps from moving in parallel are moved: those of a group together with the
// groups before it, else by itself.
void Linkage::take_as_parallel() {
  std::string links;
  long double most = 0;
  AssurGroup before;
  for (const AssurGroup& group : structure_.groups) {
    AssurGroup together = before;
    together.links.insert(together.links.end(), group.links.begin(), group.links.end());
    together.joints.insert(together.joints.end(), group.joints.begin(), group.joints.end());
    together.superfluous += group.superfluous;
    auto moved = parallel_pins(together, sketch_, structure_, size_);
    if (!moved) together = group, moved = parallel_pins(group, sketch_, structure_, size_);
    before = moved ? together : AssurGroup();
    if (!moved || moved->empty()) continue;
    for (const auto& [p, by] : *moved) {
      LinkageSketch::Point& point = sketch_.points[static_cast<std::size_t>(p)];
      point.x = static_cast<double>(point.x + by.x), point.y = static_cast<double>(point.y + by.y);
      most = std::max(most, length(by));
    }
    links += (links.empty() ? "" : ", ") + links_of(group, sketch_);
  }
  if (links.empty()) return;
  moved_ = fmt::format(
      "the links {} are taken as parallel: their points are moved by up to {:.2g} mm, within the rounding of the "
      "coordinates",
      links, static_cast<double>(1e3L * most));
  structure_ = structure_of(sketch_, faults_);
}

bool Linkage::start_at_sketch(Node& node) {
  node = {drawn_at_, {}};
  for (const AssurGroup& group : structure_.groups) node.shifts.emplace_back(group.is_dyad() ? 0 : group.links.size());
  Closed closed(sketch_.links.size());
  closed.shifts = node.shifts;
  closed.poses.of(sketch_.driver).turn = Direction::of_variable(0);
  std::optional<Taylor> first;
  for (std::size_t k = 0; k < structure_.groups.size(); ++k) {
    AssurGroup& group = structure_.groups[k];
    find_change_point(group, closed.poses, first);
    if (group.parallel) closed.shifts[k].clear();  // nothing to follow
    const bool closes = close_group(k, closed);
    if (group.parallel || (closes && !(group.is_dyad() && closed.margin[k] <= least_margin))) continue;
    refuse("points",
           fmt::format("the linkage is drawn in a position in which {}, which leaves its branch open; draw it in "
                       "another position",
                       group.is_dyad() ? dead_position_of(group, sketch_) : undetermined(group)));
    return false;
  }
  node.shifts = std::move(closed.shifts);
  return true;
}

// All of them change together, by one sine: a group with change points in other positions than the first one's is not
// followed through them.
void Linkage::find_change_point(AssurGroup& group, const LinkPoses& drawn, std::optional<Taylor>& first) const {
  const long double alike = sketch_.rounded > 0 ? 1e-3L : 1e-9L;
  const auto motion = parallel_motion(group, sketch_, structure_, drawn, size_);
  if (!motion || !motion->changes) return;
  const Taylor sine = sine_of(*motion, drawn);
  if (!first) first = sine;
  const long double sense = sine.value() * first->value() + sine.slope() * first->slope() < 0 ? -1 : 1;
  for (int k = 0; k <= Taylor::order; ++k)
    if (!(std::fabs(sense * sine.c[k] - first->c[k]) < alike)) return;
  group.parallel = motion;
}

// Where Newton's method has found no change point, the closed form is exact and costs less.
void Linkage::close_in_parallel() {
  const LinkPoses drawn = poses(drawn_at_);
  for (AssurGroup& group : structure_.groups)
    if (!group.is_dyad() && !group.parallel) group.parallel = parallel_motion(group, sketch_, structure_, drawn, size_);
}

// Steps are halved until what Newton's method corrects is little, so that no other branch is taken.
Linkage::Way Linkage::march(const Node& from, long double angle) const {
  constexpr long double most_corrected = 0.01L;  // of the size, and of a radian
  const long double sense = angle < 0 ? -1 : 1, end = from.phi + angle;
  Way way;
  way.nodes.push_back(from);
  for (long double step = whole_turn / steps_of_turn; sense * (end - way.nodes.back().phi) > 0;) {
    const Node& last = way.nodes.back();
    const bool at_end = sense * (end - last.phi) <= step * (1 + 1e-9L);
    const long double phi = at_end ? end : last.phi + sense * step;
    const Shifts start = predicted(last, phi);
    Closed closed = close(phi, start);
    closed.failed = first_astray(closed, start, most_corrected);
    if (closed.failed < 0) {
      way.nodes.push_back({phi, std::move(closed.shifts)});
      step = std::min(1.5L * step, whole_turn / steps_of_turn);
      continue;
    }
    step /= 2;
    if (step > least_step) continue;
    way.stopped = std::move(closed);
    break;
  }
  return way;
}

bool Linkage::comes_back(const Node& begin, const Node& end) const {
  constexpr long double same = 1e-9L;
  for (std::size_t g = 0; g < begin.shifts.size(); ++g)
    for (std::size_t i = 0; i < begin.shifts[g].size(); ++i) {
      const LinkShift &a = begin.shifts[g][i], &b = end.shifts[g][i];
      if (std::fabs(a.x.value() - b.x.value()) > same * size_ || std::fabs(a.y.value() - b.y.value()) > same * size_ ||
          std::fabs(std::remainder(a.angle.value() - b.angle.value(), whole_turn)) > same)
        return false;
    }
  return true;
}

// A margin that is positive again beyond touches zero there: the links pass through one line. Where Newton's method closes a
// group, it is followed from a place where its series is good.
bool Linkage::touches(const Way& way, long double sense) const {
  constexpr long double beyond = 1e-5L, before = 1e-3L;
  const long double phi = way.nodes.back().phi + sense * beyond;
  auto from = way.nodes.rbegin();
  while (std::next(from) != way.nodes.rend() && std::fabs(from->phi - phi) < before) ++from;
  const Shifts start = predicted(*from, phi);
  const Closed closed = close(phi, start);
  const int astray = first_astray(closed, start, before);
  return astray < 0 || astray > way.stopped->failed;
}

bool Linkage::is_near(const std::vector<LinkShift>& a, const std::vector<LinkShift>& b, long double apart) const {
  const auto off = [](const Taylor& u, const Taylor& v) { return std::fabs(u.value() - v.value()); };
  return std::equal(a.begin(), a.end(), b.begin(), [&](const LinkShift& u, const LinkShift& v) {
    return off(u.x, v.x) < apart * size_ && off(u.y, v.y) < apart * size_ && off(u.angle, v.angle) < apart;
  });
}

// The first group that cannot be closed, or that Newton's method closes in a position farther off than `apart`; −1: none.
int Linkage::first_astray(const Closed& closed, const Shifts& start, long double apart) const {
  for (int g = 0; g < static_cast<int>(start.size()); ++g) {
    const auto k = static_cast<std::size_t>(g);
    if (g == closed.failed || !is_near(start[k], closed.shifts[k], apart)) return g;
  }
  return closed.failed;
}

void Linkage::explore() {
  Node begin;
  if (!start_at_sketch(begin)) return;
  Way forward = march(begin, whole_turn);
  for (turns_ = 1; !forward.stopped && turns_ < 2 && !comes_back(begin, forward.nodes.back()); ++turns_) {
    Way more = march(forward.nodes.back(), whole_turn);
    forward.nodes.insert(forward.nodes.end(), std::next(more.nodes.begin()), more.nodes.end());
    forward.stopped = std::move(more.stopped);
  }
  if (!forward.stopped) {
    nodes_ = std::move(forward.nodes);
    if (!comes_back(nodes_.front(), nodes_.back()))
      refuse("points",
             "the links stand otherwise after two turns of the driving link; a cycle of more turns is not "
             "computed: change a length, or let another link drive");
    return;
  }
  turns_ = 1;
  const long double upper = forward.nodes.back().phi;
  const auto stops = [&](const Way& way, long double sense) {  // for another reason than a lock
    const long double phi = way.nodes.back().phi;
    if (touches(way, sense))
      refuse_change_point(way.stopped->failed, phi);
    else if (structure_.groups[static_cast<std::size_t>(way.stopped->failed)].superfluous > 0 &&
             std::fabs(phi - begin.phi) < least_way)
      refuse_stop(*way.stopped, phi);
    return !faults_.empty();
  };
  if (stops(forward, 1)) return;
  Way back = march(begin, -whole_turn);
  if (back.stopped && stops(back, -1)) return;
  const long double lower = back.nodes.back().phi;
  if (!back.stopped || upper - lower < least_way) return refuse_stop(*forward.stopped, upper);
  nodes_.assign(back.nodes.rbegin(), back.nodes.rend());
  nodes_.insert(nodes_.end(), std::next(forward.nodes.begin()), forward.nodes.end());
  arc_ = CrankArc{static_cast<double>((lower + upper) / 2), static_cast<double>((upper - lower) / 2)};
  lower_lock_ = stop_in_words(*back.stopped), upper_lock_ = stop_in_words(*forward.stopped);
}

std::string Linkage::undetermined(const AssurGroup& group) const {
  return "the links " + links_of(group, sketch_) + " are not determined";
}

void Linkage::refuse_change_point(int group, long double phi) {
  const AssurGroup& of = structure_.groups[static_cast<std::size_t>(group)];
  refuse(
      "points",
      fmt::format(
          "at φ = {} {}, or so nearly that a few millionths of a length decide how the links continue: a change "
          "point. {}; passed are those of exact parallelograms, and of the kinds four-bar, slider-crank and inverted "
          "slider-crank",
          in_degrees_of(phi), of.is_dyad() ? dead_position_of(of, sketch_) : undetermined(of),
          of.superfluous > 0 ? "Put all bearings of parallel cranks in one line, or one of them clearly out of it"
                             : "Change a length clearly"));
}

void Linkage::refuse_stop(const Closed& stopped, long double phi) {
  const AssurGroup& group = structure_.groups[static_cast<std::size_t>(stopped.failed)];
  if (group.superfluous > 0)
    refuse("links",
           fmt::format("the links {} have {}, and their lengths let them move no "
                       "further than φ = {} (drawn at {}): leave a link out, or make the lengths those of a "
                       "linkage that moves, as the parallel ones of a parallelogram",
                       links_of(group, sketch_), superfluous_of(group), in_degrees_of(phi), in_degrees_of(drawn_at_)));
  else
    refuse("links", fmt::format("{} hardly moves: at φ = {} {}; drawn at {}", sketch_.name_of(sketch_.driver),
                                in_degrees_of(phi), stop_in_words(stopped), in_degrees_of(drawn_at_)));
}

std::string Linkage::stop_in_words(const Closed& stopped) const {
  return dead_position_of(structure_.groups[static_cast<std::size_t>(stopped.failed)], sketch_);
}

// Between the nodes as well: a dip between two of them would be a lock that was stepped over.
void Linkage::find_margins() {
  constexpr long double small = 0.05L;  // of the greatest: a dip that may go down to zero
  least_.assign(structure_.groups.size(), {});
  const auto margin_at = [&](std::size_t group, long double phi) {
    const Closed closed = close(phi, start_near(phi));
    return group < closed.margin.size() ? closed.margin[group] : -1.0L;
  };
  const std::size_t last = nodes_.size() - 1;
  const auto least_near = [&](std::size_t g, std::size_t k) {
    long double from = nodes_[k > 0 ? k - 1 : 0].phi, to = nodes_[std::min(k + 1, last)].phi;
    for (int i = 0; i < 60; ++i) {
      const long double a = from + (to - from) * 0.382L, b = from + (to - from) * 0.618L;
      if (margin_at(g, a) < margin_at(g, b))
        to = b;
      else
        from = a;
    }
    return LeastMargin{margin_at(g, (from + to) / 2), (from + to) / 2};
  };
  const auto at_an_end = [&](long double phi) {
    return arc_ && std::min(phi - nodes_.front().phi, nodes_.back().phi - phi) < least_way;
  };
  std::vector<std::vector<long double>> at(structure_.groups.size());
  for (const Node& node : nodes_) {
    const Closed closed = close(node.phi, start_near(node.phi));
    for (std::size_t g = 0; g < at.size(); ++g) at[g].push_back(g < closed.margin.size() ? closed.margin[g] : -1);
  }
  for (std::size_t g = 0; g < at.size(); ++g) {
    const auto [least, greatest] = std::minmax_element(at[g].begin(), at[g].end());
    const long double scale = structure_.groups[g].is_dyad() ? 1 : *greatest;
    for (std::size_t k = 0; k <= last; ++k) {
      const bool dips = (k == 0 || at[g][k] <= at[g][k - 1]) && (k == last || at[g][k] <= at[g][k + 1]);
      if (&at[g][k] != &*least && !(dips && at[g][k] < small * scale)) continue;
      const LeastMargin found = least_near(g, k);
      if (structure_.groups[g].is_dyad() && found.margin < least_[g].margin) least_[g] = found;
      if (structure_.groups[g].changes() || at_an_end(found.phi) || found.margin > least_margin * scale) continue;
      return refuse_change_point(static_cast<int>(g), found.phi);
    }
  }
}

std::string Linkage::structure_in_words() const {
  int highest = 2;
  std::string groups;
  for (const AssurGroup& group : structure_.groups) {
    highest = std::max(highest, group.group_class);
    groups += fmt::format("{}{} ({})", groups.empty() ? "" : ", ", name_of(group), links_of(group, sketch_));
    if (group.superfluous > 0) groups += fmt::format(" with {}", superfluous_of(group));
  }
  const char* const roman[] = {"II", "III", "IV", "V", "VI", "VII", "VIII", "IX", "X"};
  const int n = static_cast<int>(sketch_.links.size());
  return fmt::format("linkage of class {}: {} drives {}; degrees of freedom 3·{} − 2·{} = {}{}",
                     roman[std::min(highest - 2, 8)], sketch_.name_of(sketch_.driver), groups, n,
                     structure_.joints.size(), structure_.freedom,
                     structure_.freedom == 1 ? "" : " by count, 1 along its motion");
}

std::string Linkage::locks_in_words() const {
  return lower_lock_ == upper_lock_ ? lower_lock_ : lower_lock_ + ", and " + upper_lock_;
}

std::vector<std::string> Linkage::transmission_in_words() const {
  constexpr long double rounding = 1e-11L;  // of a margin that is zero: angles below 0.0002° are 0
  std::vector<std::string> words;
  for (std::size_t g = 0; g < least_.size(); ++g) {
    const AssurGroup& group = structure_.groups[g];
    if (group.form != AssurGroup::Form::rrr && group.form != AssurGroup::Form::rrp) continue;
    const long double margin = std::min(least_[g].margin, 1.0L), sine = margin > rounding ? std::sqrt(margin) : 0;
    words.push_back(fmt::format("transmission angle of {} ({}) at least {:.4g}°, at φ = {}", name_of(group),
                                links_of(group, sketch_), static_cast<double>(std::asin(sine) * 360 / whole_turn),
                                in_degrees_of(std::remainder(least_[g].phi, whole_turn))));
  }
  return words;
}

}  // namespace kurbel
