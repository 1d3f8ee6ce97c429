// json.cpp — the text of records.
#include <fmt/format.h>

#include <cmath>
#include <cstring>
#include <iterator>

#include "engine/scene/printable.h"
#include "studies/data/number_text.h"
#include "studies/data/value.h"

namespace kurbel {
namespace {

class JsonWriter {
 public:
  explicit JsonWriter(JsonForm form) : form_(form) {}
  std::string text;

  void put(const Value& value) {
    value.visit([&](const auto& v) { put(v); });
  }
  void put(const Record& record) {
    items(record, "{}", [&](const Field& f) {
      if (const Estimate* e = f.value.as<Estimate>()) {
        put(f.key, e->value);
        next();
        put(f.key + "_error", e->error);
      } else {
        put(f.key, f.value);
      }
    });
  }

 private:
  void put(std::monostate) { text += "null"; }
  void put(bool v) { text += v ? "true" : "false"; }
  void put(std::int64_t v) { fmt::format_to(std::back_inserter(text), "{}", v); }
  // The shortest text that reproduces the double, and is recognisable as no integer.
  void put(double v) {
    if (!std::isfinite(v)) return put(std::monostate());
    const std::size_t begin = text.size();
    fmt::format_to(std::back_inserter(text), "{}", v);
    if (text.find_first_of(".e", begin) == std::string::npos) text += ".0";
  }
  void put(const Rounded& v) {
    if (!std::isfinite(v.number)) return put(std::monostate());
    append_digits(text, v.number + 0.0, v.digits);
  }
  void put(const RoundedList& v) {
    if (form_ == JsonForm::indented)
      items(v.numbers, "[]", [&](double number) { put(Rounded{number, v.digits}); });
    else
      put_on_one_line(v);
  }
  // A report has a hundred thousand of these numbers: in blocks.
  void put_on_one_line(const RoundedList& v) {
    constexpr std::size_t size = 4096, longest = 72;
    char block[size];
    char* end = block;
    *end++ = '[';
    for (const double number : v.numbers) {
      if (end > block + size - longest) text.append(block, end), end = block;
      if (std::isfinite(number))
        end = put_digits(end, number + 0.0, v.digits);
      else
        std::memcpy(end, "null", 4), end += 4;
      *end++ = ',';
    }
    if (!v.numbers.empty()) --end;
    *end++ = ']';
    text.append(block, end);
  }
  void put(const Estimate& v) { put(estimate_record(v)); }
  void put(const List& list) {
    items(list, "[]", [&](const Value& item) { put(item); });
  }
  void put(const std::string& words) {
    text += '"';
    const char *from = words.data(), *const end = from + words.size();
    while (from != end) {
      const char* to = from;
      while (to != end && is_kept(*to)) ++to;
      text.append(from, to);
      from = to;
      while (to != end && !is_ascii(*to)) ++to;
      if (to != from)
        text += printable_json({from, to});
      else if (to != end)
        put_escaped(*to++);
      from = to;
    }
    text += '"';
  }
  static bool is_ascii(char c) { return static_cast<unsigned char>(c) < 0x80; }
  bool is_kept(char c) const {
    return c >= 0x20 && c < 0x7F && c != '"' && c != '\\' && (c != '<' || form_ != JsonForm::in_page);
  }
  void put_escaped(char c) {
    if (c == '<')
      text += "\\u003c";
    else if (c == '\n' || c == '\t')
      text += c == '\n' ? "\\n" : "\\t";
    else if (c == '"' || c == '\\')
      text += {'\\', c};
    else
      text += printable_json({&c, 1});
  }
  void put(const std::string& key, const Value& value) {
    put(key);
    text += form_ == JsonForm::indented ? ": " : ":";
    put(value);
  }

  template <class Items, class Put>
  void items(const Items& all, const char* brackets, Put put_item) {
    text += brackets[0];
    ++depth_;
    for (std::size_t i = 0; i < all.size(); ++i) {
      i == 0 ? line() : next();
      put_item(all[i]);
    }
    --depth_;
    if (!all.empty()) line();
    text += brackets[1];
  }
  void next() { text += ',', line(); }
  void line() {
    if (form_ == JsonForm::indented) text += '\n', text.append(2 * depth_, ' ');
  }

  JsonForm form_;
  std::size_t depth_ = 0;
};

}  // namespace

std::string json_text(const Record& record, JsonForm form) {
  JsonWriter writer(form);
  writer.put(record);
  return std::move(writer.text);
}

}  // namespace kurbel
