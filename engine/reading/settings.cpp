// settings.cpp — settings as edits of a scene's text, and the locations of faults in them.
#include "engine/reading/settings.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <utility>

#include "engine/scene/keys.h"
#include "engine/scene/text.h"

namespace kurbel {
namespace {

constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";

// Lines and columns count from 1, columns in characters.
std::size_t offset_of(std::string_view text, Location at) {
  std::size_t i = text.starts_with(byte_order_mark) ? byte_order_mark.size() : 0;
  for (int line = 1; line < at.line; ++line) i = std::min(text.find('\n', i), text.size() - 1) + 1;
  for (int column = 1; column < at.column && i < text.size(); ++column) do
      ++i;
    while (i < text.size() && !begins_character(text[i]));
  return i;
}

Location location_of(std::string_view text, std::size_t offset) {
  Location at{1, 1};
  for (std::size_t i = text.starts_with(byte_order_mark) ? byte_order_mark.size() : 0; i < offset && i < text.size();
       ++i) {
    if (text[i] == '\n')
      at = {at.line + 1, 1};
    else if (begins_character(text[i]))
      ++at.column;
  }
  return at;
}

// A text as TOML writes it.
std::string in_toml(std::string_view text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\')
      out += '\\', out += c;
    else if (static_cast<unsigned char>(c) < 0x20 || c == 0x7F)
      out += fmt::format("\\u{:04X}", static_cast<unsigned>(c));
    else
      out += c;
  }
  return out + '"';
}

// "0.5", "true", "[1, 2]", "{ kind = \"none\" }" are used as they are; values unknown to TOML are texts.
bool is_toml_value(const std::string& value) {
  if (value.find('\n') != std::string::npos || value.find('#') != std::string::npos) return false;
  try {
    const DocumentValue read = parse_toml("v = " + value, "");
    return read.entries.size() == 1 && read.entries[0].key == "v" &&
           read.entries[0].value.type != DocumentValue::Type::other;
  } catch (const SceneError&) {
    return false;
  }
}

std::vector<std::string> keys_of(const DocumentValue& table) {
  std::vector<std::string> keys;
  for (const DocumentEntry& entry : table.entries) keys.push_back(entry.key);
  return keys;
}

// A key that TOML takes without quotes.
std::string as_key(const std::string& name) {
  const bool bare = !name.empty() && std::all_of(name.begin(), name.end(), [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-';
  });
  return bare ? name : in_toml(name);
}

}  // namespace

Message SettledText::in_setting(std::size_t setting, std::size_t place, const std::string& text) const {
  const std::string& own = settings_[setting];
  return {fmt::format("--set {}", in_quotes(own)), location_of(own, std::min(place, own.size())), text};
}

void SettledText::refuse(std::size_t setting, std::size_t place, const std::string& why) const {
  throw SceneError({in_setting(setting, place, why)});
}

SettledText::SettledText(const std::string& text, const std::string& file, const std::vector<std::string>& settings)
    : text_(text), file_(file), before_(text), settings_(settings) {
  if (settings.empty()) return;
  // The last one of a key counts.
  std::map<std::vector<Segment>, std::size_t> last;
  for (std::size_t k = 0; k < settings.size(); ++k) last[path_of(k)] = k;
  for (std::size_t k = 0; k < settings.size(); ++k)
    if (last.at(path_of(k)) == k) edits_.push_back(edit_of(k));
  std::stable_sort(edits_.begin(), edits_.end(), [](const Edit& a, const Edit& b) { return a.begin < b.begin; });
  text_.clear();
  std::size_t from = 0;
  for (Edit& edit : edits_) {
    if (edit.begin < from) refuse(edit.setting, 0, "lies within what another --set gives; give one of them");
    text_.append(text, from, edit.begin - from);
    edit.settled_begin = text_.size();
    text_ += edit.by;
    from = edit.begin + edit.length;
  }
  text_.append(text, from);
  if (!text_.ends_with('\n')) text_ += '\n';
  for (const std::string& setting : settings) text_ += "# set beside the file: " + in_toml(setting) + "\n";
}

std::vector<SettledText::Segment> SettledText::path_of(std::size_t setting) const {
  const std::string& own = settings_[setting];
  const std::size_t equals = own.find('='), first = own.find_first_not_of(" \t");
  if (equals == std::string::npos)
    refuse(setting, own.size(), "no value; write COMPONENT.KEY=VALUE, e.g. main_coupling.stiffness=1 MN*m/rad");
  std::size_t path_end = equals;
  while (path_end > first && (own[path_end - 1] == ' ' || own[path_end - 1] == '\t')) --path_end;
  std::vector<Segment> path;
  for (std::size_t i = first, dot = 0; i <= path_end; i = dot + 1) {
    dot = std::min(own.find('.', i), path_end);
    Segment segment{own.substr(i, dot - i), i, 0};
    if (const std::size_t bracket = segment.name.find('['); bracket != std::string::npos) {
      const std::string number = segment.name.substr(bracket + 1);
      if (number.size() < 2 || number.size() > 8 || number.back() != ']' || number[0] == '0' ||
          number.find_first_not_of("0123456789") != number.size() - 1)
        refuse(setting, i + bracket, "an item of a list is written [1], [2], …");
      segment.item = std::stoi(number);
      segment.name.resize(bracket);
    }
    if (segment.name.empty()) refuse(setting, i, "a name is missing; write COMPONENT.KEY=VALUE");
    path.push_back(std::move(segment));
  }
  return path;
}

SettledText::Edit SettledText::edit_of(std::size_t setting) {
  const std::vector<Segment> path = path_of(setting);
  const std::string& own = settings_[setting];
  const std::size_t value_at = std::min(own.find_first_not_of(" \t", own.find('=') + 1), own.size());
  std::string value(trimmed(std::string_view(own).substr(value_at), " \t"));
  const bool is_text = !value.empty() && !is_toml_value(value);
  if (is_text) value = in_toml(value);

  const DocumentValue document = parse_toml(before_, file_);
  const DocumentValue* table = &document;
  for (std::size_t k = 0;; ++k) {
    const DocumentEntry* entry = table->find(path[k].name);
    Edit edit;
    if (!entry) {
      if (value.empty())
        refuse(setting, path[k].place, fmt::format("there is no {} to take away", in_quotes(path[k].name)));
      edit = brought_in(setting, {path.begin() + static_cast<std::ptrdiff_t>(k), path.end()}, document, *table, value);
    } else {
      const DocumentValue& found = item_of(setting, path[k], entry->value);
      if (k + 1 < path.size()) {
        if (found.type != DocumentValue::Type::table)
          refuse(setting, path[k + 1].place,
                 fmt::format("{} is no table but {}", in_quotes(path[k].name), found.describe()));
        table = &found;
        continue;
      }
      edit = value.empty() ? taken_away(setting, path[k], *entry, table == &document ? nullptr : table)
                           : replaced(setting, path[k], found, value);
    }
    edit.setting = setting;
    edit.quoted = is_text;
    return edit;
  }
}

const DocumentValue& SettledText::item_of(std::size_t setting, const Segment& segment,
                                          const DocumentValue& value) const {
  if (segment.item == 0) return value;
  if (value.type != DocumentValue::Type::list)
    refuse(setting, segment.place, fmt::format("{} is no list but {}", in_quotes(segment.name), value.describe()));
  if (segment.item > static_cast<int>(value.items.size()))
    refuse(setting, segment.place, fmt::format("{} has {} items", in_quotes(segment.name), value.items.size()));
  return value.items[static_cast<std::size_t>(segment.item) - 1];
}

// Missing parts of the path are added with dots; a missing section is added after all others, so that no line of the file
// moves.
SettledText::Edit SettledText::brought_in(std::size_t setting, const std::vector<Segment>& missing,
                                          const DocumentValue& document, const DocumentValue& table,
                                          const std::string& value) {
  const Segment& first = missing.front();
  const bool is_root = &table == &document;
  if (is_root) check_section(setting, first, document);
  if (first.item > 0) refuse(setting, first.place, fmt::format("there is no list {}", in_quotes(first.name)));
  std::string name;
  for (std::size_t m = is_root && missing.size() > 1 ? 1 : 0; m < missing.size(); ++m)
    name += (name.empty() ? "" : ".") + as_key(missing[m].name);
  std::string before, behind;
  const std::size_t begin = is_root ? 0 : offset_of(before_, table.at);
  Edit edit;
  if (is_root && missing.size() > 1) {
    edit.begin = before_.size();
    before = begun_.insert(first.name).second ? "\n[" + as_key(first.name) + "]\n" : "\n";
  } else if (is_root) {
    edit.begin = before_.starts_with(byte_order_mark) ? byte_order_mark.size() : 0;
    behind = "\n";
  } else if (begin < before_.size() && before_[begin] == '{') {
    edit.begin = begin + 1;
    const bool alone = table.entries.empty();
    before = alone && !begun_.insert(std::to_string(begin)).second ? ", " : " ";
    if (!alone) behind = ",";
  } else if (begin < before_.size() && before_[begin] == '[') {
    edit.begin = std::min(before_.find('\n', begin), before_.size());
    before = "\n";
  } else {
    refuse(setting, first.place,
           fmt::format("{} is not there, and its table is written with dots; write it into the scene",
                       in_quotes(first.name)));
  }
  before += name + " = ";
  edit.key = missing.back().place;
  edit.value = before.size();
  edit.by = before + value + behind;
  return edit;
}

// Components are not made here.
void SettledText::check_section(std::size_t setting, const Segment& first, const DocumentValue& document) const {
  const std::vector<std::string> sections = {"title", "run", "effects", "sequence", "operation"};
  if (std::find(sections.begin(), sections.end(), first.name) != sections.end()) return;
  const std::vector<std::string> names = keys_of(document);
  refuse(setting, first.place,
         fmt::format("the scene has no {}{}; it has: {}", in_quotes(first.name), suggestion(first.name, names),
                     listed(names, "and")));
}

SettledText::Edit SettledText::replaced(std::size_t setting, const Segment& segment, const DocumentValue& found,
                                        const std::string& value) const {
  const std::size_t begin = offset_of(before_, found.at), end = offset_of(before_, found.end);
  if (found.type == DocumentValue::Type::table && (begin >= before_.size() || before_[begin] != '{'))
    refuse(
        setting, segment.place,
        fmt::format("{} is a table; set one of its keys: {}", in_quotes(segment.name), listed(keys_of(found), "and")));
  Edit edit;
  edit.begin = begin, edit.length = end - begin;
  edit.by = value;
  return edit;
}

// In an inline table including its comma; `table` is null at the root.
SettledText::Edit SettledText::taken_away(std::size_t setting, const Segment& segment, const DocumentEntry& entry,
                                          const DocumentValue* table) const {
  if (segment.item > 0) refuse(setting, segment.place, "an item of a list cannot be taken away; give the whole list");
  const std::size_t key = offset_of(before_, entry.at), end = offset_of(before_, entry.value.end);
  if (entry.value.type == DocumentValue::Type::table && before_[offset_of(before_, entry.value.at)] != '{')
    refuse(setting, segment.place, fmt::format("{} is a table; take away its keys", in_quotes(segment.name)));
  Edit edit;
  edit.begin = key, edit.length = end - key;
  if (!table || before_[offset_of(before_, table->at)] != '{') return edit;
  const char* const blanks = " \t\r\n";
  const std::size_t next = before_.find_first_not_of(blanks, end), previous = before_.find_last_not_of(blanks, key - 1);
  if (next != std::string::npos && before_[next] == ',')
    edit.length = next + 1 - key;
  else if (before_[previous] == ',')
    edit.begin = previous, edit.length = end - previous;
  return edit;
}

Message SettledText::placed(const Message& message) const {
  if (message.at.line <= 0 || message.file != file_) return message;
  const std::size_t offset = offset_of(text_, message.at);
  std::size_t shift = 0;  // offset of the settled text, modulo its size
  for (const Edit& edit : edits_) {
    if (offset < edit.settled_begin) break;
    if (offset < edit.settled_begin + edit.by.size()) {
      const std::string& own = settings_[edit.setting];
      const std::size_t within = offset - edit.settled_begin, equals = own.find('=');
      if (within < edit.value) return in_setting(edit.setting, edit.key, message.text);
      const std::size_t value = std::min(own.find_first_not_of(" \t", equals + 1), own.size());
      return in_setting(edit.setting, value + (edit.quoted ? 0 : within - edit.value), message.text);
    }
    shift = edit.settled_begin + edit.by.size() - edit.begin - edit.length;
  }
  return {message.file, location_of(before_, std::min(offset - shift, before_.size())), message.text};
}

SceneError SettledText::placed(const SceneError& error) const {
  if (edits_.empty()) return error;
  std::vector<Message> messages;
  for (const Message& message : error.messages) messages.push_back(placed(message));
  return SceneError(std::move(messages));
}

}  // namespace kurbel
