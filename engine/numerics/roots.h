// roots.h — where a function of one variable vanishes between two places at which its signs differ.
#pragma once

#include <functional>

namespace kurbel {

// Root of f in [a, b] with f(a), f(b) of opposite signs (Illinois), to the last few bits or |f| ≤ enough.
double find_root(const std::function<double(double)>& f, double a, double fa, double b, double fb, double enough = 0);

}  // namespace kurbel
