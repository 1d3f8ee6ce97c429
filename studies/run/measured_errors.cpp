// measured_errors.cpp — differences of runs, and errors that they may hide.
#include "studies/run/measured_errors.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "studies/findings/figure_changes.h"

namespace kurbel {
namespace {

constexpr double share = 0.05;  // of the median, in every figure's error

const Figure* find(const std::vector<Figure>& figures, const Figure& like, std::size_t place) {
  if (place < figures.size() && figures[place].name == like.name) return &figures[place];
  const auto found =
      std::find_if(figures.begin(), figures.end(), [&](const Figure& f) { return measure_the_same(f, like); });
  return found == figures.end() ? nullptr : &*found;
}

double median(std::vector<double> values) {
  if (values.empty()) return 0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace

MeasuredErrors measure_errors(std::vector<Figure>& figures, const std::vector<Witness>& witnesses) {
  std::vector<double> in_scale;
  double latest = 0;
  for (std::size_t k = 0; k < figures.size(); ++k) {
    Figure& figure = figures[k];
    figure.error.reset();
    figure.at_error.reset();
    for (const Witness& witness : witnesses) {
      const Figure* other = find(*witness.figures, figure, k);
      if (!other) continue;
      figure.error = std::max(figure.error.value_or(0), witness.weight * apart(figure, *other));
      if (figure.at && other->at)
        figure.at_error = std::max(figure.at_error.value_or(rounding_of_a_run * std::abs(*figure.at)),
                                   witness.weight * std::abs(*figure.at - *other->at));
    }
    if (figure.error && figure.scale > 0) in_scale.push_back(*figure.error / figure.scale);
    if (figure.at) latest = std::max(latest, std::abs(*figure.at));
  }
  const double typical = median(in_scale);
  MeasuredErrors errors{.hidden = share * typical};
  for (Figure& figure : figures) {
    // A smooth top moves by the root of its value's error; further away it is another one, of several that are equal.
    if (figure.at_error && *figure.at_error > std::sqrt(typical + rounding_of_a_run) * latest)
      figure.at_error = latest;
    else if (figure.at_error && *figure.at_error > rounding_of_a_run * std::abs(*figure.at))
      *figure.at_error += errors.hidden * latest;
    if (!figure.error) continue;
    if (!figure.exact)
      *figure.error += errors.hidden * figure.scale + rounding_of_a_run * (std::abs(figure.value) + figure.scale);
    if (figure.scale > 0) errors.largest = std::max(errors.largest, *figure.error / figure.scale);
    *figure.error += figure.resolution;
  }
  return errors;
}

double add_differences(std::vector<Figure>& figures, const std::vector<Figure>& finer) {
  double worst = 0;
  for (std::size_t k = 0; k < figures.size(); ++k) {
    Figure& figure = figures[k];
    const Figure* other = find(finer, figure, k);
    if (!figure.error || !other) continue;
    const double off = apart(figure, *other);
    *figure.error += off;
    if (figure.at && other->at && figure.at_error) *figure.at_error += std::abs(*figure.at - *other->at);
    if (figure.scale > 0) worst = std::max(worst, off / figure.scale);
  }
  return worst;
}

std::shared_ptr<const Model> with_finer_shafts(const Model& model) {
  if (model.scene.components.empty()) return nullptr;
  Scene scene = model.scene;
  ++scene.finer_shafts;
  auto finer = compile(scene, model.effects);
  const bool same = finer->network.components == model.network.components &&
                    finer->network.elements.size() == model.network.elements.size();
  return same ? finer : nullptr;
}

double add_shaft_errors(std::vector<Figure>& figures, std::vector<Figure>& states, const std::vector<Figure>& finer,
                        const std::vector<Figure>& finer_states) {
  add_differences(states, finer_states);
  return add_differences(figures, finer);
}

std::vector<std::string> shaft_error_notes(double change, double accuracy, const std::string& why) {
  if (!why.empty()) return {"what the cut of continuous shafts leaves open is not in the errors: " + why};
  if (change <= accuracy) return {};
  return {
      fmt::format("the number of segments of continuous shafts changes figures by up to {:.1e} of their scales; the "
                  "errors include it",
                  change)};
}

}  // namespace kurbel
