// limit.cpp — limits on figures, and confidence of the count of those that hold.
#include "studies/sweep/limit.h"

#include <fmt/format.h>

#include <algorithm>
#include <boost/math/distributions/binomial.hpp>
#include <cmath>
#include <stdexcept>

#include "engine/base/find_by.h"
#include "engine/scene/keys.h"
#include "engine/scene/messages.h"
#include "engine/scene/units.h"
#include "studies/sweep/influence.h"

namespace kurbel {

Side side_of(const FigureLimit& limit, const SweepRow& row) {
  const auto [value, known] = figure_in(row, limit.figure);
  if (!std::isfinite(value)) return Side::unknown;
  const double beyond = limit.from_above ? value - limit.value : limit.value - value;
  const double error = known.value_or(0);
  if (error > 0 && std::abs(beyond) <= error) return Side::undecided;
  return beyond <= 0 ? Side::holds : Side::beyond;
}

void LimitCount::take_up(Side side) {
  ++(side == Side::holds ? holds : side == Side::undecided ? undecided : side == Side::beyond ? beyond : unknown);
}
void LimitCount::end(std::size_t trials) {
  interval = {clopper_pearson(holds, trials).low, clopper_pearson(holds + undecided, trials).high};
}

std::string limit_in_words(std::string given) {
  for (const auto& [sign, shown] : {std::pair{"<=", "≤"}, std::pair{">=", "≥"}})
    if (const std::size_t at = given.find(sign); at != std::string::npos) given.replace(at, 2, shown);
  return given;
}

FigureLimit parse_limit(const std::string& text, const std::vector<SweptFigure>& figures) {
  const auto refuse = [&](const std::string& why) {
    throw std::invalid_argument(fmt::format(
        "--limit {}: {}; write e.g. \"delta.press <= 0.05\" or \"min_speed.press >= 50 rpm\"", in_quotes(text), why));
  };
  const std::size_t sign = text.find_first_of("<>");
  if (sign == std::string::npos) refuse("neither <= nor >=");
  FigureLimit limit{.from_above = text[sign] == '<', .given = text};
  std::string name = text.substr(0, sign);
  name.resize(name.find_last_not_of(' ') + 1);
  name.erase(0, std::min(name.find_first_not_of(' '), name.size()));
  const auto* const found = find_by(figures, &SweptFigure::name, name);
  if (!found) {
    std::vector<std::string> names;
    for (const SweptFigure& f : figures) names.push_back(f.name);
    refuse(fmt::format("no figure {} in this sweep{}; it has: {}", in_quotes(name), suggestion(name, names),
                       shortened_list(names, "and")));
  }
  limit.figure = static_cast<std::size_t>(found - figures.data());
  UnitError error;
  const std::size_t value_at = text.find_first_not_of("<>= ", sign);
  const auto quantity = parse_quantity(value_at == std::string::npos ? "" : text.substr(value_at), error);
  if (!quantity) refuse(error.text);
  const Dimension wanted = parse_unit(found->unit, error).value_or(Unit{}).dimension;
  const Quantity taken = wanted_as(*quantity, wanted);
  if (taken.dimension != wanted)
    refuse(fmt::format("{} is {}, and the limit is {}", name, name_of(wanted), name_of(taken.dimension)));
  limit.value = taken.value;
  return limit;
}

Interval clopper_pearson(std::size_t successes, std::size_t trials, double confidence) {
  if (trials == 0) return {};
  namespace policies = boost::math::policies;  // in double throughout, as in tolerated.cpp
  using Binomial = boost::math::binomial_distribution<double, policies::policy<policies::promote_double<false>>>;
  const auto n = static_cast<double>(trials), k = static_cast<double>(successes);
  const double tail = (1 - confidence) / 2;
  return {Binomial::find_lower_bound_on_p(n, k, tail), Binomial::find_upper_bound_on_p(n, k, tail)};
}

}  // namespace kurbel
