// document.h — a scene file as a tree of values, each with its place in the file. Knows TOML, knows no machine.
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

// What a text is that says how it is computed: "= 2*p0".
struct Computed {
  Quantity quantity;
  bool faulty = false;  // something was said about it already
  bool zero = false;    // just 0, of any dimension
};

struct DocumentValue {
  enum class Type { flag, integer, number, text, list, table, other };
  Type type = Type::table;
  Location at, end = {};  // of its first character, and behind its last
  bool flag = false;
  std::int64_t integer = 0;
  double number = 0;
  std::string text = {};
  std::vector<DocumentValue> items = {};                                  // of a list
  std::vector<DocumentEntry> entries;                                     // of a table, in the order of the file
  std::shared_ptr<const Computed> computed = {};                          // of such a text
  std::shared_ptr<const std::map<std::string, Quantity>> constants = {};  // that a table's formula may use

  const DocumentEntry* find(std::string_view key) const;
  std::string describe() const;  // as in the file: 12, "abc", true; "a list", "a table"
};

struct DocumentEntry {
  std::string key;
  Location at;  // of the key
  DocumentValue value;
};

// Largest scene file that is read; anything bigger is no scene.
inline constexpr std::size_t max_scene_bytes = 16'000'000;

// The text of a file. Throws SceneError if it is missing, unreadable, larger than `limit`, or no regular file: a pipe
// may keep its reader waiting for ever.
std::string read_text_file(const std::string& path, std::size_t limit);

// Whether a file lies in a folder or below it, links followed; true as well where that cannot be told, because the file
// cannot be opened either.
bool lies_below(const std::filesystem::path& folder, const std::filesystem::path& file);

// Throws SceneError with line and column on text that is not TOML.
DocumentValue parse_toml(const std::string& text, const std::string& file);

}  // namespace kurbel
