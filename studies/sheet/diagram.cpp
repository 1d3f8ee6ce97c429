// diagram.cpp — axes, curves and marks of one diagram.
#include "studies/sheet/diagram.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "engine/numerics/angles.h"

namespace kurbel {
namespace {

constexpr double title_height = diagram_head, numbers_height = diagram_foot;

struct ValueRange {
  double least = 0, greatest = 0;  // with 0
};
ValueRange range_of(const SheetDiagram& d) {
  ValueRange r;
  for (const SheetCurve& c : d.curves)
    for (const double v : c.value) r.least = std::min(r.least, v), r.greatest = std::max(r.greatest, v);
  return r;
}

void draw_curve(Canvas& c, const SheetCurve& curve, const AngleAxis& axis, const Placed& placed,
                const std::vector<SheetPosition>& positions) {
  std::vector<Spot> spots;
  for (std::size_t i = 0; i < curve.way.size(); ++i) spots.push_back({axis.x(curve.way[i]), placed.y(curve.value[i])});
  c.curve(spots, curve.pen);
  for (std::size_t k = 0; k < curve.at_positions.size(); ++k)
    if (std::isfinite(curve.at_positions[k]))
      c.mark({axis.x(positions[k].way), placed.y(curve.at_positions[k])}, curve.pen,
             fmt::format("data-of=\"{}\" data-position=\"{}\" data-value=\"{:.12g}\"", xml_text(curve.symbol),
                         positions[k].label, curve.at_positions[k]));
}

// At the right end, one below the other where they would meet.
void name_curves(Canvas& c, const Box& box, const SheetDiagram& d, const AngleAxis& axis, const Placed& placed) {
  std::vector<std::pair<double, const SheetCurve*>> ends;
  for (const SheetCurve& curve : d.curves)
    if (!curve.value.empty()) ends.emplace_back(placed.y(curve.value.back()), &curve);
  std::sort(ends.begin(), ends.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  double last = box.y;
  for (const auto& [y, curve] : ends) {
    const bool on_axis = std::abs(y - placed.zero) < 2.5;
    last = std::max(on_axis ? placed.zero - 1.5 : y + 1, last + 3.6);
    c.symbols({axis.right() + 2, last}, curve->symbol, {.size = 3, .pen = curve->pen, .ground = true});
  }
}

}  // namespace

double AngleAxis::x(double way) const { return left + way * in_degrees / degrees_per_mm; }
std::string AngleAxis::words() const {
  return fmt::format("μ_φ = {:.4g} rad/mm ({:g}°/mm)", degrees_per_mm / in_degrees, degrees_per_mm);
}

AngleAxis angle_axis(double cycle, double left, double width) { return {left, cycle, round_degrees(cycle, width)}; }

void draw_ordinates(Canvas& c, const Box& box, const AngleAxis& axis, const std::vector<SheetPosition>& positions) {
  const double bottom = box.bottom() - numbers_height;
  double last = -1e9;
  const auto ordinate = [&](double x, const std::string& label, bool numbered) {
    c.line({x, box.y + title_height}, {x, bottom}, numbered ? Pen::grid : Pen::letter);
    if (!numbered && x - last < 2.2) x = last + 2.2;
    if (!numbered) last = x;
    c.words({x, bottom + (numbered ? 3 : 5.6)}, label,
            {.size = 2.6, .at = "middle", .bold = !numbered, .pen = numbered ? Pen::body : Pen::load});
  };
  for (const SheetPosition& p : positions) ordinate(axis.x(p.way), p.label, p.numbered);
  ordinate(axis.right(), "0", true);
}

Placed draw_diagram(Canvas& c, const Box& box, const AngleAxis& axis, const SheetDiagram& d,
                    const std::vector<SheetPosition>& positions) {
  const ValueRange range = range_of(d);
  const double room = box.height - title_height - numbers_height - 4;
  Placed placed;
  placed.scale = scale_for(d.scale, d.unit, range.greatest - range.least, room);
  placed.zero = box.bottom() - numbers_height - 1 + placed.scale.mm(range.least);
  c.begin_group(fmt::format("data-diagram=\"{}\" data-per-mm=\"{:.12g}\" data-zero=\"{:.6f}\"", xml_text(d.title),
                            placed.scale.per_mm, placed.zero));
  c.symbols({axis.left, box.y + 3}, fmt::format("{}, {}", d.title, placed.scale.words()), {.size = 3, .bold = true});
  draw_ordinates(c, box, axis, positions);
  c.arrow({axis.left, box.bottom() - numbers_height}, {axis.left, box.y + title_height - 2}, Pen::body);
  c.arrow({axis.left, placed.zero}, {axis.right() + 8, placed.zero}, Pen::body);
  c.symbols({axis.right() + 8.6, placed.zero + 1}, "φ", {.size = 3});
  for (const SheetCurve& curve : d.curves) draw_curve(c, curve, axis, placed, positions);
  name_curves(c, box, d, axis, placed);
  c.end_group();
  return placed;
}

void add_diagrams(Sheets& sheets, const std::string& title, double cycle, const std::vector<SheetPosition>& positions,
                  const std::vector<SheetDiagram>& diagrams, const std::string& note, std::size_t rows) {
  const Box room = sheets.room();
  const AngleAxis axis = angle_axis(cycle, room.x + 6, room.width - 24);
  Canvas& c = sheets.add(title, axis.words());
  const double height = room.height / static_cast<double>(rows ? rows : diagrams.size());
  for (std::size_t i = 0; i < diagrams.size(); ++i)
    draw_diagram(c, {room.x, room.y + height * static_cast<double>(i), room.width, height - 2}, axis, diagrams[i],
                 positions);
  add_lines(c, sheets.foot(), fmt::format("{}; {}.", axis.words(), note));
}

}  // namespace kurbel
