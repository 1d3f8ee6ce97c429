// key_figures.cpp — ranks all figures and selects the best.
#include "studies/answers/key_figures.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <string_view>
#include <tuple>

#include "engine/numerics/angles.h"
#include "engine/numerics/index.h"
#include "studies/limits/ratings.h"

namespace kurbel {
namespace {

constexpr std::size_t most_peaks = 3;
constexpr int never = 100;
constexpr double stands_within_the_cycle = 2;  // (ω_max − ω_min)/ω_mid from there on: ω_min ≤ 0

// Ranks of a figure of the link, and of the same figure of others.
struct Ranked {
  std::string_view words;
  int of_link, of_others = of_link;
};
constexpr Ranked ranks[] = {
    {"cycle_fluctuation", 2, never},
    {"delta", 2, never},
    {"flywheel_energy", 2},
    {"mean_speed", 2, never},
    {"current_use", 3},
    {"cycle_motor_power", 3},
    {"motor_mean_power", 3},
    {"motor_peak_current", 9},  // behind what heats it
    {"motor_peak_power", 9},
    {"motor_peak_torque", 9},
    {"motor_rms_torque", 3},
    {"thermal_use", 3},
    {"motor_rms_current", 4},
    {"peak_torque", 4},
    {"speed_drop", 4},
    {"machine_efficiency", 5},
    {"peak_force", 5},
    {"peak_load_torque", 5},
    {"useful_work_per_cycle", 5},
    {"energy_given", 6},
    {"engagement_heat", 6},
    {"impacts", 6},
    {"motor_slip_heat", 6},
    {"run_down_time", 6},
    {"run_up_time", 6},
    {"slip_heat", 6},
    {"start_heat", 6},
    {"stopping_angle", 6},
    {"stopping_time", 6},
    {"strand_force", 6},
    {"torque_reserve", 6},
    {"final_speed", 7, 9},
    {"peak_velocity", 7},
    {"final_angle", 8, 10},
    {"heat_power", 8},
    {"loop_power", 8},
    {"loop_work", 8},
    {"max_speed", 8},
    {"peak_acceleration", 8, 10},
    {"slip_time", 8},
    {"volumetric_efficiency", 8},
    {"work", 10},
};

int rank_of(const Figure& f, const std::string& link, const std::set<std::string>& judged) {
  if (judged.contains(f.name)) return 1;
  if (f.what == quantities::peak_other) return 8;
  if (f.what == quantities::cycle_fluctuation && !(f.value < stands_within_the_cycle)) return never;
  if (f.what == quantities::final_angle && std::abs(f.value) > 2 * pi) return never;  // counts turns
  for (const Ranked& known : ranks)
    if (f.words() == known.words) return f.of == link ? known.of_link : known.of_others;
  return never;
}

}  // namespace

std::vector<std::size_t> chosen_figures(const Result& r, std::size_t most) {
  const std::string link = r.model ? r.model->network.nodes[at(r.model->reduction_node)].component : "";
  std::set<std::string> judged;
  if (r.model)
    for (const Figure& f : rating_figure_list(*r.model)) judged.insert(f.name);
  // Peaks of torque by size over the usual torque; the others in the order of the list.
  std::vector<std::tuple<int, double, std::size_t>> ranked;
  std::vector<std::pair<double, std::size_t>> peaks;
  for (std::size_t i = 0; i < r.figures.size(); ++i) {
    const Figure& f = r.figures[i];
    if (!r.complete && !std::isfinite(f.value)) continue;
    const int rank = rank_of(f, link, judged);
    if (rank == 4)
      peaks.emplace_back(-std::abs(f.value) / (f.scale > 0 ? f.scale : 1), i);
    else if (rank < never)
      ranked.emplace_back(rank, 0, i);
  }
  std::stable_sort(peaks.begin(), peaks.end());
  // The greatest one comes first, whichever figures have ratings.
  for (std::size_t k = 0; k < peaks.size(); ++k)
    ranked.emplace_back(k == 0 ? 0 : k < most_peaks ? 4 : 8, static_cast<double>(k), peaks[k].second);
  std::stable_sort(ranked.begin(), ranked.end());
  std::vector<std::size_t> chosen;
  for (std::size_t k = 0; k < std::min(most, ranked.size()); ++k) chosen.push_back(std::get<2>(ranked[k]));
  std::sort(chosen.begin(), chosen.end());
  return chosen;
}

}  // namespace kurbel
