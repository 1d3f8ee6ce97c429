// periodic_table.cpp — builds a periodic table level by level of bisection, and wraps angles.
#include "mechanisms/reduced/periodic_table.h"

#include <fmt/core.h>

#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "engine/numerics/deadline.h"

namespace kurbel {

namespace {

constexpr std::size_t most_nodes = PeriodicTable::degree + 1;
constexpr std::size_t deepest_level = 14;  // shortest of 16 pieces: 2π/(16·2¹⁴) = 2.4e-5 rad
// Three halvings bring what is smooth down by 2^(3 degree + 3), a kink by 8: an error this small that has hardly fallen
// is the samples' own round-off.
constexpr double may_be_noise = 1e-6, hardly_fallen = 0.3;
constexpr std::size_t halvings_of_noise = 3;

// Nodes x_k = cos(π (k + ½)/n). Between them the interpolation error peaks at cos(kπ/n).
double chebyshev_node(std::size_t k, std::size_t n) {
  return std::cos(std::numbers::pi * (static_cast<double>(k) + 0.5) / static_cast<double>(n));
}
std::array<double, 5> check_points(std::size_t n) {
  std::array<double, 5> x = {1, 0, 0, 0, -1};
  x[1] = std::cos(std::numbers::pi * static_cast<double>(n / 4) / static_cast<double>(n));
  x[2] = n % 2 == 0 ? 0 : std::cos(std::numbers::pi * static_cast<double>(n / 2) / static_cast<double>(n));
  x[3] = -x[1];
  return x;
}

// Turns values at distinct x into coefficients of powers of x (Newton's divided differences), in place. The angles of
// the samples are doubles and so lie off the nodes that were meant by up to 10⁻¹⁶ of themselves, which near a change
// point is much of the way that a channel takes to turn: the polynomial goes through the places that they have.
void interpolate(const std::vector<long double>& x, std::vector<long double>& values) {
  const std::size_t n = x.size();
  for (std::size_t j = 1; j < n; ++j)
    for (std::size_t i = n; i-- > j;) values[i] = (values[i] - values[i - 1]) / (x[i] - x[i - j]);
  for (std::size_t i = n - 1; i-- > 0;)  // a_i + (x − x_i) (what stands behind)
    for (std::size_t k = i; k + 1 < n; ++k) values[k] -= x[i] * values[k + 1];
}

}  // namespace

// The work of PeriodicTable::build.
class TableBuilder {
 public:
  TableBuilder(const PeriodicTable::Sampler& sampler, std::vector<ChannelSpec> channels, double tolerance,
               std::size_t max_pieces, const PeriodicTable::Cut& cut, const PeriodicTable::Sampler& other)
      : sampler_(sampler),
        other_(other),
        channels_(std::move(channels)),
        tolerance_(tolerance),
        cut_(cut),
        max_pieces_(std::max(max_pieces, cut.pieces + 1)),
        nodes_(cut.degree_used + 1),
        check_points_(check_points(nodes_)),
        maximum_(channels_.size()) {
    if (cut.pieces < 1 || !(cut.shift >= 0 && cut.shift < 1) || cut.degree_used < 4 ||
        cut.degree_used > PeriodicTable::degree)
      throw std::invalid_argument(
          fmt::format("periodic table: {} pieces shifted by {}, degree {}; allowed: 1 or more, 0 … 1, 4 … {}",
                      cut.pieces, cut.shift, cut.degree_used, PeriodicTable::degree));
    if (channels_.empty()) throw std::invalid_argument("periodic table: no channels");
    if (!(tolerance > 0))
      throw std::invalid_argument(fmt::format("periodic table: tolerance = {}; must be > 0", tolerance));
  }

  PeriodicTable run() {
    std::vector<Piece> level(first_pieces());
    for (std::size_t i = 0; i < level.size(); ++i) level[i].index = i;
    while (!level.empty()) {
      for (Piece& piece : level) {  // all of a level first: its scales are then known
        Deadline::check();
        fit(piece);
      }
      level = split_or_keep(level);
    }
    return finish();
  }

 private:
  struct Piece {
    std::size_t level = 0, index = 0;
    std::vector<double> coefficients;                   // channel after channel
    std::vector<double> error;                          // per channel: absolute for own_maximum, relative for own_value
    std::array<double, halvings_of_noise> before = {};  // the worst of those that were halved, latest first
  };

  // Shifted seams cut a piece in two at 0, which is there at both ends of the period.
  std::size_t first_pieces() const { return cut_.pieces + (cut_.shift > 0 ? 1 : 0); }
  double width(const Piece& piece) const {
    return PeriodicTable::period / static_cast<double>(cut_.pieces << piece.level);
  }
  double middle(const Piece& piece) const {
    return (static_cast<double>(piece.index) + 0.5 - std::ldexp(cut_.shift, static_cast<int>(piece.level))) *
           width(piece);
  }

  double within(double phi) const { return cut_.shift > 0 ? phi : std::clamp(phi, 0.0, PeriodicTable::period); }

  std::vector<double> sample(double phi) {
    std::vector<double> values(channels_.size());
    sampler_(phi, values);
    ++samples_;
    for (std::size_t c = 0; c < values.size(); ++c) {
      if (!std::isfinite(values[c]))
        throw std::runtime_error(fmt::format("periodic table: channel \"{}\" is {} at phi = {:.17g} rad",
                                             channels_[c].name, values[c], phi));
      maximum_[c] = std::max(maximum_[c], std::fabs(values[c]));
    }
    return values;
  }

  void fit(Piece& piece) {
    const double middle = this->middle(piece), half = width(piece) / 2, per_half = 1 / half;
    const auto place = [&](double phi) { return (static_cast<long double>(phi) - middle) * per_half; };
    std::vector<long double> x(nodes_), values(nodes_);
    std::array<std::vector<double>, most_nodes> at_node;
    for (std::size_t k = 0; k < nodes_; ++k) {
      const double phi = within(middle + half * chebyshev_node(k, nodes_));
      x[k] = place(phi);
      at_node[k] = sample(phi);
    }
    piece.coefficients.assign(channels_.size() * most_nodes, 0);
    for (std::size_t c = 0; c < channels_.size(); ++c) {
      for (std::size_t k = 0; k < nodes_; ++k) values[k] = at_node[k][c];
      interpolate(x, values);
      for (std::size_t i = 0; i < nodes_; ++i) piece.coefficients[c * most_nodes + i] = static_cast<double>(values[i]);
    }

    piece.error.assign(channels_.size(), 0);
    for (const double check : check_points_) {
      const double phi = within(middle + half * check), x_there = static_cast<double>(place(phi));
      count_error(piece, x_there, sample(phi));
    }
  }
  void count_error(Piece& piece, double x, const std::vector<double>& truth) const {
    for (std::size_t c = 0; c < channels_.size(); ++c) {
      double error = std::fabs(PeriodicTable::value({piece.coefficients.data(), x}, c) - truth[c]);
      if (channels_[c].scale == ErrorScale::own_value)
        error /= std::max({std::fabs(truth[c]), channels_[c].least_scale, std::numeric_limits<double>::min()});
      piece.error[c] = std::max(piece.error[c], error);
    }
  }
  void hold_against_other(Piece& piece) const {
    const double half = width(piece) / 2, phi = within(middle(piece) + half / 2);
    std::vector<double> values(channels_.size());
    other_(phi, values);
    count_error(piece, (phi - middle(piece)) / half, values);
  }

  double relative_error(const Piece& piece, std::size_t c) const {
    if (channels_[c].scale == ErrorScale::own_value) return piece.error[c];
    return piece.error[c] / std::max({maximum_[c], channels_[c].least_scale, std::numeric_limits<double>::min()});
  }

  bool good(const Piece& piece) const {
    for (std::size_t c = 0; c < channels_.size(); ++c)
      if (!(relative_error(piece, c) <= tolerance_)) return false;
    return true;
  }

  double worst_error(const Piece& piece) const {
    double worst = 0;
    for (std::size_t c = 0; c < channels_.size(); ++c) worst = std::max(worst, relative_error(piece, c));
    return worst;
  }

  // Both halves of a piece err as much as it did, and as its parents: no kink, which lies in one of them.
  bool is_noise(const std::vector<Piece>& level, std::size_t i) const {
    const Piece &piece = level[i], &sibling = level[i ^ 1];
    if (piece.level < halvings_of_noise || good(sibling)) return false;
    const double error = worst_error(piece);
    return error < may_be_noise && error > hardly_fallen * *std::max_element(piece.before.begin(), piece.before.end());
  }

  // Keeps the good pieces and halves the others while there is space; returns the halves, sibling beside sibling.
  std::vector<Piece> split_or_keep(std::vector<Piece>& level) {
    std::vector<char> enough(level.size());
    for (std::size_t i = 0; i < level.size(); ++i) enough[i] = good(level[i]) || is_noise(level, i);
    std::vector<Piece> halves;
    std::size_t total = kept_.size() + level.size();
    for (std::size_t i = 0; i < level.size(); ++i) {
      Piece& piece = level[i];
      if (enough[i] || total == max_pieces_ || piece.level == deepest_level) {
        kept_.push_back(std::move(piece));
        continue;
      }
      ++total;
      std::array<double, halvings_of_noise> before = piece.before;
      std::rotate(before.begin(), before.end() - 1, before.end());
      before.front() = worst_error(piece);
      for (std::size_t side = 0; side < 2; ++side)
        halves.push_back({piece.level + 1, 2 * piece.index + side, {}, {}, before});
    }
    return halves;
  }

  PeriodicTable finish() {
    std::size_t finest = 0;
    for (const Piece& piece : kept_) finest = std::max(finest, piece.level);
    const std::size_t cells = first_pieces() << finest;

    PeriodicTable table;
    table.cells_per_radian_ = static_cast<double>(cut_.pieces << finest) / PeriodicTable::period;
    table.first_cell_ = std::ldexp(cut_.shift, static_cast<int>(finest));
    table.grid_.resize(cells + 1);
    table.report_ = {kept_.size(), samples_, true, {}};
    std::sort(kept_.begin(), kept_.end(), [&](const Piece& a, const Piece& b) { return middle(a) < middle(b); });
    for (const Piece& piece : kept_) {
      const std::size_t span = std::size_t{1} << (finest - piece.level);
      std::fill_n(table.grid_.begin() + static_cast<std::ptrdiff_t>(piece.index * span), span,
                  static_cast<std::uint32_t>(table.pieces_.size()));
      table.grid_.back() = static_cast<std::uint32_t>(table.pieces_.size());
      table.pieces_.push_back(middle(piece));
      table.pieces_.push_back(1 / (width(piece) / 2));
      table.pieces_.insert(table.pieces_.end(), piece.coefficients.begin(), piece.coefficients.end());
      table.report_.converged = table.report_.converged && good(piece);
    }
    if (other_)
      for (Piece& piece : kept_) hold_against_other(piece);
    for (std::size_t c = 0; c < channels_.size(); ++c) {
      table.report_.channels.push_back({channels_[c].name, maximum_[c], 0});
      for (const Piece& piece : kept_)
        table.report_.channels[c].error = std::max(table.report_.channels[c].error, relative_error(piece, c));
    }
    return table;
  }

  const PeriodicTable::Sampler &sampler_, &other_;
  std::vector<ChannelSpec> channels_;
  double tolerance_;
  PeriodicTable::Cut cut_;
  std::size_t max_pieces_, nodes_;
  std::array<double, 5> check_points_;
  std::vector<double> maximum_;  // per channel, of all samples so far
  std::size_t samples_ = 0;
  std::vector<Piece> kept_;
};

PeriodicTable PeriodicTable::build(const Sampler& sampler, std::vector<ChannelSpec> channels, double tolerance,
                                   std::size_t max_pieces, const Cut& cut, const Sampler& other) {
  return TableBuilder(sampler, std::move(channels), tolerance, max_pieces, cut, other).run();
}

// Cells per radian, the first cell, how many cells there are; each cell's place among the pieces; the pieces.
std::vector<double> PeriodicTable::numbers() const {
  std::vector<double> all = {cells_per_radian_, first_cell_, static_cast<double>(grid_.size())};
  all.insert(all.end(), grid_.begin(), grid_.end());
  all.insert(all.end(), pieces_.begin(), pieces_.end());
  return all;
}

PeriodicTable PeriodicTable::from_numbers(std::span<const double> numbers, std::size_t channels) {
  const auto refuse = [] { throw std::invalid_argument("the numbers are those of no table"); };
  const std::size_t stride = header + channels * (degree + 1);
  if (numbers.size() < 3 || !(numbers[2] >= 2 && numbers[2] < static_cast<double>(numbers.size() - 2))) refuse();
  PeriodicTable table;
  table.cells_per_radian_ = numbers[0];
  table.first_cell_ = numbers[1];
  const auto cells = static_cast<std::size_t>(numbers[2]);
  table.pieces_.assign(numbers.begin() + 3 + static_cast<std::ptrdiff_t>(cells), numbers.end());
  if (table.pieces_.empty() || table.pieces_.size() % stride != 0) refuse();
  const double last = table.first_cell_ + period * table.cells_per_radian_;
  if (!(table.cells_per_radian_ > 0 && table.first_cell_ >= 0 && last < static_cast<double>(cells) + 1e-6)) refuse();
  for (const double place : numbers.subspan(3, cells)) {
    if (!(place >= 0 && place < static_cast<double>(table.pieces_.size())) || std::fmod(place, stride) != 0) refuse();
    table.grid_.push_back(static_cast<std::uint32_t>(place));
  }
  table.report_.pieces = table.pieces_.size() / stride;
  table.report_.converged = true;
  table.report_.channels.resize(channels);
  return table;
}

double PeriodicTable::mean(std::size_t channel) const {
  const std::size_t stride = header + report_.channels.size() * (degree + 1);
  long double sum = 0;
  for (std::size_t i = 0; i < pieces_.size(); i += stride) {
    const double* piece = pieces_.data() + i;
    const auto place = [&](double phi) { return std::clamp((phi - piece[0]) * piece[1], -1.0, 1.0); };
    const double* c = piece + header + channel * (degree + 1);
    // A piece that shifted seams let reach over an end of the period counts within it.
    const long double from = place(0), to = place(period);
    long double from_power = from, to_power = to, integral = 0;
    for (std::size_t k = 0; k <= degree; ++k, from_power *= from, to_power *= to)
      integral += c[k] * (to_power - from_power) / static_cast<long double>(k + 1);
    sum += integral / piece[1];
  }
  return static_cast<double>(sum / period);
}

// φ − 2πk with 2π in three parts: k times the first two is exact while |k| < 2²⁴, so that nothing is lost that φ still
// has.
PeriodicTable::Cursor PeriodicTable::locate_wrapped(double phi) const {
  constexpr double high = 0x1.921fb54p+2, low = 0x1.921fb54442d18p+2 - high, rest = 2.4492935982947064e-16;
  if (!std::isfinite(phi)) return {pieces_.data() + header, std::numeric_limits<double>::quiet_NaN()};

  const double turns = std::floor(phi / period);
  double wrapped = std::fabs(turns) < 0x1p24 ? ((phi - turns * high) - turns * low) - turns * rest
                                             : std::fmod(phi, period);  // such an angle is itself uncertain by 1e-8 rad
  if (wrapped < 0) wrapped += period;
  if (wrapped >= period) wrapped = std::max(0.0, wrapped - period);
  return locate(wrapped);
}

}  // namespace kurbel
