// explained_pages_test.cpp — kurbel explain knows every key figure and every symbol that stands on a page or a sheet.
#include <gtest/gtest.h>

#include <cctype>
#include <functional>
#include <regex>
#include <set>

#include "drivetrain/gears/bevel_worm.h"
#include "engine/scene/units.h"
#include "studies/dictionary/dictionary.h"
#include "studies/dictionary/symbols.h"
#include "studies/effects/effect_study.h"
#include "studies/forces/forces_findings.h"
#include "studies/gears/bevel_worm.h"
#include "studies/gears/gears.h"
#include "studies/modes/modes.h"
#include "studies/reduce/reduce.h"
#include "studies/report/theory.h"
#include "studies/run/run_findings.h"
#include "studies/size/size.h"
#include "studies/steady/steady.h"
#include "studies/worksheet/forces_sheet.h"
#include "studies/worksheet/reduce_sheet.h"
#include "tests/support/scenes.h"
#include "tests/support/sheet_page.h"

namespace kurbel::explained_pages_test {
namespace {

// Letters with what belongs to them: primes, raised letters, indices. Words and functions are none.
std::set<std::string> symbols_of(const std::string& formula) {
  static const std::regex part(
      "(?:(?:Δ)?(?:[A-Za-z]|[\xCE\xCF][\x80-\xBF])(?:′|″|₀|₁|₂|₃|₄|ⁿ|ᵗ|ᶜ|ʳ|\xCC[\x80-\xBF])*(?:_(?:[A-Za-z0-9*]|["
      "\xCE\xCF]["
      "\x80-"
      "\xBF])+)?(?:′)?)|[A-Za-z]{2,}");
  static const std::regex word("[A-Za-z]{2,}");
  std::set<std::string> found;
  const std::string bare = std::regex_replace(formula, std::regex("\\b(?!_)[A-Za-z]{2,}(?![_A-Za-z])"), " ");
  for (std::sregex_iterator i(bare.begin(), bare.end(), part), end; i != end; ++i)
    if (const std::string text = i->str(); text != "d" && text != "π" && text != "Δ" && !std::regex_match(text, word))
      found.insert(text);
  return found;
}

void expect_page_explained(const std::string& study, const Findings& findings, std::set<std::string>& symbols) {
  for (const KeyFigure& f : findings.figures) {
    const Definition* const d = meant_by(f.name);
    EXPECT_TRUE(d) << study << ": " << f.name;
    if (!d || f.means.empty() || f.name.starts_with("mode ")) continue;  // of what, the number does not say
    EXPECT_EQ(d->name, definition_of(f.means)->name) << study << ": " << f.name;
  }
  const Report page = page_of(findings);
  for (const ReportSection& s : page.sections)
    for (const Card& card : s.cards)
      if (const FormulaCard* formula = std::get_if<FormulaCard>(&card)) symbols.merge(symbols_of(formula->symbols));
}

TEST(ExplainedPages, FormulasAndKeyFiguresOfPages) {
  Scene press = test::scene_file("scenes/crank_press.toml");
  press.run.until = 1;
  SizeOptions size;
  size.delta = 0.05, size.simulate = false;
  std::set<std::string> symbols;
  const auto check = [&](const char* study, const auto& result) {
    expect_page_explained(study, findings_of(result), symbols);
  };
  check("run", simulate(press, press.effects, "elastic", {}));
  check("steady", steady(press, {Effects{}, press.effects}, {}));
  check("modes", find_modes(press, press.effects, {.torque = "main_coupling"}));
  check("forces", find_forces(press, {}));
  check("forces", find_forces(test::scene_file("scenes/four_bar_rocker.toml"), {}));
  check("size", size_flywheel(press, size));
  check("reduce", reduce(press, {}));
  check("gears", find_gears(test::scene_file("scenes/gear_pair.toml"), {}));
  check("bevel pair", BevelPair{.teeth = {19, 40}, .module = 0.004, .shaft_angle = 1.5});
  expect_page_explained("worm pair",
                        findings_of(WormPair{.starts = 1, .teeth = 40, .module = 0.004, .worm_diameter = 0.05}, 150),
                        symbols);
  EXPECT_GT(symbols.size(), 50u);
  for (const std::string& symbol : symbols) EXPECT_TRUE(meant_by(symbol)) << symbol;
}

TEST(ExplainedPages, SymbolsOfWorksheets) {
  ForcesOptions options;
  options.simulate = false;
  std::set<std::string> symbols;
  const auto collect = [&](const std::string& html) {
    for (const auto& cell : test::cells_of(html)) symbols.insert(cell.column);
    for (const auto& mark : test::marks_of(html)) symbols.insert(mark.of);
    static const std::regex drawn("data-(?:vector|plan)=\"([^\"]+)\""),
        words("<text class=\"on-[a-z]+ bold\"[^>]*>([^ ]*)</text>"), spans("</?tspan[^>]*>");
    for (std::sregex_iterator i(html.begin(), html.end(), drawn), end; i != end; ++i) symbols.insert((*i)[1]);
    // Points of plans, titles of diagrams: an index is a span that is lowered.
    const std::string plain =
        std::regex_replace(std::regex_replace(html, std::regex("<tspan dy=\"0?.25em\"[^>]*>"), "_"), spans, "");
    static const std::regex plan_point("^[a-z](_[0-9a-z]+)?(?:′)?$");
    for (std::sregex_iterator i(plain.begin(), plain.end(), words), end; i != end; ++i)
      if (std::regex_match((*i)[1].str(), plan_point)) symbols.insert((*i)[1]);
  };
  for (const char* scene :
       {"scenes/crank_press.toml", "scenes/shaper.toml", "scenes/four_bar_rocker.toml", "scenes/six_link_press.toml"})
    collect(sheet_of(test::scene_file(scene), options, {}, "").html());
  for (const char* scene : {"scenes/crank_press.toml", "scenes/four_bar_rocker.toml"})
    collect(sheet_of(test::scene_file(scene), ReduceOptions{}, ReduceSheetRequest{}).html());
  for (const char* known : {"R_12", "F_x2", "aⁿ_BA", "aᶜ_AA2", "v_BA", "p_v", "b′", "s_2", "μ_F", "I_em", "ΔT", "M_c"})
    EXPECT_TRUE(symbols.contains(known)) << known;
  for (const std::string& symbol : symbols) EXPECT_TRUE(meant_by(symbol)) << symbol;
}

TEST(ExplainedPages, SymbolsAreDefinedOnceAndWhole) {
  std::set<std::string_view> names;
  for (const Definition& d : entries::of_symbols) {
    EXPECT_TRUE(names.insert(d.name).second) << d.name;
    EXPECT_FALSE(d.is.empty() || d.is.ends_with('.')) << d.name;
    UnitError error;
    EXPECT_TRUE(parse_unit(d.unit, error)) << d.name << " in " << d.unit;
    EXPECT_EQ(theory_notes("theory " + std::string(d.theory)).size(), 1u) << d.name;
    EXPECT_TRUE(d.name.find('*') != std::string_view::npos || meant_by(d.name) == &d) << d.name;
  }
  for (const entries::Label& l : entries::labels) EXPECT_TRUE(definition_of(l.name)) << l.name;
  EXPECT_EQ(meant_by("R_12")->name, "R_*");
  EXPECT_EQ(meant_by("R12")->name, "R_*");
  EXPECT_EQ(meant_by("S2")->name, "S_*");
  for (const char* known : {"O", "OA", "AB", "№", "aᶜ", "aʳ", "e⁻", "ω2"}) EXPECT_TRUE(meant_by(known)) << known;
  EXPECT_EQ(meant_by("I₀")->name, "I_0");
  EXPECT_EQ(meant_by("peak torque, main_coupling")->name, "peak_torque");
  EXPECT_EQ(meant_by("largest slot: block on lever, moment")->name, "reaction_moment");
}

}  // namespace
}  // namespace kurbel::explained_pages_test
