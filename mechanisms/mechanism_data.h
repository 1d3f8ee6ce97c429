// mechanism_data.h — the mechanisms that there are, each with its own data.
#pragma once

#include <memory>
#include <variant>

#include "mechanisms/four_bar.h"
#include "mechanisms/knuckle_press.h"
#include "mechanisms/quick_return.h"
#include "mechanisms/slider_crank_geometry.h"
#include "mechanisms/slider_crank_simbody.h"

namespace kurbel {

using MechanismData = std::variant<SliderCrankData, FourBarData, QuickReturnData, KnucklePressData>;

}  // namespace kurbel
