// effects_command.cpp — what effects there are, and what each changes and costs in a scene.
#include <fmt/format.h>

#include <memory>

#include "app/command_line.h"
#include "app/terminal.h"
#include "app/verb.h"
#include "studies/effects/effect_study.h"

namespace kurbel::app::effects_command {
namespace {

int list_effects() {
  say(
      fmt::format("elasticity — couplings and shafts twist; needs: a stiffness; states: a twist and a speed each; "
                  "matters: where an excitation meets a mode, and for starts and blows; unless mentioned: off\n"));
  for (const EffectFlag& effect : effect_flags())
    say(fmt::format("{} — {}; needs: {}; states: {}; matters: {}; unless mentioned: {}\n", effect.name, effect.adds,
                    effect.parameters, effect.states, effect.matters,
                    effect.unsaid == EffectFlag::Unsaid::off           ? "off"
                    : effect.unsaid == EffectFlag::Unsaid::where_given ? "on where the scene gives that"
                                                                       : "on, even in the rigid machine"));
  return exit_done;
}

int study(const StudyOptions& arguments) {
  if (arguments.scene.empty()) return list_effects();
  const Scene scene = read(arguments);
  check_folder(arguments);
  Progress progress(arguments.quiet);
  const EffectStudy found = study_effects(scene, simulate_options(arguments, progress));
  return present(output_of(found), arguments);
}

void set_up(OptionList& command, int& code) {
  const auto arguments = std::make_shared<StudyOptions>();
  add_study_options(command, *arguments);
  command.option("scene").required(false);
  command.action([&code, arguments] { code = study(*arguments); });
}

const Verb verb{{.place = 90,
                 .name = "effects",
                 .arguments = "scene.toml",
                 .help = "what each effect changes and costs; without a scene: the list",
                 .does = "what each effect changes and costs: the full model, and the model without one effect at a "
                         "time, ranked; without a scene: the list of effects",
                 .set_up = set_up}};

}  // namespace
}  // namespace kurbel::app::effects_command
