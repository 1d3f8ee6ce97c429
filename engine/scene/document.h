// document.h — a scene file as a tree of values with their locations in the file. TOML only, independent of machines.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "engine/scene/messages.h"
#include "engine/scene/units.h"

namespace kurbel {

struct DocumentEntry;

// Result of a text with a computation: "= 2*p0".
struct Computed {
  Quantity quantity;
  bool faulty = false;  // a fault of it is already reported
  bool zero = false;    // plain 0, for any dimension
};

struct DocumentValue {
  enum class Type { flag, integer, number, text, list, table, other };
  Type type = Type::table;
  Location at, end = {};  // of its first character, and after its last
  bool flag = false;
  std::int64_t integer = 0;
  double number = 0;
  std::string text = {};
  std::vector<DocumentValue> items = {};                                  // of a list
  std::vector<DocumentEntry> entries;                                     // of a table, in the order of the file
  std::shared_ptr<const Computed> computed = {};                          // of a text with a computation
  std::shared_ptr<const std::map<std::string, Quantity>> constants = {};  // for the formulas of a table

  const DocumentEntry* find(std::string_view key) const;
  std::string describe() const;  // as in the file: 12, "abc", true; "a list", "a table"
};

struct DocumentEntry {
  std::string key;
  Location at;  // of the key
  DocumentValue value;
};

// Maximum size of a scene file.
inline constexpr std::size_t max_scene_bytes = 16'000'000;

// The text of a file. Throws SceneError if it is missing, unreadable, larger than `limit`, or not a regular file: reading
// a pipe could block forever.
std::string read_text_file(const std::string& path, std::size_t limit);

// Whether a file is in a folder or below it, with links resolved; also true if this is undetermined, as the file cannot be
// opened either.
bool lies_below(const std::filesystem::path& folder, const std::filesystem::path& file);

// Throws SceneError with line and column for text that is not TOML.
DocumentValue parse_toml(const std::string& text, const std::string& file);

}  // namespace kurbel
