// dense_tables.cpp — all tables of a scene's components, those of nested sections included.
#include "engine/values/dense_tables.h"

#include <fmt/format.h>

#include <algorithm>

namespace kurbel {
namespace {

bool is_dense(const Section& section, const CurveData& curve) {
  const bool over_way = curve.over == "angle" || curve.over == "travel" || curve.over == "swing";
  return over_way && curve.by_formula.empty() && std::max(curve.x.size(), curve.x_back.size()) >= dense_points &&
         !section.given("rounding") && !section.given("rounding_angle");
}

// visit(name, data) for each dense table.
template <class SectionOrConst, class Visit>
void visit_dense(SectionOrConst& section, const std::string& name, const Visit& visit) {
  for (auto& setting : section.settings) {
    const std::string key = name + "." + setting.key;
    if (is_dense(section, setting.curve)) visit(key, setting.curve);
    for (auto& nested : setting.sections) visit_dense(nested, key, visit);
  }
}

}  // namespace

Scene with_tables_within(Scene scene, double within) {
  for (Section& section : scene.components)
    visit_dense(section, section.name, [within](const std::string&, CurveData& curve) { curve.within = within; });
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
      if (curve.within > 0)
        names += fmt::format("{}{} ({} points)", names.empty() ? "" : ", ", name,
                             std::max(curve.x.size(), curve.x_back.size()));
    });
  if (names.empty()) return {};
  return fmt::format(
      "tables re-tabulated by fewer pieces, within {:.1g} of their greatest value, which is in the errors: {}; a "
      "smaller "
      "accuracy in [run] takes them more exactly",
      tables_within(scene), names);
}

}  // namespace kurbel
