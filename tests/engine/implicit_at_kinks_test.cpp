// implicit_at_kinks_test.cpp — implicit methods where laws have kinks: an event that no single step ends on, and a
// motion so short that a coarse step goes over it. Variants that broke off.
#include <gtest/gtest.h>

#include "engine/model/model.h"
#include "studies/run/simulate.h"
#include "tests/coverage/variant.h"

namespace kurbel::implicit_at_kinks_test {
namespace {

struct Broken {
  const char* scene;
  std::uint64_t seed;
  const char* method;
  double accuracy;
};

TEST(ImplicitMethods, PassEventsAtKinksOfTheirLaws) {
  for (const Broken& b : {Broken{"crank_press", 6, "esdirk3", 1e-3}, Broken{"crank_press", 6, "esdirk5", 1e-4},
                          Broken{"crank_press", 8, "esdirk3", 1e-8}, Broken{"worm_hoist", 10, "esdirk3", 1e-2}}) {
    const Scene scene = coverage::make_variant(b.scene, b.seed).read;
    SimulateOptions options;
    options.measure_error = false;
    options.method = b.method;
    options.accuracy = b.accuracy;
    const Result r = simulate(scene, scene.effects, b.scene, options);
    EXPECT_TRUE(r.complete) << b.scene << " " << b.seed << " " << b.method << ": " << r.diagnosis;
    EXPECT_LT(r.energy.relative, 1e-3) << b.scene << " " << b.seed;
  }
}

}  // namespace
}  // namespace kurbel::implicit_at_kinks_test
