// named.h — the entry of a list that the user names. If there is none, std::invalid_argument says so by `none`, with {0} for
// the name in quotes, {1} for "did you mean", {2} for all names.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <string>
#include <vector>

#include "engine/scene/keys.h"
#include "engine/scene/messages.h"

namespace kurbel {

using NoneOfThatName = fmt::format_string<std::string, std::string, std::string>;

inline void check_name(const std::vector<std::string>& names, const std::string& wanted, NoneOfThatName none) {
  if (std::find(names.begin(), names.end(), wanted) == names.end())
    throw std::invalid_argument(fmt::format(none, in_quotes(wanted), suggestion(wanted, names), listed(names)));
}

template <class T, class Base>
const T& named(const std::vector<T>& list, std::string Base::*name, const std::string& wanted, NoneOfThatName none) {
  std::vector<std::string> names;
  for (const T& one : list) {
    if (one.*name == wanted) return one;
    names.push_back(one.*name);
  }
  check_name(names, wanted, none);
  return list.front();
}

}  // namespace kurbel
