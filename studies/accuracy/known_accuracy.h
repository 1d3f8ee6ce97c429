// known_accuracy.h — what `kurbel accuracy` measured of a scene, for a run that is told to use it (--setting FILE).
//
// A run's figures depend on its scene and its options alone. What lies in a results folder is never looked for.
#pragma once

#include <filesystem>
#include <string>

#include "engine/scene/scene.h"

namespace kurbel {

// A method at a tolerance, and what it did to the scene's motion and figures.
struct KnownSetting {
  std::string file;  // that says so
  std::string method;
  double tolerance = 0;
  double error = 0;    // largest of the motion's and the figures' relative errors
  double seconds = 0;  // processor time
  std::string describe() const;
};

// Of a scene's text: FNV-1a, 64 bits, as hexadecimal digits.
std::string fingerprint(const std::string& scene_text);

// The cheapest setting of the model with these effects whose measured error is at most `accuracy`, from the summary
// that `kurbel accuracy` wrote. Throws SceneError with the place in that file where it cannot be read, is none, is of
// another scene, or has no setting for these effects that is exact enough.
KnownSetting known_setting(const std::filesystem::path& summary, const Scene& scene, const Effects& effects,
                           double accuracy);

}  // namespace kurbel
