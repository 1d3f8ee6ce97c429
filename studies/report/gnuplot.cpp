// gnuplot.cpp — static figures of a report's plots, without a browser.
#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <set>

#include "engine/scene/printable.h"
#include "studies/files/spawn.h"
#include "studies/files/staging.h"
#include "studies/files/whole_file.h"
#include "studies/report/render.h"

namespace kurbel {
namespace {

// In the order of the roles.
const char* colour_of(Role role) {
  constexpr const char* colours[] = {"#7f7f7f", "#0072b2", "#404040", "#e69f00",
                                     "#009e73", "#d55e00", "#cc79a7", "#56b4e9"};
  return colours[static_cast<std::size_t>(role)];
}

// A title as a file's name: ASCII letters and digits, the rest joined by "_".
std::string slug(const std::string& title) {
  std::string name;
  for (const char c : title)
    if (std::isalnum(static_cast<unsigned char>(c)) && static_cast<unsigned char>(c) < 0x80)
      name += static_cast<char>(std::tolower(c));
    else if (!name.empty() && name.back() != '_')
      name += '_';
  while (!name.empty() && name.back() == '_') name.pop_back();
  return name.empty() ? "plot" : name.substr(0, 60);
}

// In gnuplot's single quotes a quote is doubled; a line feed would end the string, and the rest would be a command.
std::string quoted(const std::string& text) {
  std::string out = "'";
  for (const char c : printable(text)) out += c == '\'' ? "''" : std::string(1, c);
  return out + "'";
}

std::string label(const Axis& axis) {
  return axis.unit.empty() ? axis.label : fmt::format("{} [{}]", axis.label, axis.unit);
}

// Cells end halfway between their places, as on the page.
std::vector<double> edges_of(const std::vector<double>& at) {
  const std::size_t n = at.size();
  if (n < 2) return n ? std::vector<double>{at[0] - 0.5, at[0] + 0.5} : std::vector<double>{};
  std::vector<double> edges = {1.5 * at[0] - 0.5 * at[1]};
  for (std::size_t i = 1; i < n; ++i) edges.push_back((at[i - 1] + at[i]) / 2);
  edges.push_back(1.5 * at[n - 1] - 0.5 * at[n - 2]);
  return edges;
}

// One block per series, two blank lines between: gnuplot's "index".
std::string data_of(const Plot& plot) {
  std::string text =
      fmt::format("# {}\n# {}, {}\n", printable(plot.title), printable(label(plot.x)), printable(label(plot.y)));
  for (std::size_t i = 0; i < plot.series.size(); ++i) {
    const Series s = drawn(plot.series[i]);
    text += fmt::format("{}# {}\n", i ? "\n\n" : "", printable(s.name));
    for (std::size_t k = 0; k < s.x.size(); ++k) text += fmt::format("{:.9g} {:.9g}\n", s.x[k], s.y[k]);
  }
  if (!plot.map) return text;
  // "x y z", one block a row of the map, and where each cell begins and ends.
  const ColourMap& map = *plot.map;
  const std::vector<double> across = edges_of(map.x), up = edges_of(map.y);
  text += fmt::format("\n\n# {}\n", printable(map.name));
  for (std::size_t i = 0; i < map.y.size(); ++i) {
    for (std::size_t k = 0; k < map.x.size(); ++k)
      text += fmt::format("{:.7g} {:.7g} {:.6g} {:.7g} {:.7g} {:.7g} {:.7g}\n", map.x[k], map.y[i], map.z[i][k],
                          across[k], across[k + 1], up[i], up[i + 1]);
    text += '\n';
  }
  return text;
}

// For a name of several lines only the first: the others are used where there is space.
std::string places_of(const std::vector<std::string>& names) {
  std::string text = "(";
  for (std::size_t i = 0; i < names.size(); ++i)
    text += fmt::format("{}{} {}", i ? ", " : "", quoted(names[i].substr(0, names[i].find('\n'))), i + 1);
  return text + ")\n";
}

// Axis ranges, names of parts, bands, and labels beside lines.
std::string frame_of(const Plot& plot) {
  const auto range = [](const char* axis, const Axis& of) {
    if (!of.least && !of.greatest) return std::string();
    const auto end = [](const std::optional<double>& value) { return value ? fmt::format("{:.9g}", *value) : "*"; };
    return fmt::format("set {}range [{}:{}]\n", axis, end(of.least), end(of.greatest));
  };
  std::string text = range("x", plot.x) + range("y", plot.y);
  if (!plot.x.names.empty()) text += "set xtics rotate by -35 " + places_of(plot.x.names);
  if (!plot.y.names.empty()) text += "set ytics " + places_of(plot.y.names);
  for (const Band& band : plot.bands) {
    if (band.from < band.to)
      text += fmt::format(
          "set object rectangle from first {:.9g},graph 0 to first {:.9g},graph 1 fc rgb '{}' fs transparent solid "
          "0.15 noborder behind\n",
          band.from, band.to, colour_of(band.role));
    else
      text += fmt::format("set arrow from first {0:.9g},graph 0 to first {0:.9g},graph 1 nohead dt 2 lc rgb '{1}'\n",
                          band.from, colour_of(band.role));
    text += fmt::format("set label {} at first {:.9g},graph 0.97 font ',10' tc rgb '{}'\n", quoted(band.text),
                        band.from, colour_of(band.role));
  }
  const auto beside = [&](const Series& s, const std::string& words, std::size_t k) {
    if (!words.empty() && k < s.x.size())
      text += fmt::format("set label {} at first {:.9g},first {:.9g} offset 0.3,0.4 font ',10' tc rgb '{}'\n",
                          quoted(words), s.x[k], s.y[k], colour_of(s.role));
  };
  for (const Series& s : plot.series) beside(s, s.text_at_start, 0), beside(s, s.text_at_end, s.x.size() - 1);
  return text;
}

// Drawn twice, as SVG and as PNG.
std::string script_of(const Plot& plot, const std::string& name) {
  std::string text = fmt::format(
      "# gnuplot {0}.gp → {0}.svg and {0}.png\nreset\nset terminal svg size 900,480 noenhanced font 'sans,14' "
      "background 'white'\nset output '{0}.svg'\n"
      "set title {1}\nset xlabel {2}\nset ylabel {3}\nset grid lc rgb '#dddddd'\nset key outside below horizontal\n",
      name, quoted(plot.title), quoted(label(plot.x)), quoted(label(plot.y)));
  if (plot.x.logarithmic) text += "set logscale x\n";
  if (plot.y.logarithmic) text += "set logscale y\n";
  if (plot.equal_axes) text += "set size ratio -1\n";
  if (plot.map) text += "set autoscale fix\n";  // as far as its cells reach
  if (plot.bars) text += "set style fill solid 0.7\nset boxwidth 0.8 relative\nset xtics 1\n";
  for (const EventMark& mark : marks_drawn(plot))
    text += fmt::format(
        "set arrow from first {0:.9g},graph 0 to first {0:.9g},graph 0.04 nohead lc rgb '#d55e00' lw 1.4\n", mark.x);
  text += frame_of(plot);
  text += "plot ";
  if (plot.map)
    text += fmt::format("'{}.dat' index {} using 1:2:4:5:6:7:3 with boxxyerror fs solid noborder lc palette title {}{}",
                        name, plot.series.size(), quoted(fmt::format("{} [{}]", plot.map->name, plot.map->unit)),
                        plot.series.empty() ? "" : ", \\\n     ");
  bool first = true;
  for (const std::size_t i : order_of_drawing(plot)) {
    const Series& s = plot.series[i];
    text += fmt::format("{}'{}.dat' index {} with {} lw {} {}lc rgb '{}' title {}", first ? "" : ", \\\n     ", name, i,
                        plot.bars  ? "boxes"
                        : !s.line  ? s.sizes.empty() ? "points pt 7 ps 0.9" : "points pt 7 ps 0.4"
                        : s.points ? "linespoints pt 7 ps 0.5"
                                   : "lines",
                        stands_behind(plot, s) ? 4.5 : 1.5, s.dashed || s.role == Role::reference ? "dt 2 " : "",
                        colour_of(s.role), s.text_at_start.empty() && s.text_at_end.empty() ? quoted(s.name) : "''");
    first = false;
  }
  return text + fmt::format(
                    "\nset terminal pngcairo size 1350,720 noenhanced font 'sans,14' background 'white'\nset output "
                    "'{0}.png'\nreplot\n",
                    name);
}

}  // namespace

std::vector<TextFile> gnuplot_files(const Report& report) {
  std::vector<TextFile> files;
  std::set<std::string> taken;
  for (const ReportSection& section : report.sections)
    for (const Card& card : section.cards) {
      const Plot* plot = std::get_if<Plot>(&card);
      if (!plot || (plot->series.empty() && !plot->map)) continue;
      std::string name = slug(plot->title);
      for (int n = 2; !taken.insert(name).second; ++n) name = slug(plot->title) + "_" + std::to_string(n);
      files.push_back({name + ".dat", data_of(*plot)});
      files.push_back({name + ".gp", script_of(*plot, name)});
    }
  return files;
}

std::vector<std::string> draw_by_gnuplot(const std::vector<TextFile>& files, int folder, int kept) {
  std::vector<std::string> drawn, scripts = {"gnuplot"};
  for (const TextFile& file : files)
    if (file.name.ends_with(".gp")) scripts.push_back(file.name);
  if (scripts.size() == 1 || !is_installed("gnuplot")) return drawn;
  // One process draws all plots; if a script fails, each is drawn by its own process.
  const bool all_well = run_and_wait(scripts, folder, kept);
  for (std::size_t i = 1; i < scripts.size(); ++i) {
    const bool well = all_well || run_and_wait({"gnuplot", scripts[i]}, folder, kept);
    const std::string name = scripts[i].substr(0, scripts[i].size() - 3);
    for (const char* extension : {".svg", ".png"})
      if (const std::string picture = name + extension; faccessat(folder, picture.c_str(), F_OK, 0) == 0) {
        if (well)
          drawn.push_back(picture);
        else
          unlinkat(folder, picture.c_str(), 0);
      }
  }
  return drawn;
}

int write_gnuplot(const Report& report, const std::string& path) {
  std::filesystem::create_directories(path);
  const std::vector<TextFile> files = gnuplot_files(report);
  for (const TextFile& file : files) write_whole(std::filesystem::path(path) / file.name, file.text);
  const Descriptor folder = open_folder(AT_FDCWD, path);
  if (!folder) return 0;
  const std::vector<std::string> drawn = draw_by_gnuplot(files, folder.get());
  return static_cast<int>(
      std::count_if(drawn.begin(), drawn.end(), [](const std::string& name) { return name.ends_with(".svg"); }));
}

}  // namespace kurbel
