// remedies.cpp — the value of a key that just holds, by a power law through what was computed so far.
#include "studies/trials/remedies.h"

#include <cmath>
#include <limits>

#include "engine/scene/quantity_place.h"
#include "studies/limits/ratings.h"
#include "studies/variants/variant_runs.h"

namespace kurbel {
namespace {

constexpr int most_values = 4;
constexpr double worse_by = 0.01;

const Verdict* worst_to_mend(const std::vector<Verdict>& verdicts) {
  const Verdict* worst = nullptr;
  for (const Verdict& v : verdicts)
    if (v.state() == Compliance::exceeded && v.remedy && !v.remedy->tried && (!worst || v.share() > worst->share()))
      worst = &v;
  return worst;
}

class Search {
 public:
  Search(const Result& run, const Verdict& verdict, SimulateOptions options)
      : run_(run), verdict_(verdict), runs_(without_errors(std::move(options)), run.cpu_total) {}

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
  static SimulateOptions without_errors(SimulateOptions options) {
    options.measure_error = options.keep_state = false;
    return options;
  }
  double share_of(const Verdict& v) const { return (v.value + verdict_.error) / v.limit; }

  // A bore stays in proportion to its diameter. Not a number: that machine has no such verdict.
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
  VariantRuns runs_;
};

}  // namespace

void try_remedies(Result& run, const SimulateOptions& options) {
  if (!run.complete || !run.model || run.model->scene.run.model != "reduced" || !options.go_on_from.empty()) return;
  const std::vector<Verdict> verdicts = judge_ratings(run);
  if (const Verdict* verdict = worst_to_mend(verdicts))
    run.remedies_tried[name_of_remedy(*verdict)] = Search(run, *verdict, options).value();
}

}  // namespace kurbel
