// fields_test.cpp — a table of fields reads what stands in a section into the members that its keys fill, and refuses to
// be made where a key or a member would be said twice.
#include "engine/scene/fields.h"

#include <gtest/gtest.h>

#include <limits>
#include <random>
#include <stdexcept>

namespace kurbel::fields_test {
namespace {

enum class Side { left, right };

struct Pin {
  double radius = 0, half_length = 0;
};
struct WornPin : Pin {
  std::optional<double> wear;
};
struct Load {
  double force = 0;
};
struct Table {
  double mass = 0, guide = 0, value = 0;
  Side form = Side::left;
  int teeth = 0;
  bool open = false;
  std::string name;
  Side side = Side::left;
  std::optional<double> maybe;
  std::optional<bool> perhaps;
  std::vector<double> angles;
  std::vector<int> order;
  CurveData curve;
  Pin pin;
  std::vector<Load> loads;
  std::optional<Load> one_load;
};

Fields<WornPin> pin_fields(const std::string& name) {
  return Fields<WornPin>()
      .add({.name = name + "_radius", .unit = "m"}, &WornPin::radius)
      .add({.name = name + "_length", .unit = "m"}, &WornPin::half_length, Scaled(0.5))
      .add({.name = name + "_wear", .unit = "m"}, &WornPin::wear)
      .derive([](WornPin& pin) { pin.radius -= pin.wear.value_or(0); })
      .check([](const Reading<WornPin>& pin) {
        if (pin.wear && pin.radius <= 0) pin.refuse(&WornPin::wear, "nothing is left of it");
      });
}

const Tables<Load>& load_tables() {
  static const auto made = Tables<Load>().add(
      "load", "a load", Fields<Load>().add({.name = "force", .unit = "N", .required = true}, &Load::force));
  return made;
}

const Fields<Table>& fields() {
  static const auto made =
      Fields<Table>()
          .add({.name = "mass", .unit = "kg", .required = true}, &Table::mass)
          .add({.name = "guide", .unit = "m"}, &Table::guide, [](const Table& t) { return 2 * t.mass; })
          .add_forms(&Table::value, &Table::form, {{{.name = "left"}, Side::left}, {{.name = "right"}, Side::right}})
          .add({.name = "teeth"}, &Table::teeth)
          .add({.name = "open"}, &Table::open)
          .add({.name = "name"}, &Table::name)
          .add({.name = "side"}, &Table::side, {{"left", Side::left}, {"right", Side::right}})
          .add({.name = "maybe"}, &Table::maybe)
          .add({.name = "perhaps"}, &Table::perhaps)
          .add({.name = "angles", .unit = "rad"}, &Table::angles)
          .add({.name = "order"}, &Table::order)
          .add({.name = "curve", .choices = {"time"}}, &Table::curve)
          .add(pin_fields("pin"), &Table::pin, [](const Table& t) { return Pin{.radius = 0.1 * t.mass}; })
          .add({.name = "loads"}, &Table::loads, load_tables())
          .add({.name = "one_load"}, &Table::one_load, load_tables());
  return made;
}

const Kind& kind() {
  static const Kind made{.name = "thing", .keys = fields().keys()};
  return made;
}

Setting number(const std::string& key, double value, int line = 1) {
  Setting s{.key = key, .at = {line, 1}, .given = true, .number = value, .sections = {}};
  return s;
}
Section section_of(std::vector<Setting> settings) {
  return {.name = "a", .kind = &kind(), .at = {1, 1}, .settings = std::move(settings)};
}
Section load_of(double force) {
  return {.name = "l", .kind = &load_tables().kinds().front(), .at = {2, 1}, .settings = {number("force", force)}};
}
std::string reported(const Messages& messages) {
  std::string text;
  for (const Message& m : messages.all()) text += m.text + "\n";
  return text;
}

TEST(Fields, TypeOfTheMemberIsTypeOfTheKey) {
  const auto type = [](const std::string& name) {
    for (const Key& key : fields().keys())
      if (key.name == name) return key.type;
    throw std::logic_error(name);
  };
  EXPECT_EQ(type("mass"), KeyType::quantity);
  EXPECT_EQ(type("teeth"), KeyType::integer);
  EXPECT_EQ(type("open"), KeyType::flag);
  EXPECT_EQ(type("name"), KeyType::text);
  EXPECT_EQ(type("side"), KeyType::text);
  EXPECT_EQ(type("maybe"), KeyType::quantity);
  EXPECT_EQ(type("perhaps"), KeyType::flag);
  EXPECT_EQ(type("angles"), KeyType::quantities);
  EXPECT_EQ(type("order"), KeyType::integers);
  EXPECT_EQ(type("curve"), KeyType::curve);
  EXPECT_EQ(type("loads"), KeyType::sections);
}

TEST(Fields, WhatIsReadEqualsWhatWasWritten) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> any(1, 1000);
  for (int round = 0; round < 50; ++round) {
    const double mass = any(random), guide = any(random), value = any(random), radius = any(random),
                 force = any(random);
    const int teeth = static_cast<int>(any(random));
    const bool right = round % 2 == 1;
    Section s = section_of({number("mass", mass), number("guide", guide), number(right ? "right" : "left", value),
                            number("teeth", teeth), number("maybe", guide), number("pin_radius", radius),
                            number("pin_length", guide)});
    const auto add = [&](const std::string& key) -> Setting& {
      s.settings.push_back({.key = key, .at = {1, 1}, .given = true, .sections = {}});
      return s.settings.back();
    };
    add("open").flag = right;
    add("perhaps").flag = !right;
    add("name").text = "n" + std::to_string(round);
    add("side").text = right ? "right" : "left";
    add("angles").numbers = {mass, guide};
    add("order").numbers = {3, 1, 2};
    add("curve").curve.y = {guide, value};
    add("loads").sections = {load_of(force), load_of(2 * force)};
    add("one_load").sections = {load_of(3 * force)};
    Messages messages("f");
    const auto t = fields().read(s, messages);
    EXPECT_EQ(reported(messages), "");
    EXPECT_EQ(t.mass, mass);
    EXPECT_EQ(t.guide, guide);
    EXPECT_EQ(t.value, value);
    EXPECT_EQ(t.form, right ? Side::right : Side::left);
    EXPECT_EQ(t.side, right ? Side::right : Side::left);
    EXPECT_EQ(t.teeth, teeth);
    EXPECT_EQ(t.open, right);
    EXPECT_EQ(t.perhaps, !right);
    EXPECT_EQ(t.name, "n" + std::to_string(round));
    EXPECT_EQ(t.maybe, guide);
    EXPECT_EQ(t.angles, (std::vector<double>{mass, guide}));
    EXPECT_EQ(t.order, (std::vector<int>{3, 1, 2}));
    EXPECT_EQ(t.curve.y, (std::vector<double>{guide, value}));
    EXPECT_EQ(t.pin.radius, radius);
    EXPECT_EQ(t.pin.half_length, 0.5 * guide);
    ASSERT_EQ(t.loads.size(), 2u);
    EXPECT_EQ(t.loads[1].force, 2 * force);
    EXPECT_EQ(t.one_load.value().force, 3 * force);
  }
}

TEST(Fields, DefaultsFollowFromWhatStandsAbove) {
  Messages messages("f");
  const Table t = fields().read(section_of({number("mass", 3)}), messages);
  EXPECT_EQ(t.guide, 6);
  EXPECT_DOUBLE_EQ(t.pin.radius, 0.3);
  EXPECT_FALSE(t.maybe);
  EXPECT_FALSE(t.perhaps);
  EXPECT_FALSE(t.one_load);
  EXPECT_TRUE(t.loads.empty());
}

TEST(Fields, RequiredKeyIsNeverPassedOver) {
  Messages messages("f");
  EXPECT_THROW(fields().read(section_of({}), messages), std::logic_error);
}

TEST(Fields, FaultsNameTheMembersKeyAndItsPlace) {
  Messages messages("f");
  const Section s = section_of({number("mass", 1), number("pin_radius", 1, 5), number("pin_wear", 2, 6)});
  const auto t = fields().read(s, messages);
  EXPECT_EQ(reported(messages), "thing \"a\": nothing is left of it\n");
  EXPECT_EQ(messages.all().front().at.line, 6);
  EXPECT_EQ(t.key(&Table::pin), "pin_radius");
  EXPECT_EQ(t.given_keys(&Table::pin), (std::vector<std::string>{"pin_radius", "pin_wear"}));
  EXPECT_FALSE(t.given(&Table::maybe));
}

TEST(Fields, OneOfSeveralFormsIsKept) {
  Messages messages("f");
  fields().read(section_of({number("mass", 1), number("left", 1, 2), number("right", 2, 3)}), messages);
  EXPECT_EQ(reported(messages), "thing \"a\": \"left\" and \"right\" both given; keep one\n");
  EXPECT_EQ(messages.all().front().at.line, 3);
}

TEST(Fields, OneTableIsNotAList) {
  Section s = section_of({number("mass", 1)});
  s.settings.push_back({.key = "one_load", .at = {4, 1}, .given = true, .sections = {load_of(1), load_of(2)}});
  Messages messages("f");
  fields().read(s, messages);
  EXPECT_EQ(reported(messages), "thing \"a\": one_load = a list of 2 tables; must be one table\n");
}

TEST(Fields, NumbersBeyondIntsStayDefined) {
  Messages messages("f");
  EXPECT_EQ(fields().read(section_of({number("mass", 1), number("teeth", 1e300)}), messages).teeth,
            std::numeric_limits<int>::max());
}

TEST(Fields, KeyDeclaredTwiceIsRefused) {
  EXPECT_THROW(Fields<Table>().add({.name = "mass"}, &Table::mass).add({.name = "mass"}, &Table::guide),
               std::logic_error);
  EXPECT_THROW(Fields<Table>().add({.name = "pin_radius"}, &Table::mass).add(pin_fields("pin"), &Table::pin),
               std::logic_error);
}

TEST(Fields, MemberFilledTwiceIsRefused) {
  EXPECT_THROW(Fields<Table>().add({.name = "mass"}, &Table::mass).add({.name = "weight"}, &Table::mass),
               std::logic_error);
  EXPECT_THROW(Fields<Table>().add(pin_fields("pin"), &Table::pin).add(pin_fields("other"), &Table::pin),
               std::logic_error);
}

TEST(Fields, MemberThatNoKeyFillsCannotBeAskedFor) {
  const auto few = Fields<Table>().add({.name = "mass"}, &Table::mass);
  Messages messages("f");
  const auto t = few.read(section_of({number("mass", 1)}), messages);
  EXPECT_THROW(t.given(&Table::guide), std::logic_error);
}

}  // namespace
}  // namespace kurbel::fields_test
