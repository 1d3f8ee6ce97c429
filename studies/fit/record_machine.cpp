// record_machine.cpp — runs, steady cycles and modes as what a record would show.
#include "studies/fit/record_machine.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

#include "engine/scene/messages.h"
#include "studies/findings/trace.h"
#include "studies/measured/overlay.h"
#include "studies/modes/modes.h"
#include "studies/run/simulate.h"
#include "studies/variants/variant_runs.h"

namespace kurbel {
namespace {

// Components whose channels a record has: the trajectory holds no others.
std::vector<std::string> components_of(const Scene& scene, const FitRecord& record) {
  std::vector<std::string> list;
  for (const Section& s : scene.components)
    for (const RecordChannel& c : record.channels)
      if ((c.channel + ".").find("." + s.name + ".") != std::string::npos) {
        list.push_back(s.name);
        break;
      }
  return list;
}

// The trace over the link's angle in the last whole cycle, closed to a period.
std::optional<Signal> over_angle(const SteadyCycle& cycle, const std::string& channel) {
  if (!cycle.found || !cycle.traces || cycle.traces->last_cycles.empty()) return {};
  for (const Trace& t : cycle.traces->last_cycles.back().traces)
    if (t.name == channel && t.x.size() > 2) {
      std::vector<double> x = t.x, y = t.y;
      const double period = cycle.model->cycle, left = x.front() + period - x.back();
      if (left > 1e-9 * period) x.push_back(x.front() + period), y.push_back(y.front());
      return Signal(std::move(x), std::move(y), period);
    }
  return {};
}

// Rows of a run's trajectory, which is straight between them: so many for each point of the record, and more.
constexpr std::size_t points_between = 12, more_points = 2'000, most_points = 100'000;

Eigen::Map<const Eigen::VectorXd> mapped(const std::vector<double>& values) {
  return {values.data(), static_cast<Eigen::Index>(values.size())};
}

// Correlation length of the values of each row: 1 + 2 Σ ρ_k up to the first that is not positive.
constexpr Eigen::Index fewest_correlated = 8;
double correlation_length(const Eigen::MatrixXd& r) {
  const Eigen::Index n = r.cols();
  const double power = r.squaredNorm();
  if (n < fewest_correlated || !(power > 0)) return 1;
  double sum = 1;
  for (Eigen::Index k = 1; k < n / 2; ++k) {
    const double rho = r.leftCols(n - k).cwiseProduct(r.rightCols(n - k)).sum() / power;
    if (rho <= 0) break;
    sum += 2 * rho;
  }
  return std::min(sum, static_cast<double>(n) / 4);
}

// Of the residual of a fit with so many unknowns. Both sums are too small in short records; so where ρ₁ is significant it is at
// least that of a first-order autoregression, (1 + ρ)/(1 − ρ), with ρ free of its bias, ρ = (n ρ₁ + 1 + unknowns)/(n − 3)
// (Kendall, and Marriott and Pope, Biometrika 41, 1954).
double correlation_length_of_residual(const Eigen::VectorXd& r, double unknowns) {
  const double sum = correlation_length(r.transpose()), n = static_cast<double>(r.size()), power = r.squaredNorm();
  if (r.size() < fewest_correlated || !(power > 0)) return sum;
  const double first = r.head(r.size() - 1).dot(r.tail(r.size() - 1)) / power;
  if (first <= 2 / std::sqrt(n)) return sum;
  const double rho = (n * first + 1 + unknowns) / (n - 3);
  return std::max(sum, rho < 1 ? std::min((1 + rho) / (1 - rho), n / 4) : n / 4);
}

}  // namespace

double ShownSignal::mean(double x, double reach) const {
  constexpr int parts = 32;
  double sum = 0, weight = 0;
  for (int i = 0; i < parts; ++i) {
    const double at = x + reach * ((2 * i + 1.0) / parts - 1), density = pace ? pace->at(at) : 1;
    sum += density * signal.at(at), weight += density;
  }
  return sum / weight;
}

RecordMachine::RecordMachine(const RecordRequest& request, const FitRecord& record, std::size_t number,
                             const std::vector<Unknown>& unknowns)
    : request_(request), record_(std::make_shared<FitRecord>(record)), unknowns_(unknowns), varied_(request.scene, {}) {
  std::vector<SweptParameter> parameters;
  double later = 0, earlier = 0;
  Scene scene = varied_.at({});
  for (std::size_t k = 0; k < unknowns.size(); ++k) {
    const Unknown& u = unknowns[k];
    if (!u.concerns(number)) continue;
    if (u.kind == Unknown::Kind::key) parameters.push_back(u.range), keys_.push_back(k);
    if (u.kind == Unknown::Kind::record_shift) later = u.si(1), earlier = u.si(0);
    if (u.kind == Unknown::Kind::key || !u.moves_machine()) continue;
    if (!table_at(scene.components, u.of))
      throw std::invalid_argument(fmt::format(
          "{}: no table {} of points stands in {}; a channel that is mapped, or a table such as engine.load.pressure",
          u.range.where, in_quotes(u.of), request.scene.file));
    tables_.push_back(k);
  }
  if (!parameters.empty()) varied_ = VariedScene(request.scene, parameters);
  if (record.over != Over::time) return;
  const double before = record.reach.empty() ? 0 : record.reach.front();
  if (record.at.front() - before + std::min(0.0, earlier) < -1e-12)
    throw std::invalid_argument(
        fmt::format("--measured {}: begins at {:.6g} s{}, before the run does; give --free \"{}: shift=…\" with ends "
                    "that leave it behind 0 s, or take these rows out",
                    record.file, record.at.front() - before,
                    earlier < 0 ? fmt::format(" and may be shifted by {:.6g} s", earlier) : "", record.name));
  until_ = record.at.back() + (record.reach.empty() ? 0 : record.reach.back()) + std::max(0.0, later);
}

bool RecordMachine::depends_on(std::size_t unknown) const {
  return std::count(keys_.begin(), keys_.end(), unknown) + std::count(tables_.begin(), tables_.end(), unknown) > 0;
}

std::vector<double> RecordMachine::values_of(const Eigen::VectorXd& u) const {
  std::vector<double> values;
  for (const std::size_t k : keys_) values.push_back(unknowns_[k].at(u[static_cast<Eigen::Index>(k)]));
  return values;
}

void RecordMachine::change_tables(Scene& scene, const Eigen::VectorXd& u) const {
  using Kind = Unknown::Kind;
  for (const std::size_t k : tables_) {
    const Unknown& unknown = unknowns_[k];
    CurveData* const table = table_at(scene.components, unknown.of);
    const double by = unknown.si(u[static_cast<Eigen::Index>(k)]);
    const bool gain = unknown.kind == Kind::table_gain, offset = unknown.kind == Kind::table_offset;
    for (double& y : table->y) y = gain ? y * by : offset ? y + by : y;
    for (double& x : table->x) x += gain || offset ? 0 : by;
    if (unknown.kind == Kind::dead_centre && request_.over == Over::time) scene.run.start.angle += by;
  }
}

Response RecordMachine::at(const Eigen::VectorXd& u, const Effects* effects) {
  Response response;
  const auto compute = [&] {
    const Scene* scene = &varied_.at(values_of(u));
    Scene changed;
    if (!tables_.empty() || request_.over == Over::time) {
      changed = *scene;
      change_tables(changed, u);
      scene = &changed;
    }
    const Effects& on = effects ? *effects : scene->effects;
    response = request_.over == Over::time    ? run(*scene, on)
               : request_.over == Over::angle ? cycle(*scene, on)
                                              : modes(*scene);
  };
  if (const auto failure = failure_of(compute, request_.scene.interrupted)) response.failed = failure->reason;
  return response;
}

Response RecordMachine::run(const Scene& given, const Effects& effects) const {
  Scene scene = given;
  scene.run.output = components_of(scene, *record_);
  scene.run.samples = static_cast<int>(std::min(points_between * record_->at.size() + more_points, most_points));
  SimulateOptions options;
  options.measure_error = false;
  options.until = until_;
  options.watch.interrupted = request_.scene.interrupted;
  const Result result = simulate(compile(scene, effects), "", options);
  Response response;
  if (!result.complete || !result.trajectory) return {.failed = result.diagnosis.empty() ? "no run" : result.diagnosis};
  const std::vector<Channel>& known = result.trajectory->channels();
  for (const RecordChannel& c : record_->channels) {
    if (std::none_of(known.begin(), known.end(), [&](const Channel& k) { return k.name == c.channel; }))
      return {.failed = "its run has no " + c.channel};
    response.channels.push_back({signal_of(result, c.channel)});
    if (std::any_of(unknowns_.begin(), unknowns_.end(), [&](const Unknown& u) { return u.is_pattern_of(c.channel); }))
      response.channels.back().angle = signal_of(result, "angle" + c.channel.substr(c.channel.find('.')));
  }
  return response;
}

Response RecordMachine::cycle(const Scene& scene, const Effects& effects) const {
  SteadyOptions options;
  options.start_search = false, options.traces = true;
  options.watch.interrupted = request_.scene.interrupted;
  options.hold_by = request_.hold_by, options.mean_speed = request_.mean_speed;
  const SteadyStudy study = steady(scene, {effects}, options);
  if (study.cycles.empty()) return {.failed = study.diagnosis};
  const SteadyCycle& found = study.cycles.front();
  if (!found.found) return {.failed = found.why.empty() ? study.diagnosis : found.why};
  Response response;
  response.held = found.held_quantity;
  std::optional<Signal> pace = over_angle(found, "speed." + study.link);
  if (pace) {
    std::vector<double> slowness;
    for (const double w : pace->value()) slowness.push_back(1 / w);
    pace = Signal(pace->time(), std::move(slowness), pace->period());
  }
  for (const RecordChannel& c : record_->channels) {
    const auto signal = over_angle(found, c.channel);
    if (!signal) return {.failed = "its steady cycle has no " + c.channel + " over the angle"};
    response.channels.push_back({*signal, pace});
  }
  return response;
}

Response RecordMachine::modes(const Scene& scene) const {
  ModesOptions options;
  options.modes_alone = true;
  options.watch.interrupted = request_.scene.interrupted;
  const ModesStudy study = find_modes(scene, effects_of_modes(scene), options);
  if (!study.complete) return {.failed = study.diagnosis};
  constexpr double hertz = 0.5 / std::numbers::pi;
  Response response;
  for (const RecordChannel& c : record_->channels) {
    std::vector<double>& values = response.modes.emplace_back();
    for (const double number : record_->at) {
      const auto mode = std::find_if(study.modes.begin(), study.modes.end(), [&](const Mode& m) {
        return !m.of_internal_states && m.number == std::lround(number);
      });
      if (mode == study.modes.end())
        return {.failed = fmt::format("has no mode {:.0f}; its modes are 1 … {}", number, study.modes.size())};
      values.push_back(c.channel == "natural_frequency"  ? mode->omega * hertz
                       : c.channel == "damped_frequency" ? mode->lambda.imag() * hertz
                                                         : mode->ratio);
    }
  }
  return response;
}

std::vector<std::string> RecordMachine::settings_at(const Eigen::VectorXd& u,
                                                    const std::optional<HeldQuantity>& held) const {
  std::vector<std::string> settings;
  for (const std::size_t k : keys_)
    settings.push_back(unknowns_[k].range.setting(unknowns_[k].at(u[static_cast<Eigen::Index>(k)])));
  if (held) settings.push_back(fmt::format("{}={} {}", held->key, held->value, held->unit));
  return settings;
}

ComparedRecord::ComparedRecord(const FitRecord& record, const std::vector<double>& orders, std::size_t number)
    : record_(record),
      orders_(record.over == Over::angle ? orders : std::vector<double>{}),
      number_(number),
      lengths_(record.channels.size(), 1.0) {
  const auto points = static_cast<Eigen::Index>(record.at.size());
  if (!orders_.empty()) {
    const std::vector<double> weights = weights_over(record);
    map_.resize(static_cast<Eigen::Index>(2 * orders_.size()), points);
    for (Eigen::Index i = 0; i < points; ++i)
      for (std::size_t k = 0; k < orders_.size(); ++k) {
        const auto at = static_cast<std::size_t>(i);
        const double angle = orders_[k] * record.at[at];
        map_(static_cast<Eigen::Index>(2 * k), i) = 2 * weights[at] * std::cos(angle);
        map_(static_cast<Eigen::Index>(2 * k + 1), i) = -2 * weights[at] * std::sin(angle);
      }
  }
  per_channel_ = orders_.empty() ? points : map_.rows();
  data_ = compared(measured_points());
  scatter_ = Eigen::VectorXd::Zero(data_.size());
  std::vector<Eigen::MatrixXd> blocks;
  Eigen::Index common = std::numeric_limits<Eigen::Index>::max();
  const bool together = points_scatter_together();
  for (std::size_t c = 0; c < record.channels.size(); ++c) {
    const RecordChannel& channel = record.channels[c];
    const Eigen::MatrixXd& block =
        blocks.emplace_back(together ? cycles_of(channel) : Eigen::MatrixXd(0, per_channel_));
    common = std::min(common, block.rows());
    auto part = scatter_.segment(begin(c), per_channel_);
    of_scatter_ = of_scatter_ && channel.has_scatter();
    const double root = std::sqrt(static_cast<double>(record.cycles));
    if (!channel.has_scatter())
      part = sizes(data_.segment(begin(c), per_channel_));
    else if (orders_.empty())
      part = mapped(channel.scatter) / root;
    else if (block.rows() > 1)
      part = (block.colwise().squaredNorm().transpose() / static_cast<double>(block.rows() - 1)).cwiseSqrt() / root;
    else  // points taken as independent of each other
      part = (map_.cwiseAbs2() * mapped(channel.scatter).cwiseAbs2()).cwiseSqrt() / root;
  }
  deviation_ = scatter_;
  if (common < 2 || blocks.empty()) return;
  cycles_.resize(common, data_.size());
  for (std::size_t c = 0; c < blocks.size(); ++c)
    cycles_.middleCols(begin(c), per_channel_) = blocks[c].topRows(common);
}

// Cycles whose points move together, as by a level of each, are n values, not n times as many as there are points.
bool ComparedRecord::points_scatter_together() const {
  constexpr double apart = 2;  // longest correlation of points that scatter each by itself
  const auto n = static_cast<Eigen::Index>(record_.at.size());
  for (const RecordChannel& c : record_.channels) {
    if (!c.cycles.empty() && (n < fewest_correlated || record_.over == Over::mode)) return true;
    Eigen::MatrixXd rows(static_cast<Eigen::Index>(c.cycles.size()), n);
    for (Eigen::Index k = 0; k < rows.rows(); ++k)
      rows.row(k) =
          (mapped(c.cycles[static_cast<std::size_t>(k)]) - mapped(c.mean)).cwiseQuotient(mapped(c.scatter)).transpose();
    if (correlation_length(rows) > apart) return true;
  }
  return false;
}

// A row for each cycle: what is compared of it, less that of the mean.
Eigen::MatrixXd ComparedRecord::cycles_of(const RecordChannel& channel) const {
  Eigen::MatrixXd rows(static_cast<Eigen::Index>(channel.cycles.size()), per_channel_);
  for (std::size_t k = 0; k < channel.cycles.size(); ++k)
    rows.row(static_cast<Eigen::Index>(k)) = compared(mapped(channel.cycles[k]) - mapped(channel.mean)).transpose();
  return rows;
}

// Without scatter: modes each by their own size, orders by the greatest, points by their range.
Eigen::VectorXd ComparedRecord::sizes(const Eigen::VectorXd& data) const {
  if (record_.over == Over::mode) return data.cwiseAbs().cwiseMax(1e-300);
  const double greatest = std::max(data.cwiseAbs().maxCoeff(), 1e-300);
  const double size = orders_.empty() ? data.maxCoeff() - data.minCoeff() : greatest;
  return Eigen::VectorXd::Constant(data.size(), std::max(size, 1e-9 * greatest));
}

Eigen::VectorXd ComparedRecord::measured_points() const {
  const auto points = static_cast<Eigen::Index>(record_.at.size());
  Eigen::VectorXd all(static_cast<Eigen::Index>(record_.channels.size()) * points);
  for (std::size_t c = 0; c < record_.channels.size(); ++c)
    all.segment(static_cast<Eigen::Index>(c) * points, points) = mapped(record_.channels[c].mean);
  return all;
}

Eigen::VectorXd ComparedRecord::compared(const Eigen::VectorXd& points) const {
  if (orders_.empty()) return points;
  const Eigen::Index count = map_.cols();
  Eigen::VectorXd all(points.size() / count * per_channel_);
  for (Eigen::Index c = 0; c * count < points.size(); ++c)
    all.segment(c * per_channel_, per_channel_) = map_ * points.segment(c * count, count);
  return all;
}

Eigen::VectorXd ComparedRecord::points_of(const Response& response, const std::vector<Unknown>& unknowns,
                                          const Eigen::VectorXd& u) const {
  using Kind = Unknown::Kind;
  double shift = 0, dead_centre = 0;  // over time the latter is in the start's angle
  for (std::size_t k = 0; k < unknowns.size(); ++k)
    if (unknowns[k].concerns(number_)) {
      const double by = unknowns[k].si(u[static_cast<Eigen::Index>(k)]);
      shift += unknowns[k].kind == Kind::record_shift ? by : 0;
      dead_centre += unknowns[k].kind == Kind::dead_centre ? by : 0;
    }
  if (record_.over == Over::angle) shift += dead_centre;
  const auto points = static_cast<Eigen::Index>(record_.at.size());
  Eigen::VectorXd all(static_cast<Eigen::Index>(record_.channels.size()) * points);
  for (std::size_t c = 0; c < record_.channels.size(); ++c) {
    auto shown = all.segment(static_cast<Eigen::Index>(c) * points, points);
    for (Eigen::Index i = 0; i < points; ++i) {
      const auto k = static_cast<std::size_t>(i);
      if (!response.modes.empty())
        shown[i] = response.modes[c][k];
      else
        shown[i] = record_.reach.empty() ? response.channels[c].signal.at(record_.at[k] + shift)
                                         : response.channels[c].mean(record_.at[k] + shift, record_.reach[k]);
    }
    double gain = 1, offset = 0;
    Eigen::VectorXd pattern = Eigen::VectorXd::Zero(points);
    for (std::size_t k = 0; k < unknowns.size(); ++k) {
      const Unknown& unknown = unknowns[k];
      if (!unknown.concerns(number_) || unknown.of != record_.channels[c].channel) continue;
      const double by = unknown.si(u[static_cast<Eigen::Index>(k)]);
      if (unknown.kind == Kind::gain) gain *= by;
      if (unknown.kind == Kind::offset) offset += by;
      if (!unknown.is_pattern_of(unknown.of)) continue;
      for (Eigen::Index i = 0; i < points; ++i) {
        const double at = record_.at[static_cast<std::size_t>(i)];
        const double angle =
            record_.over == Over::angle ? at : response.channels[c].angle->at(at + shift) - dead_centre;
        const double turned = unknown.order * angle;
        pattern[i] += by * (unknown.kind == Kind::cosine ? std::cos(turned) : std::sin(turned));
      }
    }
    shown = (gain * shown.array() * (1 + pattern.array()) + offset).matrix();
  }
  return all;
}

void ComparedRecord::weigh_by(const Eigen::VectorXd& left, double unknowns) {
  for (std::size_t c = 0; c < lengths_.size(); ++c)
    if (orders_.empty() && record_.over != Over::mode)
      lengths_[c] = correlation_length_of_residual(left.segment(begin(c), per_channel_), unknowns);
  const double values = independent(), freedom = std::max(values - unknowns, 1.0);
  double squares = 0, scattered = 0;  // over the scatter
  for (std::size_t c = 0; c < lengths_.size(); ++c) {
    const auto part = left.segment(begin(c), per_channel_);
    const Eigen::VectorXd size = scatter_.segment(begin(c), per_channel_);
    const double of_size = part.cwiseQuotient(size).squaredNorm() / static_cast<double>(per_channel_);
    if (record_.channels[c].has_scatter()) {
      const double count = static_cast<double>(per_channel_) / lengths_[c];
      squares += count * of_size, scattered += count;
    }
    const double greatest = std::max(data_.segment(begin(c), per_channel_).cwiseAbs().maxCoeff(), 1e-300);
    deviation_.segment(begin(c), per_channel_) =
        (size * std::sqrt(of_size * values / freedom)).cwiseMax(record_.machine_error * greatest) *
        std::sqrt(lengths_[c]);
  }
  if (scattered == 0) return;
  widened_ = std::sqrt(std::max(1.0, squares / scattered * values / freedom));
  for (std::size_t c = 0; c < lengths_.size(); ++c)
    if (record_.channels[c].has_scatter())
      deviation_.segment(begin(c), per_channel_) =
          scatter_.segment(begin(c), per_channel_) * widened_ * std::sqrt(lengths_[c]);
}

double ComparedRecord::independent() const {
  double count = 0;
  for (const double length : lengths_) count += static_cast<double>(per_channel_) / length;
  return count;
}

OrderPart order_part(double real, double imaginary) {
  return {{std::hypot(real, imaginary)}, {std::atan2(imaginary, real)}};
}

}  // namespace kurbel
