// gear_twins_test.cpp — a machine behind an ideal gear is the machine reduced to the shaft before it: J/i², k/i², c/i²,
// M/i, iω, iφ (theory 5.3), whichever way it turns; and a mirrored machine does mirrored things. In all that runs,
// modes, steady cycles and reductions put out.
#include <numeric>
#include <set>

#include "studies/modes/modes.h"
#include "studies/reduce/reduce.h"
#include "studies/steady/steady.h"
#include "tests/support/scenes.h"
#include "tests/support/thorough.h"
#include "tests/twins/twin_gears.h"

namespace kurbel::gear_twins_test {
namespace {

using namespace test;  // NOLINT: the scenes' names

constexpr double allowed = 3e-6;  // runs at 1e-8, over the largest value; joint friction is the least exact

class Twins : public EveryScene {
 protected:
  bool skipped() const { return scene().dear && !test::thorough(); }
  // In the short form modes and reductions behind every second gear, each behind those that the other and the next scene leave.
  std::size_t first_gear(std::size_t study) const { return test::thorough() ? 0 : (GetParam() + study) % 2; }
  std::size_t gear_step() const { return test::thorough() ? 1 : 2; }
};

// Each gear's twin, and how the two differ; in steps of two every second gear, from the first or the second one on.
void for_all_gears(const TwinScene& scene,
                   const std::function<void(const std::string&, const std::string&, const TwinMap&)>& expect,
                   std::size_t first = 0, std::size_t step = 1) {
  const std::vector<IdealGear> gears = gears_of(scene);
  for (std::size_t k = first % gears.size(); k < gears.size(); k += step) {
    const IdealGear& gear = gears[k];
    SCOPED_TRACE(fmt::format("{} behind a gear of {:.3g}", scene.name, gear.ratio()));
    expect(geared(scene, gear), direct(scene, {}, gear.view()), map_of(scene, {}, gear.view()));
  }
}
void mirrored(const TwinScene& scene,
              const std::function<void(const std::string&, const std::string&, const TwinMap&)>& expect) {
  if (!scene.reversible) return;
  SCOPED_TRACE(scene.name + ", mirrored");
  const View back{1, -1};
  expect(direct(scene, {}, {}), direct(scene, back, back), map_of(scene, back, back));
}

void expect_same_runs(const std::string& first, const std::string& second, const TwinMap& map) {
  expect_same_run(run(first, false), run(second, false), map, allowed);
}

TEST_P(Twins, BehindAGearRunsAsReducedToTheShaftBefore) { for_all_gears(scene(), expect_same_runs); }
TEST_P(Twins, MirroredMachineRunsMirrored) { mirrored(scene(), expect_same_runs); }

// --- modes -----------------------------------------------------------------------------------------------------------

// The channel of a joint or, for a segment, of its shaft.
std::string torque_of(const std::string& joint) { return "torque." + joint.substr(0, joint.find(", segment ")); }

std::map<std::string, std::size_t> own_joints(const ModesStudy& m) {
  std::map<std::string, std::size_t> joints;
  for (std::size_t k = 0; k < m.joint_names.size(); ++k) joints[m.joint_names[k]] = k;
  return joints;
}

void expect_near(double a, double b, const std::string& what, double scale = 0) {
  if (std::isfinite(a) != std::isfinite(b) ||
      (std::isfinite(a) && std::abs(a - b) > 1e-7 * std::max({std::abs(a), std::abs(b), scale})))
    ADD_FAILURE() << fmt::format("{}: {:.10g}, but {:.10g}", what, a, b);
}

void expect_same_shapes(const ModesStudy& a, const ModesStudy& b) {
  ASSERT_EQ(a.modes.size(), b.modes.size());
  ASSERT_EQ(a.damped.size(), b.damped.size());
  const auto in_a = own_joints(a), in_b = own_joints(b);
  for (std::size_t k = 0; k < a.modes.size(); ++k) {
    const Mode &x = a.modes[k], &y = b.modes[k];
    const std::string mode = fmt::format("mode {}, ", k + 1);
    expect_near(x.omega, y.omega, mode + "ω", 1e-6);
    expect_near(x.lambda.real(), y.lambda.real(), mode + "Re λ", x.omega);
    expect_near(std::abs(x.lambda.imag()), std::abs(y.lambda.imag()), mode + "Im λ", x.omega);
    expect_near(x.ratio, y.ratio, mode + "ζ", 1);
    for (const auto& [name, joint] : in_a)
      expect_near(x.shares.joint[joint], y.shares.joint[in_b.at(name)], mode + "twist energy in " + name, 1);
    std::vector<double> kinetic_a = x.shares.shaft, kinetic_b = y.shares.shaft;
    std::sort(kinetic_a.begin(), kinetic_a.end());
    std::sort(kinetic_b.begin(), kinetic_b.end());
    ASSERT_EQ(kinetic_a.size(), kinetic_b.size());
    for (std::size_t i = 0; i < kinetic_a.size(); ++i)
      expect_near(kinetic_a[i], kinetic_b[i], mode + "kinetic energy", 1);
  }
  for (std::size_t k = 0; k < a.damped.size(); ++k)
    expect_near(a.damped[k].lambda.real(), b.damped[k].lambda.real(), "decay", std::abs(b.damped[k].lambda));
}

void expect_same_response(const ModesStudy& a, const ModesStudy& b, const TwinMap& map) {
  const auto in_a = own_joints(a), in_b = own_joints(b);
  double largest = 1e-9;
  for (const JointResponse& r : b.here.joints) largest = std::max(largest, std::abs(r.mean) + r.rms);
  for (const auto& [name, joint] : in_a) {
    const JointResponse &x = a.here.joints[joint], &y = b.here.joints[in_b.at(name)];
    const double torque = map.factor(torque_of(name), "N*m"), size = std::abs(torque);
    expect_near(torque * x.mean, y.mean, "mean torque of " + name, largest);
    expect_near(size * x.peak, y.peak, "peak of " + name, largest);
    expect_near(torque * (torque > 0 ? x.upper : x.lower), y.upper, "greatest torque of " + name, largest);
    expect_near(torque * (torque > 0 ? x.lower : x.upper), y.lower, "least torque of " + name, largest);
    expect_near(size * x.amplitude_sum, y.amplitude_sum, "sum of amplitudes of " + name, largest);
    expect_near(size * x.rms, y.rms, "rms of " + name, largest);
    expect_near(x.power, y.power, "power of " + name, 1e-3);
  }
  ASSERT_EQ(a.critical.size(), b.critical.size());
  for (std::size_t k = 0; k < a.critical.size(); ++k) {
    const CriticalSpeed &x = a.critical[k], &y = b.critical[k];
    expect_near(std::abs(x.speed), std::abs(y.speed), "critical speed");
    EXPECT_EQ(x.mode, y.mode);
    EXPECT_EQ(x.order, y.order);
    const std::string& joint = a.joint_names[x.joint];
    EXPECT_EQ(joint, b.joint_names[y.joint]);
    expect_near(std::abs(map.factor(torque_of(joint), "N*m")) * x.amplitude, y.amplitude, "amplitude there", largest);
  }
  ASSERT_EQ(a.zones.size(), b.zones.size());
  for (std::size_t k = 0; k < a.zones.size(); ++k) {
    expect_near(std::abs(a.zones[k].centre), std::abs(b.zones[k].centre), "zone");
    expect_near(a.zones[k].variation, b.zones[k].variation, "variation", 1);
    expect_near(a.zones[k].half_width, b.zones[k].half_width, "half width", 1);
  }
}

void expect_same_verdicts(const ModesStudy& a, const ModesStudy& b, const TwinMap& map) {
  ASSERT_EQ(a.verdicts.size(), b.verdicts.size());
  for (std::size_t k = 0; k < a.verdicts.size(); ++k) {
    const Verdict &x = a.verdicts[k], &y = b.verdicts[k];
    EXPECT_EQ(x.component, y.component);
    EXPECT_EQ(x.requirement, y.requirement);
    EXPECT_EQ(x.holds(), y.holds()) << x.component << ": " << x.requirement;
    const double factor = x.unit == "N*m" ? std::abs(map.factor(torque_of(x.component), "N*m")) : 1;
    expect_near(factor * x.value, y.value, x.component + ": " + x.requirement, 1e-3 * y.limit);
    expect_near(factor * x.limit, y.limit, x.component + ": limit of " + x.requirement);
  }
  ASSERT_EQ(a.barred.size(), b.barred.size());
  for (std::size_t k = 0; k < a.barred.size(); ++k) {
    expect_near(std::abs(a.barred[k].from), std::abs(b.barred[k].from), "barred from", 1);
    expect_near(std::abs(a.barred[k].to), std::abs(b.barred[k].to), "barred to", 1);
    EXPECT_EQ(a.barred[k].reason, b.barred[k].reason);
  }
}

// Nothing where the scene has no modes, of which both must say so.
std::optional<ModesStudy> modes_of(const std::string& text, std::string& why) {
  const Scene scene = scene_from(text);
  try {
    return find_modes(scene, scene.effects, {});
  } catch (const std::invalid_argument& error) {
    why = error.what();
    return {};
  }
}
void expect_same_modes(const std::string& first, const std::string& second, const TwinMap& map) {
  std::string why_a, why_b;
  const std::optional<ModesStudy> a = modes_of(first, why_a), b = modes_of(second, why_b);
  ASSERT_EQ(a.has_value(), b.has_value()) << why_a << why_b;
  if (!a) return;
  ASSERT_EQ(a->joint_names.size(), b->joint_names.size());
  expect_same_shapes(*a, *b);
  expect_same_response(*a, *b, map);
  expect_same_verdicts(*a, *b, map);
}

// Hunt–Crossley's law has no stiffness in N·m/rad but at a compression, which nobody knows here. What an operating
// sequence reverses is linearised and reduced as it stands without the sequence; so is a speed that is prescribed.
bool is_linear(const TwinScene& scene) { return scene.far_text.find("Hunt-Crossley") == std::string::npos; }
bool turns_by_itself(const TwinScene& scene) {
  return scene.end.find("to = -1") == std::string::npos && scene.far_text.find("prescribed speed") == std::string::npos;
}

TEST_P(Twins, BehindAGearHasTheModesOfTheReducedMachine) {
  if (is_linear(scene()) && turns_by_itself(scene()) && !skipped())
    for_all_gears(scene(), expect_same_modes, first_gear(0), gear_step());
}
TEST_P(Twins, MirroredMachineHasTheSameModes) {
  if (turns_by_itself(scene()) && !skipped()) mirrored(scene(), expect_same_modes);
}

// --- reduction -------------------------------------------------------------------------------------------------------

std::optional<MachineReduction> reduction_of(const std::string& text, std::string& why) {
  try {
    return reduce(scene_from(text), {.positions = 7, .to = {}, .speed = {}, .orders = 5});
  } catch (const std::invalid_argument& error) {
    why = error.what();
    return {};
  }
}
void expect_same_chain(const Chain& a, const Chain& b) {
  const auto total = [](const Chain& chain) {
    return std::accumulate(chain.inertias.begin(), chain.inertias.end(), 0.0,
                           [](double sum, const ChainInertia& i) { return sum + i.reduced; });
  };
  expect_near(total(a), total(b), "inertia of the chain");
  // By name, and the pieces of one shaft by damping: their order is that of the walk along the tree.
  const auto sorted = [](std::vector<ChainSpring> springs) {
    std::sort(springs.begin(), springs.end(), [](const ChainSpring& x, const ChainSpring& y) {
      return std::pair(x.name, x.reduced_damping) < std::pair(y.name, y.reduced_damping);
    });
    return springs;
  };
  const std::vector<ChainSpring> in_a = sorted(a.springs), in_b = sorted(b.springs);
  ASSERT_EQ(in_a.size(), in_b.size());
  for (std::size_t k = 0; k < in_a.size(); ++k) {
    EXPECT_EQ(in_a[k].name, in_b[k].name);
    expect_near(in_a[k].reduced_stiffness, in_b[k].reduced_stiffness, "stiffness of " + in_a[k].name + " on the link");
    expect_near(in_a[k].reduced_damping, in_b[k].reduced_damping, "damping of " + in_a[k].name + " on the link");
  }
}
void expect_same_reductions(const std::string& first, const std::string& second, const TwinMap&) {
  std::string why_a, why_b;
  const std::optional<MachineReduction> a = reduction_of(first, why_a), b = reduction_of(second, why_b);
  ASSERT_EQ(a.has_value(), b.has_value()) << why_a << why_b;
  if (!a) return;
  EXPECT_EQ(a->link, b->link);
  expect_near(a->cycle, b->cycle, "cycle");
  expect_near(a->speed, b->speed, "speed");
  ASSERT_EQ(a->positions.size(), b->positions.size());
  double torque = 1e-6;
  for (const ReducedPosition& p : b->positions) torque = std::max({torque, std::abs(p.drive), std::abs(p.load)});
  for (std::size_t k = 0; k < a->positions.size(); ++k) {
    const ReducedPosition &x = a->positions[k], &y = b->positions[k];
    const std::string where = fmt::format(" at position {}", k);
    expect_near(x.inertia, y.inertia, "inertia" + where);
    expect_near(x.slope, y.slope, "slope of the inertia" + where, y.inertia);
    expect_near(x.drive, y.drive, "driving torque" + where, torque);
    expect_near(x.load, y.load, "load" + where, torque);
  }
  ASSERT_EQ(a->spectra.size(), b->spectra.size());
  expect_near(a->mean_drive.value, b->mean_drive.value, "mean driving torque", torque);
  expect_near(a->mean_load.value, b->mean_load.value, "mean load", torque);
  expect_same_chain(a->chain, b->chain);
}

TEST_P(Twins, BehindAGearReducesToTheSameInertiaAndTorques) {
  if (is_linear(scene()) && turns_by_itself(scene()) && !skipped())
    for_all_gears(scene(), expect_same_reductions, first_gear(1), gear_step());
}

// --- steady cycle ----------------------------------------------------------------------------------------------------

void expect_same_cycles(const std::string& first, const std::string& second, const TwinMap& map) {
  const auto study = [](const std::string& text) {
    const Scene scene = scene_from(text);
    return steady(scene, {scene.effects}, {.start_search = false});
  };
  const SteadyStudy one = study(first), other = study(second);
  ASSERT_EQ(one.cycles.size(), other.cycles.size());
  for (std::size_t c = 0; c < one.cycles.size(); ++c) {
    const SteadyCycle &a = one.cycles[c], &b = other.cycles[c];
    ASSERT_TRUE(a.found && b.found) << a.why << b.why;
    const auto without_shafts = [](std::vector<Figure> figures) {  // δ of shafts: named by shafts, below
      std::erase_if(figures, [](const Figure& f) { return f.name.starts_with("delta."); });
      return figures;
    };
    expect_same_figures(without_shafts(a.figures), without_shafts(b.figures), map, 1e-6);
    for (const ShaftFluctuation& x : a.shafts)
      for (const ShaftFluctuation& y : b.shafts)
        if (x.shaft == y.shaft) expect_near(x.delta().value_or(NAN), y.delta().value_or(NAN), "δ of " + x.shaft, 1);
    ASSERT_EQ(a.motors.size(), b.motors.size());
    for (std::size_t k = 0; k < a.motors.size(); ++k) {
      const double torque = map.factor("torque." + a.motors[k].component, "N*m");
      EXPECT_NEAR(torque * a.motors[k].mean, b.motors[k].mean, 1e-5 * b.motors[k].rms);
      EXPECT_NEAR(std::abs(torque) * a.motors[k].rms, b.motors[k].rms, 1e-5 * b.motors[k].rms);
    }
    expect_near(a.point.largest(), b.point.largest(), "largest multiplier", 1e4);
  }
}

// Where a mechanism, an engine or a joint makes a cycle.
TEST(SteadyTwins, BehindAGearTheCycleIsThatOfTheReducedMachine) {
  const std::set<std::string> cyclic = {"pump by tables over travel and angle", "compressor", "four-bar linkage",
                                        "two-stroke engine by its torque"};
  for (TwinScene scene : twin_scenes()) {
    if (!cyclic.count(scene.name)) continue;
    scene.reversible = false;  // the mechanism would run the other way, and its direction of start would be needed
    for_all_gears(scene, expect_same_cycles);
  }
}
TEST(SteadyTwins, MirroredMachineHasTheMirroredCycle) {
  const std::set<std::string> cyclic = {"press without edges", "universal joint"};
  for (const TwinScene& scene : twin_scenes())
    if (cyclic.count(scene.name)) mirrored(scene, expect_same_cycles);
}

INSTANTIATE_TEST_SUITE_P(All, Twins, ::testing::Range<std::size_t>(0, twin_scenes().size()), name_of_twin);

// --- what they cover -------------------------------------------------------------------------------------------------

void note_kinds(const Section& section, std::set<std::string>& kinds) {
  kinds.insert(section.kind->name);
  for (const Setting& setting : section.settings)
    for (const Section& nested : setting.sections) note_kinds(nested, kinds);
}

TEST(TwinScenes, HoldEveryKindOfComponent) {
  std::set<std::string> seen;
  for (const TwinScene& scene : twin_scenes())
    for (const Section& section : scene_from(geared(scene, twin_gears()[0])).components) note_kinds(section, seen);
  for (const Kind& kind : all_kinds()) EXPECT_TRUE(seen.count(kind.name)) << "no twins of kind " << kind.name;
}

}  // namespace
}  // namespace kurbel::gear_twins_test
