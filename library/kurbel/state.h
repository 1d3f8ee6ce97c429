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

namespace kurbel {

class Machine;
struct SavedParts;
struct MotionParts;

// A moment of a machine as a value: states, modes of all contacts and laws, the place in the operating sequence. Can be
// copied, compared, kept as text and given to another thread or process. Going on from it takes the same steps wherever
// that happens, to the last bit.
class SavedState {
 public:
  explicit SavedState(std::shared_ptr<const SavedParts> parts) : parts_(std::move(parts)) {}
  double time() const;                   // [s]
  const std::vector<double>& y() const;  // in the order of Motion::state_names(): angles, twists, speeds, own states
  std::string text() const;              // JSON, exact
  friend bool operator==(const SavedState& a, const SavedState& b);
  const SavedParts& parts() const { return *parts_; }  // for kurbel itself

 private:
  std::shared_ptr<const SavedParts> parts_;
};

// One thread at a time; any number of motions of one machine may go on side by side.
class Motion {
 public:
  // Begins where the scene says, with its effects or with these (as --effects). `tolerance` is that of a step, over the
  // scale of each state. Throws BadScene, std::invalid_argument.
  explicit Motion(const Machine& machine, const std::string& effects = {}, double tolerance = 1e-9);
  ~Motion();
  Motion(Motion&&) noexcept;
  Motion& operator=(Motion&&) noexcept;

  double time() const;  // [s]
  // On to a time [s], through all events on the way; the solver starts anew there, so few long ways are cheaper than many
  // short ones. Throws std::invalid_argument for a time before now, std::runtime_error in words where the motion cannot
  // go on; it then stands where it stood.
  void go_to(double time);

  SavedState state() const;
  void restore(const SavedState& state);                 // of this machine, or of one with the same states
  SavedState state_from(const std::string& text) const;  // std::invalid_argument for the text of another machine

  std::vector<std::string> names() const;  // of all that can be looked at: "torque.main_coupling"
  std::vector<std::string> units() const;
  double operator[](const std::string& name) const;  // now; std::out_of_range with the nearest names
  std::vector<double> values() const;                // of all names
  std::vector<std::string> state_names() const;

 private:
  std::unique_ptr<MotionParts> parts_;
};

}  // namespace kurbel
