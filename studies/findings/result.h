// result.h — what a study hands to tables, JSON and reports: figures with units and measured errors.
#pragma once

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

// Its error is measured by other runs (measured_errors.h).
struct Figure : Estimate {
  std::string name = {};                // dotted and stable: "peak_torque.main_coupling"
  std::string unit = {};                // SI
  std::optional<double> at = {};        // time it belongs to [s]
  double scale = 0;                     // rated quantity that the error is judged by; 0: the error is not judged
  double resolution = 0;                // part of the error that all runs share: what location leaves open
  std::optional<double> at_error = {};  // of the time, measured as the error of the value is [s]
  bool exact = false;                   // by construction: a count, a speed that is given or held
  QuantityKind what = {};               // what it tells of
  std::string of = {};                  // and of whom: the component; empty: of the whole machine

  // Its name without its owner: "peak_torque".
  std::string_view words() const {
    return std::string_view(name).substr(0, name.size() - (of.empty() ? 0 : of.size() + 1));
  }
  // Of a name: its words, its quantity and its owner.
  static Figure of_name(Name name, double value = 0, std::string unit = {}, double scale = 0) {
    Figure figure{{value}, std::move(name.text), std::move(unit), {}, scale};
    figure.what = name.what, figure.of = std::move(name.of);
    return figure;
  }
  // The same in the unit that its definition has.
  static Figure defined(Name name, double value = 0, double scale = 0);
};

// Null: none of that name.
const Figure* find(const std::vector<Figure>& figures, std::string_view name);

// What a run finds of a figure: members as those of Figure.
struct Found {
  double value = 0, scale = 0;
  std::optional<double> at = {};
  bool exact = false;
  double resolution = 0;
};

// Figures that a run may have are told here, each in one place: to list them before there is a run, or with what the run
// found.
class FigureTeller {
 public:
  // Adds to `figures`; `listing`: all of them, without values.
  explicit FigureTeller(std::vector<Figure>& figures, bool listing) : figures_(figures), listing_(listing) {}
  bool listing() const { return listing_; }
  // What is told already; null: nothing under that name.
  const Figure* find(std::string_view name) const { return kurbel::find(figures_, name); }
  // A figure that is made elsewhere, or in a unit of its own.
  Figure& take(Figure figure) { return figures_.emplace_back(std::move(figure)); }

  // find() → Found, or std::optional of it: none, this run has no such figure. For a list it is not called.
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
  std::optional<Estimate> angle_out = {}, speed_out = {};  // of its driven shaft, where it has two
};

// Run-up, steady motion and run-down of the reduction link; times in s. Defined in periods.h.
struct Periods {
  std::optional<double> run_up_end;                         // from here on within the range of the steady cycle, ± 1 %
  std::optional<double> run_down_begin;                     // the last source went off
  std::optional<double> standstill;                         // came to rest
  double run_up_resolution = 0, standstill_resolution = 0;  // how far errors as small as the tolerance move them [s]
  double steady_speed = 0;                                  // of steady motion only [rad/s]
  bool steady = false;                                      // what remains to the mid speed's limit is below 0.1 %
  std::optional<double> remaining;                          // to the limit [rad/s]; nothing: none is in sight
  bool without_limit = false;  // the speed goes on changing, by no less from cycle to cycle
  std::string verdict;         // why steady, or why not, in words
};

struct EnergyBalance {
  std::map<std::string, double> by_line;     // driving, useful, harmful, weight [J]
  std::map<std::string, double> by_account;  // per component [J]
  double kinetic_start = 0, kinetic_end = 0, stored_start = 0, stored_end = 0, residual = 0, relative = 0;
  double reduction_residual = 0;  // kinetic energy of Simbody's bodies against that from I_r, relative
  double free_bodies = 0;         // torque of a joint by its one side against that by its other (theory 5.18), relative
  int checks = 0;
};

struct Result {
  std::string title, label;  // label: "rigid", "elastic"
  std::string scene_file;
  bool complete = true;
  std::string diagnosis;  // of an incomplete run
  std::string effects;
  std::size_t coordinates = 0, states = 0;
  std::string explanation;  // what was merged, and why
  double until = 0, accuracy = 0;
  double measured_accuracy = 0;  // largest error over its scale; 0 with errors not measured
  std::string checkpoint;        // text of the state at the end, to go on from; where it was asked for
  double begins_at = 0;          // [s]: later than 0 where a run goes on from another one's end
  bool accuracy_confirmed = false, errors_measured = false;
  bool confirmation_asked = false;  // not with --no-error: then nothing was to be confirmed
  double tolerance = 0;
  int runs = 0;
  std::int64_t flow_calls = 0;  // evaluations of the right-hand side, of all runs
  std::vector<Figure> figures;
  std::map<std::string, ComponentState> final_state;
  std::vector<Event> events;
  // Of the events' times, by comparison of runs [s]: one for each event (match_events), nothing where only one run has
  // it; none at all: not measured.
  std::vector<std::optional<double>> event_errors;
  Periods periods;
  std::vector<CycleRecord> cycles;
  EnergyBalance energy;
  RunStatistics statistics;
  double cpu_total = 0;  // of all runs, errors included [s]
  std::vector<std::string> notes;
  Claims claims;  // that the motion itself gives: it stalls, runs away, slips to the end
  // Of remedies of its verdicts (name_of_remedy) the value with which the machine was computed and holds, and with one worse
  // by 1 % does not; not finite: none was found.
  std::map<std::string, double> remedies_tried;
  std::shared_ptr<const TrajectoryRecorder> trajectory;  // null for a multibody run
  std::shared_ptr<const Traces> traces;                  // for plots; null unless asked for
  std::shared_ptr<const Model> model;

  const Figure* find(std::string_view name) const { return kurbel::find(figures, name); }
  const Figure* find(const QuantityKind& what, const std::string& of) const;
  // Ran to the end, but not to the accuracy asked for: its figures stand with the errors that were measured, if any.
  bool unconfirmed() const { return complete && confirmation_asked && !accuracy_confirmed; }
  // "accuracy 1e-06 was asked for, 3.1e-05 measured"
  std::string accuracy_in_words() const;
};

}  // namespace kurbel
