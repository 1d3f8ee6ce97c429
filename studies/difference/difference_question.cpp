// difference_question.cpp — kurbel diff: the same question put to two scenes.
#include "engine/reading/read_scene.h"
#include "engine/scene/document.h"
#include "studies/difference/difference.h"
#include "studies/question/question.h"
#include "studies/scenes/kinds.h"

namespace kurbel {
namespace {

struct DifferenceRequest : MachineRequest {
  std::string other;  // its file; empty: the same scene
  std::vector<std::string> other_set;
};

StudyOutput difference(const Inquiry& inquiry, DifferenceRequest asked) {
  const MachineQuestion one = question_of(inquiry, asked);
  MachineQuestion other = one;
  if (!asked.other.empty()) other.text = read_text_file(asked.other, max_scene_bytes), other.file = asked.other;
  other.settings.insert(other.settings.end(), asked.other_set.begin(), asked.other_set.end());
  parse_scene(SettledText(other.text, other.file, other.settings), all_kinds(), other.allowed);  // errors first
  inquiry.watch.at(asked.of + " of both", 0);
  return output_of(difference_between(one, other, asked.of));
}

}  // namespace

Question difference_question() {
  return make_question(
      {.place = 22,
       .name = "diff",
       .arguments = "a.toml b.toml",
       .help = "two machines figure by figure, and what differs in their scenes",
       .does = "puts the same question (`--of`) to two scenes, or to one with other values (`--other-set`): every "
               "figure of both with its error, whether they differ by more than that, and the keys that differ",
       .more = {"a.toml a.toml --other-set \"main_coupling.stiffness=1 MN*m/rad\" | the effect of one value"}},
      OptionsOf<DifferenceRequest>()
          .add({.name = "other", .doc = "scene file of the other machine", .by_place = true}, &DifferenceRequest::other)
          .add({.name = "other_set",
                .doc = "COMPONENT.KEY=VALUE in the other machine alone; --set holds for both; repeatable",
                .each_time = true},
               &DifferenceRequest::other_set)
          .add(machine_options()),
      difference);
}

}  // namespace kurbel
