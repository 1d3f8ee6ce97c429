// html.cpp — the page: template, styles and scripts with the report's data as JSON.
#include "studies/data/xml.h"
#include "studies/report/render.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <numbers>
#include <numeric>
#include <stdexcept>
#include <type_traits>
#include <utility>

#include "engine/scene/units.h"
#include "studies/data/value.h"
#include "studies/files/built_in.h"
#include "studies/files/whole_file.h"
#include "studies/findings/figure_text.h"
#include "studies/findings/thin.h"
#include "studies/report/theory.h"

KURBEL_BUILT_IN(page_html, KURBEL_REPORT_FOLDER "/page.html")
KURBEL_BUILT_IN(page_css, KURBEL_REPORT_FOLDER "/page.css")
KURBEL_BUILT_IN(page_js, KURBEL_REPORT_FOLDER "/page.js")
KURBEL_BUILT_IN(plotly_js, KURBEL_REPORT_FOLDER "/vendor/plotly-basic.min.js")
KURBEL_BUILT_IN(plotly_licence, KURBEL_REPORT_FOLDER "/vendor/plotly-LICENSE")

namespace kurbel {
namespace {

// In the order of the roles.
const char* name_of(Role role) {
  constexpr const char* names[] = {"rigid", "elastic", "reference", "orange", "green", "vermillion", "purple", "sky"};
  return names[static_cast<std::size_t>(role)];
}

Record record_of(const Axis& axis) {
  Record r = {{"label", axis.label}, {"unit", axis.unit}, {"log", axis.logarithmic}};
  if (axis.least) r.push_back({"least", Rounded{*axis.least, 8}});
  if (axis.greatest) r.push_back({"greatest", Rounded{*axis.greatest, 8}});
  if (!axis.names.empty()) r.push_back({"names", axis.names});
  return r;
}

List rounded(const std::vector<std::vector<double>>& lists, int digits) {
  return each(lists, [digits](const std::vector<double>& list) { return RoundedList{list, digits}; });
}

// An initializer list copies its values: what is long is added by this.
void add(Record& record, const char* key, Value value) { record.push_back({key, std::move(value)}); }

Record record_of(const ColourMap& map) {
  return {{"name", map.name},
          {"unit", map.unit},
          {"x", RoundedList{map.x, 6}},
          {"y", RoundedList{map.y, 6}},
          {"z", rounded(map.z, 4)}};
}

Record series_record(const Plot& plot, const Series& series) {
  Series points = drawn(series);
  Record r = {{"name", series.name},
              {"role", name_of(series.role)},
              {"dashed", series.dashed},
              {"points", series.points || !series.line},
              {"line", series.line}};
  if (stands_behind(plot, series)) r.push_back({"behind", true});
  r.push_back({"x", RoundedList{std::move(points.x), 8}});
  r.push_back({"y", RoundedList{std::move(points.y), 7}});
  if (!points.labels.empty()) r.push_back({"labels", points.labels});
  if (!points.sizes.empty()) r.push_back({"sizes", RoundedList{std::move(points.sizes), 3}});
  if (!series.text_at_start.empty()) r.push_back({"textAtStart", series.text_at_start});
  if (!series.text_at_end.empty()) r.push_back({"textAtEnd", series.text_at_end});
  return r;
}

Record record_of(const Plot& plot) {
  Record r = {{"kind", "plot"},    {"title", plot.title},    {"note", plot.note},     {"equalAxes", plot.equal_axes},
              {"bars", plot.bars}, {"x", record_of(plot.x)}, {"y", record_of(plot.y)}};
  add(r, "series", each(order_of_drawing(plot), [&](std::size_t i) { return series_record(plot, plot.series[i]); }));
  if (plot.wide) r.push_back({"wide", true});
  if (plot.map) r.push_back({"map", record_of(*plot.map)});
  r.push_back({"bands", each(plot.bands, [](const Band& band) {
                 return Record{{"from", Rounded{band.from, 8}},
                               {"to", Rounded{band.to, 8}},
                               {"text", band.text},
                               {"role", name_of(band.role)}};
               })});
  r.push_back({"marks", each(marks_drawn(plot), [](const EventMark& mark) {
                 return Record{{"x", Rounded{mark.x, 8}}, {"text", mark.text}};
               })});
  return r;
}

const char* class_of(Tone tone) {
  constexpr const char* classes[] = {"", "good", "fair", "aside", "bad"};
  return classes[static_cast<std::size_t>(tone)];
}

Record record_of(const Table& table) {
  Record r = {{"kind", "table"},
              {"title", table.title},
              {"folded", table.folded},
              {"textColumns", table.text_columns},
              {"columns", table.columns}};
  add(r, "rows", table.rows);
  if (!table.tones.empty())
    r.push_back({"tones", each(table.tones, [](const std::vector<Tone>& row) { return each(row, class_of); })});
  if (!table.means.empty()) r.push_back({"means", table.means});
  return r;
}

Record record_of(const FormulaCard& formula) {
  return {{"kind", "formula"},
          {"title", formula.title},
          {"symbols", formula.symbols},
          {"numbers", formula.numbers},
          {"note", formula.note}};
}

Record record_of(const Text& t) {
  return {{"kind", "text"}, {"title", t.title}, {"body", t.body}, {"verbatim", t.verbatim}, {"folded", t.folded}};
}

Record record_of(const MachineView::Part& part) {
  Record r = {{"name", part.name},
              {"kind", part.kind},
              {"ratioIn", Rounded{part.ratio_in}},
              {"ratioOut", Rounded{part.ratio_out}},
              {"elastic", part.elastic}};
  if (part.slips) r.push_back({"slips", true});
  r.push_back({"crank", part.crank});
  r.push_back({"row", part.row});
  return r;
}

Record record_of(const MachineView::Tie& tie) {
  return {{"row", tie.row}, {"atEnd", tie.at_end}, {"part", tie.part}, {"out", tie.out}};
}

Record record_of(const MachineView::Linkage& linkage) {
  return {{"name", linkage.name},
          {"load", linkage.load},
          {"ratio", Rounded{linkage.ratio}},
          {"direction", Rounded{linkage.direction}},
          {"x", rounded(linkage.x, 5)},
          {"y", rounded(linkage.y, 5)},
          {"links", each(linkage.links,
                         [](const MachineView::Linkage::Link& link) {
                           return Record{{"shape", link.shape}, {"joints", link.joints}};
                         })},
          {"fixed", linkage.fixed},
          {"output", linkage.output},
          {"gaps", each(linkage.gaps,
                        [](const MachineView::Linkage::Gap& gap) {
                          return Record{{"joint", gap.joint}, {"size", Rounded{gap.size}}};
                        })},
          {"bendEnlargement", Rounded{linkage.bend_enlargement}}};
}

Record record_of(const MachineView::Motion& motion) {
  Record r = {{"label", motion.label}, {"role", name_of(motion.role)}};
  add(r, "angle", RoundedList{motion.angle});
  add(r, "twistIn", rounded(motion.twist_in, 4));
  add(r, "twistOut", rounded(motion.twist_out, 4));
  if (!motion.slip_in.empty()) {
    add(r, "slipIn", rounded(motion.slip_in, 5));
    add(r, "slipOut", rounded(motion.slip_out, 5));
  }
  add(r, "torque", rounded(motion.torque, 4));
  add(r, "force", rounded(motion.force, 4));
  add(r, "bend", rounded(motion.bend, 4));
  add(r, "shift", rounded(motion.shift, 4));
  return r;
}

Record record_of(const GearView::Wheel& wheel) {
  return {{"name", wheel.name},
          {"teeth", wheel.teeth},
          {"internal", wheel.internal},
          {"x", RoundedList{wheel.x, 7}},
          {"y", RoundedList{wheel.y, 6}},
          {"centre", Rounded{wheel.centre, 9}},
          {"angle", Rounded{wheel.angle, 12}},
          {"speed", Rounded{wheel.speed, 12}},
          {"edge", Rounded{wheel.edge}},
          {"circles", each(wheel.circles, [](const GearView::Circle& circle) {
             return Record{{"name", circle.name}, {"radius", Rounded{circle.radius, 9}}};
           })}};
}

Record record_of(const KeyFigure& figure) {
  const TileText text = tile_text(figure, figure.digits);
  Record r = {{"name", figure.name}, {"value", text.value}};
  if (!text.known.empty()) r.push_back({"known", text.known});
  r.push_back({"unit", pretty_unit(figure.unit)});
  r.push_back({"error", text.error});
  r.push_back({"note", figure.note});
  if (!figure.means.empty()) r.push_back({"means", figure.means});
  return r;
}

Record record_of(const Meaning& meaning) {
  return {{"id", meaning.id}, {"title", meaning.title}, {"text", meaning.text}};
}

template <class Parts>
List records_of(const Parts& parts) {
  return each(parts, [](const auto& part) { return record_of(part); });
}

Record record_of(const MachineView& machine) {
  Record r = {{"kind", "machine"},
              {"title", machine.title},
              {"link", machine.link},
              {"enlargement", Rounded{machine.enlargement}},
              {"cycle", Rounded{machine.cycle > 0 ? machine.cycle : 2 * std::numbers::pi, 12}},
              {"parts", records_of(machine.parts)},
              {"ties", records_of(machine.ties)}};
  add(r, "linkages", records_of(machine.linkages));
  add(r, "time", RoundedList{machine.time});
  add(r, "motions", records_of(machine.motions));
  return r;
}

Record record_of(const GearView& view) {
  return {{"kind", "gears"},
          {"title", view.title},
          {"note", view.note},
          {"wheels", records_of(view.wheels)},
          {"points", each(view.points,
                          [](const GearView::Point& point) {
                            return Record{{"name", point.name}, {"place", Rounded{point.place, 9}}};
                          })},
          {"pitchPoint", Rounded{view.pitch_point, 9}},
          {"direction", Rounded{view.direction, 9}},
          {"start", Rounded{view.start, 9}},
          {"end", Rounded{view.end, 9}},
          {"basePitch", Rounded{view.base_pitch, 9}},
          {"firstContact", Rounded{view.first_contact, 9}},
          {"baseRadius", Rounded{view.base_radius, 9}},
          {"closeUp", Rounded{view.close_up}}};
}

Record section_record(const ReportSection& section) {
  Record r = {{"title", section.title}};
  add(r, "cards", each(section.cards, [](const Card& card) {
        return std::visit([](const auto& c) { return record_of(c); }, card);
      }));
  return r;
}

// All texts in it, one per line.
void add_words(const Value& value, std::string& words) {
  if (const std::string* text = value.as<std::string>()) words += *text + "\n";
  if (const List* list = value.as<List>())
    for (const Value& item : *list) add_words(item, words);
  if (const Record* record = value.as<Record>())
    for (const Field& field : *record) add_words(field.value, words);
}

Record record_of(const Report& report, const Letterhead& head) {
  Record r = {{"title", report.title}};
  if (!head.brand_svg.empty()) r.push_back({"brand", head.brand_svg});
  if (!head.author.empty()) r.push_back({"author", head.author});
  add(r, "subtitle", report.subtitle);
  add(r, "conclusion", report.conclusion);
  add(r, "complete", report.complete);
  add(r, "footer", report.footer);
  add(r, "figures", records_of(report.figures));
  add(r, "sections", each(report.sections, section_record));
  if (!report.meanings.empty()) r.push_back({"meanings", records_of(report.meanings)});
  std::string words;
  for (const Field& field : r) add_words(field.value, words);
  if (const std::vector<std::string> notes = theory_notes(words); !notes.empty()) r.push_back({"theory", notes});
  return r;
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
  const bool labels = series.labels.size() == series.x.size(), sizes = series.sizes.size() == series.x.size();
  if (series.x.size() <= points_per_series) {
    Series all = series;
    if (!labels) all.labels.clear();
    if (!sizes) all.sizes.clear();
    return all;
  }
  const std::vector<std::size_t> kept = series.line ? kept_by_extremes(series.x, series.y, points_per_series)
                                                    : drawn_by_chance(series.x.size(), points_per_series);
  const auto chosen = [&kept](const auto& list, bool any) {
    std::remove_cvref_t<decltype(list)> some;
    some.reserve(any ? kept.size() : 0);
    for (std::size_t i = 0; i < kept.size() && any; ++i) some.push_back(list[kept[i]]);
    return some;
  };
  return {.name = series.name,
          .role = series.role,
          .x = chosen(series.x, true),
          .y = chosen(series.y, !series.y.empty()),
          .dashed = series.dashed,
          .points = series.points,
          .line = series.line,
          .labels = chosen(series.labels, labels && !series.line),
          .sizes = chosen(series.sizes, sizes && !series.line),
          .text_at_start = series.text_at_start,
          .text_at_end = series.text_at_end};
}

std::string html_of(const Report& report, const Letterhead& head) {
  const std::string json = json_text(record_of(report, head), JsonForm::in_page);
  const std::string_view page = page_html();
  std::string html;
  html.reserve(page.size() + json.size() + plotly_js().size() + 65536);
  // Placeholders {{name}} of the template, in one pass; inserted text is not scanned again.
  std::size_t at = 0;
  for (std::size_t open = page.find("{{"); open != std::string_view::npos; open = page.find("{{", at)) {
    const std::size_t close = page.find("}}", open);
    const std::string_view name = page.substr(open + 2, close - open - 2);
    html += page.substr(at, open - at);
    if (name == "title")
      html += escaped_xml(report.title);
    else if (name == "conclusion")
      html += escaped_xml(fmt::format("{}", fmt::join(report.conclusion, " ")));
    else if (name == "css")
      html += page_css();
    else if (name == "js")
      html += page_js();
    else if (name == "plotly")
      html += plotly_js();
    else if (name == "licence")
      html += escaped_xml(plotly_licence());
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
