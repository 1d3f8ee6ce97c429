// simulate.cpp — the sequence of tolerances, the independent run, and the results of the confirmed run.
#include "studies/run/simulate.h"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <set>
#include <tuple>
#include <utility>

#include "engine/numerics/index.h"
#include "engine/return_map/periodicity.h"
#include "engine/rigid/work_equation.h"
#include "engine/run/checkpoint.h"
#include "engine/values/dense_tables.h"
#include "mechanisms/deforming/deforming_mechanism.h"
#include "mechanisms/reduced/mechanism.h"
#include "studies/answers/motion_claims.h"
#include "studies/duty/holding.h"
#include "studies/duty/motor_figures.h"
#include "studies/limits/ratings.h"
#include "studies/run/event_match.h"
#include "studies/run/figures.h"
#include "studies/run/measured_errors.h"
#include "studies/run/multibody.h"
#include "studies/run/run_findings.h"
#include "studies/validity/outside_data.h"
#include "studies/validity/static_curve.h"
#include "studies/validity/substitutes.h"

namespace kurbel {
namespace {

constexpr double timed_for = 0.1;          // all timings of a run together [s]
constexpr int energy_checks = 60;          // in a run; each evaluates the mechanism's bodies, which takes some 20 µs
constexpr int first_checks = 15;           // in a run that a finer one replaces
constexpr double least_tolerance = 2e-15;  // smaller ones exceed double precision
// Shortest last step of the sequence: errors decrease at least with the square root of the tolerance, so that the
// coarser run's are twice the finer's, and their difference still covers the finer's.
constexpr double least_step = 4;
// A finer run with fewer steps than this multiple of the coarser one's has much the same errors: at order 8 not 1/8.
constexpr double least_more_steps = 1.3;

class Simulation {
 public:
  Simulation(std::shared_ptr<const Model> model, const std::string& label, const SimulateOptions& options)
      : model_(std::move(model)), options_(options), settings_(model_->scene.run), equations_(model_, true) {
    if (options.accuracy) settings_.accuracy = *options.accuracy;
    if (options.until) settings_.until = *options.until;
    if (options.method) settings_.method = *options.method;
    if (options.budget) settings_.budget = std::min(settings_.budget, *options.budget);
    result_.label = label;
    if (!options.go_on_from.empty()) take_checkpoint(options.go_on_from);
    result_.confirmation_asked = options.measure_error;
  }

  // Tolerances are reduced until two runs agree within the accuracy and the finer one's energy balance closes within
  // it. Then a third, independent run must agree with it, too (README.md describes what that covers).
  Result run() {
    log(fmt::format("{}: {} coordinates, {} states; effects: {}; {:.6g} s to simulate", result_.label,
                    model_->free_shafts + model_->twist_count() + further_coordinates(*model_), model_->state_count(),
                    model_->effects.describe(), settings_.until));
    if (!checkpoint_) equations_.snapshot(0, equations_.start(0));  // a place where the machine cannot stand is refused
    if (!options_.chosen_because.empty()) result_.notes.push_back(options_.chosen_because);
    tolerance_ = options_.first_tolerance.value_or(std::max(settings_.accuracy, 1e-12) / 10);
    fine_ = one_run(tolerance_);
    if (options_.measure_error && fine_->outcome.complete) {
      confirm();
      note_interrupt();
      state_errors();
      if (result_.errors_measured && model_->has_continuous_shafts() && !interrupted()) add_errors_of_shafts();
    }
    if (options_.timed && fine_->outcome.complete) time_again();
    fill(*fine_, tolerance_);
    return std::move(result_);
  }

 private:
  // The continued run is judged on its own: figures, works and peaks begin here.
  void take_checkpoint(const std::string& text) {
    checkpoint_ = checkpoint_from(text, equations_);
    checkpoint_->integrals.clear(), checkpoint_->observers.clear();
    result_.begins_at = checkpoint_->state.t;
    if (settings_.until <= checkpoint_->state.t)
      throw UnfitCheckpoint(fmt::format("is of {:.9g} s, and the run ends at {:.9g} s; let it run on with --until",
                                        checkpoint_->state.t, settings_.until));
    result_.notes.push_back(
        fmt::format("continues from a state at {:.9g} s: figures are of the motion after it", checkpoint_->state.t));
  }

  void log(const std::string& text) const { options_.watch.say(text); }
  // Work and edges over the angle, made once for all runs of the sequence.
  std::shared_ptr<WorkTables> work_tables() {
    const bool asked = settings_.method == "auto" || settings_.method == "work";
    if (result_.runs == 0 && asked && WorkTables::refusal(model_).empty())
      work_tables_ = std::make_shared<WorkTables>(model_);
    return work_tables_;
  }

  // Two runs of the sequence and an independent one; whichever is too coarse for the accuracy is repeated with a
  // smaller tolerance.
  void confirm() {
    while (!ladder_agrees() && tighten()) {
    }
    // At first not smaller than usually sufficient: a method of low order may have needed a far smaller one than another.
    if (interrupted() || !run_elsewhere(std::max(tolerance_, settings_.accuracy / 10 / tolerance_step))) return;
    if (coarse_is_alike() && !interrupted()) tighten_elsewhere();
    while (!confirmed() && !interrupted()) {
      const bool blame_elsewhere = error_by(nullptr, elsewhere_.get()) > error_by(coarse_.get(), nullptr);
      const bool went_on =
          blame_elsewhere || ladder_ended() ? tighten_elsewhere() || tighten() : tighten() || tighten_elsewhere();
      if (!went_on) return;
    }
  }
  bool ladder_agrees() const {
    return coarse_ && error_by(coarse_.get(), nullptr) <= settings_.accuracy &&
           fine_->energy->closes(settings_.accuracy);
  }
  bool confirmed() const {
    return coarse_ && elsewhere_ && error_by(coarse_.get(), elsewhere_.get()) <= settings_.accuracy &&
           fine_->energy->closes(settings_.accuracy);
  }
  bool interrupted() const { return options_.watch.stopped(); }
  // Where edges, turns or stability end the steps, the tolerance hardly changes them, and the difference of two runs does
  // not show their errors; that to an independent run does, if its own are known to be smaller: by a coarser one like it.
  bool coarse_is_alike() const {
    const auto steps = [](const OneRun& run) { return static_cast<double>(run.outcome.statistics.stepper.steps); };
    return coarse_ && steps(*fine_) < least_more_steps * steps(*coarse_);
  }

  static constexpr double weight_of_elsewhere = 2, weight_of_coarse_elsewhere = 0.4;  // measured_errors.h says why
  // These runs with their weights, as far as they were made; a coarser independent one goes with the independent one.
  std::vector<std::pair<const OneRun*, double>> weighted(const OneRun* coarse, const OneRun* elsewhere) const {
    std::vector<std::pair<const OneRun*, double>> list;
    if (coarse) list.emplace_back(coarse, weight_of_coarse_);
    if (elsewhere) list.emplace_back(elsewhere, weight_of_elsewhere);
    if (elsewhere && coarse_elsewhere_) list.emplace_back(coarse_elsewhere_.get(), weight_of_coarse_elsewhere);
    return list;
  }
  std::vector<Witness> witnesses(const OneRun* coarse, const OneRun* elsewhere,
                                 std::vector<Figure> OneRun::*what = &OneRun::figures) const {
    std::vector<Witness> list;
    for (const auto& [run, weight] : weighted(coarse, elsewhere)) list.push_back({&(run->*what), weight});
    return list;
  }
  // Largest error over its scale in the figures, by these runs.
  double error_by(const OneRun* coarse, const OneRun* elsewhere) const {
    std::vector<Figure> figures = fine_->figures;
    return measure_errors(figures, witnesses(coarse, elsewhere)).largest;
  }
  // The next tolerance of a sequence; the last step may be shorter, or there is none.
  static double tighter(double tolerance) { return std::max(tolerance / tolerance_step, least_tolerance); }
  static bool can_be_tightened(double tolerance) { return tighter(tolerance) <= tolerance / least_step; }
  bool ladder_ended() const { return ladder_failed_ || !can_be_tightened(tolerance_); }

  // The next run of the sequence. False at its end: the run before it is used.
  bool tighten() {
    if (ladder_ended()) return false;
    const double before = std::exchange(tolerance_, tighter(tolerance_));
    std::unique_ptr<OneRun> finer = one_run(tolerance_);
    if (!finer->outcome.complete) {
      tolerance_ = before;
      ladder_failed_ = true;
      unconfirmed_ = fmt::format("the confirming run failed ({})", finer->outcome.diagnosis);
      return false;
    }
    coarse_ = std::move(fine_);
    fine_ = std::move(finer);
    log(fmt::format("  tolerances {:.0e} and {:.0e} agree within {:.1e}, energy within {:.1e}; {:.1e} requested",
                    before, tolerance_, error_by(coarse_.get(), nullptr), fine_->energy->relative(),
                    settings_.accuracy));
    return true;
  }

  bool end_elsewhere(const std::string& what, const std::string& why) {
    unconfirmed_ = fmt::format("{} failed ({})", what, why);
    return !(elsewhere_ended_ = true);
  }

  // By another method, with other step ends and other table lookups. False if it failed: the run before it is used.
  bool run_elsewhere(double tolerance) {
    try {
      equations_elsewhere();
    } catch (const std::runtime_error& why) {
      return end_elsewhere("Simbody, whose tables should confirm the figures,", why.what());
    }
    std::unique_ptr<OneRun> other = one_run(tolerance, true);
    if (settings_.method == "esdirk5" && !stiff_ && other->outcome.statistics.method != name_of(Method::verner_65)) {
      stiff_ = true;  // "auto" turned to the implicit method that it should confirm
      other = one_run(tolerance, true);
    }
    if (!other->outcome.complete)
      return end_elsewhere("the run by another method that should confirm the figures", other->outcome.diagnosis);
    // At the end of the sequence no finer run shows the error of its last run, and the one before it shows only its
    // own coarseness: two independent runs, one with a smaller tolerance, show more.
    if (elsewhere_ && ladder_ended()) {
      coarse_ = std::move(elsewhere_);
      weight_of_coarse_ = weight_of_elsewhere;
    } else {
      coarse_elsewhere_ = std::move(elsewhere_);
    }
    elsewhere_ = std::move(other);
    elsewhere_tolerance_ = tolerance;
    log(fmt::format("  {} from elsewhere with {:.0e} agrees within {:.1e}", elsewhere_->outcome.statistics.method,
                    tolerance, error_by(nullptr, elsewhere_.get())));
    return true;
  }
  bool tighten_elsewhere() {
    return !elsewhere_ended_ && can_be_tightened(elsewhere_tolerance_) && run_elsewhere(tighter(elsewhere_tolerance_));
  }

  // Below 0.3 s three runs are timed, of milliseconds up to nine: other load only increases times, so the least counts.
  void time_again() {
    double &least = fine_->outcome.statistics.cpu_seconds, spent = least;
    const auto reported = std::tuple(result_.runs, result_.cpu_total, result_.flow_calls);
    for (int i = 0; i < 8 && (i < 2 ? least < 0.3 : spent < timed_for) && !interrupted(); ++i) {
      const RunOutcome again = std::move(one_run(tolerance_)->outcome);
      if (again.complete) spent += again.statistics.cpu_seconds, least = std::min(least, again.statistics.cpu_seconds);
    }
    std::tie(result_.runs, result_.cpu_total, result_.flow_calls) = reported;
  }

  void note_interrupt() {
    if (!interrupted() || confirmed()) return;
    if (unconfirmed_.empty()) unconfirmed_ = "interrupted before all runs were made";
    fine_->outcome.complete = false;
    fine_->outcome.diagnosis =
        "interrupted in a run that measures the errors; the figures are whole, but their errors are not";
  }

  // Errors of all figures by all runs that were made.
  void state_errors() {
    if (!coarse_ && !elsewhere_) {
      result_.notes.push_back(unconfirmed_ + "; figures are without errors");
      return;
    }
    const auto [of_figures, hidden] = measure_errors(fine_->figures, witnesses(coarse_.get(), elsewhere_.get()));
    const double of_energy = fine_->energy->largest(settings_.accuracy);
    measure_errors(fine_->last_state, witnesses(coarse_.get(), elsewhere_.get(), &OneRun::last_state));
    const double tables = left_by_tables(model_->scene);
    for (std::vector<Figure>* figures : {&fine_->figures, &fine_->last_state})
      for (Figure& f : *figures)
        if (f.error && !f.exact) *f.error += tables * std::max(std::abs(f.value), f.scale);
    for (const auto& [witness, weight] : weighted(coarse_.get(), elsewhere_.get()))
      add_event_errors(fine_->outcome.events, witness->outcome.events, weight, hidden * settings_.until,
                       result_.event_errors);
    for (std::size_t k = 0; k < result_.event_errors.size(); ++k)
      if (std::optional<double>& error = result_.event_errors[k]) *error += tables * fine_->outcome.events[k].t;
    result_.measured_accuracy = std::max(of_figures, of_energy);
    result_.errors_measured = true;
    result_.accuracy_confirmed = confirmed();
    log(fmt::format("  errors of up to {:.1e}; {:.1e} requested: {}", result_.measured_accuracy, settings_.accuracy,
                    result_.accuracy_confirmed ? "reached" : "not reached"));
    if (!result_.accuracy_confirmed) note_unconfirmed(of_energy);
  }
  void note_unconfirmed(double of_energy) {
    if (coarse_ && elsewhere_)
      result_.notes.push_back(
          fmt::format("accuracy {:.1e} requested, {:.1e} reached{}", settings_.accuracy, result_.measured_accuracy,
                      result_.measured_accuracy == of_energy ? fine_->energy->where(of_energy) : ""));
    result_.notes.push_back(unconfirmed_.empty() ? "the tolerances cannot be tightened further"
                            : !elsewhere_        ? unconfirmed_ + "; errors are by the run before it"
                            : !coarse_           ? unconfirmed_ + "; errors are by a run by another method"
                                                 : unconfirmed_);
  }

  void add_errors_of_shafts() {
    double change = 0;
    std::string why = "nothing computes the machine cut finer from where this run begins";
    if (const auto finer = checkpoint_ ? nullptr : with_finer_shafts(*model_)) {
      Equations equations(finer, true);
      const std::unique_ptr<OneRun> run = one_run(std::max(tolerance_, settings_.accuracy / 10), equations);
      why = run->outcome.diagnosis;
      if (run->outcome.complete)
        change = add_shaft_errors(fine_->figures, fine_->last_state, run->figures, run->last_state), why.clear();
    }
    for (auto& note : shaft_error_notes(change, settings_.accuracy, why)) result_.notes.push_back(note);
  }

  std::unique_ptr<OneRun> one_run(double tolerance, bool elsewhere = false) {
    return one_run(tolerance, elsewhere ? equations_elsewhere() : equations_, elsewhere);
  }
  // Looks closely where the speed passes the levels requested in the last run; everywhere, should others be requested.
  std::unique_ptr<OneRun> one_run(double tolerance, Equations& equations, bool elsewhere = false) {
    std::unique_ptr<OneRun> run = one_run(tolerance, equations, elsewhere, fine_ ? fine_->speed.get() : nullptr);
    return run->speed->answered() ? std::move(run) : one_run(tolerance, equations, elsewhere, nullptr);
  }
  std::unique_ptr<OneRun> one_run(double tolerance, Equations& equations, bool elsewhere, const SpeedRecorder* before) {
    const Model& model = equations.model();
    auto run = std::make_unique<OneRun>();
    const bool will_be_confirmed = options_.measure_error && !fine_;  // a finer run follows, whose balance counts
    const int rows = elsewhere ? 0 : settings_.samples;               // a witness gives figures alone
    run->trajectory = std::make_shared<TrajectoryRecorder>(channels_of(model, settings_.output), settings_.until, rows);
    std::vector<ExtremeOf> extremes = extremes_of(model);
    for (const auto more : {motor_extremes_of, rim_speeds_of, shaft_torques_of, held_torques_of})
      for (ExtremeOf& extreme : more(model)) extremes.push_back(std::move(extreme));
    run->extremes = std::make_unique<ExtremeRecorder>(std::move(extremes));
    if (rows > 0) run->extremes->take_rows_of(run->trajectory->channels());
    run->heat = heat_recorder_of(model);
    run->slips = std::make_unique<SlipRecorder>(model);
    run->link = std::make_unique<LinkRecorder>(model, settings_.until);
    run->falls = std::make_unique<FlywheelFalls>(model);
    run->currents = std::make_unique<MotorCurrents>(model);
    run->ranges = std::make_unique<DataRangeRecorder>(model);
    run->speed = std::make_unique<SpeedRecorder>(settings_.until, before);
    run->energy = std::make_unique<EnergyAudit>(settings_.until, elsewhere           ? 2
                                                                 : will_be_confirmed ? first_checks
                                                                                     : energy_checks);
    RunOptions options{.tolerance = tolerance,
                       .method = elsewhere ? confirming_method() : settings_.method,
                       .until = settings_.until,
                       .budget = settings_.budget,
                       .interrupted = options_.watch.interrupted,
                       .progress = {},
                       .work_tables = work_tables(),
                       .checkpoint = checkpoint_ ? &*checkpoint_ : nullptr,
                       .to_go_on = options_.keep_state,
                       .accuracy = settings_.accuracy,
                       .elsewhere = elsewhere};
    if (options_.watch.progress)
      options.progress = [&](double fraction) {
        options_.watch.progress(fmt::format("{} (tolerance {:.0e})", result_.label, tolerance), fraction);
      };
    std::vector<Observer*> observers = {run->trajectory.get(), run->extremes.get(), &run->cycles,
                                        run->speed.get(),      run->energy.get(),   run->ranges.get(),
                                        run->slips.get(),      run->link.get(),     &run->switchings};
    if (const double clock = clock_of(model); clock > 0)
      observers.push_back(&(run->by_time = CycleRecorder(clock, clock == least_repetition(model.scene.sequence))));
    if (!run->falls->empty()) observers.push_back(run->falls.get());
    if (!run->currents->empty()) observers.push_back(run->currents.get());
    if (run->heat) observers.push_back(run->heat.get());
    if (!model.scene.figures.empty())
      observers.push_back((run->asked = std::make_unique<AskedRecorder>(model, &run->cycles, &run->by_time)).get());
    // Plots need only the first tolerance, and the timed runs remain without them.
    if (options_.traces && !traces_) observers.push_back((traces_ = std::make_unique<TraceRecorder>(*model_)).get());
    run->outcome = integrate(equations, options, observers);
    result_.cpu_total += run->outcome.statistics.cpu_seconds;
    result_.flow_calls += run->outcome.statistics.stepper.flow_calls;
    if (!run->outcome.state.empty()) collect_figures(model, equations, tolerance, *run);
    const RunStatistics& s = run->outcome.statistics;
    log(fmt::format("  {} with tolerance {:.0e}: {} steps, {} rejected, {} events, {:.3g} ms{}", s.method, tolerance,
                    s.stepper.steps, s.stepper.rejected, s.events, 1e3 * s.cpu_seconds,
                    run->outcome.complete ? "" : "; " + run->outcome.diagnosis));
    if (result_.runs++ == 0) log(fmt::format("  chosen because: {}", s.reason));
    return run;
  }

  // Another method of similar cost for the same figures: another order, another family, or time instead of angle.
  std::string confirming_method() const {
    const std::string& asked = settings_.method;
    // What dop853 and fehlberg8 miss at long steps, both of order 8, they miss alike.
    if (asked == "dop853" || asked == "fehlberg8") return "verner6";
    if (asked == "esdirk5" && stiff_) return "esdirk";
    if (asked == "dopri5" || asked == "verner6" || asked == "adams") return "dop853";
    // Verner's method, and esdirk5 where the machine is stiff: the work equation has the steps of dop853 near rest and
    // between edges, implicit methods interpolate alike within their steps.
    return "auto";
  }

  // The same machine with its mechanisms extracted anew, if they use tables and are described by the scene.
  std::shared_ptr<const Model> model_elsewhere() const {
    if (!has_tables(model_->network) || model_->scene.components.empty()) return model_;
    auto other = compile_network(extracted_from(build_network(model_->scene), Extraction::second), model_->scene,
                                 model_->effects);
    const bool same_machine = other->network.components == model_->network.components &&
                              other->state_count() == model_->state_count();  // else made by hand, not of the scene
    return same_machine ? other : model_;
  }
  Equations& equations_elsewhere() {
    if (!equations_elsewhere_) {
      equations_elsewhere_.emplace(model_elsewhere(), true);
      equations_elsewhere_->keep_angles_from(1);
    }
    return *equations_elsewhere_;
  }

  void fill(OneRun& run, double tolerance) {
    const Model& m = *model_;
    result_.title = m.scene.heading();
    result_.scene_file = m.scene.file;
    result_.complete = run.outcome.complete, result_.diagnosis = run.outcome.diagnosis;
    result_.effects = m.effects.describe();
    result_.coordinates = m.free_shafts + m.twist_count() + further_coordinates(m);
    result_.states = m.state_count();
    result_.explanation = m.explain();
    result_.until = settings_.until, result_.accuracy = settings_.accuracy;
    result_.tolerance = tolerance;
    result_.figures = std::move(run.figures);
    result_.events = run.outcome.events;
    const Periods& periods = result_.periods = run.periods;
    if (traces_) result_.traces = traces_->traces(periods.time > 0 ? 1 : periods.cycles, periods.judged_until);
    result_.cycles = (run.periods.time > 0 ? run.by_time : run.cycles).cycles();
    result_.statistics = run.outcome.statistics;
    result_.statistics.limits = limits_of(run.outcome, equations_);
    run.trajectory->add_peaks(run.extremes->rows());
    result_.trajectory = run.trajectory;
    result_.model = model_;
    result_.energy = energy_balance(m, *run.energy);
    result_.final_state = final_state(m, run.last_state);
    run.outcome.checkpoint.observers.clear();  // whoever goes on is judged on its own
    if (options_.keep_state && run.outcome.complete) result_.checkpoint = text_of(run.outcome.checkpoint, equations_);
    if (const std::string words = checkpoint_ ? "" : words_of_balance(equations_, run.outcome); !words.empty())
      result_.notes.push_back(words);
    for (const std::string& what : run.outcome.held) result_.notes.push_back(what);
    if (!checkpoint_ && run.outcome.complete) result_.claims = start_claims(model_);
    drop_errors_after_unstable_start(result_);  // before they report which claims are sure
    for (Claim& claim :
         motion_claims(equations_, run.outcome, result_, *run.slips, *run.link, options_.watch, settings_.budget))
      result_.claims.push_back(std::move(claim));
    drop_errors_after_unstable_start(result_);
    report_outside_data(*run.ranges, result_);
    for (std::string& note : regularised(run.outcome.regularised)) result_.notes.push_back(std::move(note));
    for (auto* of : {&notes_on_arcs, &substitutes, &idle_effects})
      for (std::string& note : (*of)(m)) result_.notes.push_back(std::move(note));
    for (std::string& note : figures_not_given(m, result_.figures)) result_.notes.push_back(std::move(note));
    if (std::string note = coarse_rows_note(*run.trajectory, run.outcome.statistics.stepper.steps); !note.empty())
      result_.notes.push_back(std::move(note));
    for (std::string& note : static_curve_notes(m, *run.trajectory)) result_.notes.push_back(std::move(note));
  }

  std::shared_ptr<const Model> model_;
  const SimulateOptions& options_;
  RunSettings settings_;
  Equations equations_;
  std::optional<Equations> equations_elsewhere_;
  std::optional<Checkpoint> checkpoint_;  // where it goes on from
  std::shared_ptr<WorkTables> work_tables_;
  std::unique_ptr<TraceRecorder> traces_;              // of the first run
  std::unique_ptr<OneRun> fine_, coarse_, elsewhere_;  // the run whose figures count, and its witnesses
  std::unique_ptr<OneRun> coarse_elsewhere_;           // the independent one before it, with a larger tolerance
  double tolerance_ = 0, elsewhere_tolerance_ = 0, weight_of_coarse_ = 1;  // measured_errors.h
  bool ladder_failed_ = false, elsewhere_ended_ = false;                   // a tighter run of theirs failed
  bool stiff_ = false;                                                     // "auto" takes implicit steps
  std::string unconfirmed_;                                                // why that was
  Result result_;
};

}  // namespace

Result simulate(std::shared_ptr<const Model> model, const std::string& label, const SimulateOptions& options) {
  if (model->scene.run.model == "multibody") return simulate_multibody(std::move(model), label, options);
  return Simulation(std::move(model), label, options).run();
}

Result simulate(const Scene& scene, const Effects& effects, const std::string& label, const SimulateOptions& options) {
  return simulate(compile(scene, effects), label, options);
}

}  // namespace kurbel
