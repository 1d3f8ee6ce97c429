// scene.h — a machine as its scene describes it, read and found to be sound.
#pragma once

#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace kurbel {

// Where in a user's text something is wrong, and what.
struct Fault {
  std::string file;  // as it was given; of a setting, the setting
  int line = 0;      // from 1; 0: the file as a whole
  int column = 0;    // from 1, in characters
  std::string text;  // what · got · allowed · next step
};

// A scene that cannot be read or makes no machine. what() has a line "file:line:col: text" for each fault.
class BadScene : public std::invalid_argument {
 public:
  // Of the message as a whole and of its faults one by one.
  BadScene(const std::string& what, std::vector<Fault> faults)
      : std::invalid_argument(what), faults_(std::move(faults)) {}
  // All of them, in the order of the text.
  const std::vector<Fault>& faults() const { return faults_; }

 private:
  std::vector<Fault> faults_;
};

// Values put beside a scene: {"main_coupling.stiffness", "1 MN*m/rad"}, as `--set` of the command does.
using Settings = std::vector<std::pair<std::string, std::string>>;

struct MachineParts;

// A value: copies share what is read, and nothing of it ever changes. May be used by several threads at once.
class Machine {
 public:
  // Of a scene's file. Throws BadScene with all faults at once, and for a file that cannot be read. Data files of a
  // scene are looked for beside it, nowhere else.
  static Machine from_file(const std::string& path, const Settings& settings = {});
  // Of a scene's text. `file` is its name in messages and need not exist; data files are looked for beside it. Throws
  // BadScene with all faults at once.
  static Machine from_text(const std::string& text, const std::string& file = "text", const Settings& settings = {});

  // The same with further settings put in; the later one of a path holds. Throws BadScene.
  Machine with(const Settings& settings) const;

  std::string title() const;                    // as the scene says
  std::string file() const;                     // its name in messages
  std::string text() const;                     // with its settings put in
  std::string effects() const;                  // that it names: "elasticity: main_coupling"; "none"
  std::vector<std::string> components() const;  // along its lines, then by name
  std::string explain() const;                  // what is merged, the coordinates, their inertias; throws BadScene
  double until() const;                         // end of its run [s]
  double accuracy() const;                      // asked of every figure, over its scale
  // Names and units of the figures that its runs may yield; throws BadScene where it cannot be compiled.
  std::vector<std::pair<std::string, std::string>> figures() const;

  const MachineParts& parts() const { return *parts_; }  // for kurbel itself

 private:
  explicit Machine(std::shared_ptr<const MachineParts> parts) : parts_(std::move(parts)) {}
  std::shared_ptr<const MachineParts> parts_;
};

// What may stand in a scene: "coupling", "induction motor", "run", …
std::vector<std::string> kinds();
// The keys of one of kinds(), a line each: unit, default, domain. Throws std::invalid_argument for another name.
std::string keys(const std::string& kind);
// JSON Schema of a scene, draft 2020-12: docs/scene.schema.json.
std::string schema();
std::vector<std::string> example_scenes();           // "press", "pump", …
std::string example_scene(const std::string& name);  // its text, with comments; std::invalid_argument: there is none

}  // namespace kurbel
