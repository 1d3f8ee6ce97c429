// accuracy.cpp — the study of accuracy from its levels to its judgement, step by step.
#include "studies/accuracy/accuracy.h"

#include <fmt/format.h>

#include "studies/accuracy/accuracy_work.h"

namespace kurbel {

AccuracyStudy measure_accuracy(const Scene& scene, const AccuracyOptions& options) {
  AccuracyWork work(scene, options);
  AccuracyStudy& study = work.study;
  make_levels(work);
  if (work.levels.empty()) {
    study.break_off("no level of the scene runs to its end: " + work.last_diagnosis);
    study.findings = {study.diagnosis};
    return std::move(study);
  }
  study.fullest = work.levels.size() - 1;
  follow_figures(work);
  climb_ladder(work);
  for (const LevelAtWork& level : work.levels) study.levels.push_back(level.reported);
  study.notes = work.levels[study.fullest].reference.notes;
  add_energy_method(work);
  add_multibody(work);
  fill_model_errors(study);
  study.seconds = work.spent();
  if (work.interrupted()) study.break_off("interrupted");
  judge_accuracy(study, options);
  return std::move(study);
}

std::string AccuracyStudy::name_of(const MeasuredSetting& s) const {
  const std::string& level = levels[s.level].name;
  return s.tolerance > 0 ? fmt::format("{}, {} at {:.0e}", level, s.method, s.tolerance) : level;
}

}  // namespace kurbel
