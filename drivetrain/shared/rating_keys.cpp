// rating_keys.cpp — keys of ratings.
#include "drivetrain/shared/rating_keys.h"

#include <fmt/format.h>

namespace kurbel {

Fields<HeatRating> heat_rating_fields() {
  return Fields<HeatRating>()
      .add(quantity("allowable_heat", "J", positive, "heat that it may take in one engagement, limit for kurbel run"),
           &HeatRating::engagement)
      .add(quantity("allowable_heat_power", "W", positive,
                    "heat that it may take on the mean of the time run, limit for kurbel run"),
           &HeatRating::power);
}

Fields<RimRating> rim_rating_fields() {
  using Rim = RimRating;
  return Fields<Rim>()
      .add(quantity("rim_radius", "m", positive, "mean radius r of the rim"), &Rim::radius)
      .add(quantity("allowable_rim_speed", "m/s", positive, "limit of r ω for kurbel run; needs rim_radius"),
           &Rim::speed)
      .add(quantity("rim_density", "kg/m3", positive, "ρ of the rim"), &Rim::density)
      .add(quantity("allowable_rim_stress", "Pa", positive,
                    "limit of ρ (r ω)², hoop stress of a thin free ring, for kurbel run; needs rim_radius, "
                    "rim_density"),
           &Rim::stress)
      .check([](const Reading<Rim>& rim) {
        for (const auto member : {&Rim::speed, &Rim::stress})
          if (rim.*member && !rim.radius)
            rim.refuse(member, fmt::format("\"{}\" needs \"rim_radius\"; give that, too", rim.key(member)));
        if (rim.stress && !rim.density)
          rim.refuse(&Rim::stress, "\"allowable_rim_stress\" needs \"rim_density\"; give that, too");
        rim.drop_without(&Rim::stress, &Rim::density);
      });
}

const Fields<DutyRating>& duty_rating_fields() {
  using Rating = DutyRating;
  using Duty = Rating::Duty;
  static const auto made =
      Fields<Rating>()
          .add({.name = "duty",
                .doc = "that its rated torque M_N is stated for, after IEC 60034-1: kurbel run holds the RMS torque, a "
                       "lower bound of heating, against what makes the same heat"},
               &Rating::duty, {{"S1", Duty::continuous}, {"S2", Duty::short_time}, {"S3", Duty::intermittent}})
          .add(quantity("duty_time", "s", positive, "S2: how long M_N may act"), &Rating::time)
          .add(quantity("duty_share", "", {.low = 0, .high = 1, .low_open = true},
                        "S3: part of the time in which M_N may act; the run is to be of whole duty cycles"),
               &Rating::share)
          .check([](const Reading<Rating>& r) {
            if ((r.duty == Duty::short_time) != r.time.has_value())
              r.refuse(r.time ? r.key(&Rating::time) : r.key(&Rating::duty),
                       r.time ? "\"duty_time\" belongs to duty = \"S2\"; drop it"
                              : "duty = \"S2\" needs \"duty_time\"; give that, too");
            if ((r.duty == Duty::intermittent) != r.share.has_value())
              r.refuse(r.share ? r.key(&Rating::share) : r.key(&Rating::duty),
                       r.share ? "\"duty_share\" belongs to duty = \"S3\"; drop it"
                               : "duty = \"S3\" needs \"duty_share\"; give that, too");
          });
  return made;
}

}  // namespace kurbel
