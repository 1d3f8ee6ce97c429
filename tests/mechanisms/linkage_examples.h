// linkage_examples.h — linkages that the tests share, as sketches.
#pragma once

#include <memory>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "mechanisms/linkage/linkage.h"
#include "mechanisms/reduced/mechanism_data.h"

namespace kurbel::test {

// Points by letters, links by the letters that they go through.
class SketchOf {
 public:
  SketchOf& point(char name, double x, double y) {
    s.points.push_back({std::string(1, name), x, y});
    return *this;
  }
  SketchOf& frame(const std::string& points) {
    s.frame_points = indices(points);
    return *this;
  }
  // Its centre of mass amid its points.
  SketchOf& link(const std::string& name, const std::string& points, double mass = 0, double inertia = 0) {
    LinkageSketch::Link link{name, indices(points), mass, 0, 0, inertia};
    for (const int p : link.points) {
      link.com_x += s.points[static_cast<std::size_t>(p)].x / static_cast<double>(link.points.size());
      link.com_y += s.points[static_cast<std::size_t>(p)].y / static_cast<double>(link.points.size());
    }
    s.links.push_back(link);
    return *this;
  }
  SketchOf& com(double x, double y) {  // of the last link
    s.links.back().com_x = x, s.links.back().com_y = y;
    return *this;
  }
  SketchOf& slide(const std::string& link, double angle, const std::string& on = "") {
    s.slides.push_back({number(link), on.empty() ? LinkageSketch::frame : number(on), angle});
    return *this;
  }
  SketchOf& drives(const std::string& link) {
    s.driver = number(link);
    return *this;
  }
  SketchOf& rocks(const std::string& link) {
    s.output = {number(link), -1, 0};
    return *this;
  }
  SketchOf& moves(const std::string& link, char point, double along) {
    s.output = {number(link), indices(std::string(1, point)).front(), along};
    return *this;
  }
  LinkageData data() const { return {std::make_shared<const Linkage>(s), s.gravity}; }

  LinkageSketch s;

 private:
  std::vector<int> indices(const std::string& letters) const {
    std::vector<int> list;
    for (const char letter : letters)
      for (std::size_t p = 0; p < s.points.size(); ++p)
        if (s.points[p].name[0] == letter) list.push_back(static_cast<int>(p));
    return list;
  }
  int number(const std::string& link) const {
    for (std::size_t k = 0; k < s.links.size(); ++k)
      if (s.links[k].name == link) return static_cast<int>(k);
    return -1;
  }
};

// A slider-crank OAD whose ram has its centre of mass in its pin and a point E beside it, which is the output.
inline SketchOf ram_with_a_point_beside_its_pin() {
  SketchOf of;
  of.point('O', 0, 0).point('A', 0, 0.06).point('D', 0.25, 0).point('E', 0.4, 0.05).frame("O");
  of.link("crank", "OA", 2, 0.004).link("rod", "AD", 3, 0.03).link("ram", "DE", 40).com(0.25, 0);
  return of.slide("ram", 0).moves("ram", 'E', 0);
}

// Stephenson's chain: a four-bar OABC, a rod from a point D of its coupler, a rocker GE.
inline SketchOf stephenson() {
  SketchOf of;
  of.point('O', 0, 0).point('A', 0.05, 0).point('B', 0.19, 0.14).point('C', 0.24, 0).point('D', 0.15, 0.22);
  of.point('E', 0.34, 0.26).point('G', 0.42, 0.08).frame("OCG");
  of.link("crank", "OA", 2, 0.004).link("coupler", "ABD", 3, 0.03).link("rocker", "CB", 1.6, 0.006);
  of.link("rod", "DE", 1.8, 0.008).link("lever", "GE", 5, 0.09);
  of.rocks("lever");
  return of;
}

// Peaucellier and Lipkin's cell about the pole O, C on a circle through it: P moves on x = (0.28² − 0.15²)/0.2.
inline SketchOf peaucellier() {
  SketchOf of;
  const double r = 0.1, a = 0.28, b = 0.15, angle = -0.3;
  const double cx = r + r * std::cos(angle), cy = r * std::sin(angle), oc = std::hypot(cx, cy);
  const double foot = (oc * oc + a * a - b * b) / (2 * oc), high = std::sqrt(a * a - foot * foot);
  const double ax = (foot * cx - high * cy) / oc, ay = (foot * cy + high * cx) / oc;
  const double bx = (foot * cx + high * cy) / oc, by = (foot * cy - high * cx) / oc;
  of.point('O', 0, 0).point('Q', r, 0).point('C', cx, cy).point('A', ax, ay).point('B', bx, by);
  of.point('P', ax + bx - cx, ay + by - cy).frame("OQ");
  of.link("crank", "QC", 1, 0.01).link("arm_a", "OA", 1, 0.007).link("arm_b", "OB", 1, 0.007);
  of.link("side_ac", "AC", 0.5, 0.001).link("side_bc", "BC", 0.5, 0.001);
  of.link("side_ap", "AP", 0.5, 0.001).link("side_bp", "BP", 0.5, 0.001);
  of.moves("side_bp", 'P', std::acos(0.0));
  return of;
}

}  // namespace kurbel::test
