// document.cpp — the one source that includes toml++.
#include "engine/document.h"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>

namespace kurbel {
namespace {

Location location(const toml::source_region& region) {
  return {static_cast<int>(region.begin.line), static_cast<int>(region.begin.column)};
}

DocumentValue convert(const toml::node& node) {
  DocumentValue value;
  value.at = location(node.source());
  using Type = DocumentValue::Type;
  if (const auto* table = node.as_table()) {
    value.type = Type::table;
    for (const auto& [key, child] : *table)
      value.entries.push_back({std::string(key.str()), location(key.source()), convert(child)});
    std::sort(value.entries.begin(), value.entries.end(),
              [](const DocumentEntry& a, const DocumentEntry& b) { return a.at < b.at; });
  } else if (const auto* array = node.as_array()) {
    value.type = Type::list;
    for (const toml::node& item : *array) value.items.push_back(convert(item));
  } else if (const auto* text = node.as_string()) {
    value.type = Type::text;
    value.text = text->get();
  } else if (const auto* integer = node.as_integer()) {
    value.type = Type::integer;
    value.integer = integer->get();
    value.number = static_cast<double>(value.integer);
  } else if (const auto* number = node.as_floating_point()) {
    value.type = Type::number;
    value.number = number->get();
  } else if (const auto* flag = node.as_boolean()) {
    value.type = Type::flag;
    value.flag = flag->get();
  } else {
    value.type = Type::other;  // dates and times
  }
  return value;
}

}  // namespace

const DocumentEntry* DocumentValue::find(std::string_view key) const {
  const auto found = std::find_if(entries.begin(), entries.end(), [&](const DocumentEntry& e) { return e.key == key; });
  return found == entries.end() ? nullptr : &*found;
}

std::string DocumentValue::describe() const {
  switch (type) {
    case Type::flag: return flag ? "true" : "false";
    case Type::integer: return fmt::format("the bare number {}", integer);
    case Type::number: return fmt::format("the bare number {}", number);
    case Type::text: return fmt::format("\"{}\"", text);
    case Type::list: return "a list";
    case Type::table: return "a table";
    case Type::other: return "a date or time";
  }
  return "";
}

std::string read_text_file(const std::string& path, std::size_t limit) {
  const auto refuse = [&](const std::string& text) { throw SceneError({{path, {}, text}}); };
  std::error_code status;
  if (!std::filesystem::exists(path, status)) refuse("no such file; check the path, or list the folder with ls");
  if (std::filesystem::is_directory(path, status)) refuse("is a folder; give the scene file inside it");
  // Read no more than the limit: pipes and devices have no size to ask for.
  std::ifstream in(path, std::ios::binary);
  if (!in) refuse("cannot be opened for reading; check its permissions");
  std::string text(limit + 1, '\0');
  in.read(text.data(), static_cast<std::streamsize>(text.size()));
  if (in.bad()) refuse("cannot be read");
  text.resize(static_cast<std::size_t>(in.gcount()));
  if (text.size() > limit) refuse(fmt::format("is larger than {} MB; put long tables into CSV files", limit / 1'000'000));
  return text;
}

DocumentValue parse_toml(const std::string& text, const std::string& file) {
  if (text.find_first_not_of(" \t\r\n") == std::string::npos)
    throw SceneError({{file, {}, "is empty; a scene needs at least `line` and the tables of its components"}});
  try {
    return convert(toml::parse(text, file));
  } catch (const toml::parse_error& error) {
    throw SceneError({{file, location(error.source()), fmt::format("not TOML: {}", error.description())}});
  }
}

}  // namespace kurbel
