// writer.h — JSON written straight into one string: a report is mostly numbers.
#pragma once

#include <fmt/format.h>

#include <cmath>
#include <string>
#include <string_view>
#include <vector>

#include "studies/report/render.h"

namespace kurbel {

class Writer {
 public:
  std::string text;

  void key(std::string_view name) {
    comma();
    text += fmt::format("\"{}\":", name);
    fresh_ = true;
  }
  void value(const std::string& s) { put(json_string(s)); }
  void value(const char* s) { put(json_string(s)); }
  void value(bool b) { put(b ? "true" : "false"); }
  void value(double v, int digits = 7) { put(number(v, digits)); }
  void value(const std::vector<double>& list, int digits = 7) {
    comma();
    text += '[';
    for (std::size_t i = 0; i < list.size(); ++i) {
      if (i) text += ',';
      text += number(list[i], digits);
    }
    text += ']';
    fresh_ = false;
  }
  void value(const std::vector<std::vector<double>>& lists, int digits) {
    list(lists, [&](const std::vector<double>& l) { value(l, digits); });
  }
  void value(const std::vector<std::string>& strings) {
    list(strings, [&](const std::string& s) { value(s); });
  }
  void value(const std::vector<std::vector<std::string>>& rows) {
    list(rows, [&](const std::vector<std::string>& row) { value(row); });
  }
  template <class T, class... More>
  void field(std::string_view name, const T& v, More... more) {
    key(name);
    value(v, more...);
  }
  template <class Body>
  void object(Body body) {
    comma();
    text += '{';
    fresh_ = true;
    body();
    text += '}';
    fresh_ = false;
  }
  void value(const std::vector<int>& numbers) {
    list(numbers, [&](int number) { value(static_cast<double>(number)); });
  }
  // A list of objects under a name.
  template <class List, class Each>
  void objects(std::string_view name, const List& items, Each each) {
    key(name);
    list(items, [&](const auto& item) { object([&] { each(item); }); });
  }
  template <class List, class Each>
  void list(const List& items, Each each) {
    comma();
    text += '[';
    fresh_ = true;
    for (const auto& item : items) each(item);
    text += ']';
    fresh_ = false;
  }

 private:
  static std::string number(double v, int digits) {
    return std::isfinite(v) ? fmt::format("{:.{}g}", v, digits) : "null";
  }
  void put(const std::string& s) {
    comma();
    text += s;
    fresh_ = false;
  }
  void comma() {
    if (!fresh_) text += ',';
    fresh_ = false;
  }
  bool fresh_ = true;
};

}  // namespace kurbel
