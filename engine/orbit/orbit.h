// orbit.h — where the scene's own start leads to: the motion that the machine keeps, found once for all studies.
//
// The machine runs as the scene says, sequence, contacts and own states included, round by round (a round: the common
// period of all that reads an angle or time), until nothing is left that is to be switched. Where rounds come near to each
// other, Newton's method on the return map goes the rest of the way; what it finds counts only if the run was on its way
// there: what is left must shrink from one round to the next as the derivative says. What does not settle that way, runs on.
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "engine/base/enumerators.h"
#include "engine/return_map/return_map.h"

namespace kurbel {

struct OrbitOptions {
  double tolerance = 1e-12;  // of the return map; the run's is 1e-9 at the least
  std::string method = "auto";
  int cycles = 1;       // of the machine in one round
  double budget = 300;  // of processor time, for one integration [s]
  int most_rounds = 600;
  const std::atomic<bool>* interrupted = nullptr;
  std::function<void(const std::string& what, double fraction)> progress = {};
};

// As a scene's run asks for it: its budget, and its method unless that goes over the angle, where no round is one of time.
OrbitOptions orbit_options(const RunSettings& run, const std::atomic<bool>* interrupted = nullptr);
// Of the return map.
inline ReturnMapOptions map_options(const OrbitOptions& of) {
  return {of.tolerance, of.method, of.cycles, of.budget, of.interrupted};
}

struct Orbit {
  enum class Kind {
    equilibrium,  // all speeds keep; the reduction link may stand
    cycle,        // everything comes again after a round
    vibrating,    // so it does, and the link does not turn in the mean
    at_rest,      // nothing moves
    runaway,      // speeds grow beyond bounds
    drifting,     // neither: it goes on changing, or nothing has a common period
    failed,       // the run broke down
    interrupted
  };
  Kind kind = Kind::failed;
  std::string words;               // what it is, and what decides that
  bool stable = true;              // as its multipliers say; false where they are uncertain or unknown
  bool polished = false;           // by Newton on the return map; else as near as the run came
  double still_changes = 0;        // from round to round, of the rated values
  int rounds = 0;                  // that the run took
  double cost = 0;                 // of all, in cycles
  State state;                     // in the steady motion: on the section of a cycle
  SteadyPoint point;               // of a cycle or an equilibrium that turns: the fixed point and its multipliers
  std::shared_ptr<ReturnMap> map;  // of it; null where nothing comes round
  bool repeats() const { return map && (kind == Kind::cycle || kind == Kind::vibrating || kind == Kind::equilibrium); }
};
inline const char* name_of(Orbit::Kind kind) {
  return kind == Orbit::Kind::runaway ? "running away" : enumerator_words<Orbit::Kind::interrupted>(kind);
}

// Throws std::invalid_argument in words where nothing can have a period in common.
Orbit find_orbit(std::shared_ptr<const Model> model, const OrbitOptions& options);

}  // namespace kurbel
