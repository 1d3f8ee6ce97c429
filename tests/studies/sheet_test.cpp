// sheet_test.cpp — the classical sheet: closed forms of its positions, the load's edges, round scales and lengths that
// are true to them, every number that of the study.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <random>
#include <regex>
#include <string>

#include "studies/sheet/linkage_drawing.h"
#include "studies/sheet/table.h"
#include "studies/sheet/vector_plan.h"
#include "studies/worksheet/energy_mass_sheet.h"
#include "studies/worksheet/forces_sheet.h"
#include "studies/worksheet/reduce_sheet.h"
#include "tests/mechanisms/slider_crank_geometry.h"
#include "tests/support/scenes.h"
#include "tests/support/sheet_page.h"

namespace kurbel::sheet_test {
namespace {

using test::cell_at;
using test::cells_of;
using test::marks_of;

constexpr double degree = std::numbers::pi / 180;

const char* const offset_press = R"(
title = "press with an offset"
line  = ["motor", "flywheel", "press"]
motor    = { kind = "motor", torque = { over = "speed", unit = ["rpm", "N*m"], points = [[20, 900], [60, 100], [70, 0]] }, inertia = "2 kg*m2" }
flywheel = { kind = "flywheel", inertia = "60 kg*m2" }
press    = { kind = "slider-crank", radius = "50 mm", rod = "180 mm", offset = "12 mm", crank_inertia = "0.4 kg*m2", rod_mass = "12 kg", rod_com = "60 mm", rod_inertia = "0.06 kg*m2", slider_mass = "30 kg", load = { kind = "press", nominal_force = "40 kN", nominal_travel = "6 mm", rise = "0.5 mm", breakthrough = "2 mm", drop = "0.2 mm" } }
[run]
start = { speed = "60 rpm" }
)";

SliderCrankGeometry offset_geometry() {
  SliderCrankData d;
  d.radius = 0.05, d.rod_length = 0.18, d.offset = 0.012, d.crank_inertia = 0.4;
  d.rod_mass = 12, d.rod_com = 0.06, d.rod_inertia = 0.06, d.slider_mass = 30;
  return SliderCrankGeometry(d);
}

ReduceSheet sheet_of_scene(const Scene& scene, std::optional<double> delta = {}) {
  return sheet_of(scene, ReduceOptions{},
                  ReduceSheetRequest{.paper = {}, .delta = delta, .flywheel = {}, .author = {}});
}

// Of a file, drawn once for all tests.
const ReduceSheet& sheet_of_file(const std::string& name) {
  static std::map<std::string, ReduceSheet> drawn;
  const auto known = drawn.find(name);
  return known != drawn.end() ? known->second
                              : drawn.emplace(name, sheet_of_scene(test::scene_file(name))).first->second;
}
const ReduceSheet& sheet_of_offset_press() {
  static const ReduceSheet drawn = sheet_of_scene(test::scene_from(offset_press));
  return drawn;
}

TEST(Sheet, ScalesAreRoundAndTheNextFinerOneIsTooFine) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> exponent(-9, 9);
  for (int i = 0; i < 200; ++i) {
    const double value = std::pow(10, exponent(random)), scale = round_scale(value);
    EXPECT_GE(scale, value * (1 - 1e-11));
    EXPECT_LE(scale, value * 2.0000001);
    const double digits = scale / std::pow(10, std::floor(std::log10(scale * (1 + 1e-12))));
    const std::array round = {1.0, 2.0, 2.5, 4.0, 5.0};
    EXPECT_TRUE(std::any_of(round.begin(), round.end(), [&](double d) { return std::abs(digits - d) < 1e-9; }))
        << scale;
  }
}

TEST(Sheet, PositionsGoFromTheDeadCentreInTheSenseOfTheMotion) {
  const std::vector<SheetPosition> back =
      sheet_positions({2 * std::numbers::pi, 0.2, -1, 12}, {0.2 - 100 * degree}, 0.2);
  ASSERT_EQ(back.size(), 13u);
  EXPECT_EQ(back[0].label, "0");
  EXPECT_TRUE(back[0].greatest);
  EXPECT_NEAR(back[1].phi, 0.2 - 30 * degree + 2 * std::numbers::pi, 1e-14);
  EXPECT_EQ(back[4].label, "a");  // 100° lie between 90° and 120°
  EXPECT_EQ(back[3].label, "3");
  EXPECT_TRUE(back[4].edge && !back[4].numbered);
}

// x = r cos φ + √(l² − (e − r sin φ)²), numbered from where crank and rod lie in line.
TEST(Sheet, KinematicsOfAnOffsetSliderCrankMatchTheClosedForm) {
  const ReduceSheet& sheet = sheet_of_offset_press();
  const SliderCrankGeometry geometry = offset_geometry();
  const auto cells = cells_of(sheet.html());
  const double omega = sheet.reduction.speed, origin = geometry.extended_angle();
  EXPECT_NEAR(sheet.motion.cycle.origin, origin, 1e-10);
  for (int k = 0; k < 12; ++k) {
    const std::string row = std::to_string(k);
    const double phi = origin + 30 * k * degree;
    const auto x = geometry.slider(phi), beta = geometry.rod(phi);
    EXPECT_NEAR(cell_at(cells, row, "φ"), phi / degree, 1e-8);
    EXPECT_NEAR(cell_at(cells, row, "x"), x.value, 1e-11);
    EXPECT_NEAR(cell_at(cells, row, "s"), x.value - geometry.x_max(), 1e-11);
    EXPECT_NEAR(cell_at(cells, row, "x′"), x.slope, 1e-10);
    EXPECT_NEAR(cell_at(cells, row, "x″"), x.curvature, 1e-10);
    EXPECT_NEAR(cell_at(cells, row, "v"), x.slope * omega, 1e-9);
    EXPECT_NEAR(cell_at(cells, row, "a"), x.curvature * omega * omega, 1e-8);
    EXPECT_NEAR(cell_at(cells, row, "ω_2"), beta.slope * omega, 1e-9);
    EXPECT_NEAR(cell_at(cells, row, "ε_2"), beta.curvature * omega * omega, 1e-8);
    // S on the rod: C = A + c (cos β, sin β).
    const double vx = -0.05 * std::sin(phi) - 0.06 * std::sin(beta.value) * beta.slope;
    const double vy = 0.05 * std::cos(phi) + 0.06 * std::cos(beta.value) * beta.slope;
    EXPECT_NEAR(cell_at(cells, row, "v_S2"), std::hypot(vx, vy) * omega, 1e-9);
  }
}

// The blow lies between positions 11 and 0: where the travel to the dead centre is 6, 5.5, 2 and 1.8 mm.
TEST(Sheet, AShockBetweenTwoPositionsIsNotSkipped) {
  const ReduceSheet& sheet = sheet_of_offset_press();
  const SliderCrankGeometry geometry = offset_geometry();
  std::vector<double> travels;
  for (const SheetPosition& p : sheet.motion.positions)
    if (p.edge && !p.numbered) travels.push_back(1e3 * (geometry.x_max() - geometry.slider(p.phi).value));
  ASSERT_EQ(travels.size(), 4u);
  EXPECT_NEAR(travels[0], 6, 1e-6);
  EXPECT_NEAR(travels[1], 5.5, 1e-6);
  EXPECT_NEAR(travels[2], 2, 1e-6);
  EXPECT_NEAR(travels[3], 1.8, 1e-6);
  double most = 0, numbered = 0;
  for (const ReducedPosition& p : sheet.reduction.curve) most = std::max(most, p.load);
  for (const ReducedPosition& p : sheet.reduction.positions) numbered = std::max(numbered, p.load);
  double shown = 0;
  for (const auto& c : cells_of(sheet.html()))
    if (c.column == "M_c") shown = std::max(shown, c.value);
  EXPECT_NEAR(shown, most, 1e-6 * most);  // the curve has it 1e-7 rad beside
  EXPECT_LT(numbered, 0.1 * most);        // the table of twelve skips it
}

// Without an offset the sheet's numbers are those of the study's own table.
TEST(Sheet, EveryNumberIsTheStudysFigure) {
  const Scene scene = test::scene_file("docs/tasks/flywheel_sheet.toml");
  const ReduceSheet sheet = sheet_of_scene(scene, 1.0 / 80);
  const MachineReduction r = reduce(scene, {});
  SizeOptions options;
  options.delta = 1.0 / 80, options.simulate = false;
  const Sizing sizing = size_flywheel(scene, options);
  const auto cells = cells_of(sheet.html());
  for (const ReducedPosition& p : r.positions) {
    const std::string row = std::to_string(p.number);
    EXPECT_NEAR(cell_at(cells, row, "M_d"), p.drive, 1e-12 * std::abs(p.drive));
    EXPECT_NEAR(cell_at(cells, row, "M_c"), p.load, 1e-12 * std::abs(p.load) + 1e-13);
    EXPECT_NEAR(cell_at(cells, row, "I_em"), p.mechanism_inertia, 1e-13);
    EXPECT_NEAR(cell_at(cells, row, "I_r"), p.inertia, 1e-13);
    EXPECT_NEAR(cell_at(cells, row, "I_r′"), p.slope, 1e-13);
    EXPECT_NEAR(cell_at(cells, row, "ΔT"), sizing.diagram.excess.value(p.phi), 1e-8);
    EXPECT_NEAR(cell_at(cells, row, "A_c"), sizing.diagram.load_work.value(p.phi), 1e-8);
  }
  ASSERT_TRUE(sheet.works);
  EXPECT_NEAR(sheet.works->exact.inertia, sizing.exact.inertia, 1e-9);
  EXPECT_NE(sheet.html().find("5.5165 kg·m² of “flywheel”"), std::string::npos);
}

// Cells say their value to half of their last digit.
TEST(Sheet, CellsAreRoundedAsTheyStand) {
  const SheetColumn column{"x", "m", {0.12345678, -0.00012345, 0}};
  const ColumnTexts texts = texts_of(column);
  EXPECT_EQ(texts.cells, (std::vector<std::string>{"0.12346", "−0.00012", "0"}));
  const ColumnTexts large = texts_of({"F", "N", {6.3e6, -12345.6, std::nan("")}});
  EXPECT_EQ(large.exponent, 6);
  EXPECT_EQ(large.cells, (std::vector<std::string>{"6.3000", "−0.0123", "—"}));
}

TEST(Sheet, HeightsOnPaperAreValuesOverTheirScale) {
  const ReduceSheet& sheet = sheet_of_file("scenes/crank_press.toml");
  const auto marks = marks_of(sheet.html());
  EXPECT_GT(marks.size(), 100u);
  for (const auto& m : marks) EXPECT_NEAR(m.zero - m.y, m.value / m.per_mm, 6e-4) << m.diagram << " " << m.position;
}

TEST(Sheet, LinksOnPaperAreTheirLengthsOverTheScale) {
  for (const char* scene : {"scenes/crank_press.toml", "scenes/shaper.toml", "scenes/knuckle_press.toml",
                            "scenes/four_bar_rocker.toml", "scenes/straight_line_saw.toml"}) {
    const ReduceSheet& sheet = sheet_of_file(scene);
    const MechanismOnSheet& m = sheet.mechanisms.front();
    Canvas canvas;
    const Box box{23, 8, 266, 174};
    const PlanPlaced plan = draw_linkage(canvas, box, m, sheet.motion.positions, 1);
    EXPECT_NEAR(plan.scale.per_mm, round_scale(plan.scale.per_mm), 1e-12 * plan.scale.per_mm);
    for (const SheetPosition& p : sheet.motion.positions) {
      const std::vector<PlanePoint> joints = m.joints(m.crank_angle(p.phi));
      for (const LinkageDrawing::Link& link : m.mechanism.data.drawing().links) {
        if (link.joints.size() < 2 || link.shape == "slot" || link.shape == "block") continue;
        const auto a = static_cast<std::size_t>(link.joints[0]), b = static_cast<std::size_t>(link.joints[1]);
        const Spot from = plan.spot(joints[a]), to = plan.spot(joints[b]);
        EXPECT_NEAR(std::hypot(to.x - from.x, to.y - from.y) * plan.scale.per_mm,
                    std::hypot(joints[b].x - joints[a].x, joints[b].y - joints[a].y), 1e-12)
            << scene;
        for (const Spot& s : {from, to})
          EXPECT_TRUE(s.x > box.x && s.x < box.right() && s.y > box.y && s.y < box.bottom()) << scene;
      }
    }
  }
}

// I₀ = kl μ_T/(ω² δ), tan ψ = ½ ω² μ_I/μ_T: the drawing gives back the inertia, and without a demanded δ the machine's own.
TEST(Sheet, TheDrawingGivesTheFlywheelThatTheMachineHas) {
  const ReduceSheet& sheet = sheet_of_offset_press();
  ASSERT_TRUE(sheet.works) << sheet.why_no_works;
  const WorksOnSheet& w = *sheet.works;
  const Scale energy{"μ_T", 5, "J"}, inertia{"μ_I", 0.002, "kg·m²"};
  const TangentOnPaper upper = on_paper(w.exact.upper, 0, energy, inertia),
                       lower = on_paper(w.exact.lower, 0, energy, inertia);
  const double mid = w.sizing.mid_speed, fastest = mid * (1 + w.delta / 2), slowest = mid * (1 - w.delta / 2);
  EXPECT_NEAR(std::tan(upper.psi), 0.5 * fastest * fastest * 0.002 / 5, 1e-9);
  EXPECT_NEAR(std::tan(lower.psi), 0.5 * slowest * slowest * 0.002 / 5, 1e-9);
  EXPECT_NEAR((upper.intercept - lower.intercept) * 5 / (mid * mid * w.delta), sheet.reduction.constant_inertia, 1e-6);
  EXPECT_NEAR(sheet.reduction.constant_inertia, 62, 1e-9);
}

// From position 0, which is not φ = 0: works are integrals of the torques from there, and vanish over the cycle.
TEST(Sheet, WorksCountFromPositionZero) {
  const ReduceSheet& sheet = sheet_of_offset_press();
  ASSERT_TRUE(sheet.works);
  const WorkDiagram& d = sheet.works->sizing.diagram;
  const double turn = 2 * std::numbers::pi, origin = sheet.motion.cycle.origin;
  ASSERT_GT(origin, 0.05);
  EXPECT_NEAR(sheet.from_origin(d.excess, turn), 0, 1e-8 * d.work);
  EXPECT_NEAR(sheet.from_origin(d.load_work, turn), d.work, 1e-8 * d.work);
  for (const double way : {0.5, 3.0, turn - 0.5 * origin}) {
    const double drive = sheet.from_origin(d.drive_work, way), load = sheet.from_origin(d.load_work, way);
    EXPECT_NEAR(drive, d.mean_torque() * way, 1e-8 * d.work);
    EXPECT_NEAR(sheet.from_origin(d.excess, way), drive - load, 1e-8 * d.work);
  }
}

// Nothing is drawn off the paper, nothing is no number, every tag is closed.
TEST(Sheet, PagesAreWhole) {
  const auto check = [](const std::string& html, const Paper& paper) {
    const auto count = [&](const std::string& what) {
      std::size_t n = 0;
      for (std::size_t at = html.find(what); at != std::string::npos; at = html.find(what, at + 1)) ++n;
      return n;
    };
    EXPECT_GT(count("<svg "), 4u);
    for (const std::string tag : {"svg", "g", "text", "tspan"})
      EXPECT_EQ(count("<" + tag + " "), count("</" + tag + ">")) << tag;
    for (const char* none : {"=\"nan", "=\"-nan", "=\"inf", ">nan", ">inf", " nan", "<script"})
      EXPECT_EQ(count(none), 0u) << none;
    EXPECT_NE(html.find("@page { size: " + paper.name + " landscape"), std::string::npos);
    static const std::regex place(R"re(<(line|circle|text)[^>]*? (?:x1|cx|x)="([^"]*)" (?:y1|cy|y)="([^"]*)")re");
    for (std::sregex_iterator i(html.begin(), html.end(), place), end; i != end; ++i) {
      const double x = std::stod((*i)[2]), y = std::stod((*i)[3]);
      EXPECT_TRUE(x >= 19 && x <= paper.width - 4 && y >= 4 && y <= paper.height - 4) << i->str();
    }
  };
  for (const char* scene : {"scenes/crank_press.toml", "scenes/shaper.toml", "scenes/four_bar_rocker.toml",
                            "docs/tasks/two_cylinder_compressor.toml", "scenes/single_cylinder_engine.toml"})
    check(sheet_of_file(scene).html(), {});
  // The structure stands beside the plan.
  for (const auto& [scene, group] :
       {std::pair("scenes/crank_press.toml", "RRP"), std::pair("scenes/shaper.toml", "RPR"),
        std::pair("scenes/four_bar_rocker.toml", "RRR")})
    EXPECT_NE(sheet_of_file(scene).html().find(group), std::string::npos) << scene;
  const Paper a3 = paper_named("A3");
  check(sheet_of(test::scene_file("scenes/drag_link_feeder.toml"), {},
                 {.paper = a3, .delta = {}, .flywheel = {}, .author = "N. N."})
            .html(),
        a3);
}

// Of any number of plans the first sheet is full, and each has the larger cell that fewer leave it; tables grow with the paper.
TEST(Sheet, ThePaperIsUsed) {
  static const std::regex cell(R"re(<rect class="grid" x="([^"]*)" y="([^"]*)" width="([^"]*)" height="([^"]*)")re");
  static const std::regex size(R"re(<text[^>]*font-size="([^"]*)"[^>]*data-row)re");
  for (const char* name : {"A4", "A3"})
    for (std::size_t count = 1; count < 40; ++count) {
      Sheets sheets(paper_named(name), {});
      const VectorPlan plan{.title = "0", .arrows = {{"v", {0, 0}, {1, 0.3 + 0.05 * static_cast<double>(count)}}}};
      add_plans(sheets, {.what = "plans", .note = "", .scale = "μ", .unit = "m/s"},
                std::vector<VectorPlan>(count, plan));
      const std::string html = sheets.html(), first = html.substr(0, html.find("</svg>"));
      double right = 0, bottom = 0;
      for (std::sregex_iterator i(first.begin(), first.end(), cell), end; i != end; ++i)
        right = std::max(right, std::stod((*i)[1]) + std::stod((*i)[3])),
        bottom = std::max(bottom, std::stod((*i)[2]) + std::stod((*i)[4]));
      EXPECT_NEAR(right, sheets.room().right(), 0.1) << name << ", " << count;
      EXPECT_NEAR(bottom, sheets.room().bottom(), 0.1) << name << ", " << count;
    }
  for (const auto& [name, least] : {std::pair("A4", 2.89), std::pair("A3", 4.0)}) {
    Sheets sheets(paper_named(name), {});
    SheetTable table{.title = "t", .labels = std::vector<std::string>(16, "1")};
    for (int k = 0; k < 10; ++k) table.columns.push_back({"v", "m/s", std::vector<double>(16, 1.2345)});
    add_table(sheets, table);
    const std::string html = sheets.html();
    std::smatch found;
    ASSERT_TRUE(std::regex_search(html, found, size));
    EXPECT_GE(std::stod(found[1]), least) << name;
  }
}

TEST(Sheet, WhatCannotBeDrawnIsRefusedInWords) {
  const auto words = [](const std::string& scene, const ReduceOptions& options) -> std::string {
    try {
      sheet_of(test::scene_file(scene), options, {});
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_NE(words("scenes/belt_conveyor.toml", {}).find("has none on its lines"), std::string::npos);
  ReduceOptions to;
  to.to = "press.slider";
  EXPECT_NE(words("scenes/crank_press.toml", to).find("--sheet with --to press.slider"), std::string::npos);
  ReduceOptions many;
  many.positions = 100;
  EXPECT_NE(words("scenes/crank_press.toml", many).find("a sheet has 4 … 72"), std::string::npos);
}

// --- forces ---

TEST(ForcesSheet, ASliderCranksNumbersAreTheStudysFigures) {
  const Scene scene = test::scene_file("scenes/crank_press.toml");
  ForcesOptions options;
  options.simulate = false;
  const ForcesSheet sheet = sheet_of(scene, options, {}, "");
  const Forces study = find_forces(scene, options);
  const auto cells = cells_of(sheet.html());
  for (int k = 0; k < 12; ++k) {
    const LinkageForces& f = study.prescribed->rows[static_cast<std::size_t>(k)].forces;
    if (k % 3 == 0) continue;  // a pin or the slider turns its sense of sliding there: its friction is either way
    const std::string row = std::to_string(k);
    const double dust = 1e-6 * std::abs(study.prescribed->reaction(1).value);
    EXPECT_NEAR(cell_at(cells, row, "R_01"), f.joints[0].force.magnitude(), dust) << k;
    EXPECT_NEAR(cell_at(cells, row, "R_12"), f.joints[1].force.magnitude(), dust) << k;
    EXPECT_NEAR(cell_at(cells, row, "R_23"), f.joints[2].force.magnitude(), dust) << k;
    EXPECT_NEAR(cell_at(cells, row, "R_03"), f.joints[3].normal, dust) << k;
    EXPECT_NEAR(cell_at(cells, row, "M_b"), f.torque, 1e-6 * std::abs(study.prescribed->torque.value)) << k;
    EXPECT_NEAR(cell_at(cells, row, "F_x2"), f.links[1].inertia_force.x, 1e-9 * f.links[1].inertia_force.magnitude())
        << k;
  }
  double most = 0;
  for (const auto& c : cells)
    if (c.column == "R_12") most = std::max(most, c.value);
  EXPECT_GT(most, 600e3);  // of the blow, between 11 and 0
}

// Of a crank that accelerates, every link's θ̈ = θ″ ω² + θ′ ε: the crank's is ε, the rod's β″ by sin β = (e + r sin φ)/l.
TEST(Kinematics, LinksTakeTheCranksAcceleration) {
  const Scene scene = test::scene_from(R"(
line = ["motor", "pump"]
motor = { kind = "torque source", torque = "30 N*m", inertia = "0.3 kg*m2" }
pump = { kind = "slider-crank", radius = "50 mm", rod = "180 mm", slider_mass = "3 kg" }
)");
  const auto model = compile(scene, scene.effects);
  const MechanismOnSheet pump = mechanisms_of(*model).front();
  const double w = 7, e = -40;
  for (const double phi : {0.4, 1.9, 3.7, 5.5}) {
    const MechanismMotionAt even = motion_at(pump, phi, w, 0), faster = motion_at(pump, phi, w, e);
    ASSERT_GE(faster.links.size(), 2u);
    EXPECT_NEAR(faster.links[0].alpha, e, 1e-12);
    const double part = 50.0 / 180, sine = part * std::sin(phi), cosine = std::sqrt(1 - sine * sine);
    const double rate = part * std::cos(phi) / cosine, curve = (rate * rate - 1) * sine / cosine;  // β′, β″
    EXPECT_NEAR(std::abs(faster.links[1].alpha), std::abs(curve * w * w + rate * e), 1e-10) << phi;
    for (std::size_t k = 0; k < faster.links.size(); ++k)
      EXPECT_NEAR(faster.links[k].alpha - even.links[k].alpha, even.links[k].omega / w * e, 1e-10) << k;
  }
}

// Σ R − m a_S = 0 of every link of a four-bar without weights; power in = power out + dT/dt.
TEST(ForcesSheet, EveryLinkIsInEquilibrium) {
  const Scene scene = test::scene_from(R"(
line = ["motor", "rocker"]
motor  = { kind = "torque source", torque = "30 N*m", inertia = "0.3 kg*m2" }
rocker = { kind = "four-bar", crank = "60 mm", coupler = "200 mm", rocker = "160 mm", ground = "220 mm", crank_mass = "2 kg", crank_com = "10 mm", crank_inertia = "0.01 kg*m2", coupler_mass = "3 kg", coupler_com = "90 mm", coupler_inertia = "0.02 kg*m2", rocker_mass = "4 kg", rocker_com = "100 mm", rocker_inertia = "0.06 kg*m2", load = { kind = "constant", torque = "-25 N*m" } }
[run]
start = { speed = "300 rpm" }
)");
  ForcesOptions options;
  options.simulate = false;
  const ForcesSheet sheet = sheet_of(scene, options, {}, "");
  ASSERT_EQ(sheet.joints.size(), 4u);
  for (std::size_t k = 0; k < 4; ++k)
    EXPECT_EQ(sheet.joints[k].symbol, (std::array{"R_01", "R_12", "R_23", "R_03"}[k]));
  const auto cells = cells_of(sheet.html());
  for (std::size_t k = 0; k < sheet.motion.positions.size(); ++k) {
    const LinkageForces& at = sheet.at(k);
    const auto left = [&](Force2 sum) { EXPECT_LT(sum.magnitude(), 1e-9 * (1 + at.joints[1].force.magnitude())) << k; };
    left(at.joints[0].force - at.joints[1].force + at.links[0].inertia_force);
    left(at.joints[1].force - at.joints[2].force + at.links[1].inertia_force);
    left(at.joints[2].force + at.joints[3].force + at.links[2].inertia_force);
    const LinkAt& motion = sheet.motion.at[k];
    const MechanismMotionAt m = motion_at(sheet.mechanisms.front(), motion.phi, motion.omega, 0);
    double rate = 0;  // dT/dt = Σ (m a·v + I ε ω) = −Σ (inertia force · v + couple · ω)
    const PlanarLinkage l = sheet.mechanisms.front().mechanism.data.linkage(at.state.phi);
    for (std::size_t i = 0; i < 3; ++i) {
      const Path& com = l.bodies[i].com;
      rate -= motion.omega * (at.links[i].inertia_force.x * static_cast<double>(com.x.slope()) +
                              at.links[i].inertia_force.y * static_cast<double>(com.y.slope())) +
              at.links[i].inertia_couple * m.links[i].omega;
    }
    EXPECT_NEAR(at.torque * motion.omega + at.state.load * m.velocity, rate, 1e-8 * (1 + std::abs(rate)));
    const std::string& row = sheet.motion.positions[k].label;
    EXPECT_NEAR(cell_at(cells, row, "R_12"), at.joints[1].force.magnitude(), 1e-8);
    EXPECT_NEAR(cell_at(cells, row, "M_load"), -25, 1e-12);
  }
}

}  // namespace
}  // namespace kurbel::sheet_test
