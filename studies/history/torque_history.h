// torque_history.h — a torque of the simulated scene over time, and its components in frequency.
//
// The run is that of `kurbel run`: the same start, operating sequence, contacts and effects, with tolerances reduced
// until its figures are confirmed. Results from its samples have an error of two parts: the error of the run's
// torque, measured at its peak, and twice the change with half as many samples or half the window.
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
  std::string component;  // the component of the torque
  std::string channel;
  std::vector<double> time, speed, angle, value;  // speed and angle of the reduction link
  AmplitudeSpectrum spectrum, orders;
  std::vector<SpectralLine> strongest, strongest_orders;  // amplitudes with the run's error, or none; orders, not Hz
  std::vector<WaterfallLine> lines;
  std::vector<LoadCycle> cycles;  // of more than `resolution` in range, the largest first
  Estimate greatest, least;
  Estimate equivalent_amplitude;    // of the cycles at m = 5
  std::optional<double> run_error;  // of the torque [N·m]; empty: the run was not confirmed, its error is unknown
  double resolution = 0;            // smaller ranges are below the run's error, or unknown
  bool complete = true;
  std::string diagnosis;
};

struct HistoryWanted {
  std::string torque;  // of a component: "main_coupling"
  std::string link;    // component whose turns define the orders
  double highest = 0;  // highest frequency that the samples must resolve [rad/s]
  Watch watch = {};
};

// Throws std::invalid_argument if the scene has no such torque, SceneError if it makes no machine.
TorqueHistory simulate_torque(const Scene& scene, const Effects& effects, const HistoryWanted& wanted);

// Wöhler exponent of `equivalent_amplitude`.
inline constexpr double load_exponent = 5;

}  // namespace kurbel
