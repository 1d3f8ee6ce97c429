// measurement_options.h — options for comparing a measured record with a simulation.
#pragma once

#include "studies/measured/measurement.h"
#include "studies/question/option.h"

namespace kurbel {

const OptionsOf<MeasurementRequest>& measurement_options();

}  // namespace kurbel
