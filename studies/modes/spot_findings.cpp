// spot_findings.cpp — spot checks in words, tables and plots.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "studies/claims/headline.h"
#include "studies/findings/plots.h"
#include "studies/findings/rows.h"
#include "studies/modes/modes_plots.h"

namespace kurbel::modes {
namespace {

constexpr std::size_t joints_reported = 1000, joints_shown = 12;

const JointResponse& really(const SpotCheck& spot, std::size_t j) { return spot.cycle->joints[j]; }

// In the cycle, of the strongest order of the linear response; NaN if that is a fixed frequency.
double amplitude_of_order(const ModesStudy& m, const SpotCheck& spot, std::size_t j) {
  const double harmonic = m.excitations.order(spot.linear.joints[j].dominant) / spot.cycle_order;
  const auto r = static_cast<std::size_t>(std::lround(harmonic));
  if (r == 0 || r >= spot.cycle->orders[j].size() || std::abs(harmonic - std::round(harmonic)) > 1e-6) return NAN;
  return std::abs(spot.cycle->orders[j][r]);
}

std::string difference_text(const SpotCheck& spot, std::size_t j) {
  const double cycle = really(spot, j).peak, difference = spot.difference(j);
  if (!std::isfinite(difference)) return "unbounded";
  const double share = 100 * difference / cycle;
  if (std::abs(share) < 10) return fmt::format("{:+.2g} %", share);
  return share < 1000 ? fmt::format("{:+.0f} %", share) : fmt::format("{:.3g} times that", share / 100 + 1);
}

// The joint whose linear response is the farthest off, of those that carry much.
std::size_t farthest_off(const SpotCheck& spot) {
  constexpr double much = 0.1;  // of the largest torque
  double largest = 0, most = -1;
  std::size_t joint = spot.joint;
  for (const JointResponse& r : spot.cycle->joints) largest = std::max(largest, r.peak);
  for (std::size_t j = 0; j < spot.cycle->joints.size(); ++j)
    if (const double peak = really(spot, j).peak; peak >= much * largest && std::abs(spot.difference(j)) > most * peak)
      most = std::abs(spot.difference(j)) / peak, joint = j;
  return joint;
}

std::string sentence(const ModesStudy& m, const SpotCheck& spot) {
  const std::string begin = fmt::format("spot check at {}: ", m.speed_unit.text(spot.speed, 5));
  const std::string linear = torque_text(spot.linear.joints[spot.joint].peak);
  if (!spot.cycle)
    return begin + fmt::format("no nonlinear cycle was found beside the linear {} in {}: {}", linear,
                               m.joint_names[spot.joint], spot.why);
  std::string text =
      begin +
      fmt::format("the torque of {} has an amplitude of {} in the nonlinear cycle, {} in the linear response ({})",
                  m.joint_names[spot.joint], torque_text(really(spot, spot.joint).peak), linear,
                  difference_text(spot, spot.joint));
  if (const std::size_t j = farthest_off(spot); j != spot.joint)
    text += fmt::format("; the largest difference is in {}: {}", m.joint_names[j], difference_text(spot, j));
  if (!spot.stable) text += "; the cycle is unstable: a machine held at this speed leaves it";
  return headline(text);
}

// A joint at one of the speeds.
struct Line {
  const SpotCheck* spot = nullptr;
  std::size_t joint = 0;
};

Rows spot_table(const ModesStudy& m) {
  std::vector<Line> lines;
  for (const SpotCheck& spot : m.spots)
    for (std::size_t j = 0; spot.cycle && j < std::min(joints_shown, m.joint_names.size()); ++j)
      lines.push_back({&spot, j});
  const ReadAs torque{.digits = 5, .otherwise = "unbounded"};
  const auto of = [](auto get) { return [get](const Line& l) { return get(*l.spot, l.joint); }; };
  const auto linear = [](const Line& l) -> const JointResponse& { return l.spot->linear.joints[l.joint]; };
  return table_of("", "Spot checks: the linear response against the nonlinear cycle", std::move(lines))
      .not_on_terminal()
      .text_in(1)
      .only_for_people("joint", [&m](const Line& l) { return m.joint_names[l.joint]; })
      .only_for_people(
          fmt::format("speed [{}]", m.speed_unit.name), [](const Line& l) { return l.spot->speed; },
          ReadAs{.factor = m.speed_unit.of(1), .digits = 5})
      .only_for_people(
          "peak, linear [N·m]", [linear](const Line& l) { return linear(l).peak; }, torque)
      .only_for_people("in the cycle", of([](const SpotCheck& s, std::size_t j) { return really(s, j).peak; }), torque)
      .only_for_people("linear − cycle", of([](const SpotCheck& s, std::size_t j) { return s.difference(j); }),
                       ReadAs{.digits = 3, .otherwise = "unbounded"})
      .only_for_people(
          "mean, linear", [linear](const Line& l) { return linear(l).mean; }, torque)
      .only_for_people("in the cycle", of([](const SpotCheck& s, std::size_t j) { return really(s, j).mean; }), torque)
      .only_for_people("order",
                       [&m, linear](const Line& l) {
                         const double order = m.excitations.order(linear(l).dominant);
                         return order > 0 ? read_as(order, ReadAs{.digits = 4}) : std::string("—");
                       })
      .only_for_people(
          "its amplitude", [linear](const Line& l) { return linear(l).dominant_amplitude; }, torque)
      .only_for_people("in the cycle",
                       of([&m](const SpotCheck& s, std::size_t j) { return amplitude_of_order(m, s, j); }),
                       ReadAs{.digits = 5});
}

Record spot_record(const ModesStudy& m, const SpotCheck& spot) {
  Record record = {{"speed", spot.speed},
                   {"found", spot.cycle.has_value()},
                   {"joint", m.joint_names[spot.joint]},
                   {"use", spot.share},
                   {"why", spot.why}};
  if (!spot.cycle) return record;
  record.push_back({"stable", spot.stable});
  record.push_back({"acceleration", spot.acceleration});
  record.push_back({"joints", each(numbers_below(std::min(joints_reported, m.joint_names.size())), [&](std::size_t j) {
                      const JointResponse& linear = spot.linear.joints[j];
                      return Record{{"joint", m.joint_names[j]},
                                    {"mean", linear.mean},
                                    {"cycle_mean", really(spot, j).mean},
                                    {"peak", linear.peak},
                                    {"cycle_peak", Estimate{really(spot, j).peak, spot.error(j)}},
                                    {"linear_error", spot.difference(j)},
                                    {"order", m.excitations.order(linear.dominant)},
                                    {"amplitude", linear.dominant_amplitude},
                                    {"cycle_amplitude", amplitude_of_order(m, spot, j)}};
                    })});
  return record;
}

// The one with the highest utilisation; among requested speeds only, the one with the largest error of the linear response.
const SpotCheck* spot_to_report(const ModesStudy& m) {
  const SpotCheck* found = nullptr;
  const auto off = [](const SpotCheck& s) { return std::abs(s.difference(s.joint)) / really(s, s.joint).peak; };
  const auto before = [&](const SpotCheck& a, const SpotCheck& b) {
    return a.share || b.share ? a.share.value_or(0) > b.share.value_or(0) : off(a) > off(b);
  };
  for (const SpotCheck& spot : m.spots)
    if (spot.cycle && (!found || before(spot, *found))) found = &spot;
  return found;
}

}  // namespace

void say_spots(Findings& f, Chapter in, const ModesStudy& m) {
  if (m.spots.empty()) return;
  Sentences lines{.lines = {}, .title = "Spot checks by the nonlinear cycle", .indent = "  ", .apart = true};
  for (const SpotCheck& spot : m.spots) lines.lines.push_back(sentence(m, spot));
  f.say(in, std::move(lines));
  f.say(in, spot_table(m));
  f.record("spot_checks", each(m.spots, [&m](const SpotCheck& spot) { return spot_record(m, spot); }));
  if (const SpotCheck* spot = spot_to_report(m))
    f.key(fmt::format("amplitude at {}, nonlinear", m.speed_unit.text(spot->speed, 5)),
          {really(*spot, spot->joint).peak, spot->error(spot->joint)}, "spot_amplitude",
          fmt::format("{}; linear {}", m.joint_names[spot->joint], difference_text(*spot, spot->joint)), 5);
}

void mark_spots(const ModesStudy& m, std::size_t joint, Plot& plot) {
  std::vector<const SpotCheck*> found;
  for (const SpotCheck& spot : m.spots)
    if (spot.cycle) found.push_back(&spot);
  if (found.empty()) return;
  plot.series.push_back(marks(series_of(
      "in the nonlinear cycle", Role::orange, found, [&m](const SpotCheck* s) { return m.speed_unit.of(s->speed); },
      [joint](const SpotCheck* s) { return really(*s, joint).peak; })));
}

}  // namespace kurbel::modes
