// spreadsheet.cpp — the parts of the archive that hold a sheet's cells, and the words that they share.
#include "engine/tables/spreadsheet.h"

#include <fmt/format.h>
#include <zip.h>

#include <algorithm>
#include <charconv>
#include <memory>
#include <pugixml.hpp>
#include <vector>

#include "engine/scene/document.h"
#include "engine/scene/keys.h"
#include "engine/scene/messages.h"
#include "engine/tables/mat_text.h"
#include "engine/tables/table_text.h"

namespace kurbel {
namespace {

constexpr int most_rows = 1'048'576, most_columns = 16'384;  // of a sheet

class Workbook {
 public:
  Workbook(const std::string& bytes, const std::string& path, std::size_t limit) : path_(path), limit_(limit) {
    zip_error_t error;
    zip_error_init(&error);
    zip_source_t* source = zip_source_buffer_create(bytes.data(), bytes.size(), 0, &error);
    if (source) archive_.reset(zip_open_from_source(source, ZIP_RDONLY, &error));
    if (source && !archive_) zip_source_free(source);
    zip_error_fini(&error);
    if (!archive_) refuse("is a damaged archive, no .xlsx file; save it anew");
  }

  std::vector<std::string> names() const {
    const pugi::xml_document book = xml("xl/workbook.xml");
    std::vector<std::string> names;
    for (const pugi::xml_node sheet : book.document_element().child("sheets").children("sheet"))
      names.emplace_back(sheet.attribute("name").value());
    return names;
  }

  std::string text(const std::string& wanted) {
    const pugi::xml_document sheet = xml(part_of_sheet(wanted));
    if (has("xl/sharedStrings.xml")) {
      const pugi::xml_document shared = xml("xl/sharedStrings.xml");
      for (const pugi::xml_node item : shared.document_element().children("si")) words_.push_back(words_in(item));
    }
    std::string text;
    int row = 0;
    for (const pugi::xml_node line : sheet.document_element().child("sheetData").children("row")) {
      const int next = line.attribute("r").as_int(row + 1);
      if (next <= row || next > most_rows) refuse(fmt::format("row {} follows row {}; save the file anew", next, row));
      append(text, std::string(static_cast<std::size_t>(next - std::max(row, 1)), '\n'));
      row = next;
      add_row(line, row, text);
    }
    return text;
  }

 private:
  [[noreturn]] void refuse(const std::string& why) const { throw SceneError({{path_, {}, why}}); }

  void append(std::string& text, std::string_view more) const {
    if (text.size() + more.size() > limit_)
      refuse(fmt::format("holds more than {} MB of cells; save the part that is needed", limit_ / 1'000'000));
    text += more;
  }

  bool has(const std::string& name) const { return zip_name_locate(archive_.get(), name.c_str(), 0) >= 0; }

  // Read up to the limit, whatever the archive says of the size.
  std::string part(const std::string& name) const {
    const std::unique_ptr<zip_file_t, int (*)(zip_file_t*)> file(zip_fopen(archive_.get(), name.c_str(), 0),
                                                                 zip_fclose);
    if (!file)
      refuse(fmt::format("is an archive without {}: no .xlsx file; save it as .xlsx or .csv", in_quotes(name)));
    std::string bytes;
    char piece[1 << 16];
    for (zip_int64_t n; (n = zip_fread(file.get(), piece, sizeof piece)) != 0;) {
      if (n < 0) refuse(fmt::format("its part {} cannot be unpacked; save it anew", in_quotes(name)));
      bytes.append(piece, static_cast<std::size_t>(n));
      if (bytes.size() > limit_)
        refuse(fmt::format("its part {} unpacks to more than {} MB; save the sheet that is needed", in_quotes(name),
                           limit_ / 1'000'000));
    }
    return bytes;
  }
  pugi::xml_document xml(const std::string& name) const {
    pugi::xml_document document;
    const std::string bytes = part(name);
    // No blank is dropped, no entity of the file's own is known: nothing unfolds.
    if (!document.load_buffer(bytes.data(), bytes.size(), pugi::parse_default | pugi::parse_ws_pcdata_single))
      refuse(fmt::format("its part {} is no XML; save it anew", in_quotes(name)));
    return document;
  }

  std::string part_of_sheet(const std::string& wanted) const {
    const pugi::xml_document book = xml("xl/workbook.xml"), relations = xml("xl/_rels/workbook.xml.rels");
    std::vector<std::string> names;
    for (const pugi::xml_node sheet : book.document_element().child("sheets").children("sheet")) {
      names.emplace_back(sheet.attribute("name").value());
      if (!wanted.empty() && names.back() != wanted) continue;
      const std::string id = sheet.attribute("r:id").value();
      for (const pugi::xml_node one : relations.document_element().children("Relationship")) {
        if (id != one.attribute("Id").value()) continue;
        const std::string target = one.attribute("Target").value();
        return target.starts_with('/') ? target.substr(1) : "xl/" + target;
      }
      refuse(fmt::format("its sheet {} has no cells; save it anew", in_quotes(names.back())));
    }
    refuse(names.empty() ? "has no sheets"
                         : fmt::format("has no sheet {}{}; there are {}", in_quotes(wanted), suggestion(wanted, names),
                                       shortened_list(names, "and")));
  }

  // Of a cell or an entry of the shared words: what stands in it, formatted or not.
  static std::string words_in(const pugi::xml_node& node) {
    std::string words = node.child("t").text().get();
    for (const pugi::xml_node run : node.children("r")) words += run.child("t").text().get();
    return words;
  }

  std::string value_of(const pugi::xml_node& cell, int row, int column) const {
    const std::string_view type = cell.attribute("t").value();
    if (type == "inlineStr") return words_in(cell.child("is"));
    const std::string value = cell.child("v").text().get();
    if (type != "s") return value;
    std::size_t index = 0;
    const auto [end, status] = std::from_chars(value.data(), value.data() + value.size(), index);
    if (status != std::errc{} || end != value.data() + value.size() || index >= words_.size())
      refuse(fmt::format("cell {} names a text that the file does not hold; save it anew", cell_name(row, column)));
    return words_[index];
  }

  void add_row(const pugi::xml_node& line, int row, std::string& text) const {
    int at = 0;
    for (const pugi::xml_node cell : line.children("c")) {
      int column = 0;
      for (const char c : std::string_view(cell.attribute("r").value()))
        if (c >= 'A' && c <= 'Z' && column <= most_columns) column = 26 * column + (c - 'A' + 1);
      if (column == 0) column = at + 1;
      if (column <= at || column > most_columns)
        refuse(fmt::format("cells of row {} are out of order; save the file anew", row));
      append(text, std::string(static_cast<std::size_t>(column - std::max(at, 1)), '\t'));
      at = column;
      std::string value = value_of(cell, row, column);
      // A cell is one cell, and a row one line, whatever is written in it.
      for (char& c : value)
        if (c == '\t' || c == '\n' || c == '\r' || c == '\0' || c == '"') c = ' ';
      append(text, value);
    }
  }

  const std::string& path_;
  std::size_t limit_;
  std::unique_ptr<zip_t, void (*)(zip_t*)> archive_{nullptr, zip_discard};
  std::vector<std::string> words_;
};

}  // namespace

std::string sheet_as_text(const std::string& bytes, const std::string& sheet, const std::string& path,
                          std::size_t limit) {
  if (!is_archive(bytes)) return mat_as_text(bytes, sheet, path, limit);
  return Workbook(bytes, path, limit).text(sheet);
}

std::vector<std::string> sheet_names(const std::string& path) {
  if (!path.ends_with(".xlsx") && !path.ends_with(".xlsm")) return {};
  const std::string bytes = read_text_file(path, max_table_bytes);
  return is_archive(bytes) ? Workbook(bytes, path, max_table_bytes).names() : std::vector<std::string>{};
}

}  // namespace kurbel
