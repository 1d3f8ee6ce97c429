// train_sheets_test.cpp — published trains from their mass–elastic sheets (tests/cases/ts01 … ts04): undamped modes to the
// printed digits.
#include "studies/modes/modes.h"
#include "studies/scenes/train_sheet.h"
#include "tests/published/published.h"

namespace kurbel::train_sheets_test {
namespace {

using test::Against;
using test::two_pi;
using test::Validation;

struct Printed {
  double frequency, half_a_digit;
};

// `unit` of a frequency [rad/s].
void expect_printed(const char* source, const char* sheet, double unit, const char* unit_name,
                    const std::vector<Printed>& printed) {
  const Validation is(Against::published, source);
  const Scene scene = test::scene_from(scene_of_sheet(test::source_path(std::string("tests/cases/") + sheet)));
  const ModesStudy study = find_modes(scene, scene.effects, {.modes_alone = true});
  ASSERT_GE(study.modes.size(), printed.size());
  for (std::size_t i = 0; i < printed.size(); ++i)
    is.near("natural frequency " + std::to_string(i + 1) + " from the sheet, as printed", unit_name,
            study.modes[i].omega / unit, printed[i].frequency, printed[i].half_a_digit);
}

TEST(TrainSheets, DieselCrankshaftHasThePublishedModes) {
  expect_printed("Mendes, Meirelles, Zampieri (2008): six-cylinder diesel engine", "ts01_diesel_crankshaft.csv", two_pi,
                 "Hz",
                 {{216.58, 0.005},
                  {592.74, 0.005},
                  {984.92, 0.005},
                  {1171.0, 0.05},
                  {1416.0, 0.05},
                  {1660.0, 0.05},
                  {1794.4, 0.05},
                  {2993.5, 0.05}});
}

TEST(TrainSheets, GearedMarineTurbinesHaveThePublishedModes) {
  expect_printed("Gunter, Chen: marine turbines, two stages of gears, one propeller, ex. 8.1 (case tv01)",
                 "ts02_marine_turbines.csv", two_pi / 60, "1/min", {{177.7, 0.05}, {220.2, 0.05}, {1282.6, 0.05}});
}

TEST(TrainSheets, ListsOfDiscsAndShaftsHaveThePublishedModes) {
  expect_printed("Friswell et al.: Dynamics of Rotating Machines, ex. 9.7.1", "ts03_five_discs.csv", two_pi, "Hz",
                 {{81.21, 0.005}, {141.21, 0.005}, {378.95, 0.005}, {536.36, 0.005}});
}

TEST(TrainSheets, TwoGearedEnginesHaveThePublishedModes) {
  expect_printed("Friswell et al.: Dynamics of Rotating Machines, ex. 9.6.3", "ts04_two_engines.csv", two_pi, "Hz",
                 {{10.304, 0.0005}, {20.479, 0.0005}, {24.423, 0.0005}});
}

}  // namespace
}  // namespace kurbel::train_sheets_test
