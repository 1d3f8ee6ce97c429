// angles.h — turns and degrees in radians; conversion factors.
#pragma once

#include <numbers>

namespace kurbel {

inline constexpr double pi = std::numbers::pi;
inline constexpr double turn = 2 * pi;          // [rad]
inline constexpr double degree = pi / 180;      // [rad]
inline constexpr double in_degrees = 180 / pi;  // an angle [rad] times this is in degrees
inline constexpr double in_rpm = 30 / pi;       // a speed [rad/s] times this is in revolutions per minute

}  // namespace kurbel
