// planar.h — a vector of the plane in precision T.
#pragma once

#include <cmath>

namespace kurbel {

template <class T>
struct Planar {
  T x{}, y{};
  T magnitude() const { return std::hypot(x, y); }
  T direction() const { return std::atan2(y, x); }  // [rad]
  // Components in axes rotated by `angle`.
  Planar seen_from(T angle) const {
    const T c = std::cos(angle), s = std::sin(angle);
    return {c * x + s * y, c * y - s * x};
  }
  friend Planar operator+(Planar a, Planar b) { return {a.x + b.x, a.y + b.y}; }
  friend Planar operator-(Planar a, Planar b) { return {a.x - b.x, a.y - b.y}; }
  friend Planar operator*(T s, Planar a) { return {s * a.x, s * a.y}; }
  friend T dot(Planar a, Planar b) { return a.x * b.x + a.y * b.y; }
  friend T cross(Planar a, Planar b) { return a.x * b.y - a.y * b.x; }
  friend T length(Planar a) { return a.magnitude(); }
  friend Planar left(Planar a) { return {-a.y, a.x}; }  // ẑ × a
};

}  // namespace kurbel
