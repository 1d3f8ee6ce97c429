// orbit.h — the steady motion reached from the start of the scene, found once for all studies.
//
// The machine runs as defined by the scene, with sequence, contacts and internal states, period by period (common period of
// all laws over angle or time), until all switching is done. If successive periods are close, Newton's method on the return
// map completes the search. Its result is accepted only if the run converges to it: the remaining deviation must decrease
// from period to period as predicted by the derivative. Otherwise the run continues.
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "engine/base/enumerators.h"
#include "engine/return_map/return_map.h"

namespace kurbel {

struct OrbitOptions {
  double tolerance = 1e-12;  // of the return map; that of the run is at least 1e-9
  std::string method = "auto";
  int cycles = 1;       // cycles of the machine in one period; up to twelve times as many where the motion needs them
  double budget = 300;  // of processor time, for one integration [s]
  int most_periods = 600;  // periods; the default: four times as many once a period has changed by less than 1e-3
  const std::atomic<bool>* interrupted = nullptr;
  bool clocked = true;  // a clocked sequence keeps to its clock; if it does not, the search begins anew without
  std::function<void(const std::string& what, double fraction)> progress = {};
};

// Options of a scene's run: its budget, and its method unless it integrates over the angle, which has no periods of time.
OrbitOptions orbit_options(const RunSettings& run, const std::atomic<bool>* interrupted = nullptr);
// Options of the return map.
inline ReturnMapOptions map_options(const OrbitOptions& of) {
  return {of.tolerance, of.method, of.cycles, of.budget, of.interrupted, of.clocked};
}

struct Orbit {
  enum class Kind {
    equilibrium,  // all speeds are constant; the reduction link may be at rest
    cycle,        // the motion is periodic
    vibrating,    // the motion is periodic, and the link has zero mean speed
    at_rest,      // nothing moves
    runaway,      // speeds grow without bound
    drifting,     // none of these: the motion keeps changing, or there is no common period
    failed,       // the integration failed
    interrupted
  };
  Kind kind = Kind::failed;
  std::string words;               // description, with the criterion
  bool stable = true;              // by its multipliers; false if they are uncertain or unknown
  bool polished = false;           // found by Newton's method on the return map; else by the run only
  double still_changes = 0;        // change per period, over the rated values
  int cycles = 0;                  // of the run
  double cost = 0;                 // total, in cycles
  State state;                     // a state of the steady motion; for a cycle on its section
  SteadyPoint point;               // for a cycle or a rotating equilibrium: the fixed point and its multipliers
  std::shared_ptr<ReturnMap> map;  // of the point; null if there is no period
  bool repeats() const { return map && (kind == Kind::cycle || kind == Kind::vibrating || kind == Kind::equilibrium); }
};
inline const char* name_of(Orbit::Kind kind) {
  return kind == Orbit::Kind::runaway ? "running away" : enumerator_words<Orbit::Kind::interrupted>(kind);
}

// Throws std::invalid_argument if there can be no common period.
Orbit find_orbit(std::shared_ptr<const Model> model, const OrbitOptions& options);

}  // namespace kurbel
