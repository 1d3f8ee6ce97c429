// variant.h — random variants of the example scenes, each made again from its scene's name and its seed.
//
//   const Variant v = make_variant("crank_press", 17);   // v.text is a scene file: print it, save it, run it
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "engine/model/model.h"

namespace kurbel::coverage {

struct Variant {
  std::string scene;  // "crank_press"
  std::uint64_t seed = 0;
  std::string text;  // a whole scene file; CSV files it names lie beside the scene it was made of
  std::string method;
  double accuracy = 1e-6;
  std::map<std::string, int> refused;  // draws that were refused before this one, by reason
  Scene read;                          // of `text`
};

// Names of scenes/*.toml, in alphabetic order.
const std::vector<std::string>& scene_names();
// The settings of a variant: every method of the reduced model, and 1e-2 … 1e-9.
const std::vector<std::string>& methods();
const std::vector<double>& accuracies();

// Physical parameters × 0.7 … 1.4, effects switched, start and end moved, a method and an accuracy drawn. What the
// reader, the compiler or the method refuses is drawn again. Throws std::runtime_error if all draws are refused.
// `length`: of the simulated time, over that of a campaign's variant, which otherwise is the same.
Variant make_variant(const std::string& scene, std::uint64_t seed, double length = 1);

// The same machine started one cycle of its reduction link on, where that changes nothing but its angles: it has a
// cycle, whatever depends on an angle repeats itself after it, and its operating sequence waits for no angle.
std::optional<Scene> started_a_cycle_on(const Model& model);

}  // namespace kurbel::coverage
