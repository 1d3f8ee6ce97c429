// state.h — a machine in motion under its user's hands: go on to a time, look, keep the moment, come back to it.
//
//     kurbel::Motion motion(machine);
//     motion.go_to(0.2);
//     const kurbel::SavedState here = motion.state();
//     motion.go_to(0.5), motion.restore(here);
#pragma once

#include <memory>
#include <string>
#include <vector>

#include <kurbel/studies.h>

namespace kurbel {

class Machine;
struct SavedParts;
struct MotionParts;

// A moment of a machine as a value: states, modes of all contacts and laws, the place in the operating sequence. Can be
// copied, compared, kept as text and given to another thread or process. Going on from it takes the same steps wherever
// that happens, to the last bit.
class SavedState {
 public:
  explicit SavedState(std::shared_ptr<const SavedParts> parts) : parts_(std::move(parts)) {}  // for kurbel itself
  double time() const;                                                                        // [s]
  // In the order of Motion::state_names() and in SI: angles and twists [rad], speeds [rad/s], states of elements' own.
  const std::vector<double>& y() const;
  // JSON, exact to the last bit; Motion::state_from() reads it.
  std::string text() const;
  // The same moment to the last bit: time, states, modes, what the solver remembers.
  friend bool operator==(const SavedState& a, const SavedState& b);
  const SavedParts& parts() const { return *parts_; }  // for kurbel itself

 private:
  std::shared_ptr<const SavedParts> parts_;
};

// A machine at work: at a time, with a state. For one thread at a time; any number of motions of one machine may go on side
// by side.
class Motion {
 public:
  // Begins where the scene says, with its effects or with these (as `--effects`). `tolerance` is the local error allowed in
  // a step, over the scale of each state: 1e-14 … 0.1. Throws BadScene where the machine cannot be compiled or started,
  // std::invalid_argument for another tolerance and for a multibody scene (run.model must be "reduced").
  explicit Motion(const Machine& machine, const std::string& effects = {}, double tolerance = 1e-9);
  ~Motion();
  Motion(Motion&&) noexcept;             // what is moved from can only be assigned to or destroyed
  Motion& operator=(Motion&&) noexcept;  // likewise

  double time() const;  // where it stands [s]
  // On to a time [s], through all events on the way; the solver starts anew there, so few long ways are cheaper than many
  // short ones. Throws std::invalid_argument for a time before now, std::runtime_error in words where the motion cannot
  // go on or is interrupted; it then stands where it stood.
  void go_to(double time, const Watcher& watcher = {});

  // This moment, to come back to. Later motion does not change it.
  SavedState state() const;
  // Back (or on) to a moment of this machine, or of one with the same states: its time, too. Throws std::invalid_argument
  // for the state of another machine; the motion then stands where it stood.
  void restore(const SavedState& state);
  // A moment of this machine from its text. Throws std::invalid_argument for what is none, and for another machine's.
  SavedState state_from(const std::string& text) const;

  // Of all that can be looked at: "torque.main_coupling", "speed.press".
  std::vector<std::string> names() const;
  // SI, in the order of the names: "N*m", "rad/s"; empty: a plain number.
  std::vector<std::string> units() const;
  // A quantity now, in SI: the torque of a coupling is k θ + c θ̇ at this state. Throws std::out_of_range with the nearest
  // names.
  double operator[](const std::string& name) const;
  // Of all names, now, in SI.
  std::vector<double> values() const;
  // What the entries of SavedState::y() are: "angle of motor", "twist of main_coupling".
  std::vector<std::string> state_names() const;

 private:
  std::unique_ptr<MotionParts> parts_;
};

}  // namespace kurbel
