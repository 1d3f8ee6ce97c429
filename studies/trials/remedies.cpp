// remedies.cpp — the value of a key that just suffices, by a power law through the values computed so far.
#include "studies/trials/remedies.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/scene/quantity_place.h"
#include "studies/limits/ratings.h"
#include "studies/variants/variant_runs.h"

namespace kurbel {
namespace {

constexpr int most_values = 4;
constexpr double worse_by = 0.01;

// Exceeded verdicts with a remedy by a key, in descending order of excess.
std::vector<const Verdict*> to_mend(const std::vector<Verdict>& verdicts) {
  std::vector<const Verdict*> list;
  for (const Verdict& v : verdicts)
    if (v.state() == Compliance::exceeded && v.remedy && !v.remedy->tried) list.push_back(&v);
  std::stable_sort(list.begin(), list.end(),
                   [](const Verdict* a, const Verdict* b) { return a->share() > b->share(); });
  return list;
}

class Search {
 public:
  // All searches share one allowance of time.
  Search(const Result& run, const Verdict& verdict, VariantRuns& runs) : run_(run), verdict_(verdict), runs_(runs) {}

  // Not finite: none was found.
  double value() const {
    Scene scene = run_.model->scene;
    const Setting* setting = quantity_at(scene.components, verdict_.remedy->key);
    if (!setting || !(setting->number > 0)) return nan;
    const double given = setting->number, from = share_of(verdict_);
    double value = verdict_.remedy->value;
    const double worse = value > given ? 1 - worse_by : 1 + worse_by;
    for (int k = 0; k < most_values && !runs_.over(); ++k) {
      const double share = share_with(value);
      if (share <= 1 && share_with(worse * value) > 1) return value;
      const double power = std::log(share / from) / std::log(value / given);
      if (!(power * (value - given) < 0)) return nan;  // it does not get better that way
      value *= std::pow(share, -1 / power);
      value = value > given ? enough(value) : -enough(-value);
    }
    return nan;
  }

 private:
  static constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  double share_of(const Verdict& v) const { return (v.value + verdict_.known_error()) / v.limit; }

  // A bore stays in proportion to its diameter. NaN: that machine has no such verdict.
  double share_with(double value) const {
    Scene scene = run_.model->scene;
    const std::string& key = verdict_.remedy->key;
    Setting& setting = *quantity_at(scene.components, key);
    if (key.ends_with(".diameter"))
      if (Setting* bore = quantity_at(scene.components, key.substr(0, key.rfind('.')) + ".bore"))
        bore->number *= value / setting.number;
    setting.number = value;
    const VariantRun varied = runs_.run("remedy", scene, run_.model->effects);
    if (varied.failed.empty())
      for (const Verdict& v : judge_ratings(varied.result))
        if (v.component == verdict_.component && v.requirement == verdict_.requirement) return share_of(v);
    return nan;
  }

  const Result& run_;
  const Verdict& verdict_;
  VariantRuns& runs_;
};

}  // namespace

void try_remedies(Result& run, const SimulateOptions& options) {
  if (!run.complete || !run.model || run.model->scene.run.model != "reduced" || !options.go_on_from.empty()) return;
  SimulateOptions without_errors = options;
  without_errors.measure_error = without_errors.keep_state = false;
  VariantRuns runs(without_errors, run.cpu_total);
  const std::vector<Verdict> verdicts = judge_ratings(run);
  for (const Verdict* verdict : to_mend(verdicts))
    if (!runs.over()) run.remedies_tried[name_of_remedy(*verdict)] = Search(run, *verdict, runs).value();
}

}  // namespace kurbel
