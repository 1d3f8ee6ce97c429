// accuracy_judge.cpp — evaluation of the measured settings: fronts, sentences, answers.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "studies/accuracy/accuracy.h"
#include "studies/claims/ranges.h"

namespace kurbel {
namespace {

std::string percent(double error) { return fmt::format("{:.2g} %", 100 * error); }

class Judge {
 public:
  explicit Judge(AccuracyStudy& study) : study_(study) {}

  void mark_fronts() {
    for (std::size_t level = 0; level < study_.levels.size(); ++level) {
      const std::vector<std::size_t> own = of_level(level);
      for (const std::size_t i : front(own, [](const MeasuredSetting& s) { return s.trajectory_error; }))
        study_.settings[i].on_level_front = true;
    }
    if (study_.figures.empty()) return;  // where nothing moves there is no total error
    std::vector<std::size_t> all(study_.settings.size());
    std::iota(all.begin(), all.end(), 0u);
    for (const std::size_t i : front(all, [&](const MeasuredSetting& s) { return total(s); }))
      study_.settings[i].on_front = true;
  }

  // The cheapest setting with a total error of the key figure of at most `error`; null: none.
  const MeasuredSetting* cheapest_within(double error) const {
    const MeasuredSetting* best = nullptr;
    for (const MeasuredSetting& s : study_.settings)
      if (total(s) <= error && (!best || s.seconds < best->seconds)) best = &s;
    return best;
  }
  const MeasuredSetting* best_for(double seconds) const {
    const MeasuredSetting* best = nullptr;
    for (const MeasuredSetting& s : study_.settings)
      if (s.seconds <= seconds && !std::isnan(total(s)) &&
          (!best || total(s) < total(*best) || (total(s) == total(*best) && s.seconds < best->seconds)))
        best = &s;
    return best;
  }

  std::string reported(const MeasuredSetting& s) const {
    return fmt::format("{}, {}, measured {}", study_.name_of(s), duration_text(s.seconds), percent(total(s)));
  }

  // Processor time for each level's key figure.
  void time_levels() {
    if (study_.figures.empty()) return;
    for (std::size_t level = 0; level < study_.levels.size(); ++level)
      for (const std::size_t i : of_level(level)) {
        const MeasuredSetting& s = study_.settings[i];
        double& least = study_.levels[level].seconds;
        if (s.numerical_error[study_.key] <= close_enough && !(least <= s.seconds)) least = s.seconds;
      }
  }

  void find() {
    if (study_.figures.empty() || study_.settings.empty()) {
      study_.findings = {"No figure of the scene can be followed: nothing moves"};
      return;
    }
    add(conclusion());
    add(price_of_digits());
    for (std::size_t level = 0; level < study_.levels.size(); ++level) add(limit_of(level));
    add(floor());
    add(price_of_multibody());
  }

  double total(const MeasuredSetting& s) const { return s.total_error[study_.key]; }
  const std::string& key() const { return study_.figures[study_.key].name; }

 private:
  void add(const std::string& sentence) {
    if (!sentence.empty()) study_.findings.push_back(sentence);
  }
  const ModelLevel& full() const { return study_.levels[study_.fullest]; }

  std::vector<std::size_t> of_level(std::size_t level) const {
    std::vector<std::size_t> own;
    for (std::size_t i = 0; i < study_.settings.size(); ++i)
      if (study_.settings[i].level == level) own.push_back(i);
    return own;
  }
  template <class Error>
  std::vector<std::size_t> front(const std::vector<std::size_t>& of, Error error) const {
    std::vector<double> errors, seconds;
    for (const std::size_t i : of) {
      errors.push_back(error(study_.settings[i]));
      seconds.push_back(study_.settings[i].seconds);
    }
    std::vector<std::size_t> chosen = pareto_front(errors, seconds);
    for (std::size_t& i : chosen) i = of[i];
    return chosen;
  }

  std::string conclusion() const {
    for (const double error : {1e-2, 1e-1}) {
      const MeasuredSetting* s = cheapest_within(error);
      if (s) return fmt::format("For {:g} % in {}: {}", 100 * error, key(), reported(*s));
    }
    const MeasuredSetting* best = best_for(HUGE_VAL);
    return best ? fmt::format("Nothing tried brings {} within 10 %; the nearest: {}", key(), reported(*best))
                : fmt::format("Nothing tried yields {}", key());
  }

  // Increase of time for each power of ten in error, from 1 % on, as far as the references resolve it.
  std::string price_of_digits() const {
    std::string text;
    const MeasuredSetting* before = cheapest_within(1e-2);
    if (!before) return "";
    double error = 1e-2;
    double least = HUGE_VAL, most = 0;
    for (double next = 1e-3; next > 1.5e-12; next /= 10) {
      const MeasuredSetting* s = cheapest_within(next);
      if (!s) break;
      least = std::min(least, s->seconds / before->seconds), most = std::max(most, s->seconds / before->seconds);
      before = s;
      error = next;
    }
    if (most == 0) return fmt::format("No setting tried is nearer to {} than 1 %", key());
    return fmt::format(
        "From 1 % to {:.0e} (relative) each further digit costs {:.1f} … {:.1f} × the time; there it is {}", error,
        least, most, reported(*before));
  }

  // Where a tighter tolerance is useless because the model error dominates.
  std::string limit_of(std::size_t level) const {
    const ModelLevel& m = study_.levels[level];
    if (level == study_.fullest || std::isnan(m.model_error[study_.key])) return "";
    const bool has_key = std::any_of(study_.settings.begin(), study_.settings.end(), [&](const MeasuredSetting& s) {
      return s.level == level && !std::isnan(s.numerical_error[study_.key]);
    });
    if (!has_key) return fmt::format("The level \"{}\" yields the motion of the link alone, not {}", m.name, key());
    const double off = m.model_error[study_.key];
    if (off <= std::max(m.floor[study_.key], full().floor[study_.key]))
      return fmt::format("The {} gives the same {} as the {}", m.called, key(), full().called);
    const MeasuredSetting* enough = nullptr;
    for (const MeasuredSetting& s : study_.settings)
      if (s.level == level && s.numerical_error[study_.key] <= 0.1 * off && (!enough || s.seconds < enough->seconds))
        enough = &s;
    std::string text = fmt::format("The {} is {} off the {} in {} whatever its tolerance", m.called, percent(off),
                                   full().called, key());
    if (enough)
      text += fmt::format("; {} at {:.0e} ({}) is accurate enough for it", enough->method, enough->tolerance,
                          duration_text(enough->seconds));
    return text;
  }

  std::string floor() const {
    return fmt::format(
        "{} and {} agree on {} of the {} to {:.1e}, on its motion to {:.1e}: no smaller error is claimed", full().first,
        full().second, key(), full().called, full().floor[study_.key], full().agreement);
  }

  // Against the cheapest reduced setting of at least the same accuracy.
  std::string price_of_multibody() const {
    double least = HUGE_VAL, most = 0;
    for (const MeasuredSetting& s : study_.settings) {
      if (study_.levels[s.level].name != "multibody") continue;
      double cheapest = HUGE_VAL;
      for (const MeasuredSetting& r : study_.settings)
        if (study_.levels[r.level].name == "rigid" && r.trajectory_error <= s.trajectory_error)
          cheapest = std::min(cheapest, r.seconds);
      if (std::isinf(cheapest)) continue;
      least = std::min(least, s.seconds / cheapest);
      most = std::max(most, s.seconds / cheapest);
    }
    if (most == 0) return "";
    return fmt::format("The multibody run needs {} × the time of the reduced machine for no smaller error",
                       range_text(least, most, 3));
  }

  AccuracyStudy& study_;
};

}  // namespace

std::vector<std::size_t> pareto_front(const std::vector<double>& error, const std::vector<double>& seconds) {
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < error.size(); ++i)
    if (!std::isnan(error[i])) order.push_back(i);
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return seconds[a] != seconds[b] ? seconds[a] < seconds[b] : error[a] < error[b];
  });
  std::vector<std::size_t> front;
  // Gains of less than a tenth are ignored: times scatter by as much.
  for (const std::size_t i : order)
    if (front.empty() || error[i] < 0.9 * error[front.back()]) front.push_back(i);
  return front;
}

void judge_accuracy(AccuracyStudy& study, const AccuracyOptions& options) {
  Judge judge(study);
  judge.mark_fronts();
  judge.time_levels();
  judge.find();
  if (study.figures.empty()) return;
  if (options.within) {
    const MeasuredSetting* s = judge.cheapest_within(*options.within);
    study.answers.push_back(
        s ? fmt::format("Cheapest within {} of {}: {}", percent(*options.within), judge.key(), judge.reported(*s))
          : fmt::format("No setting tried is within {} of {}", percent(*options.within), judge.key()));
  }
  if (options.budget) {
    const MeasuredSetting* s = judge.best_for(*options.budget);
    study.answers.push_back(
        s ? fmt::format("Most exact for {} of processor time: {}", duration_text(*options.budget), judge.reported(*s))
          : fmt::format("No setting tried takes less than {}: the cheapest takes longer",
                        duration_text(*options.budget)));
  }
}

}  // namespace kurbel
