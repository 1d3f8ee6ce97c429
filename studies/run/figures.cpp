// figures.cpp — the figures of one run.
#include "studies/run/figures.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "drivetrain/shared/rating_keys.h"
#include "engine/numerics/index.h"
#include "mechanisms/reduced/mechanism.h"
#include "studies/duty/holding.h"
#include "studies/duty/motor_figures.h"
#include "studies/duty/stopping.h"
#include "studies/limits/ratings.h"
#include "studies/run/simulate.h"

namespace kurbel {
namespace {

// Mechanisms whose joints have clearance.
std::vector<std::string> components_with_impacts(const Model& model) {
  std::vector<std::string> names;
  for (const Network::ShaftElement& e : model.network.elements)
    if (const MechanismElement* element = mechanism_of(e);
        element && element->dynamics() && !element->mechanism().clearances.empty())
      names.push_back(element->mechanism().name);
  return names;
}

// Whose output an account's load acts on; empty: it is no load of a mechanism.
std::string mechanism_loaded_by(const WorkAccount& account) {
  const std::string end = ".load";
  if (account.kind != Account::useful || !account.name.ends_with(end)) return {};
  return account.name.substr(0, account.name.size() - end.size());
}

// Of each compressor: λ, the share of its stroke that draws in gas. It goes by its mechanism's name, one of several of a
// mechanism by that of its load.
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

struct FlywheelOnLink {
  std::string name;
  double inertia = 0, ratio = 1;  // [kg·m²]; of its speed to the link's
};
std::vector<FlywheelOnLink> flywheels_on_link(const Model& model) {
  std::vector<FlywheelOnLink> list;
  const std::size_t link = at(model.reduction_node);
  for (const auto& [component, flywheel] : model.network.data.all<Flywheel>()) {
    const std::size_t node = at(model.network.ports.at(component).out);
    if (model.shaft_of_node[node] == model.shaft_of_node[link])
      list.push_back({component, flywheel.inertia, model.gain_of_node[node] / model.gain_of_node[link]});
  }
  return list;
}

class Figures {
 public:
  Figures(const Model& model, Equations& equations, OneRun& run, double tolerance)
      : model_(model), equations_(equations), run_(run), tolerance_(tolerance) {}

  void collect() {
    collect_extremes();
    collect_rms();
    collect_final();
    collect_cycles();
    collect_periods();
    collect_work();
    collect_heat();
    collect_stopping();
    collect_impacts();
    collect_motors();
    collect_works_of_periods();
    collect_ratings();
    collect_falls_and_reserves();
  }

 private:
  void add(Name name, double value, const std::string& unit, double scale, std::optional<double> time = {}) {
    run_.figures.push_back(Figure::of_name(std::move(name), value, unit, scale));
    run_.figures.back().at = time;
  }
  void add(const QuantityKind& what, const std::string& of, double value, const std::string& unit, double scale,
           std::optional<double> time = {}) {
    add(Name::make(what, of), value, unit, scale, time);
  }
  // A duration up to a time; `resolution`: how sharply that time is located.
  void add_located(const QuantityKind& what, double begin, double end, double resolution) {
    add(what, "", end - begin, "s", run_.outcome.t, end);
    run_.figures.back().resolution = resolution;
  }
  std::string link() const { return model_.network.nodes[at(model_.reduction_node)].component; }

  void collect_extremes() {
    for (std::size_t i = 0; i < run_.extremes->wanted().size(); ++i) {
      const ExtremeOf& wanted = run_.extremes->wanted()[i];
      const ExtremeRecorder::Found& found = run_.extremes->found()[i];
      if (found.any)
        add(wanted.name, found.value, wanted.unit,
            wanted.scale > 0 ? wanted.scale : std::max(std::abs(found.value), least_scale(wanted.unit)), found.time);
    }
  }
  // What is this small is rounding, and is not judged by its own size: a slider that should stand still.
  double least_scale(const std::string& unit) const {
    constexpr double nothing = 1e-9;
    if (unit == "N*m" || unit == "N") return nothing * model_.torque_scale;
    const double speed = nothing * model_.speed_scale;
    return unit == "m/s2" || unit == "rad/s2" ? speed * model_.speed_scale : speed;
  }
  void collect_rms() {
    if (run_.outcome.t <= 0) return;
    for (std::size_t i = 0; i < model_.torque_joints.size(); ++i)
      for (const bool spring : {false, true}) {
        const int elastic = model_.torque_joints[i].elastic;
        if (spring && elastic >= 0 && model_.elastic[at(elastic)].slips) continue;
        if (spring && !model_.network.joints[at(model_.torque_joints[i].joint)].element) continue;
        const double square = run_.outcome.state[equations_.square_index(i, spring)];
        add(spring ? quantity::rms_spring_torque : quantity::rms_torque, model_.torque_joints[i].component,
            std::sqrt(std::max(0.0, square) / run_.outcome.t), "N*m", model_.torque_joints[i].torque_scale);
      }
  }
  void collect_final() {
    const Snapshot& s = equations_.snapshot(run_.outcome.t, run_.outcome.state);
    for (const std::string& component : model_.network.components) {
      if (model_.network.components.size() > 60 && component != link()) continue;
      const Network::Ports& ports = model_.network.ports.at(component);
      const int node = ports.out;
      const double ratio = model_.scale_ratio[at(node)];
      add(quantity::final_angle, component, s.node_angle[node], "rad", std::max(1.0, ratio), run_.outcome.t);
      add(quantity::final_speed, component, model_.gain_of_node[at(node)] * s.now.speed[model_.shaft_of_node[at(node)]],
          "rad/s", model_.speed_scale * ratio, run_.outcome.t);
      const std::size_t shaft = at(model_.shaft_of_node[at(node)]);
      run_.figures.back().exact = shaft >= model_.free_shafts || equations_.at_standstill(shaft);
    }
  }
  // Heat of what slips.
  void collect_heat() {
    for (const ElasticJoint& e : model_.elastic)
      if (e.slips && !run_.energy->work.empty())  // empty: failed before its first step
        add(quantity::slip_heat, model_.network.joints[at(e.joint)].component, -run_.energy->work[at(e.loss_account)],
            "J", energy_scale(), run_.outcome.t);
  }
  // Joints with clearance: how often one is hit after flight.
  void collect_impacts() {
    for (const std::string& component : components_with_impacts(model_)) {
      int count = 0;
      for (const Event& e : run_.outcome.events) count += e.component == component && e.kind == EventKind::impact;
      add(quantity::impacts, component, count, "", std::max(1, count), run_.outcome.t);
      run_.figures.back().exact = true;
    }
  }
  void collect_stopping() {
    const auto stopping = first_stopping(model_, run_.outcome.events);
    if (!stopping) return;
    add(quantity::stopping_time, link(), stopping->time, "s", model_.scene.run.until, stopping->at);
    add(quantity::stopping_angle, link(), stopping->angle, "rad", 1, stopping->at);
  }
  // A machine that nothing drives repeats its cycles, too, unless it loses something: like the two before it.
  bool comes_again(const CycleRecord& last) const {
    constexpr double alike = 1e-3;  // of the mid speed
    const CycleRecord* here = &last;
    if (here - run_.cycles.cycles().data() < 2) return false;
    return std::all_of(here - 2, here, [&](const CycleRecord& c) {
      return std::max(std::abs(c.omega_max - last.omega_max), std::abs(c.omega_min - last.omega_min)) <=
             alike * std::abs(last.mid_speed());
    });
  }
  std::vector<const CycleRecord*> all_that_come_again() const {
    std::vector<const CycleRecord*> list;
    for (const CycleRecord& c : run_.cycles.cycles())
      if (comes_again(c)) list.push_back(&c);
    return list;
  }
  // Of the last complete cycle of steady motion, or the last one before run-down.
  void collect_cycles() {
    run_.periods = find_periods(model_, run_.cycles.cycles(), *run_.speed, run_.outcome, tolerance_);
    const CycleRecord* last = nullptr;
    for (const CycleRecord& c : run_.cycles.cycles())
      if (!run_.periods.run_down_begin || c.end <= *run_.periods.run_down_begin) last = &c;
    if (!last) return;
    const bool repeats = run_.periods.steady || comes_again(*last);
    if (repeats) repeating_ = last;
    add(repeats ? quantity::delta : quantity::cycle_fluctuation, link(), last->fluctuation(), "", 1, last->end);
    add(quantity::mid_speed, link(), last->mid_speed(), "rad/s", model_.speed_scale, last->end);
    add(quantity::mean_speed, link(), last->mean_speed(model_.cycle), "rad/s", model_.speed_scale, last->end);
    add(quantity::cycle_time, link(), last->end - last->begin, "s", 2 * M_PI / model_.speed_scale, last->end);
    std::array<double, 4> sum{};  // by account
    for (std::size_t k = 0; k < last->work.size(); ++k)
      sum[static_cast<std::size_t>(model_.accounts[k].kind)] += last->work[k];
    for (const Account kind : {Account::driving, Account::useful, Account::harmful})
      add(work_per_cycle_of(kind), "", sum[static_cast<std::size_t>(kind)], "J", energy_scale(), last->end);
    for (std::size_t k = 0; k < last->work.size(); ++k)
      if (const std::string mechanism = mechanism_loaded_by(model_.accounts[k]); !mechanism.empty())
        add_loop(mechanism, last->work[k], *last);
    for (const Intake& intake : intakes_of(model_)) {
      add(Name::own("volumetric_efficiency", intake.name), intake.efficiency, "", 1);
      run_.figures.back().exact = true;
    }
    if (repeats) collect_flywheels(*last);
    if (!repeats || !(sum[0] > 0)) return;
    if (const auto efficiency = efficiency_of(sum[0], sum[1], sum[3], last->energy_after - last->energy_before))
      add(Name{quantity::other, "", "machine_efficiency"}, *efficiency, "", 1, last->end);
  }
  void add_loop(const std::string& mechanism, double work, const CycleRecord& c) {
    const double time = c.end - c.begin;
    add(Name::own("loop_work", mechanism), work, "J", energy_scale(), c.end);
    add(Name::own("loop_power", mechanism), work / time, "W", energy_scale() / time, c.end);
  }
  // What flywheels that turn rigidly with the link give from its largest to its least speed.
  void collect_flywheels(const CycleRecord& c) {
    for (const FlywheelOnLink& f : flywheels_on_link(model_))
      add(Name::own("flywheel_energy", f.name),
          0.5 * f.inertia * f.ratio * f.ratio * std::abs(c.omega_max * c.omega_max - c.omega_min * c.omega_min), "J",
          energy_scale(), c.end);
  }
  void collect_periods() {
    const Periods& p = run_.periods;
    if (p.run_up_end) add_located(quantity::run_up_time, 0, *p.run_up_end, p.run_up_resolution);
    if (p.steady) add(quantity::steady_speed, link(), p.steady_speed, "rad/s", model_.speed_scale);
    if (p.run_down_begin && p.standstill)
      add_located(quantity::run_down_time, *p.run_down_begin, *p.standstill, p.standstill_resolution);
  }
  void collect_work() {
    for (const Account kind : {Account::driving, Account::useful, Account::harmful, Account::weight}) {
      double sum = 0;
      for (std::size_t k = 0; k < run_.energy->work.size(); ++k)
        if (model_.accounts[k].kind == kind) sum += run_.energy->work[k];
      add(quantity::work, name_of(kind), sum, "J", energy_scale());
    }
  }
  void collect_ratings() {
    const double begin = run_.trajectory->time().empty() ? 0 : run_.trajectory->time().front();
    for (Figure& f : rating_figures(model_, run_.heat.get(), run_.figures, energy_scale(), run_.outcome.t - begin))
      run_.figures.push_back(std::move(f));
  }
  void collect_falls_and_reserves() {
    if (run_.falls)
      for (Figure& f : run_.falls->figures(energy_scale())) run_.figures.push_back(std::move(f));
    for (Figure& f : reserves(model_, run_.figures)) run_.figures.push_back(std::move(f));
    const std::size_t own = model_.state_count() - model_.own_states.size();
    for (std::size_t k = 0; k < model_.own_states.size(); ++k)
      if (const auto& [component, state] = model_.own_states[k]; state.name == "slipped_angle")
        add(Name::own(state.name, component), run_.outcome.state[own + k], state.unit, 1, run_.outcome.t);
  }
  void collect_works_of_periods() {
    const EnergyAudit& e = *run_.energy;
    const WholeRun whole{.begin = run_.trajectory->time().empty() ? 0 : run_.trajectory->time().front(),
                         .end = run_.outcome.t,
                         .energy_begin = e.kinetic_start + e.stored_start,
                         .energy_end = e.kinetic_end + e.stored_end,
                         .work = e.work};
    run_.work_periods = work_periods(model_, run_.periods, run_.cycles.cycles(), whole);
    for (Figure& f : work_figures(run_.work_periods)) run_.figures.push_back(std::move(f));
  }
  std::optional<MotorRun::Span> after_run_up() const {
    const Periods& p = run_.periods;
    if (!p.run_up_end) return {};
    return MotorRun::Span{*p.run_up_end, p.run_down_begin.value_or(run_.outcome.t)};
  }
  void collect_motors() {
    const double begin = run_.trajectory->time().empty() ? 0 : run_.trajectory->time().front();
    if (run_.outcome.state.size() < equations_.size()) return;
    std::vector<double> work;  // up to the end, of an incomplete run too
    for (std::size_t k = 0; k < model_.accounts.size(); ++k)
      work.push_back(run_.outcome.state[equations_.work_index(k)]);
    const std::vector<Figure> known = run_.figures;
    for (Figure& f : motor_figures({.equations = equations_,
                     .y = run_.outcome.state,
                     .work = work,
                     .duration = run_.outcome.t - begin,
                     .energy_scale = energy_scale(),
                     .last = repeating_,
                     .repeating = model_.commands.empty() ? std::vector<const CycleRecord*>{} : all_that_come_again(),
                     .currents = run_.currents.get(),
                     .end = run_.outcome.t,
                     .steady = run_.periods.steady && !run_.periods.run_down_begin,
                     .known = &known,
                     .after_run_up = after_run_up()}))
      run_.figures.push_back(std::move(f));
  }
  // Where nothing moves, a part of the work of the rated torque over 1 rad, beside which what is left is rounding.
  double energy_scale() const {
    return std::max({run_.energy->turnover, run_.energy->largest_kinetic, 1e-9 * model_.torque_scale});
  }

  const Model& model_;
  Equations& equations_;
  OneRun& run_;
  double tolerance_;
  const CycleRecord* repeating_ = nullptr;  // the last whole cycle of a motion that repeats
};

std::vector<Figure> last_state(const Model& m, Equations& equations, const RunOutcome& outcome) {
  const Snapshot& s = equations.snapshot(outcome.t, outcome.state);
  std::vector<Figure> list;
  const auto add = [&](int node) {
    const int shaft = m.shaft_of_node[at(node)];
    Figure angle, speed;
    angle.value = s.node_angle[node];
    angle.scale = std::max(1.0, m.scale_ratio[at(node)]);
    speed.value = m.gain_of_node[at(node)] * s.now.speed[shaft];
    speed.scale = m.speed_scale * m.scale_ratio[at(node)];
    speed.exact = at(shaft) >= m.free_shafts || equations.at_standstill(at(shaft));
    list.insert(list.end(), {angle, speed});
  };
  for (const std::string& component : m.network.components) {
    add(m.network.ports.at(component).in);
    add(m.network.ports.at(component).out);
  }
  return list;
}

}  // namespace

QuantityKind work_per_cycle_of(Account account) {
  switch (account) {
    case Account::driving:
      return quantity::driving_work_per_cycle;
    case Account::useful:
      return quantity::useful_work_per_cycle;
    case Account::harmful:
      return quantity::harmful_work_per_cycle;
    case Account::weight:
      break;
  }
  return quantity::weight_work_per_cycle;
}

void collect_figures(const Model& model, Equations& equations, double tolerance, OneRun& run) {
  Figures(model, equations, run, tolerance).collect();
  run.last_state = last_state(model, equations, run.outcome);
}

EnergyBalance energy_balance(const Model& model, const EnergyAudit& audit) {
  EnergyBalance e;
  for (std::size_t k = 0; k < audit.work.size(); ++k) {
    e.by_line[name_of(model.accounts[k].kind)] += audit.work[k];
    e.by_account[model.accounts[k].name] += audit.work[k];
  }
  e.kinetic_start = audit.kinetic_start;
  e.kinetic_end = audit.kinetic_end;
  e.stored_start = audit.stored_start;
  e.stored_end = audit.stored_end;
  e.residual = audit.largest_residual;
  e.relative = audit.relative();
  e.reduction_residual = audit.reduction_residual;
  e.free_bodies = audit.open_body.part;
  e.checks = audit.checked;
  return e;
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
  const auto add = [&](const QuantityKind& what, const std::string& of, const std::string& unit) {
    list.push_back(Figure::of_name(Name::make(what, of), 0, unit));
  };
  const std::string link = model.network.nodes[at(model.reduction_node)].component;
  for (const ExtremeOf& e : extremes_of(model)) list.push_back(Figure::of_name(e.name, 0, e.unit));
  for (const TorqueJoint& joint : model.torque_joints) {
    add(quantity::rms_torque, joint.component, "N*m");
    if (model.network.joints[at(joint.joint)].element) add(quantity::rms_spring_torque, joint.component, "N*m");
  }
  for (const std::string& component : model.network.components) {
    if (model.network.components.size() > 60 && component != link) continue;
    add(quantity::final_angle, component, "rad");
    add(quantity::final_speed, component, "rad/s");
  }
  for (const std::string& component : components_with_impacts(model)) add(quantity::impacts, component, "");
  if (model.cycle > 0) {
    add(quantity::delta, link, "");
    add(quantity::cycle_fluctuation, link, "");
    add(quantity::mid_speed, link, "rad/s");
    add(quantity::mean_speed, link, "rad/s");
    add(quantity::cycle_time, link, "s");
    for (const Account kind : {Account::driving, Account::useful, Account::harmful})
      add(work_per_cycle_of(kind), "", "J");
    for (const WorkAccount& account : model.accounts)
      if (const std::string mechanism = mechanism_loaded_by(account); !mechanism.empty())
        for (const auto& [words, unit] : {std::pair("loop_work", "J"), {"loop_power", "W"}})
          list.push_back(Figure::of_name(Name::own(words, mechanism), 0, unit));
    for (const Intake& intake : intakes_of(model))
      list.push_back(Figure::of_name(Name::own("volumetric_efficiency", intake.name)));
    list.push_back(Figure::of_name({quantity::other, "", "machine_efficiency"}));
    for (const FlywheelOnLink& f : flywheels_on_link(model))
      list.push_back(Figure::of_name(Name::own("flywheel_energy", f.name), 0, "J"));
  }
  add(quantity::run_up_time, "", "s");
  add(quantity::steady_speed, link, "rad/s");
  add(quantity::run_down_time, "", "s");
  for (const char* kind : {"driving", "useful", "harmful", "weight"}) add(quantity::work, kind, "J");
  for (const ElasticJoint& e : model.elastic)
    if (e.slips) add(quantity::slip_heat, model.network.joints[at(e.joint)].component, "J");
  for (Figure& f : motor_figure_list(model)) list.push_back(std::move(f));
  for (Figure& f : work_figure_list(model)) list.push_back(std::move(f));
  for (Figure& f : flywheel_fall_list(model)) list.push_back(std::move(f));
  for (Figure& f : reserve_list(model)) list.push_back(std::move(f));
  for (const auto& [component, state] : model.own_states)
    if (state.name == "slipped_angle") list.push_back(Figure::of_name(Name::own(state.name, component), 0, state.unit));
  for (std::vector<Figure> of_limits : {rating_figure_list(model), watched_figure_list(model)})
    for (Figure& f : of_limits)
      if (std::none_of(list.begin(), list.end(), [&](const Figure& known) { return known.name == f.name; }))
        list.push_back(std::move(f));
  // Of a signal that makes the link stop.
  if (!model.scene.sequence.steps.empty()) {
    add(quantity::stopping_time, link, "s");
    add(quantity::stopping_angle, link, "rad");
  }
  return list;
}

}  // namespace kurbel
