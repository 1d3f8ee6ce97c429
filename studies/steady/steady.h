// steady.h — the periodic motion of a machine, computed directly: figures, stability, operating points.
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
  // Demanded speed of the reduction link, one of: (ω_max + ω_min)/2, or the mean over time [rad/s].
  std::optional<double> mid_speed = {}, mean_speed = {};
  // Quantity that holds this speed, COMPONENT.KEY: it is scaled; empty: a torque added to the drive.
  std::string hold_by = {};
  Moment at = {};            // state of the machine at that moment; default: after all switching
  int periods = 1;           // cycles after which the motion repeats; up to twelve times as many where it needs them
  bool traces = false;       // for plots
  bool start_search = true;  // also the start from rest and the gearbox ratio of the fastest start
  bool every_order = false;  // figures of all orders, not only of the significant ones
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
  // Also for a shaft that turns backwards; empty for one that stands or reverses.
  std::optional<double> delta() const {
    if (!(max * min > 0)) return {};
    return (max - min) / std::abs(mid());
  }
};

struct MotorUse {
  std::string component;
  double rms = 0, mean = 0, peak = 0;      // of its torque over the cycle [N·m]
  std::optional<double> rated;             // [N·m], if the scene gives it
  std::optional<double> thermal() const {  // RMS over rated torque: heating of the windings
    return rated ? std::optional(rms / *rated) : std::nullopt;
  }
};

// A quantity of the scene and its value for a demanded speed.
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
  std::string why;  // reason, if not found
  Orbit::Kind kind = Orbit::Kind::failed;
  std::string orbit;  // in words: the motion that the scene's own start leads to, and its cause
  ReturnMap::End end = ReturnMap::End::returned;
  Periodicity periodicity;
  double section = 0;  // link angle of the return map's section [rad]
  SteadyPoint point;
  std::size_t unknowns = 0;
  int run_cycles = 0;                     // of the run before Newton's method
  int repeats_after = 1;                  // one period [cycles]
  double cost = 0, cost_limit = 0;        // of the search including the run [cycles]
  double cycle_time = 0;                  // of one period [s]
  std::string stability;                  // in words
  std::optional<double> halving;          // cycles in which the slowest deviation is halved
  std::vector<double> multiplier_errors;  // by a looser search and the accuracy of the derivative; empty: not known
  bool neutral = false;                   // a multiplier of 1: member of a family
  bool uncertain = false;                 // the map's derivative is uncertain, and with it the stability
  std::vector<Figure> figures;            // with errors measured by a looser search
  std::vector<OrdersOf> orders;           // of speeds and torques; also with errors
  std::vector<ShaftFluctuation> shafts;
  std::vector<MotorUse> motors;
  Claims starters = {};                       // motors whose starters wait for ever
  SteadyLoads loads;                          // of its joints, if any has limits
  double work_residual = 0;                   // of the balance of works in the cycle, over the driving work
  double added_torque = 0;                    // constant torque besides the drive, for the demanded mean speed [N·m]
  std::string added_at;                       // on this component's shaft
  std::optional<HeldQuantity> held_quantity;  // scaled to hold the demanded speed instead
  std::shared_ptr<const Traces> traces;
  std::vector<std::string> notes;              // range of validity of the model in this motion
  std::vector<std::string> outside_data = {};  // extrapolation of tables: figures have no errors then
  double cpu_seconds = 0;

  const Figure* find(std::string_view name) const { return kurbel::find(figures, name); }
};

struct SteadyStudy : SceneStudy {
  std::string link;
  std::optional<double> mid_speed;
  std::optional<OperatingDiagram> diagram;  // none if a law over time drives or a speed is prescribed
  std::string no_diagram;                   // reason
  std::vector<SteadyCycle> cycles;          // of the requested models
  std::optional<StartRun> start;            // rigid, from rest to 95 % of the steady speed
  std::vector<RatioSearch> ratios;
  std::string later;  // it comes to rest in the end: why the motion of an earlier moment is shown; empty otherwise
};

// Default effects for cycles shown side by side: the scene's own effects, rigid and elastic, so that only elasticity
// differs. A scene without elasticity is also shown with all of it; one set if nothing is elastic. The rigid cycle
// has ideal joints, which is noted.
std::vector<Effects> effects_side_by_side(const Scene& scene);

// Finds the steady cycle of the scene with each set of effects. Throws SceneError if no machine can be made;
// std::invalid_argument with the reason if the question is incomplete: a family of cycles without --mean-speed,
// periods without common multiple, a mean speed for a machine driven by a law over time.
SteadyStudy steady(const Scene& scene, const std::vector<Effects>& effects, const SteadyOptions& options);

// "stable: the slowest deviation halves in 3.2 cycles"; neutral if it differs from 1 by no more than the error. `period`
// [cycles]: of the multipliers.
std::string stability_text(const std::vector<std::complex<double>>& multipliers, std::optional<double>* halving,
                           double error, int period = 1);

// Files: operating_points.csv, and steady.LABEL.csv per model with traces. The study must outlive the findings.
Findings findings_of(const SteadyStudy& study);

}  // namespace kurbel
