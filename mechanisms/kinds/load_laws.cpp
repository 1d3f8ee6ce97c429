// load_laws.cpp — from the keys of a load on a mechanism's output to its law.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "engine/reading/mirrored.h"
#include "mechanisms/kinds/load_kinds.h"

namespace kurbel {
namespace {

using namespace load_keys;

WorkingEnd working_end(bool from_greatest, const Mechanism& mechanism) {
  return {from_greatest ? mechanism.travel.greatest : mechanism.travel.least, from_greatest ? 1 : -1};
}

// The width that edges are rounded over when the effect load_edges is off; a smooth table has no edges.
template <class Keys>
bool put_rounding(const Reading<Keys>& s, const Mechanism& mechanism, SliderLoad& load) {
  const bool over_angle = load.period() > 0, rocks = mechanism.rocks();
  for (const auto member : {&EdgeKeys::rounding, &EdgeKeys::rounding_angle}) {
    if (!(s.*member)) continue;
    const double most = over_angle ? 0.5 * load.period() : mechanism.stroke();
    const char* const unit = over_angle || rocks ? "rad" : "m";
    load.rounding = 0.5 * *(s.*member);
    std::string wrong;
    if (!rocks && over_angle != (member == &EdgeKeys::rounding_angle))
      wrong = over_angle ? "the table is over the crank angle; give \"rounding_angle\""
                         : "the table is over the travel; give \"rounding\"";
    else if (!load.can_be_rounded())
      wrong =
          fmt::format("\"{}\" is for straight pieces, and the table is smooth or a formula; drop it", s.key(member));
    else if (2 * load.rounding > most)
      wrong = fmt::format("{} = {:g} {}; must be ≤ {} of {:g} {}", s.key(member), 2 * load.rounding, unit,
                          over_angle ? "half the period"
                          : rocks    ? "the swing"
                                     : "the stroke",
                          most, unit);
    if (!wrong.empty()) return s.refuse(member, wrong);
  }
  return true;
}

bool put_law(const Reading<PressLoad>& s, const Mechanism& mechanism, SliderLoad& load) {
  bool valid = true;
  if (s.travel > mechanism.stroke())
    valid = s.refuse(&PressLoad::travel, fmt::format("nominal_travel = {}; must be ≤ the stroke of {}", in_mm(s.travel),
                                                     in_mm(mechanism.stroke())));
  if (s.rise > s.travel)
    valid = s.refuse(&PressLoad::rise,
                     fmt::format("rise = {}; must be ≤ nominal_travel = {}", in_mm(s.rise), in_mm(s.travel)));
  if (s.breakthrough >= s.travel - s.rise && s.breakthrough > 0 && s.rise <= s.travel)
    valid = s.refuse(&PressLoad::breakthrough,
                     fmt::format("breakthrough = {}; must be < nominal_travel − rise = {}, where the full force stands",
                                 in_mm(s.breakthrough), in_mm(s.travel - s.rise)));
  if (s.drop > s.breakthrough)
    valid = s.refuse(&PressLoad::drop,
                     fmt::format("drop = {}; must be ≤ breakthrough = {}", in_mm(s.drop), in_mm(s.breakthrough)));
  if (!valid) return false;
  load.law = PressForce::make(working_end(s.from_greatest, mechanism), mechanism.stroke(), s.force, s.travel, s.rise,
                              s.breakthrough, s.drop);
  return put_rounding(s, mechanism, load);
}

// Over the crank angle a diagram repeats after one turn, or after two where it is longer than one.
double cycle_of(const CurveData& data) {
  if (data.period > 0) return data.period;
  const double turn = 2 * std::numbers::pi;
  return data.x.back() - data.x.front() > turn * 1.0001 ? 2 * turn : turn;
}

// The travel has its greatest place at 0 and its least at 180 deg of the crank, as the diagram counts: a diagram mirrored
// about 0 deg then does no work. Not of a crank with an offset, nor of other linkages in general.
bool turns_at_dead_centres(const Mechanism& mechanism) {
  const auto turns_at = [&](double angle) {
    const auto near = [&](double r) { return std::abs(std::remainder(r - angle, 2 * std::numbers::pi)) < 1e-6; };
    return std::any_of(mechanism.travel.reversals.begin(), mechanism.travel.reversals.end(), near);
  };
  return turns_at(0) && turns_at(std::numbers::pi);
}

// The diagram that acts: of a cylinder that does not fire the motored one. False, with a message, where there is none.
template <class Keys, class Key>
bool choose_diagram(const Reading<Keys>& s, Key key, const Mechanism& mechanism, CurveData& data, SliderLoad& load) {
  if (data.over != "angle") {
    if (s.motored)
      return s.refuse(&Keys::motored, fmt::format("belongs to a diagram over \"angle\"; it is over \"{}\"", data.over));
    return !s.misfire ||
           s.refuse(
               &Keys::misfire,
               fmt::format("a diagram over {} knows no cycle that could misfire; give it over \"angle\"", data.over));
  }
  data.period = cycle_of(data);
  if (s.motored && std::abs(cycle_of(*s.motored) - data.period) > 1e-9 * data.period)
    return s.refuse(&Keys::motored, "its period is not that of the fired diagram");
  if (!s.misfire) return true;
  if (!s.motored && !s.from_greatest)
    return s.refuse(
        &Keys::misfire,
        "the compression of a cylinder at the folded end does not end at 0 deg and is not mirrored; give \"motored\"");
  if (!s.motored && !turns_at_dead_centres(mechanism))
    return s.refuse(&Keys::misfire,
                    "the travel does not turn at 0 and 180 deg of the crank, as it does not with an offset, so that "
                    "the compression mirrored about 0 deg would do work that is none; give \"motored\"");
  const double period = data.period;
  load.mirrored = !s.motored;
  try {
    data = s.motored ? *s.motored : first_half_turn_mirrored(data, period, false);
  } catch (const std::invalid_argument& error) {
    return s.refuse(key, error.what());
  }
  data.period = period;
  return true;
}

// The law of a curve over travel or crank angle; of a chamber with its area and the pressure outside.
template <class OverTravel, class OverAngle, class Keys, class Key, class... Chamber>
bool put_curve(const Reading<Keys>& s, Key key, const CurveData& data, const Mechanism& mechanism, SliderLoad& load,
               Chamber... chamber) {
  const auto refuse = [&](const std::string& text) { return s.refuse(key, text); };
  const WorkingEnd end = working_end(s.from_greatest, mechanism);
  try {
    if (data.over != "angle") {
      if (data.period > 0) return refuse(fmt::format("a table over {} has no period", data.over));
      if (mechanism.travel.winding != 0)
        return refuse(
            fmt::format("a table over {}, but the output rotates with the crank and has no end of a swing; give the "
                        "table over the crank's angle",
                        data.over));
      OverTravel law{TravelForce{end, data.curve(), {}, mechanism.stroke()}, chamber...};
      if (!data.x_back.empty()) law.retreat = data.back();
      load.law = std::move(law);
    } else {
      if (!data.x_back.empty()) return refuse("a table over the crank angle has one branch; drop return_points");
      load.law = OverAngle{AngleForce{end, data.curve().over_angle()}, chamber...};
    }
  } catch (const std::invalid_argument& error) {
    return refuse(error.what());
  }
  return true;
}

bool put_law(const Reading<Table>& s, const Mechanism& mechanism, SliderLoad& load) {
  CurveData data = s.force;
  return choose_diagram(s, &Table::force, mechanism, data, load) &&
         put_curve<TravelForce, AngleForce>(s, &Table::force, data, mechanism, load) &&
         put_rounding(s, mechanism, load);
}

bool put_law(const Reading<Compressor>& s, const Mechanism& mechanism, SliderLoad& load) {
  CompressorForce law = s;
  law.end = working_end(s.from_greatest, mechanism);
  law.stroke = mechanism.stroke();
  law.area = 0.25 * std::numbers::pi * s.bore * s.bore;
  if (law.delivery <= law.suction)
    return s.refuse(&Compressor::delivery,
                    fmt::format("delivery_pressure = {:g} bar; must be above suction_pressure = {:g} bar",
                                law.delivery * 1e-5, law.suction * 1e-5));
  const auto refuse = [&](const char* event, double greatest) {
    return s.refuse(&Compressor::clearance,
                    fmt::format("clearance = {:g}; must be < {:.4g}, else the {} at these pressures", law.clearance,
                                greatest, event));
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

bool put_law(const Reading<Cylinder>& s, Mechanism& mechanism, SliderLoad& load) {
  if (s.rod >= s.bore)
    return s.refuse(&Cylinder::rod, fmt::format("rod_diameter = {}; must be < bore = {}", in_mm(s.rod), in_mm(s.bore)));
  const auto area = [](double diameter) { return 0.25 * std::numbers::pi * diameter * diameter; };
  // Of an area that is negative behind the piston.
  const auto put_chamber = [&](auto key, const CurveData& pressure, double on, SliderLoad& of) {
    return put_curve<ChamberOverTravel, ChamberOverAngle>(s, key, pressure, mechanism, of, on, s.outside);
  };
  if (s.behind) {
    SliderLoad behind = load;
    behind.name += ".behind";
    CurveData pressure = *s.behind;
    if (pressure.over == "angle") pressure.period = cycle_of(pressure);
    if (!put_chamber(&Cylinder::behind, pressure, area(s.rod) - area(s.bore), behind)) return false;
    mechanism.loads.push_back(std::move(behind));
  }
  CurveData pressure = s.pressure;
  return choose_diagram(s, &Cylinder::pressure, mechanism, pressure, load) &&
         put_chamber(&Cylinder::pressure, pressure, area(s.bore), load);
}

template <class Law>
bool put_law(const Reading<LoadKeys<Law>>& s, const Mechanism&, SliderLoad& load) {
  load.law = static_cast<const Law&>(s);
  return true;
}

}  // namespace

void put_loads(const std::vector<LoadReading>& loads, Mechanism& mechanism) {
  for (std::size_t k = 0; k < loads.size(); ++k) {
    SliderLoad load{ConstantForce{},
                    loads.size() == 1 ? mechanism.name + ".load" : fmt::format("{}.load{}", mechanism.name, k + 1)};
    const auto put = [&](const auto& keys) {
      load.account = keys.account;
      return put_law(keys, mechanism, load);
    };
    if (std::visit(put, loads[k])) mechanism.loads.push_back(std::move(load));
  }
}

}  // namespace kurbel
