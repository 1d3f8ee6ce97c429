// measured_names.h — names under which a page shows a measurement for comparison.
#pragma once

#include <string>

namespace kurbel {

// A chapter before the figures; not shown if empty.
inline constexpr const char* chapter_of_measurement = "Against the measurement";

// A trace beside those of the run: the measured channel in SI, over the run's time or angle.
inline std::string measured_trace(const std::string& channel) { return "measured." + channel; }

}  // namespace kurbel
