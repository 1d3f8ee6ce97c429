// order_findings.cpp — orders as bars over the order, in tables and for programs.
#include "studies/steady/order_findings.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "engine/base/find_by.h"
#include "engine/numerics/angles.h"
#include "studies/findings/figure_text.h"
#include "studies/findings/plots.h"
#include "studies/run/compare.h"

namespace kurbel {
namespace {

constexpr std::size_t most_order_plots = 8;

struct ReportedOrder {
  const OrdersOf* of = nullptr;
  Order order;
};

// Shafts that turn together are listed once.
std::vector<ReportedOrder> reported_orders(const SteadyCycle& c) {
  std::vector<ReportedOrder> rows;
  for (const OrdersOf& of : c.orders)
    if (!of.repeated)
      for (Order& o : of.reporting()) rows.push_back({&of, std::move(o)});
  return rows;
}

// "Orders per turn of crank", "Orders of the vibration".
std::string counted(const SteadyStudy& s, const SteadyCycle& c) {
  return c.point.vibrates() ? "of the vibration" : "per turn of " + s.link;
}

Rows orders_table(const SteadyStudy& s, const SteadyCycle& c) {
  const SpeedUnit speed = c.model->scene.speed_unit;
  const auto cells = [speed](const ReportedOrder& row) {
    return figure_cells(row.order.amplitude(), row.of->unit, speed);
  };
  const auto phase = [](const ReportedOrder& row) {
    const std::optional<Estimate> found = row.order.phase();
    return found ? std::optional(in_degrees * *found) : std::nullopt;
  };
  return table_of("", fmt::format("Orders {}, {} model", counted(s, c), c.label), reported_orders(c))
      .fold()
      .not_on_terminal()
      .explained_by([](const ReportedOrder& row) {
        return fmt::format("{}_order.{:g}.{}", row.of->channel.what.channel, row.order.order, row.of->channel.of);
      })
      .only_for_people("quantity", [](const ReportedOrder& row) { return row.of->channel.text; })
      .only_for_people("order", [](const ReportedOrder& row) { return row.order.order; })
      .only_for_people("amplitude", [&](const ReportedOrder& row) { return cells(row).value; })
      .only_for_people("numerical error", [&](const ReportedOrder& row) { return cells(row).error; })
      .only_for_people("unit", [&](const ReportedOrder& row) { return cells(row).unit; })
      .only_for_people(
          "phase [°]",
          [&](const ReportedOrder& row) { return phase(row) ? figure_text(*phase(row)).value : std::string("—"); })
      .only_for_people("numerical error", [&](const ReportedOrder& row) {
        return phase(row) ? figure_text(*phase(row)).error : std::string();
      });
}

const OrdersOf* orders_named(const SteadyCycle& c, const std::string& name) {
  return find_by(c.orders, &OrdersOf::channel, name);
}

// All orders up to the highest significant one of the models; empty: nothing oscillates.
std::optional<Plot> bars_of_orders(const SteadyStudy& s, const std::string& name, const std::string& title) {
  Plot plot{.title = title,
            .x = {fmt::format("order ({})", counted(s, s.cycles.back())), ""},
            .y = {"amplitude", ""},
            .bars = true};
  double last = 0;
  for (const SteadyCycle& c : s.cycles)
    if (const OrdersOf* of = orders_named(c, name))
      for (const Order& o : of->reporting()) last = std::max(last, o.order);
  if (!(last > 0)) return {};
  std::string unit;
  for (const SteadyCycle& c : s.cycles)
    if (const OrdersOf* of = orders_named(c, name)) {
      Series& bars =
          plot.series.emplace_back(Series{.name = c.label, .role = is_elastic(*c.model) ? Role::elastic : Role::rigid});
      for (const Order& o : of->orders)
        if (o.order <= last) bars.add(o.order, std::abs(o.wave));
      unit = of->unit;
      const FigureCells mean = figure_cells({of->mean}, unit, c.model->scene.speed_unit);
      const std::vector<Order> reported = of->reporting();
      plot.note += fmt::format("{}{}: mean {} {}, ", plot.note.empty() ? "" : "; ", c.label, mean.value, mean.unit);
      plot.note += reported.empty()
                       ? "no vibration above its error"
                       : fmt::format("orders that matter contain {:.6g} % of the oscillation's mean square",
                                     100 * of->captured(reported));
    }
  plot.note += ".";
  return in_readable_unit(std::move(plot), unit, s.cycles.back().model->scene.speed_unit);
}

std::vector<Plot> order_plots(const SteadyStudy& s) {
  std::vector<Plot> plots;
  const auto add = [&](const std::string& name, const std::string& title) {
    if (plots.size() < most_order_plots)
      if (auto plot = bars_of_orders(s, name, title)) plots.push_back(std::move(*plot));
  };
  add("speed." + s.link, "Orders in the speed of " + s.link);
  for (const OrdersOf& of : s.cycles.back().orders)
    if (of.channel.what == quantities::torque) add(of.channel.text, "Orders in the torque of " + of.channel.of);
  return plots;
}

}  // namespace

List orders_for_programs(const SteadyCycle& c) {
  return each(c.orders, [](const OrdersOf& of) {
    const std::vector<Order> reported = of.reporting();
    return Record{
        {"name", of.channel.text},
        {"unit", of.unit},
        {"mean", of.mean},
        {"captured_of_amplitude", reported.empty() ? Value() : Value(of.captured(reported))},  // of rounding: nothing
        {"orders", each(reported, [](const Order& o) {
           const std::optional<Estimate> phase = o.phase();
           return Record{{"order", o.order},
                         {"amplitude", std::abs(o.wave)},
                         {"phase", phase ? Value(phase->value) : Value()},
                         {"error", o.error}};
         })}};
  });
}

void say_orders(Findings& f, Chapter in, const SteadyStudy& s) {
  f.draw(in, [&s] { return order_plots(s); });
  for (const SteadyCycle& c : s.cycles)
    if (c.found) f.say(in, orders_table(s, c));
}

}  // namespace kurbel
