// units_test.cpp — quantities as engineers write them, and garbage.
#include "engine/scene/units.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

namespace kurbel::units_test {
namespace {

constexpr double pi = std::numbers::pi;

Quantity read(const std::string& text) {
  UnitError error;
  const auto quantity = parse_quantity(text, error);
  EXPECT_TRUE(quantity) << text << ": " << error.text;
  return quantity.value_or(Quantity{});
}
Dimension dimension_of(const std::string& unit) {
  UnitError error;
  const auto parsed = parse_unit(unit, error);
  EXPECT_TRUE(parsed) << unit << ": " << error.text;
  return parsed.value_or(Unit{}).dimension;
}
std::string error_in(const std::string& text) {
  UnitError error;
  return parse_quantity(text, error) ? "none" : error.text;
}

struct Example {
  std::string text;
  double si;
  std::string unit;
};

TEST(Units, FormsInUseHaveTheirValuesInSi) {
  const Example examples[] = {
      {"1500 rpm", 50 * pi, "rad/s"},
      {"25 rev/s", 50 * pi, "rad/s"},
      {"9000 deg/s", 50 * pi, "rad/s"},
      {"1500 rev/min", 50 * pi, "rad/s"},
      {"12 mm", 0.012, "m"},
      {"120 µm", 120e-6, "m"},
      {"120 μm", 120e-6, "m"},
      {"120 um", 120e-6, "m"},
      {"5 in", 0.127, "m"},
      {"4 kN*m/rad", 4000, "N*m/rad"},
      {"4 kNm/rad", 4000, "N*m/rad"},
      {"70 N*m/deg", 70 * 180 / pi, "N*m/rad"},
      {"70 N·m/°", 70 * 180 / pi, "N*m/rad"},
      {"70 N m / deg", 70 * 180 / pi, "N*m/rad"},
      {"0.5 kg m2", 0.5, "kg*m2"},
      {"0.5 kg·m²", 0.5, "kg*m2"},
      {"0.5 kg*m^2", 0.5, "kg*m2"},
      {"0.5kg*m2", 0.5, "kg*m2"},
      {"500000 kg*mm2", 0.5, "kg*m2"},
      {"5000 kg cm^2", 0.5, "kg*m2"},
      {"30°", pi / 6, "rad"},
      {"30 deg", pi / 6, "rad"},
      {"500 mrad", 0.5, "rad"},
      {"6 bar", 6e5, "Pa"},
      {"80 GPa", 8e10, "N/m2"},
      {"15 hp", 15 * 745.69987158227022, "W"},
      {"11 kW", 11e3, "N*m/s"},
      {"2 N*m*s/rad", 2, "N*m*s/rad"},
      {"0.02 N*m*s2/rad2", 0.02, "N*m*s^2/rad^2"},
      {"5 Hz", 5, "1/s"},
      {"300 1/min", 5, "Hz"},
      {"5 s^-1", 5, "Hz"},
      {"5 s-1", 5, "Hz"},
      {"9.81 m/s2", 9.81, "m*s^-2"},
      {"9.81 m/s/s", 9.81, "m/s^2"},
      {"3 min", 180, "s"},
      {"20 ms", 0.02, "s"},
      {"5 %", 0.05, ""},
      {"0.05", 0.05, ""},
      {"+3 kg", 3, "kg"},
      {"-3e-2 kg", -0.03, "kg"},
      {"7.85 g/cm3", 7850, "kg/m3"},
      {"400 V", 400, "V"},
      {"2 Ohm", 2, "V/A"},
      {"2 Ω", 2, "V/A"},
      {"30 mH", 0.03, "V*s/A"},
      {"1 t", 1000, "kg"},
      {"0.5 kg\u00a0m²", 0.5, "kg*m2"},
      {"  3\tkg ", 3, "kg"},
      {"1.5 N*m/A", 1.5, "V*s"},
      {"1/80", 0.0125, ""},
      {"-3/4 kg", -0.75, "kg"},
      {"1/2.5 %", 0.004, ""},
      {"1/2 1/min", 1. / 120, "Hz"},
      {"400 N*m/(rad/s)^2", 400, "N*m*s2/rad2"},
      {"3 W/(m² s)", 3, "kg/s4"},
      {"2 N*m*(rad/s)^-1", 2, "N*m*s/rad"},
      {"30 N*m/(1/min)", 1800, "N*m*s"},
  };
  for (const Example& e : examples) {
    const Quantity q = read(e.text);
    EXPECT_NEAR(q.value, e.si, 1e-14 * std::abs(e.si)) << e.text;
    EXPECT_EQ(q.dimension, dimension_of(e.unit)) << e.text;
  }
}

TEST(Units, AngleIsADimensionOfItsOwn) {
  EXPECT_NE(dimension_of("1/min"), dimension_of("rad/s"));
  EXPECT_NE(dimension_of("Hz"), dimension_of("rad/s"));
  EXPECT_NE(dimension_of("kN*m"), dimension_of("kN*m/rad"));
  EXPECT_EQ(dimension_of("rpm"), dimension_of("rad/s"));
}

double as_speed(const std::string& text) { return wanted_as(read(text), dimension_of("rad/s")).value; }

TEST(Units, SpeedCountedPerMinuteOrInHertzIsOfWholeTurns) {
  EXPECT_DOUBLE_EQ(as_speed("60 1/min"), as_speed("60 rpm"));
  EXPECT_DOUBLE_EQ(as_speed("60 min^-1"), as_speed("60 rpm"));
  EXPECT_DOUBLE_EQ(as_speed("25 Hz"), as_speed("25 rev/s"));
  EXPECT_DOUBLE_EQ(as_speed("2 kHz"), as_speed("2000 rev/s"));
  EXPECT_DOUBLE_EQ(as_speed("60 rpm"), 2 * pi);
  EXPECT_DOUBLE_EQ(as_speed("3 rad/min"), 3. / 60);
}

// "25 1/s" is 25 rad/s to one and 25 rev/s to the other: neither is taken for granted.
TEST(Units, SpeedPerSecondLeavesOpenWhetherTurnsOrRadiansAndStaysAFrequency) {
  for (const char* text : {"25 1/s", "25 s^-1", "25 1/ms"})
    EXPECT_EQ(wanted_as(read(text), dimension_of("rad/s")).dimension, dimension_of("1/s")) << text;
}

// k = T/i = U/ω, equal by the balance of power.
TEST(Units, AMotorsConstantIsATorquePerCurrentOrAVoltagePerSpeed) {
  const Dimension constant = dimension_of("N*m/A");
  for (const char* text : {"0.9 V*s/rad", "900 mV/(rad/s)", "0.9 N*m/A"}) {
    EXPECT_DOUBLE_EQ(wanted_as(read(text), constant).value, 0.9) << text;
    EXPECT_EQ(wanted_as(read(text), constant).dimension, constant) << text;
  }
  EXPECT_DOUBLE_EQ(wanted_as(read("2 V/rpm"), constant).value, 60 / pi);
  EXPECT_NE(wanted_as(read("2 N*m/A"), dimension_of("V*s/rad")).dimension, dimension_of("V*s/rad"));
}

TEST(Units, FrequencyIsCountedInHertzAsBefore) {
  EXPECT_DOUBLE_EQ(wanted_as(read("5 Hz"), dimension_of("1/s")).value, 5);
  EXPECT_DOUBLE_EQ(wanted_as(read("300 1/min"), dimension_of("1/s")).value, 5);
  EXPECT_DOUBLE_EQ(wanted_as(read("3 min"), dimension_of("s")).value, 180);
}

TEST(Units, SlashDividesByTheNextFactorAlone) {
  EXPECT_EQ(dimension_of("N/m*s"), dimension_of("N*s/m"));
  EXPECT_EQ(dimension_of("N*m/rad/s"), dimension_of("N*m*rad-1*s-1"));
}

TEST(Units, ErrorsNameTheSlip) {
  EXPECT_EQ(error_in("4 kN*m/radd"), "unknown unit \"radd\" — did you mean \"rad\"?");
  EXPECT_EQ(error_in("3 kgm2"), "unknown unit \"kgm\" — did you mean \"kg*m\"?");
  EXPECT_EQ(error_in("3 KN"), "unknown unit \"KN\" — did you mean \"kN\"?");
  EXPECT_EQ(error_in("3,5 kg"), "unexpected comma; decimals are written with a point");
  EXPECT_EQ(error_in("3 kg*"), "the unit ends in an operator");
  EXPECT_EQ(error_in("3 m^"), "an exponent must be a whole number from -9 to 9");
  EXPECT_EQ(error_in("3 m^1000000000000"), "an exponent must be a whole number from -9 to 9");
  EXPECT_EQ(error_in("1/0"), "nothing can be divided by 0");
  EXPECT_EQ(error_in("1/"), "unexpected \"/\" in a unit");
  EXPECT_EQ(error_in("3 m*5"), "unexpected \"5\" in a unit");
  EXPECT_EQ(error_in("3 N*m/(rad/s"), "a bracket is not closed");
  EXPECT_EQ(error_in("3 N/("), "a bracket is not closed");
  EXPECT_EQ(error_in("3 N/(("), "unexpected \"(\" in a unit");
  EXPECT_EQ(error_in("3 N*m/(rad/)"), "the unit ends in an operator");
  EXPECT_EQ(error_in("3 kg)"), "unexpected \")\" in a unit");
  EXPECT_EQ(error_in("3 kg*()"), "unexpected \")\" in a unit");
  EXPECT_EQ(error_in("3 ((kg))"), "unexpected \"(kg))\" in a unit");
  for (const char* text : {"", " ", "kg", "--3 kg", "+-3 kg", "+ 3 kg", "e5 kg", ".", "-"})
    EXPECT_EQ(error_in(text), "a number must come first") << text;
  for (const char* text : {"nan", "inf kg", "-inf kg", "infinity kg", "nan kg"})
    EXPECT_EQ(error_in(text), "the number must be finite") << text;
  for (const char* text : {"1e999 kg", "-1e999", "1e308 km", "1e308 kg9*t9"})
    EXPECT_EQ(error_in(text), "the number is out of range (1e-308 … 1e308)") << text;
}

TEST(Units, ErrorPointsAtTheSlip) {
  UnitError error;
  EXPECT_FALSE(parse_quantity("12 kN*mm/radd", error));
  EXPECT_EQ(error.column, 9u);
}

// value in a unit → SI → back
TEST(Units, ValueTimesUnitAndBackIsTheValue) {
  std::mt19937 random(1);
  const std::string factors[] = {"kg", "mm", "rev", "kN", "min", "deg", "bar", "hp", "V", "s", "A", "g", "ft"};
  std::uniform_int_distribution<std::size_t> pick(0, std::size(factors) - 1);
  std::uniform_int_distribution<int> exponent(-3, 3);
  std::uniform_real_distribution<double> digits(-1e3, 1e3);
  for (int i = 0; i < 2000; ++i) {
    std::string unit = factors[pick(random)];
    for (int k = 0; k < i % 4; ++k)
      unit += (k % 2 ? "/" : "*") + factors[pick(random)] + "^" + std::to_string(exponent(random));
    const double value = digits(random);
    UnitError error;
    const auto parsed = parse_unit(unit, error);
    ASSERT_TRUE(parsed) << unit << ": " << error.text;
    char text[64];
    std::snprintf(text, sizeof text, "%.17g ", value);
    EXPECT_NEAR(read(text + unit).value / parsed->factor, value, 1e-13 * std::abs(value)) << unit;
  }
}

TEST(Units, GarbageNeverCrashesAndErrorsLieWithinTheText) {
  std::mt19937 random(2);
  const std::string pieces[] = {"1",
                                "9",
                                "-",
                                "+",
                                ".",
                                "e",
                                "kg",
                                "m",
                                "/",
                                "*",
                                "·",
                                "²",
                                "^",
                                " ",
                                "(",
                                ")",
                                "\t",
                                "°",
                                "µ",
                                ",",
                                "nan",
                                "rad",
                                std::string("\0", 1),
                                "\xff",
                                "\xc2",
                                "(",
                                "%",
                                "N",
                                "\n"};
  std::uniform_int_distribution<std::size_t> pick(0, std::size(pieces) - 1), length(0, 12);
  for (int i = 0; i < 200'000; ++i) {
    std::string text;
    for (std::size_t k = length(random); k > 0; --k) text.append(pieces[pick(random)]);
    UnitError error;
    const auto quantity = parse_quantity(text, error);
    if (quantity) {
      EXPECT_TRUE(std::isfinite(quantity->value)) << text;
    } else {
      EXPECT_FALSE(error.text.empty()) << text;
      EXPECT_LE(error.column, text.size()) << text;
    }
  }
}

TEST(Units, LongTextsAreReadInLinearTime) {
  UnitError error;
  std::string text = "1 m";
  for (int i = 0; i < 200'000; ++i) text += i % 2 ? "*m" : "/m";
  EXPECT_TRUE(parse_quantity(text, error));
  std::string endless(1'000'000, 'x');
  endless[0] = '1';
  EXPECT_FALSE(parse_quantity(endless, error));
  EXPECT_LT(error.text.size(), 200u);
}

TEST(Units, DimensionsHaveNames) {
  EXPECT_EQ(name_of(dimension_of("kN*mm")), "a torque or energy (N·m)");
  EXPECT_EQ(name_of(dimension_of("rpm")), "an angular velocity (rad/s)");
  EXPECT_EQ(name_of(dimension_of("")), "a plain number");
  EXPECT_EQ(name_of(dimension_of("kg*A")), "a quantity in kg·A");
}

TEST(Units, NumbersAreWrittenWithPrettyUnits) {
  EXPECT_EQ(with_unit(0.5, "kg*m2"), "0.5 kg·m²");
  EXPECT_EQ(with_unit(1234567, "N*m"), "1.23457e+06 N·m");
  EXPECT_EQ(pretty_unit("kg*m^2"), "kg·m²");
}

TEST(Units, NearestFindsSlipsAndLeavesStrangersAlone) {
  const std::vector<std::string> words = {"stiffness", "damping", "damping_ratio", "on"};
  EXPECT_EQ(nearest("stifness", words), "stiffness");
  EXPECT_EQ(nearest("stiffnses", words), "stiffness");
  EXPECT_EQ(nearest("Damping", words), "damping");
  EXPECT_EQ(nearest("temperature", words), std::nullopt);
  EXPECT_EQ(nearest("", words), std::nullopt);
  EXPECT_EQ(nearest(std::string(100'000, 'a'), words), std::nullopt);
}

}  // namespace
}  // namespace kurbel::units_test
