// dense_tables.cpp — all tables of a scene's components, those of nested sections included.
#include "engine/values/dense_tables.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

namespace kurbel {
namespace {

constexpr std::size_t dense_points = 200;     // from which on fewer may pay
constexpr std::size_t points_of_a_piece = 3;  // at least, that it pays

std::size_t points_of(const CurveData& curve) { return curve.x.size() + curve.x_back.size(); }

bool may_be_dense(const Section& section, const CurveData& curve) {
  const bool over_way = curve.over == "angle" || curve.over == "travel" || curve.over == "swing";
  return over_way && curve.by_formula.empty() && points_of(curve) >= dense_points && !section.given("rounding") &&
         !section.given("rounding_angle");
}

bool pays(CurveData curve, double within) try {
  curve.within = within;
  return points_of_a_piece * (curve.curve().x().size() + curve.back().x().size()) <= points_of(curve);
} catch (const std::invalid_argument&) {  // the component that owns it makes more of it
  return false;
}

// visit(name, data) for each table that may be dense.
template <class SectionOrConst, class Visit>
void visit_dense(SectionOrConst& section, const std::string& name, const Visit& visit) {
  for (auto& setting : section.settings) {
    const std::string key = name + "." + setting.key;
    if (may_be_dense(section, setting.curve)) visit(key, setting.curve);
    for (auto& nested : setting.sections) visit_dense(nested, key, visit);
  }
}

}  // namespace

Scene with_fewer_points(Scene scene) {
  const double within = tables_of_accuracy * scene.run.accuracy;
  for (Section& section : scene.components)
    visit_dense(section, section.name, [within](const std::string&, CurveData& curve) {
      if (pays(curve, within)) curve.within = within;
    });
  return scene;
}

Scene with_rougher_tables(Scene scene, double times) {
  for (Section& section : scene.components)
    visit_dense(section, section.name, [times](const std::string&, CurveData& curve) { curve.within *= times; });
  return scene;
}

double tables_within(const Scene& scene) {
  double within = 0;
  for (const Section& section : scene.components)
    visit_dense(section, section.name,
                [&within](const std::string&, const CurveData& curve) { within = std::max(within, curve.within); });
  return within;
}

std::string words_of_dense_tables(const Scene& scene) {
  std::string names;
  for (const Section& section : scene.components)
    visit_dense(section, section.name, [&names](const std::string& name, const CurveData& curve) {
      if (curve.within > 0) names += fmt::format("{}{} ({} points)", names.empty() ? "" : ", ", name, points_of(curve));
    });
  if (names.empty()) return {};
  return fmt::format(
      "tables re-tabulated by fewer pieces, within {:.1g} of their greatest value, which is in the errors: {}; a "
      "smaller accuracy in [run] takes them more exactly",
      tables_within(scene), names);
}

}  // namespace kurbel
