// machine_parts.h — implementation behind the handles of <kurbel/…>: a machine as read, a study's output, and the
// conversion of scene errors.
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
  std::string text, file;             // as given, without the settings
  std::vector<std::string> settings;  // "main_coupling.stiffness=1 MN*m/rad"
  Scene scene;
  std::function<SceneError(const SceneError&)> placed;  // places an error found later in the text as given
};

struct StudyParts {
  StudyOutput output;
};
inline Study study_of(StudyOutput output) {
  return Study(std::make_shared<const StudyParts>(StudyParts{std::move(output)}));
}

BadScene bad_scene(const SceneError& error);

// A message in the words of a caller: "--mid-speed" is mid_speed. Quotations and command lines ("kurbel sweep …") stay.
std::string for_callers(const std::string& message);

// The result of `ask`; errors are in the words of a caller.
template <class Ask>
auto answered(const Ask& ask) {
  try {
    return ask();
  } catch (const SceneError& error) {
    throw bad_scene(error);
  } catch (const BadScene&) {
    throw;
  } catch (const std::invalid_argument& error) {
    throw std::invalid_argument(for_callers(error.what()));
  }
}
// The same for a machine: errors in its scene are placed in the text as given.
template <class Ask>
auto asked_of(const MachineParts& machine, const Ask& ask) {
  return answered([&] {
    try {
      return ask();
    } catch (const SceneError& error) {
      throw machine.placed(error);
    }
  });
}

Watch watch_of(const Watcher& watcher);

// The inquiry for a question; the machine must outlive it.
Inquiry inquiry_of(const MachineParts& machine, const Watcher& watcher);

// Throws std::out_of_range: `what` has no `name`; the message lists the nearest names.
[[noreturn]] void refuse_name(const std::string& what, const std::string& name, const std::vector<std::string>& names);

}  // namespace kurbel
