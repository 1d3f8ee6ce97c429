// rows.h — a table said once: rows of values described by columns; terminal, JSON and page are renderings of it.
//
//   table_of("critical_speeds", "Strongest critical speeds", study.critical)
//       .column("speed", "speed [1/min]", &CriticalSpeed::speed, {.factor = 30 / pi})
//       .column("mode", "mode", &CriticalSpeed::mode)
//       .only_for_programs("harmonic", &CriticalSpeed::harmonic)
//
// A column has a key for programs, a heading for people, or both; programs get the value in SI, people its reading.
#pragma once

#include <fmt/format.h>

#include <cmath>
#include <concepts>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <ranges>
#include <span>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "engine/base/estimate.h"
#include "studies/conclusions/headline.h"
#include "studies/findings/figure_text.h"
#include "studies/findings/report.h"

namespace kurbel {

// --- values, for programs ---

class Value;
struct Field;
using List = std::vector<Value>;
using Record = std::vector<Field>;  // in this order

// What JSON can say. A number that is not finite is null there.
class Value {
 public:
  Value();  // null
  Value(const Value&);
  Value(Value&&) noexcept;
  Value& operator=(const Value&);
  Value& operator=(Value&&) noexcept;
  ~Value();
  template <std::same_as<bool> T>
  Value(T v) : what_(v) {}
  template <std::integral T>
  requires(!std::same_as<T, bool>) Value(T v) : Value(Whole{static_cast<std::int64_t>(v)}) {}
  Value(double v);
  Value(const char* v);
  Value(std::string v);
  Value(List v);
  Value(Record v);
  template <class T>
  Value(const std::optional<T>& v) {
    if (v) *this = Value(*v);
  }
  template <std::ranges::input_range R>
  requires(!std::convertible_to<R, std::string> && !std::same_as<R, List> && !std::same_as<R, Record>)
      Value(const R& range)
      : Value(List(std::begin(range), std::end(range))) {}

  template <class F>
  decltype(auto) visit(F&& f) const {
    return std::visit(std::forward<F>(f), what_);
  }
  // bool, std::int64_t, double, std::string, List or Record; null: it is another.
  template <class T>
  const T* as() const {
    return std::get_if<T>(&what_);
  }

 private:
  struct Whole {
    std::int64_t number;
  };
  explicit Value(Whole v);
  std::variant<std::monostate, bool, std::int64_t, double, std::string, List, Record> what_;
};

struct Field {
  std::string key;
  Value value;
};

// Where a field is whole.
inline Value::Value() = default;
inline Value::Value(const Value&) = default;
inline Value::Value(Value&&) noexcept = default;
inline Value& Value::operator=(const Value&) = default;
inline Value& Value::operator=(Value&&) noexcept = default;
inline Value::~Value() = default;
inline Value::Value(Whole v) : what_(v.number) {}
inline Value::Value(double v) : what_(v) {}
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

// An estimate of its own, or as KEY and KEY_error among others.
inline Record estimate_record(const Estimate& e) { return {{"value", e.value}, {"error", e.error}}; }
inline void tell_estimate(Record& among, const std::string& key, const Estimate& e) {
  among.push_back({key, e.value});
  among.push_back({key + "_error", e.error});
}

// --- readings, for people ---

// How people read a number.
struct ReadAs {
  double factor = 1;  // from SI
  int digits = 6;
  const char* otherwise = "—";  // what is not finite, or is not there
};

inline std::string read_as(double v, const ReadAs& r = {}) {
  const double x = r.factor * v;
  return std::isfinite(x) ? rounded_number(x == 0 ? 0.0 : x, r.digits) : std::string(r.otherwise);
}
inline std::string read_as(const std::string& text, const ReadAs& = {}) { return text; }
template <std::integral T>
std::string read_as(T v, const ReadAs& = {}) {
  return fmt::format("{}", v);
}
template <class T>
std::string read_as(const std::optional<T>& v, const ReadAs& r = {}) {
  return v ? read_as(*v, r) : std::string(r.otherwise);
}
template <class T, std::invocable<const T&> InWords>
std::string read_as(const T& v, const InWords& in_words) {
  return std::invoke(in_words, v);
}

// --- tables ---

struct Column {
  std::string key, heading;             // empty: not for programs; not for people
  bool for_people = true;               // even under an empty heading
  std::vector<Value> values = {};       // a row each, where there is a key
  std::vector<std::string> texts = {};  // a row each, where it is for people
};

struct Rows {
  std::string key;           // of the list in JSON; empty: none
  std::string title;         // on the page
  std::string heading = {};  // on the terminal, above; empty: none
  std::vector<Column> columns = {};
  std::size_t count = 0;
  std::size_t for_programs = SIZE_MAX;                         // at most
  std::optional<std::vector<std::size_t>> for_people = {};     // which; none: all
  std::size_t text_columns = 1, text_columns_on_terminal = 1;  // leading ones; the others are numbers, on the right
  bool terminal = true, page = true, even_if_empty = false;
  bool folded = false;                        // on the page
  bool apart = true;                          // on the terminal, by a blank line before it
  std::vector<std::vector<Tone>> tones = {};  // report.h
  std::vector<std::string> means = {};        // per row, the name of its figure in the dictionary; none, or one each

  List list() const;                                    // as programs get it
  std::vector<std::string> headings() const;            // as people read it
  std::vector<std::vector<std::string>> texts() const;  // without the headings
  bool shown_to_people() const { return (count > 0 && (!for_people || !for_people->empty())) || even_if_empty; }
};

template <class T>
class RowsOf : public Rows {
 public:
  RowsOf(std::string of_key, std::string of_title, std::span<const T> rows, std::shared_ptr<const std::vector<T>> owned)
      : rows_(rows), owned_(std::move(owned)) {
    key = std::move(of_key), title = std::move(of_title), count = rows.size();
  }

  // `get` is a member or a function of a row; `read` a ReadAs, or a function that makes words of what `get` gives.
  template <class Get, class Read = ReadAs>
  RowsOf& column(std::string its_key, std::string its_heading, Get get, Read read = {}) {
    Column& made = columns.emplace_back(Column{std::move(its_key), std::move(its_heading)});
    for (const T& row : rows_) {
      const auto& value = std::invoke(get, row);
      if (!made.key.empty()) made.values.emplace_back(value);
      made.texts.push_back(read_as(value, read));
    }
    return *this;
  }
  template <class Get>
  RowsOf& column(std::string its_key, std::string its_heading, Get get, ReadAs read) {
    return column<Get, ReadAs>(std::move(its_key), std::move(its_heading), std::move(get), read);
  }
  template <class Get, class Read = ReadAs>
  RowsOf& only_for_people(std::string its_heading, Get get, Read read = {}) {
    Column& made = columns.emplace_back(Column{"", std::move(its_heading)});
    for (const T& row : rows_) made.texts.push_back(read_as(std::invoke(get, row), read));
    return *this;
  }
  template <class Get>
  RowsOf& only_for_people(std::string its_heading, Get get, ReadAs read) {
    return only_for_people<Get, ReadAs>(std::move(its_heading), std::move(get), read);
  }
  template <class Get>
  RowsOf& only_for_programs(std::string its_key, Get get) {
    Column& made = columns.emplace_back(Column{.key = std::move(its_key), .heading = "", .for_people = false});
    for (const T& row : rows_) made.values.emplace_back(std::invoke(get, row));
    return *this;
  }

  // `get` gives an Estimate, or none: KEY and KEY_error for programs, "6257.16998 ± 0.00006" for people.
  template <class Get>
  RowsOf& estimate_for_programs(const std::string& its_key, Get get) {
    const auto of = [&](const T& row) -> std::optional<Estimate> { return std::invoke(get, row); };
    only_for_programs(its_key, [&](const T& row) { return of(row) ? std::optional(of(row)->value) : std::nullopt; });
    return only_for_programs(its_key + "_error", [&](const T& row) { return of(row).value_or(Estimate{}).error; });
  }
  template <class Get>
  RowsOf& estimate(const std::string& its_key, std::string its_heading, Get get) {
    estimate_for_programs(its_key, get);
    return only_for_people(std::move(its_heading), [&](const T& row) { return with_error(std::invoke(get, row), ""); });
  }

  // Whose rows are figures: `get` gives a row's name in the dictionary.
  template <class Get>
  RowsOf& explained_by(Get get) {
    for (const T& row : rows_) means.push_back(std::invoke(get, row));
    return *this;
  }

  // Where and how it is shown.
  RowsOf& headed(std::string on_terminal) { return heading = std::move(on_terminal), *this; }
  RowsOf& text_in(std::size_t leading) { return text_columns = text_columns_on_terminal = leading, *this; }
  RowsOf& text_in(std::size_t on_page, std::size_t on_terminal) {
    return text_columns = on_page, text_columns_on_terminal = on_terminal, *this;
  }
  RowsOf& fold(bool so = true) { return folded = so, *this; }
  RowsOf& close() { return apart = false, *this; }
  RowsOf& always() { return even_if_empty = true, *this; }
  RowsOf& not_on_terminal() { return terminal = false, *this; }
  RowsOf& not_on_page() { return page = false, *this; }
  RowsOf& people_see(std::vector<std::size_t> which) { return for_people = std::move(which), *this; }
  RowsOf& people_see_first(std::size_t most) {
    for_people.emplace();
    for (std::size_t i = 0; i < std::min(most, count); ++i) for_people->push_back(i);
    return *this;
  }
  RowsOf& people_see_it_if(bool so) { return so ? *this : people_see({}); }
  RowsOf& programs_see_first(std::size_t most) { return for_programs = most, *this; }

 private:
  std::span<const T> rows_;
  std::shared_ptr<const std::vector<T>> owned_;
};

// Of rows that live as long as columns are added; rows made for it are kept.
template <class T>
RowsOf<T> table_of(std::string key, std::string title, const std::vector<T>& rows) {
  return {std::move(key), std::move(title), std::span<const T>(rows), nullptr};
}
template <class T>
RowsOf<T> table_of(std::string key, std::string title, std::vector<T>&& rows) {
  auto kept = std::make_shared<const std::vector<T>>(std::move(rows));
  const std::span<const T> view(*kept);
  return {std::move(key), std::move(title), view, std::move(kept)};
}
// 0, 1, … count − 1: rows of what is numbered.
std::vector<std::size_t> numbers_below(std::size_t count);

// Rows of words under headings, for people alone.
using Lines = std::vector<std::vector<std::string>>;
Rows words_table(const std::string& title, const std::vector<std::string>& headings, const Lines& lines);

// The other way round: a row a quantity (name, symbol, a value of each thing, unit), for programs a record a thing.
template <class T>
class QuantitiesOf {
 public:
  QuantitiesOf(std::string title, std::vector<std::string> headings, std::span<const T> things)
      : title_(std::move(title)), headings_(std::move(headings)), things_(things), records_(things.size()) {}
  template <class Get, class Read = ReadAs>
  QuantitiesOf& quantity(const std::string& key, std::string name, std::string symbol, std::string unit, Get get,
                         Read read = {}) {
    std::vector<std::string>& line = lines_.emplace_back();
    line = {std::move(name), std::move(symbol)};
    for (const T& thing : things_) line.push_back(read_as(std::invoke(get, thing), read));
    line.push_back(std::move(unit));
    return key.empty() ? *this : only_for_programs(key, get);
  }
  template <class Get>
  QuantitiesOf& only_for_programs(const std::string& key, Get get) {
    for (std::size_t i = 0; i < things_.size(); ++i) records_[i].push_back({key, std::invoke(get, things_[i])});
    return *this;
  }
  Rows rows() const {
    Rows table = words_table(title_, headings_, lines_);
    table.text_columns = table.text_columns_on_terminal = 2;
    return table;
  }
  const std::vector<Record>& records() const { return records_; }

 private:
  std::string title_;
  std::vector<std::string> headings_;
  std::span<const T> things_;
  Lines lines_;
  std::vector<Record> records_;
};

}  // namespace kurbel
