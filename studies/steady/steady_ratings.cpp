// steady_ratings.cpp — the cycle's figures under the names of a run, assessed like those of a run.
#include "studies/steady/steady_ratings.h"

#include <algorithm>
#include <cmath>

#include "drivetrain/shared/rating_keys.h"
#include "studies/limits/ratings.h"

namespace kurbel {
namespace {

Figure renamed(const Figure& f, Name name) {
  Figure other = f;
  other.name = std::move(name.text), other.what = name.what, other.of = std::move(name.of);
  return other;
}

// For a rim at the largest speed of its shaft, with the relative error of the link's speed.
void add_rim_speeds(const SteadyCycle& c, Result& as_run) {
  const Figure* fastest = nullptr;
  for (const Figure& f : c.figures)
    if (f.what == quantities::cycle_max_speed) fastest = &f;
  for (const auto& [component, rating] : c.model->network.data.all<RimRating>()) {
    for (const ShaftFluctuation& shaft : c.shafts) {
      if (shaft.shaft != component) continue;
      const double speed = *rating.radius * std::max(std::abs(shaft.max), std::abs(shaft.min));
      Figure rim = Figure::of_name(Name::own("rim_speed", component), speed, "m/s");
      if (fastest && fastest->error && fastest->value != 0)
        rim.error = speed * *fastest->error / std::abs(fastest->value);
      as_run.figures.push_back(std::move(rim));
    }
  }
}

// Loads of joints in steady motion, by DIN 740-2 and the makers' stresses, as in `modes`: instead of verdicts on
// peaks only. The start is assessed by `modes` and `run`.
void add_loads(const SteadyCycle& c, std::vector<Verdict>& verdicts) {
  if (!c.loads.found) return;
  RunUp none;
  none.words = "kurbel modes judges the start, kurbel run the load cases of its run";
  const std::vector<LimitedJoint> joints = limited_joints(*c.model);
  const auto head = [](const Verdict& v) { return v.requirement.substr(0, v.requirement.find(':')); };
  for (Verdict& v : judge(joints, c.loads, none, {}, c.model->scene.speed_unit)) {
    const auto joint =
        std::find_if(joints.begin(), joints.end(), [&v](const LimitedJoint& j) { return j.name == v.component; });
    std::erase_if(verdicts, [&](const Verdict& other) {
      const bool same = other.component == v.component ||
                        (joint != joints.end() && other.component == joint->component);  // of its segments together
      return same && head(other) == head(v) && other.load_case == v.load_case;
    });
    verdicts.push_back(std::move(v));
  }
}

}  // namespace

std::vector<Verdict> steady_ratings(const SteadyCycle& c) {
  if (!c.found || !c.model) return {};
  Result as_run;
  as_run.model = c.model;
  as_run.errors_measured =
      std::any_of(c.figures.begin(), c.figures.end(), [](const Figure& f) { return f.error.has_value(); });
  for (const Figure& f : c.figures) {
    if (f.what == quantities::cycle_peak_torque)
      as_run.figures.push_back(renamed(f, Name::make(quantities::peak_torque, f.of)));
    if (f.words() == "greatest_torque" || f.words() == "least_torque") as_run.figures.push_back(f);
    if (f.what == quantities::rms_drive_torque)
      as_run.figures.push_back(renamed(f, Name::own("motor_rms_torque", f.of)));
  }
  add_rim_speeds(c, as_run);
  std::vector<Figure> strands = rating_figures(*c.model, nullptr, as_run.figures, 0, 0);
  for (Figure& strand : strands) {
    const Figure* peak = as_run.find(quantities::peak_torque, strand.of);
    // F = F₀ + |τ|/(2 r₁): its error is that of the torque, by the same slope.
    if (peak && peak->error && peak->value != 0) {
      std::vector<Figure> moved = {*peak};
      moved.front().value += std::copysign(*peak->error, peak->value);
      for (const Figure& other : rating_figures(*c.model, nullptr, moved, 0, 0))
        if (other.name == strand.name) strand.error = std::abs(other.value - strand.value);
    }
    as_run.figures.push_back(std::move(strand));
  }
  std::vector<Verdict> verdicts = judge_ratings(as_run, load_case::steady);
  add_loads(c, verdicts);
  return verdicts;
}

}  // namespace kurbel
