// option_values.cpp — converts option texts to values, with the allowed form if invalid.
#include "studies/question/option_values.h"

#include <fmt/format.h>

#include <stdexcept>

#include "engine/scene/messages.h"
#include "engine/scene/units.h"
#include "engine/values/quantity_reader.h"

namespace kurbel {

double quantity_of(const std::string& option, const std::string& text, const std::string& what,
                   const std::string& example, const Domain& domain) {
  UnitError error;
  auto value = parse_quantity(text, error);
  if (!value)
    throw std::invalid_argument(
        fmt::format("{} {}: {}; write e.g. \"{}\"", option, in_quotes(text), error.text, example));
  const Dimension wanted = parse_quantity(example, error)->dimension;
  value = wanted_as(*value, wanted);
  if (value->dimension != wanted || !domain.contains(value->value))
    throw std::invalid_argument(fmt::format("{} {}: must be {}{}, e.g. \"{}\"", option, in_quotes(text), what,
                                            wanted == Dimension{} ? "" : " with its unit", example));
  if (const std::string allowed = size_allowed(value->value, value->dimension, domain); !allowed.empty())
    throw std::invalid_argument(
        fmt::format("{} {}: must be {}; check its unit and power of ten", option, in_quotes(text), allowed));
  return value->value;
}

Moment moment_of(const std::string& option, const std::string& at, std::optional<double>& speed) {
  Moment moment;
  const std::string example = "\"step 2\", a time such as \"1.5 s\", or a speed such as \"60 rpm\"";
  if (at.starts_with("step ")) {
    const std::string number = at.substr(5);
    if (number.empty() || number.size() > 6 || number.find_first_not_of("0123456789") != std::string::npos)
      throw std::invalid_argument(fmt::format("{} {}: must be {}", option, in_quotes(at), example));
    moment.after_step = std::stoul(number);
    return moment;
  }
  UnitError error;
  const auto value = parse_quantity(at, error);
  const auto is = [&](const char* like) { return value->dimension == parse_quantity(like, error)->dimension; };
  if (!value)
    throw std::invalid_argument(fmt::format("{} {}: {}; must be {}", option, in_quotes(at), error.text, example));
  if (is("1 s") && value->value >= 0) {
    moment.time = value->value;
  } else if (is("1 rad/s") && value->value != 0) {
    speed = value->value;
  } else {
    throw std::invalid_argument(fmt::format("{} {}: must be {}", option, in_quotes(at), example));
  }
  return moment;
}

}  // namespace kurbel
