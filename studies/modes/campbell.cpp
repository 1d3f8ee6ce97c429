#include "studies/modes/campbell.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "engine/scene/text.h"
#include "studies/claims/ranges.h"
#include "studies/findings/plots.h"
#include "studies/findings/rows.h"
#include "studies/modes/critical_speeds.h"
#include "studies/modes/modes_plots.h"

namespace kurbel::modes {
namespace {

constexpr std::size_t critical_shown = 16, rays_shown = 10, modes_named = 12;
constexpr double mostly = 0.9;         // of a mode's energy in internal states: the mechanical shape does not matter
constexpr double least_circle = 1e-3;  // of the severest critical speed's share
constexpr double least_ray = 0.02;     // of the strongest order's torque

// Near enough to be drawn for its margin.
bool is_near(const ModesStudy& m, const Margin& row) { return std::abs(row.margin) < 3 * m.margins.speeds.margin; }

// Orders of the severest critical speeds first, then those within the margin, those with the largest torques, and the
// orders of the reduction link; sorted by slope. Frequencies independent of speed, and converters, are all drawn.
std::vector<const ExcitationLine*> lines_drawn(const ModesStudy& m) {
  using Kind = ExcitationLine::Kind;
  std::vector<const ExcitationLine*> shown;
  std::size_t rays = 0;
  const auto show = [&](const ExcitationLine& line) {
    const bool is_ray = line.kind == Kind::order;
    if ((is_ray && rays == rays_shown) || std::find(shown.begin(), shown.end(), &line) != shown.end()) return;
    shown.push_back(&line), rays += is_ray;
  };
  const auto show_harmonic = [&](std::size_t r) {
    for (const ExcitationLine& line : m.margins.lines)
      if (line.harmonic == r) show(line);
  };
  const std::vector<std::size_t> severe = severest_critical(m, 12);
  for (const std::size_t i : severe)
    if (const double most = m.critical[severe.front()].share;
        std::isinf(most) || m.critical[i].share > least_circle * most)
      show_harmonic(m.critical[i].harmonic);
  for (const Margin& row : m.margins.rows)
    if (is_near(m, row)) show(m.margins.lines[row.line]);
  std::vector<std::pair<double, std::size_t>> strength;
  for (std::size_t r = 1; r <= m.excitations.harmonics; ++r)
    strength.emplace_back(-m.excitations.strength(r, m.drive.at.speed), r);
  std::sort(strength.begin(), strength.end());
  for (const auto& [negative, r] : strength)
    if (negative < least_ray * strength.front().first) show_harmonic(r);
  for (const ExcitationLine& line : m.margins.lines)
    if (line.kind != Kind::order || line.order == 1 || line.order == 2) show(line);
  std::stable_sort(shown.begin(), shown.end(),
                   [](const ExcitationLine* a, const ExcitationLine* b) { return a->order < b->order; });
  return shown;
}

// Up to the highest mode of the severe critical speeds, and never below the first mode [Hz].
double top_of(const ModesStudy& m) {
  double top = m.modes.empty() ? 0 : hertz(m.modes.front().magnitude());
  const std::vector<std::size_t> severe = severest_critical(m, 16);
  for (const std::size_t i : severe)
    if (m.critical[i].share > 0.05 * m.critical[severe.front()].share)
      top = std::max(top, hertz(m.critical[i].order * m.critical[i].speed));
  // Up to the strongest order at the operating speed, unless that leaves no room for the modes.
  constexpr double most_above = 6;
  std::size_t strongest = 0;
  double most = 0;
  for (std::size_t r = 1; r <= m.excitations.harmonics; ++r)
    if (const double size = m.excitations.strength(r, m.drive.at.speed); size > most * (1 + 1e-9))
      most = size, strongest = r;
  if (strongest > 0)
    top = std::max(top, std::min(most_above * top, m.excitations.order(strongest) * hertz(std::abs(m.drive.at.speed))));
  const double lowest = top;
  for (const Margin& row : m.margins.rows)
    if (is_near(m, row)) top = std::max(top, hertz(m.margins.modes[row.mode].omega));
  if (severe.empty())
    for (const ExcitationLine* line : lines_drawn(m))
      top = std::max(top, std::min(most_above * lowest, hertz(line->at(m.fastest))));
  return 1.15 * top;
}

// "Above the diagram, where no order of weight meets a mode: mode 2 at 481.8 Hz.": names the modes not drawn.
std::string modes_above(const ModesStudy& m, double top) {
  constexpr std::size_t most_reported = 4;
  std::string text;
  std::size_t number = 0;
  for (const Mode& mode : m.modes) {
    const double f = hertz(frequency_of_resonance(m.drive, mode));
    if (f <= top) continue;
    if (++number <= most_reported)
      text += fmt::format("{}mode {} at {:.4g} Hz", number == 1 ? "" : ", ", mode.number, f);
  }
  if (number > most_reported) text += fmt::format(" and {} more", number - most_reported);
  return number == 0 ? "" : "Above the diagram, where no order of weight meets a mode: " + text + ". ";
}

// Through the diagram up to its edge; empty if it lies above.
std::optional<Series> ray(const ModesStudy& m, const ExcitationLine& line, double top) {
  const auto at = [&](double speed) { return hertz(line.at(speed)); };
  double from = m.slowest, to = m.fastest;
  const double meets_edge = line.order > 0 ? (2 * std::numbers::pi * top - line.fixed) / line.order : HUGE_VAL;
  if (at(from) >= top) return {};  // of a converter's line, too, that comes down from above
  to = std::min(to, meets_edge);
  Series s{.name = fmt::format("{:.4g} · {}", line.order, line.label), .text_at_end = line.label};
  const bool is_ray = line.kind == ExcitationLine::Kind::order;
  s.role = is_ray ? Role::rigid : Role::reference, s.dashed = !is_ray;
  s.add(m.speed_unit.of(from), at(from));
  if (const double bottom = line.order > 0 ? -line.fixed / line.order : 0; bottom > from && bottom < to)
    s.add(m.speed_unit.of(bottom), 0);
  s.add(m.speed_unit.of(to), at(to));
  return s;
}

// "Sources: cylinder (4 alike): 2×, 4×; compressor: 1×. "
std::string legend_of(const std::vector<const ExcitationLine*>& lines) {
  std::vector<std::pair<std::string, std::string>> by_source;
  for (const ExcitationLine* line : lines) {
    if (line->source.empty() || line->source == "every shaft") continue;
    const auto same = std::find_if(by_source.begin(), by_source.end(),
                                   [&](const auto& source) { return source.first == line->source; });
    if (same == by_source.end())
      by_source.emplace_back(line->source, line->label);
    else
      same->second += ", " + line->label;
  }
  std::string text;
  for (const auto& [source, labels] : by_source)
    text += fmt::format("{}{}: {}", text.empty() ? "Sources: " : "; ", source, labels);
  return text.empty() ? "" : text + ". ";
}

std::string words_of(const ModesStudy& m, const Margin& row, double speed) {
  const MarginMode& mode = m.margins.modes[row.mode];
  const ExcitationLine& line = m.margins.lines[row.line];
  std::string text = fmt::format("{}, {:+.3g} % off the operating speeds\n{}{}\nmode {}: {}\n",
                                 m.speed_unit.text(speed, 4), 100 * row.margin, line.label,
                                 line.source.empty() ? "" : " of " + line.source, mode.number, mode.name);
  if (row.largest)
    text +=
        fmt::format("largest response at {}, {:+.3g} %\n", m.speed_unit.text(*row.largest, 4), 100 * row.at_largest);
  if (!row.not_assessed.empty()) return text + "response not assessed: " + row.not_assessed;
  return text + fmt::format("{} in {}\n{:.3g} % of the limit", torque_text(row.response->amplitude),
                            as_words(row.response->joint), 100 * row.response->share);
}

// Intersections of the lines shown with modes: larger for higher utilisation.
std::vector<Series> meetings(const ModesStudy& m, const std::vector<const ExcitationLine*>& lines, double top) {
  Series kept{.name = "meetings, larger ones severer", .role = Role::orange},
      within{.name = fmt::format("within ± {:.3g} % of the operating speeds", 100 * m.margins.speeds.margin),
             .role = Role::vermillion};
  double most = 0;
  for (const CriticalSpeed& c : m.critical)
    if (std::isfinite(c.share)) most = std::max(most, c.share);
  for (const Margin& row : m.margins.rows) {
    const double frequency = hertz(m.margins.modes[row.mode].omega);
    if (frequency > top || std::find(lines.begin(), lines.end(), &m.margins.lines[row.line]) == lines.end()) continue;
    Series& s = row.within ? within : kept;
    const double share = row.not_assessed.empty() ? row.response->share : std::nan("");
    for (const std::optional<double>& speed : {row.crossing, row.further_crossing}) {
      if (!speed || *speed < m.slowest || *speed > m.fastest) continue;
      s.add(m.speed_unit.of(*speed), frequency);
      s.sizes.push_back(std::isinf(share) ? 3 : share > 0 && most > 0 ? 0.7 + 2.3 * std::sqrt(share / most) : 0.7);
      s.labels.push_back(words_of(m, row, *speed));
    }
  }
  std::vector<Series> all;
  for (Series* s : {&kept, &within})
    if (!s->x.empty()) all.push_back(marks(std::move(*s)));
  return all;
}

// The operating range, and the required margin on both sides.
void add_operating_bands(const ModesStudy& m, std::vector<Band>& bands) {
  const OperatingSpeeds& run = m.margins.speeds;
  if (!run.known()) return;
  const double from = m.speed_unit.of(run.slowest), to = m.speed_unit.of(run.fastest);
  bands.push_back(
      {from * (1 - run.margin), to * (1 + run.margin), fmt::format("± {:.3g} %", 100 * run.margin), Role::sky});
  if (from < to) bands.push_back({from, to, "operating range", Role::green});
}

// Barred ranges of all joints, those that touch as one.
std::vector<Band> bands_of(const ModesStudy& m) {
  std::vector<Band> bands;
  for (const BarredRange& range : m.barred) {
    const double from = m.speed_unit.of(range.from), to = m.speed_unit.of(range.to);
    const auto touching =
        std::find_if(bands.begin(), bands.end(), [&](const Band& band) { return from <= band.to && band.from <= to; });
    if (touching == bands.end())
      bands.push_back({from, to, "barred", Role::vermillion});
    else
      touching->from = std::min(touching->from, from), touching->to = std::max(touching->to, to);
  }
  for (const SpeedStretch& s : stretches(m.sweep))
    if (!s.kept)
      bands.push_back({m.speed_unit.of(m.sweep[s.begin].speed), m.speed_unit.of(m.sweep[s.end - 1].speed), "cannot run",
                       Role::rigid});
  add_operating_bands(m, bands);
  const double speed = m.speed_unit.of(std::abs(m.drive.at.speed));
  if (speed > 0 && !(m.margins.speeds.slowest < m.margins.speeds.fastest))
    bands.push_back(
        {speed, speed, "operating speed " + m.speed_unit.text(std::abs(m.drive.at.speed), 4), Role::reference});
  return bands;
}

// Windows of a run by position, ascending; of those within an eightieth of the range the one with larger amplitude.
struct Windows {
  std::vector<double> at;
  std::vector<std::vector<double>> amplitude;
};

Windows windows_by(const std::vector<double>& place, const TorqueHistory& h, std::size_t columns) {
  std::vector<std::size_t> order = numbers_below(place.size());
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return place[a] < place[b]; });
  const double like = (place[order.back()] - place[order.front()]) / 80;
  Windows rows;
  for (const std::size_t l : order) {
    if (rows.at.empty() || place[l] > rows.at.back() + like) {
      rows.at.push_back(place[l]);
      rows.amplitude.emplace_back(columns, std::nan(""));
    }
    std::vector<double>& row = rows.amplitude.back();
    const AmplitudeSpectrum& s = h.lines[l].spectrum;
    for (std::size_t k = 0; k < columns && k < s.amplitude.size(); ++k)
      if (!(row[k] >= s.amplitude[k])) row[k] = s.amplitude[k];
  }
  return rows;
}

// The parts that vibrate against each other.
std::string moving_parts(const ModesStudy& m, const Mode& mode) {
  const Eigen::VectorXd shape = shaft_shape(m, mode);
  const std::vector<double>& energy = mode.shares.shaft;
  int one = -1, other = -1;
  const auto sense = [&](int i) {
    const double ratio = m.drive.ratio[static_cast<std::size_t>(i)];
    return (ratio < 0 ? -1 : 1) * shape[i] < 0 ? -1 : 1;
  };
  const auto larger = [&](int i, int than) {
    return than < 0 || energy[static_cast<std::size_t>(i)] > energy[static_cast<std::size_t>(than)] * (1 + 1e-9);
  };
  for (int i = 0; i < static_cast<int>(energy.size()) && i < shape.size(); ++i)
    if (larger(i, one)) one = i;
  if (one < 0) return "";
  for (int i = 0; i < static_cast<int>(energy.size()) && i < shape.size(); ++i)
    if (sense(i) != sense(one) && larger(i, other)) other = i;
  const auto name = [&](int i) { return as_words(m.shaft_names[static_cast<std::size_t>(i)]); };
  if (other < 0 || energy[static_cast<std::size_t>(other)] < 0.03) return name(one);
  return name(one) + " against " + name(other);
}

}  // namespace

std::string name_of(const ModesStudy& m, const Mode& mode) {
  if (!mode.of_internal_states) return moving_parts(m, mode);
  for (const EnergyStore& store : energy_stores(m, mode))
    if (store.name.find(" of ") != std::string::npos)
      return mode.energy.in_internal_states() > mostly ? store.name
                                                       : fmt::format("{} and {}", store.name, moving_parts(m, mode));
  return moving_parts(m, mode);
}

std::vector<std::size_t> severest_critical(const ModesStudy& m, std::size_t count) {
  double most = 0;
  for (const CriticalSpeed& c : m.critical) most = std::max(most, c.share);
  std::vector<std::size_t> places;
  for (std::size_t i = 0; i < m.critical.size(); ++i)
    if (m.critical[i].share > 1e-6 * most || std::isinf(m.critical[i].share)) places.push_back(i);
  std::stable_sort(places.begin(), places.end(),
                   [&](std::size_t a, std::size_t b) { return m.critical[a].share > m.critical[b].share; });
  if (places.size() > count) places.resize(count);
  return places;
}

Plot campbell_plot(const ModesStudy& m) {
  const double top = top_of(m);
  Plot plot{.title = "Campbell diagram: where excitation orders meet the modes",
            .x = {.label = "speed of " + m.link,
                  .unit = m.speed_unit.name,
                  .least = m.speed_unit.of(m.slowest),
                  .greatest = m.speed_unit.of(m.fastest)},
            .y = {.label = "frequency", .unit = "Hz", .least = 0, .greatest = top},
            .note = "Level lines: modes. Grey rays: orders, of the turn of " + m.link + " where no shaft is named. ",
            .wide = true,
            .bands = bands_of(m)};
  const std::vector<const ExcitationLine*> lines = lines_drawn(m);
  for (const ExcitationLine* line : lines) {
    if (std::optional<Series> drawn = ray(m, *line, top))
      plot.series.push_back(std::move(*drawn));
    else
      plot.note += fmt::format("{} lies above the diagram. ", capitalised(line->label));
  }
  plot.note += legend_of(lines);
  std::string shifted;
  std::size_t named = 0;
  for (const Mode& mode : m.modes) {
    const double f = hertz(frequency_of_resonance(m.drive, mode));
    if (f > top || named >= modes_named) continue;
    if (const std::string why = why_shifted(m, mode, 2 * std::numbers::pi * f); !why.empty())
      shifted += fmt::format("Mode {} is drawn where it resonates, at |λ| = {:.4g} Hz{} from {:.4g} Hz. ", mode.number,
                             f, why, hertz(mode.omega));
    plot.series.push_back({.name = fmt::format("mode {}: {}", mode.number, name_of(m, mode)),
                           .role = further_role(named++),
                           .x = {m.speed_unit.of(m.slowest), m.speed_unit.of(m.fastest)},
                           .y = {f, f},
                           .text_at_start = fmt::format("{}  {}, {:.4g} Hz", mode.number, name_of(m, mode), f)});
  }
  if (std::any_of(plot.series.begin(), plot.series.end(), [](const Series& s) { return s.dashed; }))
    plot.note += "Dashed: excitations of fixed frequency, of converters and of tooth meshes. ";
  for (Series& met : meetings(m, lines, top)) plot.series.push_back(std::move(met));
  plot.note += shifted + modes_above(m, top);
  for (const ParametricZone& z : m.zones)
    if (z.half_width > 0) plot.marks.push_back({m.speed_unit.of(z.centre), fmt::format("parametric, mode {}", z.mode)});
  return plot;
}

Plot waterfall_plot(const ModesStudy& m, const TorqueHistory& h) {
  double slow = HUGE_VAL, fast = -HUGE_VAL, end = 0;
  for (const WaterfallLine& line : h.lines) {
    slow = std::min(slow, line.speed), fast = std::max(fast, line.speed);
    end = std::max(end, end_of_spectrum(m, line.spectrum));
  }
  const bool over_speed = fast - slow > 0.05 * std::max(std::abs(fast), std::abs(slow));
  std::vector<double> place;
  for (const WaterfallLine& line : h.lines) place.push_back(over_speed ? m.speed_unit.of(line.speed) : line.time);
  std::vector<double> frequency = h.lines.front().spectrum.frequency;
  frequency.resize(
      static_cast<std::size_t>(std::upper_bound(frequency.begin(), frequency.end(), end) - frequency.begin()));
  const Windows windows = windows_by(place, h, frequency.size());
  Plot plot{.title = fmt::format("Waterfall of {}: amplitudes along the run", h.channel),
            .x = {.label = "frequency", .unit = "Hz", .least = 0, .greatest = end},
            .y = over_speed ? Axis{.label = "speed of " + m.link, .unit = m.speed_unit.name}
                            : Axis{.label = "time", .unit = "s"},
            .note = over_speed
                        ? "Of windows at like speeds the larger amplitude; grey: orders of the turn of " + m.link + "."
                        : "The speed hardly changes: over time.",
            .wide = true,
            .map = ColourMap{"amplitude", "N·m", frequency, windows.at, windows.amplitude}};
  for (const Mode& mode : m.modes)
    if (const double f = hertz(mode.magnitude()); f <= end)
      plot.bands.push_back({f, f, fmt::format("mode {}", mode.number), Role::orange});
  if (!over_speed) return plot;
  for (const ExcitationLine* line : lines_drawn(m)) {
    if (line->fixed != 0) continue;
    const double per_unit = line->order * hertz(m.speed_unit.size);
    const double low = windows.at.front(), high = std::min(windows.at.back(), end / per_unit);
    if (low < high)
      plot.series.push_back({.name = fmt::format("order {:g}", line->order),
                             .role = Role::rigid,
                             .x = {per_unit * low, per_unit * high},
                             .y = {low, high},
                             .dashed = true,
                             .text_at_end = line->label});
  }
  return plot;
}

Rows critical_table(const ModesStudy& m) {
  const std::vector<std::size_t> severest = severest_critical(m, critical_shown);
  return table_of("critical_speeds",
                  fmt::format("Critical speeds within {}, the severest first",
                              speed_range(m.slowest, m.fastest, m.speed_unit)),
                  m.critical)
      .headed(fmt::format("critical speeds within {} ({} of {}, the severest first; --range takes others)",
                          speed_range(m.slowest, m.fastest, m.speed_unit), severest.size(), m.critical.size()))
      .text_in(0)
      .people_see(severest)
      .column("speed", fmt::format("order meets mode at [{}]", m.speed_unit.name), &CriticalSpeed::speed,
              {.factor = m.speed_unit.of(1)})
      .column("peak", fmt::format("largest response at [{}]", m.speed_unit.name), &CriticalSpeed::peak,
              {.factor = m.speed_unit.of(1), .otherwise = "no peak"})
      .column("mode", "mode", &CriticalSpeed::mode)
      .column("order", "order", &CriticalSpeed::order, {.digits = 4, .otherwise = "unbounded"})
      .column("amplitude", "amplitude of that order there [N·m]", &CriticalSpeed::amplitude,
              {.digits = 5, .otherwise = "unbounded"})
      .column("joint", "in", [&](const CriticalSpeed& c) { return m.joint_names[c.joint]; })
      .column("share", "share of the limit [%]", [](const CriticalSpeed& c) { return c.share; },
              {.factor = 100, .digits = 4, .otherwise = "unbounded"});
}

Rows zone_table(const ModesStudy& m) {
  return table_of("parametric_zones", "Parametric instability by the varying inertia, first order", m.zones)
      .headed("parametric instability by the varying inertia, first order")
      .text_in(0)
      .column("mode", "mode", &ParametricZone::mode)
      .column("order", "order of the inertia", [&](const ParametricZone& z) { return m.excitations.order(z.harmonic); },
              {.digits = 4, .otherwise = "unbounded"})
      .column("speed", fmt::format("around [{}]", m.speed_unit.name), &ParametricZone::centre,
              {.factor = m.speed_unit.of(1)})
      .column("variation", "variation ε", &ParametricZone::variation, {.digits = 4, .otherwise = "unbounded"})
      .only_for_people(fmt::format("half width [{}]", m.speed_unit.name),
                       [](const ParametricZone& z) { return z.centre * z.half_width; },
                       {.factor = m.speed_unit.of(1), .digits = 4})
      .column("relative_half_width", "state", &ParametricZone::half_width,
              [](double half_width) { return half_width > 0 ? "unstable inside" : "closed by damping"; });
}

}  // namespace kurbel::modes
