// html.cpp — the page: template, styles and scripts with the report's data as JSON.
#include "studies/report/render.h"

#include <fmt/format.h>

#include <algorithm>
#include <numbers>
#include <numeric>
#include <stdexcept>

#include "engine/scene/units.h"
#include "studies/files/whole_file.h"
#include "studies/findings/figure_text.h"
#include "studies/findings/thin.h"
#include "studies/report/assets.h"
#include "studies/report/theory.h"
#include "studies/report/writer.h"

namespace kurbel {
namespace {

// In the order of the roles.
const char* name_of(Role role) {
  constexpr const char* names[] = {"rigid", "elastic", "reference", "orange", "green", "vermillion", "purple", "sky"};
  return names[static_cast<std::size_t>(role)];
}

void write(Writer& w, const Axis& axis) {
  w.object([&] {
    w.field("label", axis.label);
    w.field("unit", axis.unit);
    w.field("log", axis.logarithmic);
    if (axis.least) w.field("least", *axis.least, 8);
    if (axis.greatest) w.field("greatest", *axis.greatest, 8);
    if (!axis.names.empty()) w.field("names", axis.names);
  });
}

void write(Writer& w, const ColourMap& map) {
  w.object([&] {
    w.field("name", map.name);
    w.field("unit", map.unit);
    w.field("x", map.x, 6);
    w.field("y", map.y, 6);
    w.field("z", map.z, 4);
  });
}

void write(Writer& w, const Plot& plot) {
  w.field("kind", "plot");
  w.field("title", plot.title);
  w.field("note", plot.note);
  w.field("equalAxes", plot.equal_axes);
  w.field("bars", plot.bars);
  w.key("x"), write(w, plot.x);
  w.key("y"), write(w, plot.y);
  w.objects("series", order_of_drawing(plot), [&](std::size_t i) {
    const Series& series = plot.series[i];
    const Series points = drawn(series);
    w.field("name", series.name);
    w.field("role", name_of(series.role));
    w.field("dashed", series.dashed);
    w.field("points", series.points || !series.line);
    w.field("line", series.line);
    if (stands_behind(plot, series)) w.field("behind", true);
    w.field("x", points.x, 8);
    w.field("y", points.y, 7);
    if (!points.labels.empty()) w.field("labels", points.labels);
    if (!points.sizes.empty()) w.field("sizes", points.sizes, 3);
    if (!series.text_at_start.empty()) w.field("textAtStart", series.text_at_start);
    if (!series.text_at_end.empty()) w.field("textAtEnd", series.text_at_end);
  });
  if (plot.wide) w.field("wide", true);
  if (plot.map) w.key("map"), write(w, *plot.map);
  w.objects("bands", plot.bands, [&](const Band& band) {
    w.field("from", band.from, 8);
    w.field("to", band.to, 8);
    w.field("text", band.text);
    w.field("role", name_of(band.role));
  });
  w.objects("marks", marks_drawn(plot), [&](const EventMark& mark) {
    w.field("x", mark.x, 8);
    w.field("text", mark.text);
  });
}

std::vector<std::string> classes_of(const std::vector<Tone>& tones) {
  constexpr const char* classes[] = {"", "good", "fair", "aside", "bad"};
  std::vector<std::string> names;
  for (const Tone tone : tones) names.emplace_back(classes[static_cast<std::size_t>(tone)]);
  return names;
}

void write(Writer& w, const Table& table) {
  w.field("kind", "table");
  w.field("title", table.title);
  w.field("folded", table.folded);
  w.field("textColumns", static_cast<double>(table.text_columns));
  w.field("columns", table.columns);
  w.field("rows", table.rows);
  if (!table.tones.empty()) {
    w.key("tones");
    w.list(table.tones, [&](const std::vector<Tone>& row) { w.value(classes_of(row)); });
  }
  if (!table.means.empty()) w.field("means", table.means);
}

void write(Writer& w, const FormulaCard& formula) {
  w.field("kind", "formula");
  w.field("title", formula.title);
  w.field("symbols", formula.symbols);
  w.field("numbers", formula.numbers);
  w.field("note", formula.note);
}

void write(Writer& w, const Text& t) {
  w.field("kind", "text");
  w.field("title", t.title);
  w.field("body", t.body);
  w.field("verbatim", t.verbatim);
  w.field("folded", t.folded);
}

void write(Writer& w, const MachineView::Linkage& linkage) {
  w.field("name", linkage.name);
  w.field("load", linkage.load);
  w.field("ratio", linkage.ratio);
  w.field("direction", linkage.direction);
  w.field("x", linkage.x, 5);
  w.field("y", linkage.y, 5);
  w.objects("links", linkage.links, [&](const MachineView::Linkage::Link& link) {
    w.field("shape", link.shape);
    w.field("joints", link.joints);
  });
  w.field("fixed", linkage.fixed);
  w.field("output", static_cast<double>(linkage.output));
  w.objects("gaps", linkage.gaps, [&](const MachineView::Linkage::Gap& gap) {
    w.field("joint", gap.joint);
    w.field("size", gap.size);
  });
  w.field("bendEnlargement", linkage.bend_enlargement);
}

void write(Writer& w, const MachineView& machine) {
  w.field("kind", "machine");
  w.field("title", machine.title);
  w.field("link", machine.link);
  w.field("enlargement", machine.enlargement);
  w.field("cycle", machine.cycle > 0 ? machine.cycle : 2 * std::numbers::pi, 12);
  w.objects("parts", machine.parts, [&](const MachineView::Part& part) {
    w.field("name", part.name);
    w.field("kind", part.kind);
    w.field("ratioIn", part.ratio_in);
    w.field("ratioOut", part.ratio_out);
    w.field("elastic", part.elastic);
    if (part.slips) w.field("slips", true);
    w.field("crank", part.crank);
    w.field("row", static_cast<double>(part.row));
  });
  w.objects("ties", machine.ties, [&](const MachineView::Tie& tie) {
    w.field("row", static_cast<double>(tie.row));
    w.field("atEnd", tie.at_end);
    w.field("part", static_cast<double>(tie.part));
    w.field("out", tie.out);
  });
  w.objects("linkages", machine.linkages, [&](const MachineView::Linkage& linkage) { write(w, linkage); });
  w.field("time", machine.time, 7);
  w.objects("motions", machine.motions, [&](const MachineView::Motion& motion) {
    w.field("label", motion.label);
    w.field("role", name_of(motion.role));
    w.field("angle", motion.angle, 7);
    w.field("twistIn", motion.twist_in, 4);
    w.field("twistOut", motion.twist_out, 4);
    if (!motion.slip_in.empty()) {
      w.field("slipIn", motion.slip_in, 5);
      w.field("slipOut", motion.slip_out, 5);
    }
    w.field("torque", motion.torque, 4);
    w.field("force", motion.force, 4);
    w.field("bend", motion.bend, 4);
    w.field("shift", motion.shift, 4);
  });
}

void write(Writer& w, const GearView::Wheel& wheel) {
  w.field("name", wheel.name);
  w.field("teeth", static_cast<double>(wheel.teeth));
  w.field("internal", wheel.internal);
  w.field("x", wheel.x, 7);
  w.field("y", wheel.y, 6);
  w.field("centre", wheel.centre, 9);
  w.field("angle", wheel.angle, 12);
  w.field("speed", wheel.speed, 12);
  w.field("edge", wheel.edge);
  w.objects("circles", wheel.circles, [&](const GearView::Circle& circle) {
    w.field("name", circle.name);
    w.field("radius", circle.radius, 9);
  });
}

void write(Writer& w, const GearView& view) {
  w.field("kind", "gears");
  w.field("title", view.title);
  w.field("note", view.note);
  w.objects("wheels", view.wheels, [&](const GearView::Wheel& wheel) { write(w, wheel); });
  w.objects("points", view.points, [&](const GearView::Point& point) {
    w.field("name", point.name);
    w.field("place", point.place, 9);
  });
  w.field("pitchPoint", view.pitch_point, 9);
  w.field("direction", view.direction, 9);
  w.field("start", view.start, 9);
  w.field("end", view.end, 9);
  w.field("basePitch", view.base_pitch, 9);
  w.field("firstContact", view.first_contact, 9);
  w.field("baseRadius", view.base_radius, 9);
  w.field("closeUp", view.close_up);
}

std::string json_of(const Report& report, const Letterhead& head) {
  Writer w;
  w.object([&] {
    w.field("title", report.title);
    if (!head.brand_svg.empty()) w.field("brand", head.brand_svg);
    if (!head.author.empty()) w.field("author", head.author);
    w.field("subtitle", report.subtitle);
    w.field("conclusion", report.conclusion);
    w.field("complete", report.complete);
    w.field("footer", report.footer);
    w.objects("figures", report.figures, [&](const KeyFigure& figure) {
      w.field("name", figure.name);
      const TileText text = tile_text({figure.value, figure.error}, figure.digits);
      w.field("value", text.value);
      if (!text.known.empty()) w.field("known", text.known);
      w.field("unit", pretty_unit(figure.unit));
      w.field("error", text.error);
      w.field("note", figure.note);
      if (!figure.means.empty()) w.field("means", figure.means);
    });
    w.objects("sections", report.sections, [&](const ReportSection& section) {
      w.field("title", section.title);
      w.key("cards");
      w.list(section.cards,
             [&](const Card& card) { w.object([&] { std::visit([&](const auto& c) { write(w, c); }, card); }); });
    });
    if (!report.meanings.empty()) {
      w.objects("meanings", report.meanings, [&](const Meaning& meaning) {
        w.field("id", meaning.id);
        w.field("title", meaning.title);
        w.field("text", meaning.text);
      });
    }
    const std::vector<std::string> notes = theory_notes(w.text);  // of all that was said above
    if (!notes.empty()) w.field("theory", notes);
  });
  return w.text;
}

std::string escaped(std::string_view text) {
  std::string out;
  for (const char c : text) switch (c) {
      case '&':
        out += "&amp;";
        break;
      case '<':
        out += "&lt;";
        break;
      case '>':
        out += "&gt;";
        break;
      case '"':
        out += "&quot;";
        break;
      default:
        out += c;
    }
  return out;
}

}  // namespace

bool stands_behind(const Plot& plot, const Series& series) {
  const auto is_rigid = [](const Series& s) {
    return s.role == Role::rigid && s.line && !s.dashed && s.text_at_start.empty() && s.text_at_end.empty();
  };
  return !plot.bars && is_rigid(series) && std::any_of(plot.series.begin(), plot.series.end(), [&](const Series& s) {
    return s.line && s.role != Role::reference && !is_rigid(s);
  });
}

std::vector<std::size_t> order_of_drawing(const Plot& plot) {
  std::vector<std::size_t> order(plot.series.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_partition(order.begin(), order.end(), [&](std::size_t i) { return stands_behind(plot, plot.series[i]); });
  return order;
}

std::vector<EventMark> marks_drawn(const Plot& plot) {
  std::vector<EventMark> marks;
  const std::size_t stride = 1 + plot.marks.size() / 400;
  for (std::size_t i = 0; i < plot.marks.size(); i += stride) marks.push_back(plot.marks[i]);
  return marks;
}

Series drawn(const Series& series) {
  Series s = series;
  if (s.labels.size() != s.x.size()) s.labels.clear();
  if (s.sizes.size() != s.x.size()) s.sizes.clear();
  if (s.x.size() <= points_per_series) return s;
  if (s.line) {
    s.labels.clear(), s.sizes.clear();
    thin_by_extremes(s.x, s.y, points_per_series);
    return s;
  }
  const std::vector<std::size_t> kept = drawn_by_chance(s.x.size(), points_per_series);
  const auto keep = [&kept](auto& list) {
    if (list.empty()) return;
    for (std::size_t i = 0; i < kept.size(); ++i) std::swap(list[i], list[kept[i]]);
    list.resize(kept.size());
  };
  keep(s.x), keep(s.y), keep(s.labels), keep(s.sizes);
  return s;
}

std::string json_string(const std::string& text) {
  std::string out = "\"";
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (c == '"' || c == '\\') {
      out += '\\';
      out += c;
    } else if (c == '<') {
      out += "\\u003c";  // neither "</script" nor "<!--" can arise
    } else if (c == '\n') {
      out += "\\n";
    } else if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) {
      out += fmt::format("\\u{:04x}", static_cast<int>(c));
    } else {
      out += c;
    }
  }
  return out + '"';
}

std::string html_of(const Report& report, const Letterhead& head) {
  const std::string json = json_of(report, head);
  const std::string_view page = report_assets::page_html();
  std::string html;
  html.reserve(page.size() + json.size() + report_assets::plotly_js().size() + 65536);
  // Placeholders {{name}} of the template, once through; what is put in is not looked at again.
  std::size_t at = 0;
  for (std::size_t open = page.find("{{"); open != std::string_view::npos; open = page.find("{{", at)) {
    const std::size_t close = page.find("}}", open);
    const std::string_view name = page.substr(open + 2, close - open - 2);
    html += page.substr(at, open - at);
    if (name == "title")
      html += escaped(report.title);
    else if (name == "conclusion")
      html += escaped(report.conclusion);
    else if (name == "css")
      html += report_assets::page_css();
    else if (name == "js")
      html += report_assets::page_js();
    else if (name == "plotly")
      html += report_assets::plotly_js();
    else if (name == "licence")
      html += escaped(report_assets::plotly_licence());
    else if (name == "data")
      html += json;
    else
      throw std::logic_error(fmt::format("the report's template has no \"{}\"", name));
    at = close + 2;
  }
  html += page.substr(at);
  return html;
}

void write_html(const Report& report, const std::string& path) { write_whole(path, html_of(report)); }

}  // namespace kurbel
