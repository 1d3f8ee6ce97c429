// roots.cpp — regula falsi by Anderson and Björck (BIT 13, 1973), kept within its bracket.
#include "engine/numerics/roots.h"

#include <algorithm>

namespace kurbel {

double find_root(const std::function<double(double)>& f, double a, double fa, double b, double fb, double enough) {
  for (int i = 0; i < 100; ++i) {
    if (fb == 0 || std::abs(fb) <= enough) return b;
    double c = (fa * b - fb * a) / (fa - fb);
    if (!(c > std::min(a, b) && c < std::max(a, b))) c = 0.5 * (a + b);
    if (c == a || c == b || std::abs(b - a) <= 4e-16 * std::max(std::abs(a), std::abs(b))) return b;
    const double fc = f(c);
    if ((fc > 0) == (fb > 0)) {
      const double part = 1 - fc / fb;
      fa *= part > 0 ? part : 0.5;  // keeps the far end from standing still
    } else {
      a = b;
      fa = fb;
    }
    b = c;
    fb = fc;
  }
  return b;
}

Maximum find_maximum(const std::function<double(double)>& f, double a, double b, int steps, double enough) {
  constexpr double part = 0.38196601125010515;  // (3 − √5)/2
  double x = a + part * (b - a), y = b - part * (b - a), fx = f(x), fy = f(y);
  for (int i = 0; i < steps && !(fx > enough || fy > enough); ++i) {
    if (fx > fy) {
      b = y, y = x, fy = fx;
      fx = f(x = a + part * (b - a));
    } else {
      a = x, x = y, fx = fy;
      fy = f(y = b - part * (b - a));
    }
  }
  return fx > fy ? Maximum{x, fx} : Maximum{y, fy};
}

}  // namespace kurbel
