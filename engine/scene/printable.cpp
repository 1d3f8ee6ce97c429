// printable.cpp — character by character of UTF-8.
#include "engine/scene/printable.h"

#include <fmt/format.h>

namespace kurbel {
namespace {

struct Character {
  char32_t code = 0;  // bad: what begins here is no UTF-8
  std::size_t bytes = 1;
};
constexpr char32_t bad = 0xFFFFFFFF;

Character character_at(std::string_view text, std::size_t i) {
  const auto byte = [&](std::size_t k) { return static_cast<unsigned char>(text[i + k]); };
  const unsigned char first = byte(0);
  if (first < 0x80) return {first, 1};
  const std::size_t bytes = first >= 0xC2 && first < 0xE0 ? 2 : first >= 0xE0 && first < 0xF0 ? 3 : 4;
  if (first < 0xC2 || first > 0xF4 || i + bytes > text.size()) return {bad, 1};
  char32_t code = first & (0x7Fu >> bytes);
  for (std::size_t k = 1; k < bytes; ++k) {
    if ((byte(k) & 0xC0) != 0x80) return {bad, 1};
    code = code << 6 | (byte(k) & 0x3Fu);
  }
  constexpr char32_t least[] = {0, 0, 0x80, 0x800, 0x10000};
  if (code < least[bytes] || code > 0x10FFFF || (code >= 0xD800 && code < 0xE000)) return {bad, 1};
  return {code, bytes};
}

// What a terminal may obey: C0 and C1, line and paragraph separators, marks that turn the direction of writing.
bool is_obeyed(char32_t c) {
  return c < 0x20 || (c >= 0x7F && c < 0xA0) || c == 0x200E || c == 0x200F || (c >= 0x2028 && c <= 0x202E) ||
         (c >= 0x2066 && c <= 0x2069);
}

// The text with what a terminal may obey replaced by words, which `shown` gives for the code, and for the byte where it
// is no UTF-8.
template <class Shown>
std::string harmless(std::string_view text, std::string_view kept, const Shown& shown) {
  std::string out;
  out.reserve(text.size());
  for (std::size_t i = 0; i < text.size();) {
    const Character c = character_at(text, i);
    if (c.code == bad || (is_obeyed(c.code) && kept.find(text[i]) == std::string_view::npos))
      out += shown(c.code, static_cast<unsigned char>(text[i]));
    else
      out += text.substr(i, c.bytes);
    i += c.bytes;
  }
  return out;
}

std::string in_words(char32_t code, unsigned char byte) {
  if (code == '\n') return "\\n";
  if (code == '\t') return "\\t";
  if (code == '\r') return "\\r";
  if (code == bad) return fmt::format("\\x{:02X}", byte);
  return code < 0x100 ? fmt::format("\\x{:02X}", static_cast<unsigned>(code))
                      : fmt::format("\\u{:04X}", static_cast<unsigned>(code));
}

}  // namespace

std::string printable(std::string_view text) { return harmless(text, "", in_words); }
std::string printable_lines(std::string_view text) { return harmless(text, "\n\t", in_words); }
std::string printable_json(std::string_view json) {
  return harmless(json, "\n\t", [](char32_t code, unsigned char) {
    return fmt::format("\\u{:04x}", code == bad ? 0xFFFDu : static_cast<unsigned>(code));
  });
}

}  // namespace kurbel
