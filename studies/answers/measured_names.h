// measured_names.h — by what names a page knows a measurement that is laid over it, whoever lays it there.
#pragma once

#include <string>

namespace kurbel {

// A chapter in front of the figures; empty, it is not shown.
inline constexpr const char* chapter_of_measurement = "Against the measurement";

// A trace beside those of the run that holds what was measured of a channel, in SI, at the run's time or angle.
inline std::string measured_trace(const std::string& channel) { return "measured." + channel; }

}  // namespace kurbel
