// result.h — results of a study for tables, JSON and reports: figures with units and measured errors.
#pragma once

#include <cmath>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/base/estimate.h"
#include "engine/run/recorders.h"
#include "studies/claims/claim.h"

namespace kurbel {

struct Traces;

// A figure; its error is measured by other runs (measured_errors.h).
struct Figure : Estimate {
  std::string name = {};                // dotted and stable: "peak_torque.main_coupling"
  std::string unit = {};                // SI
  std::optional<double> at = {};        // time it belongs to [s]
  double scale = 0;                     // rated quantity that the error is related to; 0: the error is not judged
  double resolution = 0;                // part of the error common to all runs: the uncertainty of event location
  std::optional<double> at_error = {};  // of the time, measured like the error of the value [s]
  bool exact = false;                   // by construction: a count, a prescribed speed
  QuantityKind what = {};               // its quantity
  std::string of = {};                  // its owner: the component; empty: the whole machine

  // Its name without its owner: "peak_torque".
  std::string_view words() const {
    return std::string_view(name).substr(0, name.size() - (of.empty() ? 0 : of.size() + 1));
  }
  // From a name with its words, quantity and owner.
  static Figure of_name(Name name, double value = 0, std::string unit = {}, double scale = 0) {
    Figure figure{{value}, std::move(name.text), std::move(unit), {}, scale};
    figure.what = name.what, figure.of = std::move(name.of);
    return figure;
  }
  // The same in the unit of its definition.
  static Figure defined(Name name, double value = 0, double scale = 0);
};

// Null: no figure of that name.
const Figure* find(const std::vector<Figure>& figures, std::string_view name);

// The value of a figure in a run: members as in Figure.
struct Found {
  double value = 0, scale = 0;
  std::optional<double> at = {};
  bool exact = false;
  double resolution = 0;
};

// Possible figures of a run are declared here, each in one place: to list them before a run, or with the values of
// the run.
class FigureReporter {
 public:
  // Adds to `figures`; `listing`: all figures, without values.
  explicit FigureReporter(std::vector<Figure>& figures, bool listing) : figures_(figures), listing_(listing) {}
  bool listing() const { return listing_; }
  // A figure already reported; null: none of that name.
  const Figure* find(std::string_view name) const { return kurbel::find(figures_, name); }
  // A figure made elsewhere, or in its own unit.
  Figure& take(Figure figure) { return figures_.emplace_back(std::move(figure)); }

  // find() → Found, or std::optional of it: empty if the run has no such figure. Not called when listing.
  template <class Find>
  void operator()(const QuantityKind& what, std::string of, const Find& find) {
    (*this)(Name::make(what, std::move(of)), find);
  }
  template <class Find>
  void operator()(const char* words, const std::string& of, const Find& find) {
    (*this)(Name::own(words, of), find);
  }
  template <class Find>
  void operator()(Name name, const Find& find) {
    std::optional<Found> found;
    if (!listing_) found = find();
    if (listing_ || found) add(std::move(name), found.value_or(Found{}));
  }

 private:
  void add(Name name, const Found& found);

  std::vector<Figure>& figures_;
  bool listing_;
};

struct ComponentState {
  Estimate angle, speed;                                   // of its (driving) shaft [rad, rad/s]
  std::optional<Estimate> angle_out = {}, speed_out = {};  // of its driven shaft, if it has two
};

// Run-up, steady motion and run-down of the reduction link; times in s. Defined in periods.h.
struct Periods {
  std::optional<double> run_up_end;                         // from here on within the range of the steady cycle
  std::optional<double> run_down_begin;                     // the last source was switched off
  std::optional<double> standstill;                         // at rest from here on
  double run_up_resolution = 0, standstill_resolution = 0;  // shift by errors of the size of the tolerance [s]
  double steady_speed = 0;                                  // of steady motion only [rad/s]
  bool steady = false;                                      // deviation from the limit of the mid speed < 0.1 %
  std::optional<double> remaining;                          // to the limit [rad/s]; empty: no limit is recognisable
  bool without_limit = false;  // the speed keeps changing, without slowing from cycle to cycle
  bool unsettled = false;      // it still changes, and whether it comes to a limit is not known
  double judged_until =
      HUGE_VAL;         // end of the last period of steady motion, else of the driven time; ∞: of the run [s]
  int cycles = 1;       // after which steady motion repeats, or periods of `time`
  double time = 0;      // [s]: what repeats are periods of the laws over time, not of the angle; 0: cycles
  std::string verdict;  // why steady or not, in words
};

struct EnergyBalance {
  std::map<std::string, double> by_line;     // driving, useful, harmful, weight [J]
  std::map<std::string, double> by_account;  // per component [J]
  double kinetic_start = 0, kinetic_end = 0, stored_start = 0, stored_end = 0, residual = 0, relative = 0;
  double reduction_residual = 0;  // kinetic energy of Simbody's bodies against that by I_r, relative
  double free_bodies = 0;         // torque of a joint from either of its sides (theory 5.18), relative difference
  int checks = 0;
};

struct Result {
  std::string title, label;  // label: "rigid", "elastic"
  std::string scene_file;
  bool complete = true;
  std::string diagnosis;  // of an incomplete run
  std::string effects;
  std::size_t coordinates = 0, states = 0;
  std::string explanation;  // what was merged and why
  double until = 0, accuracy = 0;
  double measured_accuracy = 0;  // largest error over its scale; 0 if errors are not measured
  std::string checkpoint;        // text of the final state, to continue from; if requested
  double begins_at = 0;          // [s]: > 0 if the run continues another one
  bool accuracy_confirmed = false, errors_measured = false;
  bool confirmation_asked = false;  // false with --no-error: then nothing had to be confirmed
  double tolerance = 0;
  int runs = 0;
  std::int64_t flow_calls = 0;  // evaluations of the right-hand side, of all runs
  std::vector<Figure> figures;
  std::map<std::string, ComponentState> final_state;
  std::vector<Event> events;
  // Errors of the events' times, by comparison of runs [s]: one for each event (match_events), empty if only one run
  // has it; none at all: not measured.
  std::vector<std::optional<double>> event_errors;
  Periods periods;
  std::vector<CycleRecord> cycles;  // those by which steadiness was judged: single cycles, or periods of time
  EnergyBalance energy;
  RunStatistics statistics;
  double cpu_total = 0;  // of all runs, errors included [s]
  std::vector<std::string> notes;
  Claims claims;  // from the motion itself: it stalls, runs away, slips to the end
  // For remedies of its verdicts (name_of_remedy) the value confirmed by computation: the machine holds with it, and
  // does not with one worse by 1 %; not finite: none was found.
  std::map<std::string, double> remedies_tried;
  std::shared_ptr<const TrajectoryRecorder> trajectory;  // null for a multibody run
  std::shared_ptr<const Traces> traces;                  // for plots; null unless requested
  std::shared_ptr<const Model> model;

  const Figure* find(std::string_view name) const { return kurbel::find(figures, name); }
  const Figure* find(const QuantityKind& what, const std::string& of) const;
  // Complete, but without the requested accuracy: its figures have the errors that were measured, if any.
  bool unconfirmed() const { return complete && confirmation_asked && !accuracy_confirmed; }
  // "accuracy 1e-06 requested, 3.1e-05 measured"
  std::string accuracy_in_words() const;
  // That, and what to try; empty: it is confirmed.
  std::string unconfirmed_in_words() const;
};

}  // namespace kurbel
