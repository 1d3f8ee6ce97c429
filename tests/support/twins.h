// twins.h — one machine described in two ways: behind an ideal gear or reduced to the shaft before it, forwards or
// mirrored; and the comparison of all results of its runs.
//
// Values in a scene's text are in angle brackets, each with the letter of its kind:
//     <J 0.3> kg·m²   <k 200> N·m/rad   <c 2> N·m·s/rad   <q 0.1> N·m·s²/rad²   <M 40> N·m   <w 30> rad/s   <a 0.1> rad
// other quantities with the power of the ratio by which they transform: <^-3 kg/m3 870>. Without plus they are
// magnitudes; with a plus their sign changes with the sense of rotation: <M+ 40>, <w+ 30>, <^0+ m 0.2>. <?a|b> is the
// text a, in a mirrored machine b. <curve+ speed N*m: 0 40, 60 -5; interpolation = "smooth"> is a table. "F:" before
// any of them uses the view of the far group in a text of the near one.
#pragma once

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

#include "engine/scene/scene.h"
#include "studies/findings/result.h"

namespace kurbel::test {

// A quantity written for ω is transformed to sign · ratio · ω: inertias J/ratio², stiffness and damping likewise,
// torques sign · M/ratio.                                                                     (theory 5.3)
struct View {
  double ratio = 1;
  int sign = 1;
  double power(int n) const { return std::pow(ratio, n); }
};

// --- texts -----------------------------------------------------------------------------------------------------------

inline double number_in(const std::string& text) {
  double value = 0;
  const auto begin = text.data() + text.find_first_not_of(' '), end = text.data() + text.size();
  if (std::from_chars(begin, end, value).ec != std::errc()) throw std::logic_error("no number: " + text);
  return value;
}

inline std::string twin_curve(const std::string& token, bool turns, const View& view) {
  const std::size_t colon = token.find(':'), tail = token.find(';');
  const std::size_t space = token.find(' ');
  const std::string over = token.substr(0, space), unit = token.substr(space + 1, colon - space - 1);
  const int sign = turns ? view.sign : 1;
  const double of_x = over == "speed" || over == "angle" || over == "twist" ? view.ratio * sign : 1;
  const double of_y = unit == "N*m" ? sign / view.ratio : unit == "rad/s" ? sign * view.ratio : 1;
  const char* x_unit = over == "speed" ? "rad/s" : over == "time" ? "s" : over == "speed ratio" ? "1" : "rad";
  std::vector<std::pair<double, double>> points;
  const std::string list = token.substr(colon + 1, tail == std::string::npos ? tail : tail - colon - 1);
  for (std::size_t from = 0; from != std::string::npos && from < list.size();) {
    const std::size_t comma = list.find(',', from), first = list.find_first_not_of(' ', from);
    const std::size_t gap = list.find(' ', first);
    points.emplace_back(of_x * number_in(list.substr(first, gap - first)), of_y * number_in(list.substr(gap)));
    from = comma == std::string::npos ? comma : comma + 1;
  }
  if (of_x < 0) std::reverse(points.begin(), points.end());
  std::string text = fmt::format("{{ over = \"{}\", unit = [\"{}\", \"{}\"], points = [",
                                 over == "ratio" ? "speed ratio" : over, over == "ratio" ? "1" : x_unit, unit);
  for (const auto& [x, y] : points) text += fmt::format("[{:.17g}, {:.17g}], ", x, y);
  text += "]";
  if (tail != std::string::npos) {
    const std::string option = token.substr(tail + 2);
    const std::string period = "period ";
    text += ", " + (option.starts_with(period)
                        ? fmt::format("period = \"{:.17g} {}\"",
                                      std::abs(of_x) * number_in(option.substr(period.size())), x_unit)
                        : option);
  }
  return text + " }";
}

inline std::string twin_value(std::string token, const View& view) {
  static const std::map<char, std::pair<const char*, int>> kinds = {
      {'J', {"kg*m2", -2}}, {'k', {"N*m/rad", -2}}, {'c', {"N*m*s/rad", -2}}, {'q', {"N*m*s2/rad2", -3}},
      {'M', {"N*m", -1}},   {'w', {"rad/s", 1}},    {'a', {"rad", 1}}};
  if (token.front() == '?') {
    const std::size_t bar = token.find('|');
    return view.sign > 0 ? token.substr(1, bar - 1) : token.substr(bar + 1);
  }
  const std::size_t space = token.find(' ');
  const bool turns = token[space - 1] == '+';
  const std::string head = token.substr(0, turns ? space - 1 : space), rest = token.substr(space + 1);
  if (head == "curve") return twin_curve(rest, turns, view);
  const double sign = turns ? view.sign : 1;
  if (head.front() == '^') {
    const std::size_t gap = rest.find(' ');
    const std::string unit = rest.substr(0, gap);
    const double value = sign * std::pow(view.ratio, number_in(head.substr(1))) * number_in(rest.substr(gap));
    return unit == "1" ? fmt::format("{:.17g}", value) : fmt::format("\"{:.17g} {}\"", value, unit);
  }
  const auto& [unit, power] = kinds.at(head.front());
  return fmt::format("\"{:.17g} {}\"", sign * view.power(power) * number_in(rest), unit);
}

inline std::string seen(const std::string& text, const View& here, const View& far) {
  std::string out;
  for (std::size_t from = 0; from < text.size();) {
    const std::size_t open = text.find('<', from);
    out += text.substr(from, open - from);
    if (open == std::string::npos) break;
    const std::size_t close = text.find('>', open);
    const std::string token = text.substr(open + 1, close - open - 1);
    out += token.starts_with("F:") ? twin_value(token.substr(2), far) : twin_value(token, here);
    from = close + 1;
  }
  return out;
}

// An ideal gear with ω_in = ratio · ω_out: a gearbox or, for a negative ratio, a planetary gear with fixed carrier.
struct IdealGear {
  std::vector<std::pair<int, int>> teeth;  // of the stages; for a planetary gear of sun and ring
  bool reversing = false;
  double ratio() const {
    double product = reversing ? -1 : 1;
    for (const auto& [driving, driven] : teeth) product *= static_cast<double>(driven) / driving;
    return product;
  }
  View view() const { return {std::abs(ratio()), reversing ? -1 : 1}; }
  std::string text(const std::string& name, bool back) const {
    if (reversing)
      return fmt::format(
          "\n[{}]\nkind = \"planetary gear\"\nsun = {}\nring = {}\nin = \"{}\"\nout = \"{}\"\nfixed = \"carrier\"\n",
          name, teeth[0].first, teeth[0].second, back ? "ring" : "sun", back ? "sun" : "ring");
    std::string stages;
    for (const auto& [driving, driven] : teeth)
      stages += fmt::format("{{ teeth = [{}, {}] }}, ", back ? driven : driving, back ? driving : driven);
    return fmt::format("\n[{}]\nkind = \"gearbox\"\nstages = [{}]\n", name, stages);
  }
};

// --- scenes ----------------------------------------------------------------------------------------------------------

// Splits a text into its tables.
inline std::vector<std::pair<std::string, std::string>> tables_in(const std::string& text) {
  std::vector<std::pair<std::string, std::string>> tables;
  for (std::size_t from = text.find("\n["); from != std::string::npos;) {
    const std::size_t next = text.find("\n[", from + 1), close = text.find(']', from);
    tables.emplace_back(text.substr(from + 2, close - from - 2), text.substr(from, next - from));
    from = next;
  }
  return tables;
}

struct TwinScene {
  std::string name;
  std::vector<std::string> near, far, rest;     // along the line: there is a gear before and after the far ones
  std::vector<std::string> far_besides = {};    // further components of the far group: on a shaft, in branches
  std::string near_text, far_text;              // tables of all components, in the view of their group
  std::string end;                              // branches, effects, sequence, run
  std::map<std::string, int> output_sign = {};  // of mechanisms' outputs in the mirrored machine; default: 1
  std::vector<std::string> travels = {};        // slides whose travel includes the start angle of their shaft
  bool reversible = true;                       // the far group has a mirrored form
  std::size_t gears = 4;                        // number of gears to use: laws over the angle fit few ratios only
  bool dear = false;                            // modes and reduction take 20 s and more: only in the thorough form
};

inline std::string line_of(const std::vector<std::vector<std::string>>& groups) {
  std::string text;
  for (const auto& group : groups)
    for (const std::string& name : group) text += fmt::format("\"{}\", ", name);
  return "line = [" + text + "]\n";
}

// The machine without gears: each group in its own view.
inline std::string direct(const TwinScene& s, const View& near, const View& far) {
  return line_of({s.near, s.far, s.rest}) + seen(s.near_text, near, far) + seen(s.far_text, far, far) +
         seen(s.end, near, far);
}
// The machine with gears, each group as written.
inline std::string geared(const TwinScene& s, const IdealGear& gear) {
  std::vector<std::vector<std::string>> groups = {s.near, {"gear_to"}, s.far};
  if (!s.rest.empty()) groups.push_back({"gear_back"}), groups.push_back(s.rest);
  const std::string gears = gear.text("gear_to", false) + (s.rest.empty() ? "" : gear.text("gear_back", true));
  return line_of(groups) + seen(s.near_text, {}, {}) + seen(s.far_text, {}, {}) + gears + seen(s.end, {}, {});
}

// --- comparison ------------------------------------------------------------------------------------------------------

// Transforms the first run's results of a component to those of the second one.
struct TwinMap {
  std::map<std::string, View> view = {};
  View other = {};                              // for components not in `view`
  double turned = 0;                            // shift of all angles [rad]
  std::map<std::string, int> output_sign = {};  // of mechanisms' outputs
  std::vector<std::string> slides = {};         // slides whose travel has the sign of their shaft's sense
  std::vector<std::string> travels = {};        // slides that start at a shifted position
  View of(const std::string& component) const {
    const auto found = view.find(component);
    return found == view.end() ? other : found->second;
  }
  // "torque.gear.sun" → gear
  // "peak_torque.coupling" → coupling, and "torque_order.0.5.coupling", with the order in between.
  static std::string component_in(const std::string& name) {
    std::size_t first = name.find('.');
    while (first != std::string::npos && first + 1 < name.size() && std::isdigit(name[first + 1]))
      first = name.find('.', first + 1);
    return first == std::string::npos ? name : name.substr(first + 1, name.find('.', first + 1) - first - 1);
  }
  // Shafts behind gears are shifted according to their ratio: their shift at the start, which is constant.
  std::map<std::string, double> start_shift = {};  // of components
  double offset(const std::string& name) const {
    if (!name.starts_with("angle.") && !name.starts_with("final_angle.")) return 0;
    const auto found = start_shift.find(name.substr(name.find('.') + 1));
    return found == start_shift.end() ? turned : found->second;
  }
  void find_start_shift(const TrajectoryRecorder& a, const TrajectoryRecorder& b) {
    if (turned == 0) return;
    for (std::size_t k = 0; k < a.channels().size() && k < b.channels().size(); ++k) {
      const std::string& name = a.channels()[k].name.text;
      if (!name.starts_with("angle.")) continue;
      const std::string shaft = name.substr(name.find('.') + 1);
      start_shift[shaft] = b.value(0, k) - a.value(0, k);
      if (shaft.ends_with(".out")) start_shift[shaft.substr(0, shaft.size() - 4)] = start_shift[shaft];
    }
  }
  double factor(const std::string& name, const std::string& unit) const {
    const View v = of(component_in(name));
    std::string quantity = name.substr(0, name.find('.'));
    const bool magnitude = quantity.starts_with("rms_") || quantity.starts_with("cycle_rms_") ||
                           quantity == "motor_rms_torque" || quantity.ends_with("_order");
    for (const char* prefix : {"cycle_peak_", "cycle_rms_", "peak_", "rms_"})
      if (quantity.starts_with(prefix)) quantity = quantity.substr(std::string(prefix).size());
    // Transverse quantities of a mirrored slider-crank change sign.
    for (const char* across : {"crank_pin_shift_y", "crank_pin_shift_y_rate", "guide_reaction", "rod_deflection"})
      if (quantity == across) return other.sign;
    if (quantity.starts_with("bending_")) return other.sign;
    for (const char* of_output : {"position", "velocity", "acceleration", "force", "load_torque"})
      if (quantity == of_output) {
        if (std::find(slides.begin(), slides.end(), component_in(name)) != slides.end()) return magnitude ? 1 : v.sign;
        const auto found = output_sign.find(component_in(name));
        return found == output_sign.end() ? 1 : found->second;
      }
    if (unit == "rad" || unit == "rad/s" || unit == "rad/s2") return (magnitude ? 1 : v.sign) * v.ratio;
    // Pulleys keep their radius, so that forces transform like torques.
    if (quantity == "strand_force" || quantity == "slack_force") return 1 / v.ratio;
    if (unit == "N*m") return (magnitude ? 1 : v.sign) / v.ratio;
    return 1;
  }
};

inline TwinMap map_of(const TwinScene& s, const View& near, const View& far) {
  TwinMap map;
  map.other = near;
  for (const auto* group : {&s.far, &s.far_besides})
    for (const std::string& name : *group) map.view[name] = far;
  if (near.sign < 0) map.output_sign = s.output_sign;
  map.slides = s.travels;
  return map;
}

// No heat of slip is given for a motor with commands, such as a mirrored one, which is reversed.
inline bool of_a_commanded_motor(const std::string& name) { return name.starts_with("motor_slip_heat."); }

inline bool of_a_gear(const std::string& name) {
  return name.find("gear_to") != name.npos || name.find("gear_back") != name.npos;
}

inline std::string turned(std::string words, int sign) {
  if (sign > 0) return words;
  if (words == "slips") return "slips backwards";  // of a belt
  if (words == "slips backwards") return "slips";
  for (const auto& [a, b] :
       {std::pair{"forwards", "backwards"}, {"driving flank", "rear flank"}, {"upper limit", "lower limit"}}) {
    const std::size_t of_a = words.find(a), of_b = words.find(b);
    if (of_a != words.npos) words.replace(of_a, std::string(a).size(), b);
    if (of_b != words.npos) words.replace(of_b, std::string(b).size(), a);
  }
  return words;
}

// Names of the ends of a travel if its sign is reversed.
inline std::string at_other_end(std::string words) {
  for (const auto& [a, b] : {std::pair{"extended", "folded"}, {"least", "greatest"}}) {
    const std::size_t of_a = words.find(a), of_b = words.find(b);
    if (of_a != words.npos) words.replace(of_a, std::string(a).size(), b);
    if (of_b != words.npos) words.replace(of_b, std::string(b).size(), a);
  }
  return words;
}

// Channel by channel and row by row, relative to the largest value of the channel.
inline void expect_same_channels(const Result& first, const Result& second, const TwinMap& map, double allowed) {
  const TrajectoryRecorder &a = *first.trajectory, &b = *second.trajectory;
  ASSERT_EQ(a.time().size(), b.time().size());
  std::size_t compared = 0;
  for (std::size_t k = 0; k < a.channels().size(); ++k) {
    const Channel& channel = a.channels()[k];
    if (of_a_gear(channel.name.text)) continue;
    const auto same = std::find_if(b.channels().begin(), b.channels().end(),
                                   [&](const Channel& c) { return c.name == channel.name && c.unit == channel.unit; });
    if (same == b.channels().end()) {
      ADD_FAILURE() << "the second run has no channel " << channel.name.text;
      continue;
    }
    const auto m = static_cast<std::size_t>(same - b.channels().begin());
    const double factor = map.factor(channel.name.text, channel.unit);
    double offset = map.offset(channel.name.text);
    // The position of a rotating output is compared modulo whole turns.
    if (channel.unit == "rad" && channel.name.text.starts_with("position.") && !a.time().empty())
      offset += 2 * M_PI * std::round((b.value(0, m) - factor * a.value(0, k) - offset) / (2 * M_PI));
    for (const std::string& slide : map.travels)
      if (channel.name == "position." + slide) offset += b.value(0, m) - factor * a.value(0, k);
    double largest = 1e-4;
    for (std::size_t row = 0; row < a.time().size(); ++row) largest = std::max(largest, std::abs(b.value(row, m)));
    for (std::size_t row = 0; row < a.time().size(); ++row)
      if (!(std::abs(factor * a.value(row, k) + offset - b.value(row, m)) <= allowed * largest)) {
        ADD_FAILURE() << fmt::format(
            "{} at {:.6g} s: {:.10g} · {:.6g} = {:.10g}, but {:.10g}; off by {:.2g} of the largest", channel.name.text,
            a.time()[row], a.value(row, k), factor, factor * a.value(row, k) + offset, b.value(row, m),
            std::abs(factor * a.value(row, k) + offset - b.value(row, m)) / largest);
        break;
      }
    ++compared;
  }
  EXPECT_GT(compared, 0u);
}

inline void expect_same_figures(const std::vector<Figure>& first, const std::vector<Figure>& second, const TwinMap& map,
                                double allowed) {
  const auto counterpart = [&](std::string name) -> const Figure* {
    if (map.of(TwinMap::component_in(name)).sign < 0) {
      const std::size_t begin = name.starts_with("cycle_m") ? std::string("cycle_").size() : 0;
      if (name.compare(begin, 9, "max_speed") == 0)
        name.replace(begin, 3, "min");
      else if (name.compare(begin, 9, "min_speed") == 0)
        name.replace(begin, 3, "max");
    }
    return find(second, name);
  };
  for (const Figure& f : first) {
    if (of_a_gear(f.name) || of_a_commanded_motor(f.name)) continue;
    if (f.what.functional == Functional::order_phase) continue;  // reversing the rotation shifts it by half a turn
    const Figure* other = counterpart(f.name);
    if (!other && f.what.functional == Functional::order) continue;  // amplitudes within their error are not given
    if (!other) {
      ADD_FAILURE() << "the second run has no figure " << f.name;
      continue;
    }
    EXPECT_EQ(f.unit, other->unit) << f.name;
    const double factor = map.factor(f.name, f.unit);
    // Of two equal peaks of opposite sign either may be the larger.
    const bool peak = f.name.starts_with("peak_") || f.name.starts_with("cycle_peak_");
    const double a = peak ? std::abs(factor * f.value) : factor * f.value + map.offset(f.name),
                 b = peak ? std::abs(other->value) : other->value;
    const double scale = std::max({std::abs(b), 1e-3 * other->scale, 1e-9});
    if (!(std::abs(a - b) <= 3 * allowed * scale))
      ADD_FAILURE() << fmt::format("{}: {:.10g} · {:.6g}, but {:.10g}; off by {:.2g}", f.name, f.value, factor,
                                   other->value, std::abs(a - b) / scale);
  }
  const auto own = [](const std::vector<Figure>& list) {
    return std::count_if(list.begin(), list.end(), [](const Figure& f) {
      const bool of_an_order = f.what.functional == Functional::order || f.what.functional == Functional::order_phase;
      return !of_an_order && !of_a_gear(f.name) && !of_a_commanded_motor(f.name);
    });
  };
  EXPECT_EQ(own(first), own(second));
}

inline void expect_same_events(const Result& first, const Result& second, const TwinMap& map, double allowed) {
  const auto own = [](const std::vector<Event>& all) {
    std::vector<Event> kept;
    for (const Event& e : all)
      if (!of_a_gear(e.component)) kept.push_back(e);
    return kept;
  };
  const std::vector<Event> a = own(first.events), b = own(second.events);
  const auto reported = [](const std::vector<Event>& list) {
    std::string text;
    for (const Event& e : list)
      text += fmt::format("    {:.9g} s {}: {} (from {})\n", e.t, e.component, e.what, e.from);
    return text;
  };
  bool same = a.size() == b.size();
  for (std::size_t k = 0; same && k < a.size(); ++k) {
    const std::string owner = a[k].component.substr(0, a[k].component.find('.'));
    const int sign = map.of(owner).sign;
    const auto output = map.output_sign.find(owner);
    const bool other_end = output != map.output_sign.end() && output->second < 0;
    same = a[k].component == b[k].component &&
           (other_end ? at_other_end(a[k].what) : turned(a[k].what, sign)) == b[k].what &&
           turned(a[k].from, sign) == b[k].from && std::abs(a[k].t - b[k].t) <= 30 * allowed * second.until;
  }
  EXPECT_TRUE(same) << "events\n" << reported(a) << "and\n" << reported(b);
}

inline void expect_same_energy(const EnergyBalance& a, const EnergyBalance& b, double allowed) {
  double turnover = std::max({std::abs(b.kinetic_end), std::abs(b.kinetic_start), std::abs(b.stored_end)});
  for (const auto& [name, work] : b.by_account) turnover = std::max(turnover, std::abs(work));
  const auto same = [&](const std::string& what, double x, double y) {
    EXPECT_NEAR(x, y, 3 * allowed * turnover) << what;
  };
  for (const auto* lines : {&a.by_line, &a.by_account}) {
    const auto& others = lines == &a.by_line ? b.by_line : b.by_account;
    for (const auto& [name, work] : *lines)
      if (!of_a_gear(name)) same("work " + name, work, others.count(name) ? others.at(name) : 0);
  }
  same("kinetic energy at the start", a.kinetic_start, b.kinetic_start);
  same("kinetic energy at the end", a.kinetic_end, b.kinetic_end);
  same("stored energy at the start", a.stored_start, b.stored_start);
  same("stored energy at the end", a.stored_end, b.stored_end);
}

// All channels, figures, works, events and notes of the first run are in the second one, too. `allowed`: difference
// over the largest value of a channel, over the value of a figure.
inline void expect_same_run(const Result& first, const Result& second, TwinMap map, double allowed) {
  ASSERT_TRUE(first.complete && second.complete) << first.diagnosis << "\n" << second.diagnosis;
  map.find_start_shift(*first.trajectory, *second.trajectory);
  expect_same_channels(first, second, map, allowed);
  expect_same_figures(first.figures, second.figures, map, allowed);
  expect_same_events(first, second, map, allowed);
  expect_same_energy(first.energy, second.energy, allowed);
  // The note on coarse rows depends on a peak between two rows and may differ.
  const auto count = [](const Result& r) {
    return std::count_if(r.notes.begin(), r.notes.end(),
                         [](const std::string& note) { return !note.starts_with("the rows of trajectory.csv"); });
  };
  EXPECT_EQ(count(first), count(second)) << fmt::format("{}\nand\n{}", fmt::join(first.notes, "\n"),
                                                        fmt::join(second.notes, "\n"));
  EXPECT_EQ(first.cycles.size(), second.cycles.size());
  EXPECT_EQ(first.periods.steady, second.periods.steady);
}

}  // namespace kurbel::test
