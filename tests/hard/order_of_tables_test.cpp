// order_of_tables_test.cpp — what must not change a single bit of a result: the order of the tables in the file, and
// parameters of effects that are off.
#include <fmt/format.h>

#include <bit>
#include <cstdint>
#include <random>

#include "tests/published/published.h"

namespace kurbel::order_of_tables_test {
namespace {

using test::project_text;
using test::run;
using test::with;

// A scene's text cut at its table headers; the first piece is what stands above them.
std::vector<std::string> tables_of(const std::string& text) {
  std::vector<std::string> tables(1);
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("[")) tables.emplace_back();
    tables.back() += line + "\n";
  }
  return tables;
}

std::string shuffled(const std::string& text, unsigned seed) {
  std::vector<std::string> tables = tables_of(text);
  std::mt19937 random(seed);
  for (std::size_t i = tables.size() - 1; i > 1; --i) std::swap(tables[i], tables[1 + random() % i]);
  std::string out;
  for (const std::string& table : tables) out += table;
  return out;
}

void expect_same_bits(double a, double b, const std::string& what) {
  EXPECT_EQ(std::bit_cast<std::uint64_t>(a), std::bit_cast<std::uint64_t>(b)) << what << ": " << a << " and " << b;
}

// Every figure with its error, every value of every channel that both have, every event.
void expect_same_bits(const Result& a, const Result& b) {
  ASSERT_TRUE(a.complete) << a.diagnosis;
  ASSERT_TRUE(b.complete) << b.diagnosis;
  for (const Figure& f : a.figures) {
    const Figure* other = b.find(f.name);
    if (!other) continue;
    expect_same_bits(f.value, other->value, f.name);
    // A part of what is typical of all figures belongs to each error: it is the same for the same list.
    if (a.figures.size() == b.figures.size() && f.error && other->error)
      expect_same_bits(*f.error, *other->error, "error of " + f.name);
  }
  std::size_t channels = 0;
  for (const Channel& channel : a.trajectory->channels()) {
    const auto& others = b.trajectory->channels();
    if (std::none_of(others.begin(), others.end(), [&](const Channel& c) { return c.name == channel.name; })) continue;
    ++channels;
    const auto x = test::series(a, channel.name.text), y = test::series(b, channel.name.text);
    ASSERT_EQ(x.size(), y.size());
    for (std::size_t row = 0; row < x.size(); ++row) expect_same_bits(x[row], y[row], channel.name.text);
  }
  EXPECT_GT(channels, 2u);
  ASSERT_EQ(a.events.size(), b.events.size());
  for (std::size_t i = 0; i < a.events.size(); ++i) {
    expect_same_bits(a.events[i].t, b.events[i].t, a.events[i].what);
    EXPECT_EQ(a.events[i].component, b.events[i].component);
    EXPECT_EQ(a.events[i].what, b.events[i].what);
  }
}

class OrderOfTables : public ::testing::TestWithParam<const char*> {};

TEST_P(OrderOfTables, ChangesNoBitOfTheResult) {
  const std::string text = project_text(GetParam());
  const Result original = run(text);
  for (const unsigned seed : {1u, 2u}) {
    const std::string other = shuffled(text, seed);
    ASSERT_NE(other, text);
    expect_same_bits(original, run(other));
  }
}
INSTANTIATE_TEST_SUITE_P(OfScenes, OrderOfTables,
                         ::testing::Values("scenes/crank_press.toml", "scenes/six_inertia_chain.toml",
                                           "scenes/driven_slider_crank.toml"),
                         [](const auto& info) {
                           const std::string name = info.param;
                           std::string out;
                           for (const char c : name.substr(7, name.size() - 12)) out += c == '_' ? ' ' : c;
                           std::erase(out, ' ');
                           return out;
                         });

// Three branches from one gearbox wheel and things that sit `on` shafts, in any order.
const char* const branched = R"(line = ["motor", "c", "gear", "flywheel"]
[[branch]]
from = "gear.out"
line = ["s2", "pump"]
[[branch]]
from = "gear.out"
line = ["s1", "fan"]
[[branch]]
from = "pump"
line = ["s3", "tail"]
[motor]
kind = "dc shunt motor"
stall_torque = "70 N*m"
no_load_speed = "90 rad/s"
inertia = "0.07 kg*m2"
[c]
kind = "coupling"
stiffness = "3.1 kN*m/rad"
damping_ratio = 0.03
[gear]
kind = "gearbox"
stages = [{ teeth = [19, 41], inertia = ["0.003 kg*m2", "0.07 kg*m2"] }]
[flywheel]
kind = "flywheel"
inertia = "1.3 kg*m2"
[s1]
kind = "shaft"
stiffness = "7 kN*m/rad"
[s2]
kind = "shaft"
stiffness = "11 kN*m/rad"
[s3]
kind = "shaft"
stiffness = "13 kN*m/rad"
[fan]
kind = "load"
quadratic = "0.013 N*m*s2/rad2"
inertia = "0.17 kg*m2"
[pump]
kind = "load"
torque = "7 N*m"
inertia = "0.19 kg*m2"
[tail]
kind = "inertia"
inertia = "0.11 kg*m2"
[drag_a]
kind = "bearing drag"
damping = "0.011 N*m*s/rad"
on = "flywheel"
[drag_b]
kind = "bearing drag"
damping = "0.017 N*m*s/rad"
on = "flywheel"
[effects]
elasticity = true
[run]
until = "0.7 s"
samples = 101
)";

TEST(OrderOfTables, OfBranchesChangesNoBitOfTheResult) {
  const Result original = run(branched);
  for (const unsigned seed : {1u, 2u, 3u, 4u}) expect_same_bits(original, run(shuffled(branched, seed)));
}

// --- parameters of effects that are off ---

TEST(EffectOff, ItsDampingMayStayInTheFileOrNot) {
  const std::string press =
      with(project_text("scenes/crank_press.toml"), "elasticity = [\"motor_coupling\", \"main_coupling\"]",
           "elasticity = [\"main_coupling\"]");
  expect_same_bits(run(press), run(with(press, "damping_ratio = 0.06", "")));
  expect_same_bits(run(press), run(with(press, "stiffness     = \"4 kN*m/rad\"", "stiffness     = \"123 kN*m/rad\"")));
}

TEST(EffectOff, ARigidMachineKnowsNoStiffness) {
  const std::string chain =
      with(project_text("scenes/six_inertia_chain.toml"), "elasticity = true", "elasticity = false");
  std::string other = with(chain, "\"4 kN*m/rad\"", "\"9 kN*m/rad\"");
  other = with(with(other, "\"2 N*m*s/rad\"", "\"0 N*m*s/rad\""), "\"10 N*m*s/rad\"", "\"7 N*m*s/rad\"");
  expect_same_bits(run(chain), run(other));
}

// A coupling without hubs whose elasticity is off leaves no trace.
TEST(EffectOff, ACouplingWithoutHubsMayAsWellBeAbsent) {
  const std::string with_coupling = with(project_text("scenes/driven_slider_crank.toml"),
                                         "line  = [\"motor\", \"crank\"]", "line  = [\"motor\", \"soft\", \"crank\"]") +
                                    "\n[soft]\nkind = \"coupling\"\nstiffness = \"700 N*m/rad\"\ndamping_ratio = 0.1\n";
  expect_same_bits(run(project_text("scenes/driven_slider_crank.toml")), run(with_coupling));
}

}  // namespace
}  // namespace kurbel::order_of_tables_test
