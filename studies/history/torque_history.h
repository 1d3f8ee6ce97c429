// torque_history.h — a torque of the simulated scene over time, and what it is made of.
//
// The run is that of `kurbel run`: the same start, operating sequence, contacts, and effects, tightened until its
// figures are confirmed. What is read off its samples has an error of two parts: what the run's torque lacks, measured
// at its peak, and twice what half as many samples, or half the window, change.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "engine/scene/scene.h"
#include "studies/findings/watch.h"
#include "studies/history/rainflow.h"
#include "studies/history/spectrum.h"

namespace kurbel {

struct TorqueHistory {
  std::string component;  // whose torque it is
  std::string channel;
  std::vector<double> time, speed, angle, value;  // speed and angle of the reduction link
  AmplitudeSpectrum spectrum, orders;
  std::vector<SpectralLine> strongest, strongest_orders;  // amplitudes with the run's error, or none; orders, not Hz
  std::vector<WaterfallLine> lines;
  std::vector<LoadCycle> cycles;  // of more than `resolution` in range, the largest first
  Estimate greatest, least;
  Estimate equivalent_amplitude;    // of the cycles at m = 5
  std::optional<double> run_error;  // of the torque [N·m]; empty: the run was not confirmed, and no error is known
  double resolution = 0;            // ranges up to this are the run's error, or no run tells
  bool complete = true;
  std::string diagnosis;
};

struct HistoryWanted {
  std::string torque;  // of a component: "main_coupling"
  std::string link;    // component whose turns the orders count
  double highest = 0;  // samples are enough for swings of up to this [rad/s]
  Watch watch = {};
};

// Throws std::invalid_argument where the scene has no such torque, SceneError where it makes no machine.
TorqueHistory simulate_torque(const Scene& scene, const Effects& effects, const HistoryWanted& wanted);

// Wöhler exponent of `equivalent_amplitude`.
inline constexpr double load_exponent = 5;

}  // namespace kurbel
