// cycle_figures.cpp — one period with all quantities of its figures recorded.
#include "studies/steady/cycle_figures.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <numbers>

#include "drivetrain/shared/rating_keys.h"
#include "engine/base/find_by.h"
#include "engine/numerics/index.h"
#include "engine/orbit/follow_period.h"
#include "studies/duty/motor_figures.h"
#include "studies/duty/work_periods.h"
#include "studies/figures/asked_figures.h"
#include "studies/findings/report.h"
#include "studies/limits/ratings.h"
#include "studies/run/figures.h"
#include "studies/validity/outside_data.h"

namespace kurbel {
namespace {

// Elements of one component that drive together, rated or not, and prescribed shafts.
using Drive = MotorTorque;

std::vector<Drive> drives_of(const Model& model) {
  std::vector<Drive> drives;
  for (std::size_t e = 0; e < model.network.elements.size(); ++e) {
    const Network::ShaftElement& element = model.network.elements[e];
    if (element.element->account != Account::driving) continue;
    auto* const known = find_by(drives, &Drive::component, element.component);
    if (known) {
      known->elements.push_back(e);
    } else {
      drives.push_back({.component = element.component, .elements = {e}, .node = element.node});
    }
  }
  std::copy_if(model.motors.begin(), model.motors.end(), std::back_inserter(drives),
               [](const MotorTorque& motor) { return motor.prescribed; });
  return drives;
}

// ∫M dt and ∫M² dt of every drive, integrated along with the motion and as accurately.
class DriveQuadratures final : public RunExtension {
 public:
  DriveQuadratures(Equations& equations, std::vector<Drive> drives)
      : equations_(equations), drives_(std::move(drives)) {}
  std::size_t begin() const { return equations_.size(); }
  std::size_t size() const override { return begin() + 2 * drives_.size(); }
  void flow(double t, std::span<const double> y, std::span<double> ydot) override {
    equations_.flow(t, y.first(begin()), ydot.first(begin()));
    const Snapshot& s = equations_.snapshot(t, y.first(begin()));
    for (std::size_t i = 0; i < drives_.size(); ++i) {
      const double torque = drives_[i].torque(s);
      ydot[begin() + 2 * i] = torque;
      ydot[begin() + 2 * i + 1] = torque * torque;
    }
  }
  const SparsityPattern& jacobian_pattern() override {
    if (pattern_.size == size()) return pattern_;
    pattern_ = equations_.jacobian_pattern();
    pattern_.size = size();
    for (std::size_t i = begin(); i < size(); ++i) {
      pattern_.row.push_back(static_cast<std::int64_t>(i));
      pattern_.column_start.push_back(static_cast<std::int64_t>(pattern_.row.size()));
    }
    return pattern_;
  }
  void jacobian(double t, std::span<const double> y, std::span<double> values) override {
    const std::size_t own = equations_.jacobian_pattern().row.size();
    equations_.jacobian(t, y.first(begin()), values.first(own));
    std::fill(values.begin() + static_cast<std::ptrdiff_t>(own), values.end(), 0.0);
  }
  ErrorControl error_control(double tolerance) const override {
    ErrorControl control = equations_.error_control(tolerance);
    const Model& m = equations_.model();
    for (const Drive& drive : drives_) {
      const double torque = m.torque_scale / m.scale_ratio[at(drive.node)];
      control.scale.push_back(torque / m.speed_scale);  // per radian of the link
      control.scale.push_back(torque * torque / m.speed_scale);
    }
    return control;
  }
  void before_event(double, std::span<const double>, const std::vector<std::size_t>&) override {}
  void after_event(double, std::span<double>) override {}

 private:
  Equations& equations_;
  std::vector<Drive> drives_;
  SparsityPattern pattern_;
};

// Of the angles of all shafts, two each.
std::vector<ExtremeOf> angles_of(const Model& m) {
  std::vector<ExtremeOf> wanted;
  for (const NamedShaft& shaft : shafts_of(m)) {
    const int s = m.shaft_of_node[at(shaft.node)];
    const double gain = m.gain_of_node[at(shaft.node)];
    for (const Functional which : {Functional::greatest, Functional::least})
      wanted.push_back({.name = Name::make(quantities::angle, shaft.name),
                        .unit = "rad",
                        .scale = 1,
                        .functional = which,
                        .value = [node = shaft.node](const Snapshot& x) { return x.node_angle[node]; },
                        .rate = [=](const Snapshot& x) { return gain * x.now.speed[s]; }});
  }
  return wanted;
}

// Extremes in one period: speeds of all shafts first, two each, then torques, forces and accelerations.
std::vector<ExtremeOf> wanted_of(const Model& m) {
  std::vector<ExtremeOf> wanted;
  for (const NamedShaft& shaft : shafts_of(m)) {
    const int s = m.shaft_of_node[at(shaft.node)];
    const double gain = m.gain_of_node[at(shaft.node)];
    ExtremeOf speed{.name = Name::make(quantities::max_speed, shaft.name),
                    .unit = "rad/s",
                    .scale = m.speed_scale * m.scale_ratio[at(shaft.node)],
                    .functional = Functional::greatest,
                    .value = [=](const Snapshot& x) { return gain * x.now.speed[s]; },
                    .rate = [=](const Snapshot& x) { return gain * x.alpha[s]; }};
    wanted.push_back(speed);
    speed.name = Name::make(quantities::min_speed, shaft.name);
    speed.functional = Functional::least;
    wanted.push_back(std::move(speed));
  }
  for (ExtremeOf& e : extremes_of(m))
    if (e.name.what != quantities::max_speed && e.name.what != quantities::min_speed) {
      e.name = e.name.of_cycle();
      wanted.push_back(std::move(e));
    }
  for (ExtremeOf& torque : shaft_torques_of(m)) wanted.push_back(std::move(torque));
  for (Drive& drive : drives_of(m))
    wanted.push_back({.name = Name::make(quantities::peak_drive_torque, drive.component),
                      .unit = "N*m",
                      .scale = m.torque_scale,
                      .value = [drive = std::move(drive)](const Snapshot& s) { return drive.torque(s); },
                      .rate = {}});
  return wanted;
}

class CycleFigures {
 public:
  CycleFigures(const ReturnMap& map, const SteadyPoint& point, double tolerance)
      : map_(map),
        point_(point),
        tolerance_(tolerance),
        m_(map.model()),
        extremes_(wanted_of(m_)),
        angles_(point.vibrates() ? angles_of(m_) : std::vector<ExtremeOf>{}),
        ranges_(m_),
        asked_(m_),
        equations_(map.shared_model(), true),
        drives_(equations_, drives_of(m_)) {
    turned_ = -link_angle(map.place(equations_, point.z));
    outcome_ = follow_period(map, point, equations_, {.tolerance = tolerance, .extension = &drives_}, observers());
    if (outcome_.diagnosis.empty()) turned_ += link_angle(outcome_.state);
  }

  Period collect() {
    if (!outcome_.diagnosis.empty()) return {.failed = outcome_.diagnosis};
    add_speeds();
    add_vibration();
    add_torques();
    add_works();
    add_drives();
    FigureReporter report(round_.figures, false);
    asked_.report(0, {}, report);
    round_.outside_data = ranges_.sentences();
    round_.orders = orders_of_cycle(map_, point_, tolerance_, turned_);
    return std::move(round_);
  }

 private:
  std::vector<Observer*> observers() {
    std::vector<Observer*> list = {&extremes_, &angles_, &ranges_};
    if (!asked_.empty()) list.push_back(&asked_);
    return list;
  }
  void add(Name name, double value, double scale) {
    round_.figures.push_back(Figure::defined(std::move(name), value, scale));
  }
  void add(const QuantityKind& what, const std::string& of, double value, double scale) {
    add(Name::make(what, of), value, scale);
  }
  double link_angle(std::span<const double> y) const { return equations_.angle_with_turns(at(m_.reduction_angle), y); }
  bool vibrates() const { return !angles_.wanted().empty(); }
  double time() const { return outcome_.t - map_.start_time(); }
  double energy_scale() const { return m_.torque_scale * 2 * std::numbers::pi; }
  // For the link: its cycle, and the period after which all repeats.
  void add_times(const std::string& link) {
    add(quantities::period, "", time(), time());
    if (m_.cycle > 0 && !vibrates()) add(quantities::cycle_time, link, time() * m_.cycle / std::abs(turned_), time());
    add(quantities::mean_speed, link, vibrates() ? 0 : turned_ / time(), m_.speed_scale);
  }
  void add_speeds() {
    const std::vector<NamedShaft> shafts = shafts_of(m_);
    for (std::size_t i = 0; i < shafts.size(); ++i) {
      ShaftFluctuation f{shafts[i].name, m_.node_ratio[at(shafts[i].node)], extremes_.found()[2 * i].value,
                         extremes_.found()[2 * i + 1].value};
      if (shafts[i].node == m_.reduction_node) {
        add_times(f.shaft);
        add(quantities::mid_speed, f.shaft, f.mid(), m_.speed_scale);
        add(quantities::cycle_max_speed, f.shaft, f.max, m_.speed_scale);
        add(quantities::cycle_min_speed, f.shaft, f.min, m_.speed_scale);
      }
      if (const auto delta = f.delta()) add(quantities::delta, f.shaft, *delta, 1);
      // Energy released by a flywheel from its largest to its least speed.
      if (const auto* flywheel = m_.network.data.find<Flywheel>(f.shaft))
        add(Name::own("flywheel_energy", f.shaft), 0.5 * flywheel->inertia * std::abs(f.max * f.max - f.min * f.min),
            energy_scale());
      round_.shafts.push_back(std::move(f));
    }
  }
  // Vibration about a position, if the link does not rotate on average.
  void add_vibration() {
    if (!vibrates()) return;
    add(quantities::vibration_frequency, "", 1 / time(), 1 / time());
    for (std::size_t i = 0; i + 1 < angles_.wanted().size(); i += 2)
      add(quantities::vibration_amplitude, angles_.wanted()[i].name.of,
          0.5 * (angles_.found()[i].value - angles_.found()[i + 1].value), 1);
  }
  void add_torques() {
    for (std::size_t i = 2 * shafts_of(m_).size(); i < extremes_.wanted().size(); ++i)
      if (extremes_.found()[i].any) {
        const ExtremeOf& wanted = extremes_.wanted()[i];
        const double value = extremes_.found()[i].value;
        round_.figures.push_back(
            Figure::of_name(wanted.name, value, wanted.unit, wanted.scale > 0 ? wanted.scale : std::abs(value)));
      }
    for (std::size_t i = 0; i < m_.torque_joints.size(); ++i)
      add(quantities::cycle_rms_torque, m_.torque_joints[i].component,
          root_mean_square(outcome_.state[equations_.square_index(i, false)], time()),
          m_.torque_joints[i].torque_scale);
  }
  void add_drives() {
    const std::vector<Drive> drives = drives_of(m_);
    const std::size_t first = extremes_.wanted().size() - drives.size();
    for (std::size_t i = 0; i < drives.size(); ++i) {
      const double* const sums = outcome_.state.data() + drives_.begin() + 2 * i;
      MotorUse use{drives[i].component,
                   root_mean_square(sums[1], time()),
                   sums[0] / time(),
                   extremes_.found()[first + i].value,
                   {}};
      if (const auto* rating = m_.network.data.find<MotorRating>(use.component)) {
        use.rated = rating->torque;
        if (rating->breakdown && *rating->breakdown > 0)
          add(Name::own("breakdown_use", use.component), std::abs(use.peak) / *rating->breakdown, 1);
      }
      add(quantities::mean_drive_torque, use.component, use.mean, m_.torque_scale);
      add(quantities::rms_drive_torque, use.component, use.rms, m_.torque_scale);
      round_.motors.push_back(std::move(use));
    }
  }
  // In a steady cycle the sum of all works is zero.
  void add_works() {
    const std::vector<double> work = works_done(equations_, outcome_.state);
    const std::array<double, 4> by_kind = works_by_kind(m_, work);
    double sum = 0, turnover = 0;
    for (const Account kind : all_accounts) {
      const double of_kind = by_kind[static_cast<std::size_t>(kind)];
      sum += of_kind;
      turnover += std::abs(of_kind);
      add(work_per_cycle_of(kind), "", of_kind, energy_scale());
    }
    const auto [driving, useful, harmful, weight] = by_kind;
    if (const auto efficiency = efficiency_of(driving, useful, weight, 0); efficiency && driving > 0)
      add(Name{quantities::other, "", "machine_efficiency"}, *efficiency, 1);
    for (const MotorTorque& motor : m_.motors)
      add(Name::own("cycle_motor_power", motor.component), driving_work(m_, motor.component, work) / time(),
          std::abs(motor.rated_torque * motor.rated_speed));
    std::vector<std::pair<std::string, double>> by_account;  // a component may have several of one kind
    for (std::size_t a = 0; a < m_.accounts.size(); ++a) {
      const std::string name = fmt::format("{} ({})", m_.accounts[a].name, name_of(m_.accounts[a].kind));
      const auto known = std::ranges::find(by_account, name, &std::pair<std::string, double>::first);
      (known == by_account.end() ? by_account.emplace_back(name, 0) : *known).second += work[a];
    }
    for (const auto& [name, of_account] : by_account)
      if (of_account != 0) add(quantities::work_per_cycle, name, of_account, energy_scale());
    round_.work_residual = std::abs(sum) / std::max(turnover, 1e-6 * m_.torque_scale * map_.periodicity().angle);
  }

  const ReturnMap& map_;
  const SteadyPoint& point_;
  double tolerance_;
  const Model& m_;
  ExtremeRecorder extremes_, angles_;
  DataRangeRecorder ranges_;
  AskedRecorder asked_;
  Equations equations_;
  DriveQuadratures drives_;
  RunOutcome outcome_;
  Period round_;
  double turned_ = 0;  // by the link [rad]
};

}  // namespace

std::vector<NamedShaft> shafts_of(const Model& m) {
  std::vector<NamedShaft> shafts;
  const int link = m.reduction_node;
  for (const std::string& component : m.network.components) {
    const Network::Ports& ports = m.network.ports.at(component);
    if (m.network.components.size() > 60 && ports.in != link && component != m.network.components.front() &&
        component != m.network.components.back())
      continue;
    if (ports.in == ports.out) {
      shafts.push_back({component, ports.in});
    } else {
      shafts.push_back({component + ".in", ports.in});
      shafts.push_back({component + ".out", ports.out});
    }
  }
  return shafts;
}

std::string name_of_link(const Model& m) {
  const std::vector<NamedShaft> shafts = shafts_of(m);
  const auto link =
      std::find_if(shafts.begin(), shafts.end(), [&](const NamedShaft& s) { return s.node == m.reduction_node; });
  return link == shafts.end() ? m.node_label(m.reduction_node) : link->name;
}

Period figures_of_period(const ReturnMap& map, const SteadyPoint& point, double tolerance) {
  return CycleFigures(map, point, tolerance).collect();
}

}  // namespace kurbel
