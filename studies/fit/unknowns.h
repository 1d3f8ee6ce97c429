// unknowns.h — unknowns of a fit: keys of the scene, its tables, and the relation between machine and record.
//
//     rotor.inertia=0.005..0.05 kg*m2           a key, the same for all records
//     half: load.torque=2..8 N*m                a key, of the machine of this record alone
//     each: run.start.speed=1400..1460 rpm      a key, a separate unknown for every record
//     gain of engine.load.pressure=0.9..1.1     factor on a table's values
//     shift of engine.load.pressure=-2..2 deg   a table, delayed by this
//     shift=-2..2 deg                           the record, simulated = measured + shift
//     offset of engine.load.pressure=-0.1..0.1 bar    a table's values, more by this
//     dead centre of engine.load.pressure=-2..2 deg   table and record, or table and angle of start, later by this
//     gain of speed.engine=0.98..1.02, offset of speed.engine=-5..5 rpm    what a record shows = gain · simulated + offset
//     pattern of speed.engine=1,2               times 1 + Σ (a cos k φ + b sin k φ): an encoder's teeth, each turn
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "studies/experiments/parameter.h"
#include "studies/fit/fit_record.h"

namespace kurbel {

struct Unknown {
  enum class Kind { key, table_gain, table_offset, table_shift, record_shift, dead_centre, gain, offset, cosine, sine };
  Kind kind = Kind::key;
  std::string name;                        // as reported: "rotor.inertia", "half: shift"
  SweptParameter range;                    // path, unit, ends
  std::string of = {};                     // table or channel
  std::optional<std::size_t> record = {};  // for this record only; none: all
  double factor = 1;                       // to SI
  int order = 0;                           // of a pattern, per turn

  double at(double u) const { return range.low + u * (range.high - range.low); }  // in its unit
  double si(double u) const { return factor * at(u); }
  bool concerns(std::size_t r) const { return !record || *record == r; }
  bool moves_machine() const {
    return kind == Kind::key || kind == Kind::table_gain || kind == Kind::table_offset || kind == Kind::table_shift ||
           kind == Kind::dead_centre;
  }
  bool is_pattern_of(const std::string& channel) const {
    return (kind == Kind::cosine || kind == Kind::sine) && of == channel;
  }
};

// "half: rest" for a record of that name; "each: rest" where `each` is allowed.
struct OfRecord {
  std::optional<std::size_t> record = {};
  bool each = false;
  std::string rest;
};
// Throws std::invalid_argument if no record has the name. `option`: its name in messages.
OfRecord of_record(const std::string& option, const std::string& text, const std::vector<std::string>& names);

// Throws std::invalid_argument with the reason.
std::vector<Unknown> parse_unknowns(const std::vector<std::string>& given, const std::vector<FitRecord>& records);

// A table of the scene by path, "engine.load.pressure"; null: there is none.
CurveData* table_at(std::vector<Section>& sections, const std::string& path);

}  // namespace kurbel
