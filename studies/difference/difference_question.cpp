// difference_question.cpp — kurbel diff: the same question put to two scenes.
#include <stdexcept>

#include "studies/difference/difference.h"

namespace kurbel {
namespace {

struct DifferenceAsked {
  std::string of = "run";
  std::optional<double> delta;
  bool measure_error = true;
};

const OptionsOf<DifferenceAsked>& options() {
  static const auto made =
      OptionsOf<DifferenceAsked>()
          .add({.name = "of", .doc = "run (default), steady, modes or size"}, &DifferenceAsked::of)
          .add({.name = "delta", .doc = "demanded δ, of --of size", .example = "0.05", .what = "a plain number"},
               &DifferenceAsked::delta)
          .add({.name = "no_error", .doc = "skip the runs that measure errors: any change counts then"},
               &DifferenceAsked::measure_error, false);
  return made;
}

}  // namespace

const std::vector<DeclaredOption>& difference_options() { return options().declared(); }

StudyOutput difference(const Inquiry& first, const Inquiry& second, const GivenOptions& given) {
  const DifferenceAsked asked = options().read(given, "diff", first.scene, first.dashes);
  MachineQuestion questions[] = {question_of(first, asked.of, asked.measure_error),
                                 question_of(second, asked.of, asked.measure_error)};
  for (MachineQuestion& question : questions) question.delta = asked.delta;
  if (asked.delta && questions[0].of != SweepStudy::size)
    throw std::invalid_argument(first.dashes ? "--delta: belongs to --of size" : "delta: belongs to of = \"size\"");
  first.watch.at(asked.of + " of both", 0);
  return output_of(difference_between(questions[0], questions[1], asked.of));
}

}  // namespace kurbel
