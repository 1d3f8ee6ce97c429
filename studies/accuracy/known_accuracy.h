// known_accuracy.h — what `kurbel accuracy` measured for a scene, for a run that uses it (--setting FILE).
//
// A run's figures depend on its scene and its options alone: results folders are not searched.
#pragma once

#include <filesystem>
#include <string>

#include "engine/scene/scene.h"

namespace kurbel {

// A method at a tolerance, and its errors in motion and figures of the scene.
struct KnownSetting {
  std::string file;  // the file that states it
  std::string method;
  double tolerance = 0;
  double error = 0;    // largest of the motion's and the figures' relative errors
  double seconds = 0;  // processor time
  std::string describe() const;
};

// Fingerprint of a scene's text: FNV-1a, 64 bits, as hexadecimal digits.
std::string fingerprint(const std::string& scene_text);

// The cheapest setting of the model with these effects whose measured error is at most `accuracy`, from the summary
// written by `kurbel accuracy`. Throws SceneError with the place in that file if it cannot be read, is no such
// summary, belongs to another scene, or has no sufficiently accurate setting for these effects.
KnownSetting known_setting(const std::filesystem::path& summary, const Scene& scene, const Effects& effects,
                           double accuracy);

}  // namespace kurbel
