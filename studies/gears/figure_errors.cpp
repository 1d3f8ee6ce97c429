// figure_errors.cpp — pairs with one number changed.
#include "studies/gears/figure_errors.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numbers>
#include <stdexcept>

namespace kurbel {
namespace {

// A number of the data, and its change.
template <class Data>
struct GivenNumber {
  std::function<double&(Data&)> number;
  double by;
};

// Each number decreased and increased; pairs refused by the solver are omitted.
template <class T, class Data>
void add_moved(const Data& data, const std::vector<GivenNumber<Data>>& places,
               const std::function<T(const Data&)>& solve, Moved<T>& list) {
  for (const GivenNumber<Data>& place : places) {
    if (place.by == 0) continue;
    std::array<std::optional<T>, 2> both;
    for (const int side : {0, 1}) {
      Data other = data;
      place.number(other) += (side == 0 ? -1 : 1) * place.by;
      try {
        both[static_cast<std::size_t>(side)] = solve(other);
      } catch (const std::invalid_argument&) {
      }
    }
    list.push_back(std::move(both));
  }
}

using PairPlaces = std::vector<GivenNumber<GearPairData>>;

void add_given(const GearPairData& d, PairPlaces& places) {
  const auto add = [&](auto number) {
    GearPairData copy = d;
    places.push_back({number, part_moved * std::abs(number(copy))});
  };
  using D = GearPairData&;
  add([](D x) -> double& { return x.module; });
  add([](D x) -> double& { return x.helix; });
  add([](D x) -> double& { return x.rack.pressure_angle; });
  add([](D x) -> double& { return x.rack.addendum; });
  add([](D x) -> double& { return x.rack.clearance; });
  add([](D x) -> double& { return x.rack.root_radius; });
  add([](D x) -> double& { return x.backlash; });
  add([](D x) -> double& { return x.density; });
  add([](D x) -> double& { return x.young; });
  if (d.centre_distance) add([](D x) -> double& { return *x.centre_distance; });
  for (const std::size_t i : {0UL, 1UL}) {
    add([i](D x) -> double& { return x.width[i]; });
    add([i](D x) -> double& { return x.bore[i]; });
    if (d.tip_diameter[i]) add([i](D x) -> double& { return *x.tip_diameter[i]; });
    if (d.shift[i])
      places.push_back({[i](D x) -> double& { return *x.shift[i]; }, part_moved*(1 + std::abs(*d.shift[i]))});
  }
}

// The pair described by its centre distance and shifts, with the resulting tips.
GearPairData by_results(const GearPair& p) {
  GearPairData d = p.data;
  d.centre_distance = std::abs(p.centre_distance);
  for (const std::size_t i : {0UL, 1UL}) d.shift[i] = p.wheel[i].shift;
  return d;
}

void add_results(const GearPair& p, const std::function<GearPair(const GearPairData&)>& solve, Moved<GearPair>& list) {
  using D = GearPairData&;
  const GearPairData d = by_results(p);
  PairPlaces places = {{[](D x) -> double& { return *x.centre_distance; }, part_moved** d.centre_distance}};
  for (const std::size_t i : {0UL, 1UL})
    places.push_back({[i](D x) -> double& { return *x.shift[i]; }, part_moved*(1 + std::abs(*d.shift[i]))});
  add_moved(d, places, solve, list);
  // A tip that keeps the clearance has the uncertainty of the centre distance.
  GearPairData tipped = d;
  PairPlaces tips;
  for (const std::size_t i : {0UL, 1UL}) {
    tipped.tip_diameter[i] = std::abs(p.wheel[i].tip_diameter);
    tips.push_back({[i](D x) -> double& { return *x.tip_diameter[i]; },
                    part_moved* std::max(*tipped.tip_diameter[i], 2 * *d.centre_distance)});
  }
  add_moved(tipped, tips, solve, list);
}

}  // namespace

Moved<GearPair> moved(const GearPair& pair) {
  const std::function<GearPair(const GearPairData&)> solve = solve_gear_pair;
  Moved<GearPair> list;
  PairPlaces given;
  add_given(pair.data, given);
  add_moved(pair.data, given, solve, list);
  add_results(pair, solve, list);
  return list;
}

Moved<BevelPair> moved(const BevelPair& pair) {
  using B = BevelPair&;
  Moved<BevelPair> list;
  add_moved<BevelPair, BevelPair>(pair,
                                  {{[](B b) -> double& { return b.module; }, part_moved* pair.module},
                                   {[](B b) -> double& { return b.shaft_angle; }, part_moved* pair.shaft_angle}},
                                  std::identity(), list);
  return list;
}

Moved<WormPair> moved(const WormPair& pair) {
  using W = WormPair&;
  Moved<WormPair> list;
  add_moved<WormPair, WormPair>(pair,
                                {{[](W w) -> double& { return w.module; }, part_moved* pair.module},
                                 {[](W w) -> double& { return w.worm_diameter; }, part_moved* pair.worm_diameter},
                                 {[](W w) -> double& { return w.friction; }, part_moved* pair.friction},
                                 {[](W w) -> double& { return w.pressure_angle; }, part_moved* pair.pressure_angle}},
                                std::identity(), list);
  return list;
}

double largest_error(std::span<const double> errors) {
  double most = std::numeric_limits<double>::quiet_NaN();
  for (const double e : errors)
    if (!(e <= most) && std::isfinite(e)) most = e;
  return most;
}

std::string error_text(double error) {
  if (!std::isfinite(error)) return "—";
  if (error == 0) return "0";
  double unit = std::pow(10.0, std::floor(std::log10(error)));
  const bool begins_with_one = error < 2 * unit;
  if (begins_with_one) unit /= 10;
  const double rounded = std::ceil(error / unit * (1 - 1e-12)) * unit;
  return rounded >= 1e-3 && rounded < 1e6 ? fmt::format("{:.6g}", rounded)
                                          : fmt::format("{:.{}e}", rounded, begins_with_one ? 1 : 0);
}

std::string ended_at_error(std::string number, double error, double& rounding) {
  char* end = nullptr;
  const Estimate written{std::strtod(number.c_str(), &end), error};
  if (*end != 0 || !std::isfinite(error)) return number;
  const FigureText text = figure_text(written, std::max(1, significant_digits(number)));
  if (!error_is_visible(written, text)) return number;
  rounding = std::max(rounding, std::abs(std::strtod(text.value.c_str(), nullptr) - written.value));
  return text.value;
}

double in_unit(const std::string& unit) {
  if (unit == "mm" || unit == "mrad") return 1e3;
  if (unit == "°") return 180 / std::numbers::pi;
  if (unit == "N/(mm·µm)") return 1e-9;
  return 1;
}

}  // namespace kurbel
