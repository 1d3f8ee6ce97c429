// fit_problem.cpp — runs in threads, differences above their errors.
#include "studies/fit/fit_problem.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "engine/numerics/deadline.h"
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

}  // namespace

FitProblem::FitProblem(std::vector<RecordRequest> requests, const std::vector<std::string>& free, int jobs, Watch watch)
    : requests_(std::move(requests)), jobs_(jobs), watch_(std::move(watch)) {
  for (RecordRequest& request : requests_) {
    records_.push_back(read_record(request));
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
  if (unknowns_.size() >= values_compared())
    throw std::invalid_argument(fmt::format(
        "{} unknowns for {} values that are compared: give more data (points, orders, records) than unknowns",
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

std::vector<Response> FitProblem::compute(const std::vector<Item>& items) {
  std::vector<Response> responses(items.size());
  const bool whole = in_threads(items.size(), jobs_, [&]() -> Worker {
    return [&, machines = machines_](std::size_t i) mutable {
      const std::size_t r = items[i].record;
      responses[i] = machines[r].at(items[i].u, effects[r] ? &*effects[r] : nullptr);
      return !watch_.stopped();
    };
  });
  if (!whole) throw OutOfTime(0);
  runs_ += items.size();
  watch_.at("fit", 1 - 1 / (1 + 0.02 * static_cast<double>(runs_)));
  return responses;
}

std::vector<Response> FitProblem::responses_of(const RecordMachine& machine, const std::vector<Eigen::VectorXd>& at) {
  std::vector<Response> responses(at.size());
  const bool whole = in_threads(at.size(), jobs_, [&]() -> Worker {
    return [&, own = machine](std::size_t i) mutable {
      responses[i] = own.at(at[i]);
      return !watch_.stopped();
    };
  });
  if (!whole) throw OutOfTime(0);
  runs_ += at.size();
  return responses;
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

std::optional<Eigen::VectorXd> FitProblem::residuals(const Eigen::VectorXd& u) {
  std::vector<Item> items;
  for (std::size_t r = 0; r < records_.size(); ++r) items.push_back({r, u});
  responses_ = compute(items);
  for (std::size_t r = 0; r < records_.size(); ++r)
    if (!responses_[r].failed.empty()) {
      failure_ = records_[r].name + ": " + responses_[r].failed;
      return {};
    }
  const Eigen::VectorXd r = stacked(responses_, u);
  if (r.allFinite()) return r;
  failure_ = "what the machine shows is not finite";
  return {};
}

std::pair<Eigen::VectorXd, Eigen::VectorXd> FitProblem::around(const Eigen::VectorXd& u, std::size_t unknown) const {
  const auto k = static_cast<Eigen::Index>(unknown);
  Eigen::VectorXd below = u, above = u;
  below[k] = std::max(0.0, u[k] - steps_[unknown]), above[k] = std::min(1.0, u[k] + steps_[unknown]);
  return {below, above};
}

std::optional<Eigen::MatrixXd> FitProblem::derivative(const Eigen::VectorXd& u) {
  std::vector<Item> items;
  for (std::size_t k = 0; k < unknowns_.size(); ++k)
    for (std::size_t r = 0; r < records_.size(); ++r)
      if (active[r] && machines_[r].depends_on(k)) {
        const auto [below, above] = around(u, k);
        items.push_back({r, below}), items.push_back({r, above});
      }
  const std::vector<Response> computed = compute(items);
  Eigen::MatrixXd j = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(values_compared()), size());
  std::size_t next = 0;
  for (std::size_t k = 0; k < unknowns_.size(); ++k) {
    auto [below, above] = around(u, k);
    std::vector<Response> at_below = responses_, at_above = responses_;
    bool below_runs = true, above_runs = true;
    for (std::size_t r = 0; r < records_.size(); ++r)
      if (active[r] && machines_[r].depends_on(k)) {
        at_below[r] = computed[next++], at_above[r] = computed[next++];
        below_runs = below_runs && at_below[r].failed.empty(), above_runs = above_runs && at_above[r].failed.empty();
        if (!at_below[r].failed.empty()) failure_ = at_below[r].failed;
      }
    if (!below_runs && !above_runs) return {};
    if (!below_runs) below = u, at_below = responses_;
    if (!above_runs) above = u, at_above = responses_;
    const auto c = static_cast<Eigen::Index>(k);
    j.col(c) = (stacked(at_above, above) - stacked(at_below, below)) / (above[c] - below[c]);
  }
  if (!j.allFinite()) return {};
  return j;
}

bool FitProblem::choose_steps(const Eigen::VectorXd& given) {
  const Eigen::VectorXd u = given.cwiseMax(tiny).cwiseMin(1 - tiny);
  const auto centre = residuals(u);
  if (!centre) return false;
  const auto first = derivative(u);
  if (!first) return false;
  noise_ = 0;
  for (std::size_t k = 0; k < unknowns_.size(); ++k) {
    if (!unknowns_[k].moves_machine()) continue;
    const auto c = static_cast<Eigen::Index>(k);
    std::vector<Item> items;
    Eigen::VectorXd below = u, above = u;
    below[c] -= tiny, above[c] += tiny;
    for (std::size_t r = 0; r < records_.size(); ++r)
      if (machines_[r].depends_on(k)) items.push_back({r, below}), items.push_back({r, above});
    const std::vector<Response> computed = compute(items);
    if (std::any_of(computed.begin(), computed.end(), [](const Response& r) { return !r.failed.empty(); })) continue;
    std::vector<Response> at_below = responses_, at_above = responses_;
    for (std::size_t i = 0; i < items.size(); i += 2)
      at_below[items[i].record] = computed[i], at_above[items[i].record] = computed[i + 1];
    const Eigen::VectorXd low = stacked(at_below, below), high = stacked(at_above, above);
    const double noise = (low - 2 * *centre + high).norm() / std::sqrt(6.0), slope = first->col(c).norm();
    if (!(slope > 0)) continue;
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

void FitProblem::weigh_by_residuals(const Eigen::VectorXd& u) {
  for (std::size_t r = 0; r < records_.size(); ++r) comparisons_[r].weigh_by(shown(r, u) - comparisons_[r].data());
}

}  // namespace kurbel
