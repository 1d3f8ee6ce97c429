// reduce_findings.cpp — words, tables and formulas of the reduced machine.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>

#include "engine/numerics/angles.h"
#include "engine/scene/units.h"
#include "studies/claims/ranges.h"
#include "studies/findings/output.h"
#include "studies/reduce/reduce.h"
#include "studies/reduce/reduce_plots.h"

namespace kurbel {
namespace {

std::string number(double value, int digits = 6) { return read_as(value, {.digits = digits}); }
std::string damping_text(double c) { return std::isnan(c) ? "not linear" : number(c, 5) + " N·m·s/rad"; }

// " between 30° and 100° of its crank" where it rocks.
std::string over_range(const MachineReduction& r) {
  if (!r.over_a_range) return {};
  return fmt::format(" between {:.4g}° and {:.4g}° of {}", r.begin * in_degrees, (r.begin + r.cycle) * in_degrees,
                     r.link);
}

std::string conclusion_of(const MachineReduction& r) {
  const ReducedPosition *most = nullptr, *least = nullptr;
  for (const ReducedPosition& p : r.curve) {
    if (!most || p.inertia > most->inertia) most = &p;
    if (!least || p.inertia < least->inertia) least = &p;
  }
  if (r.to_output)
    return fmt::format("Reduced to {}, the machine has {:.5g} {}{}", r.to, least ? least->inertia : 0.0,
                       pretty_unit(names_of(r).inertia_unit),
                       r.turns_back ? " or more, infinite in the dead centres" : "");
  const std::string range = range_text(least ? least->inertia : 0, most ? most->inertia : 0, 5);
  if (r.basis == CycleBasis::steady)
    return fmt::format("Reduced to {}, the machine has {} kg·m² along its steady cycle", r.to, range);
  const std::string constant = fmt::format("{:.5g}", r.constant_inertia);
  const std::string begin = fmt::format("Reduced to {}, the machine has {} kg·m²{}", r.to, range, over_range(r));
  if (r.constant_inertia == 0) return begin;
  return fmt::format("{}, {} at constant ratio", begin,
                     range == range_text(r.constant_inertia, r.constant_inertia, 5)
                         ? "all of it"
                         : fmt::format("of which {} kg·m² turn", constant));
}

// --- tables ---

struct Quantity {
  std::string name;
  std::optional<std::string> unit;
  std::function<double(const ReducedPosition&)> value;
};

// Values of each position; rounding errors relative to the largest of their unit are set to zero.
std::vector<Quantity> quantities_of(const MachineReduction& r) {
  const ReducedNames n = names_of(r);
  const std::string i = pretty_unit(n.inertia_unit), t = pretty_unit(n.torque_unit);
  std::vector<Quantity> list = {{n.inertia + "_r", i, &ReducedPosition::inertia},
                                {n.inertia + "_drive", i, &ReducedPosition::drive_inertia},
                                {n.inertia + "_em", i, &ReducedPosition::mechanism_inertia},
                                {n.inertia + "_r′", pretty_unit(n.slope_unit), &ReducedPosition::slope},
                                {n.torque + "_d", t, &ReducedPosition::drive},
                                {n.torque + "_c", t, &ReducedPosition::load}};
  for (const std::size_t k : acting(r))
    list.push_back({r.accounts[k], {}, [k](const ReducedPosition& p) { return p.share[k]; }});
  std::map<std::string, double> of_unit;  // shares are torques
  for (const Quantity& q : list)
    for (const ReducedPosition& p : r.positions)
      if (double& largest = of_unit[q.unit.value_or(t)]; p.singular.empty())
        largest = std::max(largest, std::abs(q.value(p)));
  for (Quantity& q : list) {
    q.value = [value = q.value, largest = of_unit[q.unit.value_or(t)]](const ReducedPosition& p) {
      const double v = value(p);
      return std::abs(v) < 1e-12 * largest ? 0.0 : v;
    };
  }
  return list;
}

Rows positions_table(const MachineReduction& r) {
  const std::string title =
      fmt::format("Reduced to {} at {} positions{}", r.to, r.positions.size(), r.to == r.link ? "" : " φ of " + r.link);
  auto table = table_of("", title, r.positions).headed(title).always();
  table.only_for_people("position", &ReducedPosition::number)
      .only_for_people("φ [°]", &ReducedPosition::phi, {.factor = in_degrees});
  for (const Quantity& q : quantities_of(r))
    table.only_for_people(heading_of(q.name, q.unit), [&](const ReducedPosition& p) {
      return p.singular.empty() ? read_as(q.value(p)) : std::string("—");
    });
  return table;
}

// −180° < phase ≤ 180°, to a millionth of a degree.
std::string phase_text(const Harmonic& h) {
  if (const std::optional<double>& error = h.amplitude.error; error && h.amplitude.value > 0) {
    const Estimate degrees{in_degrees * h.phase, in_degrees * *error / h.amplitude.value};
    if (const FigureText text = figure_text(degrees, 5); error_is_visible(degrees, text)) return text.value;
  }
  const double phase = h.phase;
  const double rounded_phase = std::round(phase * in_degrees * 1e6) / 1e6;
  return number(rounded_phase <= -180 ? rounded_phase + 360 : rounded_phase, 5);
}

Rows harmonics_table(const MachineReduction& r) {
  const std::string title = fmt::format("Harmonics over a cycle, on {}", r.link);
  const std::vector<Harmonic>& first = r.spectra.front().harmonics;
  auto table = table_of("", title, numbers_below(first.size())).headed(title).close().always();
  table.only_for_people("order", [&](std::size_t n) { return first[n].order; }, {.digits = 4});
  for (const Spectrum& s : r.spectra) {
    const auto amplitude = [&s](std::size_t n) {
      return is_dust(s.harmonics[n], s) ? Estimate{0, s.harmonics[n].amplitude.error} : s.harmonics[n].amplitude;
    };
    table.value_and_error(fmt::format("{} [{}]", s.name, pretty_unit(s.unit)),
                          [&](std::size_t n, int digits) { return figure_text(amplitude(n), digits); });
    table.only_for_people("phase [°]", [&, amplitude](std::size_t n) {
      return n == 0 || amplitude(n).value == 0 ? "—" : phase_text(s.harmonics[n]);
    });
  }
  return table;
}

// --- for programs and files ---

Record position_record(const MachineReduction& r, const ReducedPosition& p) {
  Record record = {{"position", p.number}, {"phi", p.phi}};
  if (p.ratio) record.push_back({"slider_velocity_ratio", *p.ratio});
  if (!p.singular.empty()) {
    record.push_back({"singular", p.singular});
    return record;
  }
  const bool mass = r.to_output && !r.to_rocker;
  const std::string inertia = mass ? "mass" : "inertia", torque = mass ? "force" : "torque";
  Record share;
  for (std::size_t k = 0; k < r.accounts.size(); ++k) share.push_back({r.accounts[k], p.share[k]});
  for (Field& field : Record{{inertia, p.inertia},
                             {"drive_" + inertia, p.drive_inertia},
                             {"mechanism_" + inertia, p.mechanism_inertia},
                             {inertia + "_slope", p.slope},
                             {"driving_" + torque, p.drive},
                             {"resisting_" + torque, p.load},
                             {"share", share}})
    record.push_back(std::move(field));
  return record;
}

Record chain_record(const Chain& chain) {
  return {{"inertias", each(chain.inertias,
                            [](const ChainInertia& i) {
                              return Record{{"name", i.name},
                                            {"own", i.own},
                                            {"ratio", i.ratio},
                                            {"reduced", i.reduced},
                                            {"mean_of_mechanism", i.mechanism}};
                            })},
          {"springs", each(chain.springs, [](const ChainSpring& s) {
             return Record{{"name", s.name},
                           {"from", s.a},
                           {"to", s.b},
                           {"ratio", s.ratio},
                           {"stiffness", s.stiffness},
                           {"damping", s.damping},
                           {"reduced_stiffness", s.reduced_stiffness},
                           {"reduced_damping", s.reduced_damping}};
           })}};
}

Record spectrum_record(const Spectrum& s) {
  return {
      {"name", s.name},
      {"unit", s.unit},
      {"captured_of_mean_square", s.captured},
      {"orders", each(s.harmonics, [](const Harmonic& h) {
         return Record{
             {"order", h.order}, {"amplitude", h.amplitude.value}, {"phase", h.phase}, {"error", h.amplitude.error}};
       })}};
}

DataTable positions_data(const MachineReduction& r) {
  std::vector<ReducedPosition> regular = r.positions;
  std::erase_if(regular, [](const ReducedPosition& p) { return !p.singular.empty(); });
  auto data = data_of(std::move(regular));
  data.in_file("position", {}, &ReducedPosition::number)
      .in_file(
          "φ", "°", [](const ReducedPosition& p) { return p.phi * in_degrees + 0.0; }, 15);
  for (const Quantity& q : quantities_of(r))
    data.in_file(
        q.name, q.unit, [value = q.value](const ReducedPosition& p) { return value(p) + 0.0; }, 15);
  return data.data();
}

DataTable harmonics_data(const MachineReduction& r) {
  using Row = std::pair<std::string, Harmonic>;
  std::vector<Row> rows;
  for (const Spectrum& s : r.spectra)
    for (const Harmonic& h : s.harmonics) rows.emplace_back(s.name, h);
  return data_of(std::move(rows))
      .in_file("quantity", {}, &Row::first)
      .in_file(
          "order", {}, [](const Row& row) { return row.second.order + 0.0; }, 6)
      .in_file(
          "amplitude", {}, [](const Row& row) { return row.second.amplitude.value + 0.0; }, 15)
      .in_file(
          "phase", "rad", [](const Row& row) { return row.second.phase + 0.0; }, 15)
      .in_file(
          "error", {}, [](const Row& row) { return row.second.amplitude.error; }, 3)
      .data();
}

DataTable curves_data(const MachineReduction& r) {
  struct Row {
    std::string point;
    double phi, x, y;
  };
  std::vector<Row> rows;
  for (const PointPath& path : r.paths)
    for (std::size_t i = 0; i < path.phi.size(); ++i) rows.push_back({path.name, path.phi[i], path.x[i], path.y[i]});
  return data_of(std::move(rows))
      .in_file("point", {}, &Row::point)
      .in_file(
          "φ", "°", [](const Row& row) { return row.phi * in_degrees; }, 15)
      .in_file(
          "x", "m", [](const Row& row) { return row.x; }, 15)
      .in_file(
          "y", "m", [](const Row& row) { return row.y; }, 15)
      .data();
}

// --- formulas ---

Formulas formulas_of(const MachineReduction& r) {
  Formulas list;
  const ReducedPosition* p = nullptr;
  for (const ReducedPosition& one : r.positions)
    if (one.singular.empty() && (!p || std::abs(one.load) > std::abs(p->load))) p = &one;
  if (!p) return list;
  const std::string where = fmt::format("At φ = {:.5g}°.", p->phi * in_degrees);
  if (r.to_output) {
    const ReducedNames n = names_of(r);
    const std::string i = pretty_unit(n.inertia_unit), t = pretty_unit(n.torque_unit), x = r.to_rocker ? "" : " m";
    list.add(fmt::format("Reduced {} (theory 2.1)", r.to_rocker ? "inertia" : "mass"),
             fmt::format("{}_r = I_r / x′²", n.inertia), "{}_r = {:.6g} kg·m² / ({:.6g}{})² = {:.6g} {}", n.inertia,
             p->inertia * *p->ratio * *p->ratio, *p->ratio, x, p->inertia, i)
        .note(where);
    list.add("Resistance reduced to it (theory 2.2)", fmt::format("{}_r = M_c / x′", n.torque),
             "{}_r = {:.6g} N·m / {:.6g}{} = {:.6g} {}", n.torque, p->load * *p->ratio, *p->ratio, x, p->load, t)
        .note(where);
    return list;
  }
  list.add("Reduced inertia (theory 2.1)", "I_r(φ) = I_drive + I_em(φ)", "I_r = {:.6g} + {:.6g} = {:.6g} kg·m²",
           p->drive_inertia, p->mechanism_inertia, p->inertia)
      .note(where);
  std::string sum;
  for (const std::size_t k : acting(r, above_rounding)) {
    if (std::abs(p->share[k]) <= above_rounding * (std::abs(p->drive) + std::abs(p->load)))
      continue;  // 0 at this angle
    sum += fmt::format("{}{:.6g}",
                       sum.empty()       ? (p->share[k] < 0 ? "−" : "")
                       : p->share[k] < 0 ? " − "
                                         : " + ",
                       std::abs(p->share[k]));
  }
  const double net = p->drive - p->load;
  list.add("Reduced torque (theory 2.2)", "M_r = Σ [F·v + M·ω]/ω = M_d − M_c", "M_r = {} = {:.6g} N·m",
           sum.empty() ? "0" : sum, std::abs(net) > above_rounding * std::abs(p->drive) ? net : 0)
      .note(where);
  return list;
}

std::string errors_text(const MachineReduction& r) {
  if (!r.inertia_error || !r.drive_error || !r.load_error)
    return fmt::format("no errors are known{}: {}", r.inertia_error ? " of M_d and M_c" : "",
                       r.outside_data.empty() ? "nothing repeats" : "torques are taken from outside of their tables");
  const auto error = [](double e) { return figure_text({0, e}).error; };  // rounded up
  return fmt::format(
      "errors, on {}: I_r {} kg·m², M_d {} N·m, M_c {} N·m (from a repetition with tolerances and samples 100 times "
      "coarser)",
      r.link, error(*r.inertia_error), error(*r.drive_error), error(*r.load_error));
}

void report_all(Findings& f, const MachineReduction& r) {
  const ReducedNames n = names_of(r);
  f.record("link", r.link);
  f.record("reduced_to", r.to);
  f.record("speed_ratio", r.to_output ? Value() : Value(r.to_ratio));
  f.record("speed", Record{{"value", r.speed}, {"unit", "rad/s"}, {"source", r.speed_source}});
  f.record("units", Record{{"inertia", n.inertia_unit}, {"torque", n.torque_unit}, {"angle", "rad"}});
  if (r.over_a_range) f.record("range", Record{{"from", r.begin}, {"to", r.begin + r.cycle}, {"unit", "rad"}});
  f.record("basis", r.basis == CycleBasis::classical ? "classical" : "steady");
  f.record("errors", Record{{"reduced_inertia", r.inertia_error},
                            {"driving_torque", r.drive_error},
                            {"resisting_torque", r.load_error}});
  f.record("positions", each(r.positions, [&](const ReducedPosition& p) { return position_record(r, p); }));
  f.record("chain", chain_record(r.chain));
  f.record("harmonics", each(r.spectra, spectrum_record));
}

}  // namespace

Rows chain_table(const Chain& chain, const std::string& to, double slowest, double fastest, const SpeedUnit& unit) {
  Lines lines;
  std::vector<std::string> headings = {"part", "what", "own", "speed ratio i", "reduced", "own c", "reduced c"};
  for (std::size_t k = 0; k < chain.inertias.size(); ++k) {
    const ChainInertia& i = chain.inertias[k];
    lines.push_back({fmt::format("J{}", k + 1),
                     i.name + (!i.mechanism ? ""
                               : i.rocks    ? " (mid-arc)"
                                            : " (mean)"),
                     number(i.own) + " kg·m²", number(i.ratio), number(i.reduced) + " kg·m²", "", ""});
  }
  for (const ChainSpring& s : chain.springs)
    lines.push_back({fmt::format("k{}-{}", s.a + 1, s.b + 1), s.name, number(s.stiffness) + " N·m/rad", number(s.ratio),
                     number(s.reduced_stiffness) + " N·m/rad", damping_text(s.damping),
                     damping_text(s.reduced_damping)});
  if (fastest > 0) {
    headings.insert(headings.begin() + 4, fmt::format("speed [{}]", unit.name));
    for (std::size_t k = 0; k < lines.size(); ++k) {
      const double i = std::abs(k < chain.inertias.size() ? chain.inertias[k].ratio
                                                          : chain.springs[k - chain.inertias.size()].ratio);
      lines[k].insert(lines[k].begin() + 4, range_text(unit.of(i * slowest), unit.of(i * fastest), 5));
    }
  }
  Rows table = words_table(fmt::format("Drive as an elastic chain, reduced to {}", to), headings, lines);
  table.heading = table.title;
  table.text_columns = table.text_columns_on_terminal = 2;
  return table;
}

Findings findings_of(const MachineReduction& r) {
  Findings f = Findings::of(r, fmt::format("Machine reduced to {}", r.to));
  f.speed_unit = r.speed_unit.name, f.opening = Findings::Opening::title_and_conclusion, f.reports_complete = false;
  f.key("constant inertia of the drive", {r.constant_inertia}, "constant_inertia", r.to_output ? "on " + r.link : "");
  if (!r.spectra.empty()) {  // else nothing repeats
    f.key("mean driving torque", r.mean_drive, "mean_driving_torque", "on " + r.link);
    f.key("mean resisting torque", r.mean_load, "mean_resisting_torque", "on " + r.link);
  }
  f.conclude(true, conclusion_of(r));
  const bool any_speed = r.speed_source == "no torque depends on it";
  if (!any_speed)
    f.conclude(true, fmt::format("Torques are those {} {} of \"{}\" ({})",
                                 r.basis == CycleBasis::steady ? "along the motion at" : "at",
                                 r.speed_unit.text(r.speed, 4), r.link, r.speed_source));
  for (const std::string& sentence : r.outside_data) f.claim(Predicate::outside_data, sentence);
  const Chapter cycle = f.chapter(r.over_a_range ? "Over the range" : "Over the cycle"),
                drive = f.chapter("The drive as an elastic chain (theory 5.3)"), spectra = f.chapter("Harmonics"),
                notes = f.chapter("Notes");
  report_all(f, r);
  if (any_speed) f.say(cycle, Sentences{.lines = {speed_text(r)}, .page = false});
  f.say(cycle, Sentences{.lines = {errors_text(r)}, .page = false});
  f.draw(cycle, [&r] { return motion_plots(r); });
  if (!r.paths.empty()) f.draw(cycle, [&r] { return path_plots(r); });
  f.say(cycle, positions_table(r));
  f.show(cycle, formulas_of(r));
  if (!r.chain.springs.empty()) f.draw(drive, [&r] { return chain_plot(r.chain); });
  f.say(drive, chain_table(r.chain, r.to_output ? r.link : r.to));
  f.say(drive, Sentences{.lines = {""}, .page = false});
  if (!r.spectra.empty()) {
    f.draw(spectra, [&r] { return harmonics_plots(r); });
    f.say(spectra, harmonics_table(r));
  }
  f.note(notes, r.notes, "");
  f.tables = {{"positions", [&r] { return positions_data(r); }}, {"harmonics", [&r] { return harmonics_data(r); }}};
  if (!r.paths.empty()) f.tables.push_back({"coupler_curves", [&r] { return curves_data(r); }});
  return f;
}

}  // namespace kurbel
