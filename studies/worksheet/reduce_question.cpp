// reduce_question.cpp — kurbel reduce: inertia and torques reduced to one link.
#include <stdexcept>

#include "studies/worksheet/reduce_sheet.h"
#include "studies/worksheet/sheet_options.h"

namespace kurbel {
namespace {

struct ReduceRequest : ReduceOptions {
  SheetRequest sheet;
  ReduceSheetRequest request;
};

StudyOutput reduced(const Inquiry& inquiry, ReduceRequest asked) {
  const std::optional<Paper> paper = asked.sheet.sheet();
  if (!paper && (asked.request.delta || !asked.request.flywheel.empty()))
    throw std::invalid_argument("--delta and --flywheel are of the sheet's flywheel; add --sheet, or ask kurbel size");
  if (!paper) return output_of(reduce(inquiry.scene, asked));
  asked.request.paper = *paper;
  asked.request.author = inquiry.author;
  return output_of(sheet_of(inquiry.scene, asked, asked.request));
}

OptionsOf<ReduceRequest> options() {
  return OptionsOf<ReduceRequest>()
      .add(
          {.name = "positions", .doc = "positions over the cycle (default: 12)", .domain = {.low = 1, .high = 100'000}},
          &ReduceOptions::positions)
      .add({.name = "to", .doc = "shaft or slider, e.g. gearbox.in, flywheel, press.slider (default: the crank)"},
           &ReduceOptions::to)
      .add({.name = "at",
            .doc = "the machine in another state: after \"step 2\" of the sequence, at \"1.5 s\", or at a "
                   "speed such as \"60 rpm\""},
           OptionForm::one,
           [](ReduceRequest& asked, const OptionValues& given) { asked.at = given.moment(asked.speed); })
      .add({.name = "speed",
            .doc = "of the crank, for torques that depend on it (default: the operating speed)",
            .example = "60 rpm",
            .what = "a speed > 0",
            .domain = positive},
           &ReduceOptions::speed)
      .add({.name = "basis",
            .doc = "classical (rigid machine at constant speed) or steady (the steady cycle with the scene's effects; "
                   "default where the classical one omits an effect)"},
           &ReduceOptions::basis,
           std::vector{std::pair("classical", CycleBasis::classical), std::pair("steady", CycleBasis::steady)})
      .add(arc_range(), OptionForm::several, take_arc_range<ReduceRequest>)
      .add({.name = "orders", .doc = "harmonics up to this order (default: 12)", .domain = {.low = 1, .high = 1000}},
           &ReduceOptions::orders)
      .add(sheet_options(), &ReduceRequest::sheet)
      .add({.name = "delta",
            .doc = "of the sheet's flywheel: demanded δ, e.g. 1/80 (default: what the machine has with its own)",
            .example = "0.05",
            .what = "a plain number"},
           OptionForm::one, [](ReduceRequest& asked, const OptionValues& given) { given.read(asked.request.delta); })
      .add({.name = "flywheel",
            .doc = "of the sheet: component to size (default: the scene's flywheel, else one on the crank)"},
           OptionForm::one,
           [](ReduceRequest& asked, const OptionValues& given) { given.read(asked.request.flywheel); });
}

}  // namespace

Question reduce_question() {
  return make_question({.place = 30,
                        .name = "reduce",
                        .arguments = "scene.toml",
                        .help = "inertia, torques and drive reduced to one shaft or slider",
                        .does = "inertia, torques and the drive's elastic chain on any shaft or slider (`--to`), "
                                "harmonics; a sheet of the positions to be printed (`--sheet`)"},
                       options(), reduced);
}

}  // namespace kurbel
