// overlay.h — a measurement laid over a run or over steady cycles: figures, traces for the plots, words.
#pragma once

#include <string>
#include <vector>

#include "studies/findings/findings.h"
#include "studies/measured/alignment.h"
#include "studies/measured/measurement.h"
#include "studies/steady/steady.h"

namespace kurbel {

// One model under it.
struct ModelOverlay {
  std::string label;
  Role role = Role::elastic;
  std::vector<Signal> simulated;  // as the measurement's signals
  Alignment alignment;
};

struct Overlay {
  Measurement measurement;
  std::vector<ModelOverlay> models;  // that it could be laid over
  bool of_cycle = false;
  SpeedUnit speed = {};
  std::vector<std::string> notes = {};
};

// What a run records, and what a steady cycle is followed by.
std::vector<KnownChannel> channels_of_run(const Model& model);
std::vector<KnownChannel> channels_of_cycle(const Model& model);

// A channel along a run: what was followed for the plots, close where something happens, and the rows of the trajectory.
Signal signal_of(const Result& run, const std::string& channel);

// Adds the residuals to the figures of run or cycles, and what was measured to their traces.
Overlay lay_over(const Measurement& measurement, Result& run);
Overlay lay_over(const Measurement& measurement, SteadyStudy& study);

// --- what is said of it (overlay_findings.cpp) ---

// The overlay must outlive the findings.
void show(Findings& findings, const Overlay& overlay);
// The steady cycles, with a test's record over them where one is asked for. Throws as steady and read_measurement do.
StudyOutput cycles_under(const MeasurementRequest& request, const Scene& scene, const std::vector<Effects>& effects,
                         SteadyOptions options);

}  // namespace kurbel
