// tape.h — the memory of an observer as a list of numbers, written and read by the same function.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <stdexcept>
#include <type_traits>
#include <utility>
#include <vector>

namespace kurbel {

// An observer passes its members one by one: an empty tape records them, a written one restores them.
//
//     void remember(Tape& tape) override { tape(time_, values_); }
class Tape {
 public:
  Tape() = default;
  explicit Tape(std::vector<double> written) : numbers_(std::move(written)), reading_(true) {}

  // Throws std::invalid_argument if a written tape is too short, or has no count where one is needed.
  template <class... T>
  void operator()(T&... member) {
    (pass(member), ...);
  }
  bool reading() const { return reading_; }
  bool at_end() const { return next_ == numbers_.size(); }
  std::vector<double> take() { return std::move(numbers_); }

 private:
  void pass(double& number) {
    if (!reading_) return numbers_.push_back(number);
    if (at_end()) throw std::invalid_argument("a recorder's memory is shorter than the recorder's");
    number = numbers_[next_++];
  }
  template <class Whole>
  requires std::is_integral_v<Whole>
  void pass(Whole& whole) {
    double number = static_cast<double>(whole);
    pass(number);
    if (!reading_) return;
    constexpr auto bits = std::min(53, std::numeric_limits<Whole>::digits);  // exact in both types
    const double end = std::ldexp(1.0, bits), begin = std::is_signed_v<Whole> ? -end : 0.0;
    if (!(number >= begin && number < end) || number != std::floor(number))
      throw std::invalid_argument("a recorder's memory is damaged: a count is none");
    whole = static_cast<Whole>(number);
  }
  template <class T>
  void pass(std::optional<T>& maybe) {
    bool any = maybe.has_value();
    pass(any);
    if (reading_) maybe = any ? std::optional<T>(T{}) : std::nullopt;
    if (any) pass(*maybe);
  }
  template <class T>
  void pass(std::vector<T>& list) {
    std::size_t size = list.size();
    pass(size);
    if (reading_) {
      if (size > numbers_.size() - next_) throw std::invalid_argument("a recorder's memory is damaged");
      list.assign(size, T{});
    }
    for (T& item : list) pass(item);
  }
  template <class T, std::size_t n>
  void pass(std::array<T, n>& list) {
    for (T& item : list) pass(item);
  }
  template <class T>
  requires requires(T& item, Tape& tape) { item.remember(tape); }
  void pass(T& item) { item.remember(*this); }

  std::vector<double> numbers_;
  std::size_t next_ = 0;
  bool reading_ = false;
};

}  // namespace kurbel
