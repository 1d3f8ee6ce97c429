// schema_test.cpp — the schema is that of the reader: every example scene fits it, and slips do not.
#include "studies/scenes/schema.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <regex>
#include <sstream>

#include "engine/scene/document.h"
#include "tests/support/files.h"
#include "tests/support/scenes.h"

namespace kurbel::schema_test {
namespace {

using Json = nlohmann::json;

using test::text_of;

Json json_of(const DocumentValue& value) {
  using Type = DocumentValue::Type;
  if (value.type == Type::flag) return value.flag;
  if (value.type == Type::integer) return value.integer;
  if (value.type == Type::number) return value.number;
  if (value.type == Type::text) return value.text;
  Json json = value.type == Type::list ? Json::array() : Json::object();
  for (const DocumentValue& item : value.items) json.push_back(json_of(item));
  for (const DocumentEntry& entry : value.entries) json[entry.key] = json_of(entry.value);
  return json;
}

// As much of JSON Schema as the schema uses; an unknown keyword fails the test.
class Validator {
 public:
  explicit Validator(Json root) : root_(std::move(root)) {}
  std::string error(const Json& value) const { return check(root_, value, "scene"); }

 private:
  // Empty: the value fits.
  std::string check(const Json& schema, const Json& value, const std::string& at) const {
    for (const auto& [keyword, rule] : schema.items())
      if (const std::string text = check_rule(schema, keyword, rule, value, at); !text.empty()) return text;
    return "";
  }
  std::string check_rule(const Json& schema, const std::string& keyword, const Json& rule, const Json& value,
                         const std::string& at) const {
    const auto unless = [&](bool good) {
      return good ? std::string()
                  : at + ": " + keyword + " " + rule.dump().substr(0, 80) + " does not hold for " +
                        value.dump().substr(0, 80);
    };
    if (keyword == "$schema" || keyword == "$defs" || keyword == "title" || keyword == "description" ||
        keyword == "default")
      return "";
    if (keyword == "$ref") return check(resolve(rule), value, at);
    if (keyword == "type") return unless(is(rule, value));
    if (keyword == "const") return unless(value == rule);
    if (keyword == "enum") return unless(std::find(rule.begin(), rule.end(), value) != rule.end());
    if (keyword == "pattern")
      return unless(!value.is_string() ||
                    std::regex_search(value.get<std::string>(), std::regex(rule.get<std::string>())));
    if (keyword == "minimum") return unless(!value.is_number() || value >= rule);
    if (keyword == "maximum") return unless(!value.is_number() || value <= rule);
    if (keyword == "exclusiveMinimum") return unless(!value.is_number() || value > rule);
    if (keyword == "exclusiveMaximum") return unless(!value.is_number() || value < rule);
    if (keyword == "minItems") return unless(!value.is_array() || value.size() >= rule.get<std::size_t>());
    if (keyword == "maxItems") return unless(!value.is_array() || value.size() <= rule.get<std::size_t>());
    if (keyword == "minProperties") return unless(!value.is_object() || value.size() >= rule.get<std::size_t>());
    if (keyword == "oneOf" || keyword == "anyOf") return check_choice(keyword, rule, value, at);
    if (keyword == "items") {
      for (std::size_t i = 0; value.is_array() && i < value.size(); ++i)
        if (const std::string text = check(rule, value[i], at + "[]"); !text.empty()) return text;
      return "";
    }
    if (keyword == "required") {
      for (const Json& name : rule)
        if (value.is_object() && !value.contains(name.get<std::string>()))
          return at + ": " + name.dump() + " is missing";
      return "";
    }
    if (keyword == "properties") {
      for (const auto& [name, inner] : rule.items())
        if (value.is_object() && value.contains(name))
          if (const std::string text = check(inner, value[name], at + "." + name); !text.empty()) return text;
      return "";
    }
    if (keyword == "additionalProperties") {
      for (auto it = value.begin(); value.is_object() && it != value.end(); ++it) {
        if (schema.contains("properties") && schema["properties"].contains(it.key())) continue;
        if (rule.is_boolean()) return at + ": unknown key " + it.key();
        if (const std::string text = check(rule, it.value(), at + "." + it.key()); !text.empty()) return text;
      }
      return "";
    }
    return "the schema uses \"" + keyword + "\", which this test does not know";
  }
  std::string check_choice(const std::string& keyword, const Json& choices, const Json& value,
                           const std::string& at) const {
    int fitting = 0;
    std::string said;
    for (const Json& choice : choices) {
      const std::string text = check(choice, value, at);
      fitting += text.empty();
      said += text.empty() ? "" : "\n  " + text;
    }
    return (keyword == "oneOf" ? fitting == 1 : fitting > 0)
               ? ""
               : at + ": fits " + std::to_string(fitting) + " of " + keyword + said;
  }
  static bool is(const std::string& type, const Json& value) {
    return (type == "object" && value.is_object()) || (type == "array" && value.is_array()) ||
           (type == "string" && value.is_string()) || (type == "boolean" && value.is_boolean()) ||
           (type == "number" && value.is_number()) || (type == "integer" && value.is_number_integer());
  }
  const Json& resolve(const std::string& target) const {
    return root_.at(Json::json_pointer(std::regex_replace(target.substr(1), std::regex("%20"), " ")));
  }

  Json root_;
};

std::string error_in(const std::string& scene) {
  static const Validator validator(Json::parse(scene_schema()));
  return validator.error(json_of(parse_toml(scene, "test.toml")));
}

TEST(Schema, TheFileInDocsIsTheOnePrinted) {
  EXPECT_TRUE(text_of(test::source_path("docs/scene.schema.json")) == scene_schema())
      << "renew it: kurbel schema > docs/scene.schema.json";
}

TEST(Schema, EveryExampleSceneFitsAndNamesTheSchema) {
  int count = 0;
  for (const auto& entry : std::filesystem::directory_iterator(test::source_path("scenes"))) {
    if (entry.path().extension() != ".toml") continue;
    ++count;
    const std::string text = text_of(entry.path().string());
    EXPECT_TRUE(text.starts_with("#:schema ../docs/scene.schema.json\n")) << entry.path();
    EXPECT_EQ(error_in(text), "") << entry.path();
  }
  EXPECT_GE(count, 8);
}

TEST(Schema, EveryKindHasTheKeysAndRequiredOnesOfTheReader) {
  const Json schema = Json::parse(scene_schema());
  for (const Kind& kind : all_kinds()) {
    const Json& table = schema.at("$defs").at(kind.name);
    std::vector<std::string> required;
    for (const Key& key : kind.keys) {
      EXPECT_TRUE(table["properties"].contains(key.name)) << kind.name << "." << key.name;
      if (key.required) required.push_back(key.name);
    }
    const std::size_t others = kind.placement == Placement::inline_one ? 4 : 3;  // kind, use, orders, on
    EXPECT_EQ(table["properties"].size(), kind.keys.size() + others) << kind.name;
    EXPECT_EQ(table["required"], Json({"kind"}));
    // What is required, or a table that may have it.
    if (!required.empty()) {
      EXPECT_EQ(table["anyOf"], Json({{{"required", required}}, {{"required", {"use"}}}})) << kind.name;
    }
    EXPECT_EQ(table["additionalProperties"], false);
  }
}

TEST(Schema, SlipsDoNotFit) {
  const std::string head = "line = [\"a\"]\n[a]\nkind = \"inertia\"\n";
  EXPECT_EQ(error_in(head + "inertia = \"1 kg*m2\"\n"), "");
  EXPECT_NE(error_in("[a]\nkind = \"inertia\"\ninertia = \"1 kg*m2\"\n"), "") << "no line";
  EXPECT_NE(error_in(head), "") << "a required key is missing";
  EXPECT_EQ(error_in(head + "use = \"table.wheel\"\n"), "") << "it may stand in a table that is used";
  EXPECT_NE(error_in(head + "inertia = 1\n"), "") << "no unit";
  EXPECT_NE(error_in(head + "inertai = \"1 kg*m2\"\n"), "") << "mistyped key";
  EXPECT_NE(error_in(head + "inertia = \"1 kg*m2\"\n[run]\nmethod = \"eular\"\n"), "") << "unknown method";
  EXPECT_NE(error_in(head + "inertia = \"1 kg*m2\"\n[run]\naccuracy = 5\n"), "") << "out of its domain";
  EXPECT_NE(error_in("line = [\"a\"]\n[a]\nkind = \"inertai\"\ninertia = \"1 kg*m2\"\n"), "") << "unknown kind";
}

}  // namespace
}  // namespace kurbel::schema_test
