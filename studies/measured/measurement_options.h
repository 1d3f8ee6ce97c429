// measurement_options.h — options by which a test's record is laid over a simulation.
#pragma once

#include "studies/measured/measurement.h"
#include "studies/question/option.h"

namespace kurbel {

const OptionsOf<MeasurementRequest>& measurement_options();

}  // namespace kurbel
