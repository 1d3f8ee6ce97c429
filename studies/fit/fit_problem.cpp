// fit_problem.cpp — runs in threads, differences above their errors.
#include "studies/fit/fit_problem.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <tuple>

#include "engine/numerics/deadline.h"
#include "engine/scene/messages.h"
#include "engine/scene/quantity_place.h"
#include "engine/scene/units.h"
#include "studies/variants/in_threads.h"

namespace kurbel {
namespace {

constexpr double shortest = 1e-3, longest = 0.05, tiny = 1e-7, wanted_noise = 1e-3;

double factor_of(const std::string& unit) {
  UnitError error;
  const auto read = parse_unit(unit, error);
  return read ? read->factor : 1;
}

void require_quantity(const RecordRequest& request) {
  const Scene scene = VariedScene(request.scene, {}).at({});
  const Setting* const setting = quantity_place(scene.components, request.hold_by).setting;
  if (!setting || setting->number == 0)
    throw std::invalid_argument(fmt::format(
        "--hold: {} has no quantity {} other than 0 that could keep the speed; give one such as load.torque",
        request.scene.file, in_quotes(request.hold_by)));
}

}  // namespace

FitProblem::FitProblem(std::vector<RecordRequest> requests, const std::vector<std::string>& free, int jobs, Watch watch)
    : requests_(std::move(requests)), jobs_(jobs), watch_(std::move(watch)) {
  for (RecordRequest& request : requests_) {
    records_.push_back(read_record(request));
    if (!request.hold_by.empty()) require_quantity(request);
    if (request.hold_by.empty() || request.mean_speed) continue;
    if (request.over != Over::angle)
      throw std::invalid_argument(fmt::format("--hold: {} is over {}; a mean speed is held over the angle alone",
                                              request.file, name_of(request.over)));
    request.mean_speed = mean_speed_of(records_.back());
    if (!request.mean_speed)
      throw std::invalid_argument(
          fmt::format("--hold: {} has no speed whose mean could be held; say it: --hold \"mean speed=3000 rpm by {}\"",
                      request.file, request.hold_by));
  }
  unknowns_ = parse_unknowns(free, records_);
  for (std::size_t r = 0; r < records_.size(); ++r) {
    machines_.emplace_back(requests_[r], records_[r], r, unknowns_);
    comparisons_.emplace_back(records_[r], requests_[r].orders, r);
  }
  active.assign(records_.size(), true);
  effects.assign(records_.size(), std::nullopt);
  steps_.assign(unknowns_.size(), shortest);
  if (unknowns_.size() > values_compared())
    throw std::invalid_argument(
        fmt::format("--free: {} unknowns for {} values that are compared; give more data (points, orders, records) or "
                    "fewer unknowns",
                    unknowns_.size(), values_compared()));
}

std::size_t FitProblem::values_compared() const {
  std::size_t count = 0;
  for (const ComparedRecord& c : comparisons_) count += static_cast<std::size_t>(c.size());
  return count;
}

Eigen::VectorXd FitProblem::given() const {
  Eigen::VectorXd u = Eigen::VectorXd::Constant(size(), 0.5);
  for (std::size_t k = 0; k < unknowns_.size(); ++k) {
    const Unknown& unknown = unknowns_[k];
    const auto scaled = [&](double value) {
      return std::clamp((value - unknown.range.low) / (unknown.range.high - unknown.range.low), 0.0, 1.0);
    };
    using Kind = Unknown::Kind;
    auto& here = u[static_cast<Eigen::Index>(k)];
    if (unknown.kind == Kind::gain || unknown.kind == Kind::table_gain) {
      here = scaled(1);
    } else if (unknown.kind != Kind::key) {
      here = scaled(0);
    } else {
      const Scene scene = VariedScene(requests_[unknown.record.value_or(0)].scene, {}).at({});
      if (const Setting* const setting = quantity_place(scene.components, unknown.range.path).setting)
        here = scaled(setting->number / factor_of(unknown.range.unit));
    }
  }
  return u;
}

std::vector<Response> FitProblem::compute(const std::vector<RecordMachine>& machines, const std::vector<Item>& items) {
  std::vector<Response> responses(items.size());
  const bool whole = in_threads(items.size(), jobs_, [&]() -> Worker {
    return [&, own = machines](std::size_t i) mutable {
      const std::size_t m = items[i].machine;
      responses[i] = own[m].at(items[i].u, effects[m] ? &*effects[m] : nullptr);
      return !watch_.stopped();
    };
  });
  if (!whole) throw OutOfTime(0);
  runs_ += items.size();
  watch_.at("fit", 1 - 1 / (1 + 0.02 * static_cast<double>(runs_)));
  return responses;
}

std::vector<Response> FitProblem::responses_of(const RecordMachine& machine, const std::vector<Eigen::VectorXd>& at) {
  std::vector<Item> items;
  for (const Eigen::VectorXd& u : at) items.push_back({0, u});
  return compute({machine}, items);
}

Eigen::VectorXd FitProblem::shown(std::size_t record, const Eigen::VectorXd& u) const {
  const ComparedRecord& c = comparisons_[record];
  return c.compared(c.points_of(responses_[record], unknowns_, u));
}

Eigen::VectorXd FitProblem::stacked(const std::vector<Response>& responses, const Eigen::VectorXd& u) const {
  Eigen::VectorXd r(static_cast<Eigen::Index>(values_compared()));
  Eigen::Index begin = 0;
  for (std::size_t k = 0; k < records_.size(); ++k) {
    const ComparedRecord& c = comparisons_[k];
    r.segment(begin, c.size()).setZero();
    if (active[k])
      r.segment(begin, c.size()) =
          (c.compared(c.points_of(responses[k], unknowns_, u)) - c.data()).cwiseQuotient(c.deviation());
    begin += c.size();
  }
  return r;
}

Eigen::VectorXd FitProblem::deviations() const {
  Eigen::VectorXd all(static_cast<Eigen::Index>(values_compared()));
  Eigen::Index begin = 0;
  for (const ComparedRecord& c : comparisons_) all.segment(begin, c.size()) = c.deviation(), begin += c.size();
  return all;
}

std::optional<Eigen::VectorXd> FitProblem::residuals(const Eigen::VectorXd& u) {
  std::vector<Item> items;
  for (std::size_t r = 0; r < records_.size(); ++r)
    if (active[r]) items.push_back({r, u});
  std::vector<Response> computed = compute(machines_, items);
  responses_.resize(records_.size());
  for (std::size_t i = 0; i < items.size(); ++i) {
    const std::size_t r = items[i].machine;
    responses_[r] = std::move(computed[i]);
    if (responses_[r].failed.empty()) continue;
    failure_ = records_[r].name + ": " + responses_[r].failed;
    return {};
  }
  const Eigen::VectorXd r = stacked(responses_, u);
  if (r.allFinite()) return r;
  failure_ = "what the machine shows is not finite";
  return {};
}

std::pair<Eigen::VectorXd, Eigen::VectorXd> FitProblem::around(const Eigen::VectorXd& u, std::size_t unknown,
                                                               double step) const {
  const auto k = static_cast<Eigen::Index>(unknown);
  Eigen::VectorXd below = u, above = u;
  below[k] = std::max(0.0, u[k] - step), above[k] = std::min(1.0, u[k] + step);
  return {below, above};
}

std::optional<std::vector<FitProblem::Sides>> FitProblem::sides(const Eigen::VectorXd& u,
                                                                const std::vector<double>& steps) {
  std::vector<Item> items;
  std::vector<Sides> list(unknowns_.size());
  for (std::size_t k = 0; k < list.size(); ++k) {
    std::tie(list[k].below, list[k].above) = around(u, k, steps[k]);
    for (std::size_t r = 0; r < records_.size(); ++r)
      if (active[r] && machines_[r].depends_on(k))
        items.push_back({r, list[k].below}), items.push_back({r, list[k].above});
  }
  const std::vector<Response> computed = compute(machines_, items);
  std::size_t next = 0;
  for (std::size_t k = 0; k < list.size(); ++k) {
    std::vector<Response> below = responses_, above = responses_;
    bool below_runs = true, above_runs = true;
    for (std::size_t r = 0; r < records_.size(); ++r)
      if (active[r] && machines_[r].depends_on(k)) {
        below[r] = computed[next++], above[r] = computed[next++];
        below_runs = below_runs && below[r].failed.empty(), above_runs = above_runs && above[r].failed.empty();
        if (!below[r].failed.empty()) failure_ = records_[r].name + ": " + below[r].failed;
      }
    if (!below_runs && !above_runs) return {};
    if (!below_runs) list[k].below = u, below = responses_;
    if (!above_runs) list[k].above = u, above = responses_;
    list[k].r_below = stacked(below, list[k].below), list[k].r_above = stacked(above, list[k].above);
  }
  return list;
}

std::optional<Eigen::MatrixXd> FitProblem::derivative(const Eigen::VectorXd& u) {
  const auto found = sides(u, steps_);
  if (!found) return {};
  Eigen::MatrixXd j(static_cast<Eigen::Index>(values_compared()), size());
  for (Eigen::Index k = 0; k < size(); ++k) {
    const Sides& s = (*found)[static_cast<std::size_t>(k)];
    j.col(k) = (s.r_above - s.r_below) / (s.above[k] - s.below[k]);
  }
  if (!j.allFinite()) return {};
  return j;
}

bool FitProblem::choose_steps(const Eigen::VectorXd& given) {
  const Eigen::VectorXd u = given.cwiseMax(tiny).cwiseMin(1 - tiny);
  const auto centre = residuals(u);
  if (!centre) return false;
  const auto first = derivative(u);
  const auto near = sides(u, std::vector<double>(unknowns_.size(), tiny));
  if (!first || !near) return false;
  noise_ = 0;
  for (std::size_t k = 0; k < unknowns_.size(); ++k) {
    const double slope = first->col(static_cast<Eigen::Index>(k)).norm();
    if (!unknowns_[k].moves_machine() || !(slope > 0)) continue;
    const double noise = ((*near)[k].r_below - 2 * *centre + (*near)[k].r_above).norm() / std::sqrt(6.0);
    steps_[k] = std::clamp(noise / (std::sqrt(2.0) * slope * wanted_noise), shortest, longest);
    noise_ = std::max(noise_, noise / (std::sqrt(2.0) * slope * steps_[k]));
  }
  return true;
}

BoundedFit FitProblem::fit(const Eigen::VectorXd& u, int most_steps) {
  const BoundedProblem problem{
      .residuals = [this](const Eigen::VectorXd& at) { return residuals(at); },
      .derivative = [this](const Eigen::VectorXd& at, const Eigen::VectorXd&) { return derivative(at); }};
  return fit_within_bounds(problem, u, most_steps);
}

std::size_t FitProblem::unknowns_of(std::size_t record) const {
  std::size_t count = 0;
  for (std::size_t k = 0; k < unknowns_.size(); ++k)
    count += unknowns_[k].moves_machine() ? machines_[record].depends_on(k) : unknowns_[k].concerns(record);
  return count;
}

}  // namespace kurbel
