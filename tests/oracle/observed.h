// observed.h — a machine's motion as the engine runs it, sampled: all that the classifier knows of a run.
//
// Every step of the run is examined in five points, begin and end among them; a step never goes over an event, so
// what a contact does changes between two steps and not within one. Commands are those in force at the time of the point.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "engine/model/model.h"
#include "engine/run/run.h"

namespace kurbel::oracle {

// The machine at one of the points.
struct Moment {
  double t = 0;                 // [s]
  double angle = 0, speed = 0;  // of the reduction link, turns counted [rad], [rad/s]
  double drive = 0;             // torque of all that drives, reduced to the link [N·m]
  double pushed = 0;            // greatest torque of a source whose own shaft stands, reduced [N·m]
  double load = 0;  // torque of all that neither drives nor opposes motion (weights, springs), reduced [N·m]
  std::vector<double> reported = {};  // commands in force
  std::vector<char> on = {};          // of each element: within its window of time
  bool driven = false;                // a source is within its window of time, and its command is not 0
  bool held = false;                  // the link's shaft is tied to the frame
};

// What a contact did for some time without a change.
struct Stretch {
  enum class State { open, slips, holds };
  State state = State::holds;
  double begin = 0, end = 0;                  // [s]
  double command_begin = 1, command_end = 1;  // that were in force
  double slip = 0;                            // greatest |difference of speeds| [rad/s]
  double slipped = 0;                         // ∫ |difference of speeds| dt [rad]
  double torque = 0;                          // greatest magnitude [N·m]
  double heat = 0;                            // ∫ |torque · difference of speeds| dt [J]
  double sense = 0;                           // of the difference at its end
};

// A clutch, torque limiter, one-way clutch, belt or brake.
struct Contact {
  std::string component, kind;  // kind as scenes name it
  double usual_speed = 1;       // of its first side [rad/s]
  double capacity = 0;          // that it holds at a command of 1 [N·m]; 0: not known
  std::vector<Stretch> stretches = {};
};

struct MotorSeen {
  std::string component;
  double rated_torque = 0, rated_speed = 0;
  double torque = 0, speed = 0;  // at the end
  double command = 1;            // at the end; 0 also outside of its window
  double squares = 0;            // ∫ M² dt [N²·m²·s]
  double late_squares[2] = {};   // of it in the last eighth of the time but one, in the last
  double late_turned[2] = {};    // angles turned in these [rad]
  double greatest = 0;           // |M| [N·m]
};

// Extremes of a joint's torque, or of a shaft's speed.
struct Extremes {
  std::string of;
  double least = HUGE_VAL, greatest = -HUGE_VAL;
  double magnitude() const { return least > greatest ? 0 : std::max(std::abs(least), std::abs(greatest)); }
};

struct Observed {
  std::shared_ptr<const Model> model;
  std::string link;
  std::vector<Moment> moments;  // by time; just before and just after an event at one time
  std::vector<Contact> contacts;
  std::vector<MotorSeen> motors;
  std::vector<Extremes> torques;     // per torque joint of the model
  std::vector<Extremes> speeds;      // per component with a node of its own: of its last shaft
  std::vector<std::string> turning;  // shafts that turn at the end
  double fastest_shaft = 0;          // of them the greatest speed over its usual one
  RunOutcome outcome;
  double cpu_seconds = 0;
};

// Runs the machine from its start. `until` [s]; `budget`: processor time [s].
Observed observe(std::shared_ptr<const Model> model, double until, double budget);

}  // namespace kurbel::oracle
