// vector_plan.cpp — plans in their cells; names where they hide nothing.
#include "studies/sheet/vector_plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "studies/sheet/scales.h"

namespace kurbel {
namespace {

constexpr double free_edge = 7, head = 5, letters = 2.6;
constexpr double least_cell = 80;       // [mm]
constexpr double shortest_named = 1.2;  // of arrows [mm]

// Where a plan reaches to, turned as it is drawn, in its unit; with its pole, or its first force's begin.
struct Extent {
  double left = 0, right = 0, low = 0, high = 0;
  double width() const { return right - left; }
  double height() const { return high - low; }
};

PlanePoint turned(PlanePoint p, double by) {
  return {p.x * std::cos(by) - p.y * std::sin(by), p.x * std::sin(by) + p.y * std::cos(by)};
}

Extent extent_of(const VectorPlan& plan, double direction) {
  Extent e;
  const auto take = [&](PlanePoint p) {
    const PlanePoint q = turned(p, direction);
    e.left = std::min(e.left, q.x), e.right = std::max(e.right, q.x);
    e.low = std::min(e.low, q.y), e.high = std::max(e.high, q.y);
  };
  for (const VectorPlan::Arrow& a : plan.arrows) take(a.from), take(a.to);
  for (const VectorPlan::Point& p : plan.points) take(p.at);
  return e;
}

// Unit a millimetre at which it fills the cell; 0: it is a point.
double finest(const Extent& e, const Box& cell) {
  return std::max(e.width() / (cell.width - 2 * free_edge), e.height() / (cell.height - 2 * free_edge - head));
}

// Names of one cell: beside what they name, off each other and off the lines as far as there is space.
class Names {
 public:
  Names(Canvas& canvas, const Box& cell) : c_(canvas), cell_(cell) {}
  void keep_off(Spot a, Spot b) { lines_.push_back({a, b}); }
  void put(Spot at, Spot away, const std::string& name, Pen pen, bool bold) {
    const double width = width_of(name, letters) - (name.find('_') == std::string::npos ? 0 : 0.8 * letters) + 0.4,
                 first = std::atan2(away.y, away.x);
    Box best;
    double least = HUGE_VAL;
    for (const double far : {0.6, 1.6, 2.8, 4.2, 6.0, 8.0, 11.0})
      for (int k = 0; k < 16; ++k) {
        const double angle = first + (k % 2 ? 1 : -1) * ((k + 1) / 2) * std::numbers::pi / 8;
        const double x = std::cos(angle), y = std::sin(angle);
        const Box box = {at.x + (far + width / 2) * x - width / 2, at.y + (far + letters / 2) * y - letters / 2, width,
                         letters};
        const double price = far + 0.15 * k + price_of(box);
        if (price < least) least = price, best = box;
      }
    taken_.push_back(best);
    const Spot near = {std::clamp(at.x, best.x, best.right()), std::clamp(at.y, best.y, best.bottom())};
    if (std::hypot(near.x - at.x, near.y - at.y) > 3) c_.line(near, at, Pen::thin);
    c_.symbols({best.x + width / 2, best.y + 0.82 * letters}, name,
               {.size = letters, .at = "middle", .bold = bold, .pen = pen});
  }

 private:
  struct Line {
    Spot a, b;
  };
  static bool crosses(const Line& l, const Box& box) {
    double from = 0, to = 1;
    const auto clip = [&](double at, double way, double low, double high) {
      if (way == 0) return at >= low && at <= high;
      from = std::max(from, std::min((low - at) / way, (high - at) / way));
      to = std::min(to, std::max((low - at) / way, (high - at) / way));
      return from <= to;
    };
    return clip(l.a.x, l.b.x - l.a.x, box.x, box.right()) && clip(l.a.y, l.b.y - l.a.y, box.y, box.bottom());
  }
  double price_of(const Box& box) const {
    double price = 0;
    if (box.x < cell_.x + 0.5 || box.right() > cell_.right() - 0.5 || box.y < cell_.y + head ||
        box.bottom() > cell_.bottom() - 0.5)
      price += 1000;
    for (const Box& t : taken_)
      if (box.x < t.right() && t.x < box.right() && box.y < t.bottom() && t.y < box.bottom()) price += 100;
    for (const Line& l : lines_) price += crosses(l, box) ? 6 : 0;
    return price;
  }

  Canvas& c_;
  Box cell_;
  std::vector<Box> taken_;
  std::vector<Line> lines_;
};

class PlanDrawer {
 public:
  PlanDrawer(Canvas& canvas, const Box& cell, const PlansOnSheet& form, const VectorPlan& plan, const Scale& scale)
      : c_(canvas), form_(form), plan_(plan), scale_(scale), names_(canvas, cell) {
    const Extent e = extent_of(plan, form.direction);
    zero_ = {cell.x + cell.width / 2 - scale.mm(e.left + e.right) / 2,
             cell.y + head + (cell.height - head) / 2 + scale.mm(e.low + e.high) / 2};
    c_.words({cell.x + 1.5, cell.y + 4}, plan.title, {.size = 3, .bold = true});
    if (form.each_to_its_own)
      c_.symbols({cell.right() - 1.5, cell.y + 4}, scale.words(), {.size = letters, .at = "end"});
  }

  void draw() {
    c_.begin_group(fmt::format("data-plan=\"{}\" data-position=\"{}\" data-per-mm=\"{:.12g}\"", form_.scale,
                               xml_text(plan_.title), scale_.per_mm));
    for (const VectorPlan::Arrow& a : plan_.arrows) {
      const Spot from = spot(a.from), to = spot(a.to);
      const double length = std::hypot(to.x - from.x, to.y - from.y);
      c_.begin_group(fmt::format("data-vector=\"{}\" data-value=\"{:.15g}\"", xml_text(a.name),
                                 std::hypot(a.to.x - a.from.x, a.to.y - a.from.y)));
      if (length > 2.6)
        c_.arrow(from, to, a.pen);
      else
        c_.line(from, to, a.pen);
      c_.end_group();
      names_.keep_off(from, to);
    }
    name_points();
    for (const VectorPlan::Arrow& a : plan_.arrows) {
      const Spot from = spot(a.from), to = spot(a.to), way = {to.x - from.x, to.y - from.y};
      if (!a.name.empty() && std::hypot(way.x, way.y) >= shortest_named)
        names_.put({(from.x + to.x) / 2, (from.y + to.y) / 2}, {way.y, -way.x}, a.name, a.pen, false);
    }
    c_.end_group();
  }

 private:
  Spot spot(PlanePoint p) const {
    const PlanePoint q = turned(p, form_.direction);
    return {zero_.x + scale_.mm(q.x), zero_.y - scale_.mm(q.y)};
  }

  // Those that stand on each other share a name.
  void name_points() {
    std::vector<bool> named(plan_.points.size(), false);
    for (std::size_t k = 0; k < plan_.points.size(); ++k) {
      if (named[k]) continue;
      const Spot at = spot(plan_.points[k].at);
      std::string name;
      for (std::size_t j = k; j < plan_.points.size(); ++j) {
        const Spot other = spot(plan_.points[j].at);
        if (named[j] || std::hypot(other.x - at.x, other.y - at.y) > 0.5) continue;
        named[j] = true;
        name += (name.empty() ? "" : ", ") + plan_.points[j].name;
      }
      c_.circle(at, k == 0 ? 0.8 : 0.4, Pen::body, k != 0);
      const Spot pole = spot(plan_.points.front().at);
      const bool is_pole = std::hypot(at.x - pole.x, at.y - pole.y) < 0.5;
      names_.put(at, is_pole ? Spot{-1, 0.4} : Spot{at.x - pole.x, at.y - pole.y}, name, Pen::body, true);
    }
  }

  Canvas& c_;
  const PlansOnSheet& form_;
  const VectorPlan& plan_;
  const Scale& scale_;
  Names names_;
  Spot zero_;
};

// Of all plans in one scale.
double finest_of(const std::vector<VectorPlan>& plans, const PlansOnSheet& form, const Box& cell) {
  double common = 0;
  for (const VectorPlan& p : plans) common = std::max(common, finest(extent_of(p, form.direction), cell));
  return common;
}

// As few sheets as cells of the least size allow, as many plans on each as near as may be, in the cells that take them
// largest.
std::pair<int, int> grid_of(const Box& room, const PlansOnSheet& form, const std::vector<VectorPlan>& plans) {
  const auto parts = [](int all, int size) { return std::max(1, (all + size - 1) / size); };
  const int most_columns = form.columns > 0 ? form.columns : static_cast<int>(room.width / least_cell),
            most_rows = form.rows > 0 ? form.rows : static_cast<int>(room.height / least_cell),
            count = static_cast<int>(plans.size()), on_each = parts(count, parts(count, most_columns * most_rows));
  std::pair<int, int> best = {most_columns, std::min(most_rows, parts(on_each, most_columns))};
  double least = HUGE_VAL;
  for (int columns = form.columns > 0 ? most_columns : 1; columns <= most_columns; ++columns) {
    const int rows = form.together * parts(parts(on_each, columns), form.together);
    const double scale = finest_of(plans, form, {0, 0, room.width / columns, room.height / rows});
    if (rows <= most_rows && scale < least) least = scale, best = {columns, rows};
  }
  return best;
}

}  // namespace

void add_plans(Sheets& sheets, const PlansOnSheet& form, const std::vector<VectorPlan>& plans) {
  const Box room = sheets.room();
  const auto [columns, rows] = grid_of(room, form, plans);
  const Box cell = {0, 0, room.width / columns, room.height / rows};
  const Scale shared = scale_for(form.scale, form.unit, finest_of(plans, form, cell), 1);
  const auto on_a_sheet = static_cast<std::size_t>(columns * rows);
  for (std::size_t from = 0; from < plans.size(); from += on_a_sheet) {
    Canvas& c = sheets.add(form.what, form.each_to_its_own ? "" : shared.words());
    for (std::size_t k = from; k < std::min(plans.size(), from + on_a_sheet); ++k) {
      if (plans[k].title.empty()) continue;
      const auto place = static_cast<int>(k - from);
      const Box at = {room.x + cell.width * (place % columns), room.y + cell.height * (place / columns), cell.width,
                      cell.height};
      c.box(at, Pen::grid);
      const Scale scale = form.each_to_its_own
                              ? scale_for(form.scale, form.unit, finest(extent_of(plans[k], form.direction), cell), 1)
                              : shared;
      PlanDrawer(c, at, form, plans[k], scale).draw();
    }
    add_lines(c, sheets.foot(), form.note);
  }
}

}  // namespace kurbel
