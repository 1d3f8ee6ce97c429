// effects_question.cpp — kurbel effects: what each effect changes and costs in a scene.
#include "studies/effects/effect_study.h"
#include "studies/question/question.h"

namespace kurbel {
namespace {

struct NoOptions {};

StudyOutput effects_one_by_one(const Inquiry& inquiry, NoOptions) {
  return output_of(study_effects(inquiry.scene, inquiry.simulation()));
}

}  // namespace

Question effects_question() {
  return make_question({.place = 90,
                        .name = "effects",
                        .arguments = "scene.toml",
                        .help = "what each effect changes and costs; without a scene: the list",
                        .does = "what each effect changes and costs: the full model, and the model without one effect "
                                "at a time, ranked; without a scene: the list of effects"},
                       OptionsOf<NoOptions>(), effects_one_by_one);
}

}  // namespace kurbel
