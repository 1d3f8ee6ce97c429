// modes_question.cpp — kurbel modes: natural frequencies, critical speeds, forced response.
#include <tuple>

#include "studies/modes/modes.h"
#include "studies/question/question.h"

namespace kurbel {
namespace {

struct ModesRequest : ModesOptions {
  ModesRequest() { spot_checks = 2; }
  std::optional<Effects> effects;
  std::vector<std::string> cases;
};

StudyOutput natural_modes(const Inquiry& inquiry, ModesRequest asked) {
  asked.watch = inquiry.watch;
  ModesStudy study = find_modes(inquiry.scene, asked.effects.value_or(effects_of_modes(inquiry.scene)), asked);
  study.cases = find_cases(inquiry, asked.cases, asked.effects, asked, study);
  return output_of(std::move(study));
}

OptionsOf<ModesRequest> options() {
  return OptionsOf<ModesRequest>()
      .add({.name = "effects",
            .doc = "as in [effects], or elasticity:COUPLING,... (default: the scene's, with all elasticity where it "
                   "has none)"},
           &ModesRequest::effects)
      .add({.name = "count", .doc = "number of modes (default: 20)", .domain = {.low = 1, .high = 1000}},
           &ModesOptions::count)
      .add({.name = "at", .doc = "as the machine is after a step of its sequence or at a time: \"step 2\", \"1.5 s\""},
           OptionForm::one,
           [](ModesRequest& asked, const OptionValues& given) { asked.at = given.moment(asked.speed); })
      .add({.name = "speed",
            .doc = "operating point, e.g. \"300 rpm\" of the reduction link (default: where the scene's own start "
                   "leads to)",
            .example = "300 rpm",
            .what = "a speed"},
           &ModesOptions::speed)
      .add({.name = "angle",
            .doc = "holds the reduction link at an angle instead of averaging over the cycle, e.g. \"90 deg\"",
            .example = "90 deg",
            .what = "an angle"},
           &ModesOptions::angle)
      .add({.name = "range",
            .doc = "speeds that the forced response spans, e.g. \"0..3000 rpm\", or \"0 rpm\" \"3000 rpm\"",
            .example = "300 rpm",
            .what = "two speeds ≥ 0, the slower first, e.g. \"0..3000 rpm\"",
            .domain = not_negative,
            .count = 2},
           OptionForm::several,
           [](ModesRequest& asked, const OptionValues& given) {
             std::tie(asked.slowest, asked.fastest) = given.range();
           })
      .add({.name = "orders",
            .doc = "highest excitation order (default: 12 … 24)",
            .example = "12",
            .what = "a plain number > 0, at most 1000",
            .domain = {.low = 0, .high = 1000, .low_open = true}},
           &ModesOptions::orders)
      .add({.name = "barred",
            .doc = "bars speeds where the torque of a joint without limits oscillates by more than this times its mean "
                   "or the rated torque (default: 1)",
            .example = "1",
            .what = "a plain number > 0",
            .domain = positive},
           &ModesOptions::barred_factor)
      .add({.name = "spot_checks",
            .doc = "number of speeds, those of the largest loads, at which the nonlinear cycle is compared with the "
                   "linear response (default: 2; 0: none)",
            .domain = {.low = 0, .high = 100}},
           &ModesOptions::spot_checks)
      .add({.name = "spot",
            .doc = "a further such speed, e.g. \"250 rpm\"; may be given again",
            .example = "250 rpm",
            .what = "a speed > 0",
            .domain = positive,
            .each_time = true},
           &ModesOptions::spots)
      .add({.name = "no_misfires",
            .doc =
                "where stresses of shafts are judged: omits the response with one cylinder after the other misfiring"},
           &ModesOptions::misfires, false)
      .add({.name = "cases",
            .doc = "names of the scene's [[case]]s to compute; none: no case (default: all)",
            .each_time = true},
           &ModesRequest::cases)
      .add({.name = "torque",
            .doc = "simulates the scene and analyses this component's torque: spectrum, orders, waterfall, rainflow"},
           &ModesOptions::torque);
}

}  // namespace

Question modes_question() {
  return make_question(
      {.place = 70,
       .name = "modes",
       .arguments = "scene.toml",
       .help = "natural frequencies, shapes, critical speeds, forced response over the speed, limits, spectra",
       .does = "natural frequencies, shapes, damping; Campbell diagram; forced response by orders, barred speeds, "
               "parametric zones, limits after DIN 740-2, stresses of shafts after IACS UR M68; spectrum of a "
               "simulated torque (`--count`, `--speed`, `--range`, `--orders`, `--spot-checks`, `--torque`)"},
      options(), natural_modes);
}

}  // namespace kurbel
