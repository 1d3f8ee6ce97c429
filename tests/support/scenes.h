// scenes.h — runs scenes in tests as a user would, and looks up figures by name.
#pragma once

#include <gtest/gtest.h>

#include <memory>
#include <string>

#include "engine/model/model.h"
#include "engine/scene/scene.h"
#include "studies/run/simulate.h"
#include "studies/scenes/kinds.h"

namespace kurbel::test {

inline std::string source_path(const std::string& relative) { return KURBEL_SOURCE_DIR "/" + relative; }

inline Scene scene_from(const std::string& text) { return parse_scene(text, "test.toml", all_kinds()); }
inline Scene scene_file(const std::string& relative) { return read_scene(source_path(relative), all_kinds()); }

// Compiled with the scene's own effects.
inline std::shared_ptr<const Model> model_of(const Scene& scene) { return compile(scene, scene.effects); }
inline std::shared_ptr<const Model> model_of(const std::string& text) { return model_of(scene_from(text)); }

// Runs with the scene's own effects; errors are measured unless switched off.
inline Result run(const Scene& scene, bool measure_error = true) {
  return simulate(scene, scene.effects, "test",
                  SimulateOptions{.measure_error = measure_error, .method = {}, .accuracy = {}, .until = {}});
}
inline Result run(const std::string& text, bool measure_error = true) { return run(scene_from(text), measure_error); }

inline double figure(const Result& result, const std::string& name) {
  const Figure* found = result.find(name);
  EXPECT_NE(found, nullptr) << "no figure " << name;
  return found ? found->value : std::nan("");
}

// A state at a given time: runs until then, without errors.
inline Result run_until(Scene scene, double t) {
  scene.run.until = t;
  return run(scene, false);
}

}  // namespace kurbel::test
