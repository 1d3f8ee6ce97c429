// tolerated.cpp — normal, uniform and triangular distributions, truncated.
#include "studies/uncertainty/tolerated.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "engine/scene/units.h"
#include "studies/claims/ranges.h"
#include "studies/variants/machine.h"

namespace kurbel {
namespace {

using enum Tolerance::Distribution;

double factor_of(const std::string& unit) {
  UnitError error;
  const auto read = parse_unit(unit, error);
  return read ? read->factor : 1;
}

// The next double inside an open end.
double inwards(double end, bool open, double towards) { return open ? std::nextafter(end, towards) : end; }

}  // namespace

Tolerated::Tolerated(const Tolerance& tolerance, const Domain& domain) : given_(tolerance) {
  const double factor = factor_of(given_.unit);
  low_ = inwards(domain.low / factor, domain.low_open, HUGE_VAL);
  high_ = inwards(domain.high / factor, domain.high_open, -HUGE_VAL);
  if (given_.distribution != normal) low_ = std::max(low_, given_.low), high_ = std::min(high_, given_.high);
  bottom_ = share_below(given_, low_), top_ = share_below(given_, high_);
  if (!(top_ > bottom_))
    throw std::invalid_argument(fmt::format("{}: nothing of its tolerance lies where the key may", given_.path));
}

double Tolerated::deviation() const { return kurbel::deviation(given_); }

double Tolerated::quantile(double share) const {
  return std::clamp(kurbel::quantile(given_, bottom_ + share * (top_ - bottom_)), low_, high_);
}

SweptParameter Tolerated::swept() const {
  SweptParameter p{.path = given_.path, .unit = given_.unit};
  p.low = quantile(1e-9), p.high = quantile(1 - 1e-9);
  p.given = fmt::format("{} = {}", given_.path, in_words());
  p.quantile = [self = *this](double share) { return self.quantile(share); };
  return p;
}

std::string Tolerated::in_words() const {
  const std::string unit = given_.unit.empty() ? "" : " " + pretty_unit(given_.unit);
  const char* const name = given_.distribution == normal    ? "normal"
                           : given_.distribution == uniform ? "uniform"
                                                            : "triangular";
  std::string text = fmt::format("{:.6g}{}, {}, {}", given_.value, unit, range_text(given_.low, given_.high, 6), name);
  if (given_.distribution == normal) text += fmt::format(" (k = {:g})", given_.k);
  if (cut_off() > 1e-9) text += fmt::format(", {:.2g} % cut off where the key's domain ends", 100 * cut_off());
  return text;
}

std::vector<Tolerated> tolerated_parameters(const Scene& scene) {
  std::vector<Tolerated> list;
  for (const Tolerance& tolerance : tolerances_of(scene.text, scene.file)) {
    const Key* const key = quantity_key(scene, tolerance.path);
    list.emplace_back(tolerance, key ? key->domain : any_number);
  }
  if (list.empty())
    throw std::invalid_argument(
        fmt::format("{}: gives no tolerances; write e.g. stiffness = {{ value = \"900 kN*m/rad\", tolerance = \"10 "
                    "%\", distribution = \"normal\", k = 2 }}",
                    scene.file));
  return list;
}

}  // namespace kurbel
