// finer_shafts.cpp — the machine with finer shafts, and the differences as errors.
#include "studies/run/finer_shafts.h"

#include <fmt/format.h>

#include "studies/run/measured_errors.h"

namespace kurbel {

std::shared_ptr<const Model> with_finer_shafts(const Model& model) {
  if (model.scene.components.empty()) return nullptr;
  Scene scene = model.scene;
  ++scene.finer_shafts;
  auto finer = compile(scene, model.effects);
  const bool same = finer->network.components == model.network.components &&
                    finer->network.elements.size() == model.network.elements.size();
  return same ? finer : nullptr;
}

double add_shaft_errors(std::vector<Figure>& figures, std::vector<Figure>& states, const std::vector<Figure>& finer,
                        const std::vector<Figure>& finer_states) {
  add_differences(states, finer_states);
  return add_differences(figures, finer);
}

std::vector<std::string> shaft_error_notes(double change, double accuracy, const std::string& why) {
  if (!why.empty()) return {"what the cut of continuous shafts leaves open is not in the errors: " + why};
  if (change <= accuracy) return {};
  return {
      fmt::format("the number of segments of continuous shafts changes figures by up to {:.1e} of their scales; the "
                  "errors include it",
                  change)};
}

}  // namespace kurbel
