// train_sheet.cpp — reads the stations and their connections, and writes them along the tree that they form.
#include "studies/scenes/train_sheet.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <deque>
#include <filesystem>
#include <map>
#include <optional>
#include <vector>

#include "engine/scene/keys.h"
#include "engine/scene/text.h"
#include "engine/scene/units.h"
#include "engine/tables/table_file.h"
#include "engine/values/quantity_reader.h"

namespace kurbel {
namespace {

constexpr double same_speed = 1e-9;
constexpr double most_teeth = 1e5;

// Possible contents of a column, and its names.
struct ColumnKind {
  const char* key;
  const char* unit;  // SI; "": a plain number; null: words
  std::vector<std::string> names;
};
const std::vector<ColumnKind>& column_kinds() {
  static const std::vector<ColumnKind> kinds = {
      {"station", nullptr, {"station", "node", "name", "disc", "disk"}},
      {"to", nullptr, {"to", "to station", "to node"}},
      {"inertia", "kg*m2", {"inertia", "j", "polar inertia", "wr2", "wk2"}},
      {"GD2", "kg*m2", {"gd2", "gd²"}},
      {"referred inertia", "kg*m2", {"referred inertia", "equivalent inertia"}},
      {"stiffness", "N*m/rad", {"stiffness", "k", "torsional stiffness"}},
      {"referred stiffness", "N*m/rad", {"referred stiffness", "equivalent stiffness"}},
      {"damping", "N*m*s/rad", {"damping", "c"}},
      {"ratio", "", {"speed ratio", "ratio"}},
      {"speed", "rad/s", {"speed"}},
      {"diameter", "m", {"diameter", "outer diameter", "od"}},
      {"bore", "m", {"bore", "inner diameter", "id"}},
      {"remark", nullptr, {"remark", "remarks", "comment", "description"}},
  };
  return kinds;
}

struct Station {
  std::string said, name;
  std::string inertia = {};  // "12.4 kg*m2"; empty: none
  double ratio = 1, speed = 0;
  Location at;
};
// Connection of two stations.
struct Joint {
  std::size_t a = 0, b = 0;
  bool rigid = false;
  std::vector<std::pair<std::string, std::string>> keys = {};  // of a shaft
  Location at;
  bool written = false;
};

std::string as_name(const std::string& said) {
  std::string name;
  for (const char c : said) {
    const bool plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-';
    if (plain)
      name += c;
    else if (!name.ends_with('_'))
      name += '_';
  }
  while (name.ends_with('_')) name.pop_back();
  const bool number = name.find_first_not_of("0123456789-_") == std::string::npos;
  const std::vector<std::string> taken = {"title",    "description", "line",  "branch",    "effects", "run",
                                          "sequence", "operation",   "table", "constants", "case",    "figure"};
  const bool reserved = std::find(taken.begin(), taken.end(), name) != taken.end();
  return number || reserved ? "station_" + name : name;
}

// Whole numbers up to 100 000 whose ratio is the given one, by its continued fraction.
std::pair<double, double> teeth_of(double ratio) {
  double p0 = 0, q0 = 1, p1 = 1, q1 = 0;
  for (double x = ratio; q1 == 0 || std::abs(p1 / q1 - ratio) > 1e-12 * ratio; x = 1 / (x - std::floor(x))) {
    const double a = std::floor(x), p = a * p1 + p0, q = a * q1 + q0;
    if (std::max(p, q) > most_teeth) break;
    p0 = p1, q0 = q1, p1 = p, q1 = q;
    if (x == a) break;
  }
  return {p1, q1};
}

class Sheet {
 public:
  explicit Sheet(const std::string& path) : path_(path), file_(path, {.words = true}) {
    find_columns();
    rows_ = file_.cells(true);
    read_stations();
    read_joints();
  }

  std::string scene() {
    check_stations();
    write_lines();
    std::string text = fmt::format(
        "#:schema ./scene.schema.json\n# Train of {}: {} stations. Each value is that of its own shaft. Nothing drives "
        "it yet, and\n# nothing damps it unless the sheet says so: give couplings a damping_ratio before a response is "
        "judged.\n"
        "title = \"{}\"\nline = [{}]\n",
        std::filesystem::path(path_).filename().string(), stations_.size(),
        as_name(std::filesystem::path(path_).stem().string()), lines_.front());
    for (std::size_t k = 1; k < lines_.size(); ++k) text += lines_[k];
    text += tables_ + "\n[effects]\nelasticity = true\n";
    if (const Station& first = stations_.front(); first.speed != 0)
      text += fmt::format(
          "\n[operation]\nspeeds = [\"{0:.12g} rad/s\"]\non = \"{1}\"\n\n[run]\nstart = {{ speed = \"{0:.12g} rad/s\", "
          "on = \"{1}\" }}\n",
          std::abs(first.speed), first.name);
    else
      text +=
          "\n# Where it runs for long, for separation margins:\n# [operation]\n# speeds = [\"1340 rpm\", \"1640 "
          "rpm\"]\n";
    return text;
  }

 private:
  [[noreturn]] void refuse(Location at, const std::string& why) const { throw SceneError({{path_, at, why}}); }

  struct Column {
    std::size_t place = 0;
    std::string unit, si;
    double factor = 1;
  };

  void find_columns() {
    std::vector<std::string> allowed;
    for (const ColumnKind& kind : column_kinds()) allowed.insert(allowed.end(), kind.names.begin(), kind.names.end());
    for (const TableHeading& heading : file_.headings()) {
      const ColumnKind* found = nullptr;
      for (const ColumnKind& kind : column_kinds())
        for (const std::string& name : kind.names)
          if (equal_but_for_case(heading.name, name)) found = &kind;
      if (!found)
        refuse(heading.at, fmt::format("column {}: what is it?{} Allowed: {}", in_quotes(heading.text),
                                       suggestion(heading.name, allowed), listed(allowed, "and")));
      const auto [place, fresh] =
          columns_.try_emplace(found->key, Column{static_cast<std::size_t>(heading.column) - 1,
                                                  heading.unit.value_or(""), found->unit ? found->unit : ""});
      if (!fresh) refuse(heading.at, fmt::format("two columns give the {}; keep one", found->key));
      if (found->unit && *found->unit) check_unit(heading, *found, place->second);
    }
    const auto one_of = [&](const char* a, const char* b, const char* c) {
      if (columns_.count(a) + columns_.count(b) + (*c ? columns_.count(c) : 0) != 1)
        refuse({1, 1}, fmt::format("must have one column of {}: {}{}{}", a, a, std::string(" or ") + b,
                                   *c ? std::string(" or ") + c : ""));
    };
    one_of("inertia", "GD2", "referred inertia");
    one_of("stiffness", "referred stiffness", "");
    if (!columns_.count("station")) refuse({1, 1}, "has no column \"station\" with the stations' names");
    if (columns_.count("ratio") && columns_.count("speed"))
      refuse({1, 1}, "gives both \"speed\" and \"speed ratio\"; keep one");
    if (columns_.count("referred inertia") + columns_.count("referred stiffness") == 1)
      refuse({1, 1}, "has one of inertia and stiffness referred to one shaft and the other not; give both alike");
  }

  void check_unit(const TableHeading& heading, const ColumnKind& kind, Column& column) const {
    UnitError error;
    const Dimension wanted = parse_unit(kind.unit, error)->dimension;
    if (column.unit.empty())
      refuse(heading.at, fmt::format("column {} has no unit; write e.g. \"{} [{}]\"", in_quotes(heading.text),
                                     heading.name, kind.unit));
    const std::optional<Unit> unit = parse_unit(column.unit, error);
    if (!unit || wanted_as(*unit, wanted).dimension != wanted)
      refuse(heading.at, fmt::format("column {}: its unit must be of {}{}", in_quotes(heading.text), name_of(wanted),
                                     unit ? force_meant(column.unit, unit->dimension, wanted) : "; " + error.text));
    column.factor = wanted_as(*unit, wanted).factor;
  }

  // Null: no such column, or an empty cell.
  const TableCell* cell(const std::vector<TableCell>& row, const char* key) const {
    const auto column = columns_.find(key);
    if (column == columns_.end()) return nullptr;
    const TableCell& found = row[column->second.place];
    return found.text.empty() || found.text == "-" || found.text == "—" ? nullptr : &found;
  }
  std::optional<double> number(const std::vector<TableCell>& row, const char* key) const {
    const TableCell* found = cell(row, key);
    if (!found) return {};
    double value = 0;
    const char* const end = found->text.data() + found->text.size();
    const auto [stop, fault] = std::from_chars(found->text.data(), end, value);
    if (fault != std::errc{} || stop != end || !std::isfinite(value))
      refuse(found->at, fmt::format("{} = {}: must be a number", key, in_quotes(found->text)));
    return value;
  }
  // With the sheet's own digits if no conversion is needed.
  std::string quantity(const std::vector<TableCell>& row, const char* key, double times = 1) const {
    const double value = *number(row, key);
    if (value < 0) refuse(cell(row, key)->at, fmt::format("{} = {}: must be ≥ 0", key, cell(row, key)->text));
    const std::string digits = times == 1 ? cell(row, key)->text : fmt::format("{:.15g}", times * value);
    DocumentValue stated;
    stated.type = DocumentValue::Type::text, stated.text = digits + " " + columns_.at(key).unit;
    stated.at = cell(row, key)->at;
    Messages messages(path_);
    double in_si = 0;
    if (!read_quantity(stated, columns_.at(key).si, any_number, key, messages, in_si)) messages.throw_if_any();
    return stated.text;
  }
  std::size_t station_named(const std::string& said, Location at) const {
    for (std::size_t i = 0; i < stations_.size(); ++i)
      if (stations_[i].said == said) return i;
    std::vector<std::string> names;
    for (const Station& s : stations_) names.push_back(s.said);
    refuse(at, fmt::format("no station {}{}", in_quotes(said), suggestion(said, names)));
  }

  void read_stations() {
    for (const std::vector<TableCell>& row : rows_) {
      const TableCell* name = cell(row, "station");
      if (!name) refuse(row.front().at, "a row without a station's name");
      const auto before =
          std::find_if(stations_.begin(), stations_.end(), [&](const Station& s) { return s.said == name->text; });
      const bool again = before != stations_.end();
      if (again && !columns_.count("to"))
        refuse(name->at,
               fmt::format("station {} stands here twice, in line {} before", in_quotes(name->text), before->at.line));
      if (!again) stations_.push_back({.said = name->text, .name = as_name(name->text), .at = name->at});
      read_station(row, again ? *before : stations_.back(), again);
    }
    for (std::size_t i = 0; i < stations_.size(); ++i)
      for (std::size_t k = 0; k < i; ++k)
        if (stations_[i].name == stations_[k].name)
          refuse(stations_[i].at,
                 fmt::format("stations {} and {} have one name as components: {}", in_quotes(stations_[k].said),
                             in_quotes(stations_[i].said), stations_[i].name));
  }
  void read_station(const std::vector<TableCell>& row, Station& s, bool again) {
    if (const auto ratio = number(row, "ratio")) {
      if (*ratio == 0) refuse(cell(row, "ratio")->at, "a speed ratio of 0: omit what does not turn");
      if (again && std::abs(std::abs(*ratio) - s.ratio) > same_speed * s.ratio)
        refuse(cell(row, "ratio")->at,
               fmt::format("station {} has another speed ratio in line {}", in_quotes(s.said), s.at.line));
      s.ratio = std::abs(*ratio);
    } else if (columns_.count("ratio") && !again) {
      refuse(row[columns_.at("ratio").place].at,
             fmt::format(
                 "station {} has no speed ratio, where others have one: write 1 for those that turn with the first",
                 in_quotes(s.said)));
    }
    if (const auto speed = number(row, "speed")) {
      s.speed = *speed * columns_.at("speed").factor;
      if (s.speed == 0 || stations_.front().speed == 0)
        refuse(cell(row, "speed")->at, "every station needs its speed, other than 0");
      s.ratio = std::abs(s.speed / stations_.front().speed);
    } else if (columns_.count("speed") && !again) {
      refuse(row[columns_.at("speed").place].at, fmt::format("station {} has no speed", in_quotes(s.said)));
    }
    for (const auto& [key, times] :
         {std::pair("inertia", 1.0), std::pair("GD2", 0.25), std::pair("referred inertia", 1 / (s.ratio * s.ratio))}) {
      if (!cell(row, key)) continue;
      if (!s.inertia.empty())
        refuse(cell(row, key)->at, fmt::format("station {} has its inertia twice", in_quotes(s.said)));
      s.inertia = quantity(row, key, times);
    }
  }

  void read_joints() {
    const bool list = columns_.count("to") > 0;
    const char* const key = columns_.count("stiffness") ? "stiffness" : "referred stiffness";
    for (std::size_t i = 0; i < rows_.size(); ++i) {
      const std::vector<TableCell>& row = rows_[i];
      const TableCell *stiffness = cell(row, key), *to = cell(row, "to");
      const bool leads = list ? to != nullptr : i + 1 < rows_.size();
      const Location at = stiffness ? stiffness->at : to ? to->at : row[columns_.at(key).place].at;
      if (leads && !stiffness)
        refuse(at, fmt::format("no stiffness between {} and the next station; write \"rigid\" where they are one piece",
                               in_quotes(cell(row, "station")->text)));
      if (!leads && stiffness && list) refuse(at, "a stiffness, and no station in the column \"to\"");
      if (!leads && stiffness)
        refuse(at,
               "a stiffness at the last station leads nowhere: a row's stiffness is that of the shaft to the next row");
      if (!leads) continue;
      Joint joint{.a = station_named(cell(row, "station")->text, at), .at = at};
      joint.b = station_named(to ? to->text : cell(rows_[i + 1], "station")->text, at);
      read_joint(row, key, joint);
      joints_.push_back(std::move(joint));
    }
  }
  void read_joint(const std::vector<TableCell>& row, const char* key, Joint& joint) const {
    const std::string& said = cell(row, key)->text;
    for (const char* word : {"rigid", "gear", "mesh", "inf", "∞"})
      joint.rigid = joint.rigid || equal_but_for_case(said, word);
    const Station &a = stations_[joint.a], &b = stations_[joint.b];
    if (joint.rigid) return;
    if (std::abs(a.ratio - b.ratio) > same_speed * a.ratio)
      refuse(joint.at, fmt::format("a shaft of {} between {} and {}, which turn at different speeds (ratios {:g} and "
                                   "{:g}): give the wheel and the pinion as two stations with \"gear\" between them",
                                   said, in_quotes(a.said), in_quotes(b.said), a.ratio, b.ratio));
    if (!(*number(row, key) > 0)) refuse(joint.at, fmt::format("stiffness = {}: must be > 0, or \"rigid\"", said));
    const bool referred = std::string_view(key) != "stiffness";
    joint.keys.emplace_back("stiffness", quantity(row, key, referred ? 1 / (a.ratio * a.ratio) : 1));
    for (const char* other : {"damping", "diameter", "bore"})
      if (cell(row, other)) joint.keys.emplace_back(other, quantity(row, other));
  }

  // Between two shafts there must be an inertia.
  void check_stations() const {
    if (stations_.size() < 2) refuse({1, 1}, "has fewer than two stations");
    for (std::size_t i = 0; i < stations_.size(); ++i) {
      const bool rigid = std::any_of(joints_.begin(), joints_.end(),
                                     [&](const Joint& j) { return j.rigid && (j.a == i || j.b == i); });
      if (!rigid && (stations_[i].inertia.empty() || stations_[i].inertia.starts_with("0 ")))
        refuse(stations_[i].at,
               fmt::format("station {} has no inertia; give it some, or make one shaft of those beside it",
                           in_quotes(stations_[i].said)));
    }
  }

  // Along the tree from the first station: the first joint of a station continues the line, the others begin branches.
  void write_lines() {
    std::vector<char> reached(stations_.size(), 0);
    std::deque<std::pair<std::size_t, Joint*>> branches = {{0, nullptr}};
    while (!branches.empty()) {
      auto [station, joint] = branches.front();
      branches.pop_front();
      std::vector<std::string> names;
      const std::string from = stations_[station].name;
      if (!joint) names.push_back(from), write_station(station), reached[station] = 1;
      while (true) {
        if (joint) {
          const std::size_t next = joint->a == station ? joint->b : joint->a;
          if (reached[next])
            refuse(joint->at, fmt::format("closes a loop between {} and {}; a sheet's train is a tree",
                                          in_quotes(stations_[station].said), in_quotes(stations_[next].said)));
          write_joint(*joint, station, next, names);
          station = next, reached[station] = 1;
          names.push_back(stations_[station].name), write_station(station);
        }
        joint = nullptr;
        for (Joint& other : joints_) {
          if (other.written || (other.a != station && other.b != station)) continue;
          other.written = true;
          if (joint)
            branches.emplace_back(station, &other);
          else
            joint = &other;
        }
        if (!joint) break;
      }
      std::string list;
      for (const std::string& name : names) list += fmt::format("{}\"{}\"", list.empty() ? "" : ", ", name);
      lines_.push_back(lines_.empty() ? list : fmt::format("\n[[branch]]\nfrom = \"{}\"\nline = [{}]\n", from, list));
    }
    for (std::size_t i = 0; i < stations_.size(); ++i)
      if (!reached[i])
        refuse(stations_[i].at, fmt::format("nothing joins station {} to the train", in_quotes(stations_[i].said)));
  }
  void write_station(std::size_t i) {
    const Station& s = stations_[i];
    tables_ += fmt::format("\n[{}]\nkind = \"inertia\"\ninertia = \"{}\"\n", s.name,
                           s.inertia.empty() ? "0 kg*m2" : s.inertia);
  }
  void write_joint(const Joint& joint, std::size_t from, std::size_t to, std::vector<std::string>& names) {
    const Station &a = stations_[from], &b = stations_[to];
    const bool gear = std::abs(a.ratio - b.ratio) > same_speed * a.ratio;
    if (joint.rigid && !gear) return;
    std::string name = a.name + "_" + b.name;
    while (std::any_of(stations_.begin(), stations_.end(), [&](const Station& s) { return s.name == name; }))
      name += "_";
    names.push_back(name);
    if (!joint.rigid) {
      tables_ += fmt::format("\n[{}]\nkind = \"shaft\"\n", name);
      const bool stiff =
          std::any_of(joint.keys.begin(), joint.keys.end(), [](const auto& k) { return k.first == "stiffness"; });
      for (const auto& [key, value] : joint.keys)
        if (stiff && (key == "diameter" || key == "bore"))
          tables_ +=
              fmt::format("# {} = \"{}\"  # for stresses: with a limit, e.g. allowable_shear_stress\n", key, value);
        else
          tables_ += fmt::format("{} = \"{}\"\n", key, value);
      return;
    }
    const auto [driving, driven] = teeth_of(b.ratio / a.ratio);
    if (!(driving >= 1 && driven >= 1))
      refuse(joint.at,
             fmt::format("the speeds of {} and {} have the ratio {:.3g}: no two wheels of up to {:.0f} teeth have it",
                         in_quotes(a.said), in_quotes(b.said), b.ratio / a.ratio, most_teeth));
    tables_ += fmt::format(
        "\n[{}]  # its teeth stand for the speeds of the sheet, {:g} to {:g}\nkind = \"gearbox\"\n"
        "stages = [{{ teeth = [{:.0f}, {:.0f}] }}]\n",
        name, a.ratio, b.ratio, driving, driven);
  }

  std::string path_;
  TableFile file_;
  std::map<std::string, Column> columns_;
  std::vector<std::vector<TableCell>> rows_;
  std::vector<Station> stations_;
  std::vector<Joint> joints_;
  std::vector<std::string> lines_;  // the first one's names, then the text of each branch
  std::string tables_;
};

}  // namespace

std::string scene_of_sheet(const std::string& path) { return Sheet(path).scene(); }

}  // namespace kurbel
