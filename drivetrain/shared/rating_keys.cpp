// rating_keys.cpp — keys of ratings.
#include "drivetrain/shared/rating_keys.h"

#include <fmt/format.h>

namespace kurbel {

const Fields<HeatRating>& heat_rating_fields() {
  static const auto made = Fields<HeatRating>()
                               .add({.name = "allowable_heat",
                                     .unit = "J",
                                     .domain = positive,
                                     .doc = "heat that it may take in one engagement, limit for kurbel run"},
                                    &HeatRating::engagement)
                               .add({.name = "allowable_heat_power",
                                     .unit = "W",
                                     .domain = positive,
                                     .doc = "heat that it may take on the mean of the time run, limit for kurbel run"},
                                    &HeatRating::power);
  return made;
}

const Fields<RimRating>& rim_rating_fields() {
  using Rim = RimRating;
  static const auto made =
      Fields<Rim>()
          .add({.name = "rim_radius", .unit = "m", .domain = positive, .doc = "mean radius r of the rim"}, &Rim::radius)
          .add({.name = "allowable_rim_speed",
                .unit = "m/s",
                .domain = positive,
                .doc = "limit of r ω for kurbel run; needs rim_radius"},
               &Rim::speed)
          .add({.name = "rim_density", .unit = "kg/m3", .domain = positive, .doc = "ρ of the rim"}, &Rim::density)
          .add({.name = "allowable_rim_stress",
                .unit = "Pa",
                .domain = positive,
                .doc = "limit of ρ (r ω)², hoop stress of a thin free ring, for kurbel run; needs rim_radius, "
                       "rim_density"},
               &Rim::stress)
          .check([](const Reading<Rim>& rim) {
            for (const auto member : {&Rim::speed, &Rim::stress})
              if (rim.*member && !rim.radius)
                rim.refuse(member, fmt::format("\"{}\" needs \"rim_radius\"; give that, too", rim.key(member)));
            if (rim.stress && !rim.density)
              rim.refuse(&Rim::stress, "\"allowable_rim_stress\" needs \"rim_density\"; give that, too");
            rim.drop_without(&Rim::stress, &Rim::density);
          });
  return made;
}

}  // namespace kurbel
