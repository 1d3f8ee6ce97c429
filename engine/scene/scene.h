// scene.h — a machine as described in its file: plain values in SI with their locations in the file.
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

// Start of one component; values not given follow from the others.
struct ComponentStart {
  std::optional<double> angle = {}, speed = {}, twist = {};  // rad, rad/s, rad
  Location at;
};

struct StartSettings {
  bool equilibrium = false;  // twists in equilibrium with the loads
  double angle = 0, speed = 0;
  std::string on;  // component of angle and speed; empty: the reduction link
  std::map<std::string, ComponentStart> components;
  Location at;
};

struct RunSettings {
  StartSettings start;
  double until = 1;        // s
  double accuracy = 1e-6;  // measured error of every figure over its scale
  std::string method = "auto";
  std::string model = "reduced";
  Location method_at = {}, model_at = {};  // in the file; else of [run]
  int samples = 1000;                      // rows of the trajectory
  std::vector<std::string> output;         // components in the trajectory; empty: all (both ends of long chains)
  double budget = 300;                     // s of CPU time for one integration
};

// One step of an operating sequence: its time and its commands.
struct SequenceStep {
  enum class When { at, after, angle, speed_above, speed_below };
  When when = When::after;
  double value = 0;              // s, s, rad, rad/s, rad/s
  std::string of = {};           // component of the angle or speed
  std::vector<std::string> set;  // components
  double to = 1;                 // 1: on, 0: off, between: partly; −1: reversed
  double over = 0;               // ramp [s]
  Curve law = {};                // instead: the value over the time since the step [s] → [1]; empty: none
  Location at = {};
};
struct Sequence {
  std::vector<SequenceStep> steps;  // each waits for the one before it
  bool repeat = false;
  double every = 0;  // period of the repetition [s]; 0: by its steps

  // The period is the duration of the steps.
  bool repeats_freely() const { return repeat && every == 0; }
};

// [[figure]]: a functional of a channel over a window, as its keys say (figure_keys).
struct FigureRequest {
  std::string functional, channel, level, window;
  int step = 0;  // of the sequence, from 1, in place of the window; 0: none
  Location at = {};
};

// [operation]: operating speeds of the machine, and excitations in addition to its own laws.
struct Operation {
  // A harmonic of a frequency converter: output · its output frequency + mains · the mains', as "6 output - 6 mains".
  struct Harmonic {
    std::string text;
    double output = 0, mains = 0;
  };
  std::vector<double> speeds;        // one speed, or minimum and maximum [rad/s]; empty: not given
  std::string on;                    // component of the speeds; empty: the reduction link
  double margin = 0.1;               // required between natural frequencies and excitations, over the latter
  std::optional<double> mains = {};  // [Hz]
  std::vector<Harmonic> converter;
  std::string motor;                                  // supplied by the converter
  std::optional<int> pole_pairs = {};                 // of that motor; empty: by its data
  std::map<std::string, std::vector<double>> orders;  // additional excitations of components: blades, teeth
};

// A row of components along a shaft, beginning at a component of another line ("" for the main line).
struct Line {
  std::string from = {};  // "gearbox.out"
  std::vector<std::string> names = {};
  Location at = {};
  std::vector<Location> name_at = {};
  std::string to = {};  // end of a branch that closes a loop: "planetary.ring"
  Location to_at = {};
};

struct Scene {
  std::string file, title, text;      // text: with the settings inserted
  std::vector<std::string> settings;  // given in addition to the file: "main_coupling.stiffness=1 MN*m/rad"
  std::vector<Line> lines;            // main line first, branches in canonical order
  std::vector<Section> components;    // canonical order: along the lines, then by name
  Effects effects;
  Sequence sequence;
  RunSettings run;
  Operation operation;
  std::vector<FigureRequest> figures;
  SpeedUnit speed_unit;  // of the first speed in the file
  int finer_shafts = 0;  // steps of refinement of continuous shafts; not a key of the scene

  const Section* find(const std::string& name) const;
  // Its title, or its file, and its settings.
  std::string heading() const;
};

// Methods for a model ("reduced", "multibody"); check_method throws std::invalid_argument for other methods.
const std::vector<std::string>& methods_of(const std::string& model);
void check_method(const std::string& method, const std::string& model);

// Keys of [run], of [operation] and of a [[figure]], for the docs.
const std::vector<Key>& run_keys();
const std::vector<Key>& operation_keys();
const std::vector<Key>& figure_keys();

}  // namespace kurbel
