// circles_cut.h — points of linkages by cutting circles, with their rates: independent of every source under test.
#pragma once

#include <cmath>
#include <complex>

namespace kurbel::test {

using Real = long double;
using Complex = std::complex<Real>;

// A place and its derivative by the crank's angle.
struct Moving {
  Complex p, v;
};
inline Real dot(Complex a, Complex b) { return a.real() * b.real() + a.imag() * b.imag(); }
inline Real cross(Complex a, Complex b) { return a.real() * b.imag() - a.imag() * b.real(); }

inline Moving crank_pin(Real radius, Real phi) {
  const Complex p = std::polar(radius, phi);
  return {p, Complex(0, 1) * p};
}
// At these distances from a and b, on the left of the way from a to b (side 1) or on its right.
inline Moving cut(const Moving& a, Real ra, const Moving& b, Real rb, int side) {
  const Complex way = b.p - a.p;
  const Real d = std::abs(way), foot = (d * d + (ra - rb) * (ra + rb)) / (2 * d);
  const Complex p = a.p + way / d * Complex(foot, side * std::sqrt((ra - foot) * (ra + foot)));
  // (p − a)·(v − v_a) = 0, (p − b)·(v − v_b) = 0
  const Complex m = p - a.p, n = p - b.p;
  const Real f = dot(m, a.v), g = dot(n, b.v), det = cross(m, n);
  return {p, {(f * n.imag() - g * m.imag()) / det, (m.real() * g - n.real() * f) / det}};
}
// Of the link from a to b the point that the sketch has at c.
inline Moving carried(const Moving& a, const Moving& b, Complex sketch_a, Complex sketch_b, Complex sketch_c) {
  const Complex part = (sketch_c - sketch_a) / (sketch_b - sketch_a);
  return {a.p + part * (b.p - a.p), a.v + part * (b.v - a.v)};
}
inline Real turning(const Moving& a, const Moving& b) { return cross(b.p - a.p, b.v - a.v) / std::norm(b.p - a.p); }
inline int side_of(Complex a, Complex b, Complex c) { return cross(b - a, c - a) > 0 ? 1 : -1; }

}  // namespace kurbel::test
