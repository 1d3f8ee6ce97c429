// component_data_test.cpp — what components state is found by component and type, and listed in the order of the scene.
#include <gtest/gtest.h>

#include "drivetrain/couplings/coupling_keys.h"
#include "drivetrain/friction/belt.h"
#include "drivetrain/shared/rating_keys.h"
#include "engine/model/model.h"
#include "tests/support/scenes.h"

namespace kurbel::component_data_test {
namespace {

TEST(ComponentData, IsFoundByComponentAndTypeAlone) {
  ComponentData data;
  data.add("b", 1.5);
  data.add("a", 2.5);
  data.add("a", std::string("words"));
  ASSERT_NE(data.find<double>("a"), nullptr);
  EXPECT_EQ(*data.find<double>("a"), 2.5);
  EXPECT_EQ(*data.find<std::string>("a"), "words");
  EXPECT_EQ(data.find<std::string>("b"), nullptr);
  EXPECT_EQ(data.find<int>("a"), nullptr);
  EXPECT_EQ(data.find<double>("c"), nullptr);
  std::string order;
  for (const auto& [component, value] : data.all<double>()) order += component;
  EXPECT_EQ(order, "ba");
}

TEST(ComponentData, ComesWithTheModelWhateverItsEffects) {
  const Scene scene = test::scene_from(R"(
line = ["motor", "coupling", "clutch", "shaft", "wheel"]
[motor]
kind = "dc shunt motor"
voltage = "220 V"
resistance = "2 Ohm"
constant = "2 N*m/A"
rated_torque = "20 N*m"
duty = "S1"
inertia = "0.1 kg*m2"
[coupling]
kind = "coupling"
stiffness = "1 kN*m/rad"
maximum_torque = "90 N*m"
backlash = "1 deg"
[clutch]
kind = "clutch"
torque = "100 N*m"
inertia_in = "0.05 kg*m2"
inertia_out = "0.05 kg*m2"
allowable_heat = "3 kJ"
[shaft]
kind = "shaft"
stiffness = "5 kN*m/rad"
diameter = "30 mm"
yield_strength = "300 MPa"
[wheel]
kind = "flywheel"
inertia = "2 kg*m2"
)");
  Effects elastic;
  elastic.all_elastic = true;
  for (const Effects& effects : {Effects{}, elastic}) {
    const auto model = compile(scene, effects);
    const ComponentData& data = model->network.data;
    EXPECT_EQ(data.find<MotorRating>("motor")->torque, 20);
    EXPECT_TRUE(data.find<MotorRating>("motor")->states_duty());
    EXPECT_EQ(data.find<CouplingLimits>("coupling")->maximum, 90);
    EXPECT_NE(data.find<StatedPlay>("coupling"), nullptr);
    EXPECT_EQ(data.find<HeatRating>("clutch")->engagement, 3000);
    EXPECT_EQ(data.find<ShaftKeys>("shaft")->rating.yield, 300e6);
    EXPECT_EQ(data.find<Flywheel>("wheel")->inertia, 2);
    EXPECT_EQ(data.find<RimRating>("wheel"), nullptr);
    EXPECT_EQ(data.find<BeltRating>("clutch"), nullptr);
    EXPECT_EQ(model->network.kind_of("clutch"), "clutch");
    EXPECT_EQ(model->network.kind_of("none"), "");
  }
}

}  // namespace
}  // namespace kurbel::component_data_test
