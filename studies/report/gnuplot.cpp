// gnuplot.cpp — static figures of a report's plots, without a browser.
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <set>
#include <stdexcept>

#include "studies/report/report.h"
#include "studies/report/thin.h"

namespace kurbel {
namespace {

const char* colour_of(Role role) {
  switch (role) {
    case Role::rigid:
      return "#7f7f7f";
    case Role::elastic:
      return "#0072b2";
    case Role::reference:
      return "#404040";
    case Role::orange:
      return "#e69f00";
    case Role::green:
      return "#009e73";
    case Role::vermillion:
      return "#d55e00";
    case Role::purple:
      return "#cc79a7";
    case Role::sky:
      return "#56b4e9";
  }
  return "#000000";
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

// In gnuplot's single quotes a quote is doubled.
std::string quoted(const std::string& text) {
  std::string out = "'";
  for (const char c : text) out += c == '\'' ? "''" : std::string(1, c);
  return out + "'";
}

std::string label(const Axis& axis) {
  return axis.unit.empty() ? axis.label : fmt::format("{} [{}]", axis.label, axis.unit);
}

void write(const std::filesystem::path& path, const std::string& text) {
  std::ofstream out(path, std::ios::binary);
  out << text;
  out.close();
  if (!out) throw std::runtime_error(fmt::format("cannot write {}: is there room and permission?", path.string()));
}

// One block per series, two blank lines between: gnuplot's "index".
std::string data_of(const Plot& plot) {
  std::string text = fmt::format("# {}\n# {}, {}\n", plot.title, label(plot.x), label(plot.y));
  for (std::size_t i = 0; i < plot.series.size(); ++i) {
    std::vector<double> x = plot.series[i].x, y = plot.series[i].y;
    thin_by_extremes(x, y, points_per_series);
    text += fmt::format("{}# {}\n", i ? "\n\n" : "", plot.series[i].name);
    for (std::size_t k = 0; k < x.size(); ++k) text += fmt::format("{:.9g} {:.9g}\n", x[k], y[k]);
  }
  return text;
}

// Some hundreds of marks at the most; more run into each other.
std::vector<EventMark> marks_of(const Plot& plot) {
  std::vector<EventMark> marks;
  const std::size_t stride = 1 + plot.marks.size() / 400;
  for (std::size_t i = 0; i < plot.marks.size(); i += stride) marks.push_back(plot.marks[i]);
  return marks;
}

// Drawn twice, as SVG and as PNG.
std::string script_of(const Plot& plot, const std::string& name) {
  std::string text = fmt::format(
      "# gnuplot {0}.gp → {0}.svg and {0}.png\nset terminal svg size 900,480 noenhanced font 'sans,14' background "
      "'white'\nset output '{0}.svg'\n"
      "set title {1}\nset xlabel {2}\nset ylabel {3}\nset grid lc rgb '#dddddd'\nset key outside below horizontal\n",
      name, quoted(plot.title), quoted(label(plot.x)), quoted(label(plot.y)));
  if (plot.x.logarithmic) text += "set logscale x\n";
  if (plot.y.logarithmic) text += "set logscale y\n";
  if (plot.equal_axes) text += "set size ratio -1\n";
  if (plot.bars) text += "set style fill solid 0.7\nset boxwidth 0.8 relative\nset xtics 1\n";
  for (const EventMark& mark : marks_of(plot))
    text += fmt::format(
        "set arrow from first {0:.9g},graph 0 to first {0:.9g},graph 0.04 nohead lc rgb '#d55e00' lw 1.4\n", mark.x);
  text += "plot ";
  for (std::size_t i = 0; i < plot.series.size(); ++i) {
    const Series& s = plot.series[i];
    text += fmt::format("{}'{}.dat' index {} with {} lw 1.5 {}lc rgb '{}' title {}", i ? ", \\\n     " : "", name, i,
                        plot.bars  ? "boxes"
                        : !s.line  ? "points pt 7 ps 0.9"
                        : s.points ? "linespoints pt 7 ps 0.5"
                                   : "lines",
                        s.dashed || s.role == Role::reference ? "dt 2 " : "", colour_of(s.role), quoted(s.name));
  }
  return text + fmt::format(
                    "\nset terminal pngcairo size 1350,720 noenhanced font 'sans,14' background 'white'\nset output "
                    "'{0}.png'\nreplot\n",
                    name);
}

}  // namespace

int write_gnuplot(const Report& report, const std::string& folder) {
  std::filesystem::create_directories(folder);
  std::set<std::string> taken;
  int drawn = 0;
  for (const ReportSection& section : report.sections)
    for (const Card& card : section.cards) {
      const Plot* plot = std::get_if<Plot>(&card);
      if (!plot || plot->series.empty()) continue;
      std::string name = slug(plot->title);
      for (int n = 2; !taken.insert(name).second; ++n) name = slug(plot->title) + "_" + std::to_string(n);
      const std::filesystem::path base = std::filesystem::path(folder) / name;
      write(base.string() + ".dat", data_of(*plot));
      write(base.string() + ".gp", script_of(*plot, name));
      // The folder goes by the environment, so that no name is read as a command.
      setenv("KURBEL_PLOTS", folder.c_str(), 1);
      const std::string command =
          fmt::format("cd \"$KURBEL_PLOTS\" && command -v gnuplot > /dev/null && gnuplot {}.gp > /dev/null 2>&1", name);
      if (std::system(command.c_str()) == 0) ++drawn;
    }
  return drawn;
}

}  // namespace kurbel
