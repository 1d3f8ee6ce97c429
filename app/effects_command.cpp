// effects_command.cpp — what effects there are, and what each changes and costs in a scene.
#include <fmt/format.h>

#include <memory>

#include "app/question_command.h"
#include "app/terminal.h"
#include "app/verb.h"
#include "engine/scene/effects.h"

namespace kurbel::app::effects_command {
namespace {

int list_effects() {
  say(
      fmt::format("elasticity — couplings and shafts twist; needs: a stiffness; states: a twist and a speed each; "
                  "matters: where an excitation meets a mode, and for starts and blows; unless mentioned: off\n"));
  for (const EffectFlag& effect : effect_flags())
    say(fmt::format("{} — {}; needs: {}; states: {}; matters: {}; unless mentioned: {}\n", effect.name, effect.adds,
                    effect.parameters, effect.states, effect.matters,
                    effect.unsaid == EffectFlag::Unsaid::off               ? "off"
                    : effect.unsaid == EffectFlag::Unsaid::where_given     ? "on where the scene gives that"
                    : effect.unsaid == EffectFlag::Unsaid::with_elasticity ? "on where anything is elastic"
                                                                           : "on, even in the rigid machine"));
  return exit_done;
}

// The question; without a scene the list of effects.
void set_up(OptionList& command, int& code) {
  const auto options = std::make_shared<StudyOptions>();
  add_study_options(command, *options);
  command.option("scene").required(false);
  command.action([&code, options] {
    code = options->scene.empty() ? list_effects() : answer(question_named("effects"), *options, {});
  });
}

const Verb verb{{question_named("effects"), set_up}};

}  // namespace
}  // namespace kurbel::app::effects_command
