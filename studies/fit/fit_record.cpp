// fit_record.cpp — columns as channels, cycles and scatters; teeth into speeds; what makes a record useless.
#include "studies/fit/fit_record.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "engine/scene/messages.h"
#include "engine/tables/table_file.h"
#include "studies/measured/overlay.h"
#include "studies/scenes/kinds.h"

namespace kurbel {
namespace {

constexpr double turn = 2 * std::numbers::pi;
const std::string scatter_of = "scatter of ";

std::shared_ptr<const Model> model_of(const RecordRequest& request) {
  const Scene scene = VariedScene(request.scene, {}).at({});
  return compile(scene, scene.effects);
}

std::vector<KnownChannel> known_channels(const RecordRequest& request, const Model* model) {
  std::vector<KnownChannel> known;
  if (request.over == Over::mode)
    return {{"natural_frequency", "Hz"}, {"damped_frequency", "Hz"}, {"damping_ratio", ""}};
  known = request.over == Over::time ? channels_of_run(*model) : channels_of_cycle(*model);
  for (std::size_t k = 0, n = known.size(); k < n; ++k) known.push_back({scatter_of + known[k].name, known[k].unit});
  return known;
}

// "c*=speed.engine" for each column of that name.
std::vector<std::string> expanded(const RecordRequest& request) {
  std::vector<std::string> maps;
  for (const std::string& map : request.maps) {
    const std::size_t equals = map.find('='), star = map.substr(0, equals).find('*');
    if (star == std::string::npos) {
      maps.push_back(map);
      continue;
    }
    const std::string before = map.substr(0, star), behind = map.substr(star + 1, equals - star - 1);
    const std::vector<std::string> names = TableFile(request.file, form_of(request.file, request.maps)).names();
    const std::size_t found = maps.size();
    for (const std::string& name : names)
      if (name.size() >= before.size() + behind.size() && name.starts_with(before) && name.ends_with(behind))
        maps.push_back(name + map.substr(equals));
    if (maps.size() == found)
      throw std::invalid_argument(fmt::format("--map {}: no column of {} has such a name; columns: {}", in_quotes(map),
                                              request.file, shortened_list(names, "and")));
  }
  return maps;
}

// Times of an encoder's teeth, N − M of them a turn: the mean speed from each to the next. Where the time is nearer to
// M + 1 pitches than to one, as its neighbour says, it is the gap.
struct Teeth {
  int pitches = 0, missing = 0;
};
Teeth parse_teeth(const std::string& text) {
  Teeth teeth;
  const std::size_t dash = text.find('-');
  try {
    teeth.pitches = std::stoi(text);
    if (dash != std::string::npos) teeth.missing = std::stoi(text.substr(dash + 1));
  } catch (const std::exception&) {
    teeth = {};
  }
  if (teeth.pitches < 2 || teeth.missing < 0 || teeth.missing >= teeth.pitches - 1)
    throw std::invalid_argument(fmt::format(
        "--teeth {}: must be the pitches of a turn, less the teeth that are missing, e.g. \"60-2\"", in_quotes(text)));
  return teeth;
}
void speeds_of_teeth(FitRecord& record, const std::string& text) {
  const Teeth teeth = parse_teeth(text);
  const std::vector<double> passed = record.at;
  record.at.clear();
  std::vector<double>& speed = record.channels.front().mean;
  speed.clear();
  double pitch = 0;  // time of one, by the tooth before
  for (std::size_t i = 0; i + 1 < passed.size(); ++i) {
    const double step = passed[i + 1] - passed[i];
    if (pitch == 0) pitch = i + 2 < passed.size() ? std::min(step, passed[i + 2] - passed[i + 1]) : step;
    const int count = step > 0.5 * (2 + teeth.missing) * pitch ? teeth.missing + 1 : 1;
    record.at.push_back(0.5 * (passed[i] + passed[i + 1]));
    record.reach.push_back(0.5 * step);
    speed.push_back(count * turn / teeth.pitches / step);
    pitch = step / count;
  }
}

// Columns of one channel are its cycles; those of its scatter go to it.
void gather(FitRecord& record, const Measurement& measured) {
  for (const MeasuredSignal& s : measured.signals) {
    const bool is_scatter = s.channel.starts_with(scatter_of);
    const std::string name = is_scatter ? s.channel.substr(scatter_of.size()) : s.channel;
    const auto same = [&](const RecordChannel& c) { return c.channel == name; };
    auto found = std::find_if(record.channels.begin(), record.channels.end(), same);
    if (found == record.channels.end()) {
      record.channels.push_back({.channel = name, .unit = s.unit, .mean = {}});
      found = std::prev(record.channels.end());
    }
    if (is_scatter)
      found->scatter = s.values;
    else
      found->cycles.push_back(s.values);
  }
  for (RecordChannel& c : record.channels) {
    if (c.cycles.empty())
      throw std::invalid_argument(
          fmt::format("--map: {} has a scatter of {} and no column of it", record.file, c.channel));
    const auto n = static_cast<double>(c.cycles.size());
    c.mean.assign(record.at.size(), 0);
    for (const auto& cycle : c.cycles)
      for (std::size_t i = 0; i < c.mean.size(); ++i) c.mean[i] += cycle[i] / n;
    if (c.cycles.size() == 1) {
      c.cycles.clear();
      continue;
    }
    if (!c.scatter.empty())
      throw std::invalid_argument(
          fmt::format("--map: {} of {} has both cycles and a scatter; leave one of them out", c.channel, record.file));
    c.scatter.assign(record.at.size(), 0);
    for (const auto& cycle : c.cycles)
      for (std::size_t i = 0; i < c.mean.size(); ++i) c.scatter[i] += std::pow(cycle[i] - c.mean[i], 2) / (n - 1);
    for (double& s : c.scatter) s = std::sqrt(s);
    record.cycles = static_cast<int>(n);
  }
}

// s² of n cycles has n − 1 degrees of freedom: a weight from one pair of values would be chance. It is the mean of s² over
// as many neighbours as have `enough` of them together.
void smooth_scatter(FitRecord& record) {
  constexpr int enough = 30;
  if (record.cycles < 2 || record.over == Over::mode) return;
  const auto n = static_cast<std::ptrdiff_t>(record.at.size());
  const bool around = record.over == Over::angle;
  const std::ptrdiff_t reach = std::min(enough / (2 * (record.cycles - 1)), static_cast<int>(around ? (n - 1) / 2 : n));
  for (RecordChannel& c : record.channels) {
    const std::vector<double> given = c.scatter;
    for (std::size_t i = 0; i < c.scatter.size(); ++i) {
      double sum = 0, count = 0;
      for (std::ptrdiff_t k = static_cast<std::ptrdiff_t>(i) - reach; k <= static_cast<std::ptrdiff_t>(i) + reach; ++k)
        if (around || (k >= 0 && k < n)) sum += std::pow(given[static_cast<std::size_t>((k + n) % n)], 2), ++count;
      c.scatter[i] = std::sqrt(sum / count);
    }
  }
}

void require_use(const FitRecord& record) {
  for (const RecordChannel& c : record.channels) {
    if (record.over == Over::mode) continue;
    const auto [least, greatest] = std::minmax_element(c.mean.begin(), c.mean.end());
    if (!(*greatest > *least))
      throw std::invalid_argument(
          fmt::format("--measured {}: {} is {:.6g} {} all along; a channel that does not vary says nothing: leave its "
                      "map out, or hold it",
                      record.file, c.channel, *least, c.unit));
    if (c.has_scatter() && std::any_of(c.scatter.begin(), c.scatter.end(), [](double s) { return !(s > 0); }))
      throw std::invalid_argument(
          fmt::format("--measured {}: the scatter of {} must be > 0 at every point", record.file, c.channel));
  }
  if (record.over != Over::angle) return;
  if (!(record.period > 0))
    throw std::invalid_argument(fmt::format(
        "--measured {}: the machine of its scene has no cycle that repeats over the angle; give --over time",
        record.file));
  const double covered = record.at.back() - record.at.front();
  const double step = covered / static_cast<double>(record.at.size() - 1);
  if (covered + 1.5 * step < record.period)
    throw std::invalid_argument(fmt::format(
        "--measured {}: covers {:.5g} deg, and the machine's cycle has {:.5g} deg; a record over the angle must "
        "cover a whole period (or --over time)",
        record.file, covered * 360 / turn, record.period * 360 / turn));
  if (covered > record.period * (1 + 1e-9))
    throw std::invalid_argument(fmt::format(
        "--measured {}: covers {:.5g} deg, more than the machine's cycle of {:.5g} deg; give one period, and "
        "further cycles as further columns (--map \"c*=CHANNEL\")",
        record.file, covered * 360 / turn, record.period * 360 / turn));
}

}  // namespace

Over over_named(const std::string& word) {
  if (word == "time") return Over::time;
  if (word == "angle") return Over::angle;
  if (word == "modes" || word == "mode") return Over::mode;
  throw std::invalid_argument(fmt::format("--over {}: must be time, angle or modes", in_quotes(word)));
}

FitRecord read_record(const RecordRequest& request) {
  FitRecord record{.name = request.name, .file = request.file, .over = request.over, .at = {}, .channels = {}};
  const std::shared_ptr<const Model> model = request.over == Over::mode ? nullptr : model_of(request);
  MeasurementRequest asked{.file = request.file, .maps = expanded(request), .shift = {}, .offsets = {}};
  std::vector<KnownChannel> known = known_channels(request, model.get());
  if (request.over == Over::angle) asked.over = "angle", asked.over_unit = "rad", record.period = model->cycle;
  if (request.over == Over::mode) asked.over = "mode", asked.over_unit = "", asked.fewest_rows = 1;
  if (!request.teeth.empty()) {
    if (request.over != Over::time || asked.maps.size() != 1)
      throw std::invalid_argument(
          "--teeth: belongs to a record over time with one map, the column of the teeth's times, "
          "e.g. --map \"t=speed.engine\"");
    const std::string& map = asked.maps.front();
    asked.maps.push_back(map.substr(0, map.find('=')) + "=time [s]");
    for (KnownChannel& c : known) c.unit = "s";
  }
  const Measurement measured = read_measurement(asked, known);
  record.at = measured.time, record.gaps = measured.gaps();
  record.cycles = request.cycles;
  if (model) record.machine_error = std::max(record.machine_error, model->scene.run.accuracy);
  gather(record, measured);
  if (!request.teeth.empty()) {
    record.channels.front().unit = "rad/s";
    speeds_of_teeth(record, request.teeth);
  } else if (request.window > 0) {
    record.reach.assign(record.at.size(), 0.5 * request.window);
  }
  smooth_scatter(record);
  require_use(record);
  return record;
}

std::vector<double> weights_over(const FitRecord& record) {
  const std::size_t n = record.at.size();
  std::vector<double> weights(n);
  for (std::size_t i = 0; i < n; ++i) {
    const double before = i > 0 ? record.at[i - 1] : record.at[n - 1] - record.period;
    const double after = i + 1 < n ? record.at[i + 1] : record.at[0] + record.period;
    weights[i] = 0.5 * (after - before) / record.period;
  }
  return weights;
}

std::optional<double> mean_speed_of(const FitRecord& record) {
  for (const RecordChannel& c : record.channels) {
    if (!c.channel.starts_with("speed.") || record.over != Over::angle) continue;
    const std::vector<double> weights = weights_over(record);
    double time = 0;
    for (std::size_t i = 0; i < weights.size(); ++i) time += weights[i] / c.mean[i];
    return 1 / time;
  }
  return {};
}

}  // namespace kurbel
