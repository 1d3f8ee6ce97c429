// reduced_mechanism.h — a mechanism of one degree of freedom as functions of its crank angle, tabulated from the
// loop equations in closed form and, for runs that confirm others, held against Simbody.
//
// For a rocking crank the tables are over σ with φ = middle + reach · cos σ, which is smooth at the ends of the arc.
//
// Every channel is tabulated from its own samples; none is the derivative of another table, which would be less
// accurate.
//     M_d − M_c = I_r ε + ½ ω² I_r′ (theory 2.4)        power of a force F on the output: F x′ ω
#pragma once

#include <cstddef>
#include <functional>
#include <memory>

#include "mechanisms/reduced/crank_cycle.h"
#include "mechanisms/reduced/extraction.h"
#include "mechanisms/reduced/mechanism_data.h"
#include "mechanisms/reduced/periodic_table.h"

namespace kurbel {

class ReducedMechanism {
 public:
  enum Channel : std::size_t {
    inertia_channel,            // I_r [kg·m²]
    inertia_slope,              // I_r′ [kg·m²/rad]
    inertia_curvature,          // I_r″ [kg·m²/rad²]
    output_position_channel,    // x [m], or ψ [rad] of a rocking output; also the next two
    output_velocity_ratio,      // x′ [m/rad]
    output_acceleration_ratio,  // x″ [m/rad²]
    gravity_torque_channel,     // M_g [N·m], positive when it drives
    gravity_torque_slope,       // M_g′ [N·m/rad]
    channel_count
  };

  // Magnitudes of rounding noise: the error of a smaller channel is relative to them.
  struct NoiseScales {
    double inertia = 0;  // for I_r′ and I_r″; ten times this for I_r, which may vanish at a dead centre [kg·m²]
    double gravity_torque = 0;  // for M_g and M_g′ [N·m]
    double output = 0;          // for x″, which is zero for an output that turns uniformly [m/rad²]
    double reach = 1;           // for x on a crank's arc: its mean |x| [m]; 1 rad
  };

  // The mechanism at one angle; each pair takes two polynomials.
  class At {
   public:
    // part: of the cycle in a turn, ½ for cycles of two turns; winding: turns of a fully turning output per crank turn.
    At(const PeriodicTable& table, double part, double winding, double phi)
        : cursor_(table.locate(part * phi)), wound_(winding * phi) {}
    double value(Channel channel) const {
      return PeriodicTable::value(cursor_, channel) + (channel == output_position_channel ? wound_ : 0);
    }
    ValueAndSlope<double> inertia() const { return pair(inertia_channel); }           // I_r, I_r′
    ValueAndSlope<double> inertia_derivative() const { return pair(inertia_slope); }  // I_r′, I_r″
    ValueAndSlope<double> output_position() const {                                   // x, x′
      const auto [value, slope] = pair(output_position_channel);
      return {value + wound_, slope};
    }
    ValueAndSlope<double> output_velocity() const { return pair(output_velocity_ratio); }  // x′, x″
    ValueAndSlope<double> gravity_torque() const { return pair(gravity_torque_channel); }  // M_g, M_g′

   private:
    ValueAndSlope<double> pair(std::size_t first) const {
      return {PeriodicTable::value(cursor_, first), PeriodicTable::value(cursor_, first + 1)};
    }
    PeriodicTable::Cursor cursor_;
    double wound_;
  };

  using Sampler = std::function<ReducedSample(double phi)>;
  // Tabulates any mechanism; report() shows whether the tolerance was reached with max_pieces. `other`: a second source;
  // differences from it count as errors.
  ReducedMechanism(const Sampler& sampler, NoiseScales noise, double tolerance, std::size_t max_pieces,
                   const PeriodicTable::Cut& cut = {}, CrankCycle cycle = {}, const Sampler& other = {});

  // From a table made before.
  ReducedMechanism(PeriodicTable table, CrankCycle cycle);
  std::vector<double> numbers() const { return table_.numbers(); }

  At at(double phi) const { return rocks_ ? At(table_, 1, 0, cycle_.part_of(phi)) : At(table_, part_, winding_, phi); }
  const CrankCycle& cycle() const { return cycle_; }
  ValueAndSlope<double> inertia(double phi) const { return at(phi).inertia(); }
  ValueAndSlope<double> inertia_derivative(double phi) const { return at(phi).inertia_derivative(); }
  ValueAndSlope<double> output_position(double phi) const { return at(phi).output_position(); }
  ValueAndSlope<double> output_velocity(double phi) const { return at(phi).output_velocity(); }
  ValueAndSlope<double> gravity_torque(double phi) const { return at(phi).gravity_torque(); }

  // Mean over a cycle; for a rocking crank the value in the middle of its arc.
  double mean(Channel channel) const { return rocks_ ? at(cycle_.arc()->middle).value(channel) : table_.mean(channel); }

  // Pieces, samples and measured error of every channel; of the second including the difference from the other source.
  const TableReport& report() const { return table_.report(); }

 private:
  PeriodicTable::Sampler in_table(const Sampler& sampler) const;  // `sampler` must outlive the result

  CrankCycle cycle_;
  bool rocks_;
  double part_, winding_;
  PeriodicTable table_;  // over part_ · φ, or σ
};

// Default tolerance of tables: 1e-12 of the value of I_r and of the maxima of the other channels, halved to allow for
// errors between the check points.
inline constexpr double table_tolerance = 0.5e-12;
inline constexpr std::size_t table_max_pieces = 4096;

// Tables of the first extraction have no boundary in common with those of the second and polynomials of another degree;
// their errors are so much smaller that the difference of two runs is the error of the second's.
inline constexpr PeriodicTable::Cut fine_cut = {23, 0.381966, 8};
inline constexpr double fine_tolerance = 0.04;  // of the second's

// A mechanism as functions of its crank angle, from sums over the links (planar_linkage.h, 1 … 3 µs per sample). The second
// extraction has other boundaries and polynomials; Simbody (10 … 40 µs per sample) confirms each of its pieces at one angle,
// and where it differs by more than the tolerance, the second is tabulated from Simbody alone: the two have no error in
// common. Kept for the life of the process, shared by calls with equal data. Throws as MechanismBodies. Thread-safe.
std::shared_ptr<const ReducedMechanism> reduce_mechanism(const MechanismData& data, double tolerance = table_tolerance,
                                                         std::size_t max_pieces = table_max_pieces,
                                                         Extraction extraction = Extraction::first);

// Extracted tables with the data that they depend on: they give the same machine without Simbody.
struct TableBook {
  struct Page {
    std::string kind;             // type name of the mechanism's data
    std::vector<double> of;       // all values that the table depends on
    std::vector<double> numbers;  // PeriodicTable::numbers()
  };
  std::vector<Page> pages;

  // During its lifetime this thread takes its tables from the book and adds missing ones.
  class Open {
   public:
    explicit Open(TableBook& book);
    ~Open();
    Open(const Open&) = delete;
    Open& operator=(const Open&) = delete;

   private:
    TableBook* before_;
  };
};

// For programs that compile thousands of scenes without running them: replaces all tables by ones with a few pieces from
// the closed forms, until switched off. For the whole process.
void take_rough_tables(bool rough);

// As reduce_mechanism, but always a new extraction.
ReducedMechanism extract_mechanism(const MechanismData& data, double tolerance = table_tolerance,
                                   std::size_t max_pieces = table_max_pieces,
                                   Extraction extraction = Extraction::first);

}  // namespace kurbel
