// overlay.h — a measurement compared with a run or with steady cycles: figures, traces for plots, sentences.
#pragma once

#include <string>
#include <vector>

#include "studies/findings/findings.h"
#include "studies/measured/alignment.h"
#include "studies/measured/measurement.h"
#include "studies/steady/steady.h"

namespace kurbel {

// Comparison with one model.
struct ModelOverlay {
  std::string label;
  Role role = Role::elastic;
  std::vector<Signal> simulated;  // in the order of the measurement's signals
  Alignment alignment;
};

struct Overlay {
  Measurement measurement;
  std::vector<ModelOverlay> models;  // those that could be compared
  bool of_cycle = false;
  SpeedUnit speed = {};
  std::vector<std::string> notes = {};
};

// Channels that a run records, and those recorded along a steady cycle.
std::vector<KnownChannel> channels_of_run(const Model& model);
std::vector<KnownChannel> channels_of_cycle(const Model& model);

// A channel along a run: the trace for plots, dense at fast changes, and the rows of the trajectory.
Signal signal_of(const Result& run, const std::string& channel);

// Adds the residuals to the figures of run or cycles, and the measured values to their traces.
Overlay lay_over(const Measurement& measurement, Result& run);
Overlay lay_over(const Measurement& measurement, SteadyStudy& study);

// --- its findings (overlay_findings.cpp) ---

// The overlay must outlive the findings.
void show(Findings& findings, const Overlay& overlay);
// The steady cycles, compared with a measured record if requested. Throws as steady and read_measurement do.
StudyOutput cycles_under(const MeasurementRequest& request, const Scene& scene, const std::vector<Effects>& effects,
                         SteadyOptions options);

}  // namespace kurbel
