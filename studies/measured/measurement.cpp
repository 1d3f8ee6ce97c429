// measurement.cpp — headings and units, options, and numbers, with a message for every error.
#include "studies/measured/measurement.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <stdexcept>

#include "engine/scene/messages.h"
#include "engine/scene/text.h"
#include "engine/scene/units.h"
#include "engine/tables/heading.h"
#include "engine/tables/spreadsheet.h"
#include "engine/tables/table_file.h"

namespace kurbel {
namespace {

// An option "COLUMN=…", the column's heading with or without its unit.
struct Option {
  std::string shown, column, value;  // shown: as messages name it
  int value_at = 1;                  // in its text, from 1
};

Option split_option(const std::string& name, const std::string& text, const std::string& example) {
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos || equals == 0)
    throw std::invalid_argument(fmt::format("{} {}: must be COLUMN=…, e.g. {}", name, in_quotes(text), example));
  return {fmt::format("{} {}", name, in_quotes(text)), std::string(trimmed(std::string_view(text).substr(0, equals))),
          std::string(trimmed(std::string_view(text).substr(equals + 1))), static_cast<int>(equals) + 2};
}

std::string quoted_list(const std::vector<std::string>& names, std::size_t most = 12) {
  std::string list;
  for (std::size_t i = 0; i < names.size() && i < most; ++i) list += (i ? ", " : "") + in_quotes(names[i]);
  return names.size() > most ? fmt::format("{} … ({} in all)", list, names.size()) : list;
}

std::string did_you_mean(const std::string& word, const std::vector<std::string>& names) {
  const auto near = nearest(word, names);
  return near ? fmt::format("; did you mean {}?", in_quotes(*near)) : "";
}

Dimension dimension_of(const std::string& si_unit) {
  UnitError error;
  return parse_unit(si_unit, error)->dimension;
}

// Minutes as machines' records write them: "U/min", "min-1".
std::optional<Unit> unit_named(const std::string& text, UnitError& error, const Dimension& wanted) {
  static constexpr std::string_view per_minute[] = {"U/min", "Upm", "UpM", "UPM", "r/min", "tr/min", "/min", "min-1"};
  const bool of_minutes = std::count(std::begin(per_minute), std::end(per_minute), text) > 0;
  const auto unit = parse_unit(text == "-" || text == "1" ? "" : of_minutes ? "1/min" : text, error);
  return unit ? std::optional(wanted_as(*unit, wanted)) : std::nullopt;
}

class Reader {
 public:
  Reader(const MeasurementRequest& request, const std::vector<KnownChannel>& channels)
      : request_(request),
        channels_(channels),
        file_(request.file, form_of(request.file, request.maps)),
        headings_(file_.headings()),
        messages_(request.file) {}

  Measurement read() {
    out_.file = request_.file, out_.over_angle = request_.over == "angle";
    std::vector<Option> maps;
    for (const std::string& map : request_.maps)
      maps.push_back(split_option("--map", map, "--map \"T1=torque.main_coupling\""));
    for (const Option& map : maps)
      if (name_with_unit(map.value).name == request_.over) find_time(map);
    if (!time_asked_) find_time_by_name();
    for (const Option& map : maps)
      if (name_with_unit(map.value).name != request_.over) add_signal(map);
    messages_.throw_if_any();
    read_numbers();
    messages_.throw_if_any();
    read_shift();
    for (const std::string& offset : request_.offsets) read_offset(offset);
    messages_.throw_if_any();
    return std::move(out_);
  }

 private:
  struct Source {
    int column = 0;     // from 1
    double factor = 1;  // to SI
  };

  const TableHeading* required(const Option& option) {
    const TableHeading* heading = file_.find(option.column);
    if (!heading)
      messages_.add(headings_.empty() ? Location{} : headings_.front().at,
                    fmt::format("no column {} ({}); columns: {}{}", in_quotes(option.column), option.shown,
                                quoted_list(file_.names()), did_you_mean(option.column, file_.names())));
    return heading;
  }

  // From the option, or from the heading; both only if they agree, or the heading's is not known.
  std::optional<Source> source_of(const TableHeading& heading, const Option& option, const std::string& channel,
                                  const std::string& si_unit) {
    const auto in_heading = heading.unit, in_option = name_with_unit(option.value).unit;
    const std::string example = si_unit.empty() ? "1" : si_unit;
    if (!in_heading && !in_option) {
      if (si_unit.empty()) return Source{heading.column, 1};
      messages_.add(heading.at,
                    fmt::format("column {} has no unit; write \"{} [{}]\" in the heading, or --map \"{}={} [{}]\"",
                                in_quotes(heading.text), heading.text, example, heading.text, channel, example));
      return {};
    }
    UnitError error;
    const Dimension wanted = dimension_of(si_unit);
    const auto by_heading = in_heading ? unit_named(*in_heading, error, wanted) : std::nullopt,
               by_option = in_option ? unit_named(*in_option, error, wanted) : std::nullopt;
    const auto alike = [](const Unit& a, const Unit& b) { return a.factor == b.factor && a.dimension == b.dimension; };
    if (by_heading && by_option && !alike(*by_heading, *by_option)) {
      messages_.add_in(option.shown, {1, option.value_at},
                       fmt::format("the unit is [{}] here and [{}] in the heading of {}; leave one of them out",
                                   *in_option, *in_heading, request_.file));
      return {};
    }
    return in_unit(in_option ? *in_option : *in_heading, heading, channel, si_unit);
  }
  std::optional<Source> in_unit(const std::string& text, const TableHeading& heading, const std::string& channel,
                                const std::string& si_unit) {
    UnitError error;
    const Dimension wanted = dimension_of(si_unit);
    const std::optional<Unit> unit = unit_named(text, error, wanted);
    if (unit && unit->dimension == wanted) return Source{heading.column, unit->factor};
    messages_.add(
        heading.at,
        fmt::format("unit [{}] of column {} {}, but {} is {}; units of it: {}{}", text, in_quotes(heading.text),
                    unit ? "is " + name_of(unit->dimension) : "is not known (" + error.text + ")", channel,
                    name_of(wanted), examples_of(si_unit), unit ? force_meant(text, unit->dimension, wanted) : ""));
    return {};
  }

  void find_time(const Option& map) {
    if (const TableHeading* heading = required(map))
      if (const auto source = source_of(*heading, map, request_.over, request_.over_unit)) time_ = *source;
    time_asked_ = true;
  }
  void find_time_by_name() {
    for (const TableHeading& h : headings_) {
      std::string name = h.name;
      std::transform(name.begin(), name.end(), name.begin(), [](unsigned char c) { return std::tolower(c); });
      if (name != request_.over && !(name == "t" && request_.over == "time")) continue;
      if (const auto source = source_of(h, {}, request_.over, request_.over_unit)) time_ = *source;
      return;
    }
    messages_.add(headings_.empty() ? Location{} : headings_.front().at,
                  fmt::format("no column \"{0}\"{1}; columns: {2}; say which it is: --map \"COLUMN={0}{3}\"",
                              request_.over, request_.over == "time" ? " or \"t\"" : "", quoted_list(file_.names()),
                              request_.over_unit.empty() ? "" : fmt::format(" [{}]", request_.over_unit)));
  }

  void add_signal(const Option& map) {
    const NameWithUnit asked = name_with_unit(map.value);
    std::vector<std::string> names;
    const KnownChannel* channel = nullptr;
    for (const KnownChannel& c : channels_) {
      names.push_back(c.name);
      if (c.name == asked.name) channel = &c;
    }
    if (!channel) {
      const std::string meant = did_you_mean(asked.name, names);
      messages_.add_in(map.shown, {1, map.value_at},
                       fmt::format("no channel {} is recorded{}{}", in_quotes(asked.name), meant,
                                   meant.empty() ? "; there are " + quoted_list(names) : ""));
    }
    const TableHeading* heading = required(map);
    if (!channel || !heading) return;
    const auto source = source_of(*heading, map, channel->name, channel->unit);
    if (!source) return;
    sources_.push_back(*source);
    out_.signals.push_back({.column = heading->name, .channel = channel->name, .unit = channel->unit, .values = {}});
  }

  void read_numbers() {
    std::vector<int> columns = {time_.column};
    for (const Source& source : sources_) columns.push_back(source.column);
    TableNumbers numbers = file_.numbers(columns, messages_, &out_.rows_left_out);
    messages_.throw_if_any();
    require_ascending(numbers);
    for (double& t : numbers.columns[0]) t *= time_.factor;
    out_.time = std::move(numbers.columns[0]);
    for (std::size_t k = 0; k < sources_.size(); ++k) {
      for (double& value : numbers.columns[k + 1]) value *= sources_[k].factor;
      out_.signals[k].values = std::move(numbers.columns[k + 1]);
    }
  }
  void require_ascending(const TableNumbers& numbers) {
    const std::vector<double>& t = numbers.columns[0];
    if (t.size() < request_.fewest_rows)
      messages_.add({}, fmt::format("{} rows; at least {} are needed{}", t.size(), request_.fewest_rows,
                                    out_.rows_left_out == 0 ? ""
                                                            : fmt::format("; {} more lack a number in a column that is "
                                                                          "mapped: map fewer columns at once",
                                                                          out_.rows_left_out)));
    for (std::size_t i = 1; i < t.size(); ++i)
      if (!(t[i] > t[i - 1])) {
        messages_.add(numbers.at[i],
                      fmt::format("{0} {1} after {2}: {0}s must ascend; sort the rows, and drop what stands twice",
                                  request_.over, t[i], t[i - 1]));
        return;
      }
  }

  std::optional<Fitted> fitted(const std::string& option, const std::string& text, const std::string& si_unit,
                               int at = 1) {
    if (text == "fit") return Fitted{.value = 0, .fit = true};
    UnitError error;
    auto quantity = parse_quantity(text, error);
    const Dimension wanted = dimension_of(si_unit);
    if (quantity) *quantity = wanted_as(*quantity, wanted);
    if (quantity && quantity->dimension == wanted) return Fitted{.value = quantity->value};
    messages_.add_in(option, {1, at + static_cast<int>(quantity ? 0 : error.column)},
                     quantity ? fmt::format("{} is {}; must be {}, e.g. \"0.2 {}\", or fit", in_quotes(text),
                                            name_of(quantity->dimension), name_of(wanted), si_unit)
                              : fmt::format("{}; e.g. \"0.2 {}\", or fit", error.text, si_unit));
    return {};
  }
  void read_shift() {
    if (request_.shift.empty()) return;
    if (const auto shift = fitted("--shift " + in_quotes(request_.shift), request_.shift, request_.over_unit))
      out_.shift = *shift;
  }
  void read_offset(const std::string& text) {
    if (text == "fit") {
      for (MeasuredSignal& s : out_.signals) s.offset = {.value = 0, .fit = true};
      return;
    }
    const Option option = split_option("--offset", text, "--offset \"T1=5 N*m\", --offset \"T1=fit\", --offset fit");
    std::vector<std::string> names;
    for (MeasuredSignal& s : out_.signals) {
      names.push_back(s.column);
      if (s.column != name_with_unit(option.column).name) continue;
      if (const auto offset = fitted(option.shown, option.value, s.unit, option.value_at)) s.offset = *offset;
      return;
    }
    messages_.add_in(option.shown, {1, 1},
                     fmt::format("no column {} is mapped; mapped: {}{}", in_quotes(option.column), quoted_list(names),
                                 did_you_mean(option.column, names)));
  }

  const MeasurementRequest& request_;
  const std::vector<KnownChannel>& channels_;
  TableFile file_;
  const std::vector<TableHeading>& headings_;
  Messages messages_;
  Source time_;
  bool time_asked_ = false;  // by --map
  std::vector<Source> sources_;
  Measurement out_;
};

}  // namespace

TableForm form_of(const std::string& file, const std::vector<std::string>& maps) {
  std::vector<std::string> columns;
  for (const std::string& map : maps)
    if (const std::string column(trimmed(std::string_view(map).substr(0, map.find('='))));
        column.find('*') == std::string::npos)
      columns.push_back(column);
  for (const std::string& name : sheet_names(file)) try {
      const TableFile sheet(file, {.sheet = name});
      if (std::all_of(columns.begin(), columns.end(), [&](const std::string& c) { return sheet.find(c); }))
        return {.sheet = name};
    } catch (const SceneError&) {  // a sheet without numbers
    }
  return {};
}

std::string Measurement::gaps() const {
  return rows_left_out == 0 ? ""
                            : fmt::format("{} of {} rows of {} are omitted: no number in a column that is mapped",
                                          rows_left_out, rows_left_out + time.size(), file);
}

Measurement read_measurement(const MeasurementRequest& request, const std::vector<KnownChannel>& channels) {
  if (request.file.empty())
    throw std::invalid_argument("--map, --shift and --offset belong to a measurement; give it: --measured test.csv");
  if (request.maps.empty())
    throw std::invalid_argument(
        fmt::format("--measured {}: say which column is which channel: --map \"T1=torque.main_coupling\" (repeatable)",
                    request.file));
  Reader reader(request, channels);
  Measurement measurement = reader.read();
  if (measurement.signals.empty())
    throw std::invalid_argument(fmt::format(
        "--measured {}: only the time is mapped; map a channel, too: --map \"T1=torque.main_coupling\"", request.file));
  return measurement;
}

void require_overlap(const Measurement& m, double begin, double end) {
  if (m.shift.fit) return;
  const double from = m.time.front() + m.shift.value, to = m.time.back() + m.shift.value;
  if (from < end && to > begin) return;
  throw std::invalid_argument(
      fmt::format("--measured {}: measured from {:.6g} to {:.6g} s{}, simulated from {:.6g} to {:.6g} s: no time in "
                  "common; give --shift \"{:.6g} s\", which lets both begin together, or --shift fit",
                  m.file, from, to, m.shift.value != 0 ? fmt::format(" (shifted by {:.6g} s)", m.shift.value) : "",
                  begin, end, begin - m.time.front()));
}

}  // namespace kurbel
