// agreement_of_advice.cpp — what `advise` recommends, run until it is settled, beside everything.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <stdexcept>

#include "engine/numerics/deadline.h"
#include "studies/advise/advise.h"
#include "tests/agreement/agreement.h"

namespace kurbel::agreement {
namespace {

constexpr double floor_of_figures = 1e-4;  // of their scales: what is less than a figure's own rounding in practice
constexpr double stated_part = 0.8;        // of a deviation that a warning must state at least
constexpr double load_steps[] = {1, 1.2, 0.8};

// What an engineer reads off a settled machine; both models must have it.
bool is_judged(const Measured& m) {
  return m.name.what == quantities::mean_speed || m.name.what == quantities::delta ||
         m.name.what == quantities::peak_torque || m.name.what == quantities::max_speed ||
         m.name.what == quantities::min_speed || m.name.what == quantities::rms_torque;
}

bool is_asked(const Advice& advice, const Measured& m) {
  return advice.figures.empty() || std::any_of(advice.figures.begin(), advice.figures.end(),
                                               [&](const std::string& f) { return m.name.text.starts_with(f); });
}

struct Worst {
  double deviation = 0, full = 0, lean = 0;
  std::string figure;
};
Worst worst_of(const Advice& advice, const SettledRun& full, const SettledRun& lean) {
  Worst worst;
  for (const Measured& m : full.figures) {
    if (!is_judged(m) || !is_asked(advice, m)) continue;
    const Measured* other = lean.find(m.name.what, m.name.of);
    if (!other) continue;
    const double size = std::max({std::abs(m.value), floor_of_figures * m.scale, 1e-300});
    const double deviation = std::max(0.0, std::abs(std::abs(m.value) - std::abs(other->value)) - m.error) / size;
    if (deviation > worst.deviation) worst = {deviation, m.value, other->value, m.name.text};
  }
  return worst;
}

// The number that ends at `end`; nothing where none does.
std::string number_before(const std::string& words, std::size_t end) {
  const std::size_t begin = words.find_last_not_of("0123456789.e+-", end - 1);
  return words.substr(begin + 1, end - begin - 1);
}

// A warning counts for what it says: the largest percentage in it, "12 ± 0.1 %" as a deviation and its error.
double warned_of(const Advice& advice) {
  double most = 0;
  for (const std::string& words : advice.warnings)
    for (std::size_t sign = words.find(" %"); sign != std::string::npos; sign = words.find(" %", sign + 1)) {
      const std::string number = number_before(words, sign), apart = " ± ";
      const std::size_t before = sign - number.size();
      if (before > apart.size() && words.compare(before - apart.size(), apart.size(), apart) == 0) {
        const std::string value = number_before(words, before - apart.size());
        most = std::max(most, (std::strtod(value.c_str(), nullptr) + std::strtod(number.c_str(), nullptr)) / 100);
        continue;
      }
      // Signed ones say how far the loads were moved.
      if (!number.empty() && number.front() != '+' && number.front() != '-')
        most = std::max(most, std::strtod(number.c_str(), nullptr) / 100);
    }
  return most;
}

}  // namespace

Row compare_advice(const Scene& scene, double within, const SettleSettings& settings) {
  const double begin = processor_time();
  Row row;
  row.kind = Motion::repeats;
  if (effect_units(scene).empty()) return row;
  const auto add = [&](const std::string& what, const Worst& worst, Verdict verdict, const std::string& words) {
    row.figures.push_back({Topic::advice, what + (worst.figure.empty() ? "" : ": " + worst.figure), worst.full,
                           worst.lean, within * std::abs(worst.full), verdict, words});
  };
  try {
    AdviseOptions options;
    options.within = within;
    options.simulate.accuracy = std::min(scene.run.accuracy, 0.1 * within);
    const Advice advice = advise(scene, options);
    row.orbit = advice.chosen == 0 ? "everything is recommended" : advice.tried[advice.chosen].words;
    if (advice.chosen == 0) return row;
    const EffectSet& on = advice.tried[advice.chosen].on;
    for (const double step : load_steps) {
      Scene loaded = scene;
      if (step != 1 && scale_loads(loaded, step).empty()) continue;
      const SettledRun full = settle(loaded, effects_of(loaded, advice.units, EffectSet(on.size(), true)), settings),
                       lean = settle(loaded, effects_of(loaded, advice.units, on), settings);
      if (full.kind != Motion::repeats || lean.kind != Motion::repeats) continue;
      const Worst worst = worst_of(advice, full, lean);
      const std::string what = step == 1 ? "loads as they are" : fmt::format("loads {:+.0f} %", 100 * (step - 1));
      add(what, worst,
          worst.deviation <= within                           ? Verdict::agrees
          : warned_of(advice) > stated_part * worst.deviation ? Verdict::reported
                                                              : Verdict::silent,
          advice.warnings.empty() ? "" : advice.warnings.front());
    }
  } catch (const std::invalid_argument& error) {
    add("", {}, Verdict::refused, error.what());
  } catch (const std::runtime_error& error) {
    add("", {}, Verdict::refused, error.what());
  }
  row.cpu_seconds = processor_time() - begin;
  return row;
}

}  // namespace kurbel::agreement
