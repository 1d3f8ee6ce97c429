// render.h — a study's report as one self-contained HTML page, or as gnuplot files.
#pragma once

#include <string>
#include <vector>

#include "studies/findings/report.h"

namespace kurbel {

// Points per series on a page; longer series are thinned, with their peaks kept.
inline constexpr std::size_t points_per_series = 2400;

// Whether it is the rigid machine's curve, drawn thick and grey behind others; a plot's series in drawing order.
bool stands_behind(const Plot& plot, const Series& series);
std::vector<std::size_t> order_of_drawing(const Plot& plot);
// At most some hundreds of marks, since more would overlap.
std::vector<EventMark> marks_drawn(const Plot& plot);

// A series as drawn: a longer curve thinned with its peaks kept, a longer cloud of markers reduced at random, with
// their labels. A thinned curve has neither labels nor sizes.
Series drawn(const Series& series);

// Letterhead above the title: a logo as SVG and a name; empty: neither.
struct Letterhead {
  std::string brand_svg = {}, author = {};
};

// The page with inlined styles, scripts and data; it loads nothing from the network, and forbids it by its content policy.
std::string html_of(const Report& report, const Letterhead& head = {});
void write_html(const Report& report, const std::string& path);

struct TextFile {
  std::string name, text;
};
// NAME.dat and NAME.gp for every plot.
std::vector<TextFile> gnuplot_files(const Report& report);
// Runs gnuplot, if installed, on these files in a folder; `kept` stays open for it (spawn.h). Returns the pictures
// drawn, NAME.svg and NAME.png.
std::vector<std::string> draw_by_gnuplot(const std::vector<TextFile>& files, int folder, int kept = -1);
// Files and pictures into a folder. Returns the number of plots drawn.
int write_gnuplot(const Report& report, const std::string& folder);

}  // namespace kurbel
