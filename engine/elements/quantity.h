// quantity.h — quantities of channels and figures, functional ∘ channel ∘ window, and the names made of them.
//
// A name is "what.whose", such as peak_torque.main_coupling. Programs search by quantity and owner; names are never
// parsed.
#pragma once

#include <algorithm>
#include <cstddef>
#include <initializer_list>
#include <string>
#include <string_view>
#include <utility>

namespace kurbel {

// Functional of a channel.
enum class Functional {
  none,         // the channel itself, or a figure defined by its word
  peak,         // its value of greatest magnitude, with its sign
  greatest,     // its largest value
  least,        // its smallest
  mid,          // midpoint of these two
  mean,         // over time
  rms,          // root of the mean square over time
  last,         // at the end
  order,        // amplitude of the harmonic with this number of periods per turn of the reduction link
  order_phase,  // its phase
  above         // time during which it lies above a level
};

// Prefix of the name.
inline const char* prefix_of(Functional functional) {
  constexpr const char* prefixes[] = {"",     "peak_",  "max_", "min_", "mid_",       "mean_",
                                      "rms_", "final_", "",     "",     "time_above_"};
  return prefixes[static_cast<std::size_t>(functional)];
}
// Suffix of the quantity; it is followed by the order: "torque_order.0.5.main_coupling".
inline const char* suffix_of(Functional functional) {
  return functional == Functional::order ? "_order" : functional == Functional::order_phase ? "_order_phase" : "";
}

struct QuantityKind {
  enum class Window {
    moment,        // a channel
    run,           // from the start of a run to its end
    cycle,         // the steady cycle, or the last whole cycle of a run before it runs down
    steady_cycle,  // the steady cycle, for quantities that also exist for a whole run
    step,          // of the operating sequence: until the next one is carried out
    run_up,        // the three periods of a run that becomes steady (studies/run/periods.h)
    steady_motion,
    run_down
  };
  std::string_view channel = {};  // "torque"; empty: an element's own, named in the text of the name
  Functional functional = Functional::none;
  Window window = Window::moment;

  friend constexpr bool operator==(const QuantityKind&, const QuantityKind&) = default;
};

// All quantities that programs search for; others have their own words.
namespace quantities {
using enum Functional;
using enum QuantityKind::Window;
inline constexpr QuantityKind other{};  // an internal state or output of an element
// channels
inline constexpr QuantityKind angle{"angle"};
inline constexpr QuantityKind speed{"speed"};
inline constexpr QuantityKind twist{"twist"};
inline constexpr QuantityKind slip{"slip"};
inline constexpr QuantityKind torque{"torque"};
inline constexpr QuantityKind spring_torque{"spring_torque"};
inline constexpr QuantityKind position{"position"};
inline constexpr QuantityKind velocity{"velocity"};
inline constexpr QuantityKind acceleration{"acceleration"};
inline constexpr QuantityKind force{"force"};
inline constexpr QuantityKind load_torque{"load_torque"};
// of a whole run
inline constexpr QuantityKind peak_torque{"torque", peak, run};
inline constexpr QuantityKind peak_spring_torque{"spring_torque", peak, run};
inline constexpr QuantityKind peak_velocity{"velocity", peak, run};
inline constexpr QuantityKind peak_acceleration{"acceleration", peak, run};
inline constexpr QuantityKind peak_force{"force", peak, run};
inline constexpr QuantityKind peak_load_torque{"load_torque", peak, run};
inline constexpr QuantityKind peak_other{"", peak, run};
inline constexpr QuantityKind max_speed{"speed", greatest, run};
inline constexpr QuantityKind min_speed{"speed", least, run};
inline constexpr QuantityKind rms_torque{"torque", rms, run};
inline constexpr QuantityKind rms_spring_torque{"spring_torque", rms, run};
inline constexpr QuantityKind final_angle{"angle", last, run};
inline constexpr QuantityKind final_speed{"speed", last, run};
inline constexpr QuantityKind steady_speed{"steady_speed", none, run};
inline constexpr QuantityKind run_up_time{"run_up_time", none, run};
inline constexpr QuantityKind run_down_time{"run_down_time", none, run};
inline constexpr QuantityKind stopping_time{"stopping_time", none, run};
inline constexpr QuantityKind stopping_angle{"stopping_angle", none, run};
inline constexpr QuantityKind slip_heat{"slip_heat", none, run};
inline constexpr QuantityKind impacts{"impacts", none, run};
inline constexpr QuantityKind amplification{"amplification", none, run};  // peak with elasticity over peak without
inline constexpr QuantityKind work{"work", none, run};                    // of a line of the energy balance
// of one cycle
inline constexpr QuantityKind cycle_peak_torque{"torque", peak, steady_cycle};
inline constexpr QuantityKind cycle_max_speed{"speed", greatest, steady_cycle};
inline constexpr QuantityKind cycle_min_speed{"speed", least, steady_cycle};
inline constexpr QuantityKind cycle_rms_torque{"torque", rms, steady_cycle};
inline constexpr QuantityKind peak_drive_torque{"drive_torque", peak, cycle};
inline constexpr QuantityKind mean_drive_torque{"drive_torque", mean, cycle};
inline constexpr QuantityKind rms_drive_torque{"drive_torque", rms, cycle};
inline constexpr QuantityKind mid_speed{"speed", mid, cycle};
inline constexpr QuantityKind mean_speed{"speed", mean, cycle};
inline constexpr QuantityKind delta{"delta", none, cycle};                          // of periodic motion
inline constexpr QuantityKind cycle_fluctuation{"cycle_fluctuation", none, cycle};  // the same for non-periodic motion
inline constexpr QuantityKind cycle_time{"cycle_time", none, cycle};
inline constexpr QuantityKind period{"period", none, cycle};
inline constexpr QuantityKind vibration_frequency{"vibration_frequency", none, cycle};
inline constexpr QuantityKind vibration_amplitude{"vibration_amplitude", none, cycle};
inline constexpr QuantityKind driving_work_per_cycle{"driving_work_per_cycle", none, cycle};
inline constexpr QuantityKind useful_work_per_cycle{"useful_work_per_cycle", none, cycle};
inline constexpr QuantityKind harmful_work_per_cycle{"harmful_work_per_cycle", none, cycle};
inline constexpr QuantityKind weight_work_per_cycle{"weight_work_per_cycle", none, cycle};
inline constexpr QuantityKind work_per_cycle{"work_per_cycle", none, cycle};  // of one account
inline constexpr QuantityKind speed_order{"speed", order, cycle};
inline constexpr QuantityKind speed_order_phase{"speed", order_phase, cycle};
inline constexpr QuantityKind torque_order{"torque", order, cycle};
inline constexpr QuantityKind torque_order_phase{"torque", order_phase, cycle};
}  // namespace quantities

// "cycle_peak_"; mean_speed is that of a cycle, so that the mean of a run says "run_mean_".
inline std::string prefix_of(const QuantityKind& what) {
  using enum QuantityKind::Window;
  const bool run_alone = what.window == run && what.functional == Functional::mean;
  constexpr const char* windows[] = {"", "", "", "cycle_", "step_", "run_up_", "steady_motion_", "run_down_"};
  const char* window = run_alone ? "run_" : windows[static_cast<std::size_t>(what.window)];
  return std::string(window) + prefix_of(what.functional);
}
// "cycle_peak_torque"; empty for an element's own quantity.
inline std::string word(const QuantityKind& what) {
  if (what.channel.empty()) return {};
  return prefix_of(what).append(what.channel).append(suffix_of(what.functional));
}

inline bool is_one_of(const QuantityKind& what, std::initializer_list<QuantityKind> kinds) {
  return std::find(kinds.begin(), kinds.end(), what) != kinds.end();
}

// Largest magnitude; of two equal ones with opposite signs, either may be taken.
inline bool is_peak(const QuantityKind& what) { return what.functional == Functional::peak; }

// Whether a figure is requested: by its full name, or by its quantity ("delta": of all owners).
inline bool is_asked_for(std::string_view name, std::string_view asked) {
  return name.starts_with(asked) && (name.size() == asked.size() || name[asked.size()] == '.');
}

// A quantity and its owner.
struct Name {
  QuantityKind what = {};
  std::string of;    // component or its part: "main_coupling", "gearbox.in"; empty: the whole machine
  std::string text;  // "peak_torque.main_coupling"

  static Name make(const QuantityKind& what, std::string of = {}) {
    std::string text = word(what);
    if (!of.empty()) text.append(".").append(of);
    return {what, std::move(of), std::move(text)};
  }
  // An element's own quantity: "current", "motor".
  static Name own(std::string_view words, const std::string& of) {
    return {quantities::other, of, std::string(words).append(".").append(of)};
  }
  // One of several of the same kind: "torque_order", "0.5", "main_coupling".
  static Name numbered(const QuantityKind& what, std::string_view number, const std::string& of) {
    return {what, of, word(what).append(".").append(number).append(".").append(of)};
  }
  friend bool operator==(const Name& a, const Name& b) { return a.text == b.text; }
  friend bool operator==(const Name& a, std::string_view text) { return a.text == text; }
  // For a channel, the figure of its peak over a whole run.
  Name peak() const {
    return {{what.channel, Functional::peak, QuantityKind::Window::run}, of, prefix_of(Functional::peak) + text};
  }
  // For an extreme or RMS value of a whole run, the same of a steady cycle; others are unchanged.
  Name of_cycle() const {
    if (what.window != QuantityKind::Window::run) return *this;
    if (what.functional == Functional::none || what.functional == Functional::last) return *this;
    return {{what.channel, what.functional, QuantityKind::Window::steady_cycle}, of, "cycle_" + text};
  }
};

}  // namespace kurbel
