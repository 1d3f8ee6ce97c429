// tolerated.h — a parameter with a tolerance as a random variable: its distribution, truncated at the key's domain.
#pragma once

#include <string>
#include <vector>

#include "engine/reading/tolerances.h"
#include "engine/scene/scene.h"
#include "studies/experiments/parameter.h"

namespace kurbel {

// All values in the unit of the tolerance.
class Tolerated {
 public:
  // `domain` in SI; throws std::invalid_argument if the distribution lies outside it.
  Tolerated(const Tolerance& tolerance, const Domain& domain);

  const Tolerance& given() const { return given_; }
  double deviation() const;                                // of the given distribution, before truncation
  double cut_off() const { return 1 - (top_ - bottom_); }  // probability outside the domain
  double quantile(double share) const;                     // of the truncated distribution
  double low() const { return low_; }                      // ends of the domain, within the distribution's range
  double high() const { return high_; }
  SweptParameter swept() const;  // with this distribution
  std::string in_words() const;  // "900 kN·m/rad ± 10 %, normal (k = 2)"

 private:
  Tolerance given_;
  double low_, high_, bottom_, top_;
};

// From a scene's text; throws std::invalid_argument if it has no tolerances, SceneError if they are invalid.
std::vector<Tolerated> tolerated_parameters(const Scene& scene);

}  // namespace kurbel
