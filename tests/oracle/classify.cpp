// classify.cpp — definitions of classify.h, evaluated.
#include "tests/oracle/classify.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "engine/return_map/periodicity.h"
#include "tests/oracle/limits.h"

namespace kurbel::oracle {
namespace {

using nlohmann::json;

constexpr double turns = 1e-3, acts = 1e-6;  // of the usual speed, of the usual torque
constexpr double at_end = 0.02;              // of the time

// The link's motion as a function of time: cubic between the points.
class Path {
 public:
  explicit Path(const std::vector<Moment>& moments) : p_(moments) {}
  double angle(double t) const {
    const auto after = std::upper_bound(p_.begin(), p_.end(), t, [](double x, const Moment& m) { return x < m.t; });
    if (after == p_.begin()) return p_.front().angle;
    if (after == p_.end()) return p_.back().angle;
    return between(*(after - 1), *after, t);
  }
  // When it passes an angle between two points that it lies between.
  static double passing(const Moment& a, const Moment& b, double angle) {
    double low = a.t, high = b.t;
    const bool rises = b.angle > a.angle;
    for (int k = 0; k < 60; ++k) {
      const double middle = 0.5 * (low + high);
      ((between(a, b, middle) < angle) == rises ? low : high) = middle;
    }
    return 0.5 * (low + high);
  }

 private:
  static double between(const Moment& a, const Moment& b, double t) {
    const double h = b.t - a.t;
    if (!(h > 0)) return b.angle;
    const double x = (t - a.t) / h, d = b.angle - a.angle;
    return a.angle + h * a.speed * x * (1 - x) * (1 - x) - h * b.speed * x * x * (1 - x) + d * x * x * (3 - 2 * x);
  }
  const std::vector<Moment>& p_;
};

class MotionJudge {
 public:
  // `points`: of `seen`, all or the first ones.
  MotionJudge(const Observed& seen, const std::vector<Moment>& points)
      : m_(*seen.model), p_(points), path_(p_), usual_(m_.speed_scale), until_(p_.back().t) {
    for (const Contact& c : seen.contacts)
      if (c.kind != "brake" && c.kind != "one-way clutch" && !c.stretches.empty()) note_slip(c);
  }

  json all() const {
    json j;
    j["cycle"] = m_.cycle, j["usual_speed"] = usual_, j["usual_torque"] = m_.torque_scale, j["until"] = until_;
    j["begins"] = turns_at(p_.front()) ? "turning" : "at rest";
    j["moves"] = moves(), j["end"] = end(), j["speed_at_end"] = p_.back().speed, j["held_at_end"] = p_.back().held;
    j["fastest"] = fastest(), j["fastest_late"] = fastest_late(),
    j["to_and_fro"] = std::min(gain_to_and_fro(), gain_of_last_oscillation()), j["rests_since"] = rests_since(),
    j["held_since"] = held_since();
    j["driven_at_end"] = p_.back().driven, j["drives_at_end"] = drives_at_end(), j["drive_at_end"] = p_.back().drive;
    j["load_at_end"] = p_.back().load, j["drives_until"] = drives_until();
    j["pushed_at_end"] = pushed(), j["falls"] = falls();
    j["does_not_start"] = does_not_start(), j["stalls"] = stalls(), j["turns_back"] = turns_back();
    j["no_round"] = no_round(), j["rounds"] = m_.cycle > 0 ? std::floor(span() / m_.cycle) : 0.0;
    j["angle_gained"] = p_.back().angle - p_.front().angle;
    add_steadiness(j);
    return j;
  }
  std::string end() const {
    const double stands = until_ - rests_since(), swing = has_decayed() ? 0 : half_swing();
    if (!turns_at(p_.back()) && (p_.back().held || stands > std::max(at_end * until_, swing))) return "rests";
    if (vibrates()) return "vibrates";
    return mean_speed(until_ - at_end * until_, until_) < 0 ? "backwards" : "forwards";
  }
  double mean_speed(double from, double to) const { return (path_.angle(to) - path_.angle(from)) / (to - from); }
  // Of the last tenth of the time; with a cycle, where the link still goes through it, of the whole ones that hold that.
  double mean_speed_of_last_tenth() const {
    const std::vector<Lap> list = m_.cycle > 0 ? laps(0) : std::vector<Lap>();
    if (list.empty() || until_ - list.back().end > 2 * (list.back().end - list.back().begin))
      return mean_speed(0.9 * until_, until_);
    const auto first =
        std::find_if(list.rbegin(), list.rend() - 1, [&](const Lap& l) { return l.begin <= 0.9 * until_; });
    return mean_speed(first->begin, list.back().end);
  }

 private:
  bool turns_at(const Moment& m) const { return std::abs(m.speed) > turns * usual_; }
  bool acts_at(double torque) const { return std::abs(torque) > acts * m_.torque_scale; }
  bool moves() const {
    return std::any_of(p_.begin(), p_.end(), [&](const Moment& m) { return turns_at(m); });
  }
  double fastest() const {
    double most = 0;
    for (const Moment& m : p_) most = std::max(most, std::abs(m.speed));
    return most;
  }
  // When the speed enters this range for good, on the straight line between two points; 0 where it is never outside.
  double within_from(double low, double high) const {
    for (std::size_t k = p_.size(); k-- > 0;) {
      const double speed = p_[k].speed, border = speed > high ? high : low;
      if (speed >= low && speed <= high) continue;
      if (k + 1 == p_.size()) return p_[k].t;
      return p_[k].t + (p_[k + 1].t - p_[k].t) * (speed - border) / (speed - p_[k + 1].speed);
    }
    return 0;
  }
  double rests_since() const { return within_from(-turns * usual_, turns * usual_); }
  // From its last reversal but one to the last one, where the time between the two before is that within a factor of two: a
  // vibration; else 0.
  double half_swing() const {
    std::array<double, 3> reversal{};
    std::size_t count = 0;
    int sense = 0;
    double at = 0;
    for (auto m = p_.rbegin(); m != p_.rend() && count < reversal.size(); ++m) {
      if (!turns_at(*m)) continue;
      const int now = m->speed > 0 ? 1 : -1;
      if (sense != 0 && now != sense) reversal[count++] = at;
      sense = now, at = m->t;
    }
    const double last = reversal[0] - reversal[1], before = reversal[1] - reversal[2];
    return count == reversal.size() && last < 2 * before && before < 2 * last ? last : 0;
  }
  // Since it last turned it reversed, and passed its greatest speed in that sense: what is left of a vibration turns no more.
  bool has_decayed() const {
    double most = 0;
    bool reversed = false;
    for (std::size_t k = p_.size(); k-- > 1 && !turns_at(p_[k]);) {
      reversed = p_[k].speed * p_[k - 1].speed < 0;
      most = std::max(most, std::abs(p_[k].speed));
      if (reversed) break;
    }
    return reversed && most > 1.1 * std::abs(p_.back().speed);
  }
  // |speed| at the end; of one that vibrates the greatest one of its last half cycle, or of the last 2 % of the time.
  double fastest_late() const {
    const double from = end() == "vibrates" ? until_ - std::max(half_swing(), at_end * until_) : until_;
    double most = 0;
    for (const Moment& m : p_)
      if (m.t >= from) most = std::max(most, std::abs(m.speed));
    return most;
  }
  // Null: it is not held at the end.
  json held_since() const {
    const auto is_free = [](const Moment& m) { return !m.held && m.speed != 0; };  // gears hold without a tie
    if (is_free(p_.back())) return {};
    const auto free = std::find_if(p_.rbegin(), p_.rend(), is_free);
    return free == p_.rend() ? 0 : free->t;
  }
  bool drives(const Moment& m) const { return m.driven && acts_at(m.drive); }
  // In all of the last 2 % of the time.
  bool drives_at_end() const {
    return std::all_of(p_.begin(), p_.end(),
                       [&](const Moment& m) { return m.t < until_ - at_end * until_ || drives(m); });
  }
  // Null: it never does.
  json drives_until() const {
    for (auto m = p_.rbegin(); m != p_.rend(); ++m)
      if (drives(*m)) return m->t;
    return {};
  }
  double span() const {
    const auto [low, high] =
        std::minmax_element(p_.begin(), p_.end(), [](const Moment& a, const Moment& b) { return a.angle < b.angle; });
    return high->angle - low->angle;
  }
  bool vibrates() const { return gain_to_and_fro() < 0.25; }
  // Of the way; 1: it does not turn to and fro.
  double gain_to_and_fro() const {
    const double from = 0.75 * until_;
    double way = 0, farthest = 0;
    std::vector<double> ends;  // angles at which it reversed
    int sense = 0;
    for (std::size_t k = 1; k < p_.size(); ++k) {
      if (p_[k].t < from) continue;
      way += std::abs(p_[k].angle - p_[k - 1].angle);
      const int now = turns_at(p_[k]) ? (p_[k].speed > 0 ? 1 : -1) : 0;
      if (now != 0 && sense != 0 && now != sense) ends.push_back(farthest);
      if (now != 0 && now != sense) sense = now, farthest = p_[k].angle;
      if (sense * (p_[k].angle - farthest) > 0) farthest = p_[k].angle;
    }
    const std::size_t n = ends.size();
    if (n < 2) return 1;
    const double gain = std::abs(path_.angle(until_) - path_.angle(from)) / way;
    return n == 2 ? gain
                  : std::min(gain, std::abs(ends[n - 1] - ends[n - 3]) /
                                       (std::abs(ends[n - 1] - ends[n - 2]) + std::abs(ends[n - 2] - ends[n - 3])));
  }
  // Of the way from its last reversal but two to the last one, which is in the last quarter of the time, and which it has
  // not left by more than a quarter beyond the half oscillation before; else 1.
  double gain_of_last_oscillation() const {
    std::vector<const Moment*> ends;
    for (std::size_t k = 1; k < p_.size(); ++k)
      if (p_[k].speed * p_[k - 1].speed < 0) ends.push_back(&p_[k]);
    const std::size_t n = ends.size();
    if (n < 3 || ends[n - 1]->t < 0.75 * until_) return 1;
    const double last = ends[n - 1]->angle, way = std::abs(last - ends[n - 2]->angle);
    if (std::abs(p_.back().angle - last) > 1.25 * way) return 1;
    return std::abs(last - ends[n - 3]->angle) / (way + std::abs(ends[n - 2]->angle - ends[n - 3]->angle));
  }
  // At any point of the last 2 % of the time: what is held may tremble.
  bool pushed() const {
    return slips_under_torque_ || std::any_of(p_.begin(), p_.end(), [&](const Moment& m) {
             return m.t >= until_ - at_end * until_ && m.pushed > 1e-3 * m_.torque_scale;
           });
  }
  bool does_not_start() const { return !turns_at(p_.front()) && !moves() && pushed(); }
  bool stalls() const { return fastest() > 0.01 * usual_ && end() == "rests" && pushed(); }
  bool no_round() const {
    return m_.cycle > 0 && span() < m_.cycle && moves() && drives_at_end() && (end() == "rests" || end() == "vibrates");
  }
  bool falls() const {
    if (!(p_.back().speed < -0.01 * usual_) || p_.front().speed < -turns * usual_) return false;
    if (p_.back().drive < -acts * m_.torque_scale) return false;
    double foremost = p_.front().angle, left = 0;  // left: at this speed by what drove it backwards
    for (const Moment& m : p_) {
      const bool driven_back = m.drive < -acts * m_.torque_scale;
      if (driven_back || m.speed >= 0) left = driven_back ? std::min(m.speed, 0.0) : 0;
      foremost = driven_back || p_.back().speed > left ? m.angle : std::max(foremost, m.angle);
    }
    return foremost - p_.back().angle > std::numbers::pi || (!p_.back().driven && p_.back().speed < -usual_);
  }
  bool turns_back() const {
    if (!drives_at_end() || std::abs(p_.back().speed) < 0.01 * usual_ || p_.back().speed * p_.back().drive > 0)
      return false;
    if (p_.front().speed * p_.back().speed > 0 && turns_at(p_.front())) return false;
    double foremost = 0;  // in the sense of the drive
    for (const Moment& m : p_)
      foremost = std::max(foremost, (m.angle - p_.back().angle) * (p_.back().drive > 0 ? 1 : -1));
    return foremost > std::numbers::pi;
  }

  // --- steadiness ---

  void note_slip(const Contact& c) {
    const Stretch& last = c.stretches.back();
    const bool slips =
        last.state == Stretch::State::slips && last.command_end > 0 && last.torque > 1e-3 * m_.torque_scale;
    slips_under_torque_ = slips_under_torque_ || (slips && std::abs(last.sense) > turns * c.usual_speed);
  }
  enum class Windows { none, of_sources, all };
  bool switches(const Moment& a, const Moment& b, Windows windows) const {
    bool changes = a.driven != b.driven;
    for (std::size_t k = 0; k < a.reported.size(); ++k)
      changes = changes || std::abs(a.reported[k] - b.reported[k]) > 1e-12;
    for (std::size_t e = 0; windows != Windows::none && e < a.on.size(); ++e)
      changes = changes || (a.on[e] != b.on[e] &&
                            (windows == Windows::all || m_.network.elements[e].element->account == Account::driving));
    return changes;
  }
  // The last change of a command, of whether anything drives, and of these windows; sequences that repeat have no last one.
  double settled_from(Windows windows) const {
    if (m_.scene.sequence.repeat) return 0;
    for (std::size_t k = p_.size() - 1; k > 0; --k)
      if (switches(p_[k - 1], p_[k], windows)) return p_[k].t;
    return 0;
  }
  struct Lap {
    double begin = 0, end = 0, mean = 0, least = 0, greatest = 0;
  };
  // Of one sense, the last ones without a turn back.
  std::vector<Lap> laps(double from) const {
    std::vector<double> borders;
    if (m_.cycle > 0) {
      double number = 0;
      for (std::size_t k = 1; k < p_.size(); ++k) {
        if (p_[k].t < from || p_[k].angle == p_[k - 1].angle) continue;
        const double a = p_[k - 1].angle / m_.cycle, b = p_[k].angle / m_.cycle;
        for (double n = std::ceil(std::min(a, b)); n <= std::max(a, b); ++n) {
          const double t = Path::passing(p_[k - 1], p_[k], n * m_.cycle);
          if (!borders.empty() && n == number && t - borders.back() <= 1e-9 * until_)
            continue;                                                          // a point on the border
          if (!borders.empty() && std::abs(n - number) != 1) borders.clear();  // it turned back
          number = n, borders.push_back(t);
        }
      }
    } else {
      for (int k = 0; k <= 10; ++k) borders.push_back(from + (until_ - from) * k / 10);
    }
    std::vector<Lap> list;
    std::size_t point = 0;
    for (std::size_t k = 1; k < borders.size(); ++k) {
      Lap lap{.begin = borders[k - 1], .end = borders[k], .mean = mean_speed(borders[k - 1], borders[k])};
      lap.least = HUGE_VAL, lap.greatest = -HUGE_VAL;
      while (point < p_.size() && p_[point].t < lap.begin) ++point;
      for (std::size_t i = point; i < p_.size() && p_[i].t <= lap.end; ++i)
        lap.least = std::min(lap.least, p_[i].speed), lap.greatest = std::max(lap.greatest, p_[i].speed);
      if (lap.least > lap.greatest) lap.least = lap.greatest = lap.mean;
      list.push_back(lap);
    }
    return list;
  }
  double stands_within(double from, double to) const {
    double stands = 0;
    for (std::size_t k = 1; k < p_.size(); ++k)
      if (p_[k - 1].t >= from && p_[k].t <= to && !turns_at(p_[k]) && !turns_at(p_[k - 1]))
        stands += p_[k].t - p_[k - 1].t;
    return stands / (to - from);
  }
  void add_steadiness(json& j) const {
    double from = settled_from(Windows::all);
    j["switched_last"] = from, j["drive_switched_last"] = settled_from(Windows::none);
    std::vector<Lap> list = laps(from);
    if (list.size() < 3) from = settled_from(Windows::of_sources), list = laps(from);
    j["laps"] = list.size();
    std::string word = "unclear";
    std::size_t period = 0;
    bool near = false, judged = false;
    const std::size_t most = m_.cycle > 0 ? 6 : 1;
    for (std::size_t p = 1; p <= most && 2 * p <= list.size() && period == 0; ++p) {
      judged = true;
      double means = 0, extremes = 0;
      for (std::size_t k = 0; k < p; ++k) {
        const Lap &a = list[list.size() - 1 - k], &b = list[list.size() - 1 - k - p];
        const double scale = std::max(std::abs(a.mean), 1e-12 * usual_);
        means = std::max(means, std::abs(a.mean - b.mean) / scale);
        extremes = std::max({extremes, std::abs(a.least - b.least) / scale, std::abs(a.greatest - b.greatest) / scale});
      }
      near = near || means < 0.01;
      if (means < 1e-3 && extremes < 5e-3) period = p;
    }
    // Of eighths of the time, or of the whole periods that fit into one: parts of a period have means of their own.
    double end_of_both = until_, length = (until_ - from) / 8, length_before = length;
    if (m_.cycle > 0) {
      const std::size_t p = std::max<std::size_t>(period, 1);
      const double lap = list.empty() ? HUGE_VAL : list.back().end - list.back().begin;
      const std::size_t n = p * static_cast<std::size_t>(length / (lap * static_cast<double>(p)));
      const bool fits = n > 0 && 2 * n <= list.size();
      const auto begin_of_last = [&](std::size_t laps) { return list[list.size() - laps].begin; };
      end_of_both = fits ? list.back().end : until_;
      length = fits ? end_of_both - begin_of_last(n) : 0;
      length_before = fits ? begin_of_last(n) - begin_of_last(2 * n) : 0;
    }
    double drift = 0;
    if (length > 0 && length_before > 0) {
      const double border = end_of_both - length, last = mean_speed(border, end_of_both),
                   before = mean_speed(border - length_before, border);
      drift = std::abs(last - before) / std::max(std::abs(last), 1e-12 * usual_);
    }
    const std::string how = end();
    const bool goes = how == "forwards" || how == "backwards";
    if (goes && period > 0 && (drift < 0.01 || m_.scene.sequence.repeat))
      word = "yes";
    else if (goes && judged && (!near || drift > 0.05))
      word = "no";
    else if (!goes)
      word = "no";
    j["steady"] = word, j["drift"] = drift;
    if (period > 0) {
      const Lap &first = list[list.size() - period], &end = list.back();
      double least = HUGE_VAL, greatest = -HUGE_VAL;
      for (std::size_t k = list.size() - period; k < list.size(); ++k)
        least = std::min(least, list[k].least), greatest = std::max(greatest, list[k].greatest);
      j["period"] = period, j["mean_speed"] = mean_speed(first.begin, end.end);
      j["least_speed"] = least, j["greatest_speed"] = greatest;
      j["stands_within"] = stands_within(first.begin, end.end);
      // Within the range widened by a twentieth of it, but by 0.1 … 1 % of the speed; by 1 % if later laps leave that.
      const double speed = std::abs(mean_speed(first.begin, end.end)), widest = 0.01 * speed;
      const double narrow = m_.cycle > 0 ? std::clamp(0.05 * (greatest - least), 0.001 * speed, widest) : widest;
      const auto entered = [&](double margin) { return within_from(least - margin, greatest + margin); };
      const auto lasting = [&](double margin) {
        const double t = entered(margin);
        return t <= end.begin || narrow == widest ? t : entered(widest);
      };
      const double one = lasting(1.1 * narrow), other = lasting(0.9 * narrow);
      j["run_up"] = lasting(narrow), j["run_up_earliest"] = std::min(one, other),
      j["run_up_latest"] = std::max(one, other);
    } else if (!list.empty()) {
      j["mean_speed"] = list.back().mean, j["least_speed"] = list.back().least,
      j["greatest_speed"] = list.back().greatest;
      j["stands_within"] = stands_within(list.back().begin, list.back().end);
    }
  }

  const Model& m_;
  const std::vector<Moment>& p_;
  Path path_;
  double usual_, until_;
  bool slips_under_torque_ = false;
};

// --- contacts ---

bool counts(const Stretch& s, const Contact& c) {
  return s.state == Stretch::State::slips && (s.slip > turns * c.usual_speed || s.slipped > 1e-2);
}
bool closed(double command) { return command >= 1 - 1e-12; }

json facts_of(const Contact& c, double until) {
  using State = Stretch::State;
  json j{{"component", c.component}, {"kind", c.kind}, {"capacity", c.capacity}, {"usual_speed", c.usual_speed}};
  double open = 0, holds = 0, slips = 0, longest = 0, deepest = 0, held_torque = 0, heat = 0, hottest = 0,
         stopped_within = 0;
  int lets_go = 0, lets_go_at_all = 0, engages = 0, slipping = 0;
  json first;
  for (std::size_t k = 0; k < c.stretches.size(); ++k) {
    const Stretch& s = c.stretches[k];
    const double length = s.end - s.begin;
    (s.state == State::open ? open : s.state == State::holds ? holds : slips) += length;
    heat += s.heat, hottest = std::max(hottest, s.heat);
    if (s.state == State::holds && closed(s.command_begin) && closed(s.command_end))
      held_torque = std::max(held_torque, s.torque);
    const bool held_before =
        k > 0 && c.stretches[k - 1].state == State::holds && closed(c.stretches[k - 1].command_end);
    if (s.state == State::holds && k > 0 && c.stretches[k - 1].state == State::slips)
      stopped_within = std::max(stopped_within, c.stretches[k - 1].end - c.stretches[k - 1].begin);
    const bool lets = s.state == State::slips && held_before && closed(s.command_begin);
    if (lets) ++lets_go_at_all;
    if (!counts(s, c)) continue;
    ++slipping;
    if (lets) {
      if (++lets_go == 1) first = s.begin;
      longest = std::max(longest, length), deepest = std::max(deepest, s.slipped);
    } else if (s.command_end >= s.command_begin) {
      ++engages;
    }
  }
  j["open"] = open, j["holds"] = holds, j["slips"] = slips;
  j["times_slipping"] = slipping, j["lets_go"] = lets_go, j["lets_go_at_all"] = lets_go_at_all, j["engages"] = engages,
  j["first_let_go"] = first;
  j["longest"] = longest, j["deepest"] = deepest, j["greatest_held_torque"] = held_torque;
  j["heat"] = heat, j["hottest"] = hottest, j["stopped_within"] = stopped_within;
  if (!c.stretches.empty()) {
    const Stretch& last = c.stretches.back();
    j["at_end"] = last.state == State::open ? "open" : last.state == State::holds ? "holds" : "slips";
    j["slips_since"] = last.begin, j["command_at_end"] = last.command_end, j["slip_at_end"] = last.sense;
    j["torque_of_last"] = last.torque;
    j["slips_to_the_end"] = last.state == State::slips && last.command_end > 0 && until - last.begin > at_end * until &&
                            std::abs(last.sense) > turns * c.usual_speed;
  }
  return j;
}

bool has_two_periods(const Model& m) try {
  return m.cycle > 0 && periodicity_of(m).by_time;
} catch (const std::invalid_argument&) {  // that never meet
  return true;
}

}  // namespace

json classify(const Observed& seen, const Observed* later) {
  json j{{"complete", seen.outcome.complete}, {"link", seen.link}, {"prescribed", false}};
  if (!seen.outcome.complete) j["diagnosis"] = seen.outcome.diagnosis;
  const Model& m = *seen.model;
  const int shaft = m.shaft_of_node[static_cast<std::size_t>(m.reduction_node)];
  j["prescribed"] = static_cast<std::size_t>(shaft) >= m.free_shafts;
  j["two_periods"] = has_two_periods(m);
  j["sequence"] = m.scene.sequence.steps.size(), j["repeats"] = m.scene.sequence.repeat;
  if (seen.moments.size() < 3) return j;
  j["motion"] = MotionJudge(seen, seen.moments).all();
  if (!seen.moments.back().driven) {
    std::vector<Moment> driven = seen.moments;
    while (!driven.empty() && !driven.back().driven) driven.pop_back();
    if (driven.size() > 2) j["driven_part"] = MotionJudge(seen, driven).all();
  }
  j["fastest_shaft"] = seen.fastest_shaft;
  if (later && later->moments.size() > 2) {
    const MotionJudge judge(*later, later->moments);
    json l = judge.all();
    const double t = later->moments.back().t;
    l["complete"] = later->outcome.complete, l["mean_speed_of_last_tenth"] = judge.mean_speed_of_last_tenth();
    l["fastest_shaft"] = later->fastest_shaft, l["mean_speed_before"] = judge.mean_speed(0.45 * t, 0.5 * t);
    double drift = 0;
    for (const MotorSeen& motor : later->motors) {
      const auto [before, last] = std::pair(std::abs(motor.late_turned[0]), std::abs(motor.late_turned[1]));
      if (before > turns * motor.rated_speed * 0.125 * t) drift = std::max(drift, std::abs(last / before - 1));
    }
    l["drift_of_motors"] = drift;
    j["later"] = l;
  }
  j["contacts"] = json::array();
  for (const Contact& c : seen.contacts) j["contacts"].push_back(facts_of(c, seen.moments.back().t));
  j["motors"] = json::array();
  for (const MotorSeen& motor : seen.motors)
    j["motors"].push_back({{"component", motor.component},
                           {"kind", m.network.kind_of(motor.component)},
                           {"late_rms_torque", std::sqrt(std::min(motor.late_squares[0], motor.late_squares[1]) /
                                                         (0.125 * seen.moments.back().t))},
                           {"rated_torque", motor.rated_torque},
                           {"rated_speed", motor.rated_speed},
                           {"torque", motor.torque},
                           {"speed", motor.speed},
                           {"command", motor.command},
                           {"greatest_torque", motor.greatest},
                           {"rms_torque", std::sqrt(motor.squares / seen.moments.back().t)},
                           {"stands", std::abs(motor.speed) < turns * std::abs(motor.rated_speed) &&
                                          motor.command != 0 && std::abs(motor.torque) > 1e-3 * motor.rated_torque}});
  j["limits"] = limits_of(seen);
  j["torques"] = json::object();
  for (const Extremes& e : seen.torques) j["torques"][e.of] = e.magnitude();
  j["turning_at_end"] = seen.turning, j["held"] = seen.outcome.held;
  return j;
}

}  // namespace kurbel::oracle
