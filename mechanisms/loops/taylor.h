// taylor.h — truncated Taylor series of a function of φ: exact derivatives of loop equations in long double.
#pragma once

#include <cmath>

namespace kurbel {

// c[k] = f⁽ᵏ⁾(φ)/k!
struct Taylor {
  static constexpr int order = 3;
  long double c[order + 1] = {};

  Taylor() = default;
  Taylor(long double constant) : c{constant} {}  // NOLINT: implicit, for numbers in formulas
  static Taylor variable(long double at) {
    Taylor t(at);
    t.c[1] = 1;
    return t;
  }
  long double value() const { return c[0]; }
  long double slope() const { return c[1]; }
  long double curvature() const { return 2 * c[2]; }
  Taylor derivative() const {  // the last coefficient is unknown and set to 0
    Taylor t;
    for (int k = 0; k < order; ++k) t.c[k] = (k + 1) * c[k + 1];
    return t;
  }

  friend Taylor operator+(Taylor a, const Taylor& b) {
    for (int k = 0; k <= order; ++k) a.c[k] += b.c[k];
    return a;
  }
  friend Taylor operator-(Taylor a, const Taylor& b) {
    for (int k = 0; k <= order; ++k) a.c[k] -= b.c[k];
    return a;
  }
  friend Taylor operator-(const Taylor& a) { return Taylor() - a; }
  friend Taylor operator*(const Taylor& a, const Taylor& b) {
    Taylor t;
    for (int k = 0; k <= order; ++k)
      for (int j = 0; j <= k; ++j) t.c[k] += a.c[j] * b.c[k - j];
    return t;
  }
  friend Taylor operator/(const Taylor& a, const Taylor& b) {
    Taylor t;
    for (int k = 0; k <= order; ++k) {
      t.c[k] = a.c[k];
      for (int j = 0; j < k; ++j) t.c[k] -= t.c[j] * b.c[k - j];
      t.c[k] /= b.c[0];
    }
    return t;
  }
};

inline Taylor sqrt(const Taylor& a) {
  Taylor t(std::sqrt(a.c[0]));
  for (int k = 1; k <= Taylor::order; ++k) {
    t.c[k] = a.c[k];
    for (int j = 1; j < k; ++j) t.c[k] -= t.c[j] * t.c[k - j];
    t.c[k] /= 2 * t.c[0];
  }
  return t;
}

// A unit vector at an angle that is a function of φ.
struct Direction {
  Taylor cos, sin;

  // At the angle part · (φ + shift).
  static Direction of_variable(long double shifted, long double part = 1) {
    Direction d;
    const long double s = std::sin(part * shifted), c = std::cos(part * shifted), p = part;
    const long double cosine[] = {c, -s * p, -c * p * p / 2, s * p * p * p / 6};
    const long double sine[] = {s, c * p, -s * p * p / 2, -c * p * p * p / 6};
    for (int k = 0; k <= Taylor::order; ++k) d.cos.c[k] = cosine[k], d.sin.c[k] = sine[k];
    return d;
  }
  static Direction constant(long double angle) { return {Taylor(std::cos(angle)), Taylor(std::sin(angle))}; }
  friend Direction operator+(const Direction& a, const Direction& b) {  // angles add
    return {a.cos * b.cos - a.sin * b.sin, a.sin * b.cos + a.cos * b.sin};
  }
  Taylor rate() const { return cos * sin.derivative() - sin * cos.derivative(); }  // of the angle, by φ
  long double angle() const { return std::atan2(sin.value(), cos.value()); }
  Taylor series() const {  // of the angle
    const Taylor r = rate();
    Taylor t(angle());
    for (int k = 0; k < Taylor::order; ++k) t.c[k + 1] = r.c[k] / (k + 1);
    return t;
  }
};

struct Path {
  Taylor x, y;
  friend Path operator+(const Path& a, const Path& b) { return {a.x + b.x, a.y + b.y}; }
  friend Path operator-(const Path& a, const Path& b) { return {a.x - b.x, a.y - b.y}; }
};
inline Path along(const Direction& d, const Taylor& length) { return {length * d.cos, length * d.sin}; }
inline Path along(const Direction& d, long double length) {
  Path p{d.cos, d.sin};
  for (int k = 0; k <= Taylor::order; ++k) p.x.c[k] *= length, p.y.c[k] *= length;
  return p;
}

}  // namespace kurbel
