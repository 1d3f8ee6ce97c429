// linkage_force_keys.cpp — from the keys of springs, forces and couples to elements that act along travels.
#include "mechanisms/kinds/linkage_force_keys.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <set>
#include <sstream>
#include <utility>

#include "engine/numerics/deadline.h"
#include "mechanisms/kinds/mechanism_keys.h"
#include "mechanisms/linkage/travel.h"

namespace kurbel {

std::vector<std::string> words_in(const std::string& text) {
  std::istringstream in(text);
  return {std::istream_iterator<std::string>(in), {}};
}
namespace {

const Tables<Reading<SpringKeys>>& spring_tables() {
  static const auto made = by_names(
      "spring", "A linear spring between two points, a damper, or both side by side",
      Fields<SpringKeys>()
          .add(
              {.name = "between",
               .doc = "two points, each of a link or of the frame; of a pin it acts on the first link there is through "
                      "it, or on the one named before it: \"rod A barrel C\"",
               .required = true},
              &SpringKeys::between)
          .add(defaulted("stiffness", "N/m", "0 N/m", not_negative, "k"), &SpringKeys::stiffness)
          .add(defaulted("preload", "N", "0 N", any_number, "tension at free_length; negative: it pushes there"),
               &SpringKeys::preload)
          .add(quantity("free_length", "m", not_negative,
                        "length from which k counts, the pull is preload + k (length − free_length); default: the "
                        "distance in the sketch"),
               &SpringKeys::free_length)
          .add(defaulted("damping", "N*s/m", "0 N*s/m", not_negative, "of a damper beside the spring"),
               &SpringKeys::damping)
          .check([](const Reading<SpringKeys>& s) {
            if (s.stiffness == 0 && s.preload == 0 && s.damping == 0)
              s.refuse("is no spring and no damper; give a stiffness, a preload or a damping");
          }));
  return made;
}

const Tables<Reading<PointForceKeys>>& force_tables() {
  static const auto made = by_names(
      "force", "A force between two points along their line, or on a point",
      Fields<PointForceKeys>()
          .add(
              {.name = "between",
               .doc = "two points, of a pin with the link before it: \"rod A barrel C\"; without a link it acts on the "
                      "first one through the pin, on the frame at its points. The load's laws count their distance, a "
                      "positive force pushes them apart"},
              &PointForceKeys::between)
          .add({.name = "on",
                .doc = "a point of a link; of a pin the link before it says on which it acts: \"rocker B\""},
               &PointForceKeys::on)
          .add(quantity("along", "rad", any_number,
                        "of a force on a point: its direction in the sketch, which stands; the load's laws count the "
                        "point's way along it. Without: along the point's path, for the resistance of a medium"),
               &PointForceKeys::along)
          .add({.name = "load", .doc = "its law, or a list of them", .required = true}, &PointForceKeys::loads,
               slider_loads())
          .check([](const Reading<PointForceKeys>& f) {
            if (f.between.has_value() == f.on.has_value())
              f.refuse("say where it acts, either between = \"A B\" or on = \"A\"");
            else if (f.between && f.along)
              f.refuse(&PointForceKeys::along, "belongs to a force on a point; between two it acts along their line");
          }));
  return made;
}

const Tables<Reading<CoupleKeys>>& couple_tables() {
  static const auto made = by_names(
      "couple", "A torque between two links, or between the frame and a link: torsion spring, damper, any law",
      Fields<CoupleKeys>()
          .add({.name = "between",
                .doc = "two links, or frame and a link: \"frame rocker\"; angles count how far the second has turned "
                       "against the first, 0 in the sketch",
                .required = true},
               &CoupleKeys::between)
          .add(defaulted("stiffness", "N*m/rad", "0 N*m/rad", not_negative, "of a torsion spring"),
               &CoupleKeys::stiffness)
          .add(defaulted("free_angle", "rad", "0 deg", any_number, "from which the stiffness counts"),
               &CoupleKeys::free_angle)
          .add(defaulted("preload", "N*m", "0 N*m", any_number, "torque at free_angle, positive against the rotation"),
               &CoupleKeys::preload)
          .add(defaulted("damping", "N*m*s/rad", "0 N*m*s/rad", not_negative, "of a damper beside the spring"),
               &CoupleKeys::damping)
          .add({.name = "torque", .doc = "a further law, or a list of them"}, &CoupleKeys::torques, rocker_loads())
          .check([](const Reading<CoupleKeys>& c) {
            if (c.stiffness == 0 && c.preload == 0 && c.damping == 0 && c.torques.empty())
              c.refuse("has no torque; give a stiffness, a preload, a damping or a torque");
          }));
  return made;
}

class LinkageForceBuilder {
 public:
  LinkageForceBuilder(const Section& section, std::shared_ptr<const Linkage> linkage, double phase)
      : section_(section), linkage_(std::move(linkage)), s_(linkage_->sketch()), phase_(phase) {}

  std::vector<Mechanism> made;

  void add(const Reading<SpringKeys>& k) {
    const auto travel = between(k, &SpringKeys::between, k.between);
    if (!travel || !is_named_well(k)) return;
    const auto laws = [&](Mechanism& m) {
      const double drawn = m.reduced->output_position(static_cast<double>(linkage_->drawn_at())).value;
      add_spring(m, k.stiffness, k.free_length.value_or(drawn), k.preload, k.damping);
      return true;
    };
    put(k, &SpringKeys::between, *travel, laws);
  }
  void add(const Reading<PointForceKeys>& k) {
    LinkageTravel travel;
    if (k.between) {
      const auto two = between(k, &PointForceKeys::between, *k.between);
      if (!two) return;
      travel = *two;
    } else {
      const auto place = place_on(k);
      if (!place) return;
      travel = {k.along ? LinkageTravel::Of::way : LinkageTravel::Of::path, {}, *place, k.along.value_or(0)};
      const auto resists = [](const LoadReading& load) {
        return std::holds_alternative<Reading<LoadKeys<MediumResistance>>>(load);
      };
      if (!k.along && !std::all_of(k.loads.begin(), k.loads.end(), resists))
        return void(
            k.refuse("without along a force resists the motion along the point's path, as kind = \"medium\" does; give "
                     "along for other laws"));
    }
    if (!is_named_well(k)) return;
    put(k, k.between ? &PointForceKeys::between : &PointForceKeys::on, travel,
        [&](Mechanism& m) { return put_further(k.loads, m); });
  }
  void add(const Reading<CoupleKeys>& k) {
    const std::vector<std::string> two = words_in(k.between);
    if (two.size() != 2) return void(k.refuse(&CoupleKeys::between, "must name two links, or frame and a link"));
    LinkageTravel travel{LinkageTravel::Of::rotation, {}, {}, 0};
    for (const auto& [name, place] : {std::pair{two[0], &travel.from}, std::pair{two[1], &travel.to}}) {
      const auto link = std::find_if(s_.links.begin(), s_.links.end(), [&](const auto& l) { return l.name == name; });
      if (link == s_.links.end() && name != "frame")
        return void(k.refuse(&CoupleKeys::between, fmt::format("unknown link \"{}\"{}; links are frame, {}", name,
                                                               suggestion(name, names_of(s_.links)),
                                                               shortened_list(names_of(s_.links), "and"))));
      if (link != s_.links.end()) place->body = static_cast<int>(link - s_.links.begin());
    }
    if (travel.from.body == travel.to.body)
      return void(k.refuse(&CoupleKeys::between, "names one body twice; a couple acts between two"));
    if (!is_named_well(k)) return;
    const auto laws = [&](Mechanism& m) {
      if (m.travel.winding != 0 && k.stiffness > 0)
        return k.refuse(
            &CoupleKeys::stiffness,
            fmt::format("{} makes full turns relative to {}, and a spring between them would be wound up without end",
                        two[1], two[0]));
      // Of the sketch 0; the table may count whole turns more.
      const double drawn = m.reduced->output_position(static_cast<double>(linkage_->drawn_at())).value;
      add_spring(m, k.stiffness, k.free_angle + drawn, k.preload, k.damping);
      return put_further(k.torques, m);
    };
    put(k, &CoupleKeys::between, travel, laws);
  }

 private:
  template <class List>
  static bool named(const List& list, const std::string& name) {
    return std::any_of(list.begin(), list.end(), [&](const auto& one) { return one.name == name; });
  }

  // On the frame it stands; else the first link has it, or the one that is named.
  std::optional<LinkageTravel::Place> place_of(const std::string& name, const std::string& link,
                                               std::string& fault) const {
    for (int p = 0; p < static_cast<int>(s_.points.size()); ++p) {
      if (s_.points[static_cast<std::size_t>(p)].name != name) continue;
      std::vector<std::string> bodies;
      for (int body = LinkageSketch::frame; body < static_cast<int>(s_.links.size()); ++body) {
        if (!s_.has(body, p)) continue;
        if (link.empty() || s_.name_of(body) == link) return LinkageTravel::Place{body, p};
        bodies.push_back(s_.name_of(body));
      }
      fault = not_through(name, link, bodies);
      return {};
    }
    fault = fmt::format("unknown point \"{}\"{}; the sketch has {}", name, suggestion(name, names_of(s_.points)),
                        shortened_list(names_of(s_.points), "and"));
    return {};
  }
  static std::string not_through(const std::string& point, const std::string& link,
                                 const std::vector<std::string>& bodies) {
    return fmt::format("the point {} is not on \"{}\"; links through it are {}", point, link,
                       shortened_list(bodies, "and"));
  }
  // "B", or of a pin the link that it acts on, too: "rocker B". Along a path a link that guides the pin comes first: with it
  // the sense of the motion is known.
  std::optional<LinkageTravel::Place> place_on(const Reading<PointForceKeys>& k) const {
    const auto& on = &PointForceKeys::on;
    const std::vector<std::string> parts = words_in(*k.on);
    if (parts.empty() || parts.size() > 2) {
      k.refuse(on, "must name one point, of a pin with the link before it: \"B\" or \"rocker B\"");
      return {};
    }
    std::string fault;
    auto place = place_of(parts.back(), "", fault);
    if (!place) {
      k.refuse(on, fault);
      return {};
    }
    if (place->body == LinkageSketch::frame) {
      k.refuse(on, fmt::format("the point {} stands still; name one of a moving link", parts.back()));
      return {};
    }
    std::vector<std::string> links;
    for (int link = static_cast<int>(s_.links.size()); link-- > 0;) {
      if (!s_.has(link, place->point)) continue;
      links.push_back(s_.name_of(link));
      const PathGuide guide = path_guide(*linkage_, {LinkageTravel::Of::path, {}, {link, place->point}, 0});
      if (parts.size() == 2 ? links.back() == parts[0] : !k.along && (guide.bearing || guide.direction))
        place->body = link;
    }
    if (parts.size() == 1 || s_.name_of(place->body) == parts[0]) return place;
    k.refuse(on, not_through(parts[1], parts[0], links));
    return {};
  }
  template <class K, class M>
  std::optional<LinkageTravel> between(const K& k, M member, const std::string& text) const {
    std::string fault;
    const std::optional<LinkageTravel> travel = between(text, fault);
    if (!travel) k.refuse(member, fault);
    return travel;
  }
  std::optional<LinkageTravel> between(const std::string& text, std::string& fault) const {
    std::vector<std::string> two, links;
    for (const std::string& word : words_in(text)) {
      const bool is_link = links.size() == two.size() && named(s_.links, word) && !named(s_.points, word);
      if (links.size() == two.size()) links.emplace_back();
      (is_link ? links.back() : two.emplace_back()) = word;
    }
    fault = "must name two points, of a pin with the link before it: \"A C\" or \"rod A barrel C\"";
    if (two.size() != 2 || links.size() != 2 || two[0] == two[1]) return {};
    const auto from = place_of(two[0], links[0], fault);
    const auto to = from ? place_of(two[1], links[1], fault) : std::nullopt;
    if (!to) return {};
    for (int body = LinkageSketch::frame; body < static_cast<int>(s_.links.size()); ++body)
      if (s_.has(body, from->point) && s_.has(body, to->point)) {
        fault = fmt::format("{} and {} keep their distance on the {}; name points of different links", two[0], two[1],
                            s_.name_of(body));
        return {};
      }
    return LinkageTravel{LinkageTravel::Of::distance, *from, *to, 0};
  }

  // Accounts and channels go by the name.
  template <class K>
  bool is_named_well(const K& k) {
    const std::string fault = fault_of_name(k.section().name);
    return fault.empty() || k.refuse(fault);
  }
  std::string fault_of_name(const std::string& name) {
    if (name.starts_with("load") || name == "joints")
      return fmt::format("\"{}\" is what the linkage's own loads and joints go by; give it another name", name);
    if (!taken_.insert(name).second)
      return fmt::format("the name \"{}\" is given twice among springs, forces and couples", name);
    return {};
  }

  static void add_spring(Mechanism& m, double stiffness, double free, double preload, double damping) {
    const double most = std::max(std::abs(m.travel.greatest - free), std::abs(m.travel.least - free));
    if (stiffness != 0 || preload != 0)
      m.loads.push_back(
          {SpringForce{stiffness, free, preload, std::abs(preload) + stiffness * most}, m.name, Account::weight});
    if (damping > 0) m.loads.push_back({MediumResistance{damping, 0}, m.name + ".damping", Account::harmful});
  }
  // False where something was wrong.
  static bool put_further(const std::vector<LoadReading>& loads, Mechanism& m) {
    const std::size_t before = m.loads.size();
    put_loads(loads, m);
    return m.loads.size() >= before + loads.size();
  }

  template <class K, class M, class Laws>
  void put(const K& k, M member, const LinkageTravel& travel, const Laws& laws) {
    if constexpr (has_bodies)  // an exported component's scene was examined before
      if (const std::string fault = fault_of(*linkage_, travel); !fault.empty()) return void(k.refuse(member, fault));
    std::string fault;
    std::optional<Mechanism> mechanism = tabulated(k.section().name, travel, fault);
    if (mechanism && !laws(*mechanism)) return;
    const auto over_travel = [](const SliderLoad& load) { return load.has_pieces() && load.period() == 0; };
    if (mechanism && mechanism->stands_still() &&
        std::any_of(mechanism->loads.begin(), mechanism->loads.end(), over_travel))
      fault = "its travel is constant, so that a law over it has only one value; give that as kind = \"constant\"";
    if (mechanism && mechanism->loads.empty()) fault = "has no law; give it one, or leave it out";
    if (!fault.empty()) return void(k.refuse(fault));
    made.push_back(std::move(*mechanism));
  }
  std::optional<Mechanism> tabulated(const std::string& own, const LinkageTravel& travel, std::string& fault) const {
    std::optional<Mechanism> mechanism;
    try {
      mechanism.emplace(section_.name + "." + own, LinkageTravelData{linkage_, travel});
      mechanism->phase = phase_;
    } catch (const OutOfTime&) {
      throw;
    } catch (const std::exception& error) {
      fault = fmt::format("cannot be tabulated: {}", error.what());
    }
    return mechanism;
  }

  const Section& section_;
  std::shared_ptr<const Linkage> linkage_;
  const LinkageSketch& s_;
  double phase_;
  std::set<std::string> taken_;
};

}  // namespace

Fields<LinkageForceKeys> linkage_force_fields() {
  return Fields<LinkageForceKeys>()
      .add({.name = "springs", .doc = "springs and dampers between points, each under a name of its own"},
           &LinkageForceKeys::springs, spring_tables())
      .add({.name = "forces", .doc = "forces on points or between two, each under a name of its own"},
           &LinkageForceKeys::forces, force_tables())
      .add({.name = "couples", .doc = "torques between two links, each under a name of its own"},
           &LinkageForceKeys::couples, couple_tables());
}

std::vector<Mechanism> linkage_forces(const Section& section, const LinkageForceKeys& keys,
                                      const std::shared_ptr<const Linkage>& linkage, double phase) {
  LinkageForceBuilder builder(section, linkage, phase);
  for (const auto& spring : keys.springs) builder.add(spring);
  for (const auto& force : keys.forces) builder.add(force);
  for (const auto& couple : keys.couples) builder.add(couple);
  return std::move(builder.made);
}

void put_linkage_forces(const Section& section, std::vector<Mechanism> forces, Network& net) {
  const int node = net.ports.at(section.name).in;
  for (Mechanism& force : forces) {
    limit_loads(force, section.name, node, net);
    const std::string name = force.name;
    const double phase = force.phase;
    net.put(node, name, std::make_shared<MechanismElement>(std::move(force)), {}, phase);
  }
}

}  // namespace kurbel
