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
  const std::vector<std::string> all = texts(name);
  if (all.size() > 1) throw std::invalid_argument(fmt::format("{} is given {} times; give one", name, all.size()));
  return all.empty() ? "" : all.front();
}

std::vector<std::string> AskedOptions::texts(const std::string& name) {
  known_.push_back(name);
  std::vector<std::string> all;
  for (const auto& [given, value] : given_)
    if (given == name) all.push_back(value);
  return all;
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
  for (const std::string& some : texts(name)) {
    std::stringstream stream(some);
    for (std::string one; std::getline(stream, one, ',');)
      if (!one.empty()) list.push_back(one);
  }
  return list;
}

std::vector<double> AskedOptions::numbers(const std::string& name, double least, double most) {
  std::vector<double> all;
  for (const std::string& one : names(name)) {
    double number = 0;
    const char* const end = one.data() + one.size();
    const auto read = std::from_chars(one.data(), end, number);
    if (read.ec != std::errc{} || read.ptr != end || !(number >= least && number <= most))
      throw std::invalid_argument(
          fmt::format("{} = {}: must be numbers, {:g} … {:g}", name, in_quotes(one), least, most));
    all.push_back(number);
  }
  return all;
}

std::vector<double> AskedOptions::quantities(const std::string& name, const std::string& what,
                                             const std::string& example, const Domain& domain) {
  std::vector<double> all;
  for (const std::string& one : names(name)) all.push_back(quantity_of(name, one, what, example, domain));
  return all;
}

std::optional<Effects> AskedOptions::effects(const std::string& name, const Scene& scene) {
  const std::vector<std::string> all = names(name);
  if (all.empty()) return {};
  return parse_effects(fmt::format("{}", fmt::join(all, ",")), scene);
}

void AskedOptions::refuse_others() const {
  for (const auto& [name, value] : given_)
    if (std::find(known_.begin(), known_.end(), name) == known_.end())
      throw std::invalid_argument(fmt::format("{} has no option {}; it has {}{}", study_, in_quotes(name),
                                              known_.empty() ? "none" : listed(known_, "and"),
                                              suggestion(name, known_)));
}

}  // namespace kurbel
