// report_test.cpp — a report is one self-contained page, keeps every peak, and stays small.
#include "studies/findings/report.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <regex>

#include "studies/findings/figure_text.h"
#include "studies/findings/thin.h"
#include "studies/findings/trace.h"
#include "studies/report/render.h"
#include "studies/run/compare.h"
#include "studies/run/run_findings.h"
#include "studies/scenes/kinds.h"
#include "tests/support/files.h"
#include "tests/support/scenes.h"

namespace kurbel::report_test {
namespace {

// The data that the page's script reads.
nlohmann::json data_of(const std::string& html) {
  const std::string open = "<script type=\"application/json\" id=\"data\">";
  const std::size_t begin = html.find(open) + open.size();
  return nlohmann::json::parse(html.substr(begin, html.find("</script>", begin) - begin));
}

const char* geared_train = R"(
title = "Train </script><script>alert(1)</script>"
line  = ["motor", "shaft", "gearbox", "fan"]
motor   = { kind = "dc shunt motor", stall_torque = "100 N*m", no_load_speed = "100 rad/s", inertia = "0.1 kg*m2" }
shaft   = { kind = "coupling", stiffness = "5 kN*m/rad", damping = "1 N*m*s/rad" }
gearbox = { kind = "gearbox", stages = [{ teeth = [20, 60], inertia = ["0.01 kg*m2", "0.1 kg*m2"] }] }
fan     = { kind = "load", quadratic = "0.1 N*m*s2/rad2", inertia = "2 kg*m2" }
run     = { start = "rest", until = "0.5 s", accuracy = 1e-5 }
)";

Comparison compared(const char* text) {
  const Scene scene = parse_scene(text, "train.toml", all_kinds());
  SimulateOptions options;
  options.traces = true;
  Effects elastic;
  elastic.all_elastic = true;
  return compare(scene, {{}, elastic, "rigid", "elastic"}, options);
}

TEST(Thinning, KeepsEndsAndExtremes) {
  std::vector<double> x, y;
  for (int i = 0; i < 1000000; ++i) {
    x.push_back(1e-5 * i);
    y.push_back(std::sin(1e-4 * i));
  }
  y[123457] = 7.5;  // peaks of a single sample
  y[765431] = -3.25;
  thin_by_extremes(x, y, 2000);
  EXPECT_LE(x.size(), 2000u);
  EXPECT_GT(x.size(), 1500u);
  EXPECT_EQ(*std::max_element(y.begin(), y.end()), 7.5);
  EXPECT_EQ(*std::min_element(y.begin(), y.end()), -3.25);
  EXPECT_EQ(x[static_cast<std::size_t>(std::max_element(y.begin(), y.end()) - y.begin())], 1e-5 * 123457);
  EXPECT_EQ(x.front(), 0);
  EXPECT_EQ(x.back(), 1e-5 * 999999);
  EXPECT_TRUE(std::is_sorted(x.begin(), x.end()));
}

// A trace is thinned whenever it is full: its early part must not grow coarser than its late part.
TEST(Thinning, IsEvenWhenRepeated) {
  std::vector<double> x, y;
  for (int i = 0; i < 200000; ++i) {
    x.push_back(i);
    y.push_back(std::sin(0.3 * i));
    if (x.size() >= 2000) thin_by_extremes(x, y, 1000);
  }
  thin_by_extremes(x, y, 1000);
  double widest = 0;
  for (std::size_t i = 1; i < x.size(); ++i) widest = std::max(widest, x[i] - x[i - 1]);
  EXPECT_LT(widest, 4 * 200000.0 / 500);
}

TEST(Thinning, LeavesShortCurvesAlone) {
  std::vector<double> x = {0, 1, 2}, y = {5, 6, 7};
  thin_by_extremes(x, y, 4);
  EXPECT_EQ(x.size(), 3u);
}

// A grid of 100 columns keeps all of them: each tenth of 100 000 rows, 100 a column; chance scatters that by √(100 · 0.9).
TEST(Thinning, ACloudsChoiceHasNoPatternOfItsOwn) {
  const std::vector<std::size_t> kept = drawn_by_chance(100000, 10000);
  ASSERT_EQ(kept.size(), 10000u);
  EXPECT_TRUE(std::is_sorted(kept.begin(), kept.end()));
  std::vector<double> in_column(100, 0);
  for (const std::size_t i : kept) ++in_column.at(i % 100);
  const auto [least, most] = std::minmax_element(in_column.begin(), in_column.end());
  EXPECT_GT(*least, 100 - 4 * std::sqrt(90.0));
  EXPECT_LT(*most, 100 + 4 * std::sqrt(90.0));
  const auto in_first_half = std::lower_bound(kept.begin(), kept.end(), 50000u) - kept.begin();
  EXPECT_NEAR(static_cast<double>(in_first_half), 5000, 4 * std::sqrt(10000 * 0.25 * 0.9));
  EXPECT_EQ(drawn_by_chance(5, 9).size(), 5u);
}

TEST(JsonText, ClosesNoScriptAndParsesBack) {
  const std::string nasty = "</script><!-- \"quoted\" back\\slash\n\ttab \x01 µ·°";
  const std::string json = json_text({{"text", nasty}}, JsonForm::in_page);
  EXPECT_EQ(json.find('<'), std::string::npos);
  EXPECT_EQ(nlohmann::json::parse(json).at("text").get<std::string>(), nasty);
}

// Terminal and page show one form of value and error, every figure's.
TEST(Report, ShowsFiguresAsTheTerminalDoes) {
  const Result r = test::run(geared_train);
  const nlohmann::json data = data_of(html_of(output_of(r).report()));
  const std::string table = output_of(r).text();
  std::map<std::string, nlohmann::json> rows;
  for (const auto& section : data.at("sections"))
    for (const auto& card : section.at("cards"))
      if (card.at("kind") == "table")
        for (const auto& row : card.at("rows")) rows[row.at(0)] = row;
  ASSERT_FALSE(r.figures.empty());
  for (const Figure& f : r.figures) {
    const FigureText text = figure_text(f);
    ASSERT_TRUE(rows.count(f.name)) << f.name;
    EXPECT_EQ(rows[f.name].at(1), text.value) << f.name;
    EXPECT_EQ(rows[f.name].at(2), text.error) << f.name;
    const std::size_t line = table.find(" " + f.name + " ");
    ASSERT_NE(line, std::string::npos) << f.name;
    const std::string row = table.substr(line, table.find('\n', line) - line);
    EXPECT_NE(row.find(" " + text.value + " "), std::string::npos) << row;
    EXPECT_NE(row.find(text.error), std::string::npos) << row;
  }
}

TEST(Report, LoadsNothingFromElsewhere) {
  const std::string html = html_of(output_of(compared(geared_train)).report());
  EXPECT_NE(html.find("default-src 'none'"), std::string::npos);
  // Of the page itself; Plotly's text holds addresses that it never calls, which the browser test sees to.
  const std::size_t plotly = html.find("plotly.js");
  const std::string own = html.substr(0, html.rfind("<script>", plotly)) + html.substr(html.find("</script>", plotly));
  EXPECT_FALSE(std::regex_search(own, std::regex("(src|href)\\s*=\\s*[\"']?(https?:)?//")));
  EXPECT_EQ(own.find("@import"), std::string::npos);
  EXPECT_EQ(own.find("alert(1)</script>"), std::string::npos) << "a title is text";
}

TEST(Report, HoldsBothModelsAndTheMachine) {
  const Comparison c = compared(geared_train);
  const nlohmann::json data = data_of(html_of(output_of(c).report()));
  EXPECT_EQ(in_one_line(data["conclusion"].get<std::vector<std::string>>()), output_of(c).conclusion());
  int plots = 0, machines = 0;
  for (const auto& section : data["sections"])
    for (const auto& card : section["cards"]) {
      if (card["kind"] == "machine") {
        ++machines;
        EXPECT_EQ(card["parts"].size(), 4u);
        EXPECT_EQ(card["motions"].size(), 2u);
        EXPECT_GT(card["enlargement"].get<double>(), 1);
      }
      if (card["kind"] != "plot") continue;
      ++plots;
      for (const auto& series : card["series"]) EXPECT_GT(series["y"].size(), 10u) << card["title"];
    }
  EXPECT_EQ(machines, 1);
  EXPECT_GE(plots, 4);
}

TEST(Trace, PlotsReachThePeaksThatTheFiguresReport) {
  const Comparison c = compared(geared_train);
  const Trace* torque = c.b.traces->find("torque.shaft");
  ASSERT_TRUE(torque);
  const double drawn = *std::max_element(torque->y.begin(), torque->y.end()),
               reported = c.b.find("peak_torque.shaft")->value;
  EXPECT_NEAR(drawn, reported, 5e-3 * reported);
}

// T + V − Σ work stays the same along the traces.
// Every curve over the angle is of the last whole cycle alone: from 0 to the cycle's end, without a way back, and as high
// as the same quantity over time between the cycle's begin and end.
void expect_curves_of_one_cycle(const char* file, double until) {
  SCOPED_TRACE(file);
  Scene scene = test::scene_file(file);
  scene.run.until = until;
  SimulateOptions options;
  options.traces = true;
  options.measure_error = false;
  const Result r = simulate(scene, scene.effects, "elastic", options);
  ASSERT_TRUE(r.complete) << r.diagnosis;
  ASSERT_EQ(r.traces->last_cycles.size(), 2u);
  for (const CycleTraces& cycle : r.traces->last_cycles) {
    ASSERT_GE(cycle.traces.size(), 4u);
    for (const Trace& over_angle : cycle.traces) {
      SCOPED_TRACE(over_angle.name);
      EXPECT_TRUE(std::is_sorted(over_angle.x.begin(), over_angle.x.end()));
      EXPECT_NEAR(over_angle.x.front(), 0, 1e-6);
      EXPECT_NEAR(over_angle.x.back(), r.model->cycle, 1e-6);
      const Trace& over_time = *r.traces->find(over_angle.name);
      double highest = -HUGE_VAL, largest = 0;
      for (const double y : over_time.y) largest = std::max(largest, std::abs(y));
      for (std::size_t i = 0; i < over_time.x.size(); ++i)
        if (over_time.x[i] >= cycle.begin && over_time.x[i] <= cycle.end) highest = std::max(highest, over_time.y[i]);
      const double found = *std::max_element(over_angle.y.begin(), over_angle.y.end());
      EXPECT_NEAR(found, highest, 1e-6 * largest);
    }
  }
}

TEST(Trace, CurvesOverTheAngleAreOfOneCycle) {
  expect_curves_of_one_cycle("scenes/crank_press.toml", 4);
  expect_curves_of_one_cycle("docs/tasks/two_cylinder_compressor.toml", 2);  // no event where its turns end
}

TEST(Trace, EnergyTracesBalance) {
  const Comparison c = compared(geared_train);
  const auto last = [&](const char* name) {
    return c.b.traces->find(name)->y.back() - c.b.traces->find(name)->y.front();
  };
  const double stored = last("kinetic_energy") + last("stored_energy");
  const double work = last("work.driving") + last("work.useful") + last("work.harmful") + last("work.weight");
  EXPECT_NEAR(stored, work, 1e-4 * std::abs(last("work.driving")));
}

TEST(Report, MillionSamplesStayBelowTenMegabytes) {
  Report report{.title = "Long"};
  ReportSection& section = report.add("Plots");
  for (int p = 0; p < 12; ++p) {
    Plot plot{.title = "Plot", .x = {"time", "s"}, .y = {"torque", "N·m"}, .series = {}};
    for (int s = 0; s < 2; ++s) {
      Series series{.name = "series", .role = s ? Role::elastic : Role::rigid, .x = {}, .y = {}};
      for (int i = 0; i < 1000000 / (p ? 10 : 1); ++i) {
        series.x.push_back(1e-6 * i);
        series.y.push_back(std::sin(0.01 * i) * (p + 1) / 3);
      }
      plot.series.push_back(std::move(series));
    }
    for (int i = 0; i < 100000; ++i) plot.marks.push_back({1e-5 * i, "load edge"});
    section.cards.push_back(std::move(plot));
  }
  EXPECT_LT(html_of(report).size(), 10'000'000u);
}

TEST(Report, WritesGnuplotFiles) {
  const test::ScratchFolder scratch;
  const std::filesystem::path folder = scratch / "a report's plots";
  Report report{.title = "Gnuplot"};
  report.add("").cards.push_back(
      Plot{.title = "Torque, it's",
           .x = {"time", "s"},
           .y = {"torque", "N·m"},
           .series = {{.name = "one's", .role = Role::elastic, .x = {0, 1, 2}, .y = {1, 4, 9}}}});
  const int drawn = write_gnuplot(report, folder.string());
  EXPECT_TRUE(std::filesystem::exists(folder / "torque_it_s.dat"));
  EXPECT_TRUE(std::filesystem::exists(folder / "torque_it_s.gp"));
  if (drawn > 0) {
    EXPECT_GT(std::filesystem::file_size(folder / "torque_it_s.svg"), 1000u);
  }
}

// Grey and thick behind whatever else there is, in the page and in gnuplot's figures, however the study lists its models;
// dashed lines and bars of its colour stay where they are.
TEST(Report, DrawsTheRigidMachineBehind) {
  const auto plot = [](bool dashed) {
    return Plot{.title = "Speed",
                .x = {"time", "s"},
                .y = {"speed", "rpm"},
                .series = {{.name = "elastic", .role = Role::elastic, .x = {0, 1}, .y = {1, 2}},
                           {.name = "rigid", .role = Role::rigid, .x = {0, 1}, .y = {1, 1}, .dashed = dashed}}};
  };
  for (const bool dashed : {false, true}) {
    SCOPED_TRACE(dashed);
    Report report{.title = "Order"};
    report.add("").cards.push_back(plot(dashed));
    const nlohmann::json series = data_of(html_of(report))["sections"][0]["cards"][0]["series"];
    EXPECT_EQ(series[0]["name"], dashed ? "elastic" : "rigid");
    EXPECT_EQ(series[0].contains("behind"), !dashed);
    EXPECT_FALSE(series[1].contains("behind"));
    Plot alone = plot(dashed);
    alone.series.erase(alone.series.begin());
    EXPECT_FALSE(stands_behind(alone, alone.series.front())) << "there is nothing before it";
    const std::string script = gnuplot_files(report)[1].text;
    EXPECT_EQ(script.find("index 1 ") < script.find("index 0 "), !dashed) << script;
    EXPECT_EQ(script.find("lw 4.5") != std::string::npos, !dashed) << script;
  }
}

// Of figures that nothing has there is no empty frame.
TEST(Report, LeavesOutPlotsOfNothing) {
  Findings f{.title = "Nothing"};
  const Chapter in = f.chapter("Plots");
  const auto plot = [](std::vector<double> at) {
    return Plot{.title = "p", .x = {"x"}, .y = {"y"}, .series = {{.name = "s", .x = at, .y = at}}};
  };
  f.draw(in, [&] {
    return std::vector<Plot>{plot({}), plot({1, 2}), Plot{.title = "none", .x = {}, .y = {}, .series = {}}};
  });
  EXPECT_EQ(page_of(f).sections.at(0).cards.size(), 1u);
}

// A sentence has four digits at most; counts and numbers of standards are whole.
TEST(Report, NotesOfPlotsHaveFourDigits) {
  Findings f{.title = "Notes"};
  f.draw(f.chapter("Plots"), [] {
    return std::vector<Plot>{{.title = "p",
                              .x = {"x"},
                              .y = {"y"},
                              .series = {{.name = "s", .x = {1, 2}, .y = {1, 2}}},
                              .note = "99.9067 % of 12345 rows (ISO 21771), 1582.48 J, 15052.53 N·m/rad, 0.25 s"}};
  });
  EXPECT_EQ(std::get<Plot>(page_of(f).sections.at(0).cards.at(0)).note,
            "99.91 % of 12345 rows (ISO 21771), 1582 J, 15.05 kN·m/rad, 0.25 s");
}

// A tile has a unit prefix from 1e4 on, whatever its unit.
TEST(Report, TilesTakeUnitPrefixes) {
  Findings f{.title = "Tiles"};
  f.figures = {{Estimate{570000, 50000}, "stiffness", "N*m/rad"}, {Estimate{9000, 0.0}, "torque", "N*m"}};
  const Report page = page_of(f);
  EXPECT_EQ(page.figures.at(0).unit, "kN·m/rad");
  EXPECT_DOUBLE_EQ(page.figures.at(0).value, 570);
  EXPECT_EQ(page.figures.at(1).unit, "N*m");
}

// The first screen has the digits of the conclusion; what is known stands below.
TEST(Report, TilesRoundAndReportWhatIsKnown) {
  const TileText peak = tile_text({8874.28314, 0.0021}), drop = tile_text({0.104382, 0.0112}),
                 exact = tile_text({10, 0.0});
  EXPECT_EQ(peak.value + "|" + peak.known + "|" + peak.error, "8874|8874.28|");
  EXPECT_EQ(drop.value + "|" + drop.known + "|" + drop.error, "0.104||± 0.012");
  EXPECT_EQ(exact.value + "|" + exact.known, "10|");
  EXPECT_EQ(tile_text({39.281234}, 6).known, "39.2812");
}

// A cloud has no peaks: what is left of it is still what was said of each point; a curve keeps its peaks.
TEST(Report, ThinnedCloudsKeepWhatTheirPointsAre) {
  Series cloud{.name = "cloud", .x = {}, .y = {}, .points = true, .line = false};
  for (int i = 0; i < 6000; ++i) {
    cloud.x.push_back(i), cloud.y.push_back(2.0 * i);
    cloud.labels.push_back(std::to_string(i)), cloud.sizes.push_back(0.5);
  }
  const Series some = drawn(cloud);
  ASSERT_EQ(some.x.size(), points_per_series);
  ASSERT_EQ(some.labels.size(), points_per_series);
  EXPECT_EQ(some.sizes.size(), points_per_series);
  for (std::size_t i = 0; i < some.x.size(); ++i)
    EXPECT_EQ(some.labels[i], std::to_string(static_cast<int>(some.x[i])));
  EXPECT_TRUE(std::is_sorted(some.x.begin(), some.x.end()));
  cloud.line = true, cloud.y[1234] = 1e6;
  const Series curve = drawn(cloud);
  EXPECT_LE(curve.x.size(), points_per_series);
  EXPECT_NE(std::find(curve.y.begin(), curve.y.end(), 1e6), curve.y.end());
  EXPECT_TRUE(curve.labels.empty());
}

// Of a list 200, 400, 800 the middle cell reaches from 300 to 600.
TEST(Report, MapsOfUnevenPlacesHaveCellsThatMeet) {
  Plot plot{.title = "uneven", .x = {"a"}, .y = {"b"}, .series = {}};
  plot.map = ColourMap{.name = "c", .unit = "", .x = {200, 400, 800}, .y = {1, 2}, .z = {{1, 2, 3}, {4, 5, 6}}};
  Report report;
  report.sections.push_back({.title = "maps", .cards = {plot}});
  const std::vector<TextFile> files = gnuplot_files(report);
  ASSERT_EQ(files.size(), 2u);
  EXPECT_NE(files[0].text.find("\n400 2 5 300 600 1.5 2.5\n"), std::string::npos) << files[0].text;
  EXPECT_NE(files[1].text.find("boxxyerror"), std::string::npos);
}

}  // namespace
}  // namespace kurbel::report_test
