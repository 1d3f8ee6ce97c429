// quantity.h — what channels and figures tell of: the words that their names are made of, each once.
//
// A name is "what.whose", as peak_torque.main_coupling. Programs that look for one ask for the quantity and its owner;
// no name is ever taken apart.
#pragma once

#include <string>
#include <string_view>
#include <utility>

namespace kurbel {

enum class QuantityKind {
  other,  // an element's own state or output
  // channels
  angle,
  speed,
  twist,
  slip,
  torque,
  spring_torque,
  position,
  velocity,
  acceleration,
  force,
  load_torque,
  // figures
  peak_torque,
  peak_spring_torque,
  peak_drive_torque,
  peak_velocity,
  peak_acceleration,
  peak_force,
  peak_load_torque,
  peak_other,  // of an element's own state or output
  max_speed,
  min_speed,
  mean_speed,
  steady_speed,
  delta,
  cycle_time,
  rms_torque,
  rms_spring_torque,
  mean_drive_torque,
  rms_drive_torque,
  final_angle,
  final_speed,
  run_up_time,
  run_down_time,
  stopping_time,
  stopping_angle,
  slip_heat,
  impacts,
  amplification,  // of a torque: peak with elasticity over peak without
  work,           // "work.driving": of a line of the energy balance
  driving_work_per_cycle,
  useful_work_per_cycle,
  harmful_work_per_cycle,
  weight_work_per_cycle,
  work_per_cycle  // of one account
};

inline const char* word(QuantityKind quantity) {
  using enum QuantityKind;
  static constexpr std::pair<QuantityKind, const char*> words[] = {{angle, "angle"},
                                                                   {speed, "speed"},
                                                                   {twist, "twist"},
                                                                   {slip, "slip"},
                                                                   {torque, "torque"},
                                                                   {spring_torque, "spring_torque"},
                                                                   {position, "position"},
                                                                   {velocity, "velocity"},
                                                                   {acceleration, "acceleration"},
                                                                   {force, "force"},
                                                                   {load_torque, "load_torque"},
                                                                   {peak_torque, "peak_torque"},
                                                                   {peak_spring_torque, "peak_spring_torque"},
                                                                   {peak_drive_torque, "peak_drive_torque"},
                                                                   {peak_velocity, "peak_velocity"},
                                                                   {peak_acceleration, "peak_acceleration"},
                                                                   {peak_force, "peak_force"},
                                                                   {peak_load_torque, "peak_load_torque"},
                                                                   {max_speed, "max_speed"},
                                                                   {min_speed, "min_speed"},
                                                                   {mean_speed, "mean_speed"},
                                                                   {steady_speed, "steady_speed"},
                                                                   {delta, "delta"},
                                                                   {cycle_time, "cycle_time"},
                                                                   {rms_torque, "rms_torque"},
                                                                   {rms_spring_torque, "rms_spring_torque"},
                                                                   {mean_drive_torque, "mean_drive_torque"},
                                                                   {rms_drive_torque, "rms_drive_torque"},
                                                                   {final_angle, "final_angle"},
                                                                   {final_speed, "final_speed"},
                                                                   {run_up_time, "run_up_time"},
                                                                   {run_down_time, "run_down_time"},
                                                                   {stopping_time, "stopping_time"},
                                                                   {stopping_angle, "stopping_angle"},
                                                                   {slip_heat, "slip_heat"},
                                                                   {impacts, "impacts"},
                                                                   {amplification, "amplification"},
                                                                   {work, "work"},
                                                                   {driving_work_per_cycle, "driving_work_per_cycle"},
                                                                   {useful_work_per_cycle, "useful_work_per_cycle"},
                                                                   {harmful_work_per_cycle, "harmful_work_per_cycle"},
                                                                   {weight_work_per_cycle, "weight_work_per_cycle"},
                                                                   {work_per_cycle, "work_per_cycle"}};
  for (const auto& [known, text] : words)
    if (known == quantity) return text;
  return "";  // of an element's own
}

// A largest magnitude: of two equal ones of opposite sign either may be taken.
inline bool is_peak(QuantityKind quantity) {
  return quantity >= QuantityKind::peak_torque && quantity <= QuantityKind::peak_other;
}

// A quantity and whose it is.
struct Name {
  QuantityKind what = QuantityKind::other;
  std::string of;    // component or part of it: "main_coupling", "gearbox.in"; empty: of the whole machine
  std::string text;  // "peak_torque.main_coupling"

  static Name make(QuantityKind what, std::string of = {}) {
    std::string text = word(what);
    if (!of.empty()) text += "." + of;
    return {what, std::move(of), std::move(text)};
  }
  // An element's own: "current", "motor".
  static Name own(const std::string& words, const std::string& of) {
    return {QuantityKind::other, of, words + "." + of};
  }
  friend bool operator==(const Name& a, const Name& b) { return a.text == b.text; }
  friend bool operator==(const Name& a, std::string_view text) { return a.text == text; }
  // Of a channel, the figure that tells its peak.
  Name peak() const {
    using enum QuantityKind;
    switch (what) {
      case torque:
        return make(peak_torque, of);
      case spring_torque:
        return make(peak_spring_torque, of);
      case velocity:
        return make(peak_velocity, of);
      case acceleration:
        return make(peak_acceleration, of);
      case force:
        return make(peak_force, of);
      case load_torque:
        return make(peak_load_torque, of);
      default:
        return {peak_other, of, "peak_" + text};
    }
  }
};

}  // namespace kurbel
