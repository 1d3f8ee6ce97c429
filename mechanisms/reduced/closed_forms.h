// closed_forms.h — all mechanisms by their loop equations in closed form, in long double: the source of the second
// extraction. Nothing here knows Simbody, Newton's method or a difference that cancels near a change point.
//
// Positions by triangles; their sides' sums and differences are formed before anything is subtracted from them.
// Derivatives by Taylor series, I_r and M_g by theory 2.1 and 2.2 over all links.
#pragma once

#include "mechanisms/linkages/four_bar.h"
#include "mechanisms/linkages/knuckle_press.h"
#include "mechanisms/linkages/mechanism_bodies.h"
#include "mechanisms/linkages/quick_return.h"
#include "mechanisms/linkages/slider_crank_simbody.h"

namespace kurbel {

// As a ReducedSample, which says what is what.
struct ClosedForm {
  long double inertia = 0, inertia_slope = 0, inertia_curvature = 0;
  long double output_position = 0, output_velocity_ratio = 0, output_acceleration_ratio = 0;
  long double gravity_torque = 0, gravity_torque_slope = 0, gravity_torque_scale = 0;
  long double potential_energy = 0;  // [J], zero at the height of the crank's axis
};

// For data without faults.
ClosedForm closed_form(const SliderCrankData& data, long double phi);
ClosedForm closed_form(const FourBarData& data, long double phi);
ClosedForm closed_form(const QuickReturnData& data, long double phi);
ClosedForm closed_form(const KnucklePressData& data, long double phi);

}  // namespace kurbel
