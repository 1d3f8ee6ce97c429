// steady.h — the periodic motion of a machine, found directly: figures, stability, operating points.
#pragma once

#include <cmath>
#include <complex>
#include <optional>
#include <string>
#include <vector>

#include "engine/orbit/moment.h"
#include "engine/orbit/orbit.h"
#include "studies/findings/output.h"
#include "studies/findings/watch.h"
#include "studies/limits/joint_loads.h"
#include "studies/run/simulate.h"
#include "studies/steady/operating_points.h"
#include "studies/steady/orders.h"

namespace kurbel {

struct Traces;

struct SteadyOptions {
  // Demanded, of the reduction link, one of the two: (ω_max + ω_min)/2, or the mean over time [rad/s].
  std::optional<double> mid_speed = {}, mean_speed = {};
  // What keeps that speed, COMPONENT.KEY: a quantity of the scene that is scaled; empty: a torque added to the drive.
  std::string hold_by = {};
  Moment at = {};            // as the machine is then; default: when all is switched
  int periods = 1;           // cycles after which the motion repeats
  bool traces = false;       // for plots
  bool start_search = true;  // start from rest and the gearbox ratio that starts fastest
  bool every_order = false;  // figures of all orders, not of those alone that matter
  Watch watch = {};
  bool holds_speed() const { return mid_speed || mean_speed; }
  std::optional<double> held_speed() const { return mid_speed ? mid_speed : mean_speed; }
};

// δ of one shaft (theory 2.6).
struct ShaftFluctuation {
  std::string shaft;  // "motor", "gearbox.in"
  double ratio = 1;   // of its mean speed to the link's
  double max = 0, min = 0;
  double mid() const { return 0.5 * (max + min); }
  // Also of a shaft that turns backwards; none of one that stands or swings to and fro.
  std::optional<double> delta() const {
    if (!(max * min > 0)) return {};
    return (max - min) / std::abs(mid());
  }
};

struct MotorUse {
  std::string component;
  double rms = 0, mean = 0, peak = 0;      // of its torque over the cycle [N·m]
  std::optional<double> rated;             // [N·m], where the scene gives it
  std::optional<double> thermal() const {  // RMS over rated: what heats the windings
    return rated ? std::optional(rms / *rated) : std::nullopt;
  }
};

// A quantity of the scene with the value that a demanded speed needs.
struct HeldQuantity {
  std::string key;  // "load.torque"
  double value = 0, of_scene = 0;
  std::string unit;  // SI
};

// The steady cycle of one model.
struct SteadyCycle {
  std::string label, effects;
  std::shared_ptr<const Model> model;
  bool found = false;
  std::string why;  // in words, unless it was found
  Orbit::Kind kind = Orbit::Kind::failed;
  std::string orbit;  // in words: what the scene's own start leads to, and what decides that
  ReturnMap::End end = ReturnMap::End::returned;
  Periodicity periodicity;
  double section = 0;  // angle of the link where the map is taken [rad]
  SteadyPoint point;
  std::size_t unknowns = 0;
  int rounds = 0;                         // of the run, before Newton's method took over
  double cost = 0, cost_limit = 0;        // of the search, run included [cycles]
  double cycle_time = 0;                  // of one round [s]
  std::string stability;                  // in words
  std::optional<double> halving;          // cycles in which the slowest deviation halves
  std::vector<double> multiplier_errors;  // by a looser search, and what the derivative is good for; empty: not known
  bool neutral = false;                   // a multiplier of 1: one of a family
  bool uncertain = false;                 // the derivative of the map, and with it the stability
  std::vector<Figure> figures;            // with errors measured by a looser search
  std::vector<OrdersOf> orders;           // of speeds and torques; with their errors, too
  std::vector<ShaftFluctuation> shafts;
  std::vector<MotorUse> motors;
  SteadyLoads loads;                          // of its joints, where any has limits
  double work_residual = 0;                   // of the cycle's works against each other, over the driving work
  double added_torque = 0;                    // constant, beside the drive, that the demanded mean speed needs [N·m]
  std::string added_at;                       // on this component's shaft
  std::optional<HeldQuantity> held_quantity;  // that keeps the demanded speed instead
  std::shared_ptr<const Traces> traces;
  std::vector<std::string> notes;  // how far the model holds in this motion
  std::vector<std::string> outside_data =
      {};  // what it takes from beyond the ends of tables: no figure has an error then
  double cpu_seconds = 0;

  const Figure* find(std::string_view name) const { return kurbel::find(figures, name); }
};

struct SteadyStudy {
  std::string title, scene_file, link;
  std::optional<double> mid_speed;
  std::optional<OperatingDiagram> diagram;  // none where time drives or a speed is prescribed
  std::string no_diagram;                   // why
  std::vector<SteadyCycle> cycles;          // of the models asked for
  std::optional<StartRun> start;            // rigid, from rest to 95 % of the steady speed
  std::vector<RatioSearch> ratios;
  std::string later;  // in the end it rests, and why the motion shown is that of an earlier moment; empty: it is not
  std::vector<std::string> notes;
  std::string conclusion;
  bool complete = true;
  std::string diagnosis;
};

// Of the cycles to show side by side where none are asked for: the scene's own effects, rigid and elastic, so that
// elasticity alone differs. A scene without any is shown with all of its elasticity, too; one set where nothing is
// elastic. The rigid cycle has ideal joints, which the study tells.
std::vector<Effects> effects_side_by_side(const Scene& scene);

// Finds the steady cycle of the scene with each set of effects. Throws SceneError where the scene makes no machine;
// std::invalid_argument in words where the question is incomplete: a family of cycles without --mean-speed, periods
// that never meet, a mean speed of a machine that time drives.
SteadyStudy steady(const Scene& scene, const std::vector<Effects>& effects, const SteadyOptions& options);

// "stable: the slowest deviation halves in 3.2 cycles"; what differs from 1 by no more than the error is neutral.
std::string stability_text(const std::vector<std::complex<double>>& multipliers, std::optional<double>* halving,
                           double error);

// Files: operating_points.csv, and steady.LABEL.csv per model with traces. The study must outlive the findings.
Findings findings_of(const SteadyStudy& study);

}  // namespace kurbel
