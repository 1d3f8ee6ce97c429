// hand_written.h — what a person writes for one machine alone: minimal coordinates, closed forms, arrays of fixed size,
// and the same Runge–Kutta table and step control as kurbel's. Peers for R1, R2b and E1.
#pragma once

#include "bench/benches.h"

namespace kurbel::bench {

BenchPoint hand_written_r1(const std::string& method, double tolerance);
BenchPoint hand_written_r2b(const std::string& method, double tolerance);
BenchPoint hand_written_e1(const std::string& method, double tolerance);

}  // namespace kurbel::bench
