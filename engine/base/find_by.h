// find_by.h — the entry of a list by the value of one of its members; null: none.
#pragma once

#include <iterator>

namespace kurbel {

template <class List, class Entry, class Member, class Value>
constexpr auto find_by(List& list, Member Entry::*member, const Value& value) -> decltype(std::data(list)) {
  for (auto& one : list)
    if (one.*member == value) return &one;
  return nullptr;
}

}  // namespace kurbel
