// mechanism_words.cpp — structure, transmission angles and the output's travel over the crank's angle, for every kind of
// mechanism from its bodies and joints.
#include "studies/reduce/mechanism_words.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "engine/numerics/angles.h"
#include "engine/scene/units.h"

namespace kurbel {
namespace {

// Ascending; one at 359.9999999999° stands at 0°.
std::vector<double> reversals_of(const Mechanism& m) {
  std::vector<double> ends = m.travel.reversals;
  for (double& phi : ends)
    if (std::abs(std::remainder(phi, m.cycle())) < 1e-9) phi = 0;
  std::sort(ends.begin(), ends.end());
  return ends;
}

// For an output that reverses twice in a cycle.
std::string time_ratio(const Mechanism& m, const std::vector<double>& ends) {
  if (ends.size() != 2) return {};
  const double one = ends[1] - ends[0], other = m.cycle() - one, slow = std::max(one, other),
               quick = std::min(one, other);
  return fmt::format("; one stroke takes {:.4g}°, the other {:.4g}°: time ratio {:.4g}", slow / degree, quick / degree,
                     slow / quick);
}

std::string travel(const Mechanism& m) {
  if (m.arc()) return "its " + words_of_arc(m);
  if (m.travel.winding == 1) return "its output turns as often as its driving link";
  if (m.travel.winding != 0)
    return fmt::format("its output makes {:g} times as many turns as its driving link", m.travel.winding);
  if (m.stroke() == 0) return "its output stands still";
  const std::vector<double> ends = reversals_of(m);
  std::string centres;
  for (const double phi : ends) centres += fmt::format("{}{:.4g}°", centres.empty() ? "" : ", ", phi / degree);
  return fmt::format("{} {}, dead centres at φ = {}{}", m.rocks() ? "swing" : "stroke",
                     m.rocks() ? fmt::format("{:.4g}°", m.stroke() / degree) : with_unit(m.stroke(), "m", 4), centres,
                     time_ratio(m, ends));
}

struct Dwell {
  double from, to, phi;  // of the driving link [rad]; the reversal
};

// Where the output stays within this share of its stroke from where it reverses; of ranges that overlap the widest.
std::vector<Dwell> dwells_of(const Mechanism& m, double share) {
  constexpr int steps = 7200;
  std::vector<Dwell> dwells;
  for (const double phi : reversals_of(m)) {
    const double end = m.reduced->output_position(phi).value, step = m.cycle() / steps;
    const auto edge = [&](double sense) {
      const auto within = [&](double way) {
        return std::abs(m.reduced->output_position(phi + sense * way).value - end) <= share * m.stroke();
      };
      int i = 1;
      while (i < steps && within(i * step)) ++i;
      double in = (i - 1) * step, out = i * step;
      for (int k = 0; k < 50; ++k) {
        const double middle = (in + out) / 2;
        (within(middle) ? in : out) = middle;
      }
      return phi + sense * in;
    };
    dwells.push_back({edge(-1), edge(1), phi});
  }
  std::stable_sort(dwells.begin(), dwells.end(),
                   [](const Dwell& a, const Dwell& b) { return a.to - a.from > b.to - b.from; });
  std::vector<Dwell> apart;
  for (const Dwell& d : dwells)
    if (std::none_of(apart.begin(), apart.end(), [&](const Dwell& wider) {
          const double middle = (wider.from + wider.to) / 2, half = (wider.to - wider.from) / 2;
          return std::abs(std::remainder(d.phi - middle, m.cycle())) < half;
        }))
      apart.push_back(d);
  std::sort(apart.begin(), apart.end(), [](const Dwell& a, const Dwell& b) { return a.phi < b.phi; });
  return apart;
}

// Empty: the output does not reverse.
std::string dwell(const Mechanism& m) {
  constexpr double share = 0.01;
  std::string ranges;
  if (m.arc() || m.travel.winding != 0 || m.stroke() == 0) return ranges;
  const auto degrees = [&](double phi) {
    const double at = phi - m.cycle() * std::floor(phi / m.cycle());
    return fmt::format("{:.5g}°", at / degree);
  };
  for (const Dwell& d : dwells_of(m, share))
    ranges += fmt::format("{}{:.4g}° from φ = {} to {}", ranges.empty() ? "" : ", ", (d.to - d.from) / degree,
                          degrees(d.from), degrees(d.to));
  return fmt::format("dwells, no farther from its reversal than {:g} % of its {}: over {}", 100 * share,
                     m.rocks() ? "swing" : "stroke", ranges);
}

// A mechanism as a sketch: its pins at one angle are the points.
LinkageSketch sketch_of(const MechanismData& data) {
  constexpr double somewhere = 0.7;  // off dead centres and change points
  const PlanarLinkage at = data.linkage(data.arc() ? data.arc()->middle : somewhere);
  LinkageSketch s;
  for (const PlanarLinkage::Body& body : at.bodies) s.links.push_back({.name = body.name, .points = {}});
  const auto points_of = [&](int body) -> std::vector<int>& {
    return body == LinkageSketch::frame ? s.frame_points : s.links[static_cast<std::size_t>(body)].points;
  };
  const auto stands_at = [&](int point, const PlanarLinkage::Joint& joint) {
    const LinkageSketch::Point& p = s.points[static_cast<std::size_t>(point)];
    return p.x == static_cast<double>(joint.at.x.value()) && p.y == static_cast<double>(joint.at.y.value());
  };
  for (const PlanarLinkage::Joint& joint : at.joints) {
    if (joint.slides) continue;
    int point = 0;  // several links may be on one pin
    const int count = static_cast<int>(s.points.size());
    while (point < count && !(stands_at(point, joint) && (s.has(joint.from, point) || s.has(joint.on, point)))) ++point;
    if (point == count)
      s.points.push_back(
          {joint.name, static_cast<double>(joint.at.x.value()), static_cast<double>(joint.at.y.value())});
    for (const int body : {joint.from, joint.on})
      if (!s.has(body, point)) points_of(body).push_back(point);
  }
  for (const PlanarLinkage::Joint& joint : at.joints) {
    if (!joint.slides) continue;
    const bool by_first = joint.from != LinkageSketch::frame && !points_of(joint.from).empty() &&
                          stands_at(points_of(joint.from).front(), joint);
    s.slides.push_back({by_first ? joint.from : joint.on, by_first ? joint.on : joint.from,
                        static_cast<double>(std::atan2(joint.along.sin.value(), joint.along.cos.value()))});
  }
  s.output = {static_cast<int>(s.links.size()) - 1, s.links.back().points.front(), 0};
  return s;
}

// Null: its joints are unknown, or its links pass change points, beside which a sketch leaves the branch open.
std::shared_ptr<const Linkage> linkage_in(const MechanismData& data) {
  if (const auto* drawn = data.as<LinkageData>()) return drawn->linkage;
  if (!data.joints_are_known()) return nullptr;
  auto linkage = std::make_shared<const Linkage>(sketch_of(data));
  return linkage->faults().empty() ? linkage : nullptr;
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

std::string structure_words(const Mechanism& mechanism) {
  const auto linkage = linkage_in(mechanism.data);
  return linkage ? linkage->structure_in_words() : "";
}

std::vector<std::string> mechanism_words(const Mechanism& m) {
  std::vector<std::string> words;
  if (const auto linkage = linkage_in(m.data)) {
    words.push_back(linkage->structure_in_words());
    for (const std::string& angle : linkage->transmission_in_words()) words.push_back(angle);
  }
  words.push_back(travel(m));
  if (const std::string line = dwell(m); !line.empty()) words.push_back(line);
  return words;
}

std::vector<std::string> mechanism_notes(const Model& model) {
  std::vector<std::pair<std::string, std::vector<std::string>>> groups;  // names, words
  for (const Network::ShaftElement& e : model.network.elements) {
    const MechanismElement* const element = mechanism_of(e);
    if (!element) continue;
    const Mechanism& m = element->mechanism();
    const std::vector<std::string> words = mechanism_words(m);
    const auto same = std::ranges::find(groups, words, &decltype(groups)::value_type::second);
    if (same == groups.end())
      groups.emplace_back(m.name, words);
    else
      same->first += ", " + m.name;
  }
  std::vector<std::string> notes;
  for (const auto& [names, words] : groups)
    for (const std::string& line : words) notes.push_back(fmt::format("{}: {}", names, line));
  return notes;
}

}  // namespace kurbel
