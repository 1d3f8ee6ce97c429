// tolerated.h — a parameter with a tolerance as a random variable: its distribution, cut off where the key's domain ends.
#pragma once

#include <string>
#include <vector>

#include "engine/reading/tolerances.h"
#include "engine/scene/scene.h"
#include "studies/experiments/parameter.h"

namespace kurbel {

// All in the unit of the tolerance.
class Tolerated {
 public:
  // `domain` in SI; throws std::invalid_argument where nothing of the distribution lies in it.
  Tolerated(const Tolerance& tolerance, const Domain& domain);

  const Tolerance& given() const { return given_; }
  double deviation() const;                                // of the distribution as given, not cut off
  double cut_off() const { return 1 - (top_ - bottom_); }  // probability that lies outside of the domain
  double quantile(double share) const;                     // of what is left
  double low() const { return low_; }                      // the domain's ends within the distribution
  double high() const { return high_; }
  SweptParameter swept() const;  // with this distribution
  std::string in_words() const;  // "900 kN·m/rad ± 10 %, normal (k = 2)"

 private:
  Tolerance given_;
  double low_, high_, bottom_, top_;
};

// Of a scene's text; throws std::invalid_argument where it gives none, SceneError for what is wrong with them.
std::vector<Tolerated> tolerated_parameters(const Scene& scene);

}  // namespace kurbel
