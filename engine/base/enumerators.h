// enumerators.h — names of enumerators as texts, taken from the source.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <string_view>
#include <utility>

namespace kurbel {
namespace enumerators_detail {

// "at_rest" of Orbit::Kind::at_rest, zero-terminated, with `underscore` in place of its underscores.
template <auto value, char underscore>
constexpr auto text() {
  constexpr std::string_view signature = __PRETTY_FUNCTION__;  // "… [with auto value = kurbel::Method::bdf; char …]"
  constexpr std::size_t end = signature.find_first_of(";,]", signature.find("value = ")),
                        begin = signature.rfind(':', end) + 1;
  static_assert(begin > 1 && begin < end && end != std::string_view::npos);
  std::array<char, end - begin + 1> name{};
  std::replace_copy(signature.begin() + begin, signature.begin() + end, name.begin(), '_', underscore);
  return name;
}
template <auto value, char underscore>
inline constexpr auto text_of = text<value, underscore>();

template <auto last, char underscore>
inline constexpr auto names = []<std::size_t... k>(std::index_sequence<k...>) {
  return std::array<const char*, sizeof...(k)>{text_of<static_cast<decltype(last)>(k), underscore>.data()...};
}
(std::make_index_sequence<static_cast<std::size_t>(last) + 1>());

}  // namespace enumerators_detail

// For an enum with enumerators from 0 to `last`: "at_rest", and in words "at rest".
template <auto last>
constexpr const char* enumerator_name(decltype(last) value) {
  return enumerators_detail::names<last, '_'>[static_cast<std::size_t>(value)];
}
template <auto last>
constexpr const char* enumerator_words(decltype(last) value) {
  return enumerators_detail::names<last, ' '>[static_cast<std::size_t>(value)];
}

}  // namespace kurbel
