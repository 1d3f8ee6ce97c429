// advise.cpp — screens order the effects by estimated importance; runs decide.
#include "studies/advise/advise.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "engine/base/find_by.h"
#include "engine/scene/units.h"
#include "studies/advise/deviation.h"
#include "studies/dictionary/dictionary.h"
#include "studies/findings/figure_text.h"
#include "studies/validity/substitutes.h"

namespace kurbel {
namespace {

std::string in_percent(double deviation, double error) {
  constexpr double least = 1e-5;  // what is below it, nobody asks
  if (deviation + error < least) return fmt::format("less than {:g} %", 100 * least);
  return with_error({100 * deviation, 100 * error}, "%", 2);
}

constexpr std::ptrdiff_t tried_completely = 5;  // units: 2⁵ sets are run one and all
constexpr double held_out_step = 0.2;           // loads and speeds ± 20 %

// Sets whose work differs by less count as equally cheap; the one with fewer effects is taken.
constexpr double same_work = 0.97;

class Adviser {
 public:
  Adviser(const Scene& scene, const AdviseOptions& options)
      : scene_(scene), options_(options), runs_(VariantRuns::timed(options.simulate)) {}

  Advice run() {
    a_.is_of(scene_);
    a_.tolerance = options_.within;
    a_.figures = options_.figures;
    a_.units = effect_units(scene_);
    if (a_.units.empty())
      throw std::invalid_argument("this scene has parameters for no effect, so there is nothing to choose between");
    say("all effects", 0);
    all_ = fullest_set(scene_, a_.units);
    a_.full = must_run(all_, "full");
    a_.tried.push_back({{}, all_, describe(a_.units, all_)});
    set_cost(a_.tried.back(), a_.full);
    if (!a_.full.complete) {
      a_.break_off(a_.full.diagnosis);
      a_.conclusion = "The full model did not run to the end: " + a_.full.diagnosis;
      return std::move(a_);
    }
    if (a_.full.periods.steady) settled_ = settled(scene_, effects(all_), runs_.options().watch);
    check_figures();
    a_.screens = screens_of(scene_, a_.units, a_.full, options_.within);
    if (std::count(all_.begin(), all_.end(), true) <= tried_completely)
      try_all();
    else
      try_greedily();
    choose();
    run_again();
    judge_what_does_not_go_with_the_rest();
    hold_out();
    conclude();
    return std::move(a_);
  }

 private:
  void say(const std::string& what, double part) const { options_.simulate.watch.at(what, part); }
  void check_figures() const {
    for (const std::string& name : options_.figures) {
      const bool known = std::any_of(a_.full.figures.begin(), a_.full.figures.end(),
                                     [&](const Figure& f) { return is_asked_for(f.name, name); });
      if (known) continue;
      std::vector<std::string> names;
      for (const Figure& f : a_.full.figures) names.push_back(f.name);
      const std::string instead = stated_instead(name, names);
      throw std::invalid_argument(fmt::format(
          "--figures: no figure \"{}\"{}; see kurbel figures", name,
          instead.empty() ? suggestion(name, names) : fmt::format(" here; what is reported is \"{}\"", instead)));
    }
  }

  // --- runs ---
  Effects effects(const EffectSet& on) const { return effects_of(scene_, a_.units, on); }
  Result must_run(const EffectSet& on, const std::string& label) const {
    return simulate(scene_, effects(on), label, runs_.options());
  }
  // Null: it was not run.
  const TriedSet* known(const EffectSet& on) const { return find_by(a_.tried, &TriedSet::on, on); }
  const TriedSet& try_set(const EffectSet& on) {
    if (const TriedSet* before = known(on)) return *before;
    TriedSet set{{}, on, describe(a_.units, on)};
    say("with " + set.words, progress());
    const VariantRun run = runs_.run(set.words, scene_, effects(on));
    set.refused = run.failed;
    if (const Result& r = run.result; r.model) {
      set_cost(set, r);
      if (const std::vector<std::string> idle = idle_effects(*r.model); !idle.empty()) set.refused = idle.front();
      Deviation& by = set;
      by = judge(a_.full, r, options_.figures);
      if (by.within && set.refused.empty()) by = with_settled(by, settled_, scene_, on, options_.figures);
    }
    set.within = set.within && set.refused.empty();
    a_.tried.push_back(std::move(set));
    return a_.tried.back();
  }
  static void set_cost(TriedSet& set, const Result& r) {
    const StepperStatistics& s = r.statistics.stepper;
    set.size = size_of(*r.model);
    set.cpu_seconds = r.statistics.cpu_seconds;
    set.evaluations = s.flow_calls + s.jacobian_calls + s.factorisations;
  }
  Deviation judge(const Result& full, const Result& other, const std::vector<std::string>& figures) const {
    Deviation found = deviation_of(changes_between(full, other, figures), options_.within);
    // A figure missing in the reduced model counts as lost, unless it was not requested.
    for (const Figure& f : full.figures)
      if (is_asked_for(f.name, figures) && !other.find(f.name))
        found.deviation = HUGE_VAL, found.error = 0, found.figure = f.name, found.within = false;
    return found;
  }
  // Also the steady motion, if the full model's run reaches it.
  Deviation with_settled(const Deviation& by_run, const std::optional<VariantRun>& full, const Scene& scene,
                         const EffectSet& on, const std::vector<std::string>& figures) const {
    if (!full || !full->failed.empty()) return by_run;
    const VariantRun lean = settled(scene, effects(on), runs_.options().watch);
    if (lean.failed.empty())
      return worse_of(by_run, settled_deviation(full->result, lean.result, figures, options_.within));
    Deviation none = by_run;
    none.within = false;
    none.not_judged.push_back("the steady motion (" + lean.failed + ")");
    return none;
  }
  double progress() const {
    const auto n = static_cast<double>(a_.tried.size());
    return n / (n + 8);
  }
  void try_all() {
    const std::size_t n = a_.units.size();
    for (std::size_t bits = 0; bits + 1 < (std::size_t{1} << n); ++bits) {
      EffectSet on(n);
      bool has_all_that_it_asks = true;
      for (std::size_t k = 0; k < n; ++k) {
        on[k] = (bits >> k) & 1;
        has_all_that_it_asks = has_all_that_it_asks && (!on[k] || all_[k]);
      }
      if (has_all_that_it_asks) try_set(on);
    }
  }
  // Switches off the effects ranked least important, first by screens, then by runs, as long as a set stays within.
  void try_greedily() {
    const std::size_t n = a_.units.size();
    EffectSet on = all_;
    try_set(EffectSet(n, false));
    std::vector<std::pair<double, std::size_t>> alone;
    for (std::size_t k = 0; k < n; ++k) {
      if (!all_[k]) continue;
      const TriedSet& t = try_set(without(all_, k));
      if (t.within) alone.emplace_back(t.deviation, k);
    }
    std::stable_sort(alone.begin(), alone.end());
    for (const auto& [deviation, k] : alone) {
      on[k] = false;
      if (!try_set(on).within) on[k] = true;
    }
  }
  void choose() {
    for (std::size_t i = 1; i < a_.tried.size(); ++i) {
      const TriedSet &t = a_.tried[i], &best = a_.tried[a_.chosen];
      if (!t.within) continue;
      const auto count = [](const TriedSet& s) { return std::count(s.on.begin(), s.on.end(), true); };
      const bool cheaper = t.work() < same_work * best.work();
      const bool leaner = t.work() < best.work() / same_work && count(t) < count(best);
      if (cheaper || leaner) a_.chosen = i;
    }
    refuse_to_drop();
    for (std::size_t k = 0; k < a_.units.size(); ++k) a_.kept_because.push_back(reason(k));
  }
  // An effect stays if a screen expects it to matter, even if a run does not confirm it.
  void refuse_to_drop() {
    EffectSet on = a_.tried[a_.chosen].on;
    bool changed = false;
    std::vector<std::string> doubts;
    for (std::size_t k = 0; k < on.size(); ++k) {
      if (on[k] || !all_[k] || a_.screens[k].empty()) continue;
      const bool all_expect =
          std::all_of(a_.screens[k].begin(), a_.screens[k].end(), [](const Screen& s) { return s.needed; });
      if (!all_expect) continue;
      const TriedSet& alone = try_set(without(all_, k));
      // A deviation far below the tolerance is decisive; one near it is not.
      if (alone.refused.empty() && alone.deviation + alone.error < 0.2 * options_.within) continue;
      on[k] = changed = true;
      kept_by_screens_.push_back(k);
      doubts.push_back(fmt::format("{}: the screens expect it to matter ({}), the run found {:.2g} %",
                                   a_.units[k].words, a_.screens[k].front().verdict, 100 * alone.deviation));
    }
    if (!changed) return;
    const TriedSet& safer = try_set(on);
    const bool keeps = safer.within;
    if (keeps) a_.chosen = static_cast<std::size_t>(&safer - a_.tried.data());
    if (!keeps) kept_by_screens_.clear();
    for (const std::string& doubt : doubts)
      a_.warnings.push_back(
          doubt + (keeps ? ": it is kept" : "; the set with it was run and is outside the tolerance: it is omitted"));
  }
  std::string reason(std::size_t k) const {
    const TriedSet& chosen = a_.tried[a_.chosen];
    EffectSet other = chosen.on;
    other[k] = !other[k];
    const TriedSet* const found = known(other);
    if (!all_[k]) return "cannot be combined with the others: judged instead of them";
    if (!chosen.on[k]) return "omit: the set without it was run and is within the tolerance";
    if (std::count(kept_by_screens_.begin(), kept_by_screens_.end(), k))
      return "keep: the screens expect it to matter, and no run shows clearly that it does not";
    if (!found) {  // the greedy search left it on after running everything but it
      const TriedSet* const alone = known(without(all_, k));
      if (!alone) return "keep: no set without it was run";
      return !alone->refused.empty() ? "keep: the full model does not run without it"
                                     : fmt::format("keep: the full model without it is {:.3g} % off in {}",
                                                   100 * alone->deviation, alone->figure);
    }
    if (!found->refused.empty()) return "keep: the machine does not run without it";
    return found->within ? "keep: omitting it saves no work"
                         : fmt::format("keep: without it {} is {:.3g} % off", found->figure, 100 * found->deviation);
  }

  // The recommended set is run once more: it must stay within, and the scatter of processor times is measured.
  void run_again() {
    TriedSet& chosen = a_.tried[a_.chosen];
    say("again with " + chosen.words, progress());
    const Result again = must_run(chosen.on, "again");
    const double a = chosen.cpu_seconds, b = again.statistics.cpu_seconds;
    a_.time_spread = std::abs(a - b) / std::max({a, b, 1e-9});
    const Deviation d = judge(a_.full, again, options_.figures);
    if (!d.within || !again.complete)
      a_.warnings.push_back(
          fmt::format("run again, the set advised deviates by {} (in {})", in_percent(d.deviation, d.error), d.figure));
    if (!chosen.not_judged.empty())
      a_.warnings.push_back(
          fmt::format("too uncertain to be judged at {:.3g} %: {}; a smaller run.accuracy judges them",
                      100 * options_.within, listed(chosen.not_judged, "and")));
  }
  // The full model is not the complete one if effects exclude each other.
  void judge_what_does_not_go_with_the_rest() {
    for (std::size_t k = 0; k < a_.units.size(); ++k) {
      if (all_[k]) continue;
      const OmittedEffect left = study_in_place_of_others(scene_, a_.units, all_, k, runs_);
      const std::string what = a_.units[k].words + ", which does not go with " + left.in_place_of;
      std::vector<FigureChange> changes = left.changes;
      if (!options_.figures.empty())
        std::erase_if(changes, [&](const FigureChange& c) { return !is_asked_for(c.figure, options_.figures); });
      const Deviation d = deviation_of(changes, options_.within);
      if (!left.failed.empty())
        a_.warnings.push_back(what + ", could not be judged in their place: " + left.failed);
      else
        a_.warnings.push_back(fmt::format("{}, is in no set: in their place it changes {} by {}, {}", what,
                                          d.figure.empty() ? "no figure" : d.figure, in_percent(d.deviation, d.error),
                                          d.within ? "within the tolerance" : "beyond the tolerance"));
    }
  }

  // --- points that took no part in the choice ---
  void hold_out() {
    if (!options_.held_out || a_.chosen == 0) return;
    const EffectSet& on = a_.tried[a_.chosen].on;
    if (!options_.figures.empty())
      a_.held_out.push_back({judge(a_.full, must_run(on, "lean"), {}), "all other telling figures"});
    const std::pair<const char*, std::string (*)(Scene&, double)> ways[] = {{"loads", scale_loads},
                                                                            {"speeds", scale_speeds}};
    for (const auto& [name, scale] : ways)
      for (const double step : {held_out_step, -held_out_step}) {
        Scene scene = scene_;
        const std::string changed = scale(scene, 1 + step);
        if (changed.empty()) break;
        HeldOut h{{}, fmt::format("{} {:+.0f} % ({})", name, 100 * step, changed)};
        say(h.what, progress());
        const VariantRun full = runs_.run("full", scene, effects(all_)), lean = runs_.run("lean", scene, effects(on));
        h.refused = full.failed.empty() ? lean.failed : full.failed;
        if (full.result.model && lean.result.model) {
          Deviation& by = h;
          by = judge(full.result, lean.result, options_.figures);
          if (full.result.periods.steady && h.refused.empty())
            by = with_settled(by, settled(scene, effects(all_), runs_.options().watch), scene, on, options_.figures);
        }
        h.within = h.within && h.refused.empty();
        a_.held_out.push_back(h);
      }
    for (const HeldOut& h : a_.held_out)
      if (!h.within)
        a_.warnings.push_back(
            !h.refused.empty() ? fmt::format("with {} a model did not run: {}", h.what, h.refused)
            : !h.not_judged.empty()
                ? fmt::format("with {} the advice is not judged in full: {}", h.what, listed(h.not_judged, "and"))
                : fmt::format("with {} the deviation is {} (in {}): the advice does not hold there", h.what,
                              in_percent(h.deviation, h.error), h.figure));
  }

  void conclude() {
    const TriedSet &full = a_.tried.front(), &chosen = a_.tried[a_.chosen];
    a_.lean_scene = with_effects(scene_, a_.units, chosen.on);
    if (a_.chosen == 0) {
      a_.conclusion =
          fmt::format("Keep everything: no cheaper set of effects stays within {:.3g} % ({} sets were run).",
                      100 * options_.within, a_.tried.size());
      return;
    }
    a_.conclusion = fmt::format(
        "Within {:.3g} %: {}. This model deviates by {} at most ({}) and takes {:.0f} % of the time of the full model; "
        "{} sets "
        "were run{}.",
        100 * options_.within,
        chosen.words == "none"
            ? "no effect is needed, the rigid machine suffices"
            : chosen.words + (std::count(chosen.on.begin(), chosen.on.end(), true) > 1 ? " are enough" : " is enough"),
        in_percent(chosen.deviation, chosen.error), chosen.figure.empty() ? "no figure differs" : chosen.figure,
        100 * chosen.cpu_seconds / std::max(full.cpu_seconds, 1e-9), a_.tried.size(),
        a_.warnings.empty() ? "" : "; mind the warnings");
  }

  const Scene& scene_;
  const AdviseOptions& options_;
  VariantRuns runs_;
  std::vector<std::size_t> kept_by_screens_;  // units that stay although a set without them is within
  std::optional<VariantRun> settled_;         // of the full model; none: its run does not come to it
  EffectSet all_;                             // that go together: those of the full model
  Advice a_;
};

}  // namespace

Advice advise(const Scene& scene, const AdviseOptions& options) { return Adviser(scene, options).run(); }

}  // namespace kurbel
