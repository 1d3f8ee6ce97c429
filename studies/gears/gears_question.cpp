// gears_question.cpp — kurbel gears: the gear pairs of a scene, or one alone: of parallel shafts, bevel or worm.
#include <fmt/format.h>

#include <stdexcept>

#include "studies/gears/bevel_worm.h"
#include "studies/gears/gears.h"
#include "studies/question/question.h"

namespace kurbel {
namespace {

struct PairAlone : GearPairData {
  std::optional<double> shaft_angle, worm_diameter;
  double friction = 0;
};

struct GearsRequest : GearsOptions {
  PairAlone pair_alone;
  std::string of_pair_alone;  // one of the options given that belong to it
};

// A quantity; `least`: one for each wheel, or the first alone if it is 1.
OptionText quantity(std::string name, std::string doc, std::string example, std::string what,
                    const Domain& domain = any_number, int least = 0) {
  return {.name = std::move(name),
          .doc = std::move(doc),
          .example = std::move(example),
          .what = std::move(what),
          .domain = domain,
          .count = least > 0 ? 2 : 0,
          .least = least};
}
OptionText length(std::string name, std::string doc, std::string example, const Domain& domain = positive,
                  int least = 0) {
  return quantity(std::move(name), std::move(doc), std::move(example),
                  domain.contains(0) ? "a length ≥ 0" : "a length > 0", domain, least);
}
OptionText plain(std::string name, std::string doc, int least = 0) {
  return quantity(std::move(name), std::move(doc), "0.25", "a plain number", any_number, least);
}

const OptionsOf<PairAlone>& pair_options() {
  static const auto made =
      OptionsOf<PairAlone>()
          .add(quantity("teeth", "a pair alone: teeth of both wheels, driving one first; an internal wheel < 0", "",
                        "two, driving wheel first, e.g. --teeth 19 95", {.low = -1e5, .high = 1e5}, 2),
               &PairAlone::teeth)
          .add(length("module", "normal module, e.g. \"4 mm\"", "4 mm"), &PairAlone::module)
          .add(plain("shift", "profile shifts x1 x2 (default: 0, or by the centre distance)", 1), &PairAlone::shift)
          .add(quantity("helix", "helix angle, e.g. \"12 deg\"", "12 deg", "an angle"), &PairAlone::helix)
          .add(length("centre_distance", "e.g. \"230 mm\" (default: by the shifts)", "230 mm"),
               &PairAlone::centre_distance)
          .add(length("width", "face width, e.g. \"40 mm\": overlap, inertias, stiffness", "40 mm"), OptionForm::one,
               [](PairAlone& pair, const OptionValues& given) {
                 given.read(pair.width[0]), pair.width[1] = pair.width[0];
               })
          .add(length("backlash", "allowance along the normal, e.g. \"0.1 mm\"", "0.1 mm", not_negative),
               &PairAlone::backlash)
          .add(length("bore", "bores of both wheels (of an internal one: outer diameter)", "20 mm", not_negative, 2),
               &PairAlone::bore)
          .add(length("tip_diameter", "tip diameters, where they differ from the rack's", "84 mm", positive, 2),
               &PairAlone::tip_diameter)
          .add(OptionsOf<BasicRack>()
                   .add(quantity("pressure_angle", "of the basic rack (default: 20 deg)", "20 deg", "an angle > 0",
                                 positive),
                        &BasicRack::pressure_angle)
                   .add(plain("addendum", "of the basic rack, in modules (default: 1)"), &BasicRack::addendum)
                   .add(plain("clearance", "of the basic rack, in modules (default: 0.25)"), &BasicRack::clearance)
                   .add(plain("root_radius", "of the basic rack, in modules (default: 0.38)"), &BasicRack::root_radius),
               &PairAlone::rack)
          .add(quantity("shaft_angle", "of a bevel pair, e.g. \"90 deg\"", "90 deg", "an angle > 0", positive),
               &PairAlone::shaft_angle)
          .add(length("worm_diameter", "of a worm pair: --teeth STARTS TEETH, --module axial", "50 mm"),
               &PairAlone::worm_diameter)
          .add(plain("friction", "coefficient of friction of a worm pair (default: 0)"), &PairAlone::friction);
  return made;
}

OptionsOf<GearsRequest> gears_options() {
  OptionsOf<GearsRequest> options;
  options
      .add({.name = "pair", .doc = "one stage, e.g. gearbox.stage1 (default: all whose module is given)"},
           &GearsRequest::pair)
      .add({.name = "speed",
            .doc = "of the first wheel, e.g. \"1500 rpm\": sliding speeds, mesh frequency",
            .example = "1500 rpm",
            .what = "a speed"},
           &GearsRequest::speed);
  const OptionsOf<PairAlone>& alone = pair_options();
  for (std::size_t k = 0; k < alone.declared().size(); ++k)
    options.add(alone.declared()[k].text, alone.declared()[k].form,
                [read = alone.readers()[k]](GearsRequest& asked, const OptionValues& given) {
                  read(asked.pair_alone, given), asked.of_pair_alone = given.label();
                });
  return options;
}

// A bevel pair has a shaft angle, a worm pair a worm diameter; otherwise the shafts are parallel.
StudyOutput gear_pairs(const Inquiry& inquiry, GearsRequest asked) {
  const PairAlone& pair = asked.pair_alone;
  if (!inquiry.without_scene()) {
    if (asked.of_pair_alone.empty()) return output_of(find_gears(inquiry.scene, asked));
    throw std::invalid_argument(
        fmt::format("{} belongs to a pair alone, --teeth without a scene; a scene's stages say it themselves",
                    asked.of_pair_alone));
  }
  if (pair.teeth[0] == 0)
    throw std::invalid_argument("gears: give a scene, or a pair alone: --teeth 19 95 --module \"4 mm\"");
  if (pair.module == 0) throw std::invalid_argument("--teeth needs --module, e.g. --module \"4 mm\"");
  if (pair.shaft_angle && pair.worm_diameter)
    throw std::invalid_argument("--shaft-angle makes a bevel pair, --worm-diameter a worm pair; give one of them");
  if (pair.shaft_angle)
    return output_of(BevelPair{.teeth = pair.teeth, .module = pair.module, .shaft_angle = *pair.shaft_angle});
  if (pair.worm_diameter)
    return {findings_of(WormPair{.starts = pair.teeth[0],
                                 .teeth = pair.teeth[1],
                                 .module = pair.module,
                                 .worm_diameter = *pair.worm_diameter,
                                 .friction = pair.friction,
                                 .pressure_angle = pair.rack.pressure_angle},
                        asked.speed)};
  return output_of(single_pair(pair, asked.speed));
}

}  // namespace

Question gears_question() {
  return make_question(
      {.place = 60,
       .name = "gears",
       .arguments = "scene.toml",
       .help = "gear pairs: diameters, contact, sliding, undercut, interference, a turning drawing",
       .does = "gear pairs of the stages given by module: diameters, contact ratio, sliding, undercut, interference, "
               "mesh stiffness, a turning drawing; or a pair alone (`--teeth 19 95 --module \"4 mm\" --shift 0.3 0`)",
       .alone = "pair_alone"},
      gears_options(), gear_pairs);
}

}  // namespace kurbel
