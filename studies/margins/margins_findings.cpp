// margins_findings.cpp — tables and sentences on separation margins.
#include "studies/margins/margins_findings.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "engine/numerics/angles.h"
#include "studies/claims/ranges.h"
#include "studies/findings/figure_text.h"

namespace kurbel {
namespace {

constexpr std::size_t nearest_shown = 12, most_shown = 60;

std::string percent(double margin) {
  if (margin == 0) return "0";
  return std::isfinite(margin) ? fmt::format("{:+.4g}", 100 * margin) : std::string("—");
}

std::vector<std::size_t> shown(const Margins& m) {
  const auto within = static_cast<std::size_t>(
      std::count_if(m.rows.begin(), m.rows.end(), [](const Margin& row) { return row.within; }));
  std::vector<std::size_t> rows = numbers_below(std::min(m.rows.size(), std::max(nearest_shown, within)));
  if (rows.size() > most_shown) rows.resize(most_shown);
  return rows;
}

// "mode 1 (19.97 Hz) and 1×, which meet at 1198 rpm, −17.6 %"; "… (at the largest response, 1150 rpm, −20.9 %)"
std::string pair_text(const Margins& m, const Margin& row, const SpeedUnit& unit) {
  const MarginMode& mode = m.modes[row.mode];
  std::string text = fmt::format("mode {} ({:.4g} Hz) and {}", mode.number, mode.omega / turn, m.lines[row.line].label);
  if (row.crossing) text += fmt::format(", which meet at {}", unit.text(*row.crossing, 4));
  text += row.margin == 0 ? ", within the range" : fmt::format(", {} %", percent(row.margin));
  if (!row.largest) return text;
  return text +
         fmt::format(" (at the largest response, {}, {} %)", unit.text(*row.largest, 4), percent(row.at_largest));
}

// NaN if not computed.
double amplitude_of(const Margin& row) {
  return row.response && row.not_assessed.empty() ? row.response->amplitude : std::nan("");
}
double share_of_joint(const Margin& row) {
  return row.response && row.not_assessed.empty() ? row.response->share : std::nan("");
}

// "60.75 N·m in coupling, 5.91 % of its limit"
std::string severity_text(const Margin& row) {
  if (!row.not_assessed.empty()) return "not assessed: " + row.not_assessed;
  if (!std::isfinite(row.response->amplitude)) return "unbounded in " + row.response->joint + ": nothing damps it";
  std::string text = with_unit(row.response->amplitude, "N*m", 4) + " in " + row.response->joint;
  if (std::isfinite(row.response->share)) text += fmt::format(", {:.3g} % of the limit", 100 * row.response->share);
  return text;
}

// Of the pairs within the margin the nearest whose response is assessed, else the nearest.
const Margin& leading(const Margins& m) {
  const auto assessed = std::find_if(m.rows.begin(), m.rows.end(),
                                     [](const Margin& row) { return row.within && row.not_assessed.empty(); });
  return assessed == m.rows.end() ? m.rows.front() : *assessed;
}

}  // namespace

Rows margin_table(const Margins& m, const SpeedUnit& unit) {
  const std::vector<std::size_t> reported = shown(m);
  const std::string heading = fmt::format(
      "separation margins at {} ({}): {} of {} pairs of a mode and an excitation, the nearest first",
      speed_range(m.speeds.slowest, m.speeds.fastest, unit, 5), m.speeds.words, reported.size(), m.rows.size());
  const auto mode = [&m](const Margin& row) -> const MarginMode& { return m.modes[row.mode]; };
  const auto line = [&m](const Margin& row) -> const ExcitationLine& { return m.lines[row.line]; };
  auto table = table_of("margins", "Separation margins", m.rows);
  table.headed(heading).text_in(3).people_see(reported);
  table.column("mode", "mode", [&](const Margin& row) { return mode(row).number; })
      .also_in_file()
      .column("excitation", "excitation", [&](const Margin& row) { return line(row).label; })
      .also_in_file()
      .column("source", "of", [&](const Margin& row) { return line(row).source; })
      .also_in_file()
      .column("frequency", "f_n [Hz]", [&](const Margin& row) { return mode(row).omega / turn; }, {.digits = 5})
      .also_in_file("Hz")
      .only_for_programs("order", [&](const Margin& row) { return line(row).order; })
      .also_in_file()
      .only_for_programs("fixed_frequency", [&](const Margin& row) { return line(row).fixed / turn; })
      .also_in_file("Hz")
      .only_for_people(fmt::format("meet at [{}]", unit.name),
                       [&](const Margin& row) {
                         const ReadAs speed{.factor = unit.of(1), .otherwise = "none"};
                         return read_as(row.crossing, speed) +
                                (row.further_crossing ? " and " + read_as(row.further_crossing, speed) : "");
                       })
      .only_for_programs("crossing", &Margin::crossing)
      .also_in_file("rad/s")
      .only_for_programs("further_crossing", &Margin::further_crossing)
      .also_in_file("rad/s");
  if (std::any_of(m.rows.begin(), m.rows.end(), [](const Margin& row) { return row.largest.has_value(); }))
    table
        .only_for_people(
            fmt::format("largest response at [{}]", unit.name),
            [&](const Margin& row) { return read_as(row.largest, {.factor = unit.of(1), .otherwise = ""}); })
        .only_for_people("margin at it [%]", [](const Margin& row) { return percent(row.at_largest); });
  table.only_for_programs("largest_response", &Margin::largest)
      .also_in_file("rad/s")
      .only_for_programs("margin_at_largest", &Margin::at_largest)
      .also_in_file()
      .column("margin", "margin [%]", &Margin::margin, percent)
      .also_in_file()
      .column("within", fmt::format("± {:.3g} %", 100 * m.speeds.margin), &Margin::within,
              [](bool within) { return within ? "WITHIN" : "kept"; });
  if (!m.tolerances.empty())
    table.only_for_programs("margin_low", &Margin::low)
        .also_in_file()
        .only_for_programs("margin_high", &Margin::high)
        .also_in_file()
        .only_for_people("95 % of it by tolerances [%]",
                         [](const Margin& row) { return percent(row.low) + " … " + percent(row.high); })
        .column("kept_probability", "kept with probability [%]",
                [](const Margin& row) { return row.kept ? row.kept->value : std::nan(""); },
                {.factor = 100, .digits = 3})
        .also_in_file();
  return table.only_for_programs("amplitude", amplitude_of)
      .also_in_file("N*m")
      .only_for_programs("joint", [](const Margin& row) { return row.response ? row.response->joint : std::string(); })
      .only_for_programs("share", share_of_joint)
      .also_in_file()
      .column("damping_ratio", "ζ", [&](const Margin& row) { return mode(row).ratio; }, {.digits = 3})
      .also_in_file()
      .column("damping", "damping by", [&](const Margin& row) { return mode(row).damping; })
      .only_for_programs("assessed", [](const Margin& row) { return row.not_assessed.empty(); })
      .only_for_programs("not_assessed", &Margin::not_assessed)
      .only_for_people("severity where they meet", severity_text);
}

Record operating_range(const Margins& m) {
  return {{"slowest", m.speeds.slowest},
          {"fastest", m.speeds.fastest},
          {"margin", m.speeds.margin},
          {"of", m.speeds.words},
          {"tolerances", List(m.tolerances.begin(), m.tolerances.end())}};
}

std::optional<Claim> margin_claim(const Margins& m, const SpeedUnit& unit) {
  if (!m.speeds.said || m.rows.empty()) return {};
  const Margin& front = m.rows.front();
  const Evidence nearest_row{.value = std::min(std::abs(front.margin), std::abs(front.at_largest)),
                             .limit = m.speeds.margin};
  const std::string range = speed_range(m.speeds.slowest, m.speeds.fastest, unit, 5),
                    limit = fmt::format("± {:.3g} %", 100 * m.speeds.margin);
  const auto within = std::count_if(m.rows.begin(), m.rows.end(), [](const Margin& row) { return row.within; });
  const std::string nearest = pair_text(m, m.rows.front(), unit);
  double least = 1;  // probability that a margin is kept
  for (const Margin& row : m.rows)
    if (row.kept) least = std::min(least, row.kept->value);
  const std::string sure =
      least < 0.995 ? fmt::format("; with the tolerances one is kept with a probability of {:.0f} %", 100 * least) : "";
  if (within == 0)
    return claimed(Predicate::margin_kept,
                   fmt::format("Every natural frequency keeps {} from all {} excitations at {}; the nearest are {}{}",
                               limit, m.lines.size(), range, nearest, sure),
                   "", nearest_row);
  const Margin& first = leading(m);
  const std::string share =
      std::isfinite(share_of_joint(first))
          ? fmt::format(", {:.0f} % of the limit of {}", 100 * share_of_joint(first), first.response->joint)
          : "";
  const auto open = std::count_if(m.rows.begin(), m.rows.end(),
                                  [](const Margin& row) { return row.within && !row.not_assessed.empty(); });
  return claimed(Predicate::margin_missed,
                 fmt::format("{} pair{} of a natural frequency and an excitation lie{} within {} at {}: {}{}{}{}",
                             within, within == 1 ? "" : "s", within == 1 ? "s" : "", limit, range,
                             pair_text(m, first, unit), share, within > 1 ? ", and more" : "",
                             open == 0 ? "" : fmt::format("; the response is not assessed for {} of them", open)),
                 "", nearest_row);
}

}  // namespace kurbel
