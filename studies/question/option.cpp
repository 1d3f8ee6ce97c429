// option.cpp — converts option texts to values; messages for invalid ones.
#include "studies/question/option.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <sstream>
#include <stdexcept>

#include "engine/scene/messages.h"
#include "engine/scene/scene.h"
#include "engine/scene/units.h"
#include "engine/values/quantity_reader.h"
#include "studies/question/range.h"

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

void check_example(const OptionText& option) {
  UnitError error;
  const auto example = parse_quantity(option.example, error);
  if (!example || !option.domain.contains(example->value))
    throw std::logic_error(fmt::format("option \"{}\" is a quantity; its example {} is none that it accepts",
                                       option.name, in_quotes(option.example)));
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

std::string OptionValues::label() const {
  std::string name = option_.text.name;
  std::replace(name.begin(), name.end(), '_', '-');
  return "--" + name;
}

const std::string& OptionValues::text() const { return texts_.front(); }

void OptionValues::refuse(const std::string& text, const std::string& must) const {
  throw std::invalid_argument(fmt::format("{} {}: must be {}", label(), in_quotes(text), must));
}

double OptionValues::quantity(const std::string& text) const {
  check_example(option_.text);
  return quantity_of(label(), text, option_.text.what, option_.text.example, option_.text.domain);
}

Moment OptionValues::moment(std::optional<double>& speed) const { return moment_of(label(), text(), speed); }

void OptionValues::read(double& value) const { value = quantity(text()); }

void OptionValues::read(std::vector<double>& value) const {
  value.clear();
  for (const std::string& one : texts_) value.push_back(quantity(one));
}

std::pair<double, double> OptionValues::range() const {
  std::vector<double> ends;
  read(ends);
  if (!(ends[0] < ends[1])) refuse(text(), "the lesser value first");
  return {ends[0], ends[1]};
}

void OptionValues::read(Effects& value) const { value = parse_effects(text(), scene_); }

std::int64_t OptionValues::whole() const {
  std::int64_t number = 0;
  const char* const end = text().data() + text().size();
  const auto read = std::from_chars(text().data(), end, number);
  const Domain& domain = option_.text.domain;
  const bool is_whole = read.ec == std::errc{} && read.ptr == end;
  if (!is_whole || !domain.contains(static_cast<double>(number)))
    refuse(text(), fmt::format("{}{} … {}", is_whole ? "" : "a whole number, ", domain.low, domain.high));
  return number;
}

std::vector<std::optional<OptionValues>> values_of(const std::vector<DeclaredOption>& options,
                                                   const GivenOptions& given, const std::string& question,
                                                   const Scene& scene) {
  std::vector<std::string> names;
  for (const DeclaredOption& option : options) names.push_back(option.text.name);
  for (const auto& [name, value] : given)
    if (std::find(names.begin(), names.end(), name) == names.end())
      throw std::invalid_argument(fmt::format("{} has no option {}; it has {}{}", question, in_quotes(name),
                                              names.empty() ? "none" : listed(names, "and"), suggestion(name, names)));
  std::vector<std::optional<OptionValues>> all(options.size());
  for (std::size_t k = 0; k < options.size(); ++k) {
    const DeclaredOption& option = options[k];
    std::vector<std::string> texts;
    for (const auto& [name, value] : given) {
      if (name != option.text.name || value.empty()) continue;
      if (option.form != OptionForm::several || option.text.each_time) {
        texts.push_back(value);
        continue;
      }
      std::stringstream stream(value);
      for (std::string one; std::getline(stream, one, ',');)
        if (!one.empty()) texts.push_back(one);
    }
    if (texts.size() == 1 && option.text.count == 2)
      if (const auto ends = range_ends(texts.front())) texts.assign(ends->begin(), ends->end());
    if (texts.empty() && !option.text.required) continue;
    const OptionValues values(option, texts, scene);
    if (texts.empty()) throw std::invalid_argument(fmt::format("{} needs {}", question, values.label()));
    if (option.form != OptionForm::several && texts.size() > 1)
      throw std::invalid_argument(fmt::format("{} is given {} times; give one", values.label(), texts.size()));
    const int most = option.text.count, number = static_cast<int>(texts.size());
    if (most > 0 && (number > most || number < (option.text.least > 0 ? option.text.least : most)))
      values.refuse(fmt::format("{}", fmt::join(texts, " ")), option.text.what);
    if (option.form == OptionForm::flag && texts.front() != "true" && texts.front() != "false")
      values.refuse(texts.front(), "true or false");
    if (option.form != OptionForm::flag || texts.front() == "true") all[k].emplace(values);
  }
  return all;
}

}  // namespace kurbel
