// sketch.h — description of a planar linkage: positions of its points in one configuration, links, slides, driving link.
#pragma once

#include <string>
#include <vector>

namespace kurbel {

// In the axes of the sketch; any configuration in which the linkage closes is allowed. A link is a rigid body through its
// points; links (and the frame) with a common point are pinned there, three links by two pins.
struct LinkageSketch {
  static constexpr int frame = -1;  // index of the fixed body
  static constexpr int most_links = 16, most_points = 64;
  struct Point {
    std::string name;
    double x = 0, y = 0;  // [m]
  };
  struct Link {
    std::string name;
    std::vector<int> points;      // at least one
    double mass = 0;              // [kg], ≥ 0
    double com_x = 0, com_y = 0;  // centre of mass, in the sketch [m]
    double inertia = 0;           // about its centre of mass [kg·m²], ≥ 0
  };
  // The first point of `link` stays on a line of `on`, without relative rotation of the two.
  struct Slide {
    int link = 0, on = frame;
    double angle = 0;  // of the line from +x in the sketch [rad]
  };
  // The displacement of a point of `link` along a direction, or the rotation of `link`: the angle from +x of the line from
  // its first to its second point.
  struct Output {
    int link = 0;
    int point = -1;    // −1: it rocks
    double angle = 0;  // of the direction from +x in the sketch [rad]
    bool rocks() const { return point < 0; }
  };
  // A distance given more precisely than by the sketch.
  struct Length {
    int from = 0, to = 0;  // points
    double value = 0;      // [m], > 0
    std::string name;      // "AB"
  };

  std::vector<Point> points;
  std::vector<Link> links;
  std::vector<int> frame_points;
  std::vector<Slide> slides;
  int driver = 0;  // the driving link, pinned to the frame in one point
  Output output;
  double gravity = 0;    // [m/s²], ≥ 0
  double elevation = 0;  // of +x of the sketch above the horizontal [rad]
  double rounded = 0;    // half a unit of the last decimal place that coordinates are given with [m]; 0: they are exact

  bool has(int body, int point) const {
    const std::vector<int>& list = body == frame ? frame_points : links[static_cast<std::size_t>(body)].points;
    for (const int p : list)
      if (p == point) return true;
    return false;
  }
  const std::string& name_of(int body) const;  // "frame", "rocker"
};

// A fault of a linkage.
struct LinkageFault {
  std::string at;    // the part of the description: "points", "links", "slides", "lengths.AB", "links.rod"
  std::string text;  // what, got, allowed, next step
};
using LinkageFaults = std::vector<LinkageFault>;

// Moves the points of the sketch by the least amount that satisfies these lengths; all other lengths of the links and the
// frame stay as drawn; centres of mass move with their links. Faults: lengths between points without a common link,
// redundant lengths, lengths with which the linkage does not close.
LinkageFaults take_lengths(LinkageSketch& sketch, const std::vector<LinkageSketch::Length>& lengths);

}  // namespace kurbel
