// ratings.h — assesses clutches, brakes, belts, shafts, flywheels and motors in a run against their ratings.
//
//     engagement: W = ∫ |M_k Δω| dt ≤ allowable_heat, of the hottest          W_total/t ≤ allowable_heat_power
//     belt:       F₀ + |τ|/(2 r₁) ≤ allowable_tension                         slip_reserve · |τ| ≤ M (Euler, Eytelwein)
//     shaft:      K_A |T|/W_p ≤ allowable_shear_stress, K_A in steady motion  W_p = π (D⁴ − d⁴)/(16 D)
//                 from the least torque to the greatest: yield; Goodman and the manufacturer's amplitude are a bound
//                 for steady motion only: the extremes of one start are not repeated continuously
//     flywheel:   r |ω| ≤ allowable_rim_speed                                 ρ (r ω)² ≤ allowable_rim_stress
//     motor:      √(∫ M² dt/t) ≤ M_N √part,  part = 1 (S1), duty_time/t (S2), duty_share (S3): a lower bound of heating
//     coupling:   S_t S_z |T| ≤ T_Kmax (DIN 740-2)                            with S_z > 1 a bound
// Every figure is one of the run, with the error measured by other runs. Without a rating there is no verdict.
#pragma once

#include <memory>
#include <vector>

#include "studies/findings/result.h"
#include "studies/limits/heat_recorder.h"
#include "studies/limits/verdicts.h"

namespace kurbel {

// Watches clutches, limiters, brakes, and other components with rated heat; null: none.
std::unique_ptr<HeatRecorder> heat_recorder_of(const Model& model);
// Rim speeds of flywheels whose rim is given.
std::vector<ExtremeOf> rim_speeds_of(const Model& model);
// Greatest and least torques of shafts with a rated stress cycle.
std::vector<ExtremeOf> shaft_torques_of(const Model& model);
// Figures of slipping components and belts, from the observer and from peak torques among `known`. Errors are related
// to `energy` [J] for heat, to `duration` [s] for times.
std::vector<Figure> rating_figures(const Model& model, const HeatRecorder* heat, const std::vector<Figure>& known,
                                   double energy, double duration);
// Figures of slipping components and belts, rated or not: names and units.
std::vector<Figure> watched_figure_list(const Model& model);
// Figures that ratings assess.
std::vector<Figure> rating_figure_list(const Model& model);

// For a complete run; an incomplete one does not show its final loads. Load cases follow from the run's sequence and
// periods, or are `only_case` if all figures belong to it; starts and engagements are not assessed then.
std::vector<Verdict> judge_ratings(const Result& result, const std::string& only_case = {});

}  // namespace kurbel
