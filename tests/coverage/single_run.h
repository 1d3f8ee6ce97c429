// single_run.h — one integration at one tolerance, with its figures and what it cost.
#pragma once

#include <memory>
#include <string>

#include "studies/findings/result.h"

namespace kurbel::coverage {

struct RunSetting {
  std::string method;
  double tolerance = 1e-8;
  double budget = 2;  // processor time [s]
};

// Figures without errors; incomplete where it failed on its way.
Result single_run(const std::shared_ptr<const Model>& model, const RunSetting& setting);

// What a start one cycle on adds to final angles, by the name of the figure.
std::map<std::string, double> shifts_of_angles(const std::shared_ptr<const Model>& model,
                                               const std::shared_ptr<const Model>& shifted);

}  // namespace kurbel::coverage
