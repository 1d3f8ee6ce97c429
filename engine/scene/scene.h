// scene.h — a machine as its file describes it: plain values in SI, each with its place in the file.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "engine/scene/effects.h"
#include "engine/scene/keys.h"
#include "engine/scene/messages.h"
#include "engine/scene/speed_unit.h"

namespace kurbel {

// Start of one component: what is not given follows from the others.
struct ComponentStart {
  std::optional<double> angle = {}, speed = {}, twist = {};  // rad, rad/s, rad
  Location at;
};

struct StartSettings {
  bool equilibrium = false;  // twists balance the loads
  double angle = 0, speed = 0;
  std::string on;  // component that angle and speed belong to; empty: the reduction link
  std::map<std::string, ComponentStart> components;
  Location at;
};

struct RunSettings {
  StartSettings start;
  double until = 1;        // s
  double accuracy = 1e-6;  // measured error of every figure over its scale
  std::string method = "auto";
  std::string model = "reduced";
  Location method_at = {}, model_at = {};  // where the file says so; else of [run]
  int samples = 1000;                      // rows of the trajectory
  std::vector<std::string> output;         // components in the trajectory; empty: all (both ends of long chains)
  double budget = 300;                     // s of CPU time for one integration
};

// One step of an operating sequence: when it happens, what it sets.
struct SequenceStep {
  enum class When { at, after, angle, speed_above, speed_below };
  When when = When::after;
  double value = 0;              // s, s, rad, rad/s, rad/s
  std::string of = {};           // the component whose angle or speed it waits for
  std::vector<std::string> set;  // components
  double to = 1;                 // 1 on, 0 off, between: part; −1: reversed
  double over = 0;               // ramp [s]
  Curve law = {};                // in their place: the value over the time since the step [s] → [1]; empty: none
  Location at = {};
};
struct Sequence {
  std::vector<SequenceStep> steps;  // each waits for the one before it
  bool repeat = false;
  double every = 0;  // a round begins so long after the one before it began [s]; 0: as its first step says

  // Its rounds take as long as their steps do.
  bool repeats_freely() const { return repeat && every == 0; }
};

// [operation]: where the machine runs for long, and what excites it besides its own laws.
struct Operation {
  // A harmonic of a frequency converter: output · its output frequency + mains · the mains', as "6 output - 6 mains".
  struct Harmonic {
    std::string text;
    double output = 0, mains = 0;
  };
  std::vector<double> speeds;        // the speed, or the slowest and the fastest [rad/s]; empty: not said
  std::string on;                    // component whose they are; empty: the reduction link
  double margin = 0.1;               // wanted between natural frequencies and excitations, of these
  std::optional<double> mains = {};  // [Hz]
  std::vector<Harmonic> converter;
  std::string motor;                                  // that the converter feeds
  std::optional<int> pole_pairs = {};                 // of that motor; none: as its data say
  std::map<std::string, std::vector<double>> orders;  // that components excite besides: blades, teeth
};

// A row of components along a shaft, beginning at a component of another line ("" for the main line).
struct Line {
  std::string from = {};  // "gearbox.out"
  std::vector<std::string> names = {};
  Location at = {};
  std::vector<Location> name_at = {};
  std::string to = {};  // of a branch that closes a loop: where it ends; "planetary.ring"
  Location to_at = {};
};

struct Scene {
  std::string file, title, text;      // the text with its settings put in
  std::vector<std::string> settings;  // given beside the file: "main_coupling.stiffness=1 MN*m/rad"
  std::vector<Line> lines;            // main line first, branches in canonical order
  std::vector<Section> components;    // canonical order: along the lines, then by name
  Effects effects;
  Sequence sequence;
  RunSettings run;
  Operation operation;
  SpeedUnit speed_unit;  // of the first speed in the file
  int finer_shafts = 0;  // steps by which continuous shafts are cut finer than they need: told by no key

  const Section* find(const std::string& name) const;
  // Its title, else its file, and what was set beside it.
  std::string heading() const;
};

// Methods that integrate a model ("reduced", "multibody"); check_method throws std::invalid_argument for another one.
const std::vector<std::string>& methods_of(const std::string& model);
void check_method(const std::string& method, const std::string& model);

// Keys of [run] and of [operation], for the docs.
const std::vector<Key>& run_keys();
const std::vector<Key>& operation_keys();

}  // namespace kurbel
