// gears_command.cpp — kurbel gears: the gear pairs of a scene, or one (also bevel or worm) from the command line.
#include <fmt/format.h>

#include <memory>
#include <stdexcept>

#include "app/question_command.h"
#include "app/verb.h"
#include "studies/gears/bevel_worm.h"
#include "studies/gears/gears.h"
#include "studies/question/option_values.h"

namespace kurbel::app::gears_command {
namespace {

struct GearsArguments {
  StudyOptions study;
  DeclaredOptions declared;
  std::string shaft_angle, worm_diameter;
  double friction = 0;
  std::vector<int> teeth;
  std::vector<double> shift;
  std::string module, helix, centre_distance, backlash, width, pressure_angle;
  std::vector<std::string> bore, tip_diameter;
  BasicRack rack;

  bool alone() const { return !teeth.empty(); }
  // An option for single pairs only.
  std::string alone_option() const {
    if (!module.empty()) return "--module";
    if (!shift.empty()) return "--shift";
    if (!helix.empty()) return "--helix";
    if (!centre_distance.empty()) return "--centre-distance";
    if (!width.empty()) return "--width";
    return backlash.empty() ? "" : "--backlash";
  }
};

double length_of(const char* option, const std::string& text, const char* example, const Domain& domain = positive) {
  return quantity_of(option, text, domain.contains(0) ? "a length ≥ 0" : "a length > 0", example, domain);
}

GearPairData pair_of(const GearsArguments& a) {
  if (a.teeth.size() != 2) throw std::invalid_argument("--teeth: must be two, driving wheel first, e.g. --teeth 19 95");
  if (a.module.empty()) throw std::invalid_argument("--teeth needs --module, e.g. --module \"4 mm\"");
  GearPairData d;
  d.teeth = {a.teeth[0], a.teeth[1]};
  d.module = length_of("--module", a.module, "4 mm");
  d.rack = a.rack;
  if (!a.pressure_angle.empty())
    d.rack.pressure_angle = quantity_of("--pressure-angle", a.pressure_angle, "an angle > 0", "20 deg", positive);
  if (!a.helix.empty()) d.helix = quantity_of("--helix", a.helix, "an angle", "12 deg", any_number);
  if (!a.centre_distance.empty()) d.centre_distance = length_of("--centre-distance", a.centre_distance, "230 mm");
  if (!a.backlash.empty()) d.backlash = length_of("--backlash", a.backlash, "0.1 mm", not_negative);
  if (!a.width.empty()) d.width[0] = d.width[1] = length_of("--width", a.width, "40 mm");
  for (std::size_t i = 0; i < a.shift.size(); ++i) d.shift[i] = a.shift[i];
  for (std::size_t i = 0; i < a.bore.size(); ++i) d.bore[i] = length_of("--bore", a.bore[i], "20 mm", not_negative);
  for (std::size_t i = 0; i < a.tip_diameter.size(); ++i)
    d.tip_diameter[i] = length_of("--tip-diameter", a.tip_diameter[i], "84 mm");
  return d;
}

// A bevel pair has a shaft angle, a worm pair a worm diameter; otherwise the shafts are parallel.
StudyOutput alone(const GearsArguments& a, std::optional<double> speed) {
  const GearPairData d = pair_of(a);
  if (!a.shaft_angle.empty() && !a.worm_diameter.empty())
    throw std::invalid_argument("--shaft-angle makes a bevel pair, --worm-diameter a worm pair; give one of them");
  if (!a.shaft_angle.empty())
    return output_of(
        BevelPair{.teeth = d.teeth,
                  .module = d.module,
                  .shaft_angle = quantity_of("--shaft-angle", a.shaft_angle, "an angle > 0", "90 deg", positive)});
  if (!a.worm_diameter.empty())
    return {findings_of(WormPair{.starts = d.teeth[0],
                                 .teeth = d.teeth[1],
                                 .module = d.module,
                                 .worm_diameter = length_of("--worm-diameter", a.worm_diameter, "50 mm"),
                                 .friction = a.friction,
                                 .pressure_angle = d.rack.pressure_angle},
                        speed)};
  return output_of(single_pair(d, speed));
}

int gears(GearsArguments a) {
  if (a.alone() == !a.study.scene.empty())
    throw std::invalid_argument(a.alone() ? "gears: give a scene or --teeth, not both"
                                          : "gears: give a scene, or a pair alone: --teeth 19 95 --module \"4 mm\"");
  const Question& question = question_named("gears");
  if (!a.alone()) {
    if (const std::string option = a.alone_option(); !option.empty())
      throw std::invalid_argument(
          fmt::format("{} belongs to a pair alone (with --teeth); a scene's stages say it "
                      "themselves",
                      option));
    return answer(question, a.study, a.declared.given());
  }
  a.study.scene = "pair_alone";  // names the folder of the results
  check_folder(a.study);
  const GearsOptions asked = gears_options().read(a.declared.given(), question.name, Scene{});
  return present(alone(a, asked.speed), a.study);
}

void set_up(OptionList& command, int& code) {
  const auto a = std::make_shared<GearsArguments>();
  add_study_options(command, a->study);
  command.option("scene").required(false);
  a->declared.add_to(command, gears_options().declared());
  command
      .add_option("--teeth", a->teeth, "a pair alone: teeth of both wheels, driving one first; an internal wheel < 0")
      .values(2);
  command.add_option("--module", a->module, "normal module, e.g. \"4 mm\"");
  command.add_option("--shift", a->shift, "profile shifts x1 x2 (default: 0, or by the centre distance)").values(1, 2);
  command.add_option("--helix", a->helix, "helix angle, e.g. \"12 deg\"");
  command.add_option("--centre-distance", a->centre_distance, "e.g. \"230 mm\" (default: by the shifts)");
  command.add_option("--width", a->width, "face width, e.g. \"40 mm\": overlap, inertias, stiffness");
  command.add_option("--backlash", a->backlash, "allowance along the normal, e.g. \"0.1 mm\"");
  command.add_option("--bore", a->bore, "bores of both wheels (of an internal one: outer diameter)").values(2);
  command.add_option("--tip-diameter", a->tip_diameter, "tip diameters, where they differ from the rack's").values(2);
  command.add_option("--pressure-angle", a->pressure_angle, "of the basic rack (default: 20 deg)");
  command.add_option("--addendum", a->rack.addendum, "of the basic rack, in modules (default: 1)");
  command.add_option("--clearance", a->rack.clearance, "of the basic rack, in modules (default: 0.25)");
  command.add_option("--root-radius", a->rack.root_radius, "of the basic rack, in modules (default: 0.38)");
  command.add_option("--shaft-angle", a->shaft_angle, "of a bevel pair, e.g. \"90 deg\"");
  command.add_option("--worm-diameter", a->worm_diameter, "of a worm pair: --teeth STARTS TEETH, --module axial");
  command.add_option("--friction", a->friction, "coefficient of friction of a worm pair (default: 0)");
  command.action([&code, a] { code = gears(*a); });
}

const Verb verb{{question_named("gears"), set_up}};

}  // namespace
}  // namespace kurbel::app::gears_command
