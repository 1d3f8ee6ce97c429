// size_question.cpp — kurbel size: the flywheel for a demanded δ.
#include "studies/question/question.h"
#include "studies/size/size.h"

namespace kurbel {
namespace {

StudyOutput sized(const Inquiry& inquiry, SizeOptions asked) {
  asked.simulation = inquiry.simulation();
  return output_of(size_flywheel(inquiry.scene, asked));
}

OptionsOf<SizeOptions> options() {
  using Asked = SizeOptions;
  return OptionsOf<Asked>()
      .add({.name = "delta",
            .doc = "demanded δ = (ω_max − ω_min)/ω_mid, e.g. 0.05, 5% or 1/20",
            .example = "0.05",
            .what = "a plain number"},
           &Asked::delta)
      .add({.name = "machine", .doc = "customary δ of a machine in place of --delta: press, pump, \"machine tool\" …"},
           &Asked::machine)
      .add({.name = "at",
            .doc = "the machine in another state: after \"step 2\" of the sequence, at \"1.5 s\", or at a mid speed "
                   "such as \"60 rpm\""},
           OptionForm::one, [](Asked& asked, const OptionValues& given) { asked.at = given.moment(asked.mid_speed); })
      .add({.name = "mid_speed",
            .doc = "(ω_max + ω_min)/2 of the crank, e.g. \"60 1/min\" (default: where drive and mean load balance)",
            .example = "60 rpm",
            .what = "a speed > 0",
            .domain = positive},
           &Asked::mid_speed)
      .add(
          {.name = "basis",
           .doc = "classical (constant drive torque, loads of the rigid machine at constant speed) or steady (loads of "
                  "the steady cycle with the scene's effects; default where the classical one omits an effect)"},
          &Asked::basis,
          std::vector{std::pair("classical", CycleBasis::classical), std::pair("steady", CycleBasis::steady)})
      .add({.name = "flywheel", .doc = "component to size (default: the scene's flywheel, else one on the crank)"},
           &Asked::flywheel)
      .add({.name = "form", .doc = "rim (on spokes; default) or disc"}, &Asked::form,
           std::vector{std::pair("rim", FlywheelForm::rim), std::pair("disc", FlywheelForm::disc)})
      .add({.name = "material", .doc = "grey cast iron (default), nodular cast iron, cast steel, steel"},
           &Asked::material)
      .add({.name = "diameter",
            .doc = "outer diameter (default: by proportion)",
            .example = "1.2 m",
            .what = "a length > 0",
            .domain = positive},
           &Asked::diameter)
      .add({.name = "rim_speed",
            .doc = "limit, e.g. \"30 m/s\" (default: the material's)",
            .example = "30 m/s",
            .what = "a speed > 0",
            .domain = positive},
           &Asked::rim_speed)
      .add({.name = "diagram",
            .doc = "length of the diagrams for their scales, e.g. \"240 mm\"",
            .example = "240 mm",
            .what = "a length > 0",
            .domain = positive},
           &Asked::diagram_length)
      .add({.name = "no_run",
            .doc = "do not compute the steady motion of the sized machine, and no flywheel with the motor's slope"},
           &Asked::simulate, false);
}

}  // namespace

Question size_question() {
  return make_question({.place = 40,
                        .name = "size",
                        .arguments = "scene.toml --delta 0.05",
                        .help = "the flywheel that keeps the speed's fluctuation δ within bounds",
                        .does = "flywheel for a demanded δ by three methods and with the motor's slope, its "
                                "dimensions; δ reached rigid and elastic"},
                       options(), sized);
}

}  // namespace kurbel
