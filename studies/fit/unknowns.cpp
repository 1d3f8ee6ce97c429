// unknowns.cpp — texts of unknowns, with what may stand there.
#include "studies/fit/unknowns.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "engine/base/find_by.h"
#include "engine/scene/messages.h"
#include "engine/scene/units.h"

namespace kurbel {
namespace {

using Kind = Unknown::Kind;

struct Prefix {
  const char* words;
  Kind kind;
};
constexpr Prefix prefixes[] = {{"gain of ", Kind::gain},
                               {"offset of ", Kind::offset},
                               {"shift of ", Kind::table_shift},
                               {"dead centre of ", Kind::dead_centre},
                               {"pattern of ", Kind::cosine}};

bool has_channel(const FitRecord& record, const std::string& name) {
  return std::any_of(record.channels.begin(), record.channels.end(),
                     [&](const RecordChannel& c) { return c.channel == name; });
}

[[noreturn]] void refuse(const std::string& text, const std::string& why) {
  throw std::invalid_argument(fmt::format("--free {}: {}", in_quotes(text), why));
}

class Reader {
 public:
  Reader(const std::string& text, const std::vector<FitRecord>& records) : text_(text), records_(records) {
    std::vector<std::string> names;
    for (const FitRecord& r : records) names.push_back(r.name);
    const OfRecord of = of_record("--free " + in_quotes(text), text, names);
    only_ = of.record, each_ = of.each, rest_ = of.rest;
  }

  std::vector<Unknown> read() {
    Unknown made;
    for (const Prefix& prefix : prefixes)
      if (rest_.starts_with(prefix.words)) {
        made.kind = prefix.kind;
        rest_ = rest_.substr(std::string(prefix.words).size());
        words_ = prefix.words;
      }
    try {
      made.range = parse_parameter(rest_);
    } catch (const std::invalid_argument& error) {
      const std::string said = error.what();
      const std::size_t colon = said.find(": ", said.find(in_quotes(rest_)) + in_quotes(rest_).size());
      refuse(text_, said.substr(said.starts_with("--vary") && colon != std::string::npos ? colon + 2 : 0));
    }
    made.of = made.range.path;
    made.range.where = "--free";
    if (made.kind == Kind::cosine) return pattern(made);
    if (made.range.is_list()) refuse(text_, "must be a range, e.g. \"rotor.inertia=0.005..0.05 kg*m2\"");
    if (made.kind == Kind::key && made.of == "shift") made.kind = Kind::record_shift;
    if (made.kind == Kind::gain && !of_a_channel(made.of)) made.kind = Kind::table_gain;
    if (made.kind == Kind::offset && !of_a_channel(made.of)) made.kind = Kind::table_offset;
    made.name = words_ + made.of;
    take_unit(made);
    return each_of(made);
  }

 private:
  bool of_a_channel(const std::string& name) const {
    return std::any_of(records_.begin(), records_.end(), [&](const FitRecord& r) { return has_channel(r, name); });
  }
  [[noreturn]] void refuse_channel(const std::string& name) const {
    std::vector<std::string> known;
    for (const FitRecord& r : records_)
      for (const RecordChannel& c : r.channels) known.push_back(c.channel);
    refuse(text_, fmt::format("no channel {} is mapped; mapped: {}{}", in_quotes(name), listed(known, "and"),
                              suggestion(name, known)));
  }

  std::string wanted_unit(const Unknown& u) const {
    const std::size_t r = only_.value_or(0);
    if (u.kind == Kind::record_shift) return records_[r].over == Over::time ? "s" : "rad";
    if (u.kind == Kind::dead_centre) return "rad";
    if (u.kind == Kind::offset)
      for (const FitRecord& record : records_)
        for (const RecordChannel& c : record.channels)
          if (c.channel == u.of) return c.unit;
    return "";
  }
  void take_unit(Unknown& u) const {
    if (u.kind == Kind::key) return;  // the scene's reader knows
    UnitError error;
    const std::string wanted = wanted_unit(u);
    auto unit = parse_unit(u.range.unit, error);
    const Dimension dimension = parse_unit(wanted, error)->dimension;
    if (unit) *unit = wanted_as(*unit, dimension);
    // A table's shift is in the unit of what it stands over, its offset in that of its values.
    const bool of_table = u.kind == Kind::table_shift || u.kind == Kind::table_offset;
    if (unit && !of_table && unit->dimension != dimension)
      refuse(text_, fmt::format("is {}; must be {}", name_of(unit->dimension), name_of(dimension)));
    u.factor = unit ? unit->factor : 1;
  }

  // One of its own for every record that has it, or one for all.
  std::vector<Unknown> each_of(const Unknown& made) const {
    std::vector<Unknown> list;
    for (const FitRecord& other : records_)
      if (made.kind == Kind::record_shift && !only_ && other.over != records_[0].over)
        refuse(text_, fmt::format("is of records over unlike axes; give one of each record, e.g. \"{}: shift=…\"",
                                  other.name));
    for (std::size_t r = 0; r < records_.size(); ++r) {
      const bool in_it = (made.kind != Kind::gain && made.kind != Kind::offset && made.kind != Kind::cosine &&
                          made.kind != Kind::sine) ||
                         has_channel(records_[r], made.of);
      if (only_ ? *only_ != r : !in_it) continue;
      if (made.kind == Kind::record_shift && records_[r].over == Over::mode)
        refuse(text_, fmt::format("{} holds modes, which have no shift", records_[r].file));
      Unknown u = made;
      if (each_ || only_) u.record = r, u.name = records_[r].name + ": " + made.name;
      list.push_back(u);
      if (!each_) break;
    }
    if (list.empty()) refuse_channel(made.of);
    return list;
  }

  std::vector<Unknown> pattern(Unknown made) const {
    if (!of_a_channel(made.of)) refuse_channel(made.of);
    std::vector<Unknown> list;
    constexpr double widest = 0.05;  // of the mean
    for (const double k : made.range.values) {
      if (!made.range.unit.empty() || !made.range.words.empty() || k < 1 || k != std::round(k))
        refuse(text_, "must be whole orders of a turn, e.g. \"pattern of speed.engine=1,2\"");
      for (const Kind kind : {Kind::cosine, Kind::sine}) {
        Unknown u = made;
        u.kind = kind, u.order = static_cast<int>(k);
        u.range.values.clear(), u.range.low = -widest, u.range.high = widest;
        u.name = fmt::format("pattern of {}, order {} {}", made.of, k, kind == Kind::cosine ? "cos" : "sin");
        for (const Unknown& one : each_of(u)) list.push_back(one);
      }
    }
    for (const Unknown& u : list)
      for (std::size_t r = 0; r < records_.size(); ++r)
        if (u.concerns(r) && has_channel(records_[r], u.of) && !u.of.starts_with("speed."))
          refuse(text_, fmt::format("{} is no speed, of which an encoder repeats a pattern each turn", u.of));
    return list;
  }

  std::string text_, rest_, words_;
  const std::vector<FitRecord>& records_;
  std::optional<std::size_t> only_;
  bool each_ = false;
};

}  // namespace

OfRecord of_record(const std::string& option, const std::string& text, const std::vector<std::string>& names) {
  const std::size_t colon = text.find(": ");
  if (colon == std::string::npos) return {.rest = text};
  const std::string name = text.substr(0, colon), rest = text.substr(colon + 2);
  if (name == "each") return {.record = {}, .each = true, .rest = rest};
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end())
    throw std::invalid_argument(fmt::format("{}: no record {}; there are {}{}", option, in_quotes(name),
                                            listed(names, "and"), suggestion(name, names)));
  return {.record = static_cast<std::size_t>(found - names.begin()), .each = false, .rest = rest};
}

std::vector<Unknown> parse_unknowns(const std::vector<std::string>& given, const std::vector<FitRecord>& records) {
  std::vector<Unknown> list;
  for (const std::string& text : given)
    for (const Unknown& u : Reader(text, records).read()) {
      for (const Unknown& other : list)
        if (other.name == u.name || (other.kind == u.kind && other.of == u.of && other.order == u.order &&
                                     (!other.record || !u.record || *other.record == *u.record)))
          refuse(text, fmt::format("{} is free twice; give one of them", u.name));
      list.push_back(u);
    }
  if (list.empty())
    throw std::invalid_argument("nothing is free; give --free \"rotor.inertia=0.005..0.05 kg*m2\" (repeatable)");
  return list;
}

CurveData* table_at(std::vector<Section>& sections, const std::string& path) {
  const std::size_t dot = path.find('.');
  if (dot == std::string::npos) return nullptr;
  Section* in = find_by(sections, &Section::name, path.substr(0, dot));
  if (!in) return nullptr;
  for (std::size_t begin = dot + 1;;) {
    const std::size_t end = path.find('.', begin);
    const std::string key = path.substr(begin, end - begin);
    const auto setting = std::find_if(in->settings.begin(), in->settings.end(),
                                      [&](const Setting& s) { return s.key == key && s.given; });
    if (setting == in->settings.end()) return nullptr;
    if (end == std::string::npos) return setting->curve.x.size() > 1 ? &setting->curve : nullptr;
    if (setting->sections.size() != 1) return nullptr;
    in = &setting->sections.front();
    begin = end + 1;
  }
}

}  // namespace kurbel
