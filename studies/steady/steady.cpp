// steady.cpp — from operating point to return map to figures, for every model asked for.
#include "studies/steady/steady.h"

#include <fmt/format.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <utility>

#include "engine/numerics/deadline.h"
#include "engine/numerics/index.h"
#include "engine/scene/units.h"
#include "studies/findings/figure_text.h"
#include "studies/findings/report.h"
#include "studies/findings/trace.h"

namespace kurbel {
namespace {

constexpr double map_tolerance = 1e-12, looser_tolerance = 1e-10;
constexpr double enough = 1e-11;         // residual of the map, over the rated values
constexpr double neutral_within = 1e-6;  // of 1
constexpr double far_beyond = 30;        // rated speeds: that is no cycle but flight

std::string rpm(double omega) { return with_unit(omega * 30 / std::numbers::pi, "rpm", 5); }

// A constant torque beside the drive; it sets no scale, so that all members of a search are measured alike.
struct AddedTorque {
  static constexpr Account account = Account::driving;
  double value = 0;  // [N·m]
  template <class T>
  T torque(const ShaftState<T>&) const {
    return T(value);
  }
  bool uses_time() const { return false; }
  bool uses_speed() const { return false; }
  Rated rated() const { return {}; }
};

// Elements of one component that drive together.
struct Drive {
  std::string component;
  std::vector<std::size_t> elements;
  double torque(const Snapshot& s) const {
    double sum = 0;
    for (const std::size_t e : elements) sum += s.sums.element_torque[e];
    return sum;
  }
};

std::vector<Drive> drives_of(const Model& model) {
  std::vector<Drive> drives;
  for (std::size_t e = 0; e < model.network.elements.size(); ++e) {
    const Network::ShaftElement& element = model.network.elements[e];
    if (element.element->account() != Account::driving) continue;
    const auto known =
        std::find_if(drives.begin(), drives.end(), [&](const Drive& d) { return d.component == element.component; });
    if (known != drives.end()) {
      known->elements.push_back(e);
    } else {
      drives.push_back({element.component, {e}});
    }
  }
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
      const int node = m.network.elements[drive.elements.front()].node;
      const double torque = m.torque_scale / m.scale_ratio[at(node)];
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

struct NamedShaft {
  std::string name;
  int node;
};
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

// Extremes over one round: speeds of all shafts first, two each, then torques, forces and accelerations.
std::vector<ExtremeOf> wanted_of(const Model& m) {
  std::vector<ExtremeOf> wanted;
  for (const NamedShaft& shaft : shafts_of(m)) {
    const int s = m.shaft_of_node[at(shaft.node)];
    const double gain = m.gain_of_node[at(shaft.node)];
    ExtremeOf speed{.name = "max_speed." + shaft.name,
                    .unit = "rad/s",
                    .scale = m.speed_scale * m.scale_ratio[at(shaft.node)],
                    .which = ExtremeOf::Which::maximum,
                    .value = [=](const Snapshot& x) { return gain * x.now.speed[s]; },
                    .rate = [=](const Snapshot& x) { return gain * x.alpha[s]; }};
    wanted.push_back(speed);
    speed.name = "min_speed." + shaft.name;
    speed.which = ExtremeOf::Which::minimum;
    wanted.push_back(std::move(speed));
  }
  for (ExtremeOf& e : extremes_of(m))
    if (!e.name.starts_with("max_speed.") && !e.name.starts_with("min_speed.")) wanted.push_back(std::move(e));
  for (Drive& drive : drives_of(m))
    wanted.push_back({.name = "peak_drive_torque." + drive.component,
                      .unit = "N*m",
                      .scale = m.torque_scale,
                      .value = [drive = std::move(drive)](const Snapshot& s) { return drive.torque(s); },
                      .rate = {}});
  return wanted;
}

// All that is told of one round of a fixed point.
struct Round {
  std::vector<Figure> figures;
  std::vector<ShaftFluctuation> shafts;
  std::vector<MotorUse> motors;
  double work_residual = 0;
  std::string failed;
};

class RoundFigures {
 public:
  RoundFigures(const ReturnMap& map, const SteadyPoint& point, double tolerance)
      : map_(map),
        m_(map.model()),
        extremes_(wanted_of(m_)),
        equations_(map.shared_model(), true),
        drives_(equations_, drives_of(m_)) {
    RunOptions run{.tolerance = tolerance,
                   .method = "auto",
                   .until = map.start_time() + point.time * (map.periodicity().by_time ? 1 : 1.5),
                   .budget = 60,
                   .interrupted = nullptr,
                   .progress = {}};
    std::vector<double> y = map.place(equations_, point.z);
    run.stop = map.round_end(equations_, y);
    y.resize(drives_.size(), 0.0);
    run.from = {map.start_time(), y};
    run.extension = &drives_;
    outcome_ = integrate(equations_, run, {&extremes_});
  }

  Round collect() {
    if (!outcome_.diagnosis.empty()) return {{}, {}, {}, 0, outcome_.diagnosis};
    add_speeds();
    add_torques();
    add_works();
    add_drives();
    return std::move(round_);
  }

 private:
  void add(const std::string& name, double value, const std::string& unit, double scale) {
    round_.figures.push_back({name, value, unit, {}, {}, scale, 0});
  }
  void add_speeds() {
    const double time = outcome_.t - map_.start_time();
    add("cycle_time", time, "s", time);
    const std::vector<NamedShaft> shafts = shafts_of(m_);
    for (std::size_t i = 0; i < shafts.size(); ++i) {
      ShaftFluctuation f{shafts[i].name, m_.node_ratio[at(shafts[i].node)], extremes_.found()[2 * i].value,
                         extremes_.found()[2 * i + 1].value};
      if (shafts[i].node == m_.reduction_node) {
        add("mean_speed." + f.shaft, f.mean(), "rad/s", m_.speed_scale);
        add("max_speed." + f.shaft, f.max, "rad/s", m_.speed_scale);
        add("min_speed." + f.shaft, f.min, "rad/s", m_.speed_scale);
      }
      add("delta." + f.shaft, f.delta(), "", 1);
      round_.shafts.push_back(std::move(f));
    }
  }
  void add_torques() {
    for (std::size_t i = 2 * shafts_of(m_).size(); i < extremes_.wanted().size(); ++i)
      if (extremes_.found()[i].any) {
        const ExtremeOf& wanted = extremes_.wanted()[i];
        add(wanted.name, extremes_.found()[i].value, wanted.unit,
            wanted.scale > 0 ? wanted.scale : std::abs(extremes_.found()[i].value));
      }
    const double time = outcome_.t - map_.start_time();
    for (std::size_t i = 0; i < m_.torque_joints.size(); ++i)
      add("rms_torque." + m_.torque_joints[i].component,
          std::sqrt(std::max(0.0, outcome_.state[equations_.square_index(i, false)]) / time), "N*m",
          m_.torque_joints[i].torque_scale);
  }
  void add_drives() {
    const double time = outcome_.t - map_.start_time();
    const std::vector<Drive> drives = drives_of(m_);
    const std::size_t first = extremes_.wanted().size() - drives.size();
    for (std::size_t i = 0; i < drives.size(); ++i) {
      const double* const sums = outcome_.state.data() + drives_.begin() + 2 * i;
      MotorUse use{drives[i].component,
                   std::sqrt(std::max(0.0, sums[1]) / time),
                   sums[0] / time,
                   extremes_.found()[first + i].value,
                   {}};
      if (const Section* section = m_.scene.find(use.component)) {
        if (section->has("rated_torque")) use.rated = section->number("rated_torque");
        if (section->has("rated_power") && section->has("rated_speed"))
          use.rated = section->number("rated_power") / section->number("rated_speed");
      }
      add("mean_drive_torque." + use.component, use.mean, "N*m", m_.torque_scale);
      add("rms_drive_torque." + use.component, use.rms, "N*m", m_.torque_scale);
      round_.motors.push_back(std::move(use));
    }
  }
  // Over a steady cycle all works add up to nothing.
  void add_works() {
    double sum = 0, turnover = 0;
    for (const Account kind : {Account::driving, Account::useful, Account::harmful, Account::weight}) {
      double of_kind = 0;
      for (std::size_t a = 0; a < m_.accounts.size(); ++a)
        if (m_.accounts[a].kind == kind) of_kind += outcome_.state[equations_.work_index(a)];
      sum += of_kind;
      turnover += std::abs(of_kind);
      add(fmt::format("{}_work_per_cycle", name_of(kind)), of_kind, "J", m_.torque_scale * 2 * std::numbers::pi);
    }
    for (std::size_t a = 0; a < m_.accounts.size(); ++a)
      if (const double work = outcome_.state[equations_.work_index(a)]; work != 0)
        add(fmt::format("work_per_cycle.{} ({})", m_.accounts[a].name, name_of(m_.accounts[a].kind)), work, "J",
            m_.torque_scale * 2 * std::numbers::pi);
    round_.work_residual = std::abs(sum) / std::max(turnover, 1e-6 * m_.torque_scale * map_.periodicity().angle);
  }

  const ReturnMap& map_;
  const Model& m_;
  ExtremeRecorder extremes_;
  Equations equations_;
  DriveQuadratures drives_;
  RunOutcome outcome_;
  Round round_;
};

// (ω_max + ω_min)/2 of the link over a round, as an observer.
class LinkSpeed {
 public:
  explicit LinkSpeed(const Model& m) : recorder_(wanted(m)) {}
  Observer* observer() { return &recorder_; }
  double mean() const { return 0.5 * (recorder_.found()[0].value + recorder_.found()[1].value); }

 private:
  static std::vector<ExtremeOf> wanted(const Model& m) {
    std::vector<ExtremeOf> both;
    for (ExtremeOf& e : extremes_of(m))
      if (e.name.starts_with("max_speed.") || e.name.starts_with("min_speed.")) both.push_back(std::move(e));
    return both;
  }
  ExtremeRecorder recorder_;
};

// One model of the study.
class Search {
 public:
  Search(const Scene& scene, const Effects& effects, const SteadyStudy& study, const SteadyOptions& options)
      : scene_(scene), effects_(effects), study_(study), options_(options) {
    std::vector<std::string> switched;
    network_ = always_on(scene, switched);
  }

  SteadyCycle run() {
    const double begin = processor_time();
    out_.effects = effects_.describe();
    if (options_.mean_speed) {
      at_speed(*options_.mean_speed);
    } else {
      freely();
    }
    if (out_.found) describe();
    out_.cpu_seconds = processor_time() - begin;
    return std::move(out_);
  }

 private:
  ReturnMapOptions map_options(double tolerance) const {
    return {.tolerance = tolerance,
            .method = scene_.run.method == "work" ? "auto" : scene_.run.method,
            .cycles = options_.periods,
            .budget = scene_.run.budget,
            .interrupted = options_.interrupted};
  }

  void prepare(std::shared_ptr<const Model> model) {
    if (!model->own_states.empty())
      throw std::invalid_argument(
          fmt::format("the {} of \"{}\" is a state that the steady cycle does not look for; switch its effect off, or "
                      "simulate long enough with kurbel run",
                      model->own_states.front().state.name, model->own_states.front().component));
    map_ = std::make_unique<ReturnMap>(model, map_options(map_tolerance));
    out_.model = std::move(model);
    out_.label = out_.model->elastic.empty() ? "rigid" : "elastic";
    out_.periodicity = map_->periodicity();
    out_.unknowns = map_->size();
    out_.cost_limit = 6 * (static_cast<double>(map_->size()) + 1) * options_.periods;
  }

  // Speeds to begin at: the operating point, then faster ones for machines that stop at the first load.
  std::vector<double> guesses() const {
    if (study_.diagram)
      if (const OperatingPoint* point = study_.diagram->working_point())
        return {point->mean.omega, 1.15 * point->mean.omega, 0.9 * point->mean.omega};
    const Model& m = *out_.model;
    const StartSettings& start = m.scene.run.start;
    const int on = start.on.empty() ? m.reduction_node : m.network.ports.at(start.on).in;
    const double speed = start.speed / m.node_ratio[at(on)];
    if (speed != 0) return {speed, std::copysign(m.speed_scale, speed)};
    return {m.speed_scale, 0.7 * m.speed_scale};
  }

  void freely() {
    prepare(compile_network(network_, scene_, effects_));
    for (const double speed : guesses()) {
      const ReturnMap::Image guess = map_->approach(speed);
      out_.end = guess.end;
      out_.why = guess.why;
      if (guess.end == ReturnMap::End::interrupted) break;
      if (guess.end != ReturnMap::End::returned) continue;
      out_.point = find_steady(*map_, guess.z, enough);
      out_.found = out_.point.found;
      out_.why = out_.point.why;
      out_.end = out_.point.end;
      if (out_.found || out_.end == ReturnMap::End::interrupted) break;
    }
    out_.cost = map_->cost();
    if (out_.found && out_.point.z.cwiseAbs().maxCoeff() > far_beyond) {
      out_.found = false;
      out_.why = fmt::format("runaway: the search for a cycle flees beyond {} times the rated speed", far_beyond);
    }
  }

  // --- a mean speed is demanded: the drive's torque is one more unknown ---

  // The driving component that takes the added torque; without one, the link.
  void choose_drive() {
    const Network& net = network_;
    added_node_ = compile_network(net, scene_, effects_)->reduction_node;
    added_to_ = net.nodes[at(added_node_)].component;
    for (const Network::ShaftElement& e : net.elements)
      if (e.element->account() == Account::driving && e.element->cycle() == 0) {
        added_node_ = e.node;
        added_to_ = e.component;
        return;
      }
  }
  std::shared_ptr<const Model> model_with(double torque) const {
    Network net = network_;
    net.put(added_node_, added_to_, AddedTorque{torque});
    return compile_network(std::move(net), scene_, effects_);
  }

  // Unknowns: z and the added torque; residuals: P(z) − z and the miss of the mean speed, whose derivatives come from
  // rounds beside, as it hangs on two peaks.
  void at_speed(double speed) {
    choose_drive();
    prepare(model_with(first_torque(speed)));
    if (out_.periodicity.by_time)
      throw std::invalid_argument(
          "--mean-speed: time drives this machine (a prescribed speed or a torque over time), so its mean speed is not "
          "free; drop the option");
    unit_ = out_.model->torque_scale / out_.model->scale_ratio[at(added_node_)];
    ReturnMap::Image guess;
    for (const double faster : {1.0, 1.2, 1.5}) {  // a machine that just stops at its load's peak
      guess = map_->approach(faster * speed);
      if (guess.end == ReturnMap::End::returned || guess.end == ReturnMap::End::interrupted) break;
    }
    cost_ = map_->cost();
    out_.end = guess.end;
    out_.why = guess.why;
    if (guess.end != ReturnMap::End::returned) return;
    Eigen::VectorXd x(guess.z.size() + 1);
    x << guess.z, first_torque(speed) / unit_;
    const NewtonOutcome newton = solve(system_at(speed), x, enough);
    out_.point.rounds = newton.rounds;
    out_.point.derivatives = newton.derivatives;
    out_.point.residual = newton.residual;
    out_.end = image_.end;
    if (newton.found) return settle(newton.x);
    out_.why = image_.end != ReturnMap::End::returned
                   ? image_.why
                   : fmt::format("no added torque was found with which \"{}\" turns at {} in the mean: {}",
                                 out_.model->node_label(out_.model->reduction_node), rpm(speed), newton.why);
    if (image_.end == ReturnMap::End::returned) out_.end = ReturnMap::End::failed;
  }

  bool round(const Eigen::VectorXd& x, double speed, bool with_derivative, Eigen::VectorXd& residual) {
    const Eigen::Index n = x.size() - 1;
    ReturnMap map(model_with(x[n] * unit_), map_options(map_tolerance));
    map.follow(*map_);
    LinkSpeed link(map.model());
    image_ = map.image(x.head(n), with_derivative, {link.observer()});
    cost_ += map.cost();
    if (image_.end != ReturnMap::End::returned) return false;
    residual.resize(n + 1);
    residual << image_.z - x.head(n), (link.mean() - speed) / std::abs(speed);
    return true;
  }

  NewtonSystem system_at(double speed) {
    NewtonSystem system;
    system.evaluate = [this, speed](const Eigen::VectorXd& x, Eigen::VectorXd& residual, Eigen::MatrixXd* derivative) {
      if (!derivative) return round(x, speed, false, residual);
      const Eigen::Index n = x.size() - 1;
      constexpr double step = 1e-5;
      Eigen::MatrixXd beside(n + 1, n + 1);
      for (Eigen::Index j = 0; j <= n; ++j) {
        Eigen::VectorXd value;
        if (!round(x + step * Eigen::VectorXd::Unit(n + 1, j), speed, false, value)) return false;
        beside.col(j) = value;
      }
      if (!round(x, speed, true, residual)) return false;
      *derivative = (beside.colwise() - residual) / step;
      derivative->topLeftCorner(n, n) = image_.derivative - Eigen::MatrixXd::Identity(n, n);
      return true;
    };
    system.stopped = [this] { return image_.end == ReturnMap::End::interrupted; };
    system.derivative_cost = 2 * static_cast<double>(map_->size()) + 2;
    return system;
  }
  // What the loads' mean torque leaves for the drive to add [N·m, on the drive's shaft].
  double first_torque(double speed) const {
    if (!study_.diagram) return 0;
    RigidMachine machine(compile_network(network_, scene_, rigid_effects()));
    const double net = MeanCharacteristic(machine, speed < 0 ? -1 : 1).at(speed).net();
    return -net / machine.model().node_ratio[at(added_node_)];
  }
  void settle(const Eigen::VectorXd& x) {
    const double torque = x[x.size() - 1] * unit_;
    auto settled = std::make_unique<ReturnMap>(model_with(torque), map_options(map_tolerance));
    settled->follow(*map_);
    map_ = std::move(settled);
    out_.model = map_->shared_model();
    out_.point.take(x.head(x.size() - 1), image_);
    out_.found = true;
    out_.point.cost = out_.cost = cost_;
    out_.cost_limit = 6 * (static_cast<double>(map_->size()) + 2) * options_.periods;
    out_.added_torque = torque;
    out_.added_at = added_to_;
  }

  // --- figures ---

  void describe() {
    out_.section = map_->section();
    out_.cycle_time = out_.point.time;
    out_.stability = stability_text(out_.point.multipliers, &out_.halving);
    out_.neutral = std::abs(out_.point.largest() - 1) < neutral_within;
    Round fine = RoundFigures(*map_, out_.point, map_tolerance).collect();
    if (!fine.failed.empty()) {
      out_.found = false;
      out_.why = fine.failed;
      return;
    }
    measure_errors(fine);
    out_.figures = std::move(fine.figures);
    out_.shafts = std::move(fine.shafts);
    out_.motors = std::move(fine.motors);
    out_.work_residual = fine.work_residual;
    if (options_.traces) follow();
  }

  // The same search with looser tolerances; what it finds otherwise is the error. A member of a family is kept as it
  // is: there the looser search would settle beside it.
  void measure_errors(Round& fine) {
    ReturnMap loose(out_.model, map_options(looser_tolerance));
    loose.follow(*map_);
    SteadyPoint point = out_.point;
    if (!out_.neutral && !options_.mean_speed) point = find_steady(loose, out_.point.z, enough * 100);
    if (!point.found) return;
    const Round other = RoundFigures(loose, point, looser_tolerance).collect();
    for (Figure& f : fine.figures)
      for (const Figure& g : other.figures)
        if (f.name == g.name) {
          f.error =
              std::max(std::abs(f.value - g.value), 8 * std::numeric_limits<double>::epsilon() * std::abs(f.value));
          // Below what the steps resolve of the rated quantity nothing is told from zero.
          if (std::abs(f.value) <= map_tolerance * f.scale) f.error = std::max(*f.error, std::abs(f.value));
        }
  }

  // Two rounds, so that one whole cycle from the link's zero is among them.
  void follow() {
    Equations equations(out_.model, true);
    TraceRecorder traces(*out_.model);
    const std::vector<double> y = map_->place(equations, out_.point.z);
    RunOptions run{.tolerance = 1e-9,
                   .method = "auto",
                   .until = map_->start_time() + 2.05 * out_.point.time * (map_->periodicity().by_time ? 1 : 1.5),
                   .budget = 60,
                   .interrupted = options_.interrupted,
                   .progress = {}};
    run.from = {map_->start_time(), y};
    run.stop = map_->round_end(equations, y, 2.05);
    integrate(equations, run, {&traces});
    out_.traces = traces.traces();
  }

  const Scene& scene_;
  Effects effects_;
  const SteadyStudy& study_;
  const SteadyOptions& options_;
  Network network_;
  std::unique_ptr<ReturnMap> map_;
  SteadyCycle out_;
  int added_node_ = 0;
  std::string added_to_;
  double cost_ = 0, unit_ = 1;  // unit_: of the added torque [N·m]
  ReturnMap::Image image_;
};

// --- the study ---

// Steady motion of a family: constant drive torque and loads of the angle alone.
std::string family_text(const OperatingDiagram& d, double cycle, const std::string& link) {
  const double net = d.curve.back().net();
  const double scale = std::max({std::abs(d.curve.back().drive), std::abs(d.curve.back().load), 1e-300});
  const std::string why = fmt::format(
      "no torque of this machine depends on the speed, so no speed is preferred: what a cycle gains or loses is the "
      "same "
      "at every speed of \"{}\"",
      link);
  if (std::abs(net) <= 1e-9 * scale)
    return fmt::format(
        "{}, here nothing. Steady motion is a family of cycles, one for every mean speed (multiplier exactly 1); say "
        "which one: --mean-speed \"60 rpm\"",
        why);
  return fmt::format(
      "{}, here {} of {} ({} driving, {} resisting): it {} for ever, and there is no steady cycle. The drive torque "
      "that a steady cycle of a given speed needs is found with --mean-speed \"60 rpm\"",
      why, net > 0 ? "a gain" : "a loss", with_unit(std::abs(net) * cycle, "J", 4),
      with_unit(d.curve.back().drive, "N*m", 5), with_unit(d.curve.back().load, "N*m", 5),
      net > 0 ? "accelerates" : "slows down");
}

class Study {
 public:
  Study(const Scene& scene, const std::vector<Effects>& effects, const SteadyOptions& options)
      : scene_(scene), effects_(effects), options_(options) {
    bool transients = false;
    for (Effects& e : effects_) transients = std::exchange(e.transients, false) || transients;
    if (!scene_.sequence.steps.empty()) {
      scene_.sequence = {};
      out_.notes.push_back("the operating sequence is left out: steady motion knows no switching");
    }
    if (transients)
      out_.notes.push_back("motors count by their static characteristics: their currents are no unknowns here");
    if (scene.effects.joint_clearance || scene.effects.flexible_rod)
      out_.notes.push_back(fmt::format("the rigid cycle has ideal joints and a rigid rod: {} left out",
                                       !scene.effects.flexible_rod      ? "joint clearance is"
                                       : !scene.effects.joint_clearance ? "the flexible rod is"
                                                                        : "joint clearance and flexible rod are"));
  }

  SteadyStudy run() {
    rigid_ = compile_network(always_on(scene_, switched_), scene_, rigid_effects());
    out_.title = scene_.title.empty() ? scene_.file : scene_.title;
    out_.scene_file = scene_.file;
    out_.link = rigid_->node_label(rigid_->reduction_node);
    out_.mean_speed = options_.mean_speed;
    for (const std::string& name : switched_)
      out_.notes.push_back(fmt::format("\"{}\" is taken as always on: steady motion knows no switching", name));
    find_diagram();
    refuse_family();
    for (const Effects& effects : effects_) find_cycle(effects);
    if (options_.start_search && out_.complete) find_start();
    conclude();
    return std::move(out_);
  }

 private:
  void progress(const std::string& what, double fraction) const {
    if (options_.progress) options_.progress(what, fraction);
  }
  void log(const std::string& text) const {
    if (options_.log) options_.log(text);
  }

  void find_diagram() {
    if (rigid_->free_shafts != 1) {
      out_.no_diagram = "a speed is prescribed: the drive gives whatever torque that needs";
      return;
    }
    const Periodicity periodicity = periodicity_of(*rigid_);
    if (periodicity.by_time || periodicity.settled_from > 0) {
      out_.no_diagram = "a torque depends on time: angle and speed alone do not tell the mean torques";
      return;
    }
    progress("operating points", 0);
    RigidMachine machine(rigid_);
    out_.diagram = operating_diagram(machine, sense());
    log(fmt::format("operating points: {} of {} speeds scanned", out_.diagram->points.size(),
                    out_.diagram->curve.size()));
  }
  int sense() const {
    const double speed = options_.mean_speed.value_or(scene_.run.start.speed);
    const StartSettings& start = scene_.run.start;
    const int on =
        start.on.empty() || options_.mean_speed ? rigid_->reduction_node : rigid_->network.ports.at(start.on).in;
    return speed / rigid_->node_ratio[at(on)] < 0 ? -1 : 1;
  }
  void refuse_family() const {
    if (out_.diagram && !out_.diagram->uses_speed && !options_.mean_speed)
      throw std::invalid_argument(family_text(*out_.diagram, periodicity_of(*rigid_).angle, out_.link));
  }

  // Steady motion is that of the machine coupled: clutches locked, brakes released.
  void find_cycle(const Effects& effects) {
    const bool stopped = options_.interrupted && options_.interrupted->load();
    if (stopped) return incomplete("interrupted");
    progress("steady cycle with effects: " + effects.describe(), 0);
    Effects running = effects;
    running.locked = true;
    SteadyCycle cycle = Search(scene_, running, out_, options_).run();
    log(fmt::format(
        "{}: {} unknowns; {} after {} rounds, {} with derivative; cost {:.1f} cycles, {:.0f} aimed at; "
        "residual {:.1e}; {:.3g} ms",
        cycle.label, cycle.unknowns, cycle.found ? "found" : "not found: " + cycle.why, cycle.point.rounds,
        cycle.point.derivatives, cycle.cost, cycle.cost_limit, cycle.point.residual, 1e3 * cycle.cpu_seconds));
    if (!cycle.found) {
      cycle.why = diagnose(cycle);
      incomplete(cycle.end == ReturnMap::End::interrupted
                     ? "interrupted"
                     : fmt::format("no steady cycle ({}): {}", cycle.label, cycle.why));
    }
    out_.cycles.push_back(std::move(cycle));
  }
  void incomplete(const std::string& why) {
    out_.complete = false;
    if (out_.diagnosis.empty()) out_.diagnosis = why;
  }

  // The mean torques tell why there can be none; else what the machine did.
  std::string diagnose(const SteadyCycle& cycle) const {
    if (cycle.end == ReturnMap::End::interrupted || !out_.diagram || options_.mean_speed) return cycle.why;
    if (const std::string none = out_.diagram->why_none(out_.link); !none.empty()) return none;
    const OperatingPoint& p = *out_.diagram->working_point();
    if (cycle.end == ReturnMap::End::stands || cycle.end == ReturnMap::End::turns_back ||
        cycle.end == ReturnMap::End::too_slow)
      return fmt::format(
          "stall within the cycle: in the mean the drive would hold {} ({}), but {}: neither the drive nor what is "
          "stored "
          "in the flywheel overcomes the load's peak there. More inertia, or a drive with a steeper characteristic, is "
          "needed",
          rpm(p.mean.omega), with_unit(p.mean.load, "N*m", 4), cycle.why);
    return cycle.why;
  }

  // Several times what the mean torques would need; where they do not suffice, what the rated torque would.
  double start_limit(double target) const {
    RigidMachine machine(rigid_);
    const double inertia = machine.constant_inertia() + machine.mechanism_inertia(1).value;
    double time = 0;
    const std::vector<MeanTorques>& curve = out_.diagram->curve;
    for (std::size_t i = 0; i + 1 < curve.size() && std::abs(curve[i + 1].omega) < target; ++i) {
      const double net = std::min(curve[i].net(), curve[i + 1].net());
      if (net <= 0) return 100 * inertia * target / rigid_->torque_scale;
      time += inertia * std::abs(curve[i + 1].omega - curve[i].omega) / net;
    }
    return 5 * time;
  }

  void find_start() {
    const SteadyCycle* rigid = nullptr;
    for (const SteadyCycle& c : out_.cycles)
      if (c.found && c.model->elastic.empty()) rigid = &c;
    if (!rigid || !out_.diagram || options_.mean_speed) return;
    const double target = 0.95 * rigid->find("mean_speed." + out_.link)->value;
    const double limit = start_limit(std::abs(target)) + 20 * rigid->cycle_time;
    progress("start from rest", 0.5);
    out_.start = start_from_rest(rigid_, target, limit, options_.interrupted);
    const double search_limit = out_.start->reached ? 4 * out_.start->time : limit;
    out_.ratios = fastest_ratios(scene_, target, search_limit, options_.interrupted);
  }

  void conclude() {
    if (!out_.complete) {
      out_.conclusion = out_.diagnosis;
      return;
    }
    std::string text;
    for (const SteadyCycle& c : out_.cycles) {
      const Figure* mean = c.find("mean_speed." + out_.link);
      const Figure* delta = c.find("delta." + out_.link);
      text += fmt::format("{}{}: mean speed {}, δ = {}, {}", text.empty() ? "Steady cycle, " : "; ", c.label,
                          with_error(mean->value * 30 / std::numbers::pi, scaled(mean->error), "rpm"),
                          with_error(delta->value, delta->error, ""), c.stability);
      if (options_.mean_speed)
        text +=
            fmt::format(", with {} {} than the scene's drive at \"{}\"", with_unit(std::abs(c.added_torque), "N*m", 6),
                        c.added_torque < 0 ? "less" : "more", c.added_at);
    }
    out_.conclusion = text + ".";
  }
  static std::optional<double> scaled(const std::optional<double>& error) {
    return error ? std::optional(*error * 30 / std::numbers::pi) : std::nullopt;
  }

  Scene scene_;  // without its operating sequence
  std::vector<Effects> effects_;
  const SteadyOptions& options_;
  std::vector<std::string> switched_;
  std::shared_ptr<const Model> rigid_;
  SteadyStudy out_;
};

}  // namespace

const Figure* SteadyCycle::find(const std::string& name) const {
  const auto found = std::find_if(figures.begin(), figures.end(), [&](const Figure& f) { return f.name == name; });
  return found == figures.end() ? nullptr : &*found;
}

std::string stability_text(const std::vector<std::complex<double>>& multipliers, std::optional<double>* halving) {
  if (halving) halving->reset();
  const std::complex<double> slowest = multipliers.empty() ? 0 : multipliers.front();
  const double size = std::abs(slowest);
  const char* swinging = std::abs(slowest.imag()) > 1e-9 * size || slowest.real() < -1e-9 ? ", swinging" : "";
  if (std::abs(size - 1) < neutral_within)
    return "neutral: a deviation neither fades nor grows (multiplier 1), the cycle is one of a family";
  if (size > 1)
    return fmt::format("unstable: a deviation doubles in {:.3g} cycles{}", std::log(2.0) / std::log(size), swinging);
  if (size < 1e-3)
    return fmt::format("stable: a cycle leaves less than {:.0e} of any deviation", std::max(size, 1e-12));
  const double cycles = std::log(2.0) / -std::log(size);
  if (halving) *halving = cycles;
  return fmt::format("stable: the slowest deviation halves in {:.3g} cycles{}", cycles, swinging);
}

SteadyStudy steady(const Scene& scene, const std::vector<Effects>& effects, const SteadyOptions& options) {
  const Deadline deadline(scene.run.budget);
  return Study(scene, effects, options).run();
}

}  // namespace kurbel
