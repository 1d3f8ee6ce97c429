// scene.h — a machine described by its scene, read and validated.
#pragma once

#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace kurbel {

// An error in a user's text: where, and what.
struct Fault {
  std::string file;  // as given; for a setting, the setting
  int line = 0;      // from 1; 0: the file as a whole
  int column = 0;    // from 1, in characters
  std::string text;  // what · got · allowed · next step
};

// A scene that cannot be read or makes no machine. what() has a line "file:line:col: text" for each fault.
class BadScene : public std::invalid_argument {
 public:
  // From the complete message and the individual faults.
  BadScene(const std::string& what, std::vector<Fault> faults)
      : std::invalid_argument(what), faults_(std::move(faults)) {}
  // All faults, in the order of the text.
  const std::vector<Fault>& faults() const { return faults_; }

 private:
  std::vector<Fault> faults_;
};

// Settings applied to a scene: {"main_coupling.stiffness", "1 MN*m/rad"}, as by `--set` of the command.
using Settings = std::vector<std::pair<std::string, std::string>>;

struct MachineParts;

// A value: copies share the data, which never changes. May be used by several threads at once.
class Machine {
 public:
  // From a scene file. Throws BadScene with all faults at once, also for a file that cannot be read. Data files are
  // looked for in the folder of the scene only.
  static Machine from_file(const std::string& path, const Settings& settings = {});
  // From the text of a scene. `file` is its name in messages and need not exist; data files are looked for in its
  // folder. Throws BadScene with all faults at once.
  static Machine from_text(const std::string& text, const std::string& file = "text", const Settings& settings = {});

  // Moving copies, too: what was moved from is still that machine.
  Machine(const Machine&) = default;
  Machine& operator=(const Machine&) = default;  // likewise

  // The same machine with further settings; the last one for a path holds. Throws BadScene.
  Machine with(const Settings& settings) const;

  std::string title() const;                    // as the scene says
  std::string file() const;                     // its name in messages
  std::string text() const;                     // with its settings applied
  std::string effects() const;                  // named in the scene: "elasticity: main_coupling"; "none"
  std::vector<std::string> components() const;  // along the lines, then by name
  std::string explain() const;                  // what is merged, the coordinates, their inertias; throws BadScene
  double until() const;                         // end of its run [s]
  double accuracy() const;                      // required of every figure, over its scale
  // Names and units of the figures that its runs may yield; throws BadScene if it cannot be compiled.
  std::vector<std::pair<std::string, std::string>> figures() const;

  const MachineParts& parts() const { return *parts_; }  // for kurbel itself

 private:
  explicit Machine(std::shared_ptr<const MachineParts> parts) : parts_(std::move(parts)) {}
  std::shared_ptr<const MachineParts> parts_;
};

// What a scene may contain: "coupling", "induction motor", "run", …
std::vector<std::string> kinds();
// The keys of one of kinds(), one per line: unit, default, domain. Throws std::invalid_argument for another name.
std::string keys(const std::string& kind);
// JSON Schema of a scene, draft 2020-12: docs/scene.schema.json.
std::string schema();
std::vector<std::string> example_scenes();           // "press", "pump", …
std::string example_scene(const std::string& name);  // text with comments; std::invalid_argument for an unknown name

}  // namespace kurbel
