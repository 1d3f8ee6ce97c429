// state.h — a machine in motion, controlled by its caller: advance to a time, read values, save the state, restore it.
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

// The state of a machine at one time, as a value: states, modes of all contacts and laws, position in the operating
// sequence. Can be copied, compared, kept as text and passed to another thread or process. Continuing from it takes
// the same steps everywhere, to the last bit.
class SavedState {
 public:
  explicit SavedState(std::shared_ptr<const SavedParts> parts) : parts_(std::move(parts)) {}  // for kurbel itself
  // Moving copies, too: what was moved from is still that state.
  SavedState(const SavedState&) = default;
  SavedState& operator=(const SavedState&) = default;  // likewise
  double time() const;                                 // [s]
  // In the order of Motion::state_names(), in SI: angles and twists [rad], speeds [rad/s], internal states of elements.
  const std::vector<double>& y() const;
  // JSON, exact to the last bit; Motion::state_from() reads it.
  std::string text() const;
  // Equal to the last bit: time, states, modes, memory of the solver.
  friend bool operator==(const SavedState& a, const SavedState& b);
  const SavedParts& parts() const { return *parts_; }  // for kurbel itself

 private:
  std::shared_ptr<const SavedParts> parts_;
};

// A machine in motion: a time and a state. Each Motion is for one thread at a time; any number of motions of one
// machine may run in parallel.
class Motion {
 public:
  // Starts as the scene says, with its effects or with these (as `--effects`). `tolerance` is the local error allowed
  // in a step, over the scale of each state: 1e-14 … 0.1. Throws BadScene if the machine cannot be compiled or
  // started, std::invalid_argument for another tolerance and for a multibody scene (run.model must be "reduced").
  explicit Motion(const Machine& machine, const std::string& effects = {}, double tolerance = 1e-9);
  ~Motion();
  Motion(Motion&&) noexcept;             // what was moved from throws std::logic_error until it is assigned to
  Motion& operator=(Motion&&) noexcept;  // likewise

  double time() const;  // current time [s]
  // Advances to a time [s] through all events on the way. The solver restarts there, so few long steps are cheaper
  // than many short ones. Throws std::invalid_argument for an earlier time, std::runtime_error with the reason if the
  // motion cannot continue or is interrupted; the motion is then unchanged.
  void go_to(double time, const Watcher& watcher = {});

  // The current state, to return to. Later motion does not change it.
  SavedState state() const;
  // Returns to a state of this machine or of one with the same states, including its time. Throws
  // std::invalid_argument for the state of another machine; the motion is then unchanged.
  void restore(const SavedState& state);
  // A state of this machine from its text. Throws std::invalid_argument for other text and for the state of another machine.
  SavedState state_from(const std::string& text) const;

  // Names of all quantities that can be read: "torque.main_coupling", "speed.press".
  std::vector<std::string> names() const;
  // SI, in the order of the names: "N*m", "rad/s"; empty: a plain number.
  std::vector<std::string> units() const;
  // Current value of a quantity, in SI: the torque of a coupling is k θ + c θ̇ at this state. Throws
  // std::out_of_range with the nearest names.
  double operator[](const std::string& name) const;
  // Current values of all names, in SI.
  std::vector<double> values() const;
  // Names of the entries of SavedState::y(): "angle of motor", "twist of main_coupling".
  std::vector<std::string> state_names() const;

 private:
  MotionParts& parts() const;
  std::unique_ptr<MotionParts> parts_;
};

}  // namespace kurbel
