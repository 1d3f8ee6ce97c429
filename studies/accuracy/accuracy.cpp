// accuracy.cpp — levels, their references by two methods, and the ladder of methods and tolerances.
#include "studies/accuracy/accuracy.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>

#include "engine/numerics/deadline.h"
#include "engine/numerics/period.h"
#include "engine/rigid/work_equation.h"
#include "studies/run/simulate.h"

namespace kurbel {
namespace {

constexpr double not_known = std::numeric_limits<double>::quiet_NaN();
constexpr double reference_tolerance = 1e-13;
// A method whose trajectory is this near to what the references agree on has nothing more to gain.
constexpr double floor_is_reached = 2;

// A level at work.
struct Level {
  ModelLevel told;
  std::shared_ptr<const Model> model;
  std::shared_ptr<WorkTables> tables;   // null: the work equation does not apply
  Result reference;                     // of the first method
  double end_angle = 0, end_speed = 0;  // of the reduction link
};

// Angles count in rad, whatever was turned; speeds and twists over the largest that they reach.
bool is_state(const Channel& channel) {
  return channel.name.starts_with("angle.") || channel.name.starts_with("speed.") || channel.name.starts_with("twist.");
}

double trajectory_difference(const TrajectoryRecorder& a, const TrajectoryRecorder& reference) {
  if (a.time().size() != reference.time().size()) return HUGE_VAL;
  double largest = 0;
  for (std::size_t k = 0; k < a.channels().size(); ++k) {
    if (!is_state(a.channels()[k])) continue;
    double scale = 0, difference = 0;
    for (std::size_t row = 0; row < a.time().size(); ++row) {
      scale = std::max(scale, std::abs(reference.value(row, k)));
      difference = std::max(difference, std::abs(a.value(row, k) - reference.value(row, k)));
    }
    if (a.channels()[k].name.starts_with("angle.")) scale = 1;
    if (scale > 0) largest = std::max(largest, difference / scale);
  }
  return largest;
}

class AccuracyRun {
 public:
  AccuracyRun(const Scene& scene, const AccuracyOptions& options) : scene_(scene), options_(options) {
    scene_.run.model = "reduced";
    scene_.run.method = "auto";
    study_.title = scene.heading();
    study_.scene_file = scene.file;
    study_.scene_text = scene.text;
  }

  AccuracyStudy run() {
    begin_ = processor_time();
    choose_levels();
    for (Level& level : levels_) make_reference(level);
    std::erase_if(levels_, [](const Level& level) { return !level.reference.complete; });
    if (levels_.empty()) {
      study_.complete = false;
      study_.diagnosis = "no level of the scene runs to its end: " + last_diagnosis_;
      study_.findings = {study_.diagnosis};
      return std::move(study_);
    }
    study_.fullest = levels_.size() - 1;
    follow_figures();
    climb();
    for (const Level& level : levels_) study_.levels.push_back(level.told);
    add_energy_method();
    add_multibody();
    fill_model_errors();
    study_.seconds = processor_time() - begin_;
    study_.complete = !interrupted();
    if (!study_.complete) study_.diagnosis = "interrupted";
    judge_accuracy(study_, options_);
    return std::move(study_);
  }

 private:
  bool interrupted() const { return options_.interrupted && options_.interrupted->load(); }
  double spent() const { return processor_time() - begin_; }
  void log(const std::string& text) const {
    if (options_.log) options_.log(text);
  }
  void omit(const std::string& what, const std::string& why) {
    study_.omissions.push_back({what, why});
    log(fmt::format("left out: {}: {}", what, why));
  }

  SimulateOptions simulate_options(const std::string& method, double tolerance) const {
    SimulateOptions o;
    o.measure_error = false;
    o.method = method;
    o.accuracy = 10 * tolerance;  // a single run takes a tenth of the accuracy as its local tolerance
    o.interrupted = options_.interrupted;
    return o;
  }

  // --- levels ---

  void choose_levels() {
    add_level("rigid", {});
    Effects full = scene_.effects;
    if (full.describe() == "none") full.all_elastic = true;
    const auto model = compile(scene_, full);
    if (model->elastic.empty() && (full.joint_clearance || full.flexible_rod))
      omit("joint clearance and flexible rod", "the levels are those of ideal joints and a rigid rod");
    if (model->elastic.empty() && !full.joint_friction) {
      omit("elastic", "the scene has no coupling or shaft with a stiffness");
      return;
    }
    const std::string name = model->elastic.empty() ? "joint friction" : "elastic";
    if (model->elastic.size() > 1)
      add_lean(full, *model);
    else if (!model->elastic.empty())
      omit("elastic lean", "one elastic element only: the lean model is the full one");
    levels_.push_back({.told = {.name = name}, .model = model, .tables = {}, .reference = {}});
  }

  void add_level(const std::string& name, const Effects& effects) {
    levels_.push_back({.told = {.name = name}, .model = compile(scene_, effects), .tables = {}, .reference = {}});
  }

  // The one elastic element that alone comes nearest to the full model's peaks.
  void add_lean(const Effects& full, const Model& model) {
    const auto peaks = [&](const Effects& effects) {
      std::map<std::string, double> found;
      SimulateOptions o = simulate_options("auto", 1e-6);
      const Result r = simulate(scene_, effects, "", o);
      if (!r.complete) return found;
      for (const Figure& f : r.figures)
        if (f.name.starts_with("peak_torque.") || f.name.starts_with("delta.")) found[f.name] = f.value;
      return found;
    };
    const std::map<std::string, double> wanted = peaks(full);
    std::set<std::string> candidates;
    for (const ElasticJoint& e : model.elastic)
      candidates.insert(model.network.joints[static_cast<std::size_t>(e.joint)].component);
    constexpr std::size_t most_candidates = 8;
    if (candidates.size() > most_candidates) {
      omit("elastic lean", fmt::format("{} elastic elements are too many to try each alone", candidates.size()));
      return;
    }
    double nearest = HUGE_VAL;
    std::string best;
    Effects lean;
    for (const std::string& component : candidates) {
      Effects one = full;
      one.all_elastic = false;
      one.elastic = {component.substr(0, component.find('.'))};
      if (interrupted()) return;
      double difference = 0;
      try {
        const std::map<std::string, double> found = peaks(one);
        if (found.empty()) continue;
        for (const auto& [figure, value] : wanted)
          if (const auto f = found.find(figure); f != found.end() && value != 0)
            difference = std::max(difference, std::abs(f->second / value - 1));
      } catch (const SceneError&) {
        continue;
      }
      log(fmt::format("elastic in {} alone: peaks off by up to {:.2g}", component, difference));
      if (difference < nearest) nearest = difference, best = one.elastic.front(), lean = one;
    }
    if (best.empty()) return omit("elastic lean", "no single elastic element makes a model that runs");
    add_level("elastic: " + best, lean);
  }

  // --- references ---

  // Independent of each other: other variables (angle against time), another table, or another family.
  std::vector<std::string> reference_methods(const Level& level) const {
    std::vector<std::string> methods;
    if (level.tables) methods.push_back("work");
    for (const char* method : {"dop853", "verner6", "esdirk5"}) methods.push_back(method);
    return methods;
  }

  void make_reference(Level& level) {
    ModelLevel& told = level.told;
    told.effects = level.model->effects.describe();
    told.coordinates = level.model->free_shafts + level.model->twist_count();
    if (level.model->elastic.empty()) {
      if (const std::string why = WorkTables::refusal(level.model); !why.empty())
        omit(told.name + ", work equation", why);
      else
        level.tables = std::make_shared<WorkTables>(level.model);
    }
    std::vector<Result> found;
    for (const std::string& method : reference_methods(level)) {
      if (found.size() == 2 || interrupted()) break;
      progress(fmt::format("reference of {} by {}", told.name, method), 0);
      SimulateOptions o = simulate_options(method, reference_tolerance);
      o.budget = options_.time / 4;
      Result r = simulate(level.model, told.name, o);
      log(fmt::format("reference of {} by {}: {:.3g} s{}", told.name, method, r.statistics.cpu_seconds,
                      r.complete ? "" : "; " + r.diagnosis));
      if (!r.complete) {
        last_diagnosis_ = r.diagnosis;
        omit(fmt::format("{}, reference by {}", told.name, method), r.diagnosis);
        continue;
      }
      (found.empty() ? told.first : told.second) = method;
      found.push_back(std::move(r));
    }
    if (found.size() < 2) {
      level.reference.complete = false;
      omit(told.name, "no two methods give a reference that can be trusted");
      return;
    }
    told.tolerance = reference_tolerance;
    told.agreement = std::max(trajectory_difference(*found[1].trajectory, *found[0].trajectory), reference_tolerance);
    for (Figure& f : found[0].figures) {
      const Figure* other = found[1].find(f.name);
      f.error = (other ? std::abs(f.value - other->value) : not_known) + f.resolution;
    }
    level.reference = std::move(found[0]);
    const Model& m = *level.model;
    const std::string link = m.network.nodes[static_cast<std::size_t>(m.reduction_node)].component;
    if (const Figure* f = level.reference.find("final_angle." + link)) level.end_angle = f->value;
    if (const Figure* f = level.reference.find("final_speed." + link)) level.end_speed = f->value;
    log(fmt::format("{}: {} and {} agree to {:.1e}", told.name, told.first, told.second, told.agreement));
  }

  // --- figures ---

  // Peaks first, the largest one before all; then what else is asked of a machine, in this order.
  void follow_figures() {
    const Result& full = levels_[study_.fullest].reference;
    std::vector<const Figure*> peaks, others;
    const auto sound = [](const Figure& f) {
      return std::abs(f.value) > 1e-9 * std::max(f.scale, 1e-300) && f.error && std::isfinite(*f.error);
    };
    for (const Figure& f : full.figures)
      if (sound(f) && f.name.starts_with("peak_torque.")) peaks.push_back(&f);
    for (const char* prefix : {"delta.", "run_up_time", "final_angle.", "final_speed.", "max_speed.", "peak_force."})
      for (const Figure& f : full.figures)
        if (sound(f) && f.name.starts_with(prefix) && (!f.name.starts_with("final_") || is_of_link(f.name)))
          others.push_back(&f);
    std::stable_sort(peaks.begin(), peaks.end(),
                     [](const Figure* a, const Figure* b) { return std::abs(a->value) > std::abs(b->value); });
    if (peaks.size() > 3) peaks.resize(3);
    peaks.insert(peaks.end(), others.begin(), others.end());
    if (!options_.figure.empty()) {
      const Figure* asked = full.find(options_.figure);
      if (!asked) {
        std::string names;
        for (const Figure& f : full.figures) names += (names.empty() ? "" : ", ") + f.name;
        throw std::invalid_argument(
            fmt::format("--figure \"{}\": the scene yields no such figure; it yields {}", options_.figure, names));
      }
      std::erase(peaks, asked);
      peaks.insert(peaks.begin(), asked);
    }
    if (peaks.size() > 8) peaks.resize(8);
    for (const Figure* f : peaks) study_.figures.push_back({f->name, f->unit});
    for (Level& level : levels_)
      for (const FollowedFigure& followed : study_.figures) {
        const Figure* f = level.reference.find(followed.name);
        const bool sound = f && f->error && std::isfinite(*f->error) && f->value != 0;
        level.told.value.push_back(sound ? f->value : not_known);
        // Two runs may agree by luck: never below their tolerance.
        level.told.floor.push_back(sound ? std::max(*f->error / std::abs(f->value), reference_tolerance) : not_known);
      }
  }
  bool is_of_link(const std::string& name) const {
    const Model& m = *levels_.back().model;
    return name.substr(name.find('.') + 1) == m.network.nodes[static_cast<std::size_t>(m.reduction_node)].component;
  }

  // --- the ladder ---

  struct Climber {
    std::size_t level;
    std::string method;
    bool open = true;
    double last_cost = 0, growth = 2;  // of a whole rung [s], from rung to rung
  };

  std::vector<std::string> methods_for(const Level& level) {
    std::vector<std::string> methods = options_.methods;
    if (methods.empty())
      methods = {"work", "dopri5", "verner6", "dop853", "fehlberg8", "adams", "esdirk3", "esdirk", "esdirk5", "bdf"};
    if (!level.tables) std::erase(methods, "work");
    return methods;
  }

  // Loose tolerances of all before tight ones of any, so that a study cut short is still one of all methods.
  void climb() {
    std::vector<Climber> climbers;
    for (std::size_t i = 0; i < levels_.size(); ++i)
      for (const std::string& method : methods_for(levels_[i])) climbers.push_back({.level = i, .method = method});
    const double rung_limit = options_.time / 15;
    const double rungs = static_cast<double>(climbers.size() * options_.tolerances.size());
    double done = 0;
    for (const double tolerance : options_.tolerances)
      for (Climber& c : climbers) {
        done += 1;
        if (!c.open) continue;
        if (interrupted()) return;
        progress(fmt::format("{}, {} at {:.0e}", levels_[c.level].told.name, c.method, tolerance), done / rungs);
        const double expected = c.growth * c.last_cost;
        if (expected > rung_limit || spent() + expected > options_.time) {
          omit(fmt::format("{}, {} at {:.0e} and tighter", levels_[c.level].told.name, c.method, tolerance),
               fmt::format("would take some {:.2g} s of the study's {:g} s", expected, options_.time));
          c.open = false;
          continue;
        }
        const double before = spent();
        take_rung(c, tolerance);
        const double cost = spent() - before;
        if (c.last_cost > 0) c.growth = std::clamp(cost / c.last_cost, 1.2, 10.0);
        c.last_cost = cost;
      }
  }

  void take_rung(Climber& c, double tolerance) {
    Level& level = levels_[c.level];
    MeasuredSetting s;
    s.level = c.level;
    s.method = c.method;
    s.tolerance = tolerance;
    Result r;
    try {
      SimulateOptions o = simulate_options(c.method, tolerance);
      o.budget = options_.time / 15;
      r = simulate(level.model, level.told.name, o);
    } catch (const std::invalid_argument& refusal) {
      c.open = false;
      return omit(fmt::format("{}, {}", level.told.name, c.method), refusal.what());
    }
    if (!r.complete) {
      c.open = false;
      return omit(fmt::format("{}, {} at {:.0e} and tighter", level.told.name, c.method, tolerance), r.diagnosis);
    }
    const double difference = trajectory_difference(*r.trajectory, *level.reference.trajectory);
    s.trajectory_error = std::max(difference, level.told.agreement);
    measure_figures(s, level, [&](const std::string& name) {
      const Figure* f = r.find(name);
      return f ? f->value : not_known;
    });
    const StepperStatistics& counts = r.statistics.stepper;
    s.steps = counts.steps;
    s.rejected = counts.rejected;
    s.flow_calls = counts.flow_calls;
    s.jacobian_calls = counts.jacobian_calls;
    s.events = r.statistics.events;
    s.energy_drift = r.energy.relative;
    if (!time_runs(s, level)) {
      c.open = false;
      return;
    }
    study_.settings.push_back(s);
    // One more rung at the floor shows that it is one.
    if (difference <= floor_is_reached * level.told.agreement) c.open = false;
  }

  void measure_figures(MeasuredSetting& s, const Level& level,
                       const std::function<double(const std::string&)>& value) const {
    const ModelLevel& full = levels_[study_.fullest].told;
    for (std::size_t i = 0; i < study_.figures.size(); ++i) {
      const double v = value(study_.figures[i].name), reference = level.told.value[i];
      s.numerical_error.push_back(std::max(std::abs(v / reference - 1), level.told.floor[i]));
      s.total_error.push_back(std::max(std::abs(v / full.value[i] - 1), full.floor[i]));
      if (std::isnan(v) || std::isnan(reference)) s.numerical_error.back() = not_known;
      if (std::isnan(v)) s.total_error.back() = not_known;
    }
  }

  // The integration with its peaks and cycles, as a user needs it; without samples and the audit of the energy.
  bool time_runs(MeasuredSetting& s, const Level& level) const {
    std::vector<double> seconds;
    double sum = 0;
    const int least = 3;
    while (static_cast<int>(seconds.size()) < options_.most_repetitions &&
           (static_cast<int>(seconds.size()) < least || sum < 0.03)) {
      Equations equations(level.model, false);
      ExtremeRecorder extremes(extremes_of(*level.model));
      CycleRecorder cycles;
      RunOptions o{.tolerance = s.tolerance,
                   .method = s.method,
                   .until = level.model->scene.run.until,
                   .budget = options_.time,
                   .interrupted = options_.interrupted,
                   .progress = {},
                   .work_tables = level.tables};
      const RunOutcome outcome = integrate(equations, o, {&extremes, &cycles});
      if (!outcome.complete) return false;
      seconds.push_back(outcome.statistics.cpu_seconds);
      sum += seconds.back();
      if (sum > 1) break;
    }
    set_times(s, seconds);
    return true;
  }

  static void set_times(MeasuredSetting& s, std::vector<double> seconds) {
    std::sort(seconds.begin(), seconds.end());
    s.seconds = seconds[seconds.size() / 2];
    s.fastest = seconds.front();
    s.slowest = seconds.back();
    s.repetitions = static_cast<int>(seconds.size());
  }

  // --- levels with solvers of their own ---

  // A level that shares the rigid model's answer but yields the motion of the link alone.
  std::size_t motion_level(const std::string& name) {
    const Level& rigid = levels_.front();
    ModelLevel told = rigid.told;
    told.name = name;
    study_.levels.push_back(told);
    return study_.levels.size() - 1;
  }
  void add_motion(MeasuredSetting s, double angle, double speed) {
    const Level& rigid = levels_.front();
    const Model& m = *rigid.model;
    const std::string link = m.network.nodes[static_cast<std::size_t>(m.reduction_node)].component;
    const double difference =
        std::max(std::abs(angle - rigid.end_angle), std::abs(speed - rigid.end_speed) / m.speed_scale);
    s.trajectory_error = std::max(difference, rigid.told.agreement);
    measure_figures(s, rigid, [&](const std::string& name) {
      return name == "final_angle." + link ? angle : name == "final_speed." + link ? speed : not_known;
    });
    study_.settings.push_back(std::move(s));
  }

  // Motion from the work diagram: T(φ) = T₀ + A(φ), t = ∫dφ/ω. No tolerance, no steps.
  void add_energy_method() {
    const Level& rigid = levels_.front();
    if (!rigid.tables || rigid.told.name != "rigid") return;
    if (!rigid.tables->of_angle_alone())
      return omit("energy method", "a torque depends on the speed: the work done is not known beforehand");
    Equations equations(rigid.model, false);
    const std::vector<double> y = equations.start(0);
    const double omega = y[equations.speed_index(0)];
    const int direction = omega >= 0 ? 1 : -1;
    const double phi = equations.angle_with_turns(static_cast<std::size_t>(rigid.model->reduction_angle), y);
    const WorkOverAngle& diagram = rigid.tables->diagram(direction);
    const double s0 = place_within(direction * phi, diagram.cycle());
    WorkOverAngle::Motion end;
    std::vector<double> seconds;
    constexpr int many = 200;
    for (int i = 0; i < options_.most_repetitions; ++i) {
      const double before = processor_time();
      for (int k = 0; k < many; ++k) end = diagram.advance(s0, std::abs(omega), scene_.run.until);
      seconds.push_back((processor_time() - before) / many);
    }
    if (end.stalled) return omit("energy method", "the machine comes to rest, and the diagram ends there");
    MeasuredSetting s;
    s.level = motion_level("energy method");
    s.method = "work diagram";
    set_times(s, seconds);
    const double turned = static_cast<double>(end.cycles) * diagram.cycle() + end.s - s0;
    add_motion(std::move(s), phi + direction * turned, direction * end.speed);
  }
  std::string link_figure(const char* prefix) const {
    const Model& m = *levels_.front().model;
    return prefix + m.network.nodes[static_cast<std::size_t>(m.reduction_node)].component;
  }

  // Simbody's closed loop at every step, by its own integrators.
  void add_multibody() {
    const Level& rigid = levels_.front();
    if (!options_.multibody || rigid.told.name != "rigid") return;
    constexpr double seconds_per_turn = 0.004;  // at a loose accuracy, measured
    const double turns = std::abs(rigid.end_angle) / (2 * M_PI);
    Scene scene = scene_;
    scene.run.model = "multibody";
    std::shared_ptr<const Model> model;
    std::optional<std::size_t> level;
    for (const char* method : {"RungeKuttaMerson", "RungeKuttaFeldberg", "CPodes"}) {
      double expected = seconds_per_turn * turns, last = 0;
      for (const double tolerance : options_.tolerances) {
        if (interrupted() || tolerance < 1e-9) break;
        if (expected > options_.time / 6) {
          omit(fmt::format("multibody, {} at {:.0e} and tighter", method, tolerance),
               fmt::format("would take some {:.2g} s of the study's {:g} s", expected, options_.time));
          break;
        }
        progress(fmt::format("multibody, {} at {:.0e}", method, tolerance), 1);
        Result r;
        try {
          if (!model) model = compile(scene, Effects{});
          SimulateOptions o = simulate_options(method, tolerance);
          o.accuracy = tolerance;
          r = simulate(model, "multibody", o);
        } catch (const SceneError& refusal) {
          return omit("multibody", refusal.what());
        }
        if (!r.complete) {
          omit(fmt::format("multibody, {} at {:.0e} and tighter", method, tolerance), r.diagnosis);
          break;
        }
        if (!level) level = motion_level("multibody");
        MeasuredSetting s;
        s.level = *level;
        s.method = method;
        s.tolerance = tolerance;
        set_times(s, {r.statistics.cpu_seconds});
        s.steps = r.statistics.stepper.steps;
        s.rejected = r.statistics.stepper.rejected;
        s.flow_calls = r.statistics.stepper.flow_calls;
        s.energy_drift = not_known;
        expected = r.statistics.cpu_seconds * std::max(1.5, last > 0 ? r.statistics.cpu_seconds / last : 2);
        last = r.statistics.cpu_seconds;
        add_motion(std::move(s), figure_of(r, "final_angle."), figure_of(r, "final_speed."));
      }
    }
  }
  double figure_of(const Result& r, const char* prefix) const {
    const Figure* f = r.find(link_figure(prefix));
    return f ? f->value : not_known;
  }

  void fill_model_errors() {
    const ModelLevel full = study_.levels[study_.fullest];
    for (ModelLevel& level : study_.levels)
      for (std::size_t i = 0; i < study_.figures.size(); ++i)
        level.model_error.push_back(
            &level == &study_.levels[study_.fullest] ? 0 : std::abs(level.value[i] / full.value[i] - 1));
  }

  void progress(const std::string& what, double fraction) const {
    if (options_.progress) options_.progress(what, fraction);
  }

  Scene scene_;
  const AccuracyOptions& options_;
  std::vector<Level> levels_;
  AccuracyStudy study_;
  std::string last_diagnosis_;
  double begin_ = 0;
};

}  // namespace

AccuracyStudy measure_accuracy(const Scene& scene, const AccuracyOptions& options) {
  return AccuracyRun(scene, options).run();
}

std::string AccuracyStudy::name_of(const MeasuredSetting& s) const {
  const std::string& level = levels[s.level].name;
  return s.tolerance > 0 ? fmt::format("{}, {} at {:.0e}", level, s.method, s.tolerance) : level;
}

}  // namespace kurbel
