// force_polygons.cpp — forces on a link, one behind the other.
#include "studies/worksheet/force_polygons.h"

#include <fmt/format.h>

#include <cmath>
#include <string_view>

namespace kurbel {

std::string reaction_symbol(const LinkageForces& f, const std::string& from, const std::string& on) {
  const auto number = [&](const std::string& body) {
    for (std::size_t i = 0; i < f.links.size(); ++i)
      if (body == f.links[i].name) return i + 1;
    return std::size_t{0};
  };
  return fmt::format("R_{}{}", number(from), number(on));
}

std::vector<VectorPlan> force_polygons(const LinkageForces& f, const PlanarLinkage& l, const std::string& label) {
  std::vector<VectorPlan> plans;
  const Force2 down = {-std::sin(l.elevation), -std::cos(l.elevation)};
  for (std::size_t i = 0; i < f.links.size(); ++i) {
    const std::string number = std::to_string(i + 1);
    VectorPlan plan{.title = fmt::format("{}: {} {}", label, number, f.links[i].name)};
    Force2 end;
    const auto add = [&](const std::string& name, Force2 force, Pen pen) {
      if (force.magnitude() == 0) return;
      const Force2 begin = end;
      end = begin + force;
      plan.arrows.push_back({name, {begin.x, begin.y}, {end.x, end.y}, pen});
    };
    if (i + 1 == f.links.size() && !l.rocks) add("F", {f.state.load, 0}, Pen::load);
    for (const AppliedForce& a : f.state.applied)
      if (a.body == static_cast<int>(i)) add("F_a" + number, a.force, Pen::load);
    add("G_" + number, l.bodies[i].mass * l.gravity * down, Pen::drive);
    add("F_" + number, f.links[i].inertia_force, Pen::accent);
    for (const JointForces& j : f.joints) {
      const bool on = j.on == std::string_view(f.links[i].name), from = j.from == std::string_view(f.links[i].name);
      if (!on && !from) continue;
      const std::string symbol = on ? reaction_symbol(f, j.from, j.on) : reaction_symbol(f, j.on, j.from);
      const double sense = on ? 1 : -1;
      add(symbol, sense * j.force, Pen::main);
      if (j.slides)
        add("T" + symbol.substr(1), sense * j.friction * Force2{std::cos(j.along), std::sin(j.along)}, Pen::edge);
    }
    plans.push_back(std::move(plan));
  }
  return plans;
}

}  // namespace kurbel
