// settled_run.h — a machine run from its own start until its motion repeats, and what is measured of it then: what all
// studies must agree with.
//
// Nothing of engine/orbit and studies/steady finds anything here but still_to_come(): the motion is integrated, and
// examined where something repeats, which is the first of these that does:
//   angle   the link passes a multiple of its cycle's angle (2π where there is none)
//   time    a law over time begins anew
//   event   the same component does the same thing again (a table that sticks and slips), where no mechanism and no law
//           over time gives a period
//   none    nothing changes, but the link stands or turns slowly: an equilibrium, examined at regular times
// Repeats: the time from the k-th place before to this one, and speeds and spring twists there, are the same, k ≤ 64.
// Twists of what slips and the elements' internal states are not compared: some of them drift.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "engine/run/recorders.h"

namespace kurbel::agreement {

enum class Motion { repeats, rests, none };
enum class Base { angle, time, event, none };  // what repeats; none: nothing changes, so that any time is a period

struct SettleSettings {
  double tolerance = 1e-10;
  double longest = 400;  // machine time [s]
  double budget = 20;    // processor time of all that is integrated until it is settled [s]
};

// One figure of the settled motion.
struct Measured {
  Name name;
  double value = 0, scale = 0;
  double error = 0;     // of three periods that follow each other, and of one with tolerances 100 × looser
  bool needed = false;  // a study of steady motion must report it
};

struct SettledRun {
  std::shared_ptr<const Model> model;
  Motion kind = Motion::none;
  Base base = Base::angle;
  std::string words;   // how it was found, or why not
  std::string link;    // name of the reduction link's shaft in figures
  double period = 0;   // [s]
  double angle = 0;    // by which the link turns in it [rad]
  double time = 0;     // from the start until settled [s]
  double to_come = 0;  // what the mean speed has still to change, over itself
  Checkpoint at;       // settled
  std::vector<Measured> figures;
  double cpu_seconds = 0;

  bool equilibrium() const;  // the speed of the link does not vary
  const Measured* find(const QuantityKind& what, const std::string& of) const;
};

// Throws as compile() does; a run that fails is of no kind, in words.
SettledRun settle(const Scene& scene, const Effects& effects, const SettleSettings& settings = {});

// How fast a small deviation of all speeds dies away: the factor that a period leaves of it, by two runs side by side.
struct Decay {
  bool measured = false;
  double factor = 0, error = 0;  // not measured: it is below `factor`, lost in what integration leaves
  int periods = 0;
};
Decay decay_of(const SettledRun& run);

// What the machine has at equal angles of its link, one period from a multiple of the cycle's angle on.
struct Place {
  double angle = 0;           // of the link, within the cycle [rad]
  double speed = 0;           // of the link [rad/s]
  double kinetic_energy = 0;  // [J]
};
std::vector<Place> places_of(const SettledRun& run, double cycle, int number);

}  // namespace kurbel::agreement
