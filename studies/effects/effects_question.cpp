// effects_question.cpp — kurbel effects: what each effect changes and costs in a scene.
#include <fmt/format.h>

#include "engine/scene/effects.h"
#include "studies/effects/effect_study.h"
#include "studies/question/question.h"
#include "studies/scenes/kinds.h"

namespace kurbel {
namespace {

struct NoOptions {};

std::string list_of_effects() {
  std::string list =
      "elasticity — couplings and shafts twist; needs: a stiffness; states: a twist and a speed each; matters: where "
      "an excitation meets a mode, and for starts and shocks; unless mentioned: off\n";
  for (const EffectFlag& effect : effect_flags())
    list += fmt::format("{} — {}; needs: {}; states: {}; matters: {}; unless mentioned: {}\n", effect.name, effect.adds,
                        effect.parameters, effect.states, effect.matters, unsaid_text(effect));
  return list;
}

StudyOutput effects_one_by_one(const Inquiry& inquiry, NoOptions) {
  if (inquiry.without_scene()) return in_words(list_of_effects());
  return output_of(study_effects(inquiry.scene, inquiry.simulation()));
}

}  // namespace

Question effects_question() {
  return make_question({.place = 90,
                        .name = "effects",
                        .arguments = "scene.toml",
                        .help = "what each effect changes and costs; without a scene: the list",
                        .does = "what each effect changes and costs: the full model, and the model without one effect "
                                "at a time, ranked; without a scene: the list of effects",
                        .alone = "list"},
                       OptionsOf<NoOptions>(), effects_one_by_one);
}

}  // namespace kurbel
