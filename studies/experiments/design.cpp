// design.cpp — the designs, each as a pure function of the row.
#include "studies/experiments/design.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <numeric>
#include <stdexcept>
#include <utility>

#include "engine/scene/messages.h"

namespace kurbel {
namespace {

constexpr std::size_t most_rows = 1'000'000'000;
constexpr const char* designs = "allowed: grid:21x3, sobol:4096, lhs:500, random:500, saltelli:1024";

[[noreturn]] void refuse_design(const std::string& text, const std::string& why) {
  throw std::invalid_argument(fmt::format("--design {}: {}; {}", in_quotes(text), why, designs));
}

// Steele, Lea, Flood 2014: every bit of the result depends on every bit of x.
std::uint64_t splitmix(std::uint64_t x) {
  x += 0x9E3779B97F4A7C15u;
  x = (x ^ (x >> 30)) * 0xBF58476D1CE4E5B9u;
  x = (x ^ (x >> 27)) * 0x94D049BB133111EBu;
  return x ^ (x >> 31);
}
std::uint64_t noise(std::uint64_t seed, std::uint64_t a, std::uint64_t b) {
  return splitmix(splitmix(splitmix(seed) ^ a) ^ b);
}
double share_of(std::uint64_t bits) { return static_cast<double>(bits >> 11) * 0x1p-53; }

std::size_t count_of(const std::string& text, const std::string& number) {
  std::size_t count = 0;
  const auto [end, error] = std::from_chars(number.data(), number.data() + number.size(), count);
  if (error != std::errc{} || end != number.data() + number.size() || count < 1 || count > most_rows)
    refuse_design(text, fmt::format("{} is no number of 1 … {}", in_quotes(number), most_rows));
  return count;
}

}  // namespace

Design::Design(const std::string& text, std::vector<SweptParameter> parameters, std::uint64_t seed)
    : text_(text), parameters_(std::move(parameters)), seed_(seed) {
  const std::size_t colon = std::min(text.find(':'), text.size());
  const std::string name = text.substr(0, colon), number = colon < text.size() ? text.substr(colon + 1) : "";
  if (parameters_.empty()) throw std::invalid_argument("nothing is varied; give --vary or --variants");
  if (name == "grid") {
    read_grid(number);
    return;
  }
  const std::pair<const char*, Kind> kinds[] = {
      {"sobol", Kind::sobol}, {"lhs", Kind::lhs}, {"random", Kind::random}, {"saltelli", Kind::saltelli}};
  const auto* const found =
      std::find_if(std::begin(kinds), std::end(kinds), [&](const auto& k) { return k.first == name; });
  if (found == std::end(kinds)) refuse_design(text, fmt::format("no design {}", in_quotes(name)));
  kind_ = found->second;
  base_ = count_of(text, number);
  rows_ = kind_ == Kind::saltelli ? base_ * (parameters_.size() + 2) : base_;
  if (rows_ > most_rows) refuse_design(text, fmt::format("more than {} rows", most_rows));
  const std::size_t dimensions = (kind_ == Kind::saltelli ? 2 : 1) * parameters_.size();
  if (kind_ == Kind::sobol || kind_ == Kind::saltelli) {
    if (dimensions > 3000) refuse_design(text, "more parameters than the sequence has dimensions (3000)");
    sobol_ = boost::random::sobol(dimensions);
  }
  if (kind_ == Kind::lhs) make_permutations();
}

Design::Design(VariantTable table)
    : text_("variants"),
      kind_(Kind::variants),
      parameters_(std::move(table.parameters)),
      rows_(table.rows.size()),
      base_(rows_),
      table_(std::move(table.rows)) {}

void Design::read_grid(const std::string& steps) {
  for (std::size_t begin = 0; begin < steps.size();) {
    const std::size_t end = std::min(steps.find('x', begin), steps.size());
    steps_.push_back(count_of(text_, steps.substr(begin, end - begin)));
    begin = end + 1;
  }
  if (steps_.empty())
    for (const SweptParameter& p : parameters_) {
      if (!p.is_list())
        refuse_design(text_, fmt::format("how many steps {} is to have is missing: it is a range", p.path));
      steps_.push_back(p.values.size());
    }
  if (steps_.size() != parameters_.size())
    refuse_design(text_, fmt::format("{} numbers of steps for {} parameters", steps_.size(), parameters_.size()));
  rows_ = 1;
  for (std::size_t k = 0; k < steps_.size(); ++k) {
    if (parameters_[k].is_list() && steps_[k] != parameters_[k].values.size())
      refuse_design(text_, fmt::format("{} steps of {}, whose list has {} values", steps_[k], parameters_[k].path,
                                       parameters_[k].values.size()));
    if (rows_ > most_rows / steps_[k]) refuse_design(text_, fmt::format("more than {} rows", most_rows));
    rows_ *= steps_[k];
  }
  base_ = rows_;
}

// Fisher and Yates, by the seed.
void Design::make_permutations() {
  if (rows_ > 10'000'000) refuse_design(text_, "a Latin hypercube has at most 10 000 000 rows; take sobol");
  for (std::size_t k = 0; k < parameters_.size(); ++k) {
    std::vector<std::uint32_t> order(rows_);
    std::iota(order.begin(), order.end(), 0u);
    for (std::size_t i = rows_; i-- > 1;) std::swap(order[i], order[noise(seed_, ~k, i) % (i + 1)]);
    permutation_.push_back(std::move(order));
  }
}

// Digits shifted by the seed (seed 0: as published), which keeps the sequence's properties.
std::vector<double> Design::sobol_point(std::size_t i) const {
  boost::random::sobol sequence = sobol_;
  const std::size_t dimensions = sequence.dimension();
  sequence.discard(static_cast<boost::uintmax_t>(i) * dimensions);
  std::vector<double> u(dimensions);
  for (std::size_t k = 0; k < dimensions; ++k)
    u[k] = share_of(sequence() ^ (seed_ == 0 ? 0 : noise(seed_, k, 0x50B01)));
  return u;
}

std::vector<double> Design::shares(std::size_t i) const {
  const std::size_t n = parameters_.size();
  if (kind_ == Kind::sobol) return sobol_point(i);
  std::vector<double> u(n);
  if (kind_ == Kind::saltelli) {
    const std::size_t which = i % (n + 2);  // 0: A; k: A with column k − 1 of B; n + 1: B
    const std::vector<double> point = sobol_point(i / (n + 2));
    for (std::size_t k = 0; k < n; ++k) u[k] = point[which == n + 1 || which == k + 1 ? n + k : k];
    return u;
  }
  for (std::size_t k = 0; k < n; ++k) {
    u[k] = share_of(noise(seed_, k, i));
    if (kind_ == Kind::lhs) u[k] = (permutation_[k][i] + u[k]) / static_cast<double>(rows_);
  }
  return u;
}

std::vector<double> Design::row(std::size_t i) const {
  if (kind_ == Kind::variants) return table_.at(i);
  std::vector<double> values(parameters_.size());
  if (kind_ == Kind::grid) {
    for (std::size_t k = parameters_.size(); k-- > 0; i /= steps_[k])
      values[k] = parameters_[k].at_step(i % steps_[k], steps_[k]);
    return values;
  }
  const std::vector<double> u = shares(i);
  for (std::size_t k = 0; k < values.size(); ++k) values[k] = parameters_[k].at_share(u[k]);
  return values;
}

}  // namespace kurbel
