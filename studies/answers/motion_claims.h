// motion_claims.h — does the machine do its work at all? Claims from the motion of a run and its final state.
#pragma once

#include "studies/answers/link_recorder.h"
#include "studies/answers/slip_recorder.h"
#include "studies/findings/result.h"
#include "studies/findings/watch.h"

namespace kurbel {

inline constexpr double far_away = 1.5;  // times the usual speed: nothing in the scene gives such a speed
// ", 2.6 times the speed of its data"; empty where no speed is among them.
std::string times_the_speed_of_its_data(const Model& model, double speed);

// Faults of the motion, what holds the link, what slips (contact_claims); for an incomplete run only that it
// stalls. `equations`: in the modes at the run's end; `result` contains its periods, figures, and the errors of its
// final state. `watch` ends trials; `budget`: of the run and its trials [s of processor time].
Claims motion_claims(Equations& equations, const RunOutcome& outcome, const Result& result, const SlipRecorder& slips,
                     const LinkRecorder& link, const Watch& watch, double budget);

// For a completed run, with the modes at its end: closed clutches and belts that slip to the end or temporarily; a
// brake that is applied and does not stop its shaft; only in the list of claims: clutches that engage, are opened by
// command, or overrun. `result` contains the errors of its final state.
Claims contact_claims(Equations& equations, const RunOutcome& outcome, const Result& result, const SlipRecorder& slips);

// Of a machine whose motion ended where the friction in a mechanism's joints allows none; empty: it did not.
std::optional<Claim> joints_jam(const Model& model, const RunOutcome& outcome);

// "220.8°", within a turn; from an angle [rad].
std::string text_of_place(double angle);

// Starts in an unstable equilibrium; springs between shafts of which only one has a start speed in the scene, while that of the other differs by more
// than a tenth of the usual speed.
Claims start_claims(const std::shared_ptr<const Model>& model);

// Of a machine that started at rest without torque on any shaft and without later changes, and never moved: a dead centre
// under load, or a balance. Empty: it did, or the run is not complete. What rounding moved is said by a claim (`start_unstable`).
std::string words_of_balance(const Equations& at_end, const RunOutcome& outcome);

}  // namespace kurbel
