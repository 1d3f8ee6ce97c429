// accuracy_work.h — data shared by the parts of the accuracy study: levels in progress, measured settings, and time.
#pragma once

#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "engine/numerics/deadline.h"
#include "engine/numerics/index.h"
#include "engine/rigid/work_equation.h"
#include "studies/accuracy/accuracy.h"
#include "studies/run/simulate.h"

namespace kurbel {

inline constexpr double not_known = std::numeric_limits<double>::quiet_NaN();
inline constexpr double reference_tolerance = 1e-13;

// A level in progress.
struct LevelAtWork {
  ModelLevel reported;
  std::shared_ptr<const Model> model;
  std::shared_ptr<WorkTables> tables;   // null: the work equation does not apply
  Result reference;                     // of the first method
  double end_angle = 0, end_speed = 0;  // of the reduction link
  bool between = false;                 // intermediate level: only error and time needed, by the reference's methods
};

struct AccuracyWork {
  AccuracyWork(const Scene& of, const AccuracyOptions& asked);

  bool interrupted() const { return options.watch.stopped(); }
  double spent() const { return processor_time() - begin; }
  void log(const std::string& text) const;
  void progress(const std::string& what, double fraction) const;
  void omit(const std::string& what, const std::string& why);
  SimulateOptions simulate_options(const std::string& method, double tolerance) const;

  Scene scene;
  const AccuracyOptions& options;
  std::vector<LevelAtWork> levels;
  AccuracyStudy study;
  std::string last_diagnosis;  // of a reference that failed
  double begin = 0;            // processor time [s]
};

// Name of the reduction link.
std::string link_of(const Model& model);

// Largest difference of angles [rad], and of speeds and twists over the largest that they reach.
double trajectory_difference(const TrajectoryRecorder& a, const TrajectoryRecorder& reference);

// Median and spread of repeated runs [s].
void set_times(MeasuredSetting& s, std::vector<double> seconds);

// Ratio of the time to that of the cheapest measured setting of the same level with errors of the motion and the key
// figure that are not larger; 0: there is none.
double times_beaten(const AccuracyStudy& study, const MeasuredSetting& s, double seconds);
// A method slower by this factor at this many successive tolerances is abandoned, which is reported.
inline constexpr int hopeless = 2, hopeless_rungs = 2;
void give_up(AccuracyWork& work, const std::string& level, const std::string& method, double tolerance);

// accuracy_levels.cpp: the series of models, each with its reference by two methods. A level without a reference is omitted.
void make_levels(AccuracyWork& work);

// followed_figures.cpp: the figures whose errors are reported, and these errors. `value` yields a figure by its name.
void follow_figures(AccuracyWork& work);
void measure_figures(MeasuredSetting& s, const AccuracyWork& work, const LevelAtWork& level,
                     const std::function<double(const std::string&)>& value);
void fill_model_errors(AccuracyStudy& study);

// accuracy_ladder.cpp: every method at every tolerance on every level.
void climb_ladder(AccuracyWork& work);

// own_solvers.cpp: levels with solvers of their own, which yield the motion of the link alone.
void add_energy_method(AccuracyWork& work);
void add_multibody(AccuracyWork& work);

}  // namespace kurbel
