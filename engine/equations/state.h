// state.h — a moment of a machine, as a value: it can be copied, compared, kept, written, and given to another thread.
//
// Whatever the right-hand side reads is computed from (t, y) or stands in Modes; whoever computes has a const Model and
// working memory besides, and nothing that must be remembered.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace kurbel {

struct Sequence;

// What a motor, a clutch or a brake is told by the operating sequence: value + rate (t − from) until its ramp ends, or
// the law over t − from of a step, piece by piece.
struct Command {
  double value = 1, rate = 0, from = 0, until = -1e300, to = 1;
  int law = -1, piece = 0;  // the step whose law it follows; −1: none
  double at(double t, const Sequence& sequence) const;
  bool holds_still() const { return rate == 0 && law < 0; }
  bool operator==(const Command&) const = default;
};

// What holds between events.
struct Modes {
  std::vector<int> piece;             // of the elements' laws, as many as an element asks for
  std::vector<int> prescribed_piece;  // per prescribed speed
  std::vector<char> active;           // per element: within its window of time, and switched on
  std::vector<double> on_since;       // per element: it went on last [s]
  std::vector<int> direction;         // per shaft: sense of motion, 0 = held; 1 where nothing opposes motion
  std::vector<int> slip;              // per elastic joint: sense of slip, 0 = stuck; 1 where there is no contact
  std::vector<int> loss_direction;    // per relation: sense of sliding of a gear with losses
  std::vector<int> loss_sign;         // per relation: sign of what goes on, that is, which flanks carry
  std::vector<char> regularised;      // per contact: its events found no rest, its torque follows its speed smoothly
  std::vector<int> carries;           // per contact: sign of the torque last seen where rows repeat; 0: either way
  std::vector<double> capacity;       // per contact: measure of its share where rows repeat [N·m]

  // Angles in y are kept from first_two_turns · 4π on; what was taken out of them is counted here.
  std::vector<double> turns;   // per tracked angle, in units of two turns
  double first_two_turns = 0;  // in units of two turns

  // The place in the operating sequence.
  std::vector<Command> command;
  std::size_t next_step = 0;
  double armed_time = 1e300, armed_angle = 0, last_step_time = 0;  // [s], [rad], [s]
  double round_began = 1e300;                                      // of a sequence by the clock [s]

  bool operator==(const Modes&) const = default;
};

// y as the equations order it: angles, twists, speeds, the elements' own states. Integrals of an audit are none of it.
struct State {
  double t = 0;
  std::vector<double> y;
  Modes modes;
  bool operator==(const State&) const = default;
};

// Of a tracked angle, all turns counted [rad].
double angle_with_turns(const Modes& modes, std::size_t tracked, std::span<const double> y);
// Takes whole multiples of two turns out of the angles, which come first in y; true if any changed.
bool wrap(Modes& modes, std::span<double> y);
// Angles have grown so far that it pays.
bool needs_wrap(const Modes& modes, std::span<const double> y);

}  // namespace kurbel
