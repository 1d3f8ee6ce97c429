// mat_text.cpp — elements of a MAT file, its arrays, Modelica's layout of results.
#include "engine/tables/mat_text.h"

#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstring>
#include <string_view>
#include <vector>

#include "engine/base/find_by.h"
#include "engine/scene/keys.h"
#include "engine/scene/messages.h"

namespace kurbel {
namespace {

// Of elements, and of arrays.
constexpr std::uint32_t of_matrix = 14, compressed = 15;
constexpr std::uint32_t of_letters = 4, first_number = 6, last_number = 15, opaque = 17;

struct Element {
  std::uint32_t type = 0;
  std::string_view data;
};

struct Array {
  std::string name;
  bool is_text = false;
  std::size_t rows = 0, columns = 0;
  std::vector<double> values;  // column by column
  double at(std::size_t row, std::size_t column) const { return values[column * rows + row]; }
};

struct Column {
  std::string heading;
  std::vector<double> values;
};

class MatFile {
 public:
  MatFile(std::string_view bytes, const std::string& path, std::size_t limit) : path_(path), left_(limit) {
    constexpr std::size_t header = 128, version_at = 124;
    const std::string_view version = bytes.size() < header ? "" : bytes.substr(version_at, 4);
    swapped_ = version.ends_with("MI");
    const int number = version.empty() ? 0 : version[swapped_ ? 0 : 1];
    if (number == 2)
      refuse("is a MAT file of version 7.3 (HDF5), which is not read; save it anew: save('file.mat', '-v7')");
    if (number != 1 || !(swapped_ || version.ends_with("IM")))
      refuse("is no MAT file of version 5, or a truncated one; save it anew: save('file.mat', '-v7'), or as .csv");
    for (std::string_view rest = bytes.substr(header); !rest.empty();) add(next(rest));
  }

  std::string text(const std::string& wanted, std::size_t limit) const {
    const std::vector<Column> columns = array("Aclass") && array("dataInfo") ? results() : columns_of(wanted);
    if (columns.empty())
      refuse(fmt::format("has no {}; it has {}; save the columns of the table as vectors of numbers",
                         wanted.empty() ? "vector or matrix of numbers" : "variable of numbers " + in_quotes(wanted),
                         all_.empty() ? "no variable" : shortened_list(all_, "and")));
    std::string text;
    std::size_t rows = 0;
    for (const Column& c : columns)
      text += (text.empty() ? "" : "\t") + c.heading, rows = std::max(rows, c.values.size());
    for (std::size_t i = 0; i < rows; ++i)
      for (std::size_t k = 0; k < columns.size(); ++k) {
        text += k == 0 ? '\n' : '\t';
        if (i < columns[k].values.size()) fmt::format_to(std::back_inserter(text), "{}", columns[k].values[i]);
        if (text.size() > limit)
          refuse(fmt::format("holds more than {} MB of cells; save the part that is needed", limit / 1'000'000));
      }
    return text;
  }

 private:
  [[noreturn]] void refuse(const std::string& why) const { throw SceneError({{path_, {}, why}}); }
  [[noreturn]] void refuse_damaged() const {
    refuse(fmt::format("is damaged or truncated {}; save it anew",
                       all_.empty() ? "before its first variable" : "behind its variable " + in_quotes(all_.back())));
  }

  template <class T>
  T value(std::string_view bytes, std::size_t index) const {
    char part[sizeof(T)];
    std::memcpy(part, bytes.data() + index * sizeof(T), sizeof(T));
    if (swapped_) std::reverse(part, part + sizeof(T));
    return std::bit_cast<T>(part);
  }

  // Up to four bytes stand in the tag itself. All but compressed ones are filled up to eight bytes.
  Element next(std::string_view& rest) const {
    if (rest.size() < 8) refuse_damaged();
    const auto first = value<std::uint32_t>(rest, 0);
    const bool is_small = first >> 16 != 0;
    const std::size_t begin = is_small ? 4 : 8, size = is_small ? first >> 16 : value<std::uint32_t>(rest, 1);
    const Element found{first & 0xFFFF, rest.substr(begin, size)};
    if (found.data.size() < size || (is_small && size > 4)) refuse_damaged();
    const std::size_t whole = is_small ? 8 : begin + (found.type == compressed ? size : (size + 7) / 8 * 8);
    rest.remove_prefix(std::min(whole, rest.size()));
    return found;
  }

  void add(const Element& element) {
    if (element.type == compressed) {
      const std::string unpacked = inflated(element.data);
      std::string_view rest = unpacked;
      if (const Element inner = next(rest); inner.type == of_matrix) add_array(inner.data);
    } else if (element.type == of_matrix) {
      add_array(element.data);
    }
  }

  std::string inflated(std::string_view packed) {
    z_stream stream{};
    if (inflateInit(&stream) != Z_OK) refuse_damaged();
    stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(packed.data()));
    stream.avail_in = static_cast<uInt>(packed.size());
    std::string bytes;
    char piece[1 << 16];
    int status = Z_OK;
    while (status == Z_OK && bytes.size() <= left_) {
      stream.next_out = reinterpret_cast<Bytef*>(piece), stream.avail_out = sizeof piece;
      status = inflate(&stream, Z_NO_FLUSH);
      bytes.append(piece, sizeof piece - stream.avail_out);
    }
    inflateEnd(&stream);
    if (bytes.size() > left_) refuse("unpacks to more than 64 MB; save the variables that are needed");
    if (status != Z_STREAM_END) refuse_damaged();
    left_ -= bytes.size();
    return bytes;
  }

  void add_array(std::string_view rest) {
    const Element flags = next(rest);
    if (flags.data.size() < 4) refuse_damaged();
    const auto about = value<std::uint32_t>(flags.data, 0), kind = about & 0xFF;
    const Element extent = kind == opaque ? Element{} : next(rest), name = next(rest);
    Array made;
    made.name = name.data.substr(0, name.data.find('\0')), made.is_text = kind == of_letters;
    if (made.name.empty()) return;  // what belongs to objects
    if (extent.data.size() == 8 && ((kind >= first_number && kind <= last_number) || made.is_text)) {
      constexpr std::uint32_t complex = 0x0800;
      if (about & complex)
        refuse(fmt::format("its variable {} is complex; save real and imaginary parts as variables of their own",
                           in_quotes(made.name)));
      made.rows = value<std::uint32_t>(extent.data, 0), made.columns = value<std::uint32_t>(extent.data, 1);
      made.values = numbers(next(rest));
      if (made.rows > most || made.columns > most || made.rows * made.columns != made.values.size()) refuse_damaged();
      arrays_.push_back(made);
    }
    all_.push_back(made.name);
  }

  template <class T>
  std::vector<double> numbers_as(std::string_view data) const {
    std::vector<double> values(data.size() / sizeof(T));
    for (std::size_t i = 0; i < values.size(); ++i) values[i] = static_cast<double>(value<T>(data, i));
    return values;
  }
  // As they are stored, which may be shorter than the variable's class.
  std::vector<double> numbers(const Element& e) const {
    switch (e.type) {
      case 1:
        return numbers_as<std::int8_t>(e.data);
      case 2:
      case 16:
        return numbers_as<std::uint8_t>(e.data);
      case 3:
        return numbers_as<std::int16_t>(e.data);
      case 4:
      case 17:
        return numbers_as<std::uint16_t>(e.data);
      case 5:
        return numbers_as<std::int32_t>(e.data);
      case 6:
      case 18:
        return numbers_as<std::uint32_t>(e.data);
      case 7:
        return numbers_as<float>(e.data);
      case 9:
        return numbers_as<double>(e.data);
      case 12:
        return numbers_as<std::int64_t>(e.data);
      case 13:
        return numbers_as<std::uint64_t>(e.data);
      default:
        refuse_damaged();
    }
  }

  const Array* array(const std::string& name) const { return find_by(arrays_, &Array::name, name); }

  std::vector<Column> columns_of(const std::string& wanted) const {
    std::vector<Column> list;
    for (const Array& a : arrays_) {
      if (a.is_text || a.values.size() < 2 || (!wanted.empty() && a.name != wanted)) continue;
      if (a.rows == 1 || a.columns == 1)
        list.push_back({a.name, a.values});
      else
        for (std::size_t k = 0; k < a.columns; ++k) {
          const auto begin = a.values.begin() + static_cast<std::ptrdiff_t>(k * a.rows);
          list.push_back({fmt::format("{}_{}", a.name, k + 1), {begin, begin + static_cast<std::ptrdiff_t>(a.rows)}});
        }
    }
    return list;
  }

  // Of a row of letters, or a column of them.
  static std::string words(const Array& a, std::size_t index, bool is_column) {
    std::string text;
    for (std::size_t i = 0; i < (is_column ? a.rows : a.columns); ++i) {
      const double letter = is_column ? a.at(i, index) : a.at(index, i);
      text += letter > 31 && letter < 127 ? static_cast<char>(letter) : letter > 0 ? '?' : ' ';
    }
    text.erase(text.find_last_not_of(' ') + 1);
    return text;
  }

  // Quantities of matrix 2, and the abscissa: what dataInfo says of matrix, row and sign. "torque [N.m]": unit [N*m].
  std::vector<Column> results() const {
    const Array &about = *array("Aclass"), &info = *array("dataInfo");
    const Array *names = array("name"), *said = array("description"), *data = array("data_2");
    const bool turned = about.rows > 3 && words(about, 3, false) == "binTrans";
    const std::size_t count = turned ? info.columns : info.rows;
    if (!names || !data || (turned ? info.rows : info.columns) < 2 ||
        (turned ? names->columns : names->rows) != count || (said && (turned ? said->columns : said->rows) != count))
      refuse("lacks parts of Modelica's layout of results (name, description, dataInfo, data_2); save it anew");
    std::vector<Column> list;
    for (std::size_t k = 0; k < count; ++k) {
      const double of = turned ? info.at(0, k) : info.at(k, 0), place = turned ? info.at(1, k) : info.at(k, 1);
      if (of != 0 && of != 2) continue;
      const auto row = static_cast<std::size_t>(std::abs(place)) - 1;
      if (!(std::abs(place) >= 1) || row >= (turned ? data->rows : data->columns)) refuse_damaged();
      Column& made = list.emplace_back(Column{words(*names, k, turned), {}});
      std::string unit = said ? words(*said, k, turned) : "";
      const std::size_t open = unit.rfind('[');
      if (open != std::string::npos && unit.ends_with(']')) {
        std::replace(unit.begin(), unit.end(), '.', '*');
        made.heading += " " + unit.substr(open);
      }
      for (std::size_t i = 0; i < (turned ? data->columns : data->rows); ++i)
        made.values.push_back((place < 0 ? -1 : 1) * (turned ? data->at(row, i) : data->at(i, row)));
    }
    return list;
  }

  static constexpr std::size_t most = 1'000'000'000;
  const std::string& path_;
  std::size_t left_;  // that may yet be unpacked
  bool swapped_ = false;
  std::vector<std::string> all_;  // names of all variables
  std::vector<Array> arrays_;
};

}  // namespace

std::string mat_as_text(const std::string& bytes, const std::string& variable, const std::string& path,
                        std::size_t limit) {
  return MatFile(bytes, path, limit).text(variable, limit);
}

}  // namespace kurbel
