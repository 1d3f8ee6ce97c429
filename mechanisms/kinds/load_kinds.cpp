// load_kinds.cpp — from the keys of a load on a mechanism's output to its law.
#include "mechanisms/kinds/load_kinds.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

namespace kurbel {
namespace {

Key working_end_key() {
  return {.name = "working_end",
          .type = KeyType::text,
          .fallback = "\"extended\"",
          .doc = "end of the stroke that the distance is counted from",
          .choices = {"extended", "folded"}};
}
Key swing_end_key() {
  return {.name = "working_end",
          .type = KeyType::text,
          .fallback = "\"greatest\"",
          .doc = "end of the swing that the distance is counted from",
          .choices = {"greatest", "least"}};
}
Key work_key(const char* fallback) {
  return {.name = "work",
          .type = KeyType::text,
          .fallback = fallback,
          .doc = "line of the energy balance",
          .choices = {"useful", "harmful", "driving"}};
}

Key rounding_key(const char* name, const char* unit) {
  return {.name = name,
          .unit = unit,
          .domain = positive,
          .doc = "width that edges are rounded over, of the same area, when the effect load_edges is off",
          .effect = "load_edges"};
}

Account account_of(const Section& s) {
  const std::string& name = s.text("work");
  return name == "driving" ? Account::driving : name == "harmful" ? Account::harmful : Account::useful;
}

WorkingEnd working_end(const Section& s, const Mechanism& mechanism) {
  const std::string& end = s.text("working_end");
  const bool extended = end == "extended" || end == "greatest";
  return {extended ? mechanism.travel.greatest : mechanism.travel.least, extended ? 1 : -1};
}

bool read_press(const Section& s, const Mechanism& mechanism, const std::string& what, Messages& messages,
                SliderLoad& load) {
  const double travel = s.number("nominal_travel"), rise = s.number("rise"), through = s.number("breakthrough"),
               drop = s.number("drop");
  const std::size_t before = messages.all().size();
  if (travel > mechanism.stroke())
    messages.add(s.where("nominal_travel"), fmt::format("{}: nominal_travel = {}; must be ≤ the stroke of {}", what,
                                                        in_mm(travel), in_mm(mechanism.stroke())));
  if (rise > travel)
    messages.add(s.where("rise"),
                 fmt::format("{}: rise = {}; must be ≤ nominal_travel = {}", what, in_mm(rise), in_mm(travel)));
  if (through >= travel - rise && through > 0 && rise <= travel)
    messages.add(s.where("breakthrough"),
                 fmt::format("{}: breakthrough = {}; must be < nominal_travel − rise = {}, where the full force stands",
                             what, in_mm(through), in_mm(travel - rise)));
  if (drop > through)
    messages.add(s.where("drop"),
                 fmt::format("{}: drop = {}; must be ≤ breakthrough = {}", what, in_mm(drop), in_mm(through)));
  if (messages.all().size() > before) return false;
  load.law = PressForce::make(working_end(s, mechanism), mechanism.stroke(), s.number("nominal_force"), travel, rise,
                              through, drop);
  return true;
}

bool read_table(const Section& s, const Mechanism& mechanism, const std::string& what, Messages& messages,
                SliderLoad& load) {
  const char* key = mechanism.rocks() ? "torque" : "force";
  CurveData data = s[key].curve;
  const auto refuse = [&](const std::string& text) {
    messages.add(s.where(key), fmt::format("{}: {}", what, text));
    return false;
  };
  try {
    if (data.over != "angle") {
      if (data.period > 0) return refuse(fmt::format("a table over {} has no period", data.over));
      TravelForce law{working_end(s, mechanism), Curve(data.x, data.y, data.form), {}, mechanism.stroke()};
      if (!data.x_back.empty()) law.retreat = Curve(data.x_back, data.y_back, data.form);
      load.law = std::move(law);
    } else {
      if (!data.x_back.empty()) return refuse("a table over the crank angle has one branch; drop return_points");
      if (data.period == 0)
        data.period = data.x.back() - data.x.front() > 2 * std::numbers::pi * 1.0001 ? 4 * std::numbers::pi
                                                                                     : 2 * std::numbers::pi;
      load.law = AngleForce{working_end(s, mechanism), Curve(data.x, data.y, data.form, data.period)};
    }
  } catch (const std::invalid_argument& error) {
    return refuse(error.what());
  }
  return true;
}

bool read_compressor(const Section& s, const Mechanism& mechanism, const std::string& what, Messages& messages,
                     SliderLoad& load) {
  const double bore = s.number("bore"), suction = s.number("suction_pressure");
  const CompressorForce law{.end = working_end(s, mechanism),
                            .stroke = mechanism.stroke(),
                            .area = 0.25 * std::numbers::pi * bore * bore,
                            .suction = suction,
                            .delivery = s.number("delivery_pressure"),
                            .outside = s.number_or("outside_pressure", suction),
                            .clearance = s.number("clearance"),
                            .compression_exponent = s.number("compression_exponent"),
                            .expansion_exponent = s.number_or("expansion_exponent", s.number("compression_exponent"))};
  if (law.delivery <= law.suction) {
    messages.add(s.where("delivery_pressure"),
                 fmt::format("{}: delivery_pressure = {:g} bar; must be above suction_pressure = {:g} bar", what,
                             law.delivery * 1e-5, law.suction * 1e-5));
    return false;
  }
  const auto refuse = [&](const char* event, double greatest) {
    messages.add(s.where("clearance"),
                 fmt::format("{}: clearance = {:g}; must be < {:.4g}, else the {} at these pressures", what,
                             law.clearance, greatest, event));
    return false;
  };
  if (law.delivery_opens_at() <= 0)
    return refuse("delivery valve never opens",
                  1 / (std::pow(law.delivery / law.suction, 1 / law.compression_exponent) - 1));
  if (law.volumetric_efficiency() <= 0)
    return refuse("suction valve never opens",
                  1 / (std::pow(law.delivery / law.suction, 1 / law.expansion_exponent) - 1));
  load.law = law;
  return true;
}

// The width that edges are rounded over when the effect load_edges is off; a smooth table has no edges.
bool read_rounding(const Section& s, const Mechanism& mechanism, const std::string& what, Messages& messages,
                   SliderLoad& load) {
  const bool over_angle = load.period() > 0, rocks = mechanism.rocks();
  for (const char* key : {"rounding", "rounding_angle"}) {
    if (!s.given(key)) continue;
    const double most = over_angle ? 0.5 * load.period() : mechanism.stroke();
    const char* const unit = over_angle || rocks ? "rad" : "m";
    load.rounding = 0.5 * s.number(key);
    std::string wrong;
    if (!rocks && over_angle != (std::string(key) == "rounding_angle"))
      wrong = over_angle ? "the table is over the crank angle; give \"rounding_angle\""
                         : "the table is over the travel; give \"rounding\"";
    else if (!load.can_be_rounded())
      wrong = fmt::format("\"{}\" is for straight pieces, and the table is smooth; drop it", key);
    else if (2 * load.rounding > most)
      wrong = fmt::format("{} = {:g} {}; must be ≤ {} of {:g} {}", key, 2 * load.rounding, unit,
                          over_angle ? "half the period"
                          : rocks    ? "the swing"
                                     : "the stroke",
                          most, unit);
    if (wrong.empty()) continue;
    messages.add(s.where(key), fmt::format("{}: {}", what, wrong));
    return false;
  }
  return true;
}

bool read_load(const Section& s, const Mechanism& mechanism, const std::string& what, Messages& messages,
               SliderLoad& load) {
  const std::string& kind = s.kind->name;
  load.account = account_of(s);
  if (kind == "press")
    return read_press(s, mechanism, what, messages, load) && read_rounding(s, mechanism, what, messages, load);
  if (kind == "table")
    return read_table(s, mechanism, what, messages, load) && read_rounding(s, mechanism, what, messages, load);
  if (kind == "compressor") return read_compressor(s, mechanism, what, messages, load);
  const char* magnitude = mechanism.rocks() ? "torque" : "force";
  if (kind == "constant") load.law = ConstantForce{s.number(magnitude)};
  if (kind == "opposing") load.law = OpposingForce{s.number(magnitude)};
  if (kind == "medium") load.law = MediumResistance{s.number("viscous"), s.number("quadratic")};
  return true;
}

Kind press_kind() {
  return {.name = "press",
          .doc = "nominal force before the working end, on the working stroke only, then break-through",
          .placement = Placement::nested,
          .keys = {{.name = "nominal_force",
                    .unit = "N",
                    .domain = not_negative,
                    .doc = "force F_n against the motion",
                    .required = true},
                   {.name = "nominal_travel",
                    .unit = "m",
                    .domain = positive,
                    .doc = "distance before the working end where the force begins",
                    .required = true},
                   {.name = "rise",
                    .unit = "m",
                    .fallback = "\"0 mm\"",
                    .domain = not_negative,
                    .doc = "travel within which the force rises; 0: an edge"},
                   {.name = "breakthrough",
                    .unit = "m",
                    .fallback = "\"0 mm\"",
                    .domain = not_negative,
                    .doc = "distance before the end where the work breaks through; 0: force lasts to the end"},
                   {.name = "drop",
                    .unit = "m",
                    .fallback = "\"0 mm\"",
                    .domain = not_negative,
                    .doc = "travel within which the force falls after break-through"},
                   rounding_key("rounding", "m"),
                   working_end_key(),
                   work_key("\"useful\"")}};
}

Kind table_kind() {
  return {
      .name = "table",
      .doc = "force by table over travel or crank angle (indicator diagram)",
      .placement = Placement::nested,
      .keys = {{.name = "force",
                .type = KeyType::curve,
                .unit = "N",
                .doc = "positive pushes the slider away from the working end; over the distance to that end "
                       "(return_points: branch of the other stroke) or over the crank angle (span up to 360 deg, or "
                       "720 deg for four strokes)",
                .required = true,
                .choices = {"travel", "angle"}},
               rounding_key("rounding", "m"),
               rounding_key("rounding_angle", "rad"),
               working_end_key(),
               work_key("\"useful\"")}};
}

Kind compressor_kind() {
  return {
      .name = "compressor",
      .doc =
          "gas force of a compressor: compression, delivery, re-expansion of the clearance volume, suction; the "
          "valves open at located events",
      .placement = Placement::nested,
      .keys = {{.name = "bore", .unit = "m", .domain = positive, .doc = "diameter of the piston", .required = true},
               {.name = "suction_pressure", .unit = "Pa", .domain = positive, .doc = "p₁, absolute", .required = true},
               {.name = "delivery_pressure", .unit = "Pa", .domain = positive, .doc = "p₂, absolute", .required = true},
               {.name = "outside_pressure",
                .unit = "Pa",
                .domain = not_negative,
                .doc = "on the other face of the piston, absolute; default: suction_pressure"},
               {.name = "clearance",
                .domain = positive,
                .doc = "clearance volume over swept volume, e.g. 0.05",
                .required = true},
               {.name = "compression_exponent",
                .fallback = "1.3",
                .domain = positive,
                .doc = "polytropic exponent n: 1 isothermal, 1.4 adiabatic for air"},
               {.name = "expansion_exponent",
                .domain = positive,
                .doc = "polytropic exponent of the re-expansion; default: compression_exponent"},
               working_end_key(),
               work_key("\"useful\"")}};
}

}  // namespace

void read_loads(const Section& s, Mechanism& mechanism, Messages& messages) {
  if (!s.has("load")) return;
  const std::vector<Section>& sections = s["load"].sections;
  for (std::size_t k = 0; k < sections.size(); ++k) {
    SliderLoad load{ConstantForce{}, sections.size() == 1 ? s.name + ".load" : fmt::format("{}.load{}", s.name, k + 1)};
    if (sections[k].sound &&
        read_load(sections[k], mechanism, fmt::format("{} \"{}\": load", s.kind->name, s.name), messages, load))
      mechanism.loads.push_back(std::move(load));
  }
}

const std::vector<Kind>& slider_load_kinds() {
  static const std::vector<Kind> kinds = {
      press_kind(),
      {.name = "constant",
       .doc = "force along the stroke, whatever the motion",
       .placement = Placement::nested,
       .keys = {{.name = "force", .unit = "N", .doc = "positive towards the extended end", .required = true},
                work_key("\"useful\"")}},
      {.name = "opposing",
       .doc = "constant force against the motion; holds at standstill",
       .placement = Placement::nested,
       .keys = {{.name = "force", .unit = "N", .domain = not_negative, .doc = "magnitude", .required = true},
                work_key("\"useful\"")}},
      {.name = "medium",
       .doc = "resistance of the medium, F = c v + q v |v|",
       .placement = Placement::nested,
       .keys =
           {{.name = "viscous", .unit = "N*s/m", .fallback = "\"0 N*s/m\"", .domain = not_negative, .doc = "c"},
            {.name = "quadratic", .unit = "N*s2/m2", .fallback = "\"0 N*s2/m2\"", .domain = not_negative, .doc = "q"},
            work_key("\"useful\"")}},
      table_kind(),
      compressor_kind(),
  };
  return kinds;
}

const std::vector<Kind>& rocker_load_kinds() {
  static const std::vector<Kind> kinds = {
      {.name = "constant",
       .doc = "torque on the rocking output, whatever the motion",
       .placement = Placement::nested,
       .keys = {{.name = "torque", .unit = "N*m", .doc = "positive towards the greatest angle", .required = true},
                work_key("\"useful\"")}},
      {.name = "opposing",
       .doc = "constant torque against the output's motion; holds at standstill",
       .placement = Placement::nested,
       .keys = {{.name = "torque", .unit = "N*m", .domain = not_negative, .doc = "magnitude", .required = true},
                work_key("\"useful\"")}},
      {.name = "medium",
       .doc = "resistance of the medium to the output's rotation, M = c ω + q ω |ω|",
       .placement = Placement::nested,
       .keys =
           {{.name = "viscous", .unit = "N*m*s/rad", .fallback = "\"0 N*m*s/rad\"", .domain = not_negative, .doc = "c"},
            {.name = "quadratic",
             .unit = "N*m*s2/rad2",
             .fallback = "\"0 N*m*s2/rad2\"",
             .domain = not_negative,
             .doc = "q"},
            work_key("\"useful\"")}},
      {.name = "table",
       .doc = "torque on the rocking output by table over its swing or the crank angle",
       .placement = Placement::nested,
       .keys = {{.name = "torque",
                 .type = KeyType::curve,
                 .unit = "N*m",
                 .doc = "positive pushes the output away from the working end; over the angle to that end "
                        "(return_points: branch of the other stroke) or over the crank angle (span up to 360 deg, or "
                        "720 deg)",
                 .required = true,
                 .choices = {"swing", "angle"}},
                rounding_key("rounding", "rad"),
                swing_end_key(),
                work_key("\"useful\"")}},
  };
  return kinds;
}

}  // namespace kurbel
