// table_text.cpp — encodings and ends of lines.
#include "engine/tables/table_text.h"

#include <fmt/format.h>

#include <cstdint>
#include <string_view>

#include "engine/scene/document.h"
#include "engine/scene/text.h"
#include "engine/tables/spreadsheet.h"

namespace kurbel {
namespace {

void append_utf8(std::string& text, std::uint32_t c) {
  const auto follow = [&](int shift) { text += static_cast<char>(0x80 | ((c >> shift) & 0x3F)); };
  if (c < 0x80) {
    text += static_cast<char>(c);
  } else if (c < 0x800) {
    text += static_cast<char>(0xC0 | (c >> 6)), follow(0);
  } else if (c < 0x10000) {
    text += static_cast<char>(0xE0 | (c >> 12)), follow(6), follow(0);
  } else {
    text += static_cast<char>(0xF0 | (c >> 18)), follow(12), follow(6), follow(0);
  }
}

// What belongs to no pair is shown as such (U+FFFD).
std::string from_utf16(std::string_view bytes, bool little_endian) {
  const auto unit = [&](std::size_t i) -> std::uint32_t {
    const auto first = static_cast<unsigned char>(bytes[i]), second = static_cast<unsigned char>(bytes[i + 1]);
    return little_endian ? first | second << 8 : first << 8 | second;
  };
  std::string text;
  for (std::size_t i = 0; i + 1 < bytes.size(); i += 2) {
    std::uint32_t c = unit(i);
    if (c >= 0xD800 && c < 0xDC00 && i + 3 < bytes.size() && unit(i + 2) >= 0xDC00 && unit(i + 2) < 0xE000) {
      c = 0x10000 + ((c - 0xD800) << 10) + (unit(i + 2) - 0xDC00);
      i += 2;
    } else if (c >= 0xD800 && c < 0xE000) {
      c = 0xFFFD;
    }
    append_utf8(text, c);
  }
  return text;
}

bool is_utf8(std::string_view text) {
  for (std::size_t i = 0; i < text.size();) {
    const auto lead = static_cast<unsigned char>(text[i++]);
    const int more = lead < 0x80                   ? 0
                     : lead >= 0xC2 && lead < 0xE0 ? 1
                     : lead >= 0xE0 && lead < 0xF0 ? 2
                     : lead >= 0xF0 && lead < 0xF5 ? 3
                                                   : -1;
    if (more < 0 || i + static_cast<std::size_t>(more) > text.size()) return false;
    for (int k = 0; k < more; ++k)
      if (begins_character(text[i++])) return false;
  }
  return true;
}

std::string from_latin_1(std::string_view bytes) {
  std::string text;
  for (const char c : bytes) append_utf8(text, static_cast<unsigned char>(c));
  return text;
}

// Text in UTF-16 without a mark: its ASCII characters leave every other byte zero.
std::string in_utf8(std::string bytes, const std::string& path) {
  if (bytes.starts_with("\xEF\xBB\xBF")) bytes.erase(0, 3);
  if (bytes.starts_with("\xFF\xFE")) return from_utf16(std::string_view(bytes).substr(2), true);
  if (bytes.starts_with("\xFE\xFF")) return from_utf16(std::string_view(bytes).substr(2), false);
  if (bytes.size() > 3 && bytes[1] == 0 && bytes[3] == 0 && bytes[0] != 0) return from_utf16(bytes, true);
  if (bytes.size() > 3 && bytes[0] == 0 && bytes[2] == 0 && bytes[1] != 0) return from_utf16(bytes, false);
  if (bytes.starts_with("\xD0\xCF\x11\xE0"))
    throw SceneError({{path, {1, 1}, "is an old .xls file; save it as .xlsx or .csv"}});
  if (const std::size_t nul = bytes.find('\0'); nul != std::string::npos)
    throw SceneError(
        {{path, {1, 1}, fmt::format("is no table: byte {} is zero, as in no text; give .csv or .xlsx", nul + 1)}});
  return is_utf8(bytes) ? bytes : from_latin_1(bytes);
}

}  // namespace

TableText read_table_text(const std::string& path, const std::string& sheet) {
  std::string bytes = read_text_file(path, max_table_bytes);
  if (is_archive(bytes) || path.ends_with(".mat")) return {sheet_as_text(bytes, sheet, path, max_table_bytes), true};
  if (!sheet.empty())
    throw SceneError(
        {{path, {}, fmt::format("is no .xlsx file, and has no sheet {}; drop the key", in_quotes(sheet))}});
  std::string text = in_utf8(std::move(bytes), path);
  if (text.find('\n') == std::string::npos)
    for (char& c : text)
      if (c == '\r') c = '\n';
  return {std::move(text)};
}

std::string cell_name(int row, int column) {
  std::string name;
  for (; column > 0; column = (column - 1) / 26) name.insert(name.begin(), static_cast<char>('A' + (column - 1) % 26));
  return name + std::to_string(row);
}

}  // namespace kurbel
