// linkage_drawing.cpp — links as lines through their points, slides as blocks on lines.
#include <algorithm>
#include <cmath>

#include "mechanisms/bodies/sketched_linkage.h"

namespace kurbel {
namespace {

struct DrawnJoint {
  int body;       // the body that it moves with
  SketchSpot at;  // in the position of the sketch, axes of the mechanism [m]
  std::string name;
};

class LinkageDrafter {
 public:
  explicit LinkageDrafter(const Linkage& linkage) : l_(linkage), s_(linkage.sketch()), index_(s_.points.size(), -1) {
    add_point(l_.structure().bearing);
    for (const int p : s_.links[static_cast<std::size_t>(s_.driver)].points) add_point(p);
    for (int p = 0; p < static_cast<int>(s_.points.size()); ++p) add_point(p);
    for (const DrawnJoint& j : joints) size_ = std::max(size_, length(j.at));
    for (std::size_t k = 0; k < s_.links.size(); ++k)
      if (static_cast<int>(k) != s_.driver) add_link(s_.links[k], "link");
    // What the load is shown at: a slider along the output's axis, else the point itself.
    for (const bool of_output : {true, false})
      for (const LinkageSketch::Slide& slide : s_.slides)
        if ((slide.on == LinkageSketch::frame && slide.link == s_.output.link) == of_output) add_slide(slide);
    const auto is_slider = [](const LinkageDrawing::Link& link) { return link.shape == "slider"; };
    if (!s_.output.rocks() && std::none_of(links.begin(), links.end(), is_slider))
      links.push_back({"point", {index_of_point(s_.output.point)}});
    add_link(s_.links[static_cast<std::size_t>(s_.driver)], "crank");
  }

  std::vector<DrawnJoint>
      joints;  // in the order of LinkageDrawing's: the driving link's bearing and its next point first
  std::vector<LinkageDrawing::Link> links;
  int index_of_point(int p) const { return index_[static_cast<std::size_t>(p)]; }

 private:
  void add_point(int p) {
    int& index = index_[static_cast<std::size_t>(p)];
    if (index >= 0) return;
    int body = LinkageSketch::frame;
    while (!s_.has(body, p) && body + 1 < static_cast<int>(s_.links.size())) ++body;
    index = static_cast<int>(joints.size());
    joints.push_back({body, l_.spot_of(p), s_.points[static_cast<std::size_t>(p)].name});
  }
  int add_place(int body, SketchSpot at) {
    joints.push_back({body, at, ""});
    return static_cast<int>(joints.size()) - 1;
  }
  // From the bearing on; of three points and more closed.
  void add_link(const LinkageSketch::Link& link, const char* shape) {
    std::vector<int> through;
    for (const int p : link.points) through.push_back(index_of_point(p));
    if (std::string(shape) == "crank") std::sort(through.begin(), through.end());
    if (through.size() > 2) through.push_back(through.front());
    if (through.size() > 1) links.push_back({shape, through});
  }
  void add_slide(const LinkageSketch::Slide& slide) {
    constexpr long double parallel = 1e-9L;
    const int p = s_.links[static_cast<std::size_t>(slide.link)].points.front(), block = index_of_point(p);
    const SketchSpot at = l_.spot_of(p), along = l_.structure().axes.direction(slide.angle);
    if (slide.on == LinkageSketch::frame) {
      if (std::fabs(along.y) < parallel)
        links.push_back({"slider", {block}});
      else
        links.push_back({"block", {block, add_place(LinkageSketch::frame, at + 0.3L * size_ * along)}});
      return;
    }
    for (const int q : s_.links[static_cast<std::size_t>(slide.on)].points) {
      const SketchSpot way = l_.spot_of(q) - at;
      if (!(length(way) > 0) || std::fabs(cross(along, way)) > parallel * length(way)) continue;
      links.push_back({"slot", {index_of_point(q), block}});
      links.push_back({"block", {block, index_of_point(q)}});
      return;
    }
    const long double half = 1.6L * std::max(length(at), 0.1L * size_);
    const int low = add_place(slide.on, at - half * along), high = add_place(slide.on, at + half * along);
    links.push_back({"slot", {low, high}});
    links.push_back({"block", {block, high}});
  }

  const Linkage& l_;
  const LinkageSketch& s_;
  std::vector<int> index_;  // of the sketch's points
  long double size_ = 0;
};

}  // namespace

std::vector<PlanePoint> places_of(const LinkageData& data, double phi) {
  const LinkPoses poses = data.linkage->poses(phi);
  std::vector<PlanePoint> places;
  const LinkageDrafter drafter(*data.linkage);
  for (const DrawnJoint& place : drafter.joints) {
    const Path at = poses[place.body](place.at);
    places.push_back({static_cast<double>(at.x.value()), static_cast<double>(at.y.value())});
  }
  return places;
}

LinkageDrawing drawing_of(const LinkageData& data) {
  const Linkage& l = *data.linkage;
  const LinkageDrafter drafter(l);
  LinkageDrawing drawing;
  drawing.name = "Linkage";
  drawing.direction = l.sketch().elevation + l.structure().axes.turned();
  drawing.links = drafter.links;
  for (std::size_t k = 0; k < drafter.joints.size(); ++k) {
    const DrawnJoint& joint = drafter.joints[k];
    drawing.names.push_back(joint.name);
    if (joint.body == LinkageSketch::frame && !joint.name.empty()) drawing.fixed.push_back(static_cast<int>(k));
  }
  drawing.output = drafter.index_of_point(l.output_point());
  drawing.rocks = l.sketch().output.rocks();
  return drawing;
}

LinkageDrawing drawing_of(const LinkageTravelData& data) {
  LinkageDrawing drawing = drawing_of(LinkageData{data.linkage, 0});
  drawing.rocks = data.travel.rocks();
  return drawing;
}

}  // namespace kurbel
