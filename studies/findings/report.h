// report.h — what a study tells people: data and words here; studies/report makes a page or gnuplot's files of it.
//
//   Report report{.title = "Size of the flywheel", .conclusion = "420 kg·m² keep δ below 0.05."};
//   report.figures.push_back({"flywheel", 420, "kg*m2", 0.2});
//   report.add("Results").cards.push_back(Plot{"δ falls with the flywheel's inertia", …});
//   write_html(report, "results/size/report.html");
#pragma once

#include <deque>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "engine/scene/speed_unit.h"

namespace kurbel {

// What a colour stands for; the same everywhere. The rest of the palette is that of Okabe and Ito.
enum class Role { rigid, elastic, reference, orange, green, vermillion, purple, sky };
Role further_role(std::size_t i);  // colours for a list of like things

// A figure on the first screen.
struct KeyFigure {
  std::string name;
  double value = 0;
  std::string unit = {};  // SI, as in a scene: "N*m"
  std::optional<double> error = {};
  std::string note = {};
  int digits = 0;          // significant ones; 0: by the error
  std::string means = {};  // its name in the dictionary: "delta.press"; empty: it has none
};

struct Axis {
  std::string label, unit = {};  // unit as it is to be read
  bool logarithmic = false;
  std::optional<double> least = {}, greatest = {};  // ends of what is shown; default: of the data
  std::vector<std::string> names = {};              // of 1, 2, 3 …: an axis of parts instead of numbers
};

struct Series {
  std::string name;
  Role role = Role::elastic;
  std::vector<double> x = {}, y = {};
  bool dashed = false;                   // references
  bool points = false;                   // markers beside the line
  bool line = true;                      // false: markers alone
  std::vector<std::string> labels = {};  // what a point is, for those who point at it; none, or one each
  std::vector<double> sizes = {};        // of markers, over the usual one; none, or one each
  // Written beside its first and its last point, in its colour; a series that says its name so is not in the legend.
  std::string text_at_start = {}, text_at_end = {};

  void add(double at, double value) { x.push_back(at), y.push_back(value); }
};

// Something that happened, on the x-axis.
struct EventMark {
  double x = 0;
  std::string text;
};

// A stretch of the x-axis: barred speeds, a range of operation; of no width: a line.
struct Band {
  double from = 0, to = 0;
  std::string text;
  Role role = Role::vermillion;
};

// Colours over a plane: z[i][k] at y[i] and x[k]; both ascend. Lines of the plot lie above it.
struct ColourMap {
  std::string name, unit;  // of what the colours stand for
  std::vector<double> x, y;
  std::vector<std::vector<double>> z;  // NaN: nothing known there
};

struct Plot {
  std::string title;  // says what it shows
  Axis x, y;
  std::vector<Series> series = {};
  std::vector<EventMark> marks = {};
  std::string note = {};
  bool equal_axes = false;  // one unit is as long on either axis: polar diagrams, loci
  bool bars = false;        // harmonics and the like
  bool wide = false;        // takes the whole width of the page
  std::vector<Band> bands = {};
  std::optional<ColourMap> map = {};
};

// The ground of a table's cell, where cells are verdicts.
enum class Tone { none, good, fair, aside, bad };

struct Table {
  std::string title;
  std::vector<std::string> columns;
  std::vector<std::vector<std::string>> rows;
  bool folded = false;                        // shown on demand; always in print
  std::size_t text_columns = 1;               // leading ones; the others are numbers, on the right
  std::vector<std::vector<Tone>> tones = {};  // per cell as the rows, or none at all
  std::vector<std::string> means = {};        // per row, the definition of what it tells; none, or one each
};

struct FormulaCard {
  std::string title, symbols;  // "δ = (ω_max − ω_min)/ω_m"
  std::string numbers;         // the same with numbers put in, and the result
  std::string note = {};
};

struct Text {
  std::string title, body;
  bool verbatim = false, folded = false;
};

// The moving machine: a shaft line, and its mechanism to scale.
struct MachineView {
  struct Part {
    std::string name, kind;              // kind "gap": parts that are left out
    double ratio_in = 1, ratio_out = 1;  // speed over the crank's
    bool elastic = false;
    bool slips = false;  // its two shafts turn apart
    bool crank = false;  // of a mechanism
    int row = 0;         // 0: the main line
  };
  // Where a line of parts begins, or ends and so closes a loop: at a shaft of a part of another line.
  struct Tie {
    int row = 0;
    bool at_end = false;  // of the line
    int part = 0;
    bool out = false;  // its shaft, of those that have two
  };
  // The mechanism by its joints over one turn of the crank, in equal steps; the last place is the first again.
  struct Linkage {
    struct Link {
      std::string shape;  // "crank", "link", "slot": a line; "slider" on a joint; "block" on a joint, along the next
      std::vector<int> joints;  // that it goes through
    };
    std::string name;
    std::string load;                       // what it works on: "press", "cylinder"; empty: else
    double ratio = 1;                       // angle that x and y are tabled over, over that of the link
    double direction = 0;                   // of +x above the horizontal [rad]
    std::vector<std::vector<double>> x, y;  // per joint [m]
    std::vector<Link> links;                // in the order of drawing
    std::vector<int> fixed;                 // joints that are bearings in the frame
    int output = 0;                         // joint that the load is shown at
    struct Gap {
      std::string joint;
      double size = 0;  // radial clearance [m]
    };
    std::vector<Gap> gaps;        // of pins in their bearings
    double bend_enlargement = 1;  // of its rod's deflection
  };
  // Per frame; twists and torques per part, empty where there are none.
  struct Motion {
    std::string label;
    Role role = Role::elastic;
    std::vector<double> angle;                             // of the crank, or of the reduction link [rad]
    std::vector<std::vector<double>> twist_in, twist_out;  // against the link, reduced to it, less the slips [rad]
    std::vector<std::vector<double>> slip_in, slip_out;    // by how much it has slipped against the link, reduced [rad]
    std::vector<std::vector<double>> torque;               // [N·m]
    // Per linkage on its output, positive towards its greatest x [N], or angle [N·m]; empty where there is none.
    std::vector<std::vector<double>> force;
    std::vector<std::vector<double>>
        bend;  // per linkage: its rod's deflection in the middle [m]; empty where none bends
    std::vector<std::vector<double>> shift;  // per gap of all linkages, of the pin in its gap, x and y by turns [m]
  };
  std::string title, link;
  std::vector<Part> parts;
  std::vector<Tie> ties;
  std::vector<Linkage> linkages;
  std::vector<double> time;     // of the frames [s]
  std::vector<Motion> motions;  // the last one in front, those before it as grey ghosts
  double enlargement = 1;       // of the twists
  double cycle = 0;             // [rad]; 0: one turn
};

// Two toothed wheels in mesh that turn: wheel 1 in the origin, wheel 2 on the x-axis; lengths in m, angles in rad.
struct GearView {
  struct Circle {
    std::string name;  // "tip", "working", "base", "root"
    double radius = 0;
  };
  struct Wheel {
    std::string name;
    int teeth = 0;  // > 0
    bool internal = false;
    std::vector<double> x, y;      // one pitch of the outline; `teeth` of them make the wheel
    double centre = 0, angle = 0;  // on the x-axis; when wheel 1 stands at 0
    double speed = 1;              // over that of wheel 1, with its sign
    std::vector<Circle> circles;
    double edge = 0;  // radius of the bore, or of an internal wheel's rim; 0: none
  };
  struct Point {
    std::string name;  // "A" … "E", "T₁", "T₂"
    double place = 0;  // along the line of action, from the pitch point
  };
  std::string title, note = {};
  std::vector<Wheel> wheels;
  double pitch_point = 0, direction = 0;  // on the x-axis; of the line of action, from the x-axis
  std::vector<Point> points;
  double start = 0, end = 0, base_pitch = 0;
  double first_contact = 0, base_radius = 0;  // contacts at first_contact + base_radius · angle + k base_pitch
  double close_up = 0;                        // half the height of the enlarged view
};

using Card = std::variant<Plot, Table, FormulaCard, Text, MachineView, GearView>;

struct ReportSection {
  std::string title;
  std::vector<Card> cards = {};
};

// What a figure means, for those who follow its name.
struct Meaning {
  std::string id, title, text;  // "delta", "delta.SHAFT — speed fluctuation δ", sentences
};

struct Report {
  std::string title, subtitle = {};
  std::vector<std::string> conclusion = {};  // sentence by sentence
  bool complete = true;
  std::vector<KeyFigure> figures = {};
  std::deque<ReportSection> sections = {};
  std::string footer = {};             // versions
  std::vector<Meaning> meanings = {};  // of the figures that it shows

  ReportSection& add(const std::string& section_title);  // stays where it is
};

// --- helpers for studies ---

// Versions, for the foot of a page.
std::string report_footer();

// The unit in which a quantity of this size is read easily: (0.05, "m") → mm, factor 1000; speeds in the scene's unit.
struct ReadableUnit {
  std::string unit;
  double factor = 1;  // value in this unit = factor · value in SI
};
ReadableUnit readable_unit(double largest, const std::string& si_unit, const SpeedUnit& speed = {});

}  // namespace kurbel
