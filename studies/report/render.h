// render.h — a study's report as one self-contained HTML page, or as gnuplot's files.
#pragma once

#include <string>
#include <vector>

#include "studies/findings/report.h"

namespace kurbel {

// Points of a series that a page holds; longer ones are thinned with their peaks kept.
inline constexpr std::size_t points_per_series = 2400;

// The rigid machine's curve, thick and grey, where there are others before it; a plot's series in the order of drawing.
bool stands_behind(const Plot& plot, const Series& series);
std::vector<std::size_t> order_of_drawing(const Plot& plot);
// Some hundreds of marks at the most; more run into each other.
std::vector<EventMark> marks_drawn(const Plot& plot);

// A series as it is drawn: of a longer curve what keeps its peaks, of a longer cloud of markers some, drawn by
// chance, with what is said of them. What is left of a thinned curve has neither labels nor sizes.
Series drawn(const Series& series);

// Whose report it is: a logo as SVG and a name, above the title; empty: neither.
struct Letterhead {
  std::string brand_svg = {}, author = {};
};

// The page: styles, scripts and data inlined; it asks the network for nothing, and says so to the browser.
std::string html_of(const Report& report, const Letterhead& head = {});
void write_html(const Report& report, const std::string& path);

struct TextFile {
  std::string name, text;
};
// For every plot NAME.dat and NAME.gp.
std::vector<TextFile> gnuplot_files(const Report& report);
// Runs gnuplot, where it is installed, on these files in a folder; `kept` stays open for it (spawn.h). Returns the
// pictures that it drew, NAME.svg and NAME.png.
std::vector<std::string> draw_by_gnuplot(const std::vector<TextFile>& files, int folder, int kept = -1);
// Both into a folder. Returns how many plots were drawn.
int write_gnuplot(const Report& report, const std::string& folder);

}  // namespace kurbel
