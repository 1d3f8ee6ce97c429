// mechanism_data.h — the mechanisms that there are, each with its own data.
#pragma once

#include <memory>
#include <variant>

#include "mechanisms/linkages/four_bar.h"
#include "mechanisms/linkages/knuckle_press.h"
#include "mechanisms/linkages/quick_return.h"
#include "mechanisms/linkages/slider_crank_geometry.h"
#include "mechanisms/linkages/slider_crank_simbody.h"

namespace kurbel {

using MechanismData = std::variant<SliderCrankData, FourBarData, QuickReturnData, KnucklePressData>;

}  // namespace kurbel
