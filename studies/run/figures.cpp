// figures.cpp — the figures of one run.
#include "studies/run/figures.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "drivetrain/shared/rating_keys.h"
#include "engine/numerics/index.h"
#include "mechanisms/deforming/deforming_mechanism.h"
#include "mechanisms/reduced/mechanism.h"
#include "studies/duty/holding.h"
#include "studies/duty/motor_figures.h"
#include "studies/duty/stopping.h"
#include "studies/limits/ratings.h"
#include "studies/run/measured_errors.h"
#include "studies/run/simulate.h"

namespace kurbel {
namespace {

// Mechanisms whose joints have clearance.
std::vector<std::string> components_with_impacts(const Model& model) {
  std::vector<std::string> names;
  for (const Network::ShaftElement& e : model.network.elements)
    if (const SliderCrankDynamics* dynamics = dynamics_of(e); dynamics && !dynamics->clearances().empty())
      names.push_back(e.component);
  return names;
}

// The mechanism whose output an account's load acts on; empty: it is no load of a mechanism.
std::string mechanism_loaded_by(const WorkAccount& account) {
  const std::string end = ".load";
  if (account.kind != Account::useful || !account.name.ends_with(end)) return {};
  return account.name.substr(0, account.name.size() - end.size());
}

// For each compressor λ, the intake fraction of its stroke. It has the name of its mechanism, or of its load if a
// mechanism has several.
struct Intake {
  std::string name;
  double efficiency = 0;
};
std::vector<Intake> intakes_of(const Model& model) {
  std::vector<Intake> list;
  for (const Network::ShaftElement& e : model.network.elements) {
    const MechanismElement* element = mechanism_of(e);
    if (!element) continue;
    const std::size_t before = list.size();
    for (const SliderLoad& load : element->mechanism().loads)
      if (const auto* compressor = std::get_if<CompressorForce>(&load.law))
        list.push_back({load.name, compressor->volumetric_efficiency()});
    if (list.size() == before + 1) list.back().name = element->mechanism().name;
  }
  return list;
}

// Angle and speed of a node's shaft, as they are at the end.
Found angle_of(const Model& m, const Snapshot& s, int node) {
  return {s.node_angle[node], std::max(1.0, m.scale_ratio[at(node)])};
}
Found speed_of(const Equations& equations, const Snapshot& s, int node) {
  const Model& m = equations.model();
  const std::size_t shaft = at(m.shaft_of_node[at(node)]);
  return {.value = m.gain_of_node[at(node)] * s.now.speed[shaft],
          .scale = m.speed_scale * m.scale_ratio[at(node)],
          .exact = shaft >= m.free_shafts || equations.at_standstill(shaft)};
}

// Figures of a run, or all that a run of the model may yield.
class RunFigures {
 public:
  RunFigures(const Model& model, Equations& equations, OneRun& run, double tolerance)
      : model_(model), report_(run.figures, false), run_(&run), equations_(&equations), tolerance_(tolerance) {}
  RunFigures(const Model& model, std::vector<Figure>& list) : model_(model), report_(list, true) {}

  void collect() {
    const LinkHistory link{begin(),      run_->cycles.cycles(), run_->by_time.cycles(),
                           *run_->speed, run_->outcome,         run_->switchings.switchings()};
    const Periods& p = run_->periods = find_periods(model_, link, tolerance_);
    cycles_ = in_periods(p.time > 0 ? link.by_time : link.cycles, p.cycles, p.cycles > 1 ? p.judged_until : HUGE_VAL);
    find_last_cycle();
    add_extremes();
    add_rms();
    add_final();
    add_cycle();
    add_flywheels();
    add_efficiency();
    add_periods();
    add_work();
    add_heat();
    add_stopping();
    add_impacts();
    add_motors();
    add_works_of_periods();
    add_ratings();
    FlywheelFalls::report(model_, run_->falls.get(), energy_scale(), report_);
    report_reserves(model_, report_);
    add_slipped_angles();
    if (run_->asked) run_->asked->report(last_, periods_of_run(), report_);
  }
  // In a separate order.
  void list() {
    list(extremes_of(model_));
    add_rms();
    add_final();
    add_impacts();
    add_cycle();
    add_efficiency();
    add_flywheels();
    add_periods();
    add_work();
    add_heat();
    list(motor_extremes_of(model_));
    list_motors(model_, report_);
    report_works(model_, {}, report_);
    FlywheelFalls::report(model_, nullptr, 0, report_);
    list(held_torques_of(model_));
    report_reserves(model_, report_);
    add_slipped_angles();
    for (std::vector<Figure> of_limits : {rating_figure_list(model_), watched_figure_list(model_)})
      for (Figure& f : of_limits)
        if (!report_.find(f.name)) report_.take(std::move(f));
    if (!model_.scene.sequence.steps.empty()) add_stopping();  // of a signal that makes the link stop
    for (AskedFigure& asked : asked_figures(model_))
      if (!report_.find(asked.figure.name)) report_.take(std::move(asked.figure));
  }

 private:
  std::vector<PeriodOfRun> periods_of_run() const {
    const Periods& p = run_->periods;
    const auto open = [&](double t) {
      return t == p.run_up_end ? p.run_up_resolution : t == p.standstill ? p.standstill_resolution : 0;
    };
    std::vector<PeriodOfRun> list;
    for (const WorkPeriod& period : three_periods(p, begin(), run_->outcome.t))
      list.push_back({period.window, period.begin, period.end, open(period.begin), open(period.end)});
    return list;
  }
  std::string link() const { return model_.network.nodes[at(model_.reduction_node)].component; }

  void add_extremes() {
    for (std::size_t i = 0; i < run_->extremes->wanted().size(); ++i) {
      const ExtremeOf& wanted = run_->extremes->wanted()[i];
      const ExtremeRecorder::Found& found = run_->extremes->found()[i];
      if (!found.any) continue;
      const double usual = wanted.scale > 0 ? wanted.scale : std::max(std::abs(found.value), least_scale(wanted.unit));
      report_.take(Figure::of_name(wanted.name, found.value, wanted.unit, usual)).at = found.time;
    }
  }
  void list(const std::vector<ExtremeOf>& extremes) {
    for (const ExtremeOf& e : extremes) report_.take(Figure::of_name(e.name, 0, e.unit));
  }
  // Smaller values are rounding errors and are not judged by their own size: a slider that should stand still.
  double least_scale(const std::string& unit) const {
    constexpr double nothing = 1e-9;
    if (unit == "N*m" || unit == "N") return nothing * model_.torque_scale;
    const double speed = nothing * model_.speed_scale;
    return unit == "m/s2" || unit == "rad/s2" ? speed * model_.speed_scale : speed;
  }
  void add_rms() {
    for (std::size_t i = 0; i < model_.torque_joints.size(); ++i)
      for (const bool spring : {false, true}) {
        const TorqueJoint& joint = model_.torque_joints[i];
        if (spring && !model_.network.joints[at(joint.joint)].element) continue;
        report_(spring ? quantities::rms_spring_torque : quantities::rms_torque, joint.component,
                [&]() -> std::optional<Found> {
                  const bool slips = joint.elastic >= 0 && model_.elastic[at(joint.elastic)].slips;
                  const double duration = run_->outcome.t - begin();
                  if (duration <= 0 || (spring && slips)) return {};
                  const double square = run_->outcome.state[equations_->square_index(i, spring)];
                  return Found{root_mean_square(square, duration), joint.torque_scale};
                });
      }
  }
  void add_final() {
    const Snapshot* const s = run_ ? &equations_->snapshot(run_->outcome.t, run_->outcome.state) : nullptr;
    const auto at_end = [&](Found found) {
      found.at = run_->outcome.t;
      return found;
    };
    for (const std::string& component : model_.network.components) {
      if (model_.network.components.size() > 60 && component != link()) continue;
      const int node = model_.network.ports.at(component).out;
      report_(quantities::final_angle, component, [&] { return at_end(angle_of(model_, *s, node)); });
      report_(quantities::final_speed, component, [&] { return at_end(speed_of(*equations_, *s, node)); });
    }
  }
  // Heat of what slips.
  void add_heat() {
    for (const ElasticJoint& e : model_.elastic)
      if (e.slips)
        report_(quantities::slip_heat, model_.network.joints[at(e.joint)].component, [&]() -> std::optional<Found> {
          if (run_->energy->work.empty()) return {};  // failed before its first step
          return Found{-run_->energy->work[at(e.loss_account)], energy_scale(), run_->outcome.t};
        });
  }
  // Joints with clearance: how often one is hit after flight.
  void add_impacts() {
    for (const std::string& component : components_with_impacts(model_))
      report_(quantities::impacts, component, [&] {
        int count = 0;
        for (const Event& e : run_->outcome.events) count += e.component == component && e.kind == EventKind::impact;
        return Found{static_cast<double>(count), static_cast<double>(std::max(1, count)), run_->outcome.t, true};
      });
  }
  void add_stopping() {
    const std::optional<Stopping> stopping =
        report_.listing() ? Stopping{} : first_stopping(model_, run_->outcome.events, run_->periods.standstill);
    if (!stopping) return;
    report_(quantities::stopping_time, link(), [&] {
      return Found{stopping->time, model_.scene.run.until, stopping->at};
    });
    report_(quantities::stopping_angle, link(), [&] {
      return Found{stopping->angle, 1, stopping->at, false, rounding_of_a_run * stopping->largest_angle};
    });
  }
  // An undriven machine repeats its cycles, too, unless it loses energy: compares with the two before it.
  bool comes_again(const CycleRecord& last) const {
    constexpr double alike = 1e-3;  // of the mid speed
    const CycleRecord* here = &last;
    if (here - cycles_.data() < 2) return false;
    return std::all_of(here - 2, here, [&](const CycleRecord& c) {
      return std::max(std::abs(c.omega_max - last.omega_max), std::abs(c.omega_min - last.omega_min)) <=
             alike * std::abs(last.mid_speed());
    });
  }
  std::vector<const CycleRecord*> all_that_come_again() const {
    std::vector<const CycleRecord*> list;
    for (const CycleRecord& c : cycles_)
      if (comes_again(c)) list.push_back(&c);
    return list;
  }
  // The last complete period of steady motion, or the last cycle before run-down.
  void find_last_cycle() {
    for (const CycleRecord& c : cycles_)
      if (c.end <= run_->periods.judged_until) last_ = &c;
    const Periods& p = run_->periods;
    if (last_ && (p.steady || (!p.remaining && !p.without_limit && comes_again(*last_)))) repeating_ = last_;
  }
  bool has_cycle() const { return report_.listing() ? model_.cycle > 0 || clock_of(model_) > 0 : last_ != nullptr; }

  void add_cycle() {
    if (!has_cycle()) return;
    for (const QuantityKind& what : {quantities::delta, quantities::cycle_fluctuation})
      report_(what, link(), [&]() -> std::optional<Found> {
        constexpr double slight = 0.1, half = 0.5;  // of the range: no δ beyond the one, no range beyond the other
        const double part = last_ == cycles_.data() ? 0 : drift_of(*last_, last_[-1], tolerance_);
        if (part > half || (what == quantities::delta) != (repeating_ && part <= slight)) return {};
        return Found{last_->fluctuation(), 1, last_->end};
      });
    report_(quantities::mid_speed, link(), [&] { return Found{last_->mid_speed(), model_.speed_scale, last_->end}; });
    // A difference of times is as exact as they are.
    const double time = last_ ? last_->end - last_->begin : 0, off = last_ ? rounding_of_a_run * last_->end : 0;
    report_(quantities::mean_speed, link(), [&] {
      const double mean = last_->mean_speed();
      return Found{mean, model_.speed_scale, last_->end, false, std::abs(mean) * off / time};
    });
    report_(quantities::cycle_time, link(), [&]() -> std::optional<Found> {
      if (model_.cycle == 0 || std::abs(last_->turned) < 0.5 * model_.cycle) return {};  // it moves to and fro
      const double cycles = std::abs(last_->turned) / model_.cycle;
      return Found{time / cycles, 2 * M_PI / model_.speed_scale, last_->end, false, off / cycles};
    });
    report_(quantities::period, "", [&]() -> std::optional<Found> {
      if (!repeating_ || (run_->periods.cycles == 1 && run_->periods.time == 0)) return {};
      return Found{time, time, last_->end, run_->periods.time > 0 && run_->periods.time == clock_of(model_), off};
    });
    for (const Account kind : {Account::driving, Account::useful, Account::harmful})
      report_(work_per_cycle_of(kind), "", [&] {
        return Found{works_by_kind(model_, last_->work)[static_cast<std::size_t>(kind)], energy_scale(), last_->end};
      });
    add_loops();
    for (const Intake& intake : intakes_of(model_))
      report_("volumetric_efficiency", intake.name, [&] { return Found{intake.efficiency, 1, {}, true}; });
  }
  void add_loops() {
    for (std::size_t k = 0; k < model_.accounts.size(); ++k) {
      const std::string mechanism = mechanism_loaded_by(model_.accounts[k]);
      if (mechanism.empty()) continue;
      const double time = last_ ? last_->end - last_->begin : 0;
      report_("loop_work", mechanism, [&] { return Found{last_->work[k], energy_scale(), last_->end}; });
      report_("loop_power", mechanism, [&] { return Found{last_->work[k] / time, energy_scale() / time, last_->end}; });
    }
  }
  // Energy released from the largest to the least speed by flywheels that turn rigidly with the link.
  void add_flywheels() {
    if (!has_cycle() || !(repeating_ || report_.listing())) return;
    const std::size_t link = at(model_.reduction_node);
    for (const auto& [component, flywheel] : model_.network.data.all<Flywheel>()) {
      const std::size_t node = at(model_.network.ports.at(component).out);
      if (model_.shaft_of_node[node] != model_.shaft_of_node[link]) continue;
      const double ratio = model_.gain_of_node[node] / model_.gain_of_node[link], inertia = flywheel.inertia;
      report_("flywheel_energy", component, [&] {
        const double max = repeating_->omega_max, min = repeating_->omega_min;
        return Found{0.5 * inertia * ratio * ratio * std::abs(max * max - min * min), energy_scale(), repeating_->end};
      });
    }
  }
  void add_efficiency() {
    if (!has_cycle()) return;
    report_({quantities::other, "", "machine_efficiency"}, [&]() -> std::optional<Found> {
      if (!repeating_) return {};
      const std::array<double, 4> work = works_by_kind(model_, repeating_->work);
      if (!(work[0] > 0)) return {};
      const std::optional<double> efficiency =
          efficiency_of(work[0], work[1], work[3], repeating_->energy_after - repeating_->energy_before);
      if (!efficiency) return {};
      return Found{*efficiency, 1, repeating_->end};
    });
  }
  void add_periods() {
    const Periods p = run_ ? run_->periods : Periods{};
    // A duration up to a time, and the resolution of its location.
    const auto lasting = [&](std::optional<double> begin, std::optional<double> end, double resolution) {
      return begin && end ? std::optional(Found{*end - *begin, run_->outcome.t, end, false, resolution}) : std::nullopt;
    };
    report_(quantities::run_up_time, "", [&] { return lasting(0.0, p.run_up_end, p.run_up_resolution); });
    report_(quantities::steady_speed, link(), [&] {
      return p.steady ? std::optional(Found{p.steady_speed, model_.speed_scale}) : std::nullopt;
    });
    report_(quantities::run_down_time, "",
            [&] { return lasting(p.run_down_begin, p.standstill, p.standstill_resolution); });
  }
  void add_work() {
    for (const Account kind : all_accounts)
      report_(quantities::work, name_of(kind), [&] {
        const double done = works_by_kind(model_, run_->energy->work)[static_cast<std::size_t>(kind)];
        return Found{done, energy_scale(), run_->outcome.complete ? std::nullopt : std::optional(run_->outcome.t)};
      });
  }
  double begin() const { return run_->trajectory->time().empty() ? 0 : run_->trajectory->time().front(); }
  void add_ratings() {
    for (Figure& f : rating_figures(model_, run_->heat.get(), run_->figures, energy_scale(), run_->outcome.t - begin()))
      report_.take(std::move(f));
  }
  void add_slipped_angles() {
    const std::size_t own = model_.state_count() - model_.internal_states.size();
    for (std::size_t k = 0; k < model_.internal_states.size(); ++k)
      if (const auto& [component, state] = model_.internal_states[k]; state.name == "slipped_angle")
        report_(Name::own(state.name, component), [&] {
          return Found{run_->outcome.state[own + k], 1, run_->outcome.t};
        });
  }
  void add_works_of_periods() {
    const EnergyAudit& e = *run_->energy;
    const WholeRun whole{.begin = begin(),
                         .end = run_->outcome.t,
                         .energy_begin = e.kinetic_start + e.stored_start,
                         .energy_end = e.kinetic_end + e.stored_end,
                         .work = e.work};
    run_->work_periods =
        work_periods(model_, run_->periods, run_->cycles.cycles(), whole, [&](double t) { return run_->works_at(t); });
    report_works(model_, run_->work_periods, report_);
  }
  void add_motors() {
    const Periods& p = run_->periods;
    if (run_->outcome.state.size() < equations_->size()) return;
    // Up to the end, also for an incomplete run.
    const std::vector<double> work = works_done(*equations_, run_->outcome.state);
    std::optional<MotorRun::Span> after_run_up;
    if (p.run_up_end) after_run_up = {*p.run_up_end, p.run_down_begin.value_or(run_->outcome.t)};
    report_motors({.equations = *equations_,
                   .y = run_->outcome.state,
                   .work = work,
                   .duration = run_->outcome.t - begin(),
                   .energy_scale = energy_scale(),
                   .last = repeating_,
                   .repeating = model_.commands.empty() ? std::vector<const CycleRecord*>{} : all_that_come_again(),
                   .currents = run_->currents.get(),
                   .end = run_->outcome.t,
                   .steady = p.steady && !p.run_down_begin,
                   .after_run_up = after_run_up},
                  report_);
  }
  // If nothing moves, a fraction of the work of the rated torque over 1 rad, as a reference for rounding errors.
  double energy_scale() const {
    return std::max({run_->energy->turnover, run_->energy->largest_kinetic, 1e-9 * model_.torque_scale});
  }

  const Model& model_;
  FigureReporter report_;
  OneRun* run_ = nullptr;  // null: of a list
  Equations* equations_ = nullptr;
  double tolerance_ = 0;
  std::vector<CycleRecord> cycles_;         // or periods of several, in steady motion
  const CycleRecord* last_ = nullptr;       // whole
  const CycleRecord* repeating_ = nullptr;  // the same, of a motion that repeats
};

std::vector<Figure> last_state(const Model& m, Equations& equations, const RunOutcome& outcome) {
  const Snapshot& s = equations.snapshot(outcome.t, outcome.state);
  std::vector<Figure> list;
  for (const std::string& component : m.network.components)
    for (const int node : {m.network.ports.at(component).in, m.network.ports.at(component).out})
      for (const Found& found : {angle_of(m, s, node), speed_of(equations, s, node)}) {
        Figure& figure = list.emplace_back();
        figure.value = found.value, figure.scale = found.scale, figure.exact = found.exact;
      }
  return list;
}

}  // namespace

QuantityKind work_per_cycle_of(Account account) {
  constexpr QuantityKind works[] = {quantities::driving_work_per_cycle, quantities::useful_work_per_cycle,
                                    quantities::harmful_work_per_cycle, quantities::weight_work_per_cycle};
  return works[static_cast<std::size_t>(account)];
}

void collect_figures(const Model& model, Equations& equations, double tolerance, OneRun& run) {
  close_balance(equations, run.outcome, *run.energy);
  RunFigures(model, equations, run, tolerance).collect();
  run.last_state = last_state(model, equations, run.outcome);
}

std::map<std::string, ComponentState> final_state(const Model& model, const std::vector<Figure>& last_state) {
  std::map<std::string, ComponentState> states;
  if (last_state.empty()) return states;
  const Figure* f = last_state.data();
  for (const std::string& component : model.network.components) {
    ComponentState& state = states[component] = {f[0], f[1]};
    const Network::Ports& ports = model.network.ports.at(component);
    if (ports.out != ports.in) state.angle_out = f[2], state.speed_out = f[3];
    f += 4;
  }
  return states;
}

std::vector<Figure> figure_list(const Model& model) {
  std::vector<Figure> list;
  RunFigures(model, list).list();
  return list;
}

}  // namespace kurbel
