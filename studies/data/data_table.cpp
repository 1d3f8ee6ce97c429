// data_table.cpp — the text of tables and of their numbers.
#include "studies/data/data_table.h"

#include <fmt/compile.h>
#include <fmt/format.h>

#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <iterator>

#include "studies/data/number_text.h"

namespace kurbel {
namespace {

void put_number(std::string& text, double value, const NumberFormat& format) {
  if (format.after_point) {
    const std::size_t begin = text.size();
    fmt::format_to(std::back_inserter(text), "{:.{}f}", value, format.digits);
    if (value < 0 && text.find_first_of("123456789i", begin) == std::string::npos) text.erase(begin, 1);  // no −0
  } else if (format.digits > 0) {
    append_digits(text, value, format.digits);
  } else {
    char place[32];  // the longest has 24
    text.append(place, static_cast<std::size_t>(fmt::format_to(place, FMT_COMPILE("{}"), value) - place));
  }
}

// The numbers of a table as text. The same one often comes twice, as the torque of a joint and of its neighbour: the text
// of each is kept until another one takes its place.
class NumbersAsText {
 public:
  explicit NumbersAsText(std::string& text) : text_(text) {}
  void put(double value, const NumberFormat& format) {
    value += 0.0;  // no −0
    const auto bits = std::bit_cast<std::uint64_t>(value);
    Known& known = known_[bits * 0x9E3779B97F4A7C15 >> 54];
    if (known.count > 0 && known.bits == bits && known.digits == format.digits &&
        known.after_point == format.after_point)
      return void(text_.append(text_, known.begin, known.count));
    known = {bits, text_.size(), 0, format.digits, format.after_point};
    put_number(text_, value, format);
    known.count = text_.size() - known.begin;
  }

 private:
  struct Known {
    std::uint64_t bits = 0;
    std::size_t begin = 0, count = 0;  // its place in the text
    int digits = 0;
    bool after_point = false;
  };
  std::string& text_;
  std::array<Known, 1024> known_ = {};
};

// Text with a comma, a quotation mark or a line end is quoted, inner quotation marks are doubled (RFC 4180).
void put_words(std::string& text, const std::string& words) {
  if (words.find_first_of(",\"\n") == std::string::npos) return void(text += words);
  text += '"';
  for (const char c : words) text += c == '"' ? std::string("\"\"") : std::string(1, c);
  text += '"';
}

}  // namespace

std::string heading_of(const std::string& name, const std::optional<std::string>& unit) {
  return unit ? fmt::format("{} [{}]", name, *unit) : name;
}

double as_written(double value, const NumberFormat& format) {
  if (!std::isfinite(value) || (format.digits == 0 && !format.after_point)) return value + 0.0;  // no −0
  std::string digits;
  put_number(digits, value, format);
  std::from_chars(digits.data(), digits.data() + digits.size(), value);
  return value + 0.0;
}

std::string csv_text(const DataTable& table) {
  std::string text = table.remark.empty() ? "" : "# " + table.remark + "\n";
  for (std::size_t k = 0; k < table.columns.size(); ++k)
    text += (k == 0 ? "" : ",") + heading_of(table.columns[k].name, table.columns[k].unit);
  text += '\n';
  NumbersAsText numbers(text);
  table.each_row([&](DataRow row) {
    for (std::size_t k = 0; k < row.size(); ++k) {
      if (const std::string* words = std::get_if<std::string>(&row[k]))
        put_words(text, *words);
      else if (const double number = std::get<double>(row[k]); !std::isnan(number))
        numbers.put(number, table.columns[k].format);
      text += k + 1 < row.size() ? ',' : '\n';
    }
  });
  return text;
}

}  // namespace kurbel
