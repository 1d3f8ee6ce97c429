// value.h — values for programs: numbers, words, lists and records of them, written as JSON.
#pragma once

#include <concepts>
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <ranges>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "engine/base/estimate.h"

namespace kurbel {

class Value;
struct Field;
using List = std::vector<Value>;
using Record = std::vector<Field>;  // in this order

// Written with this number of significant digits, for plots; other numbers are written exactly.
struct Rounded {
  double number = 0;
  int digits = 7;
};
struct RoundedList {
  std::vector<double> numbers;
  int digits = 7;
};

// A number that is not finite is null. An estimate is two fields of its record, KEY and KEY_error; in a list a record
// of "value" and "error".
class Value {
 public:
  Value();  // null
  Value(const Value&);
  Value(Value&&) noexcept;
  Value& operator=(const Value&);
  Value& operator=(Value&&) noexcept;
  ~Value();
  template <std::same_as<bool> T>
  Value(T v);
  template <std::integral T>
  requires(!std::same_as<T, bool>) Value(T v);
  Value(double v);
  Value(Rounded v);
  Value(RoundedList v);
  Value(Estimate v);
  Value(const char* v);
  Value(std::string v);
  Value(List v);
  Value(Record v);
  template <class T>
  Value(const std::optional<T>& v) {
    if (v)
      *this = Value(*v);
    else if (std::same_as<T, Estimate>)
      *this = Value(Estimate{std::numeric_limits<double>::quiet_NaN()});
  }
  template <std::ranges::input_range R>
  requires(!std::convertible_to<R, std::string> && !std::same_as<R, List> && !std::same_as<R, Record>)
      Value(const R& range)
      : Value(List(std::begin(range), std::end(range))) {}

  template <class F>
  decltype(auto) visit(F&& f) const {
    return std::visit(std::forward<F>(f), what_);
  }
  // bool, std::int64_t, double, std::string, List or Record; null: another type.
  template <class T>
  const T* as() const {
    return std::get_if<T>(&what_);
  }

 private:
  std::variant<std::monostate, bool, std::int64_t, double, Rounded, RoundedList, Estimate, std::string, List, Record>
      what_;
};

struct Field {
  std::string key;
  Value value;
};

// Defined here, where Field is a complete type.
inline Value::Value() = default;
inline Value::Value(const Value&) = default;
inline Value::Value(Value&&) noexcept = default;
inline Value& Value::operator=(const Value&) = default;
inline Value& Value::operator=(Value&&) noexcept = default;
inline Value::~Value() = default;
template <std::same_as<bool> T>
Value::Value(T v) : what_(v) {}
template <std::integral T>
requires(!std::same_as<T, bool>) Value::Value(T v) : what_(static_cast<std::int64_t>(v)) {}
inline Value::Value(double v) : what_(v) {}
inline Value::Value(Rounded v) : what_(v) {}
inline Value::Value(RoundedList v) : what_(std::move(v)) {}
inline Value::Value(Estimate v) : what_(v) {}
inline Value::Value(const char* v) : what_(std::string(v)) {}
inline Value::Value(std::string v) : what_(std::move(v)) {}
inline Value::Value(List v) : what_(std::move(v)) {}
inline Value::Value(Record v) : what_(std::move(v)) {}

// One value for each item.
template <class Items, class F>
List each(const Items& items, F&& value) {
  List list;
  for (const auto& item : items) list.push_back(Value(std::invoke(value, item)));
  return list;
}

inline Record estimate_record(const Estimate& e) { return {{"value", e.value}, {"error", e.error}}; }

// Layout of JSON text: one value per line, indented by two blanks; or all on one line for the script of a page, with
// "\u003c" for "<", so that neither "</script" nor "<!--" can occur.
enum class JsonForm { indented, in_page };

// A record as JSON. Invalid UTF-8 is replaced, and control characters are escaped.
std::string json_text(const Record& record, JsonForm form = JsonForm::indented);

}  // namespace kurbel
