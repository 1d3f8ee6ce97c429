// variant_text.cpp — finds the places of quantities by the document, and changes the text there.
#include "tests/coverage/variant_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>

#include "engine/scene/text.h"
#include "engine/scene/units.h"

namespace kurbel::coverage {
namespace {

using Type = DocumentValue::Type;

constexpr double least = 0.7, most = 1.4;

struct Edit {
  Location at;
  std::size_t length;  // of what stood there
  std::string text;
};

// A number with its unit apart: "1500 rpm" → 1500, " rpm".
struct Literal {
  double number;
  std::string unit;
};
std::optional<Literal> literal_of(const std::string& text) {
  UnitError error;
  if (!parse_quantity(text, error)) return {};
  std::size_t length = 0;
  const double number = std::stod(text, &length);
  return Literal{number, text.substr(length)};
}

Dimension dimension_of(const char* unit) {
  UnitError error;
  return parse_unit(unit, error).value_or(Unit{}).dimension;
}

class Mover {
 public:
  explicit Mover(Dice& dice) : dice_(dice), speed_(dice.factor(least, most)) {}

  std::vector<Edit> edits(const DocumentValue& document) {
    for (const DocumentEntry& entry : document.entries) {
      if (entry.value.type != Type::table || entry.key == "effects" || entry.key == "run") continue;
      length_ = dice_.factor(least, most);
      if (entry.key == "sequence") {
        times(entry.value);
      } else {
        move_table(entry.value);
      }
    }
    return std::move(edits_);
  }

 private:
  void move_table(const DocumentValue& table) {
    if (table.find("points")) return move_points(table);
    for (const DocumentEntry& entry : table.entries)
      if (!fixed().count(entry.key)) move(entry.value);
  }
  // Periods belong to the machine, and a number of modes, teeth or starts is none to move.
  static const std::set<std::string>& fixed() {
    static const std::set<std::string> keys = {"period", "modes", "kind", "on", "file", "unit", "samples", "acts"};
    return keys;
  }
  void move(const DocumentValue& value) {
    if (value.type == Type::table) {
      move_table(value);
    } else if (value.type == Type::list) {
      for (const DocumentValue& item : value.items) move(item);
    } else if (value.type == Type::text) {
      if (const auto literal = literal_of(value.text))
        put_text(value, *literal, factor_of(value.text, literal->number));
    } else if (value.type == Type::number) {
      put_number(value, moved_ratio(value.number));
    }
  }
  double factor_of(const std::string& text, double number) {
    static const Dimension length = dimension_of("m"), speed = dimension_of("rad/s"), plain{};
    UnitError error;
    const Dimension dimension = parse_quantity(text, error)->dimension;
    if (dimension == plain) return number == 0 ? 1 : dice_.factor(0.85, 1.15);
    if (dimension == length) return length_ * dice_.factor(0.95, 1.05);
    if (dimension == speed) return speed_ * dice_.factor(0.997, 1.003);
    return dice_.factor(least, most);
  }
  // What lies near below one is an efficiency: its loss is moved.
  double moved_ratio(double value) {
    const double factor = dice_.factor(0.8, 1.25);
    return value > 0.5 && value < 1 ? 1 - (1 - value) * factor : value * factor;
  }
  // A characteristic: what it gives by one factor, speeds with all speeds.
  void move_points(const DocumentValue& table) {
    const DocumentEntry* unit = table.find("unit");
    const bool over_speed = unit && !unit->value.items.empty() &&
                            (unit->value.items[0].text == "rpm" || unit->value.items[0].text == "rad/s");
    const double factor = dice_.factor(least, most);
    for (const DocumentValue& point : table.find("points")->value.items)
      for (std::size_t k = 0; k < point.items.size(); ++k) {
        const double by = k > 0 ? factor : over_speed ? speed_ : 1;
        if (by != 1) put_number(point.items[k], by * point.items[k].number);
      }
  }
  // Of an operating sequence the times, and the speeds that it waits for.
  void times(const DocumentValue& value) {
    if (value.type == Type::text) {
      const auto literal = literal_of(value.text);
      if (literal && !literal->unit.empty()) put_text(value, *literal, factor_of(value.text, literal->number));
    }
    for (const DocumentValue& item : value.items) times(item);
    for (const DocumentEntry& entry : value.entries) times(entry.value);
  }
  void put_text(const DocumentValue& value, const Literal& literal, double factor) {
    if (literal.number == 0 || factor == 1) return;
    edits_.push_back(
        {value.at, value.text.size() + 2, fmt::format("\"{:.6g}{}\"", literal.number * factor, literal.unit)});
  }
  void put_number(const DocumentValue& value, double number) {
    if (number != 0) edits_.push_back({value.at, 0, fmt::format("{:#.6g}", number)});
  }

  Dice& dice_;
  double speed_, length_ = 1;
  std::vector<Edit> edits_;
};

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    lines.push_back(text.substr(begin, end - begin));
    begin = end + 1;
  }
  return lines;
}

// Columns count characters.
std::size_t byte_of(const std::string& line, int column) {
  std::size_t i = 0;
  for (int seen = 0; i < line.size(); ++i)
    if (begins_character(line[i]) && ++seen == column) break;
  return i;
}

std::string without_comment(const std::string& line) {
  bool quoted = false;
  for (std::size_t i = 0; i < line.size(); ++i) {
    if (line[i] == '"') quoted = !quoted;
    if (line[i] == '#' && !quoted) return line.substr(0, line.find_last_not_of(" \t", i ? i - 1 : 0) + (i ? 1 : 0));
  }
  return line;
}

}  // namespace

double Dice::factor(double least_factor, double most_factor) {
  return std::exp(between(std::log(least_factor), std::log(most_factor)));
}

std::string moved_text(const std::string& text, const std::string& file, Dice& dice) {
  std::vector<std::string> lines = lines_of(text);
  std::vector<Edit> edits = Mover(dice).edits(parse_toml(text, file));
  std::sort(edits.begin(), edits.end(), [](const Edit& a, const Edit& b) { return b.at < a.at; });
  for (const Edit& edit : edits) {
    std::string& line = lines[static_cast<std::size_t>(edit.at.line - 1)];
    const std::size_t begin = byte_of(line, edit.at.column);
    const std::size_t length = edit.length > 0
                                   ? edit.length
                                   : std::min(line.find_first_not_of("0123456789.+-eE_", begin), line.size()) - begin;
    line.replace(begin, length, edit.text);
  }
  std::string moved;
  bool dropped = false;
  for (const std::string& whole : lines) {
    const std::string line = without_comment(whole);  // comments speak of other numbers
    if (line.starts_with('[')) dropped = line == "[effects]" || line == "[run]";
    if (!dropped && line.find_first_not_of(" \t\r") != std::string::npos) moved += line + "\n";
  }
  return moved;
}

}  // namespace kurbel::coverage
