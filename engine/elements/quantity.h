// quantity.h — what channels and figures tell of: the words that their names are made of, each once.
//
// A name is "what.whose", as peak_torque.main_coupling. Programs that look for one ask for the quantity and its owner;
// no name is ever taken apart.
#pragma once

#include <string>
#include <string_view>
#include <utility>

#include "engine/base/enumerators.h"

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
  // figures of a whole run
  peak_torque,
  peak_spring_torque,
  peak_velocity,
  peak_acceleration,
  peak_force,
  peak_load_torque,
  peak_other,  // of an element's own state or output
  // of one steady cycle
  peak_drive_torque,
  cycle_peak_torque,
  cycle_peak_spring_torque,
  cycle_peak_velocity,
  cycle_peak_acceleration,
  cycle_peak_force,
  cycle_peak_load_torque,
  cycle_peak_other,
  // of a whole run
  max_speed,
  min_speed,
  rms_torque,
  rms_spring_torque,
  steady_speed,
  // of one cycle: the steady one, or a run's last whole one before it runs down
  cycle_max_speed,
  cycle_min_speed,
  mid_speed,
  mean_speed,
  delta,              // of motion that repeats
  cycle_fluctuation,  // the same of motion that does not
  cycle_time,
  period,
  cycle_rms_torque,
  mean_drive_torque,
  rms_drive_torque,
  // of a whole run
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

// Empty of an element's own, whose words it has itself.
inline const char* word(QuantityKind quantity) {
  using enum QuantityKind;
  const bool of_element = quantity == other || quantity == peak_other || quantity == cycle_peak_other;
  return of_element ? "" : enumerator_name<work_per_cycle>(quantity);
}

// A largest magnitude: of two equal ones of opposite sign either may be taken.
inline bool is_peak(QuantityKind quantity) {
  return quantity >= QuantityKind::peak_torque && quantity <= QuantityKind::cycle_peak_other;
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
    static constexpr std::pair<QuantityKind, QuantityKind> peaks[] = {
        {torque, peak_torque},     {spring_torque, peak_spring_torque},
        {velocity, peak_velocity}, {acceleration, peak_acceleration},
        {force, peak_force},       {load_torque, peak_load_torque}};
    for (const auto& [channel, figure] : peaks)
      if (channel == what) return make(figure, of);
    return {peak_other, of, "peak_" + text};
  }
  // Of a figure of a whole run, the like figure of one steady cycle; others are what they were.
  Name of_cycle() const {
    using enum QuantityKind;
    static constexpr std::pair<QuantityKind, QuantityKind> figures[] = {
        {peak_torque, cycle_peak_torque},     {peak_spring_torque, cycle_peak_spring_torque},
        {peak_velocity, cycle_peak_velocity}, {peak_acceleration, cycle_peak_acceleration},
        {peak_force, cycle_peak_force},       {peak_load_torque, cycle_peak_load_torque},
        {max_speed, cycle_max_speed},         {min_speed, cycle_min_speed},
        {rms_torque, cycle_rms_torque}};
    for (const auto& [of_run, of_round] : figures)
      if (of_run == what) return make(of_round, of);
    if (what == peak_other) return {cycle_peak_other, of, "cycle_" + text};
    return *this;
  }
};

}  // namespace kurbel
