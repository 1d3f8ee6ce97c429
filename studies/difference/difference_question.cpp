// difference_question.cpp — kurbel diff: the same question put to two scenes.
#include "studies/difference/difference.h"

namespace kurbel {
namespace {

const OptionsOf<MachineAsked>& options() {
  static const auto made = machine_options();
  return made;
}

}  // namespace

const std::vector<DeclaredOption>& difference_options() { return options().declared(); }

StudyOutput difference(const Inquiry& first, const Inquiry& second, const GivenOptions& given) {
  const MachineAsked asked = options().read(given, "diff", first.scene);
  const MachineQuestion one = question_of(first, asked), other = question_of(second, asked);
  first.watch.at(asked.of + " of both", 0);
  return output_of(difference_between(one, other, asked.of));
}

}  // namespace kurbel
