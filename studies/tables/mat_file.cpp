// mat_file.cpp — arrays of MAT files of version 5, uncompressed, by their specification.
#include "studies/tables/mat_file.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <set>
#include <span>
#include <string_view>

#include "studies/dictionary/dictionary.h"

namespace kurbel {
namespace {

// Of the specification "MAT-File Format": storage types of numbers, and classes of arrays.
enum class Stored : std::uint32_t { int8 = 1, int32 = 5, uint32 = 6, number = 9, matrix = 14, utf16 = 17 };
enum class ArrayOf : std::uint32_t { letters = 4, numbers = 6, int32 = 12 };

static_assert(std::endian::native == std::endian::little, "files are written as numbers lie in memory");

template <class T>
void append(std::string& file, std::span<const T> values) {
  file.append(reinterpret_cast<const char*>(values.data()), values.size_bytes());
}

void append_tag(std::string& file, Stored type, std::size_t bytes) {
  append<std::uint32_t>(file, std::array{static_cast<std::uint32_t>(type), static_cast<std::uint32_t>(bytes)});
}

// Padded to multiples of eight bytes.
std::size_t filled_up(std::size_t bytes) { return (bytes + 7) / 8 * 8; }

template <class T>
void append_element(std::string& file, Stored type, std::span<const T> values) {
  append_tag(file, type, values.size_bytes());
  append(file, values);
  file.append(filled_up(values.size_bytes()) - values.size_bytes(), '\0');
}

// Column by column, as in MAT files.
template <class T>
void write(std::string& file, std::string_view name, ArrayOf kind, Stored type, std::size_t rows, std::size_t columns,
           const std::vector<T>& values) {
  constexpr std::size_t tag = 8, of_kind = 8, of_extent = 8;
  append_tag(file, Stored::matrix,
             4 * tag + of_kind + of_extent + filled_up(name.size()) + filled_up(values.size() * sizeof(T)));
  append_element<std::uint32_t>(file, Stored::uint32, std::array{static_cast<std::uint32_t>(kind), 0U});
  append_element<std::int32_t>(file, Stored::int32,
                               std::array{static_cast<std::int32_t>(rows), static_cast<std::int32_t>(columns)});
  append_element(file, Stored::int8, std::span(name));
  append_element(file, type, std::span(values));
}

// UTF-8 as the 16-bit characters of MAT files; others become a question mark.
std::u16string letters_of(const std::string& text) {
  std::u16string letters;
  for (std::size_t i = 0; i < text.size();) {
    const auto byte = [&](std::size_t k) { return k < text.size() ? static_cast<unsigned char>(text[k]) : 0U; };
    const unsigned first = byte(i);
    const std::size_t length = first < 0x80 ? 1 : first < 0xE0 ? 2 : first < 0xF0 ? 3 : 4;
    unsigned letter = first;
    if (length == 2) letter = (first & 0x1FU) << 6 | (byte(i + 1) & 0x3FU);
    if (length == 3) letter = (first & 0x0FU) << 12 | (byte(i + 1) & 0x3FU) << 6 | (byte(i + 2) & 0x3FU);
    letters += length == 4 ? u'?' : static_cast<char16_t>(letter);
    i += length;
  }
  return letters;
}

// Texts of one width, padded with blanks: each a column, or each a row.
void write_texts(std::string& file, std::string_view name, const std::vector<std::string>& texts, bool as_columns) {
  std::vector<std::u16string> all;
  std::size_t width = 1;
  for (const std::string& text : texts) width = std::max(width, all.emplace_back(letters_of(text)).size());
  std::vector<std::uint16_t> letters(width * texts.size(), u' ');
  for (std::size_t i = 0; i < all.size(); ++i)
    for (std::size_t k = 0; k < all[i].size(); ++k)
      letters[as_columns ? i * width + k : k * texts.size() + i] = static_cast<std::uint16_t>(all[i][k]);
  write(file, name, ArrayOf::letters, Stored::utf16, as_columns ? width : texts.size(),
        as_columns ? texts.size() : width, letters);
}

// Modelica multiplies units with a point: "kg.m2".
std::string described(std::string words, std::string unit) {
  std::replace(unit.begin(), unit.end(), '*', '.');
  return unit.empty() ? words : words + (words.empty() ? "[" : " [") + unit + "]";
}

std::string described(const DataColumn& column) {
  const Definition* definition = definition_of(column.name);
  return described(definition ? std::string(definition->words) : "", column.unit.value_or(""));
}

// Indices of its columns of numbers.
std::vector<std::size_t> numbers_in(const DataTable& table) {
  std::vector<std::size_t> places;
  for (std::size_t k = 0; k < table.columns.size(); ++k)
    if (!table.columns[k].words) places.push_back(k);
  return places;
}

// Row by row; false: more than a matrix can hold.
bool collect(const DataTable& table, const std::vector<std::size_t>& places, std::vector<double>& data) {
  constexpr std::size_t most_bytes = 2'000'000'000;
  bool fits = true;
  table.each_row([&](DataRow row) {
    fits = fits && (data.size() + places.size()) * sizeof(double) < most_bytes;
    for (std::size_t i = 0; fits && i < places.size(); ++i)
      data.push_back(as_written(std::get<double>(row[places[i]]), table.columns[places[i]].format));
  });
  return fits;
}

// Lists describing the matrices.
struct Contents {
  std::vector<std::string> names, descriptions;
  std::vector<std::int32_t> info;  // four a name

  void add(const std::string& name, const std::string& description, std::int32_t matrix, std::size_t row,
           std::int32_t beyond) {
    names.push_back(name), descriptions.push_back(description);
    info.insert(info.end(), {matrix, static_cast<std::int32_t>(row), 0, beyond});
  }
};

}  // namespace

std::optional<std::string> mat_file(const DataTable& table, const std::vector<MatConstant>& constants) {
  constexpr std::int32_t unknown_beyond = -1, constant_beyond = 0;
  const std::vector<std::size_t> places = numbers_in(table);
  if (places.empty()) return "";
  std::vector<double> data;
  if (!collect(table, places, data)) return {};
  const std::size_t rows = data.size() / places.size();
  const DataColumn& abscissa = table.columns[places.front()];
  Contents contents;
  std::set<std::string> known;
  // The abscissa of the others.
  contents.add(abscissa.name, described(abscissa), 0, 1, unknown_beyond);
  known.insert(abscissa.name);
  // Constants, at both ends.
  std::vector<double> at_ends[2];
  for (const bool end : {false, true})
    at_ends[end].push_back(rows == 0 ? 0 : end ? data[data.size() - places.size()] : data.front());
  for (const std::size_t k : places) known.insert(table.columns[k].name);
  for (const MatConstant& c : constants) {
    if (!known.insert(c.name).second) continue;
    for (std::vector<double>& values : at_ends) values.push_back(c.value);
    contents.add(c.name, described(c.words, c.unit), 1, at_ends[0].size(), constant_beyond);
  }
  // Quantities.
  for (std::size_t k = 1; k < places.size(); ++k) {
    const DataColumn& column = table.columns[places[k]];
    contents.add(column.name, described(column), 2, k + 1, unknown_beyond);
  }

  std::string file = "MATLAB 5.0 MAT-file, by kurbel: Modelica's layout of results";
  file.resize(116, ' ');                           // words about it
  file.append(8, '\0') += {'\0', '\1', 'I', 'M'};  // no data of a subsystem; version 0x0100, little-endian
  write_texts(file, "Aclass", {"Atrajectory", "1.1", table.remark, "binTrans"}, false);
  write_texts(file, "name", contents.names, true);
  write_texts(file, "description", contents.descriptions, true);
  write(file, "dataInfo", ArrayOf::int32, Stored::int32, 4, contents.names.size(), contents.info);
  at_ends[0].insert(at_ends[0].end(), at_ends[1].begin(), at_ends[1].end());
  write(file, "data_1", ArrayOf::numbers, Stored::number, at_ends[1].size(), 2, at_ends[0]);
  write(file, "data_2", ArrayOf::numbers, Stored::number, places.size(), rows, data);
  return file;
}

}  // namespace kurbel
