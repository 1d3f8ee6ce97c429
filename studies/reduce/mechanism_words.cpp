// mechanism_words.cpp — figures of the output's travel over the driving link's angle.
#include "studies/reduce/mechanism_words.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "engine/numerics/angles.h"
#include "engine/scene/units.h"
#include "mechanisms/reduced/mechanism.h"

namespace kurbel {
namespace {

// For a rotating driving link and an output that reverses twice in a cycle.
std::string time_ratio(const Mechanism& m) {
  const std::vector<double>& ends = m.travel.reversals;
  if (ends.size() != 2 || m.arc()) return {};
  const double one = ends[1] - ends[0], other = m.cycle() - one, slow = std::max(one, other),
               quick = std::min(one, other);
  return fmt::format("; one stroke takes {:.5g}°, the other {:.5g}°: time ratio {:.4g}", slow / degree, quick / degree,
                     slow / quick);
}

std::string travel(const Mechanism& m) {
  if (m.arc()) return "its " + words_of_arc(m);
  if (m.travel.winding != 0) return fmt::format("its output makes {:g} times as many turns as it", m.travel.winding);
  const char* unit = m.rocks() ? "deg" : "m";
  std::string centres;
  for (const double phi : m.travel.reversals)
    centres += fmt::format("{}{:.5g}°", centres.empty() ? "" : ", ", phi / degree);
  return fmt::format("{} {}, dead centres at φ = {}{}", m.rocks() ? "swing" : "stroke",
                     m.rocks() ? fmt::format("{:.6g}°", m.stroke() / degree) : with_unit(m.stroke(), unit, 6), centres,
                     time_ratio(m));
}

}  // namespace

std::vector<PointPath> point_paths(const Model& model) {
  constexpr int steps_of_turn = 360;
  std::vector<PointPath> paths;
  for (const Network::ShaftElement& e : model.network.elements) {
    const MechanismElement* const element = mechanism_of(e);
    const auto* const data = element ? element->mechanism().data.as<LinkageData>() : nullptr;
    if (!data) continue;
    const Linkage& l = *data->linkage;
    const LinkageSketch& s = l.sketch();
    const double axes = l.structure().axes.turned(), c = std::cos(axes), sine = std::sin(axes);
    std::vector<std::pair<int, int>> points;  // link, point
    for (int p = 0; p < static_cast<int>(s.points.size()); ++p)
      for (int link = 0; link < static_cast<int>(s.links.size()) && !s.has(LinkageSketch::frame, p); ++link)
        if (s.has(link, p)) {
          points.emplace_back(link, p);
          break;
        }
    std::vector<PointPath> own;
    for (const auto& [link, p] : points)
      own.push_back({element->mechanism().name + "." + s.points[static_cast<std::size_t>(p)].name, {}, {}, {}});
    const double from = l.arc() ? l.arc()->middle - l.arc()->reach() : 0;
    const double way = l.arc() ? 2 * l.arc()->reach() : l.turns() * turn;
    const int steps = l.turns() * steps_of_turn;
    for (int i = 0; i <= steps; ++i) {
      const double phi = from + way * i / steps;
      const LinkPoses poses = l.poses(phi);
      for (std::size_t k = 0; k < points.size(); ++k) {
        const Path at = poses[points[k].first](l.spot_of(points[k].second));
        const auto x = static_cast<double>(at.x.value()), y = static_cast<double>(at.y.value());
        own[k].phi.push_back(phi), own[k].x.push_back(c * x - sine * y), own[k].y.push_back(sine * x + c * y);
      }
    }
    paths.insert(paths.end(), own.begin(), own.end());
  }
  return paths;
}

std::vector<std::string> mechanism_words(const Model& model) {
  std::vector<std::string> words;
  for (const Network::ShaftElement& e : model.network.elements) {
    const MechanismElement* const element = mechanism_of(e);
    if (!element) continue;
    const std::vector<std::string> about = element->mechanism().data.about();
    for (const std::string& line : about) words.push_back(element->mechanism().name + ": " + line);
    if (!about.empty()) words.push_back(element->mechanism().name + ": " + travel(element->mechanism()));
  }
  return words;
}

}  // namespace kurbel
