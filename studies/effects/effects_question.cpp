// effects_question.cpp — kurbel effects: what each effect changes and costs in a scene.
#include <fmt/format.h>

#include "engine/scene/effects.h"
#include "studies/effects/effect_study.h"
#include "studies/question/question.h"
#include "studies/scenes/kinds.h"

namespace kurbel {
namespace {

struct NoOptions {};

struct ListedEffect {
  std::string name, adds, needs, states, matters, unsaid;
};

std::vector<ListedEffect> list_of_effects() {
  std::vector<ListedEffect> list = {{"elasticity", "couplings and shafts twist", "a stiffness",
                                     "a twist and a speed each",
                                     "where an excitation meets a mode, and for starts and shocks", "off"}};
  for (const EffectFlag& e : effect_flags())
    list.push_back({e.name, e.adds, e.parameters, e.states, e.matters, unsaid_text(e)});
  return list;
}

StudyOutput all_effects() {
  const std::vector<ListedEffect> list = list_of_effects();
  std::string words;
  for (const ListedEffect& e : list)
    words += fmt::format("{} — {}; needs: {}; states: {}; matters: {}; unless mentioned: {}\n", e.name, e.adds, e.needs,
                         e.states, e.matters, e.unsaid);
  StudyOutput output = in_words(std::move(words));
  output.title = "Effects";
  output.reports_complete = false;
  output.conclude(true, fmt::format("{} effects can be simulated.", list.size()));
  output.record("effects", each(list, [](const ListedEffect& e) {
                  return Record{{"effect", e.name},   {"adds", e.adds},       {"needs", e.needs},
                                {"states", e.states}, {"matters", e.matters}, {"unless_mentioned", e.unsaid}};
                }));
  return output;
}

StudyOutput effects_one_by_one(const Inquiry& inquiry, NoOptions) {
  if (inquiry.without_scene()) return all_effects();
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
