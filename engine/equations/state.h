// state.h — complete state of a machine as a value: it can be copied, compared, stored, and passed to another thread.
//
// All inputs of the right-hand side are computed from (t, y) or are in Modes; evaluation needs a const Model and working
// memory in addition, but no other memory of the past.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace kurbel {

struct Sequence;

// Command of a motor, clutch or brake from the operating sequence: value + rate (t − from) until the ramp ends, or the
// law of a step over t − from, piece by piece.
struct Command {
  double value = 1, rate = 0, from = 0, until = -1e300, to = 1;
  int law = -1, piece = 0;  // step with the law that it follows; −1: none
  double at(double t, const Sequence& sequence) const;
  bool holds_still() const { return rate == 0 && law < 0; }
  bool operator==(const Command&) const = default;
};

// The modes, constant between events.
struct Modes {
  std::vector<int> piece;             // of the elements' laws, as many as the elements need
  std::vector<int> prescribed_piece;  // per prescribed speed
  std::vector<char> active;           // per element: within its window of time, and switched on
  std::vector<double> on_since;       // per element: time of the last switching on [s]
  std::vector<int> direction;         // per shaft: direction of motion, 0 = held; 1 if nothing opposes motion
  std::vector<int> slip;              // per elastic joint: direction of slip, 0 = stuck; 1 if there is no contact
  std::vector<int> loss_direction;    // per relation: direction of sliding of a gear with losses
  std::vector<int> loss_sign;         // per relation: sign of the torque passed on, that is, the flanks in contact
  std::vector<char> regularised;      // per contact: its events chattered; its torque is a smooth function of its speed
  std::vector<double> capacity;       // per contact in redundant rows: hold at the last event [N·m]

  // Angles in y start from first_two_turns · 4π; the removed turns are counted here.
  std::vector<double> turns;   // per tracked angle, in units of two turns
  double first_two_turns = 0;  // in units of two turns

  // Progress of the operating sequence.
  std::vector<Command> command;
  std::size_t next_step = 0;
  double armed_time = 1e300, armed_angle = 0, last_step_time = 0;  // [s], [rad], [s]
  double cycle_began = 1e300;                                      // of a sequence with a fixed period [s]

  bool operator==(const Modes&) const = default;
};

// y in the order of the equations: angles, twists, speeds, internal states of the elements; without the audit integrals.
struct State {
  double t = 0;
  std::vector<double> y;
  Modes modes;
  bool operator==(const State&) const = default;
};

// A tracked angle including all turns [rad].
double angle_with_turns(const Modes& modes, std::size_t tracked, std::span<const double> y);
// Removes whole multiples of two turns from the angles, which are first in y; true if any changed.
bool wrap(Modes& modes, std::span<double> y);
// The angles are large enough to be wrapped.
bool needs_wrap(const Modes& modes, std::span<const double> y);

}  // namespace kurbel
