// periodic_table.cpp — builds a periodic table level by level of bisection, and wraps angles.
#include "mechanisms/periodic_table.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

namespace kurbel {

namespace {

constexpr std::size_t nodes = PeriodicTable::degree + 1;
constexpr std::size_t first_pieces = 16;
constexpr std::size_t deepest_level = 14;  // shortest piece: 2π/(16·2¹⁴) = 2.4e-5 rad

// Between the Chebyshev nodes the interpolation error peaks at cos(kπ/10): here k = 0, 2, 5, 8, 10.
constexpr std::array<double, 5> check_points = {1.0, 0.80901699437494742, 0.0, -0.80901699437494742, -1.0};

double chebyshev_node(std::size_t k) {
  return std::cos(std::numbers::pi * (static_cast<double>(k) + 0.5) / static_cast<double>(nodes));
}

// Matrix that takes values at the Chebyshev nodes to coefficients of powers of x.
using FitMatrix = std::array<std::array<long double, nodes>, nodes>;

FitMatrix make_fit_matrix() {
  FitMatrix fit{};
  // T_j as powers of x by T_{j+1} = 2 x T_j − T_{j−1}.
  std::array<std::array<long double, nodes>, nodes> power{};
  power[0][0] = power[1][1] = 1;
  for (std::size_t j = 2; j < nodes; ++j)
    for (std::size_t i = 0; i < nodes; ++i) power[j][i] = (i > 0 ? 2 * power[j - 1][i - 1] : 0) - power[j - 2][i];
  // Coefficient of T_j = (2 − δ_j0)/n Σ_k f_k T_j(x_k).
  for (std::size_t j = 0; j < nodes; ++j)
    for (std::size_t k = 0; k < nodes; ++k) {
      const long double angle = std::numbers::pi_v<long double> * (static_cast<long double>(k) + 0.5L) / nodes;
      const long double weight = (j == 0 ? 1.0L : 2.0L) / nodes * std::cos(static_cast<long double>(j) * angle);
      for (std::size_t i = 0; i < nodes; ++i) fit[i][k] += power[j][i] * weight;
    }
  return fit;
}

}  // namespace

// The work of PeriodicTable::build.
class TableBuilder {
 public:
  TableBuilder(const PeriodicTable::Sampler& sampler, std::vector<ChannelSpec> channels, double tolerance,
               std::size_t max_pieces)
      : sampler_(sampler),
        channels_(std::move(channels)),
        tolerance_(tolerance),
        max_pieces_(std::max(max_pieces, first_pieces)),
        maximum_(channels_.size()) {
    if (channels_.empty()) throw std::invalid_argument("periodic table: no channels");
    if (!(tolerance > 0))
      throw std::invalid_argument(fmt::format("periodic table: tolerance = {}; must be > 0", tolerance));
  }

  PeriodicTable run() {
    std::vector<Piece> level(first_pieces);
    for (std::size_t i = 0; i < first_pieces; ++i) level[i].index = i;
    while (!level.empty()) {
      for (Piece& piece : level) fit(piece);  // all of a level first: its scales are then known
      level = split_or_keep(level);
    }
    return finish();
  }

 private:
  struct Piece {
    std::size_t level = 0, index = 0;
    std::vector<double> coefficients;  // channel after channel
    std::vector<double> error;         // per channel: absolute for own_maximum, relative for own_value
    double width() const { return PeriodicTable::period / static_cast<double>(first_pieces << level); }
    double middle() const { return (static_cast<double>(index) + 0.5) * width(); }
  };

  std::vector<double> sample(double phi) {
    std::vector<double> values(channels_.size());
    sampler_(std::clamp(phi, 0.0, PeriodicTable::period), values);
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
    static const FitMatrix matrix = make_fit_matrix();
    const double middle = piece.middle(), half = piece.width() / 2;
    std::array<std::vector<double>, nodes> at_node;
    for (std::size_t k = 0; k < nodes; ++k) at_node[k] = sample(middle + half * chebyshev_node(k));

    piece.coefficients.resize(channels_.size() * nodes);
    for (std::size_t c = 0; c < channels_.size(); ++c)
      for (std::size_t i = 0; i < nodes; ++i) {
        long double sum = 0;
        for (std::size_t k = 0; k < nodes; ++k) sum += matrix[i][k] * at_node[k][c];
        piece.coefficients[c * nodes + i] = static_cast<double>(sum);
      }

    piece.error.assign(channels_.size(), 0);
    for (const double x : check_points) {
      const std::vector<double> truth = sample(middle + half * x);
      for (std::size_t c = 0; c < channels_.size(); ++c) {
        double error = std::fabs(PeriodicTable::value({piece.coefficients.data(), x}, c) - truth[c]);
        if (channels_[c].scale == ErrorScale::own_value)
          error /= std::max({std::fabs(truth[c]), channels_[c].least_scale, std::numeric_limits<double>::min()});
        piece.error[c] = std::max(piece.error[c], error);
      }
    }
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

  // Keeps the good pieces and halves the others while there is room; returns the halves.
  std::vector<Piece> split_or_keep(std::vector<Piece>& level) {
    std::vector<Piece> halves;
    std::size_t total = kept_.size() + level.size();
    for (Piece& piece : level) {
      if (good(piece) || total == max_pieces_ || piece.level == deepest_level) {
        kept_.push_back(std::move(piece));
        continue;
      }
      ++total;
      for (std::size_t side = 0; side < 2; ++side) halves.push_back({piece.level + 1, 2 * piece.index + side, {}, {}});
    }
    return halves;
  }

  PeriodicTable finish() {
    std::size_t finest = 0;
    for (const Piece& piece : kept_) finest = std::max(finest, piece.level);
    const std::size_t cells = first_pieces << finest;

    PeriodicTable table;
    table.cells_per_radian_ = static_cast<double>(cells) / PeriodicTable::period;
    table.grid_.resize(cells + 1);
    table.report_ = {kept_.size(), samples_, true, {}};
    std::sort(kept_.begin(), kept_.end(), [](const Piece& a, const Piece& b) { return a.middle() < b.middle(); });
    for (const Piece& piece : kept_) {
      const std::size_t span = std::size_t{1} << (finest - piece.level);
      std::fill_n(table.grid_.begin() + static_cast<std::ptrdiff_t>(piece.index * span), span,
                  static_cast<std::uint32_t>(table.pieces_.size()));
      table.grid_.back() = static_cast<std::uint32_t>(table.pieces_.size());
      table.pieces_.push_back(piece.middle());
      table.pieces_.push_back(2 / piece.width());
      table.pieces_.insert(table.pieces_.end(), piece.coefficients.begin(), piece.coefficients.end());
      table.report_.converged = table.report_.converged && good(piece);
    }
    for (std::size_t c = 0; c < channels_.size(); ++c) {
      table.report_.channels.push_back({channels_[c].name, maximum_[c], 0});
      for (const Piece& piece : kept_)
        table.report_.channels[c].error = std::max(table.report_.channels[c].error, relative_error(piece, c));
    }
    return table;
  }

  const PeriodicTable::Sampler& sampler_;
  std::vector<ChannelSpec> channels_;
  double tolerance_;
  std::size_t max_pieces_;
  std::vector<double> maximum_;  // per channel, of all samples so far
  std::size_t samples_ = 0;
  std::vector<Piece> kept_;
};

PeriodicTable PeriodicTable::build(const Sampler& sampler, std::vector<ChannelSpec> channels, double tolerance,
                                   std::size_t max_pieces) {
  return TableBuilder(sampler, std::move(channels), tolerance, max_pieces).run();
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
