// periodic_table.h — several functions of an angle with period 2π, tabulated together in adaptive polynomial pieces.
//
// [0, 2π) is divided into pieces, which are bisected as needed; every piece has one polynomial per channel. A uniform grid
// as fine as the shortest piece gives the piece of an angle, so a look-up takes constant time:
//
//     const auto cursor = table.locate(phi);          // wraps phi, finds the piece
//     const double inertia = table.value(cursor, 0);  // channel 0 there
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <numbers>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace kurbel {

// Scale of a channel's error.
enum class ErrorScale {
  own_value,   // |value| at the same angle: for a channel that keeps its sign
  own_maximum  // largest |value| over the period: for a channel that passes through zero
};

struct ChannelSpec {
  std::string name;
  ErrorScale scale = ErrorScale::own_maximum;
  double least_scale = 0;  // lower bound of the scale, for channels of rounding noise [unit of the channel], ≥ 0
};

// Errors of the pieces against new samples at check points between the nodes and, if given, against a second source.
struct TableReport {
  struct Channel {
    std::string name;
    double maximum = 0;  // largest |value| sampled
    double error = 0;    // largest measured error, relative to the channel's scale
  };
  std::size_t pieces = 0;   // in the finished table
  std::size_t samples = 0;  // total number
  bool converged = false;   // every error at the check points within the tolerance
  std::vector<Channel> channels;
};

class PeriodicTable {
 public:
  static constexpr std::size_t degree = 9;  // the highest
  static constexpr double period = 2 * std::numbers::pi;

  // The initial pieces. Two cuts with different shifts have no common boundary.
  struct Cut {
    std::size_t pieces = 16;      // in a period
    double shift = 0;             // of the boundaries below 0, over the initial piece: 0 … 1
    std::size_t degree_used = 9;  // of the polynomials, 4 … degree
  };

  // Writes all channels at an angle in [0, 2π], or up to an initial piece outside if the boundaries are shifted.
  using Sampler = std::function<void(double phi, std::span<double> values)>;

  // A position in the table, valid for all channels.
  struct Cursor {
    const double* coefficients;  // of the piece, channel after channel
    double x;                    // −1 … 1 within the piece
  };

  // Bisects pieces until each agrees with new samples to `tolerance` of every channel's scale, or max_pieces is reached;
  // see report().converged and the errors. Samples of `other`, one per piece, show errors common to all samples of the
  // sampler, such as rounded lengths; the difference counts as error. Throws std::invalid_argument for an empty or invalid
  // request.
  static PeriodicTable build(const Sampler& sampler, std::vector<ChannelSpec> channels, double tolerance,
                             std::size_t max_pieces, const Cut& cut, const Sampler& other = {});
  static PeriodicTable build(const Sampler& sampler, std::vector<ChannelSpec> channels, double tolerance,
                             std::size_t max_pieces) {
    return build(sampler, std::move(channels), tolerance, max_pieces, Cut());
  }

  // Any angle; non-finite angles give NaN.
  Cursor locate(double phi) const {
    if (!(phi >= 0 && phi < period)) {
      constexpr double rest = 2.4492935982947064e-16;  // of 2π beyond `period`
      if (!(phi >= period && phi < 2 * period - 1e-9)) return locate_wrapped(phi);
      phi = std::max(0.0, (phi - period) - rest);  // the second turn of a four-stroke cycle; the difference is exact
    }
    const double* piece = pieces_.data() + grid_[static_cast<std::size_t>(phi * cells_per_radian_ + first_cell_)];
    return {piece + header, (phi - piece[0]) * piece[1]};
  }

  // Two interleaved Horner schemes, for the even and the odd powers, in the two halves of one register.
  [[gnu::always_inline]] static double value(Cursor at, std::size_t channel) {
    using Pair [[gnu::vector_size(16), gnu::aligned(8), gnu::may_alias]] = double;
    const auto* c = reinterpret_cast<const Pair*>(at.coefficients + channel * (degree + 1));
    const double x = at.x, y = x * x;
    const Pair both = c[0] + y * (c[1] + y * (c[2] + y * (c[3] + y * c[4])));
    return both[0] + x * both[1];
  }

  // Derivative of value() by the angle.
  static double slope(Cursor at, std::size_t channel) {
    const double* c = at.coefficients + channel * (degree + 1);
    double sum = 0;
    for (std::size_t k = degree; k > 0; --k) sum = sum * at.x + static_cast<double>(k) * c[k];
    return sum * at.coefficients[-1];
  }

  // Mean of a channel over the period, exact for the polynomials.
  double mean(std::size_t channel) const;

  const TableReport& report() const { return report_; }

  // The table without its report, for storage; from_numbers gives an identical table, bit for bit. Throws
  // std::invalid_argument if the numbers are not a table of so many channels.
  std::vector<double> numbers() const;
  static PeriodicTable from_numbers(std::span<const double> numbers, std::size_t channels);

 private:
  friend class TableBuilder;
  static constexpr std::size_t header = 2;  // middle [rad] and 1/half-width [1/rad] precede a piece's coefficients

  Cursor locate_wrapped(double phi) const;

  double cells_per_radian_ = 0, first_cell_ = 0;  // of angle 0, with its fraction
  std::vector<std::uint32_t> grid_;  // cell → index of its piece in pieces_; one more for an angle rounded up
  std::vector<double> pieces_;
  TableReport report_;
};

}  // namespace kurbel
