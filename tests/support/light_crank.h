// light_crank.h — what gives a shaft a cycle and no load.
#pragma once

namespace kurbel::test {

// A crank without mass, so that a turn is a cycle.
inline constexpr const char* light_crank = R"(
[crank]
kind = "slider-crank"
radius = "0.1 m"
rod = "0.4 m"
slider_mass = "1e-6 kg"
)";

}  // namespace kurbel::test
