// linkage_kind.cpp — the keys of any planar linkage: a sketch of its points, links through them, slides, the driving link.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "mechanisms/kinds/kinds.h"
#include "mechanisms/kinds/linkage_force_keys.h"
#include "mechanisms/kinds/mechanism_keys.h"

namespace kurbel {
namespace {

struct PointKeys {
  std::vector<double> at;  // in the sketch's unit
};
struct LinkKeys {
  std::string points;
  double mass = 0;                         // [kg]
  std::optional<std::vector<double>> com;  // in the sketch's unit
  double inertia = 0;                      // central [kg·m²]
};
struct SlideKeys {
  std::optional<double> along;  // [rad]
  std::optional<std::string> through;
  std::string on = "frame";
};
struct LengthKeys {
  double length = 0;  // [m]
};

struct LinkageKeys {
  double unit = 1;  // [m]
  std::vector<Reading<PointKeys>> points;
  std::vector<Reading<LinkKeys>> links;
  std::string frame;
  std::vector<Reading<SlideKeys>> slides;
  std::vector<Reading<LengthKeys>> lengths;
  std::optional<std::string> driver, output;
  std::optional<double> output_along;  // [rad]
  double gravity = 0, sketch_angle = 0;
  Mounting mounting;
  std::vector<LoadReading> torques;  // in place of the mounting's loads, of an output that rocks
  LinkageForceKeys within;
};

const Tables<Reading<PointKeys>>& point_tables() {
  static const auto made =
      by_names("point", "A point of the sketch; A = [x, y] is short for A = { at = [x, y] }",
               Fields<PointKeys>().add({.name = "at", .doc = "x and y in the sketch, in `unit`", .required = true},
                                       &PointKeys::at));
  return made;
}

const Tables<Reading<LinkKeys>>& link_tables() {
  static const auto made = by_names(
      "link", "A rigid link; rod = \"D E\" is short for rod = { points = \"D E\" }",
      Fields<LinkKeys>()
          .add({.name = "points",
                .doc = "names of the points that it goes through; links that share a point are pinned there",
                .required = true},
               &LinkKeys::points)
          .add(mass_key("mass", "mass of the link"), &LinkKeys::mass)
          .add({.name = "com", .doc = "its centre of mass [x, y] in the sketch, in `unit`; default: amid its points"},
               &LinkKeys::com)
          .add(defaulted("inertia", "kg*m2", "0 kg*m2", not_negative, "about its centre of mass"), &LinkKeys::inertia));
  return made;
}

const Tables<Reading<SlideKeys>>& slide_tables() {
  static const auto made = by_names(
      "slide",
      "Named by the link that slides, without turning against what it slides on: ram = \"90 deg\" is short for ram = { "
      "along = \"90 deg\" }",
      Fields<SlideKeys>()
          .add(quantity("along", "rad", any_number, "direction of the line in the sketch, from +x"), &SlideKeys::along)
          .add({.name = "through", .doc = "two points, in place of along: the line is as their way in the sketch"},
               &SlideKeys::through)
          .add({.name = "on",
                .fallback = "\"frame\"",
                .doc = "the link that has the line; its first point slides there"},
               &SlideKeys::on)
          .check([](const Reading<SlideKeys>& s) {
            if (s.given(&SlideKeys::along) == s.given(&SlideKeys::through))
              s.refuse("give the line's direction either by along = \"90 deg\" or by through = \"A B\"");
          }));
  return made;
}

const Tables<Reading<LengthKeys>>& length_tables() {
  static const auto made =
      by_names("length", "Named by two points of one link: AB = \"262.3 mm\"",
               Fields<LengthKeys>().add(required("length", "m", positive, "their distance"), &LengthKeys::length));
  return made;
}

Fields<LinkageKeys> linkage_fields() {
  return Fields<LinkageKeys>()
      .add({.name = "points",
            .doc = "the sketch: places of all points in any one position in which the linkage closes, A = [x, y]",
            .required = true,
            .effect = "variable_inertia multibody"},
           &LinkageKeys::points, point_tables())
      .add({.name = "unit", .doc = "of the sketch's coordinates", .required = true}, &LinkageKeys::unit,
           {{"mm", 1e-3}, {"cm", 1e-2}, {"m", 1.0}, {"in", 0.0254}})
      .add({.name = "links", .doc = "the moving links, each through points of the sketch", .required = true},
           &LinkageKeys::links, link_tables())
      .add({.name = "frame", .doc = "points that stand still: \"O C\"", .required = true}, &LinkageKeys::frame)
      .add({.name = "slides", .doc = "links that slide on the frame or on a line of another link"},
           &LinkageKeys::slides, slide_tables())
      .add({.name = "lengths", .doc = "distances known better than by the sketch, which moves to them"},
           &LinkageKeys::lengths, length_tables())
      .add({.name = "driver", .doc = "the driving link, on the shaft; default: the first one"}, &LinkageKeys::driver)
      .add({.name = "output",
            .doc = "what the loads act on: a link that slides on the frame or rocks, or a point; default: the last "
                   "link"},
           &LinkageKeys::output)
      .add(quantity("output_along", "rad", any_number,
                    "of a point as the output: the direction that its way and the loads count along; default: 0 deg"),
           &LinkageKeys::output_along)
      .add(gravity_key(), &LinkageKeys::gravity)
      .add(defaulted("sketch_angle", "rad", "0 deg", any_number, "direction of the sketch's +x above the horizontal"),
           &LinkageKeys::sketch_angle)
      .add(mounting("force on an output that slides, along its way, or a list of them", slider_loads()),
           &LinkageKeys::mounting)
      .add({.name = "torque", .doc = "torque on an output that rocks, or a list of them"}, &LinkageKeys::torques,
           rocker_loads())
      .add(linkage_force_fields(), &LinkageKeys::within);
}

// Names become indices; what is wrong goes to its place.
class SketchReader {
 public:
  SketchReader(const Reading<LinkageKeys>& keys) : k_(keys) {}

  // Empty where something was said.
  std::optional<LinkageSketch> read() {
    read_points();
    read_links();
    s_.frame_points =
        points_of(k_.frame, [&](const std::string& text) { valid_ = k_.refuse(&LinkageKeys::frame, text); });
    read_slides();
    const std::vector<LinkageSketch::Length> given = lengths();
    if (valid_) read_roles();
    if (valid_) check_use();
    if (!valid_) return {};
    s_.gravity = k_.gravity, s_.elevation = k_.sketch_angle;
    if (given.empty()) s_.rounded = 0.5 * k_.unit * last_place();
    report(take_lengths(s_, given));
    if (!valid_) return {};
    return s_;
  }

  void report(const LinkageFaults& faults) {
    for (const LinkageFault& fault : faults) {
      k_.messages().add(place_of(fault.at), fmt::format("{}: {}", k_.what(), fault.text));
      valid_ = false;
    }
  }

 private:
  template <class R>
  static Location place_in(const std::vector<R>& list, const std::string& name, Location otherwise) {
    for (const R& reading : list)
      if (reading.section().name == name) return reading.section().at;
    return otherwise;
  }
  Location place_of(const std::string& at) const {
    const std::size_t dot = at.find('.');
    const std::string key = at.substr(0, dot), name = dot == std::string::npos ? "" : at.substr(dot + 1);
    const Location whole = k_.section().where(key);
    if (key == "links") return place_in(k_.links, name, whole);
    if (key == "slides") return place_in(k_.slides, name, whole);
    if (key == "lengths") return place_in(k_.lengths, name, whole);
    return whole;
  }

  template <class Part>  // −1: none
  static int index_of(const std::vector<Part>& parts, const std::string& name) {
    const auto found = std::find_if(parts.begin(), parts.end(), [&](const Part& part) { return part.name == name; });
    return found == parts.end() ? -1 : static_cast<int>(found - parts.begin());
  }
  template <class Refuse>
  std::vector<int> points_of(const std::string& text, const Refuse& refuse) {
    std::vector<int> points;
    for (const std::string& word : words_in(text)) {
      const int p = index_of(s_.points, word);
      if (p < 0)
        refuse(fmt::format("unknown point \"{}\"{}; the sketch has {}", word, suggestion(word, names_of(s_.points)),
                           shortened_list(names_of(s_.points), "and")));
      else if (std::find(points.begin(), points.end(), p) != points.end())
        refuse(fmt::format("names the point \"{}\" twice", word));
      else
        points.push_back(p);
    }
    if (points.empty() && valid_) refuse("names no point; write e.g. \"A B\"");
    return points;
  }

  void read_points() {
    for (const Reading<PointKeys>& p : k_.points) {
      if (p.at.size() != 2) {
        valid_ = p.refuse(&PointKeys::at, fmt::format("has {} numbers; must be [x, y]", p.at.size()));
        s_.points.push_back({p.section().name, 0, 0});
        continue;
      }
      s_.points.push_back({p.section().name, p.at[0] * k_.unit, p.at[1] * k_.unit});
    }
  }
  // Of all coordinates, in the sketch's unit; 0: there is none that a person writes.
  double last_place() const {
    constexpr int most_decimals = 9;
    const auto ends = [](double value, double places) {
      const double scaled = value * places;
      return std::abs(scaled - std::round(scaled)) <= 1e-15 * std::abs(scaled);
    };
    double places = 1;
    for (int k = 0; k <= most_decimals; ++k, places *= 10)
      if (std::all_of(k_.points.begin(), k_.points.end(), [&](const Reading<PointKeys>& p) {
            return std::all_of(p.at.begin(), p.at.end(), [&](double x) { return ends(x, places); });
          }))
        return 1 / places;
    return 0;
  }
  void read_links() {
    for (const Reading<LinkKeys>& link : k_.links) {
      LinkageSketch::Link to;
      to.name = link.section().name;
      if (to.name == "frame") valid_ = link.refuse("\"frame\" is what stands still; give the link another name");
      to.points =
          points_of(link.points, [&](const std::string& text) { valid_ = link.refuse(&LinkKeys::points, text); });
      to.mass = link.mass, to.inertia = link.inertia;
      if (link.com && link.com->size() != 2)
        valid_ = link.refuse(&LinkKeys::com, fmt::format("has {} numbers; must be [x, y]", link.com->size()));
      else if (link.com)
        to.com_x = link.com->at(0) * k_.unit, to.com_y = link.com->at(1) * k_.unit;
      else
        for (const int p : to.points) {
          const LinkageSketch::Point& point = s_.points[static_cast<std::size_t>(p)];
          to.com_x += point.x / static_cast<double>(to.points.size());
          to.com_y += point.y / static_cast<double>(to.points.size());
        }
      s_.links.push_back(std::move(to));
    }
  }
  void read_slides() {
    for (const Reading<SlideKeys>& slide : k_.slides) {
      LinkageSketch::Slide to;
      to.link = index_of(s_.links, slide.section().name);
      if (to.link < 0)
        valid_ = slide.refuse(fmt::format("no link of this name{}; links are {}",
                                          suggestion(slide.section().name, names_of(s_.links)),
                                          shortened_list(names_of(s_.links), "and")));
      to.on = slide.on == "frame" ? LinkageSketch::frame : index_of(s_.links, slide.on);
      if (slide.on != "frame" && to.on < 0)
        valid_ = slide.refuse(&SlideKeys::on, fmt::format("on = \"{}\"{}; must be \"frame\" or a link: {}", slide.on,
                                                          suggestion(slide.on, names_of(s_.links)),
                                                          shortened_list(names_of(s_.links), "and")));
      to.angle = slide.along.value_or(0);
      if (slide.through) {
        const std::vector<int> two = points_of(
            *slide.through, [&](const std::string& text) { valid_ = slide.refuse(&SlideKeys::through, text); });
        if (two.size() == 2) {
          const auto &a = s_.points[static_cast<std::size_t>(two[0])], &b = s_.points[static_cast<std::size_t>(two[1])];
          to.angle = std::atan2(b.y - a.y, b.x - a.x);
        } else if (valid_) {
          valid_ = slide.refuse(&SlideKeys::through, "must name two points");
        }
      }
      s_.slides.push_back(to);
    }
  }

  // Driving link and output.
  void read_roles() {
    if (k_.driver) {
      s_.driver = index_of(s_.links, *k_.driver);
      if (s_.driver < 0)
        valid_ = k_.refuse(&LinkageKeys::driver,
                           fmt::format("driver = \"{}\"{}; must be a link: {}", *k_.driver,
                                       suggestion(*k_.driver, names_of(s_.links)), shortened_list(names_of(s_.links))));
    }
    const std::string output = k_.output.value_or(s_.links.back().name);
    LinkageSketch::Output& to = s_.output;
    to.link = index_of(s_.links, output);
    const int point = index_of(s_.points, output);
    const bool both = k_.output && to.link >= 0 && point >= 0;
    if (to.link >= 0 && !both) {
      for (const LinkageSketch::Slide& slide : s_.slides)
        if (slide.link == to.link && slide.on == LinkageSketch::frame)
          to.point = s_.links[static_cast<std::size_t>(to.link)].points.front(), to.angle = slide.angle;
      if (k_.output_along)
        valid_ =
            k_.refuse(&LinkageKeys::output_along, "belongs to a point as the output; of a link it follows from it");
    } else if (point >= 0 && !both) {
      to.point = point;
      to.angle = k_.output_along.value_or(0);
      for (std::size_t k = 0; k < s_.links.size(); ++k)
        if (s_.has(static_cast<int>(k), to.point) && (to.link < 0 || static_cast<int>(k) != s_.driver))
          to.link = static_cast<int>(k);
      if (to.link < 0)
        valid_ = k_.refuse(&LinkageKeys::output, fmt::format("the point \"{}\" is on no moving link", output));
    } else {
      std::vector<std::string> names = names_of(s_.links), points = names_of(s_.points);
      names.insert(names.end(), points.begin(), points.end());
      valid_ = k_.refuse(&LinkageKeys::output, fmt::format("output = \"{}\"{}; must be a link or a point", output,
                                                           both ? " is both" : suggestion(output, names)));
    }
    if (!valid_) return;
    if (to.rocks() && !k_.mounting.loads.empty())
      valid_ = k_.refuse(
          "load", fmt::format("load: {} turns on the frame, so that torques act on it; write torque = …, or name an "
                              "output that slides, or a point",
                              output));
    if (!to.rocks() && !k_.torques.empty())
      valid_ = k_.refuse(&LinkageKeys::torques,
                         fmt::format("torque: {} has a way, so that forces act on it; write load = …", output));
  }

  void check_use() {
    for (int p = 0; p < static_cast<int>(s_.points.size()); ++p) {
      bool used = s_.has(LinkageSketch::frame, p);
      for (std::size_t k = 0; k < s_.links.size(); ++k) used = used || s_.has(static_cast<int>(k), p);
      if (used) continue;
      const std::string& name = s_.points[static_cast<std::size_t>(p)].name;
      k_.messages().add(
          place_in(k_.points, name, k_.section().at),
          fmt::format("{}: points.{}: no link and not the frame goes through it; name it there, or leave it "
                      "out",
                      k_.what(), name));
      valid_ = false;
    }
  }

  // "AB", "A B" or "A-B".
  std::vector<LinkageSketch::Length> lengths() {
    std::vector<LinkageSketch::Length> list;
    for (const Reading<LengthKeys>& length : k_.lengths) {
      const std::string& name = length.section().name;
      LinkageSketch::Length to{-1, -1, length.length, name};
      for (std::size_t cut = 1; cut < name.size(); ++cut) {
        std::string second = name.substr(cut);
        if (second.front() == '-' || second.front() == ' ') second.erase(0, 1);
        const int a = index_of(s_.points, name.substr(0, cut)), b = index_of(s_.points, second);
        if (a >= 0 && b >= 0 && a != b) to.from = a, to.to = b;
      }
      if (to.from >= 0)
        list.push_back(to);
      else
        valid_ = length.refuse(fmt::format("is named by two points of the sketch, as AB or \"A B\"; it has {}",
                                           shortened_list(names_of(s_.points), "and")));
    }
    return list;
  }

  const Reading<LinkageKeys>& k_;
  LinkageSketch s_;
  bool valid_ = true;
};

void build_linkage(const Section& section, const Reading<LinkageKeys>& keys, Network& net) {
  std::shared_ptr<const Linkage> linkage;
  if (keys.valid()) {
    SketchReader reader(keys);
    if (const auto sketch = reader.read()) {
      linkage = std::make_shared<const Linkage>(*sketch);
      reader.report(linkage->faults());
    }
  }
  if (!linkage || !linkage->faults().empty()) {  // others may refer to its shaft
    const int node = net.add_node(section.name, "", 0);
    net.ports[section.name] = {node, node};
    return;
  }
  Mounting mounting = keys.mounting;
  std::vector<Mechanism> forces = linkage_forces(section, keys.within, linkage, mounting.phase);
  for (const Mechanism& force : forces) mounting.within.push_back({force.name, *force.data.as<LinkageTravelData>()});
  if (!mounting.joints.empty() && forces.size() > JointFriction::most_applied)
    keys.refuse(fmt::format("{} springs, forces and couples press on its joints with friction; at most {} may",
                            forces.size(), JointFriction::most_applied));
  if (linkage->sketch().output.rocks()) mounting.loads = keys.torques;
  build_mechanism(section, LinkageData{linkage, linkage->sketch().gravity}, mounting, {}, net, keys.messages());
  if (keys.valid()) put_linkage_forces(section, std::move(forces), net);
}

}  // namespace

Kind linkage_kind() {
  return kind_of<linkage_fields, build_linkage>(
      on_a_shaft, "linkage",
      "any planar linkage, described by a sketch: points, links through them, pins and slides between links; "
      "one link drives, φ is its angle from +x of the sketch. No cams and no gears within it");
}

}  // namespace kurbel
