#include "studies/modes/campbell.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "studies/findings/plots.h"
#include "studies/findings/rows.h"
#include "studies/modes/critical_speeds.h"
#include "studies/modes/modes_plots.h"

namespace kurbel::modes {
namespace {

constexpr std::size_t critical_shown = 16, rays_shown = 10, modes_named = 12;
constexpr double mostly = 0.9;         // of a mode's energy in own states: what moves is beside the point
constexpr double least_circle = 1e-3;  // of the severest critical speed's share
constexpr double least_ray = 0.02;     // of the strongest order's torque

std::string readable(std::string name) {
  std::replace(name.begin(), name.end(), '_', ' ');
  return name;
}

const Mode* mode_of(const ModesStudy& m, int number) {
  for (const Mode& mode : m.modes)
    if (mode.number == number) return &mode;
  return nullptr;
}

// What excites an order at the operating speed most: components by the sums of their torques.
std::string source_of(const ModesStudy& m, std::size_t harmonic) {
  std::map<std::string, double> strength;
  const double speed = m.drive.at.speed;
  const bool by_shaft = m.drive.size() == static_cast<Eigen::Index>(m.shaft_names.size());
  for (const OrderSource& s : m.excitations.at_speed(speed)) {
    const bool on_shaft = s.kind == LeftOver::torque && by_shaft && s.index >= 0;
    if (on_shaft || s.kind == LeftOver::torque || s.kind == LeftOver::joint_torque)
      strength[on_shaft ? m.shaft_names[static_cast<std::size_t>(s.index)] : s.component] +=
          std::abs(s.at(harmonic, speed));
  }
  std::string name;
  double most = 0;
  for (const auto& [component, sum] : strength)
    if (sum > most * (1 + 1e-9)) most = sum, name = component;
  const auto like =
      std::count_if(strength.begin(), strength.end(), [&](const auto& s) { return s.second > 0.5 * most; });
  if (name.empty() || like < 2) return readable(name);
  // cylinder1 … cylinder4: "4 × cylinder"
  const std::string stem = name.substr(0, name.find_last_not_of("0123456789") + 1);
  const bool alike = std::all_of(strength.begin(), strength.end(), [&](const auto& s) {
    return !(s.second > 0.5 * most) || s.first.substr(0, s.first.find_last_not_of("0123456789") + 1) == stem;
  });
  return alike && !stem.empty() ? fmt::format("{} × {}", like, readable(stem))
                                : fmt::format("{} and {} more", readable(name), like - 1);
}

// Orders of the severest critical speeds first, then those with the largest torques.
std::vector<std::size_t> orders_shown(const ModesStudy& m) {
  std::vector<std::size_t> shown;
  const auto show = [&](std::size_t r) {
    if (shown.size() < rays_shown && std::find(shown.begin(), shown.end(), r) == shown.end()) shown.push_back(r);
  };
  const std::vector<std::size_t> severe = severest_critical(m, 12);
  for (const std::size_t i : severe)
    if (const double most = m.critical[severe.front()].share;
        std::isinf(most) || m.critical[i].share > least_circle * most)
      show(m.critical[i].harmonic);
  std::vector<std::pair<double, std::size_t>> strength;
  for (std::size_t r = 1; r <= m.excitations.harmonics; ++r)
    strength.emplace_back(-m.excitations.strength(r, m.drive.at.speed), r);
  std::sort(strength.begin(), strength.end());
  for (const auto& [negative, r] : strength)
    if (negative < least_ray * strength.front().first) show(r);
  std::sort(shown.begin(), shown.end());
  return shown;
}

// Up to the highest mode that one of the severe critical speeds belongs to, and never below the first mode [Hz].
double top_of(const ModesStudy& m) {
  double top = m.modes.empty() ? 0 : hertz(m.modes.front().magnitude());
  const std::vector<std::size_t> severe = severest_critical(m, 16);
  for (const std::size_t i : severe)
    if (m.critical[i].share > 0.05 * m.critical[severe.front()].share)
      top = std::max(top, hertz(m.critical[i].order * m.critical[i].speed));
  // Up to where the strongest order is at the operating speed, unless that leaves the modes no room.
  constexpr double most_above = 6;
  std::size_t strongest = 0;
  double most = 0;
  for (std::size_t r = 1; r <= m.excitations.harmonics; ++r)
    if (const double size = m.excitations.strength(r, m.drive.at.speed); size > most * (1 + 1e-9))
      most = size, strongest = r;
  if (strongest > 0)
    top = std::max(top, std::min(most_above * top, m.excitations.order(strongest) * hertz(std::abs(m.drive.at.speed))));
  if (severe.empty())
    for (const std::size_t r : orders_shown(m)) top = std::max(top, m.excitations.order(r) * hertz(m.fastest));
  return 1.15 * top;
}

// "Above the diagram, where no order of weight meets a mode: mode 2 at 481.8 Hz.": what is not drawn is said.
std::string modes_above(const ModesStudy& m, double top) {
  constexpr std::size_t most_told = 4;
  std::string text;
  std::size_t number = 0;
  for (const Mode& mode : m.modes) {
    const double f = hertz(frequency_of_resonance(m.drive, mode));
    if (f <= top) continue;
    if (++number <= most_told) text += fmt::format("{}mode {} at {:.4g} Hz", number == 1 ? "" : ", ", mode.number, f);
  }
  if (number > most_told) text += fmt::format(" and {} more", number - most_told);
  return number == 0 ? "" : "Above the diagram, where no order of weight meets a mode: " + text + ". ";
}

// From the origin to the edge of the diagram.
Series ray(const ModesStudy& m, double order, double top, std::string name, Role role) {
  const double end = std::min(m.fastest, top / (order * hertz(1)));
  return {.name = name,
          .role = role,
          .x = {m.speed_unit.of(m.slowest), m.speed_unit.of(end)},
          .y = {order * hertz(m.slowest), order * hertz(end)},
          .text_at_end = name};
}

std::string words_of(const ModesStudy& m, const CriticalSpeed& c) {
  const Mode* mode = mode_of(m, c.mode);
  return fmt::format(
      "{}{}\norder {:g}{}\nmode {}{}\n{} in {}\n{:.3g} % of what it may bear", m.speed_unit.text(c.speed, 4),
      c.peak ? fmt::format(", swings most at {}", m.speed_unit.text(*c.peak, 4)) : "", c.order,
      source_of(m, c.harmonic).empty() ? "" : " of " + source_of(m, c.harmonic), c.mode,
      mode ? ": " + name_of(m, *mode) : "", torque_text(c.amplitude), readable(m.joint_names[c.joint]), 100 * c.share);
}

// Circles whose areas go with their severity.
Series circles(const ModesStudy& m, const std::vector<std::size_t>& orders) {
  Series s{.name = "critical speeds, larger ones severer", .role = Role::vermillion};
  double most = 0;
  for (const CriticalSpeed& c : m.critical) most = std::max(most, c.share);
  for (const CriticalSpeed& c : m.critical) {
    if (std::find(orders.begin(), orders.end(), c.harmonic) == orders.end()) continue;
    if (!(c.share > least_circle * most) && !std::isinf(c.share)) continue;
    s.add(m.speed_unit.of(c.speed), hertz(c.order * c.speed));
    s.sizes.push_back(std::isinf(c.share) ? 3 : std::isinf(most) ? 1 : 0.7 + 2.3 * std::sqrt(c.share / most));
    s.labels.push_back(words_of(m, c));
  }
  return marks(s);
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
      bands.push_back({m.speed_unit.of(m.sweep[s.begin].speed), m.speed_unit.of(m.sweep[s.end - 1].speed), "not kept",
                       Role::rigid});
  const double speed = m.speed_unit.of(std::abs(m.drive.at.speed));
  if (speed > 0)
    bands.push_back(
        {speed, speed, "operating speed " + m.speed_unit.text(std::abs(m.drive.at.speed), 4), Role::reference});
  return bands;
}

// Windows of a run by their places, ascending; of those within an eightieth of the range the larger amplitude.
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

// What swings against what.
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
  const auto name = [&](int i) { return readable(m.shaft_names[static_cast<std::size_t>(i)]); };
  if (other < 0 || energy[static_cast<std::size_t>(other)] < 0.03) return name(one);
  return name(one) + " against " + name(other);
}

}  // namespace

std::string name_of(const ModesStudy& m, const Mode& mode) {
  if (!mode.of_own_states) return moving_parts(m, mode);
  for (const EnergyStore& store : energy_stores(m, mode))
    if (store.name.find(" of ") != std::string::npos)
      return mode.energy.in_own() > mostly ? store.name : fmt::format("{} and {}", store.name, moving_parts(m, mode));
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
  Plot plot{
      .title = "Campbell diagram: where excitation orders meet the modes",
      .x = {.label = "speed of " + m.link,
            .unit = m.speed_unit.name,
            .least = m.speed_unit.of(m.slowest),
            .greatest = m.speed_unit.of(m.fastest)},
      .y = {.label = "frequency", .unit = "Hz", .least = 0, .greatest = top},
      .note = "Level lines: modes. Grey rays: orders of the turn of " + m.link + ", with what excites them most. ",
      .wide = true,
      .bands = bands_of(m)};
  const std::vector<std::size_t> orders = orders_shown(m);
  for (const std::size_t r : orders) {
    if (m.excitations.order(r) * hertz(m.slowest) >= top) continue;
    const std::string source = source_of(m, r);
    plot.series.push_back(ray(m, m.excitations.order(r), top,
                              fmt::format("{:g}{}", m.excitations.order(r), source.empty() ? "" : " · " + source),
                              Role::rigid));
  }
  for (const GearMesh& mesh : m.excitations.meshes) {
    Series meshing = dashed(ray(m, mesh.order, top, fmt::format("mesh {}", readable(mesh.name)), Role::reference));
    if (meshing.x.back() - plot.x.least.value_or(0) > 0.15 * (m.speed_unit.of(m.fastest) - plot.x.least.value_or(0)))
      plot.series.push_back(std::move(meshing));
    else
      plot.note += fmt::format("Mesh of {}: order {:.5g}, mostly above the diagram. ", readable(mesh.name), mesh.order);
  }
  std::size_t named = 0;
  for (const Mode& mode : m.modes) {
    const double f = hertz(frequency_of_resonance(m.drive, mode));
    if (f > top || named >= modes_named) continue;
    plot.series.push_back({.name = fmt::format("mode {}: {}", mode.number, name_of(m, mode)),
                           .role = further_role(named++),
                           .x = {m.speed_unit.of(m.slowest), m.speed_unit.of(m.fastest)},
                           .y = {f, f},
                           .text_at_start = fmt::format("{}  {}, {:.4g} Hz", mode.number, name_of(m, mode), f)});
  }
  for (const FrequencySource& f : m.excitations.by_frequency)
    if (hertz(f.omega) <= top)
      plot.series.push_back(dashed({.name = "frequency of " + readable(f.component),
                                    .role = Role::reference,
                                    .x = {m.speed_unit.of(m.slowest), m.speed_unit.of(m.fastest)},
                                    .y = {hertz(f.omega), hertz(f.omega)},
                                    .text_at_end = readable(f.component)}));
  if (std::any_of(plot.series.begin(), plot.series.end(), [](const Series& s) { return s.dashed; }))
    plot.note += "Dotted: frequencies and tooth meshes. ";
  Series met = circles(m, orders);
  if (!met.x.empty()) {
    plot.note += "Circles: critical speeds, the larger the more of what its joint may bear. ";
    plot.series.push_back(std::move(met));
  }
  plot.note += modes_above(m, top);
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
  for (const std::size_t r : orders_shown(m)) {
    const double per_unit = m.excitations.order(r) * hertz(m.speed_unit.size);
    const double low = windows.at.front(), high = std::min(windows.at.back(), end / per_unit);
    if (low < high)
      plot.series.push_back({.name = fmt::format("order {:g}", m.excitations.order(r)),
                             .role = Role::rigid,
                             .x = {per_unit * low, per_unit * high},
                             .y = {low, high},
                             .dashed = true,
                             .text_at_end = fmt::format("{:g}", m.excitations.order(r))});
  }
  return plot;
}

Rows critical_table(const ModesStudy& m) {
  const std::vector<std::size_t> severest = severest_critical(m, critical_shown);
  return table_of("critical_speeds", "Critical speeds, the severest first", m.critical)
      .headed(fmt::format("critical speeds ({} of {}, the severest first)", severest.size(), m.critical.size()))
      .text_in(0)
      .people_see(severest)
      .column("speed", fmt::format("order meets mode at [{}]", m.speed_unit.name), &CriticalSpeed::speed,
              {.factor = m.speed_unit.of(1)})
      .column("peak", fmt::format("swings most at [{}]", m.speed_unit.name), &CriticalSpeed::peak,
              {.factor = m.speed_unit.of(1), .otherwise = "no peak"})
      .column("mode", "mode", &CriticalSpeed::mode)
      .column("order", "order", &CriticalSpeed::order, {.digits = 4, .otherwise = "unbounded"})
      .column("amplitude", "amplitude of that order there [N·m]", &CriticalSpeed::amplitude,
              {.digits = 5, .otherwise = "unbounded"})
      .column("joint", "in", [&](const CriticalSpeed& c) { return m.joint_names[c.joint]; })
      .column("share", "of what it may bear [%]", [](const CriticalSpeed& c) { return c.share; },
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
