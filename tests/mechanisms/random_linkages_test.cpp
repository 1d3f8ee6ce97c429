// random_linkages_test.cpp — random linkages of up to three dyads: closures, both extractions, reactions of both, energy, the
// free body of every link. 500 of them.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <string>

#include "mechanisms/reduced/newton_euler.h"
#include "mechanisms/reduced/reduced_mechanism.h"
#include "tests/mechanisms/linkage_checks.h"
#include "tests/mechanisms/linkage_examples.h"
#include "tests/mechanisms/simbody_reactions.h"
#include "tests/support/thorough.h"

namespace kurbel::random_linkages_test {
namespace {

using std::numbers::pi;
using test::SketchOf;

// Up to three dyads behind a crank, each on points of links that stand already; masses anywhere.
SketchOf random_linkage(std::mt19937& random) {
  const auto uniform = [&](double from, double to) { return std::uniform_real_distribution<double>(from, to)(random); };
  SketchOf of;
  const double phi = uniform(0, 2 * pi), r = uniform(0.05, 0.12);
  of.point('O', 0, 0).point('A', r * std::cos(phi), r * std::sin(phi)).frame("O");
  of.link("crank", "OA", uniform(0, 3), 0.01);
  std::string free = "A";  // points of moving links that a dyad may begin at
  char next = 'B';
  const int dyads = 1 + static_cast<int>(uniform(0, 2.999));
  for (int i = 0; i < dyads; ++i) {
    const char from = free[static_cast<std::size_t>(uniform(0, static_cast<double>(free.size()) - 1e-9))];
    const auto& p =
        *std::find_if(of.s.points.begin(), of.s.points.end(), [&](const auto& q) { return q.name[0] == from; });
    const double x = p.x, y = p.y;
    const char inner = next++, outer = next++, extra = next++;
    const std::string a = "a" + std::to_string(i), b = "b" + std::to_string(i);
    of.point(inner, x + uniform(0.25, 0.5), y + uniform(-0.3, 0.3));
    const double ix = of.s.points.back().x, iy = of.s.points.back().y;
    of.point(extra, x + uniform(0.1, 0.4), y + uniform(-0.4, 0.4));
    of.link(a, std::string(1, from) + inner + extra, uniform(0.2, 5), uniform(0.001, 0.1));
    const int form = static_cast<int>(uniform(0, 2.999));
    if (form == 0) {  // RRR
      of.point(outer, ix + uniform(-0.1, 0.2), iy - uniform(0.25, 0.5));
      of.s.frame_points.push_back(static_cast<int>(of.s.points.size()) - 1);
      of.link(b, std::string(1, outer) + inner, uniform(0.2, 5), uniform(0.001, 0.1));
      of.rocks(b);
    } else if (form == 1) {  // RRP
      of.link(b, std::string(1, inner), uniform(0.2, 5));
      const double angle = uniform(-0.5, 0.5);
      of.slide(b, angle).moves(b, inner, angle);
    } else {  // RPR: the link from the inner point slides in one that turns on the frame
      of.s.links.pop_back();
      of.point(outer, ix + uniform(0.1, 0.3), iy + uniform(-0.2, 0.2));
      of.s.frame_points.push_back(static_cast<int>(of.s.points.size()) - 1);
      of.link(a, std::string(1, from) + inner + extra, uniform(0.2, 5), uniform(0.001, 0.1));
      of.link(b, std::string(1, outer) + next, 1);
      of.s.links.pop_back();
      of.point(next, ix, iy + 0.3);
      of.link(b, std::string(1, outer) + next++, uniform(0.2, 5), uniform(0.001, 0.1));
      of.slide(a, std::atan2(of.s.points[of.s.points.size() - 2].y - y, of.s.points[of.s.points.size() - 2].x - x), b);
      of.rocks(b);
    }
    free += inner, free += extra;
  }
  of.s.gravity = 9.81, of.s.elevation = uniform(-3, 3);
  return of;
}

bool is_clear(const Linkage& l) {
  const double sine = std::sin(10 * pi / 180);
  return std::all_of(l.least_margins().begin(), l.least_margins().end(),
                     [&](const LeastMargin& m) { return m.margin > sine * sine; });
}

double largest_in(const LinkageForces& f) {
  double largest = 0;
  for (const JointForces& j : f.joints) largest = std::max(largest, j.force.magnitude());
  return largest;
}

// What acts on each link by the answer, summed anew: forces, and moments about the crank's bearing.
void expect_free_bodies(const LinkageData& data, const PlanarLinkage& l, const LinkageForces& f) {
  const double largest = largest_in(f);
  for (std::size_t i = 0; i < f.links.size(); ++i) {
    const LinkForces& link = f.links[i];
    double x = link.inertia_force.x, y = link.inertia_force.y;
    double moment = link.com.x * y - link.com.y * x + link.inertia_couple;
    double size = 0;
    const auto act = [&](Force2 at, double fx, double fy, double couple) {
      x += fx, y += fy, moment += at.x * fy - at.y * fx + couple;
      size = std::max(size, at.magnitude());
    };
    const double weight = l.bodies[i].mass * data.gravity;
    act(link.com, -weight * std::sin(l.elevation), -weight * std::cos(l.elevation), 0);
    if (i + 1 == f.links.size() && !l.rocks)
      act({double(l.load_at.x.value()), double(l.load_at.y.value())}, f.state.load, 0, 0);
    if (i + 1 == f.links.size() && l.rocks) moment += f.state.load;
    if (i == 0) moment += f.torque;
    for (const JointForces& j : f.joints) {
      if (std::string(j.on) == link.name) act(j.at, j.force.x, j.force.y, j.moment);
      if (std::string(j.from) == link.name) act(j.at, -j.force.x, -j.force.y, -j.moment);
    }
    EXPECT_LE(std::hypot(x, y), 1e-12 * largest) << link.name;
    EXPECT_LE(std::abs(moment), 1e-12 * largest * std::max(size, 0.1)) << link.name;
  }
}

// Simbody's mobilizers carry what the links' equilibrium says.
void expect_reactions(const LinkageData& data, const LinkageState& state, double within) {
  const PlanarLinkage l = linkage_of(data, state.phi);
  const LinkageForces f = forces_in(l, state);
  expect_free_bodies(data, l, f);
  const BodiesOf bodies = MechanismData(data).bodies_of();
  const MechanismReactions simbody = simbody_reactions(bodies, state.phi, state.omega, state.alpha, state.load);
  const std::vector<BodyInTree> tree = tree_of(bodies);
  ASSERT_EQ(simbody.on.size(), tree.size());
  const double largest = largest_in(f);
  for (std::size_t k = 0; k < tree.size(); ++k) {
    const JointForces& j = f.joints[static_cast<std::size_t>(tree[k].joint)];
    const double sense = std::string(j.on) == l.bodies[static_cast<std::size_t>(tree[k].body)].name ? 1 : -1;
    EXPECT_LE(std::abs(sense * j.force.x - simbody.on[k].x), within * largest) << j.name;
    EXPECT_LE(std::abs(sense * j.force.y - simbody.on[k].y), within * largest) << j.name;
  }
  EXPECT_LE(std::abs(f.torque - simbody.torque), within * largest);
}

TEST(RandomLinkages, BothExtractionsAgreeInMotionAndReactions) {
  constexpr int wanted = 500;
  std::mt19937 random(46);
  int good = 0, refused = 0;
  for (int tried = 0; good < wanted && tried < 60 * wanted; ++tried) {
    const LinkageData data = random_linkage(random).data();
    const Linkage& l = *data.linkage;
    if (!l.faults().empty()) {
      ++refused;
      continue;
    }
    if (l.arc()) continue;
    SCOPED_TRACE(l.structure_in_words());
    test::expect_rigid(data);
    if (!is_clear(l)) continue;
    ++good;
    test::expect_both_extractions(data, 1e-12, 24);
    const auto bodies = make_bodies(data);
    for (int i = 0; i < 6; ++i) {
      const double phi = 2 * pi * (i + 0.31) / 6, inertia = closed_sample(data, phi).inertia;
      EXPECT_NEAR(bodies->kinetic_energy(phi, 7), 24.5 * inertia, 1e-12 * 24.5 * inertia);
      expect_reactions(data, {phi, 7, -30, 150}, 1e-12);
    }
  }
  EXPECT_EQ(good, wanted) << refused << " refused";
}

// Nearer to dead positions the tables of the two differ by no more than what the second states as its error.
TEST(RandomLinkages, NearDeadPositionsTheTablesKeepTheirStatedErrors) {
  const int wanted = test::thorough() ? 40 : 3;
  std::mt19937 random(64);
  for (int good = 0, tried = 0; good < wanted && tried < 600 * wanted; ++tried) {
    const LinkageData data = random_linkage(random).data();
    if (!data.linkage->faults().empty() || data.linkage->arc() || is_clear(*data.linkage)) continue;
    ++good;
    SCOPED_TRACE(data.linkage->structure_in_words());
    const ReducedMechanism first = extract_mechanism(data),
                           second = extract_mechanism(data, table_tolerance, table_max_pieces, Extraction::second);
    ASSERT_EQ(second.report().channels.size(), std::size_t(test::sample_channels));
    double scale[test::sample_channels] = {}, off[test::sample_channels] = {};
    for (int i = 0; i < 500; ++i) {
      const double phi = 2 * pi * (i + 0.123) / 500;
      const auto a = first.at(phi), b = second.at(phi);
      for (int c = 0; c < test::sample_channels; ++c) {
        const auto channel = static_cast<ReducedMechanism::Channel>(c);
        scale[c] = std::max(scale[c], std::abs(a.value(channel)));
        off[c] = std::max(off[c], std::abs(a.value(channel) - b.value(channel)));
      }
    }
    for (int c = 0; c < test::sample_channels; ++c)
      EXPECT_LE(off[c],
                (4 * second.report().channels[static_cast<std::size_t>(c)].error + 2 * table_tolerance) * scale[c])
          << second.report().channels[static_cast<std::size_t>(c)].name;
  }
}

}  // namespace
}  // namespace kurbel::random_linkages_test
