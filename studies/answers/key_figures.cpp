// key_figures.cpp — a rank for every figure, and the best of them.
#include "studies/answers/key_figures.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <string_view>
#include <tuple>

#include "engine/numerics/index.h"
#include "studies/limits/ratings.h"

namespace kurbel {
namespace {

constexpr std::size_t most_peaks = 3;
constexpr int never = 100;
constexpr double stands_within_the_cycle = 2;  // (ω_max − ω_min)/ω_mid from there on: ω_min ≤ 0

// Ranks of figures by their names' beginnings.
struct Ranked {
  int rank;
  std::string_view name;
};
constexpr std::array own_names = {
    Ranked{3, "thermal_use"},        Ranked{3, "cycle_motor_power"},
    Ranked{3, "motor_mean_power"},   Ranked{3, "motor_rms_torque"},
    Ranked{4, "motor_rms_current"},  Ranked{6, "motor_slip_heat"},
    Ranked{8, "loop_work"},          Ranked{2, "flywheel_energy"},
    Ranked{5, "machine_efficiency"}, Ranked{8, "loop_power"},
    Ranked{4, "speed_drop"},         Ranked{6, "energy_given"},
    Ranked{6, "torque_reserve"},     Ranked{6, "engagement_heat"},
    Ranked{8, "slip_time"},          Ranked{8, "heat_power"},
    Ranked{6, "strand_force"},       Ranked{3, "current_use"},
    Ranked{6, "start_heat"},         Ranked{8, "volumetric_efficiency"},
};

bool begins(const std::string& name, std::string_view word) {
  return name.starts_with(word) && (name.size() == word.size() || name[word.size()] == '.');
}

int rank_of(const Figure& f, const std::string& link, const std::set<std::string>& judged) {
  using enum QuantityKind;
  if (judged.contains(f.name)) return 1;
  const bool of_link = f.of == link;
  if (f.name.starts_with("motor_peak_")) return 9;  // behind what heats it
  switch (f.what) {
    case cycle_fluctuation:
      return of_link && f.value < stands_within_the_cycle ? 2 : never;
    case delta:
    case mean_speed:
      return of_link ? 2 : never;
    case peak_torque:
      return 4;
    case peak_force:
    case peak_load_torque:
    case useful_work_per_cycle:
      return 5;
    case run_up_time:
    case run_down_time:
    case stopping_time:
    case stopping_angle:
    case slip_heat:
    case impacts:
      return 6;
    case peak_velocity:
      return 7;
    case final_speed:
      return of_link ? 7 : 9;
    case final_angle:
    case peak_acceleration:
      return of_link ? 8 : 10;
    case peak_other:
    case max_speed:
      return 8;
    case work:
      return 10;
    default:
      break;
  }
  for (const Ranked& own : own_names)
    if (begins(f.name, own.name)) return own.rank;
  return never;
}

}  // namespace

std::vector<std::size_t> chosen_figures(const Result& r, std::size_t most) {
  const std::string link = r.model ? r.model->network.nodes[at(r.model->reduction_node)].component : "";
  std::set<std::string> judged;
  if (r.model)
    for (const Figure& f : rating_figure_list(*r.model)) judged.insert(f.name);
  // The peaks of torque by size, over what is usual there; the others in the order of the list.
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
  // The greatest of them comes first whatever is rated.
  for (std::size_t k = 0; k < peaks.size(); ++k)
    ranked.emplace_back(k == 0 ? 0 : k < most_peaks ? 4 : 8, static_cast<double>(k), peaks[k].second);
  std::stable_sort(ranked.begin(), ranked.end());
  std::vector<std::size_t> chosen;
  for (std::size_t k = 0; k < std::min(most, ranked.size()); ++k) chosen.push_back(std::get<2>(ranked[k]));
  std::sort(chosen.begin(), chosen.end());
  return chosen;
}

}  // namespace kurbel
