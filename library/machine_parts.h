// machine_parts.h — what stands behind the handles of <kurbel/…>: a machine as it was read, a study's output, and how
// faults of a scene leave the library.
#pragma once

#include <kurbel/scene.h>
#include <kurbel/studies.h>

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "engine/scene/scene.h"
#include "studies/findings/output.h"
#include "studies/findings/watch.h"

namespace kurbel {

struct Inquiry;

struct MachineParts {
  std::string text, file;             // as they were given, without the settings
  std::vector<std::string> settings;  // "main_coupling.stiffness=1 MN*m/rad"
  Scene scene;
  std::function<SceneError(const SceneError&)> placed;  // a fault of what is built later, in the text as it was given
};

struct StudyParts {
  StudyOutput output;
};
inline Study study_of(StudyOutput output) {
  return Study(std::make_shared<const StudyParts>(StudyParts{std::move(output)}));
}

BadScene bad_scene(const SceneError& error);

// What `ask` answers; faults that it finds in the machine's scene as BadScene, placed in the text as it was given.
template <class Ask>
auto asked_of(const MachineParts& machine, const Ask& ask) {
  try {
    return ask();
  } catch (const SceneError& error) {
    throw bad_scene(machine.placed(error));
  }
}

Watch watch_of(const Watcher& watcher);

// The machine as it is put to a question; it must outlive that.
Inquiry inquiry_of(const MachineParts& machine, const Watcher& watcher);

// Throws std::out_of_range: `what` has no `name`, but names like it.
[[noreturn]] void refuse_name(const std::string& what, const std::string& name, const std::vector<std::string>& names);

}  // namespace kurbel
