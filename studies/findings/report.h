// report.h — a study's report for people: data and words here; studies/report turns it into a page or gnuplot files.
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

#include "engine/base/estimate.h"
#include "engine/scene/speed_unit.h"

namespace kurbel {

// Meaning of a colour, the same everywhere. The rest of the palette is that of Okabe and Ito.
enum class Role { rigid, elastic, reference, orange, green, vermillion, purple, sky };
Role further_role(std::size_t i);  // colours for a list of similar items

// A figure on the first screen.
struct KeyFigure : Estimate {
  std::string name, unit = {};  // SI, as in a scene: "N*m"
  std::string note = {};
  int digits = 0;          // significant ones; 0: by the error
  std::string means = {};  // its name in the dictionary: "delta.press"; empty: it has none
};

struct Axis {
  std::string label, unit = {};  // unit in readable form
  bool logarithmic = false;
  std::optional<double> least = {}, greatest = {};  // ends of the displayed range; default: of the data
  std::vector<std::string> names = {};              // for 1, 2, 3 …: an axis of categories instead of numbers
};

struct Series {
  std::string name;
  Role role = Role::elastic;
  std::vector<double> x = {}, y = {};
  bool dashed = false;                   // for references
  bool points = false;                   // markers beside the line
  bool line = true;                      // false: markers only
  std::vector<std::string> labels = {};  // tooltip of a point; none, or one each
  std::vector<double> sizes = {};        // of markers, over the default; none, or one each
  // Labels at its first and last point, in its colour; a series labelled with its name is not in the legend.
  std::string text_at_start = {}, text_at_end = {};

  void add(double at, double value) { x.push_back(at), y.push_back(value); }
};

// An event, marked on the x-axis.
struct EventMark {
  double x = 0;
  std::string text;
};

// A range of the x-axis: barred speeds, an operating range; of zero width: a line.
struct Band {
  double from = 0, to = 0;
  std::string text;
  Role role = Role::vermillion;
};

// Colours over a plane: z[i][k] at y[i] and x[k]; both ascend. Lines of the plot are drawn above it.
struct ColourMap {
  std::string name, unit;  // of the coloured quantity
  std::vector<double> x, y;
  std::vector<std::vector<double>> z;  // NaN: not known
};

struct Plot {
  std::string title;  // states what it shows
  Axis x, y;
  std::vector<Series> series = {};
  std::vector<EventMark> marks = {};
  std::string note = {};
  bool equal_axes = false;  // equal scales on both axes: polar diagrams, loci
  bool bars = false;        // harmonics and the like
  bool wide = false;        // uses the full page width
  std::vector<Band> bands = {};
  std::optional<ColourMap> map = {};
};

// Background of a table cell that contains a verdict.
enum class Tone { none, good, fair, aside, bad };

struct Table {
  std::string title;
  std::vector<std::string> columns;
  std::vector<std::vector<std::string>> rows;
  bool folded = false;                        // shown on demand; always in print
  std::size_t text_columns = 1;               // leading text columns; the others are numbers, on the right
  std::vector<std::vector<Tone>> tones = {};  // per cell, or none at all
  std::vector<std::string> means = {};        // per row, the definition of its figure; none, or one each
};

struct FormulaCard {
  std::string title, symbols;  // "δ = (ω_max − ω_min)/ω_m"
  std::string numbers;         // the same with numbers inserted, and the result
  std::string note = {};
};

struct Text {
  std::string title, body;
  bool verbatim = false, folded = false;
};

// The animated machine: a shaft line, and its mechanism to scale.
struct MachineView {
  struct Part {
    std::string name, kind;              // kind "gap": parts that are omitted
    double ratio_in = 1, ratio_out = 1;  // speed over the crank's
    bool elastic = false;
    bool slips = false;  // its two shafts may turn separately
    bool crank = false;  // of a mechanism
    int row = 0;         // 0: the main line
  };
  // Where a line of parts begins, or ends and thereby closes a loop: at a shaft of a part of another line.
  struct Tie {
    int row = 0;
    bool at_end = false;  // of the line
    int part = 0;
    bool out = false;  // the driven shaft, if it has two
  };
  // The mechanism by its joints over one turn of the crank, in equal steps; the last position equals the first.
  struct Linkage {
    struct Link {
      std::string shape;  // "crank", "link", "slot": a line; "slider" on a joint; "block" on a joint, towards the next
      std::vector<int> joints;  // joints that it passes through
    };
    std::string name;
    std::string load;                       // its load: "press", "cylinder"; empty: other
    double ratio = 1;                       // angle of the tables x and y over that of the link
    double direction = 0;                   // of +x above the horizontal [rad]
    std::vector<std::vector<double>> x, y;  // per joint [m]
    std::vector<Link> links;                // in the order of drawing
    std::vector<int> fixed;                 // joints that are bearings in the frame
    int output = 0;                         // joint where the load is drawn
    struct Gap {
      std::string joint;
      double size = 0;  // radial clearance [m]
    };
    std::vector<Gap> gaps;        // of pins in their bearings
    double bend_enlargement = 1;  // of the rod's deflection
  };
  // Per frame; twists and torques per part, empty if there are none.
  struct Motion {
    std::string label;
    Role role = Role::elastic;
    std::vector<double> angle;                             // of the crank, or of the reduction link [rad]
    std::vector<std::vector<double>> twist_in, twist_out;  // relative to the link, reduced to it, minus the slips [rad]
    std::vector<std::vector<double>> slip_in, slip_out;    // slip relative to the link, reduced [rad]
    std::vector<std::vector<double>> torque;               // [N·m]
    // Load per linkage on its output, positive towards its greatest x [N], or angle [N·m]; empty if none.
    std::vector<std::vector<double>> force;
    std::vector<std::vector<double>>
        bend;  // per linkage: its rod's deflection in the middle [m]; empty where none bends
    std::vector<std::vector<double>> shift;  // per gap of all linkages, of the pin in its gap, x and y alternating [m]
  };
  std::string title, link;
  std::vector<Part> parts;
  std::vector<Tie> ties;
  std::vector<Linkage> linkages;
  std::vector<double> time;     // of the frames [s]
  std::vector<Motion> motions;  // the last one in front, those before it grey
  double enlargement = 1;       // of the twists
  double cycle = 0;             // [rad]; 0: one turn
};

// Two meshing gears in motion: wheel 1 at the origin, wheel 2 on the x-axis; lengths in m, angles in rad.
struct GearView {
  struct Circle {
    std::string name;  // "tip", "working", "base", "root"
    double radius = 0;
  };
  struct Wheel {
    std::string name;
    int teeth = 0;  // > 0
    bool internal = false;
    std::vector<double> x, y;      // one pitch of the outline; the wheel has `teeth` of them
    double centre = 0, angle = 0;  // on the x-axis; for wheel 1 at 0
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

// The meaning of a figure, linked from its name.
struct Meaning {
  std::string id, title, text;  // "delta", "delta.SHAFT — speed fluctuation δ", sentences
};

struct Report {
  std::string title, subtitle = {};
  std::vector<std::string> conclusion = {};  // one entry per sentence
  bool complete = true;
  std::vector<KeyFigure> figures = {};
  std::deque<ReportSection> sections = {};
  std::string footer = {};             // versions
  std::vector<Meaning> meanings = {};  // of the figures that it shows

  ReportSection& add(const std::string& section_title);  // the reference stays valid
};

// --- helpers for studies ---

// Versions, for the page footer.
std::string report_footer();

// A readable unit for a quantity of this size: (0.05, "m") → mm, factor 1000; speeds in the scene's unit.
struct ReadableUnit {
  std::string unit;
  double factor = 1;  // value in this unit = factor · value in SI
};
ReadableUnit readable_unit(double largest, const std::string& si_unit, const SpeedUnit& speed = {});

}  // namespace kurbel
