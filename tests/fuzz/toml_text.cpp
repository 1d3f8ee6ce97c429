// toml_text.cpp — values in TOML's notation.
#include "tests/fuzz/toml_text.h"

#include <fmt/format.h>

#include <cmath>

namespace kurbel::fuzz {
namespace {

using Type = DocumentValue::Type;

std::string quoted(const std::string& text) {
  std::string out = "\"";
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\')
      out += std::string("\\") + c;
    else if (byte < 0x20 || byte == 0x7F)
      out += fmt::format("\\u{:04X}", byte);
    else
      out += c;
  }
  return out + "\"";
}

std::string key_text(const std::string& key) {
  const bool bare =
      !key.empty() &&
      key.find_first_not_of("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-") == std::string::npos;
  return bare ? key : quoted(key);
}

std::string number_text(double x) {
  if (std::isnan(x)) return "nan";
  if (std::isinf(x)) return x > 0 ? "inf" : "-inf";
  const std::string text = fmt::format("{}", x);
  return text.find_first_of(".e") == std::string::npos ? text + ".0" : text;
}

}  // namespace

std::string toml_text(const DocumentValue& value) {
  switch (value.type) {
    case Type::flag:
      return value.flag ? "true" : "false";
    case Type::integer:
      return fmt::format("{}", value.integer);
    case Type::number:
      return number_text(value.number);
    case Type::text:
      return quoted(value.text);
    case Type::other:
      return "1979-05-27";
    case Type::list: {
      std::string text = "[";
      for (const DocumentValue& item : value.items) text += (text.size() > 1 ? ", " : "") + toml_text(item);
      return text + "]";
    }
    case Type::table: {
      std::string text = "{";
      for (const DocumentEntry& entry : value.entries)
        text += (text.size() > 1 ? ", " : " ") + key_text(entry.key) + " = " + toml_text(entry.value);
      return text + " }";
    }
  }
  return "";
}

std::string toml_document(const DocumentValue& table) {
  std::string text;
  for (const DocumentEntry& entry : table.entries) text += key_text(entry.key) + " = " + toml_text(entry.value) + "\n";
  return text;
}

}  // namespace kurbel::fuzz
