// claim_kinds.cpp — the list of all claims: definition, evidence, wording, commands; the source of docs/claims.md.
#include <algorithm>
#include <array>

#include "studies/claims/claim.h"

namespace kurbel {
namespace {

using enum Predicate;
using enum Topic;
using enum Severity;
using enum ClaimKind::Shows;

constexpr std::array kinds = {
    ClaimKind{incomplete, runs, fault, anything,
              "the computation ended before its end: budget, interrupt, a motion that cannot go on", "none",
              "INCOMPLETE: the budget of 300 s of processor time is spent", "every command"},
    ClaimKind{jams, runs, fault, anything,
              "at an angle of the moving link no acceleration satisfies the friction in the joints of a mechanism "
              "(Painlevé's inconsistency, theory 9.10), so that an impact stops it there (8.15); of several the first",
              "at: of the impact; value: the link's angle [rad]",
              "\"crank\" jams at 220.8° after 0.0116 s: no acceleration satisfies the friction in its joints while it "
              "moves (Painlevé's inconsistency), and it stops at once",
              "run, compare"},
    ClaimKind{
        stalls, runs, fault, above,
        "the link turned, is at rest at the end and held there, directly or through springs, or a motor that stands "
        "under torque is balanced by its loads; something drives it, and no engaged brake holds it",
        "at: of its rest; value: the torque that drives, on the link [N·m]",
        "\"compressor\" stalls at 308.9° after 0.637 s: the load can hold the 91.9 N·m that drive there, and "
        "holds them to the end",
        "run, compare"},
    ClaimKind{
        does_not_start, runs, fault, above,
        "the link never turned at 0.1 % of its usual speed although something drives it; no brake that is on holds "
        "it. With a sequence: if a motor stands under torque",
        "value: the torque that drives, on the link; of a drive behind a clutch that slips, the clutch's [N·m]",
        "\"compressor\" does not start: its loads hold the 91.94 N·m that drive it", "run, compare"},
    ClaimKind{brake_does_not_stop, runs, fault, above,
              "a brake that was put on slips at the end, and at that deceleration would not stop its shaft within the "
              "time of the run; it may have stopped it before, and held it for a time",
              "at: it was put on; value: speed of its shaft [rad/s]",
              "\"brake\" does not stop it: it slips at 120 rpm after 2.5 s; its 40 N·m are too weak for what drives",
              "run, compare"},
    ClaimKind{
        turns_back, runs, fault, below,
        "the link ends more than half a turn behind its foremost position, and has not come forwards again by half of "
        "that, or has fallen farther since; or, with nothing on, it turns backwards faster than its usual speed. It "
        "does "
        "not go to and fro. A torque drives it forwards, or nothing drives it (with a sequence: only if nothing drives "
        "it)",
        "value: speed at the end [rad/s]; limit: 0",
        "\"motor\" turns backwards, at -12.67 rad/s at the end: its loads are stronger than the 79 N·m that "
        "drive it forwards",
        "run, compare"},
    ClaimKind{hangs_below_breakdown, runs, fault, below,
              "in steady motion an induction motor at the mains drives below its breakdown speed",
              "value: its mean speed; limit: its breakdown speed [rad/s]",
              "\"motor\" does not come up to speed: it stays at 320 rpm, below the 1280 rpm of its breakdown torque; "
              "its loads take all its torque there",
              "run, compare"},
    ClaimKind{starter_waits, runs, fault, anything,
              "in steady motion a star-delta starter has not come to its switching speed, or the current of a DC motor "
              "on starting resistances not down to its switching current",
              "value: mean speed of the motor [rad/s], or its current [A]; limit: the one at which it switches",
              "\"motor\" stays in star: its switching speed, 1420 rpm, is not reached (1376 rpm)",
              "run, compare, steady"},
    ClaimKind{runs_away, runs, fault, above,
              "the speed exceeds 1.5 times the usual one, its growth from cycle to cycle does not decrease, and at no "
              "higher speed (up to a hundred times) do loads and drag balance the drive. A trial of up to eight times "
              "the time confirms it: the gain does not decrease from one doubling of the time to the next, or the "
              "trial ends earlier, by the budget, by ten times the run's evaluations in one doubling, or by a fault. "
              "With fewer than three cycles only a complete trial counts, which must reach 1.3 times the speed. With "
              "nothing on any more the end must be the fastest of the run, and gain speed",
              "value: speed at the end; limit: 1.5 times the usual speed [rad/s]",
              "\"motor\" runs away: 100 rad/s at the end, 10 times the speed of its data, and the mean speed "
              "changes by +6.5 % per sixteenth of the time, and this change does not decrease",
              "run, compare"},
    ClaimKind{
        does_not_get_round, runs, fault, above,
        "the link completes no cycle, its speed at the end is at most a fifth of the largest one, or it goes to and "
        "fro and no law over time repeats, and something drives it; no brake that was put on meanwhile holds it",
        "value: the torque that drives, on the link; of a drive behind a clutch that slips, the clutch's [N·m]",
        "\"press\" does not complete a cycle: it is at 161.2° at the end, with 0.1 rpm, where 310 N·m drive it",
        "run, compare"},
    ClaimKind{slips_to_the_end, runs, warning, above,
              "a closed clutch, limiter or belt slips at the end under torque, or a brake that is on from the start",
              "value: the speed of slip [rad/s]",
              "\"clutch\" slips to the end, by 22.4 rad/s under the 12 N·m that it can transmit", "run, compare"},
    ClaimKind{
        brake_has_not_stopped, runs, warning, above,
        "a brake that was put on still slips when the sequence and the run have ended, and would stop its shaft in "
        "less than the time of the run; or a repeating sequence releases it each time before its shaft is at rest",
        "at: it was put on, or first released; value: speed of its shaft [rad/s], or how often it was released",
        "\"brake\" has not stopped it by the end: 30 rpm are left after 0.5 s, and 0.4 s more are needed at this rate",
        "run, compare"},
    ClaimKind{steady_motion_unstable, runs, warning, above, "a multiplier of the steady motion is greater than 1",
              "value: the largest multiplier; limit: 1",
              "In the elastic model the steady motion does not last: it is unstable: a deviation doubles in 4.2 cycles",
              "steady"},
    ClaimKind{start_shafts_disagree, runs, warning, above,
              "shafts that no clutch separates start at different speeds, which the scene does not give",
              "value: the difference of speed [rad/s]",
              "\"coupling\" joins shafts that start at 0 rpm and 1455 rpm: the start is a shock",
              "run, compare, steady"},
    ClaimKind{start_unstable, runs, warning, above,
              "a shaft, with those that springs, belts and closed clutches join to it, starts at rest in an unstable "
              "equilibrium: nothing holds it, its acceleration is of the size of rounding, it is accelerated away "
              "1e-4 rad to either side, and nothing else moves it earlier. No figure of a run that lasts longer has a "
              "known error",
              "at: rounding has grown to 1e-9 rad; value: rate at which a deviation grows, λ of e^(λt), of joined "
              "shafts as if they were rigid [1/s]; limit: 0",
              "\"press\" starts in an unstable equilibrium: rounding decides when it leaves it, and to which side; a "
              "deviation "
              "grows tenfold in 0.07 s. Start it at another angle",
              "run, compare, steady"},
    ClaimKind{runs_steadily, runs, note, anything,
              "the mid speed of the cycle is within 0.1 % of its final value, extrapolated from at least three cycles "
              "without a command, and the link does not stand within the cycle",
              "at: end of the run-up; value: mean speed [rad/s]",
              "\"press\" runs steadily at 59.77 rpm from 0.9627 s on", "run, compare, steady"},
    ClaimKind{
        vibrates, runs, note, anything,
        "the motion repeats, and the link does not turn on average; in a run: during its last quarter, or its last "
        "whole oscillation, the link turns to and fro and advances by less than a quarter of its path. It decays or "
        "grows if the amplitude of the last two reversals differs by more than a tenth from that of the first two. For "
        "a link that is slower than 1 % of its usual speed at the end the claim stands beside the conclusion",
        "value: frequency [Hz]",
        "Vibration about a place, elastic: frequency 13 Hz, amplitude 0.0153 rad of \"disc\", stable",
        "run, compare, steady"},
    ClaimKind{works_in_strokes, runs, note, anything,
              "the cycles, or periods of time, repeat, and the link stands within each",
              "at: end of the last cycle; value: its time [s]",
              "\"press\" makes single strokes, one every 1.961 s, and rests between them", "run, compare"},
    ClaimKind{goes_through_sequence, runs, note, anything,
              "a sequence commands the machine, which comes to no steady motion", "value: speed at the end [rad/s]",
              "\"press\" goes through its operating sequence and ends at rest", "run, compare"},
    ClaimKind{does_not_move, runs, note, anything, "the link never moved, and nothing drives it", "none",
              "\"drum\" does not move", "run, compare, steady"},
    ClaimKind{at_rest, runs, note, anything,
              "the link has moved, and stands at the end: its speed stays below 0.1 % of the usual one, or dry "
              "friction holds it soon after that (this hold is the time of rest if friction is the greater part of the "
              "braking torque at 0.1 % and no vibration reverses there)",
              "at: of its rest; value: speed at the end [rad/s]", "\"wheel\" comes to rest at 3.024 s",
              "run, compare, steady, modes"},
    ClaimKind{not_steady_yet, runs, note, anything, "the mid speed is more than 0.1 % away from its limit",
              "at: end of the run; value: remaining change of the mid speed [rad/s]",
              "\"motor\" has not reached a steady motion by 8 s: the mean speed is still 0.852 % below its final value",
              "run, compare, modes"},
    ClaimKind{moves, runs, note, anything,
              "the run is too short for any other claim; a speed beyond 1.5 times the usual one is stated. Or the link "
              "was always slower than 0.1 % of its usual speed, and gathers speed that nothing balances",
              "at: end of the run; value: speed at the end [rad/s]", "\"crank\" is at 149.7 rad/s after 0.1 s",
              "run, compare"},
    ClaimKind{starts, runs, note, anything, "the link stands at the start, and is driven and moves later",
              "at: end of the run-up, where there is one", "\"motor\" starts from rest", "run, compare"},
    ClaimKind{held_by, runs, note, anything,
              "at the end an engaged brake, or a part that is not driven, holds the link, which has never moved or was "
              "brought to rest by it. While the link moves: a motor that gives at least a tenth of its rated torque is "
              "held by a brake on its own shaft, or, if the link vibrates or creeps below 1 % of its usual speed, by "
              "parts at rest or by loads that balance it, or, if it vibrates with the link, by parts at rest",
              "at: of its rest; value: the torque that acts [N·m]", "\"drum\" is held by \"brake\"", "run, compare"},
    ClaimKind{sticks_and_slips, runs, note, above,
              "while the link turns, another shaft comes to rest and moves on in the same sense, three times at least",
              "at: of its first rest; value: how often; limit: 2",
              "\"table\" sticks and slips: it rests 12 times, first at 0.9 s, while \"drive\" turns", "run, compare"},
    ClaimKind{not_confirmed, sure, warning, anything,
              "the errors measured are larger than the requested accuracy, or were not measured",
              "value: measured, limit: requested", "NOT confirmed: accuracy 1e-06 requested, 3.1e-05 measured",
              "run, compare"},
    ClaimKind{machines_failed, sure, warning, above, "variants of a machine did not run to their end",
              "value: how many; limit: 0", "3 of 500 machines failed", "sweep, uncertainty"},
    ClaimKind{outside_data, sure, warning, anything, "the motion takes values from beyond the ends of a table", "none",
              "The torque of \"motor\" is taken from outside its table, which ends at 1796 rpm",
              "all that compute a motion"},
    ClaimKind{limit_exceeded, bears, fault, above, "a value exceeds a limit of the scene by more than its error",
              "value, limit: as in the requirement",
              "1 of 3 ratings EXCEEDED, worst \"belts\", reserve against slip (run): 120 % of the limit, 194.3 N·m of "
              "161.9 N·m",
              "run, compare, steady, modes"},
    ClaimKind{motor_overloaded, bears, fault, above,
              "RMS torque or current of a steady cycle exceeds the rated one, for a motor without a stated duty",
              "value: RMS over rated; limit: 1",
              "\"motor\" gets too hot: the RMS torque of its steady motion is 112 % of the rated one",
              "run, compare, steady"},
    ClaimKind{demand_missed, bears, fault, above, "the sized machine has a δ greater than the demanded one",
              "value: δ reached; limit: δ demanded",
              "The work equation gives 419 kg·m², too small for δ = 0.05: simulated, δ is 0.0561 at the crank", "size"},
    ClaimKind{geometry_faulty, bears, fault, anything, "a pair of gears cannot be made, or cannot run", "none",
              "the teeth of wheel 2 are pointed", "gears"},
    ClaimKind{clutch_slips_closed, bears, warning, above, "a closed clutch that had locked slips again",
              "at: first; value: largest speed of slip [rad/s]",
              "\"clutch\" slips 10 times although it is closed, first at 0.41 s: the torque reaches the 37.5 N·m "
              "that it holds",
              "run, compare"},
    ClaimKind{limiter_slips, bears, warning, above, "a torque limiter that had locked slips",
              "at: first; value: largest speed of slip [rad/s]",
              "\"limiter\" slips once, first at 0.41 s: the torque reaches the 37.5 N·m that it holds", "run, compare"},
    ClaimKind{belt_slips, bears, warning, anything, "a belt slips and grips again", "at: first; value: how often",
              "\"belts\" slips once, first at 0.01642 s, for 2.467 s in all, and grips again", "run, compare"},
    ClaimKind{geometry_doubtful, bears, warning, anything, "a pair of gears can run, but with a defect", "none",
              "wheel 1 is undercut", "gears"},
    ClaimKind{
        margin_missed, bears, warning, below,
        "at an operating speed of the scene the distance of a natural frequency from an excitation is less than the "
        "required margin",
        "value: the least margin; limit: the required margin",
        "2 pairs of a natural frequency and an excitation lie within ± 10 % at 1340 … 1640 rpm: mode 1 at 24.1 Hz and "
        "1× motor, and more",
        "modes"},
    ClaimKind{limit_undecided, bears, note, anything, "the limit lies within the error of the value",
              "value, limit, error: as in the requirement",
              "1 of 3 limits undecided, \"coupling\", vibratory torque (steady): 100 % of the limit",
              "run, compare, steady, modes"},
    ClaimKind{limit_held, bears, note, below, "the value with its error is at most the limit",
              "value, limit: as in the requirement",
              "All 5 ratings assessed hold, the nearest \"clutch\", heat of an engagement (run): 69 % of the limit",
              "run, compare, steady, modes"},
    ClaimKind{
        not_assessed, bears, note, anything,
        "the scene states a limit for a load case that this command does not compute, or that the run does not reach",
        "limit: as in the requirement", "\"coupling\", vibratory torque (steady): not assessed",
        "run, compare, steady, modes"},
    ClaimKind{
        margin_kept, bears, note, above,
        "at the operating speeds of the scene every natural frequency keeps the required margin from every excitation",
        "value: the least margin; limit: the required margin",
        "Every natural frequency keeps ± 10 % from all 4 excitations at 1340 … 1640 rpm; the nearest are mode 1 at "
        "24.1 Hz and 1× motor",
        "modes"},
    ClaimKind{share_holds, bears, note, anything, "share of the machines drawn that meet a limit",
              "value: the share; error: half of its 95 % interval",
              "delta.press <= 0.1 holds in 93.2 … 97.1 % of such machines", "sweep, uncertainty"},
    ClaimKind{speeds_barred, bears, note, anything,
              "at speeds of the examined range a joint exceeds a limit, or a rule bars them",
              "value, limit: where it is exceeded most [N·m]", "2 barred ranges, worst 310 … 355 rpm (main_coupling)",
              "modes"},
    ClaimKind{clutch_slips_engaging, bears, note, above,
              "a clutch slips from its closing to its locking; in the conclusion where it is opened each time before "
              "it locks",
              "at: first; value: largest speed of slip [rad/s]", "\"clutch\" slips while it engages, first at 0.5 s",
              "run, compare"},
    ClaimKind{clutch_opened_by_command, bears, note, anything, "a clutch is open by command", "at: first",
              "\"clutch\" is open by command, first at 0 s", "run, compare"},
    ClaimKind{freewheel_overruns, bears, note, above, "the driven side of a one-way clutch runs ahead",
              "at: first; value: largest speed of slip [rad/s]",
              "\"freewheel\" lets its driven side run ahead, first at 1.2 s", "run, compare"},
    ClaimKind{effect_matters, depends, note, anything,
              "an effect that is off, or elasticity, changes a key figure by 2 % or more", "none",
              "Joint friction, which is off, would change speed fluctuation δ, press from 0.1179 to 0.1886 (+60 %)",
              "run, compare"},
    ClaimKind{
        effects_suffice, depends, note, below,
        "no figure of the machine with fewer effects deviates from that of the full model by more than the tolerance",
        "value: greatest deviation; limit: tolerance", "elasticity is enough", "advise"},
    ClaimKind{figures_told, figures, note, anything, "the requested figures were found", "none",
              "The torque in \"main_coupling\" reaches 6.784 kN·m at 0.845 s", "every command"},
};

constexpr bool stands_in_order() {
  for (std::size_t k = 0; k < kinds.size(); ++k)
    if (kinds[k].predicate != static_cast<Predicate>(k)) return false;
  return kinds.size() == static_cast<std::size_t>(last_predicate) + 1;
}
static_assert(stands_in_order());

}  // namespace

const ClaimKind& kind_of(Predicate predicate) { return kinds[static_cast<std::size_t>(predicate)]; }
std::span<const ClaimKind> claim_kinds() { return kinds; }

}  // namespace kurbel
