// gears_question.cpp — kurbel gears: the gear pairs of a scene.
#include "studies/gears/gears.h"
#include "studies/question/question.h"

namespace kurbel {

const OptionsOf<GearsOptions>& gears_options() {
  static const auto made =
      OptionsOf<GearsOptions>()
          .add({.name = "pair", .doc = "one stage, e.g. gearbox.stage1 (default: all whose module is given)"},
               &GearsOptions::pair)
          .add({.name = "speed",
                .doc = "of the first wheel, e.g. \"1500 rpm\": sliding speeds, mesh frequency",
                .example = "1500 rpm",
                .what = "a speed"},
               &GearsOptions::speed);
  return made;
}

namespace {

StudyOutput gear_pairs(const Inquiry& inquiry, GearsOptions asked) {
  return output_of(find_gears(inquiry.scene, asked));
}

}  // namespace

Question gears_question() {
  return make_question(
      {.place = 60,
       .name = "gears",
       .arguments = "scene.toml",
       .help = "gear pairs: diameters, contact, sliding, undercut, interference, a turning drawing",
       .does = "gear pairs of the stages given by module: diameters, contact ratio, sliding, undercut, "
               "interference, mesh stiffness, a turning drawing; or a pair alone (`--teeth 19 95 --module \"4 "
               "mm\" --shift 0.3 0`)"},
      gears_options(), gear_pairs);
}

}  // namespace kurbel
