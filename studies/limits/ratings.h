// ratings.h — do clutches, brakes, belts, shafts, flywheels, motors hold what a run brings? By the ratings that they state.
//
//     engagement: W = ∫ |M_k Δω| dt ≤ allowable_heat, the hottest one         W_total/t ≤ allowable_heat_power
//     belt:       F₀ + |τ|/(2 r₁) ≤ allowable_tension                         slip_reserve · |τ| ≤ M (Euler, Eytelwein)
//     shaft:      K_A |T|/W_p ≤ allowable_shear_stress, K_A in steady motion  W_p = π (D⁴ − d⁴)/(16 D)
//                 from the least torque to the greatest: yield; for Goodman and the maker's amplitude a bound of the
//                 steady motion: the extremes of one start are no endless alternation
//     flywheel:   r |ω| ≤ allowable_rim_speed                                 ρ (r ω)² ≤ allowable_rim_stress
//     motor:      √(∫ M² dt/t) ≤ M_N √part,  part = 1 (S1), duty_time/t (S2), duty_share (S3): a lower bound of heating
//     coupling:   S_t S_z |T| ≤ T_Kmax (DIN 740-2)                            with S_z > 1 a bound
// Every figure is one of the run, with the error that other runs measure. Nothing rated, nothing judged.
#pragma once

#include <memory>
#include <vector>

#include "studies/findings/result.h"
#include "studies/limits/heat_recorder.h"
#include "studies/limits/verdicts.h"

namespace kurbel {

// Watches clutches, limiters, brakes, and whatever else's heat is rated; null: none.
std::unique_ptr<HeatRecorder> heat_recorder_of(const Model& model);
// Rim speeds of flywheels whose rim is given.
std::vector<ExtremeOf> rim_speeds_of(const Model& model);
// Greatest and least torques of shafts of which a cycle of stress is rated.
std::vector<ExtremeOf> shaft_torques_of(const Model& model);
// Of what slips and of belts, from what was watched and from peak torques among `known`. Heat is judged by `energy` [J],
// times by `duration` [s].
std::vector<Figure> rating_figures(const Model& model, const HeatRecorder* heat, const std::vector<Figure>& known,
                                   double energy, double duration);
// Those of what slips and of belts, rated or not: names and units.
std::vector<Figure> watched_figure_list(const Model& model);
// Those that ratings judge.
std::vector<Figure> rating_figure_list(const Model& model);

// Of a complete run; an incomplete one has not shown what it would bring. Load cases are told by the run's sequence and
// periods, or all are `only_case`, of figures that are of that alone.
std::vector<Verdict> judge_ratings(const Result& result, const std::string& only_case = {});

}  // namespace kurbel
