// agreement_of_modes.cpp — what `modes` reports of vibrations, held against vibrations of the settled run.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <stdexcept>

#include "engine/base/find_by.h"
#include "engine/numerics/deadline.h"
#include "engine/numerics/index.h"
#include "studies/modes/modes.h"
#include "tests/agreement/agreement.h"
#include "tests/agreement/forced_vibration.h"
#include "tests/agreement/free_vibration.h"

namespace kurbel::agreement {
namespace {

constexpr double left_by_runs = 1e-5;      // of a frequency, of the largest torque
constexpr double left_of_ratio = 1e-4;     // of the damping ratio, as a number: where it is small, runs show no more
constexpr double most_stated = 0.05;       // of a figure: what is stated as more makes it reported, not agreed
constexpr std::size_t judged = 3;          // frequencies, from the lowest on
constexpr double well_measured = 0.02;     // of a frequency: what is known less well is not judged
constexpr double least_share = 0.1;        // of twists in the energy, about half in a vibration: less is another motion
constexpr double vibrates_below = 0.7071;  // damping ratio: above, nothing is largest at any frequency
constexpr double whole = 1e-3;             // how far an order may be from one of the period's
constexpr std::size_t most_harmonics = 400;

// --- what the study reports, under one roof: the only place that knows its names ---

struct ReportedMode {
  double omega = 0, decay = 0, error = 0;
  double least = 1, greatest = 1;  // with the link held at angles of the cycle, over the one reported
  double natural() const { return std::hypot(omega, decay); }
  double ratio() const { return natural() > 0 ? decay / natural() : 1; }
};
std::vector<ReportedMode> reported_modes(const ModesStudy& study) {
  std::vector<ReportedMode> list;
  for (const DampedMode& damped : study.damped) {
    if (damped.lambda.imag() <= 0) continue;
    ReportedMode reported{damped.lambda.imag(), -damped.lambda.real(), damped.error};
    const auto* const mode = find_by(study.modes, &Mode::lambda, damped.lambda);
    if (mode && mode->only_of_mean) continue;
    // Where coefficients change with the angle, exponents are reported of the vibration; the mean's is beside them.
    if (mode && !mode->periodic.empty()) {
      for (const PeriodicMode& s : mode->periodic) {
        reported = {s.exponent.imag(), -s.exponent.real(), s.error};
        if (mode->fades_within_cycle)
          reported.least = mode->least / mode->omega, reported.greatest = mode->greatest / mode->omega;
        list.push_back(reported);
      }
      continue;
    }
    if (mode && mode->omega > 0 && mode->greatest > 0)
      reported.least = std::min(1.0, mode->least / mode->omega),
      reported.greatest = std::max(1.0, mode->greatest / mode->omega);
    list.push_back(reported);
  }
  std::sort(list.begin(), list.end(), [](const ReportedMode& a, const ReportedMode& b) { return a.omega < b.omega; });
  return list;
}

// At the operating point: of the steady motion where there is one, else of the linear drive.
struct ReportedTorque {
  double greatest = 0, least = 0;
  double linear_greatest = 0, linear_least = 0;
  std::vector<double> amplitude;  // per multiple of an order, from 1 on; [0] is none
};
struct ReportedTorques {
  std::map<std::string, ReportedTorque> joints;
  double order = 1;    // of the first amplitude
  double highest = 0;  // order that is reported
};
ReportedTorques reported_torques(const ModesStudy& study) {
  const SpeedResponse& said = study.cycle ? *study.cycle : study.here;
  ReportedTorques reported;
  reported.order = study.cycle ? study.cycle_order : study.excitations.fundamental;
  reported.highest = study.highest_order;
  for (std::size_t j = 0; j < said.joints.size() && j < study.joint_names.size(); ++j) {
    ReportedTorque torque{
        said.joints[j].upper, said.joints[j].lower, study.here.joints[j].upper, study.here.joints[j].lower, {}};
    if (j < said.orders.size())
      for (const Complex& order : said.orders[j]) torque.amplitude.push_back(std::abs(order));
    reported.joints[study.joint_names[j]] = std::move(torque);
  }
  return reported;
}

// ---------------------------------------------------------------------------------------------------------------------

// Names of the model's elastic joints, as `modes` gives them: numbered where a component has several.
std::vector<std::string> joint_names(const Model& m) {
  std::map<std::string, int> total, seen;
  for (const ElasticJoint& e : m.elastic) ++total[m.network.joints[at(e.joint)].component];
  std::vector<std::string> names;
  for (const ElasticJoint& e : m.elastic) {
    const std::string& name = m.network.joints[at(e.joint)].component;
    names.push_back(total[name] == 1 ? name : fmt::format("{}.{}", name, ++seen[name]));
  }
  return names;
}

class ModesComparison {
 public:
  ModesComparison(const Scene& scene, const SettleSettings& settings) : scene_(scene), settings_(settings) {}

  Row run() {
    const double begin = processor_time();
    const Effects effects = effects_of_modes(scene_);
    run_ = settle(scene_, effects, settings_);
    row_.kind = run_.kind;
    row_.orbit = run_.words;
    if (run_.kind == Motion::repeats && has_springs()) {
      free_ = free_vibrations_of(run_);
      if (!free_.measured) row_.orbit += "; swings are not measured: " + free_.why;
      harmonics_ = most_harmonics;
      forced_ = joint_vibrations_of(run_, harmonics_);
      ask(effects);
    }
    row_.cpu_seconds = processor_time() - begin;
    return std::move(row_);
  }

 private:
  bool has_springs() const {
    return std::any_of(run_.model->elastic.begin(), run_.model->elastic.end(),
                       [](const ElasticJoint& e) { return !e.slips && !e.springless; });
  }
  std::vector<Topic> topics() const {
    std::vector<Topic> topics;
    if (free_.measured) topics = {Topic::frequencies, Topic::damping};
    if (!forced_.empty()) topics.push_back(Topic::forced_peaks);
    if (!forced_.empty() && varies()) topics.push_back(Topic::forced_orders);
    return topics;
  }
  bool varies() const {
    return std::any_of(forced_.begin(), forced_.end(),
                       [](const JointVibration& s) { return s.greatest - s.least > 1e-6 * s.scale; });
  }
  void ask(const Effects& effects) {
    try {
      const ModesStudy study = find_modes(scene_, effects, {});
      if (free_.measured) judge_vibrations(study);
      judge_torques(study);
    } catch (const SceneError& error) {
      refuse(error.what());
    } catch (const std::invalid_argument& error) {
      refuse(error.what());
    } catch (const std::runtime_error& error) {
      refuse(error.what());
    }
  }
  void refuse(const std::string& why) {
    row_.figures.clear();
    for (const Topic topic : topics())
      row_.figures.push_back({topic, "", 0, 0, 0, Verdict::refused, why.empty() ? "no reason given" : why});
  }
  // What is omitted with a number, or a joint whose frequency depends on the amplitude, with that of the cycle as is.
  static bool reports(const ModesStudy& by) { return reports_how_much(by.notes) || !by.rattles.empty(); }
  // `stated`: what the study says that its figure may be off by.
  void compare(Topic topic, const std::string& figure, double run, double study, double allowed, double stated,
               const ModesStudy& by) {
    const double off = std::abs(run - study);
    const bool agrees = off <= allowed || (off <= allowed + stated && stated <= most_stated * std::abs(study));
    const Verdict verdict = agrees                                   ? Verdict::agrees
                            : off <= allowed + stated || reports(by) ? Verdict::reported
                                                                     : Verdict::silent;
    row_.figures.push_back({topic, figure, run, study, allowed + stated, verdict, {}});
  }

  // --- free vibrations ---

  std::vector<FreeVibration> seen() const {
    std::vector<FreeVibration> list;
    for (const FreeVibration& s : free_.list)
      if (s.omega_error < well_measured * s.natural() && s.share > least_share && s.ratio() < vibrates_below)
        list.push_back(s);
    return list;
  }
  static double apart(const FreeVibration& a, const ReportedMode& b) {
    return std::hypot(a.omega - b.omega, a.decay - b.decay);
  }
  void judge_vibrations(const ModesStudy& study) {
    const std::vector<FreeVibration> measured = seen();
    std::vector<ReportedMode> reported = reported_modes(study);
    for (std::size_t i = 0; i < std::min(judged, measured.size()); ++i) {
      const FreeVibration& m = measured[i];
      const auto nearest =
          std::min_element(reported.begin(), reported.end(),
                           [&](const ReportedMode& a, const ReportedMode& b) { return apart(m, a) < apart(m, b); });
      compare_mode(fmt::format("mode {} ({})", i + 1, m.joint), m,
                   nearest == reported.end() ? ReportedMode{} : *nearest, study);
    }
    // What is reported must be there, too, if it could be seen.
    std::erase_if(reported, [&](const ReportedMode& t) {
      return t.ratio() >= vibrates_below || t.omega > free_.fastest || t.decay > free_.shortest;
    });
    for (std::size_t i = 0; i < std::min(judged, reported.size()); ++i) {
      FreeVibration nearest;
      for (const FreeVibration& m : free_.list)
        if (nearest.omega == 0 || apart(m, reported[i]) < apart(nearest, reported[i])) nearest = m;
      if (nearest.omega_error > well_measured * nearest.natural()) continue;
      compare_mode(fmt::format("told mode {}", i + 1), nearest, reported[i], study);
    }
  }
  void compare_mode(const std::string& name, const FreeVibration& m, const ReportedMode& t, const ModesStudy& study) {
    constexpr double hz = 0.5 / std::numbers::pi;
    const double small = m.omega_error + t.error + left_by_runs * std::max(m.natural(), t.natural());
    const double stated = (m.omega > t.omega ? t.greatest - 1 : 1 - t.least) * t.natural();
    compare(Topic::frequencies, name + " [Hz]", hz * m.omega, hz * t.omega, hz * small, hz * stated, study);
    const double size = std::max({m.natural(), t.natural(), 1e-300});
    const double of_ratio = (m.decay_error + m.omega_error + t.error) / size + left_of_ratio;
    const double stated_ratio = std::max(t.greatest - 1, 1 - t.least) * t.ratio();
    compare(Topic::damping, name + " ζ", m.ratio(), t.ratio(), of_ratio, stated_ratio, study);
  }

  // --- forced vibrations ---

  void judge_torques(const ModesStudy& study) {
    const ReportedTorques reported = reported_torques(study);
    const std::vector<std::string> names = joint_names(*run_.model);
    for (const JointVibration& vibration : forced_) {
      const ElasticJoint& e = run_.model->elastic[vibration.elastic];
      if (e.slips || e.springless) continue;  // has no twist
      const std::string& name = names[vibration.elastic];
      const auto found = reported.joints.find(name);
      const ReportedTorque torque = found == reported.joints.end() ? ReportedTorque{} : found->second;
      const double allowed = vibration.extremes_error + left_by_runs * vibration.scale;
      compare(Topic::forced_peaks, name + " greatest", vibration.greatest, torque.greatest, allowed, 0, study);
      compare(Topic::forced_peaks, name + " least", vibration.least, torque.least, allowed, 0, study);
      if (!varies()) continue;
      judge_orders(name, vibration, torque, reported, study);
      // The linear drive's, with the difference that is reported beside it.
      compare(Topic::linear_peaks, name + " greatest, linear", vibration.greatest, torque.linear_greatest, allowed,
              std::abs(torque.greatest - torque.linear_greatest), study);
      compare(Topic::linear_peaks, name + " least, linear", vibration.least, torque.linear_least, allowed,
              std::abs(torque.least - torque.linear_least), study);
    }
  }
  // The order whose amplitude differs most.
  void judge_orders(const std::string& name, const JointVibration& vibration, const ReportedTorque& torque,
                    const ReportedTorques& reported, const ModesStudy& study) {
    const double turns = std::abs(run_.angle) / (2 * std::numbers::pi);
    if (run_.base != Base::angle && run_.base != Base::event && std::abs(turns - std::round(turns)) > whole) return;
    double most = -1, run = 0, of_study = 0, at_order = 0;
    for (std::size_t h = 1; h < vibration.harmonic.size(); ++h) {
      const double order = static_cast<double>(h) / turns, r = order / reported.order;
      if (order > reported.highest + whole) break;
      const auto multiple = static_cast<std::size_t>(std::round(r));
      const bool has = std::abs(r - std::round(r)) < whole && multiple < torque.amplitude.size();
      const double amplitude = has ? torque.amplitude[multiple] : 0, measured = std::abs(vibration.harmonic[h]);
      if (std::abs(measured - amplitude) <= most) continue;
      most = std::abs(measured - amplitude), run = measured, of_study = amplitude, at_order = order;
    }
    if (most < 0) return;
    compare(Topic::forced_orders, fmt::format("{} order {:.4g}", name, at_order), run, of_study,
            vibration.error + left_by_runs * vibration.scale, 0, study);
  }

  const Scene& scene_;
  SettleSettings settings_;
  SettledRun run_;
  FreeVibrations free_;
  std::vector<JointVibration> forced_;
  std::size_t harmonics_ = 0;
  Row row_;
};

}  // namespace

Row compare_modes(const Scene& scene, const SettleSettings& settings) { return ModesComparison(scene, settings).run(); }

}  // namespace kurbel::agreement
