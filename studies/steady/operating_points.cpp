// operating_points.cpp — intersections of the mean torques, starts from rest.
#include "studies/steady/operating_points.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "drivetrain/gears/gear_keys.h"
#include "engine/numerics/index.h"
#include "engine/numerics/roots.h"
#include "engine/run/run.h"
#include "engine/scene/units.h"
#include "engine/values/dense_tables.h"
#include "studies/validity/outside_data.h"

namespace kurbel {
namespace {

constexpr int scan_points = 250;              // over the rated range
constexpr int scan_points_moving = 100;       // where each torque is computed by the equations of motion
constexpr double scan_beyond = 1.25;          // of the rated speed
constexpr int most_doublings = 6;             // beyond that: it runs away
constexpr double rounding_of_tables = 1e-11;  // of the turnover: what tables of mechanisms leave of torques that cancel

std::string speed_text(const SpeedUnit& unit, double omega) { return unit.text(std::abs(omega), 5); }

}  // namespace

const OperatingPoint* OperatingDiagram::working_point() const {
  const OperatingPoint* fastest = nullptr;
  for (const OperatingPoint& p : points)
    if (p.stable()) fastest = &p;
  return fastest;
}

void OperatingDiagram::become_estimate() {
  estimate = true;
  strongest.error.reset();
  for (OperatingPoint& point : points) point.speed.error.reset(), point.torque.error.reset();
}

std::string OperatingDiagram::why_none(const std::string& link) const {
  if (working_point() || estimate) return {};
  const auto least =
      std::max_element(curve.begin(), curve.end(), [](const auto& a, const auto& b) { return a.net() < b.net(); });
  if (std::abs(least->net()) <= balance_error)
    return fmt::format(
        "the drive's mean torque on \"{}\" just balances the loads' at {} and falls behind at every other speed: "
        "mean torques do not decide whether the machine keeps that speed",
        link, speed_text(speed_unit, least->omega));
  if (least->net() < 0 && strongest.value <= balance_error)
    return fmt::format(
        "stall: nothing drives \"{}\": the drive's mean torque is {} at every speed, and the loads' is not", link,
        strongest.value < -balance_error ? "negative" : "zero");
  MeanTorques nearest = *least;
  // Between the speeds of the curve the drive may be stronger, beside loads that hardly change there.
  const auto after =
      std::find_if(curve.begin() + 1, curve.end(), [&](const auto& m) { return m.omega >= strongest_at; });
  if (after != curve.end()) {
    const MeanTorques& before = *(after - 1);
    const double part = (strongest_at - before.omega) / (after->omega - before.omega);
    const double load = before.load + part * (after->load - before.load);
    if (strongest.value - load > nearest.net())
      nearest.omega = strongest_at, nearest.drive = strongest.value, nearest.load = load;
  }
  if (least->net() < 0)
    return fmt::format(
        "stall: at every speed the loads' mean torque on \"{}\" exceeds the drive's, at the least by {} ({} against {} "
        "at {}){}. {}",
        link, with_unit(-nearest.net(), "N*m", 4), with_unit(nearest.load, "N*m", 5),
        with_unit(nearest.drive, "N*m", 5), speed_text(speed_unit, nearest.omega),
        nearest.omega == strongest_at
            ? std::string()
            : fmt::format("; the drive gives at most {} (at {})", with_unit(strongest.value, "N*m", 5),
                          speed_text(speed_unit, strongest_at)),
        brakes.empty() ? "A stronger drive, a higher ratio, or a lighter load is needed"
                       : fmt::format("These loads include {}, which is on", brakes));
  const MeanTorques& last = curve.back();
  if (last.net() > 0)
    return fmt::format(
        "runaway: up to {} the drive's mean torque on \"{}\" exceeds the loads', there still by {} ({} against {}); "
        "nothing up to there ends the acceleration. A load that grows with speed, or a drive that weakens with it, is "
        "needed",
        speed_text(speed_unit, last.omega), link, with_unit(last.net(), "N*m", 4), with_unit(last.drive, "N*m", 5),
        with_unit(last.load, "N*m", 5));
  return fmt::format(
      "no stable operating point: where the mean torques on \"{}\" meet, the drive's rises faster with speed than the "
      "loads'",
      link);
}

namespace {

// Errors from twice as many intervals at the same speed; the error of the speed is the residual of the balance over
// its slope. `within`: relative error of dense tables.
void measure_errors(const MeanTorques& here, const MeanTorques& finer, double within, OperatingPoint& point) {
  const double slope = std::abs(point.drive_slope - point.load_slope),
               rounding = 1e-14 * std::abs(here.load) + within * here.turnover;
  point.speed.error = slope > 0 ? (std::abs(finer.net() - here.net()) + rounding) / slope : 0;
  point.torque.error = std::abs(finer.load - here.load) + std::abs(point.load_slope) * *point.speed.error + rounding;
}

std::string brakes_of(const Network& network) {
  std::set<std::string> names;
  for (const Network::ShaftElement& e : network.elements)
    if (network.kind_of(e.component) == "brake") names.insert('"' + e.component + '"');
  return fmt::format("{}", fmt::join(names, ", "));
}

double error_of(MeanCharacteristic& finer, const MeanTorques& mean, double within) {
  return std::abs(finer.at(mean.omega).net() - mean.net()) + (rounding_of_tables + within) * mean.turnover;
}

}  // namespace

OperatingDiagram operating_diagram(RigidMachine& machine, int direction, const LossyMachine& lossy) {
  OperatingDiagram result;
  result.speed_unit = machine.model().scene.speed_unit;
  result.direction = direction;
  result.uses_speed = machine.uses_speed();
  if (machine.model().commands.empty()) result.brakes = brakes_of(machine.model().network);
  MeanCharacteristic mean(machine, direction, 1, lossy), finer(machine, direction, 2, lossy);
  const double rated = machine.model().speed_scale,
               step = scan_beyond * rated / (lossy.model ? scan_points_moving : scan_points);
  const int points = lossy.model ? scan_points_moving : scan_points;
  for (int i = 0; i <= points; ++i) result.curve.push_back(mean.at(i == 0 ? 1e-6 * rated : i * step));
  const bool known = !lossy.model || (lossy.model->internal_states.empty() &&
                                      std::all_of(result.curve.begin(), result.curve.end(),
                                                  [](const MeanTorques& m) { return std::isfinite(m.net()); }));
  if (!known) {
    result = operating_diagram(machine, direction);
    result.become_estimate();
    return result;
  }
  for (int i = 0; i < most_doublings && result.uses_speed && result.curve.back().net() > 0; ++i) {
    const double from = std::abs(result.curve.back().omega);
    for (int k = 1; k <= 20; ++k) result.curve.push_back(mean.at(from * (1 + k / 20.0)));
  }
  MeanTorques strongest = *std::max_element(result.curve.begin(), result.curve.end(),
                                            [](const auto& a, const auto& b) { return a.drive < b.drive; });
  // Breakdown torque between the scanned points: golden section.
  const double best = std::abs(strongest.omega);
  const Maximum highest =
      find_maximum([&](double w) { return mean.at(w).drive; }, std::max(best - step, 1e-6 * rated), best + step, 40);
  if (const MeanTorques peak = mean.at(highest.at); peak.drive > strongest.drive) strongest = peak;
  constexpr double left_by_golden_section = 1e-9;
  result.strongest_at = strongest.omega;
  result.strongest = estimate_from(strongest.drive, finer.at(strongest.omega).drive,
                                   left_by_golden_section * std::abs(strongest.drive));
  const auto greatest =
      std::max_element(result.curve.begin(), result.curve.end(), [](auto& a, auto& b) { return a.net() < b.net(); });
  const double within = left_by_tables(machine.model().scene), error = error_of(finer, result.curve.back(), within);
  // Losses by inertia torques depend on the speed, too.
  if (lossy.model && std::any_of(result.curve.begin(), result.curve.end(), [&](const MeanTorques& m) {
        return std::abs(m.net() - result.curve.back().net()) > 10 * error + 1e-9 * m.turnover;
      }))
    result.uses_speed = true;
  result.balance_error = result.uses_speed ? error_of(finer, *greatest, within) : error;
  if (!result.uses_speed) return result;  // parallel lines: they meet nowhere, or everywhere
  for (std::size_t i = 0; i + 1 < result.curve.size(); ++i) {
    const double n0 = result.curve[i].net(), n1 = result.curve[i + 1].net();
    if (n0 == 0 || (n0 > 0) == (n1 > 0)) continue;
    const double w = find_root([&](double x) { return mean.at(x).net(); }, std::abs(result.curve[i].omega), n0,
                               std::abs(result.curve[i + 1].omega), n1);
    const MeanTorques here = mean.at(w);
    OperatingPoint point{{here.omega}, {here.load}};
    const double h = std::min(1e-5 * rated, 0.1 * w);
    const MeanTorques below = mean.at(w - h), above = mean.at(w + h);
    point.drive_slope = (above.drive - below.drive) / (2 * h);
    point.load_slope = (above.load - below.load) / (2 * h);
    point.beyond_data = table_left_at(machine.model(), here.omega) != nullptr;
    if (!point.beyond_data) measure_errors(here, finer.at(here.omega), within, point);
    constexpr double rounding = 1e-12;  // what a load stores it gives back
    if (std::abs(here.load) <= rounding * here.turnover) point.torque.value = 0;
    result.points.push_back(point);
  }
  return result;
}

bool is_switched(const Network& network) {
  return std::any_of(network.elements.begin(), network.elements.end(), [](const Network::ShaftElement& e) {
    return e.window.start > Window{}.start || e.window.stop < Window{}.stop;
  });
}

namespace {

class SpeedLog final : public Observer {
 public:
  void begin(double t, std::span<const double> y, Equations& e) override { see(e.snapshot(t, y), t, e.model()); }
  void step(StepView& view) override { see(view.snapshot(view.t()), view.t(), view.equations().model()); }
  std::vector<double> t, w;

 private:
  void see(const Snapshot& s, double time, const Model& m) {
    const int node = m.reduction_node;
    t.push_back(time);
    w.push_back(m.gain_of_node[at(node)] * s.now.speed[m.shaft_of_node[at(node)]]);
  }
};

double link_start_angle(const Model& m) {
  const StartSettings& start = m.scene.run.start;
  const int on = start.on.empty() ? m.reduction_node : m.network.ports.at(start.on).in;
  return start.angle / m.node_ratio[at(on)];
}

}  // namespace

StartRun start_from_rest(const std::shared_ptr<const Model>& rigid, double target, double limit,
                         const std::atomic<bool>* interrupted, int node, bool with_error) {
  Equations equations(rigid, false);
  const Model& m = *rigid;
  StartSettings settings{};
  settings.angle = link_start_angle(m);
  if (node < 0) node = m.reduction_node;
  const double gain = m.gain_of_node[at(node)];
  const double scale = m.speed_scale * m.scale_ratio[at(node)];
  const std::size_t speed = equations.speed_index(m.shaft_of_node[at(node)]);
  RunOptions run{
      .tolerance = 1e-9, .method = "auto", .until = limit, .budget = 20, .interrupted = interrupted, .progress = {}};
  run.from = {0, equations.start(0, settings)};
  run.stop = [=](double, std::span<const double> y) {
    return (std::abs(target) - std::copysign(1.0, target) * gain * y[speed]) / scale;
  };
  SpeedLog log;
  const RunOutcome outcome = integrate(equations, run, {&log});
  StartRun result{outcome.stopped, {outcome.t}, std::move(log.t), std::move(log.w), outcome.diagnosis};
  if (result.reached && with_error) {
    run.tolerance *= 100;
    run.from = {0, equations.start(0, settings)};
    result.time =
        estimate_from(outcome.t, integrate(equations, run, {}).t, (1e-12 + left_by_tables(m.scene)) * outcome.t);
  }
  if (result.reached || !result.why.empty()) return result;
  constexpr double at_rest = 1e-6;  // of the speed scale
  const double then = result.w.back() * m.node_ratio[at(node)];
  result.falls_short = true;
  result.why = fmt::format(
      "from rest \"{}\" does not reach {} within {}; it then {}", m.node_label(node),
      speed_text(m.scene.speed_unit, target), with_unit(limit, "s", 4),
      std::abs(then) < at_rest * scale ? "stands still" : "turns at " + speed_text(m.scene.speed_unit, then));
  return result;
}

namespace {

// Gears of one component: its ideal joints.
std::vector<std::size_t> gears_of(const Network& net, const std::string& component) {
  std::vector<std::size_t> joints;
  for (std::size_t j = 0; j < net.joints.size(); ++j)
    if (net.joints[j].component == component && !net.joints[j].element) joints.push_back(j);
  return joints;
}

class RatioTrial {
 public:
  RatioTrial(const Network& network, const Scene& scene, const Effects& effects, std::string gearbox, double target,
             double limit, const std::atomic<bool>* interrupted)
      : network_(network),
        scene_(scene),
        effects_(effects),
        gearbox_(std::move(gearbox)),
        target_(target),
        limit_(limit),
        interrupted_(interrupted) {
    const auto model = compile_network(network_, scene, effects_);
    node_ = network_.ports.at(gearbox_).out;
    target_ *= model->node_ratio[at(node_)];
    present_ = ratio_of(*model);
    can_change_ = !gears_of(network_, gearbox_).empty() && turns_with(1.01 * present_);
  }
  // A stage whose ratio can be changed: none if all have losses or elastic teeth, if losses join the gearbox's ends
  // directly, or if a closed loop of shafts determines it.
  bool has_gears() const { return can_change_; }
  double present() const { return present_; }
  // Start time with another ratio of the last stage; HUGE_VAL: never reached.
  double operator()(double ratio) {
    const auto model = compile_network(with(ratio), scene_, effects_);
    const StartRun run = start_from_rest(model, target_, limit_, interrupted_, node_, false);
    const double time = run.reached ? run.time.value : HUGE_VAL;
    tried_.emplace_back(ratio, time);
    return time;
  }
  std::vector<std::pair<double, double>> tried() {
    std::sort(tried_.begin(), tried_.end());
    return tried_;
  }

 private:
  Network with(double ratio) const {
    Network net = network_;
    net.joints[gears_of(net, gearbox_).back()].ratio *= ratio / present_;
    return net;
  }
  double ratio_of(const Model& m) const {
    const Network::Ports ports = network_.ports.at(gearbox_);
    return std::abs(m.node_ratio[at(ports.in)] / m.node_ratio[at(ports.out)]);
  }
  bool turns_with(double ratio) const try {
    return std::abs(ratio_of(*compile_network(with(ratio), scene_, effects_)) - ratio) < 1e-6 * ratio;
  } catch (const SceneError&) {
    return false;
  }

  const Network& network_;
  const Scene& scene_;
  const Effects& effects_;
  std::string gearbox_;
  double target_, limit_;
  const std::atomic<bool>* interrupted_;
  double present_ = 1;
  bool can_change_ = false;
  int node_ = 0;
  std::vector<std::pair<double, double>> tried_;
};

constexpr int coarse_ratios = 25;  // from an eighth to eight times the present ratio
constexpr int fine_ratios = 22;    // steps of the golden section, to 1e-5 of the ratio

}  // namespace

std::vector<RatioSearch> fastest_ratios(const Scene& scene, const Effects& effects, double target, double limit,
                                        const std::atomic<bool>* interrupted) {
  std::vector<RatioSearch> found;
  const Network network = build_network(scene);
  for (const auto& [gearbox, gears] : network.data.all<GearStages>()) {
    RatioTrial trial(network, scene, effects, gearbox, target, limit, interrupted);
    if (!trial.has_gears()) continue;
    RatioSearch search{gearbox, trial.present(), 0, 0, 0, {}, {}, false};
    const double reached = trial(trial.present());
    search.present_time = std::isfinite(reached) ? reached : 0;
    int best = -1;
    std::vector<double> ratio, time;
    for (int i = 0; i < coarse_ratios && !(interrupted && interrupted->load()); ++i) {
      ratio.push_back(trial.present() * std::pow(8.0, 2.0 * i / (coarse_ratios - 1) - 1));
      time.push_back(trial(ratio.back()));
      if (best < 0 || time.back() < time[at(best)]) best = i;
    }
    if (best < 0 || !std::isfinite(time[at(best)])) continue;
    const double a = std::log(ratio[at(std::max(best - 1, 0))]);
    const double b = std::log(ratio[at(std::min(best + 1, static_cast<int>(ratio.size()) - 1))]);
    const auto quickness = [&](double logarithm) { return -trial(std::exp(logarithm)); };
    if (!(interrupted && interrupted->load())) find_maximum(quickness, a, b, fine_ratios);
    search.at_bound = best == 0 || best + 1 == static_cast<int>(ratio.size());
    search.best_time = HUGE_VAL;
    for (const auto& [r, t] : trial.tried()) {
      if (!std::isfinite(t)) continue;
      search.ratio.push_back(r);
      search.time.push_back(t);
      if (t < search.best_time) search.best_time = t, search.best = r;
    }
    found.push_back(std::move(search));
  }
  return found;
}

}  // namespace kurbel
