// study_options.cpp — texts of options into what studies take.
#include "library/study_options.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <sstream>
#include <stdexcept>

#include "library/option_values.h"

namespace kurbel {

std::string AskedOptions::text(const std::string& name) {
  known_.push_back(name);
  for (const auto& [given, value] : given_)
    if (given == name) return value;
  return {};
}

bool AskedOptions::flag(const std::string& name) {
  const std::string value = text(name);
  if (value.empty() || value == "false") return false;
  if (value == "true") return true;
  throw std::invalid_argument(fmt::format("{} = {}: must be true or false", name, in_quotes(value)));
}

std::optional<int> AskedOptions::whole(const std::string& name, int least, int most) {
  const std::string value = text(name);
  if (value.empty()) return {};
  int number = 0;
  const char* const end = value.data() + value.size();
  const auto read = std::from_chars(value.data(), end, number);
  if (read.ec != std::errc{} || read.ptr != end || number < least || number > most)
    throw std::invalid_argument(
        fmt::format("{} = {}: must be a whole number, {} … {}", name, in_quotes(value), least, most));
  return number;
}

std::optional<double> AskedOptions::quantity(const std::string& name, const std::string& what,
                                             const std::string& example, const Domain& domain) {
  const std::string value = text(name);
  if (value.empty()) return {};
  return quantity_of(name, value, what, example, domain);
}

std::vector<std::string> AskedOptions::names(const std::string& name) {
  std::vector<std::string> list;
  std::stringstream stream(text(name));
  for (std::string one; std::getline(stream, one, ',');)
    if (!one.empty()) list.push_back(one);
  return list;
}

std::optional<Effects> AskedOptions::effects(const std::string& name, const Scene& scene) {
  const std::string value = text(name);
  if (value.empty()) return {};
  return parse_effects(value, scene);
}

void AskedOptions::refuse_others() const {
  for (const auto& [name, value] : given_)
    if (std::find(known_.begin(), known_.end(), name) == known_.end())
      throw std::invalid_argument(fmt::format("{} has no option {}; it has {}{}", study_, in_quotes(name),
                                              known_.empty() ? "none" : listed(known_, "and"),
                                              suggestion(name, known_)));
}

}  // namespace kurbel
