// machines.h — pieces that hard cases are made of: scene texts, and the slider-crank in closed form.
#pragma once

#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <string>

namespace kurbel::hard {

inline constexpr double pi = std::numbers::pi;

// A quantity with all its digits: quantity(0.1, "kg*m2").
inline std::string quantity(double value, const std::string& unit) {
  return fmt::format("\"{:.17g} {}\"", value, unit);
}

// Crank radius r, rod l, crank inertia I about the axis, slider mass m, offset e of the slider's line.
struct Crank {
  double radius = 0.1, rod = 0.35, inertia = 0.5, mass = 3, offset = 0;

  using Real = long double;
  Real root(Real phi) const {  // √(l² − (r sin φ − e)²)
    const Real h = radius * std::sin(phi) - offset;
    return std::sqrt((static_cast<Real>(rod) - h) * (static_cast<Real>(rod) + h));
  }
  Real position(Real phi) const { return radius * std::cos(phi) + root(phi); }
  Real slope(Real phi) const {  // dx/dφ
    const Real h = radius * std::sin(phi) - offset;
    return -radius * std::sin(phi) - h * radius * std::cos(phi) / root(phi);
  }
  Real reduced_inertia(Real phi) const { return inertia + mass * slope(phi) * slope(phi); }
  // Without load: all but the brackets.
  std::string keys() const {
    std::string text =
        fmt::format("kind = \"slider-crank\", radius = {}, rod = {}, crank_inertia = {}, slider_mass = {}",
                    quantity(radius, "m"), quantity(rod, "m"), quantity(inertia, "kg*m2"), quantity(mass, "kg"));
    if (offset != 0) text += ", offset = " + quantity(offset, "m");
    return text;
  }
};

// Root of a function that changes sign in [a, b], by bisection to the last bit.
template <class F>
long double bisect(const F& f, long double a, long double b) {
  const bool rising = f(b) > 0;
  for (int i = 0; i < 200; ++i) {
    const long double c = 0.5L * (a + b);
    if (c == a || c == b) break;
    ((f(c) > 0) == rising ? b : a) = c;
  }
  return 0.5L * (a + b);
}

// y(t) of y' = f(y) by the classical Runge–Kutta method in long double.
template <class F>
long double integrate_scalar(const F& rate, long double y, long double t, int steps) {
  const long double h = t / steps;
  for (int i = 0; i < steps; ++i) {
    const long double a = rate(y), b = rate(y + 0.5L * h * a), c = rate(y + 0.5L * h * b), d = rate(y + h * c);
    y += h * (a + 2 * b + 2 * c + d) / 6;
  }
  return y;
}

// ∫ f from a to b by Simpson's rule.
template <class F>
long double simpson(const F& f, long double a, long double b, int halves) {
  const long double h = (b - a) / (2 * halves);
  long double sum = f(a) + f(b);
  for (int i = 1; i < 2 * halves; ++i) sum += (i % 2 == 0 ? 2 : 4) * f(a + i * h);
  return sum * h / 3;
}

}  // namespace kurbel::hard
