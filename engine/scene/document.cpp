// document.cpp — the one source that includes toml++.
#include "engine/scene/document.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#ifndef KURBEL_FMI_RUNTIME
#include <toml++/toml.h>
#endif

#include <algorithm>
#include <cerrno>
#include <system_error>

#include "engine/base/find_by.h"
#include "engine/scene/text.h"

namespace kurbel {
#ifndef KURBEL_FMI_RUNTIME  // what runs an exported component has its scene as a document already
namespace {

Location location(const toml::source_position& place) {
  return {static_cast<int>(place.line), static_cast<int>(place.column)};
}
Location location(const toml::source_region& region) { return location(region.begin); }

constexpr int most_nested = 64;  // toml++ stops at 256 braces, but not at tables by dots

DocumentValue convert(const toml::node& node, const std::string& file, int depth = 0) {
  if (depth > most_nested)
    throw SceneError(
        {{file, location(node.source()), fmt::format("values are nested more than {} deep", most_nested)}});
  DocumentValue value;
  value.at = location(node.source());
  value.end = location(node.source().end);
  using Type = DocumentValue::Type;
  if (const auto* table = node.as_table()) {
    value.type = Type::table;
    for (const auto& [key, child] : *table)
      value.entries.push_back({std::string(key.str()), location(key.source()), convert(child, file, depth + 1)});
    std::sort(value.entries.begin(), value.entries.end(),
              [](const DocumentEntry& a, const DocumentEntry& b) { return a.at < b.at; });
  } else if (const auto* array = node.as_array()) {
    value.type = Type::list;
    for (const toml::node& item : *array) value.items.push_back(convert(item, file, depth + 1));
  } else if (const auto* text = node.as_string()) {
    value.type = Type::text;
    value.text = text->get();
  } else if (const auto* integer = node.as_integer()) {
    value.type = Type::integer;
    value.integer = integer->get();
    value.number = static_cast<double>(value.integer);
  } else if (const auto* number = node.as_floating_point()) {
    value.type = Type::number;
    value.number = number->get();
  } else if (const auto* flag = node.as_boolean()) {
    value.type = Type::flag;
    value.flag = flag->get();
  } else {
    value.type = Type::other;  // dates and times
  }
  return value;
}

}  // namespace
#endif

const DocumentEntry* DocumentValue::find(std::string_view key) const {
  return find_by(entries, &DocumentEntry::key, key);
}

std::string DocumentValue::describe() const {
  switch (type) {
    case Type::flag:
      return flag ? "true" : "false";
    case Type::integer:
      return fmt::format("{}", integer);
    case Type::number:
      return fmt::format("{}", number);
    case Type::text:
      return in_quotes(text);
    case Type::list:
      return "a list";
    case Type::table:
      return "a table";
    case Type::other:
      return "a date or time";
  }
  return "";
}

namespace {

// Opened without waiting: a pipe without a writer would keep the program for ever.
class OpenFile {
 public:
  explicit OpenFile(const std::string& path)
      : descriptor_(path.find('\0') == std::string::npos
                        ? open(path.c_str(), O_RDONLY | O_NONBLOCK | O_NOCTTY | O_CLOEXEC)
                        : (errno = ENOENT, -1)) {}
  ~OpenFile() {
    if (descriptor_ >= 0) close(descriptor_);
  }
  OpenFile(const OpenFile&) = delete;
  OpenFile& operator=(const OpenFile&) = delete;
  int descriptor() const { return descriptor_; }

 private:
  int descriptor_;
};

// Why a file cannot be read as a text, or nothing.
std::string why_unreadable(int descriptor) {
  if (descriptor < 0) {
    if (errno == ENOENT || errno == ENOTDIR) return "no such file; check the path, or list the folder with ls";
    if (errno == EACCES || errno == EPERM) return "cannot be opened for reading; check its permissions";
    if (errno == ENXIO) return "is a socket; give a regular file";
    return fmt::format("cannot be opened for reading: {}", std::generic_category().message(errno));
  }
  struct stat status {};
  if (fstat(descriptor, &status) != 0) return "cannot be read";
  if (S_ISDIR(status.st_mode)) return "is a folder; give a file inside it";
  if (!S_ISREG(status.st_mode))
    return fmt::format("is a {}; give a regular file", S_ISFIFO(status.st_mode) ? "pipe" : "device");
  return "";
}

}  // namespace

std::string read_text_file(const std::string& path, std::size_t limit) {
  const auto refuse = [&](const std::string& text) { throw SceneError({{path, {}, text}}); };
  const OpenFile file(path);
  if (const std::string why = why_unreadable(file.descriptor()); !why.empty()) refuse(why);
  // No more than the limit is held, whatever size the file is said to have or grows to.
  std::string text;
  char piece[1 << 16];
  for (ssize_t n; (n = read(file.descriptor(), piece, sizeof piece)) != 0;) {
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) refuse(fmt::format("cannot be read: {}", std::generic_category().message(errno)));
    text.append(piece, static_cast<std::size_t>(n));
    if (text.size() > limit)
      refuse(fmt::format("is larger than {} MB; put long tables into CSV files", limit / 1'000'000));
  }
  return text;
}

bool lies_below(const std::filesystem::path& folder, const std::filesystem::path& file) {
  if (file.native().find('\0') != std::string::npos) return true;  // names no file
  std::error_code error;
  const auto own = std::filesystem::canonical(folder.empty() ? "." : folder, error);
  if (error) return true;
  const auto real = std::filesystem::weakly_canonical(file, error);
  if (error) return true;
  return std::mismatch(own.begin(), own.end(), real.begin(), real.end()).first == own.end();
}

#ifndef KURBEL_FMI_RUNTIME
namespace {

// toml++ nests a table for every dot of a key, without limit, and meets characters outside of texts unprepared. Both
// are found before it reads: the place and the reason, or line 0.
Message unfit_for_toml(const std::string& text, const std::string& file) {
  constexpr int most_dots = 8;
  Location at{1, 0};  // of the character that is examined
  int dots = 0;
  std::string quote;
  const std::size_t byte_order_mark = text.starts_with("\xEF\xBB\xBF") ? 3 : 0;
  for (std::size_t i = byte_order_mark; i < text.size(); ++i) {
    const char c = text[i];
    if (begins_character(c)) ++at.column;
    if (c == '\n') at = {at.line + 1, 0};
    if (!quote.empty()) {
      const bool line_ends = c == '\n' && quote.size() == 1;
      if (c == '\\' && quote[0] == '"') {
        ++i, ++at.column;
        if (i < text.size() && text[i] == '\n') at = {at.line + 1, 0};
      } else if (line_ends || text.compare(i, quote.size(), quote) == 0) {
        i += quote.size() - 1, at.column += static_cast<int>(quote.size()) - 1;
        quote.clear();
      }
    } else if (c == '"' || c == '\'') {
      quote = text.compare(i, 3, std::string(3, c)) == 0 ? std::string(3, c) : std::string(1, c);
      i += quote.size() - 1, at.column += static_cast<int>(quote.size()) - 1;
    } else if (c == '#') {
      i = std::min(text.find('\n', i), text.size()) - 1;
    } else if (c == '.') {
      if (++dots > most_dots)
        return {file, at,
                fmt::format("a key with more than {} dots; no key of a scene needs more than two", most_dots)};
    } else if (static_cast<unsigned char>(c) >= 0x80) {
      const auto end =
          std::find_if(text.begin() + static_cast<std::ptrdiff_t>(i) + 1, text.end(), begins_character) - text.begin();
      at.column = std::max(at.column, 1);  // a line may begin with half a character
      return {file, at,
              fmt::format("not TOML: {} outside of quotes; texts and quantities with units stand in quotes",
                          static_cast<std::size_t>(end) - i == 1
                              ? "a byte that is no UTF-8"
                              : in_quotes(std::string_view(text).substr(i, static_cast<std::size_t>(end) - i)))};
    } else if (std::string_view("\n=,[]{}").find(c) != std::string_view::npos) {
      dots = 0;
    }
  }
  return {};
}

// toml++ counts on beyond the end of a text, which is where it stopped.
Location within(const std::string& text, Location at) {
  int lines = 1, columns = 0;  // up to `at`
  for (std::size_t i = 0; i < text.size() && lines <= at.line; ++i) {
    if (text[i] == '\n' && lines == at.line) break;
    if (text[i] == '\n')
      ++lines, columns = 0;
    else if (begins_character(text[i]))
      ++columns;
  }
  return {std::clamp(at.line, 1, lines), std::clamp(at.column, 1, columns + 1)};
}

std::string_view line_of(std::string_view text, std::size_t number) {
  for (; number > 1; --number) text.remove_prefix(std::min(text.find('\n'), text.size() - 1) + 1);
  return text.substr(0, text.find_first_of("\r\n"));
}

// What toml++ says, in one sentence that is ours where it is common.
std::string why_not_toml(std::string_view said, std::string_view line, int column) {
  if (said.find("unescaped control characters") != std::string_view::npos &&
      column > static_cast<int>(characters(line)))
    return "a text does not end on this line; its closing quote is missing";
  if (said.find("whitespace, saw ','") != std::string_view::npos)
    return "unexpected comma; decimals are written with a point";
  if (said.find("TOML_MAX_NESTED_VALUES") != std::string_view::npos)
    return fmt::format("values are nested more than {} deep", most_nested);
  if (const std::size_t name = said.find('\'');
      said.find("cannot redefine existing") != std::string_view::npos && name != std::string_view::npos)
    return fmt::format("{} stands twice; keep one", in_quotes(said.substr(name + 1, said.rfind('\'') - name - 1)));
  constexpr std::string_view while_parsing = "Error while parsing ";
  if (said.starts_with(while_parsing)) said.remove_prefix(while_parsing.size());
  const bool bare_text = said.find("could not determine value type") != std::string_view::npos ||
                         said.find("expected a comment or whitespace") != std::string_view::npos ||
                         said.find("expected decimal digit") != std::string_view::npos ||
                         said.find("expected digit") != std::string_view::npos;
  return std::string(said) + (bare_text ? "; texts and quantities with units stand in quotes" : "");
}

}  // namespace

DocumentValue parse_toml(const std::string& text, const std::string& file) {
  if (text.find_first_not_of(" \t\r\n") == std::string::npos)
    throw SceneError({{file, {1, 1}, "is empty; a scene needs at least `line` and the tables of its components"}});
  if (const std::size_t nul = text.find('\0'); nul != std::string::npos) {
    const auto line = std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(nul), '\n') + 1;
    const std::size_t begin = nul == 0 ? 0 : text.rfind('\n', nul) + 1;  // npos + 1 = 0
    throw SceneError({{file,
                       {static_cast<int>(line), static_cast<int>(nul - begin) + 1},
                       "holds a NUL byte; a scene is a text file in UTF-8"}});
  }
  if (const Message message = unfit_for_toml(text, file); message.at.line > 0) throw SceneError({message});
  try {
    return convert(toml::parse(text, file), file);
  } catch (const toml::parse_error& error) {
    throw SceneError(
        {{file, within(text, location(error.source())),
          fmt::format("not TOML: {}", why_not_toml(error.description(), line_of(text, error.source().begin.line),
                                                   static_cast<int>(error.source().begin.column)))}});
  }
}
#endif

}  // namespace kurbel
