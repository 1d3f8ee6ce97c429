// without_files.cpp — what stands in the run-time of exported components for parts of the engine that read files: the texts
// of defaults are all that is left of TOML, and tables come as text or not at all.
#include <nlohmann/json.hpp>

#include "engine/scene/document.h"
#include "engine/tables/spreadsheet.h"

namespace kurbel {

// "x = 12", "x = \"3 s\"", "x = true", "x = []": what stands behind the sign is JSON, too.
DocumentValue parse_toml(const std::string& text, const std::string& file) {
  const std::size_t sign = text.find(" = ");
  const auto json = sign == std::string::npos ? nlohmann::json(nlohmann::json::value_t::discarded)
                                              : nlohmann::json::parse(text.substr(sign + 3), nullptr, false);
  DocumentValue value;
  using Type = DocumentValue::Type;
  if (json.is_string()) {
    value.type = Type::text;
    value.text = json.get<std::string>();
  } else if (json.is_boolean()) {
    value.type = Type::flag;
    value.flag = json.get<bool>();
  } else if (json.is_number_integer()) {
    value.type = Type::integer;
    value.integer = json.get<std::int64_t>();
    value.number = static_cast<double>(value.integer);
  } else if (json.is_number()) {
    value.type = Type::number;
    value.number = json.get<double>();
  } else if (json.is_array() && json.empty()) {
    value.type = Type::list;
  } else {
    throw SceneError({{file, {}, "is no plain value"}});
  }
  DocumentValue document;
  document.entries.push_back({text.substr(0, sign), {}, std::move(value)});
  return document;
}

std::string sheet_as_text(const std::string&, const std::string&, const std::string& path, std::size_t) {
  throw SceneError({{path, {}, "is a spreadsheet, which an exported component does not read; save it as .csv"}});
}

}  // namespace kurbel
