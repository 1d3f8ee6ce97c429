// modes_findings.cpp — words and tables of modes, critical speeds, forced response and a torque's spectrum.
#include "studies/modes/modes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "engine/numerics/index.h"
#include "studies/claims/ranges.h"
#include "studies/findings/figure_text.h"
#include "studies/findings/result.h"
#include "studies/limits/limits_findings.h"
#include "studies/margins/margins_findings.h"
#include "studies/modes/campbell.h"
#include "studies/modes/drive_limits.h"
#include "studies/modes/modes_plots.h"
#include "studies/shafts/stress_findings.h"

namespace kurbel {
namespace {

using namespace modes;

constexpr double cycle_error = 1e-5;  // of a peak read from 4096 samples of a cycle
constexpr std::size_t responses_shown = 40, most_for_programs = 1000;

// "unbounded" where it is: an undamped resonance.
ReadAs digits(int count) { return {.digits = count, .otherwise = "unbounded"}; }

// --- tables ---

// Names with the largest shares: "rear 61 %, web34 22 %".
std::string largest_shares(const std::vector<double>& share, const std::vector<std::string>& name) {
  std::vector<std::size_t> order(share.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  const std::size_t shown = std::min<std::size_t>(2, order.size());
  std::partial_sort(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(shown), order.end(),
                    [&](std::size_t a, std::size_t b) { return share[a] > share[b]; });
  std::string text;
  for (std::size_t i = 0; i < shown; ++i)
    if (share[order[i]] > 0.05)
      text += fmt::format("{}{} {:.0f} %", text.empty() ? "" : ", ", name[order[i]], 100 * share[order[i]]);
  return text;
}

// Ends where the mode's error begins.
std::string frequency_text(const Mode& m, double omega) {
  return m.error > 0 ? figure_text({hertz(omega), hertz(m.error)}).value : read_as(hertz(omega));
}
std::string error_text(const Mode& m) {
  const std::string error = figure_text({hertz(m.omega), hertz(m.error)}).error;
  return error.empty() ? "—" : error;
}

std::string damped_text(const Mode& m) {
  return m.lambda.imag() > 0 ? frequency_text(m, m.lambda.imag()) : "does not oscillate";
}

// For the periodic system: damped frequency and damping ratio.
std::string periodic_text(const Mode& m) {
  if (m.only_of_mean) return "does not oscillate";
  std::string text;
  for (const PeriodicMode& vibration : m.periodic)
    text += fmt::format("{}{}, {}{}", text.empty() ? "" : " and ", frequency_text(m, vibration.exponent.imag()),
                        read_as(vibration.ratio(), digits(4)),
                        vibration.branch_by_mean ? " (or multiples of 1/T off)" : "");
  return text.empty() ? "—" : text;
}

List periodic_list(const Mode& m) {
  return each(m.periodic, [](const PeriodicMode& vibration) {
    return Record{{"real", vibration.exponent.real()},
                  {"imaginary", vibration.exponent.imag()},
                  {"error", vibration.error},
                  {"branch_by_mean", vibration.branch_by_mean}};
  });
}

List energy_list(const ModesStudy& m, const Mode& mode) {
  return each(energy_stores(m, mode), [](const EnergyStore& store) {
    return Record{{"in", store.name}, {"share", store.share}};
  });
}

// Programs also get the modes of internal states.
Rows mode_table(const ModesStudy& m) {
  auto table = table_of("modes", "Natural frequencies, damping, energies", m.modes);
  table.always().text_in(1, 0).people_see_first(natural_modes(m));
  table.column("number", "mode", &Mode::number)
      .column("name", "shape", [&](const Mode& mode) { return name_of(m, mode); })
      .only_for_programs("omega", &Mode::omega)
      .only_for_programs("frequency", [](const Mode& mode) { return hertz(mode.omega); })
      .only_for_people("f [Hz]", [](const Mode& mode) { return frequency_text(mode, mode.omega); })
      .only_for_programs("damped",
                         [](const Mode& mode) {
                           return Record{{"real", mode.lambda.real()}, {"imaginary", mode.lambda.imag()}};
                         })
      .only_for_programs("natural_frequency", [](const Mode& mode) { return hertz(mode.omega); })
      .only_for_programs("error", [](const Mode& mode) { return hertz(mode.error); })
      .only_for_programs("of_internal_states", &Mode::of_internal_states)
      .only_for_programs("nature", [&](const Mode& mode) { return nature_of(m, mode); })
      .only_for_programs("energy", [&](const Mode& mode) { return energy_list(m, mode); })
      .only_for_programs("held",
                         [](const Mode& mode) {
                           return Record{{"least", hertz(mode.least)}, {"greatest", hertz(mode.greatest)}};
                         })
      .only_for_people("f damped [Hz]", damped_text)
      .only_for_programs("damping_ratio", &Mode::ratio)
      .only_for_people(
          "ζ", [](const Mode& mode) { return mode.lambda.imag() > 0 ? read_as(mode.ratio, digits(4)) : "≥ 1"; });
  if (std::any_of(m.modes.begin(), m.modes.end(),
                  [](const Mode& mode) { return mode.energy.in_internal_states() > 0.01; }))
    table.only_for_people("energy of the damped mode", [&](const Mode& mode) { return energy_text(m, mode); });
  table.only_for_people("numerical error [Hz]", error_text);
  if (std::any_of(m.modes.begin(), m.modes.end(), [](const Mode& mode) { return mode.least < mode.greatest; }))
    table.only_for_people("held at angles [Hz]",
                          [](const Mode& mode) { return range_text(hertz(mode.least), hertz(mode.greatest), 5); });
  if (std::any_of(m.modes.begin(), m.modes.end(),
                  [](const Mode& mode) { return mode.only_of_mean || !mode.periodic.empty(); }))
    table.only_for_people("periodic system [Hz], ζ", periodic_text)
        .only_for_programs("periodic", periodic_list)
        .only_for_programs("fades_within_cycle", &Mode::fades_within_cycle)
        .only_for_programs("only_of_mean", &Mode::only_of_mean);
  if (m.drive.size() <= static_cast<Eigen::Index>(most_for_programs))
    table
        .only_for_programs("shape",
                           [&](const Mode& mode) {
                             const Eigen::VectorXd shape = shaft_shape(m, mode);
                             return std::vector<double>(shape.begin(), shape.end());
                           })
        .only_for_programs("potential_energy", [](const Mode& mode) { return mode.shares.joint; })
        .only_for_programs("kinetic_energy", [](const Mode& mode) { return mode.shares.shaft; });
  return table
      .only_for_people("twist energy in",
                       [&](const Mode& mode) { return largest_shares(mode.shares.joint, m.joint_names); })
      .only_for_people("kinetic energy in",
                       [&](const Mode& mode) { return largest_shares(mode.shares.shaft, m.shaft_names); });
}

// Modes by windings, controllers and slopes of motors, with the energy that determines their nature.
Rows internal_table(const ModesStudy& m) {
  const auto first = m.modes.begin() + static_cast<std::ptrdiff_t>(natural_modes(m));
  return table_of("", "Modes of windings, controllers and other internal states",
                  std::vector<Mode>(first, m.modes.end()))
      .headed("modes of windings, controllers and other internal states, which are no natural frequencies of the drive")
      .text_in(4, 0)
      .only_for_people("mode", &Mode::number)
      .only_for_people("shape", [&](const Mode& mode) { return name_of(m, mode); })
      .only_for_people("nature", [&](const Mode& mode) { return nature_of(m, mode); })
      .only_for_people("energy", [&](const Mode& mode) { return energy_text(m, mode); })
      .only_for_people("f damped [Hz]", damped_text)
      .only_for_people("ζ", &Mode::ratio, digits(4))
      .only_for_people("|λ| [Hz]", [](const Mode& mode) { return frequency_text(mode, mode.omega); })
      .only_for_people("numerical error [Hz]", error_text);
}

Rows response_table(const ModesStudy& m) {
  const auto of = [&](auto member) { return [&m, member](std::size_t j) { return m.here.joints[j].*member; }; };
  const auto order = [&](std::size_t j) { return m.excitations.order(m.here.joints[j].dominant); };
  auto table = table_of("response",
                        fmt::format("At {} of {}; amplitude: largest deviation from the mean",
                                    m.speed_unit.text(m.drive.at.speed, 5), m.link),
                        numbers_below(m.here.joints.size()));
  table.headed("forced response at that speed; amplitude: largest deviation from the mean")
      .programs_see_first(most_for_programs)
      .people_see_first(is_forced(m) ? responses_shown : 0)
      .column("joint", "joint", [&](std::size_t j) { return m.joint_names[j]; })
      .column("mean", "mean [N·m]", of(&JointResponse::mean), digits(5))
      .column("peak", "amplitude [N·m]", of(&JointResponse::peak), digits(6));
  if (m.cycle) {
    const auto really = [&](auto member) { return [&m, member](std::size_t j) { return m.cycle->joints[j].*member; }; };
    table.column("cycle_peak", "in the steady motion", really(&JointResponse::peak), digits(6))
        .column(
            "linear_error", "linear − steady motion",
            [&m](std::size_t j) { return m.here.joints[j].peak - m.cycle->joints[j].peak; }, digits(3))
        .only_for_programs("cycle_amplitude", really(&JointResponse::dominant_amplitude));
  }
  return table.column("amplitude_sum", "Σ of amplitudes", of(&JointResponse::amplitude_sum), digits(5))
      .column("rms", "RMS", of(&JointResponse::rms), digits(5))
      .column("order", "strongest order", order,
              [&](double r) { return r > 0 ? read_as(r, digits(4)) : std::string("—"); })
      .column("amplitude", "its amplitude", of(&JointResponse::dominant_amplitude), digits(5))
      .column("power", "dissipated [W]", of(&JointResponse::power), digits(4));
}

struct LoadClass {
  double from = 0, to = 0, count = 0, sum = 0;
};

Rows rainflow_table(const TorqueHistory& h) {
  constexpr int classes = 10;
  const double width = h.cycles.empty() ? 0 : h.cycles.front().range / classes;
  std::vector<LoadClass> list;
  for (int k = classes - 1; k >= 0 && width > 0; --k) {
    LoadClass& load = list.emplace_back(LoadClass{k * width, (k + 1) * width});
    for (const LoadCycle& c : h.cycles) {
      if (std::clamp(static_cast<int>(c.range / width), 0, classes - 1) != k) continue;
      load.count += c.count;
      load.sum += c.count * c.mean;
    }
  }
  return table_of("", "Rainflow count (ASTM E1049)", std::move(list))
      .headed(fmt::format("rainflow count of the simulated {} (ASTM E1049), equivalent amplitude at m = {:g}: {}; "
                          "ranges up to {} are within the error of zero",
                          h.channel, load_exponent, with_error(h.equivalent_amplitude, "N*m"),
                          torque_text(h.resolution)))
      .text_in(0)
      .always()
      .only_for_people("range from [N·m]", &LoadClass::from, digits(5))
      .only_for_people("to [N·m]", &LoadClass::to, digits(5))
      .only_for_people("cycles", &LoadClass::count)
      .only_for_people("mean [N·m]", [](const LoadClass& c) {
        return c.count > 0 ? read_as(c.sum / c.count, digits(5)) : std::string("—");
      });
}

// Sines in the simulated torque, over Hz or over orders.
Rows spectral_table(const TorqueHistory& h, bool of_orders) {
  const std::string key = of_orders ? "order" : "frequency", of = of_orders ? "orders" : key,
                    unit = of_orders ? "" : " [Hz]";
  const std::vector<SpectralLine>& lines = of_orders ? h.strongest_orders : h.strongest;
  return table_of("", fmt::format("Strongest lines of the simulated {} over {}", h.channel, of), lines)
      .headed(fmt::format("strongest lines of the simulated {} over {}", h.channel, of))
      .text_in(0)
      .only_for_programs(key, [](const SpectralLine& l) { return l.frequency.value; })
      .only_for_programs("error", [](const SpectralLine& l) { return l.frequency.error; })
      .only_for_people(key + unit, [](const SpectralLine& l) { return with_error(l.frequency, ""); })
      .column("amplitude", "amplitude", &SpectralLine::amplitude,
              [](const Estimate& amplitude) { return with_error(amplitude, "N*m"); });
}

std::string point_text(const ModesStudy& m) {
  return fmt::format("linearised at {} of {}; {}", m.speed_unit.text(m.drive.at.speed, 4), m.link, m.drive.mode_set);
}

std::string method_text(const ModesStudy& m) {
  return fmt::format("{}, {} coordinate{}; residual {:.1e}; {} motion{} without twist; counted up to the last mode: {}",
                     m.undamped.basis ? fmt::format("shift and invert, {} vectors", m.undamped.basis) : "dense solver",
                     m.drive.size(), m.drive.size() == 1 ? "" : "s", m.undamped.residual, m.undamped.rigid,
                     m.undamped.rigid == 1 ? "" : "s", m.undamped.counted_below);
}

// --- for programs and files ---

Record operating_point(const ModesStudy& m) {
  return {{"speed", m.drive.at.speed},
          {"link", m.link},
          {"mode_set", m.drive.mode_set},
          {"steady_motion", m.orbit},
          {"torque_left_over", m.drive.mean_torque}};
}

List joint_list(const ModesStudy& m) {
  return each(numbers_below(std::min(m.joint_names.size(), most_for_programs)), [&](std::size_t i) {
    return Record{{"name", m.joint_names[i]},
                  {"stiffness", m.drive.joints[i].stiffness},
                  {"damping", m.drive.joints[i].damping},
                  {"mean_torque", m.drive.joints[i].torque}};
  });
}

Record history_record(const TorqueHistory& h) {
  return {{"channel", h.channel},
          {"greatest", h.greatest},
          {"least", h.least},
          {"equivalent_amplitude", h.equivalent_amplitude},
          {"strongest_lines", spectral_table(h, false).list()},
          {"strongest_orders", spectral_table(h, true).list()}};
}

DataTable shapes_data(const ModesStudy& m) {
  auto data = data_of(numbers_below(m.shaft_names.size()))
                  .in_file("shaft", {}, [&m](std::size_t i) { return m.shaft_names[i]; })
                  .in_file("ratio", {}, [&m](std::size_t i) { return m.drive.ratio[i]; })
                  .in_file("inertia", "kg*m2",
                           [&m](std::size_t i) { return m.drive.shaft_inertia[static_cast<Eigen::Index>(i)]; });
  for (const Mode& mode : m.modes)
    data.in_file(
        fmt::format("mode {} at {:.8g} Hz", mode.number, hertz(mode.omega)), {},
        [shape = shaft_shape(m, mode)](std::size_t i) { return shape[static_cast<Eigen::Index>(i)]; }, 9);
  return data.data();
}

DataTable response_data(const ModesStudy& m) {
  auto data =
      data_of(m.sweep).in_file("speed", "rad/s", &SpeedResponse::speed).in_file("kept", {}, [](const SpeedResponse& s) {
        return s.kept ? 1.0 : 0.0;
      });
  for (std::size_t j = 0; j < m.joint_names.size(); ++j)
    data.in_file(
            "mean " + m.joint_names[j], "N*m", [j](const SpeedResponse& s) { return s.joints[j].mean; }, 9)
        .in_file(
            "peak " + m.joint_names[j], "N*m", [j](const SpeedResponse& s) { return s.joints[j].peak; }, 9);
  return data.data();
}

// --- all of it ---

// Integration error of the sampled period. Unknown for the linear drive alone.
std::optional<double> swing_error(const ModesStudy& m, std::size_t j) {
  if (!m.cycle) return {};
  return cycle_error * std::abs(m.cycle->joints[j].peak);
}

void add_key_figures(Findings& f, const ModesStudy& m) {
  for (std::size_t k = 0; k < m.modes.size() && k < 4; ++k) {
    const Mode& mode = m.modes[k];
    std::string note = mode.of_internal_states ? nature_of(m, mode) : "";
    if (mode.lambda.imag() > 0) note += fmt::format("{}ζ = {:.3g}", note.empty() ? "" : ", ", mode.ratio);
    f.key(fmt::format("mode {}", mode.number), {hertz(mode.omega), hertz(mode.error)},
          mode.of_internal_states ? "internal_frequency" : "natural_frequency", note, 6);
  }
  if (!is_forced(m)) return;
  const SpeedResponse& said = m.cycle ? *m.cycle : m.here;
  const std::size_t j = joint_with_largest_amplitude(said);
  if (std::isfinite(said.joints[j].peak))
    f.key(fmt::format("largest amplitude at {}", m.speed_unit.text(m.drive.at.speed, 4)),
          {said.joints[j].peak, swing_error(m, j)}, "largest_amplitude", m.joint_names[j], 5);
}

Formulas rayleigh(const ModesStudy& m) {
  const Mode& first = m.modes.front();
  const double potential = m.drive.spring_work(m.drive.twists * first.shape).sum();
  const double kinetic = m.drive.inertia.dot(first.shape.cwiseAbs2());
  return Formulas()
      .add("First mode by its energies (Rayleigh, theory 12.4)", "ω² = Σ k θ² / Σ J φ²",
           "ω² = {:.6g} / {:.6g} → ω = {:.6g} 1/s, f = {:.6g} Hz", potential, kinetic, first.omega, hertz(first.omega))
      .note(point_text(m) + ".");
}

// For one coordinate, by the stiffness of weights.
Formulas about_rest(const ModesStudy& m) {
  const double stiffness = m.drive.stiffness.coeff(0, 0) + m.drive.other_stiffness.coeff(0, 0);
  return Formulas()
      .add("Vibration about its position of rest (theory 9)", "ω² = K / I_r, K = −∂M/∂φ",
           "ω² = {:.6g} / {:.6g} → ω = {:.6g} 1/s", stiffness, m.drive.inertia[0],
           std::sqrt(stiffness / m.drive.inertia[0]))
      .note(point_text(m) + ".");
}

FormulaCard half_width(const ModesStudy& m) {
  const ParametricZone& z = m.zones.back();
  const double zeta = m.modes[at(z.mode - 1)].ratio;
  return {.title = "Half width of a zone (theory 12.8)",
          .symbols = "ΔΩ/Ω = √(ε²/16 − ζ²) around Ω = 2 ω/r",
          .numbers = z.variation > 4 * zeta
                         ? fmt::format("√({:.4g}²/16 − {:.4g}²) · {} = {}", z.variation, zeta,
                                       m.speed_unit.text(z.centre, 5), m.speed_unit.text(z.centre * z.half_width, 4))
                         : fmt::format("{:.4g} ≤ 4 · {:.4g}: closed by damping, around {}", z.variation, zeta,
                                       m.speed_unit.text(z.centre, 5)),
          .note = "ε: harmonic r of the reduced inertia in the mode, over its modal inertia. ε ≤ 4 ζ: closed."};
}

void say_modes(Findings& f, Chapter in, const ModesStudy& m) {
  f.say(in, mode_table(m));
  f.say(in, internal_table(m));
  f.say(in, Sentences{.lines = {method_text(m)}, .indent = "  ", .page = false});
  f.record("shafts", m.shaft_names);
  f.record("joints", joint_list(m));
  f.record("count_of_modes_up_to_the_last", m.undamped.counted_below);
  f.record("figures", each(figures_of(m), [](const Figure& x) {
             return Record{{"name", x.name}, {"value", x.value}, {"unit", x.unit}, {"error", x.error}};
           }));
  if (m.modes.empty()) return;
  f.draw(in, [&m] { return mode_plots(m); });
  if (!m.rests_at && natural_modes(m) > 0) f.show(in, rayleigh(m));
  if (m.rests_at && m.drive.size() == 1) f.show(in, about_rest(m));
  f.show(in, Text{.title = "", .body = "Check: " + method_text(m) + " (Sylvester's law of inertia)."});
}

void say_margins(Findings& f, Chapter in, const ModesStudy& m) {
  if (m.margins.rows.empty()) return;
  f.record("operating_range", operating_range(m.margins));
  f.say(in, margin_table(m.margins, m.speed_unit));
  f.tables.push_back({"margins", [&m] { return margin_table(m.margins, m.speed_unit).data(); }});
}

void say_stresses(Findings& f, Chapter in, const ModesStudy& m) {
  if (!m.stresses.any()) return;
  f.draw(in, [&m] { return stress_plots(m.stresses); });
  f.say(in, stress_table(m.stresses));
  if (!m.stresses.misfires.empty()) f.say(in, misfire_table(m.stresses));
  f.tables.push_back({"shaft_stress", [&m] { return stress_data(m.stresses); }});
}

void say_history(Findings& f, Chapter in, const ModesStudy& m) {
  if (!m.history) return;
  const TorqueHistory& h = *m.history;
  if (!h.lines.empty()) f.draw(in, [&] { return history_plots(m, h); });
  f.say(in, Sentences{.lines = {fmt::format("simulated {}: from {} to {}", h.channel, with_error(h.least, "N*m"),
                                            with_error(h.greatest, "N*m"))},
                      .indent = "  ",
                      .apart = true});
  for (const bool of_orders : {false, true}) f.say(in, spectral_table(h, of_orders));
  Rows rainflow = rainflow_table(h);
  rainflow.page = !h.lines.empty();
  f.say(in, std::move(rainflow));
  f.record("history", history_record(h));
}

}  // namespace

Findings findings_of(const ModesStudy& m) {
  Findings f = Findings::of(m, point_text(m));
  f.page_title = fmt::format("{}: modes and critical speeds", m.title);
  f.speed_unit = m.speed_unit.name, f.footer = report_footer();
  add(f.claims, motion_claim(m));
  f.conclude(m.complete, conclusion_of(m));
  for (const std::string& sentence : m.outside_data) f.claim(Predicate::outside_data, capitalised(sentence));
  f.claim(limit_claims(m.verdicts, "limit"));
  f.claim(barred_claim(m.barred, m.limited, m.speed_unit));
  f.claim(stress_claims(m.stresses));
  f.claim(margin_claim(m.margins, m.speed_unit));
  const Chapter limits = f.chapter(modes_chapter::limits), modes = f.chapter(modes_chapter::modes),
                campbell = f.chapter(modes_chapter::margins), forced = f.chapter(modes_chapter::forced),
                cases = f.chapter(modes_chapter::cases), stresses = f.chapter(modes_chapter::stresses),
                history = f.chapter(modes_chapter::history), notes = f.chapter("Notes");
  add_key_figures(f, m);
  f.record("operating_point", operating_point(m));
  f.say(modes, Sentences{.lines = {point_text(m)}, .indent = "  ", .page = false, .apart = true});
  say_modes(f, modes, m);
  const bool is_shaken = is_forced(m);
  if (!m.modes.empty() && !m.rests_at) f.draw(campbell, [&m] { return campbell_plot(m); });
  f.say(forced, response_table(m));
  say_spots(f, forced, m);
  if (is_shaken) f.draw(forced, [&m] { return response_plots(m); });
  say_margins(f, campbell, m);
  f.say(campbell, critical_table(m));
  f.say(forced, barred_table(m.barred, m.limited, m.speed_unit));
  f.say(campbell, zone_table(m));
  if (!m.zones.empty()) f.show(campbell, half_width(m));
  f.say(limits, verdict_table(m.verdicts));
  say_cases(f, cases, m);
  name_condition_of_limits(f.claims);
  say_stresses(f, stresses, m);
  say_history(f, history, m);
  f.note(notes, m.notes);
  f.show_scene(m.scene_file, m.scene_text);
  f.tables.push_back({"mode_shapes", [&m] { return shapes_data(m); }});
  if (!m.sweep.empty()) f.tables.push_back({"forced_response", [&m] { return response_data(m); }});
  return f;
}

}  // namespace kurbel
