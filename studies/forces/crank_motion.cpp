// crank_motion.cpp — the cycle's abscissae, loads on the output, peaks and motion between abscissae.
#include "studies/forces/crank_motion.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <stdexcept>

#include "engine/base/gauss.h"
#include "engine/model/model.h"
#include "engine/numerics/angles.h"
#include "engine/numerics/deadline.h"
#include "engine/numerics/roots.h"
#include "engine/scene/units.h"
#include "engine/values/dense_tables.h"
#include "mechanisms/kinds/kinds.h"
#include "mechanisms/link_forces/link_forces.h"
#include "mechanisms/reduced/mechanism.h"
#include "studies/cycle/classical.h"
#include "studies/validity/outside_data.h"

namespace kurbel {
namespace {

constexpr int grid_of_turn = 720;  // peaks are sought on this grid, work is integrated between its points

std::size_t index(int i) { return static_cast<std::size_t>(i); }

// A step sets a load by the mechanism's name or by its own.
bool sets(const SequenceStep& step, const std::string& component, const std::string& load) {
  return std::any_of(step.set.begin(), step.set.end(), [&](const std::string& said) {
    return said == component || said == load || load.starts_with(said + ".");
  });
}

// Empty where all act.
ActingLoads some_of(ActingLoads acting) {
  return std::find(acting.begin(), acting.end(), false) == acting.end() ? ActingLoads() : std::move(acting);
}

// What holds at the end of the sequence: a load acts where neither its mechanism nor itself was switched off last.
ActingLoads left_by(const Sequence& sequence, const std::string& component, const std::vector<SliderLoad>& loads) {
  if (sequence.repeat) return {};
  ActingLoads left(loads.size(), true);
  for (std::size_t k = 0; k < loads.size(); ++k) {
    std::map<std::string, bool> on;
    for (const SequenceStep& step : sequence.steps)
      for (const std::string& said : step.set)
        if (said == component || said == loads[k].name || loads[k].name.starts_with(said + "."))
          on[said] = step.to > 0.5;
    for (const auto& [said, acts] : on)
      if (!acts) left[k] = false;
  }
  return some_of(std::move(left));
}

// Crank angle at the scene's start [rad]. Throws as compile.
double crank_angle_at_start(const AskedMechanism& asked) {
  const auto model = compile(asked.scene, classical_effects(asked.scene));
  const Network::ShaftElement& crank = mechanism_element(model->network, asked.name);
  return model->node_ratio[index(crank.node)] * reduction_angle_at_start(*model) + crank.phase;
}

// With the loads that act in the end; of a sequence that repeats: with all.
std::shared_ptr<const Model> alone(const AskedMechanism& asked, const Effects& effects) {
  Network network;
  const int node = network.add_node(asked.name, "", 1);  // kg·m²; forces do not see it
  network.ports[asked.name] = {node, node};
  network.components = {asked.name};
  network.put(node, asked.name, mechanism_element(asked.network, asked.name).element, {}, 0);
  for (const Network::ShaftElement& e : asked.network.elements)
    if (e.component.starts_with(asked.name + ".")) network.put(node, e.component, e.element, {}, 0);
  const ActingLoads left = left_by(asked.scene.sequence, asked.name, asked.mechanism().loads);
  for (Network::DataRange range : asked.network.ranges) {
    if (range.component != asked.name || (range.part >= 0 && !left.empty() && !left[index(range.part)])) continue;
    range.node = node;
    network.ranges.push_back(std::move(range));
  }
  Scene bare;
  bare.file = asked.scene.file;
  if (asked.mechanism().arc()) bare.run.start.angle = crank_angle_at_start(asked);
  return compile_network(std::move(network), bare, bare_machine(effects));
}

RigidMachine over(const std::shared_ptr<const Model>& model, const std::optional<AngleRange>& range) {
  return {model, rocking_range(*model, range)};
}

}  // namespace

// --- loads ---

const Network::ShaftElement& mechanism_element(const Network& network, const std::string& component) {
  for (const Network::ShaftElement& e : network.elements)
    if (e.component == component && e.element->cycle > 0) return e;
  throw std::logic_error("mechanism without an element");
}

AskedMechanism::AskedMechanism(const Scene& of, const std::string& wanted)
    : scene(of),
      name(chosen_mechanism(of, wanted).name),
      kind(chosen_mechanism(of, wanted).kind->name),
      network(build_network(with_rougher_tables(of, 0))) {}

const Mechanism& AskedMechanism::mechanism() const { return *find_mechanism(network, name); }

OutputLoads::OutputLoads(const AskedMechanism& asked, const Effects& effects, const std::optional<AngleRange>& range)
    : machine_(over(alone(asked, effects), range)),
      mechanism_(*find_mechanism(model().network, asked.name)),
      within_(link_forces_of(model().network, asked.name)) {
  const std::vector<SliderLoad>& loads = mechanism_.loads;
  const Sequence& sequence = asked.scene.sequence;
  const auto touched = [&](const SliderLoad& load) {
    return std::any_of(sequence.steps.begin(), sequence.steps.end(),
                       [&](const SequenceStep& step) { return sets(step, asked.name, load.name); });
  };
  repeats_ = sequence.repeat && std::any_of(loads.begin(), loads.end(), touched);
  left_ = left_by(sequence, asked.name, loads);
  for (const WorkAccount& account : model().accounts) {
    const auto of =
        std::find_if(loads.begin(), loads.end(), [&](const SliderLoad& l) { return l.name == account.name; });
    of_account_.push_back(of == loads.end() ? -1 : static_cast<int>(of - loads.begin()));
  }
}

std::vector<double> OutputLoads::edges(int direction) {
  std::vector<double> all = machine_.edges(direction);
  if (!repeats()) {  // angles of the range itself
    all.insert(all.end(), added_.begin(), added_.end());
    std::erase_if(all, [&](double e) { return !(begin() < e && e < begin() + cycle()); });
  }
  for (double begin = 0; repeats() && begin < cycle() - 1e-9; begin += turn)
    for (const double e : added_) {
      const double edge = begin + e - turn * std::floor(e / turn);
      if (std::none_of(all.begin(), all.end(),
                       [&](double k) { return std::abs(std::remainder(k - edge, cycle())) < 1e-7; }))
        all.push_back(edge);
    }
  std::sort(all.begin(), all.end());
  return all;
}

std::string OutputLoads::words_of_sequence() const {
  if (repeats_)
    return fmt::format(
        "the operating sequence switches loads of {} within its repetition: with the crank at constant speed all act, "
        "in the motion of the machine those that are on",
        mechanism_.name);
  std::vector<std::string> off;
  for (std::size_t k = 0; k < left_.size(); ++k)
    if (!left_[k]) off.push_back(mechanism_.loads[k].name);
  if (off.empty()) return {};
  return fmt::format("loads of {} count as the operating sequence leaves them: switched off{}", mechanism_.name,
                     off.size() == mechanism_.loads.size() ? "" : " " + listed(off, "and"));
}

// Two whole turns are taken out of the angle as the equations do it.
double OutputLoads::force(double phi, const CrankMotion& motion) const {
  Modes modes;
  modes.turns = {0};
  std::array<double, 1> angle = {within(phi)};
  wrap(modes, angle);
  return mechanism_.load(angle[0], motion.omega, motion.loads);
}

LinkageState OutputLoads::state(double phi, const CrankMotion& motion, const PlanarLinkage& at) const {
  LinkageState state{phi, motion.omega, motion.alpha, force(phi, motion)};
  if (within_.empty()) return state;
  const LinkPoses poses = within_.front()->data.as<LinkageTravelData>()->linkage->poses(phi);
  for (const Mechanism* force : within_)
    add_actions(*force->data.as<LinkageTravelData>(), force->load(within(phi), motion.omega), poses, at, state.applied);
  return state;
}

std::vector<std::string> OutputLoads::outside_data(double speed) { return kurbel::outside_data(machine_, speed); }

std::span<const double> OutputLoads::shares(double phi, const CrankMotion& motion) {
  machine_.set_modes(within(phi), motion.omega);
  const std::span<const double> all = machine_.at(within(phi), motion.omega, true).share;
  if (motion.loads.empty()) return all;
  acting_.assign(all.begin(), all.end());
  for (std::size_t i = 0; i < acting_.size(); ++i)
    if (of_account_[i] >= 0 && !motion.loads[index(of_account_[i])]) acting_[i] = 0;
  return acting_;
}

ActingLoads acting_loads(const Model& model, std::size_t element, const Instant& now) {
  const Network::ShaftElement& e = model.network.elements[element];
  const int of_element = model.command_of(e.component);
  if (of_element < 0) return {};
  const double* command = now.command + of_element;
  ActingLoads on;
  for (std::size_t k = 0; k < mechanism_of(e)->mechanism().loads.size(); ++k)
    on.push_back(command[0] > 0.5 && command[k + 1] > 0.5);
  return some_of(std::move(on));
}

// --- where the cycle is examined ---

namespace {

// Cells of the grid and rows of all of it; those up to an angle are rows.
struct Positions {
  int cells = 0, rows = 0;
  double rows_end = HUGE_VAL;
};

std::vector<Abscissa> abscissae(const AngleRange& range, bool repeats, const std::vector<double>& edges, int direction,
                                const Positions& wanted) {
  const double cycle = range.to - range.from;
  const int cells = wanted.cells, rows = wanted.rows;
  std::vector<double> knots;
  for (int i = 0; i <= cells; ++i) knots.push_back(range.place(i, cells));
  knots.insert(knots.end(), edges.begin(), edges.end());
  std::sort(knots.begin(), knots.end());
  std::vector<Abscissa> all;
  for (int i = 0; i <= cells; ++i) all.push_back({.phi = range.place(i, cells), .grid = true});
  for (int i = 0; i <= rows && cycle * i / rows <= wanted.rows_end * (1 + 1e-12); ++i) {
    if (i * cells % rows == 0)
      all[index(i * cells / rows)].row = true;
    else
      all.push_back({.phi = range.place(i, rows), .row = true});
  }
  for (std::size_t i = 0; i + 1 < knots.size(); ++i) {
    const double half = 0.5 * (knots[i + 1] - knots[i]), middle = 0.5 * (knots[i + 1] + knots[i]);
    if (half <= 1e-12) continue;
    for (std::size_t k = 0; k < 3; ++k)
      all.push_back({.phi = middle + half * gauss<3>.x[k], .weight = half * gauss<3>.w[k]});
  }
  for (const double edge : edges)
    for (const double phi : {edge - beside, edge + beside}) {
      const double within = !repeats ? phi : phi < 0 ? phi + cycle : phi > cycle ? phi - cycle : phi;
      if (within > range.from && within < range.to)
        all.push_back({.phi = within, .side = phi < edge ? -direction : direction});
    }
  const auto apart = [&](double phi, double edge) { return repeats ? std::remainder(phi - edge, cycle) : phi - edge; };
  for (Abscissa& a : all)
    if (a.grid || a.row)
      for (const double edge : edges)
        if (std::abs(apart(a.phi, edge)) < 0.5 * beside) a.aside = 0.5 * direction * beside, a.side = 1;
  std::stable_sort(all.begin(), all.end(), [](const Abscissa& a, const Abscissa& b) { return a.phi < b.phi; });
  return all;
}

}  // namespace

std::vector<Abscissa> abscissae(double cycle, const std::vector<double>& edges, int direction, int rows_of_turn,
                                double rows_end) {
  const int turns = static_cast<int>(std::lround(cycle / turn));
  return abscissae({0, cycle}, true, edges, direction, {grid_of_turn * turns, rows_of_turn * turns, rows_end});
}

std::vector<Abscissa> abscissae(const AngleRange& range, const std::vector<double>& edges, int direction, int rows) {
  return abscissae(range, false, edges, direction, {grid_of_turn, rows});
}

// --- peaks ---

Peak peak_of(const std::vector<double>& phi, const std::vector<double>& values,
             const std::function<double(double)>& value) {
  constexpr double same_peak = 1e-9;  // of its value
  constexpr double may_grow = 1e-3;   // of its value: by more no peak between samples so close rises above them
  double largest = 0;
  for (const double v : values) largest = std::max(largest, std::abs(v));
  Peak peak{{values.front()}, phi.front()};
  if (largest == 0) return peak;
  const auto consider = [&](double v, double where) {
    if (std::abs(v) > (1 + same_peak) * std::abs(peak.value)) peak = {{v}, where};
  };
  constexpr int most_refined = 16;  // a force that stays the same has a peak of rounding at every other sample
  int refined = 0;
  const std::size_t n = values.size();
  for (std::size_t i = 0; i < n; ++i) {
    const double here = std::abs(values[i]);
    if (here < (1 - may_grow) * largest) continue;
    if ((i > 0 && std::abs(values[i - 1]) > here) || (i + 1 < n && std::abs(values[i + 1]) > here)) continue;
    Peak local{{values[i]}, phi[i]};
    const double sense = values[i] < 0 ? -1 : 1;
    const bool refine = ++refined <= most_refined;
    for (const std::size_t k : {i, i + 1}) {  // the pieces before and after it
      if (!refine) break;
      // Within an edge nothing is to be found that its two sides do not say.
      if (k == 0 || k >= n || !(phi[k] - phi[k - 1] > 2.5 * beside)) continue;
      const auto [where, found] = find_maximum([&](double x) { return sense * value(x); }, phi[k - 1], phi[k], 40);
      if (found > sense * local.value) local = {{sense * found}, where};
    }
    consider(local.value, local.phi);
  }
  return peak;
}

Peak measured_peak_of(const std::vector<double>& phi, const std::vector<double>& values,
                      const std::function<double(double)>& value, double scale) {
  Peak peak = peak_of(phi, values, value);
  std::vector<double> wide_phi, wide;
  // Samples at a load's edge stand for one side of it: no other sample shows a peak there.
  const auto at_edge = [&](std::size_t i) {
    return (i > 0 && phi[i] - phi[i - 1] < 2.5 * beside) || (i + 1 < phi.size() && phi[i + 1] - phi[i] < 2.5 * beside);
  };
  for (std::size_t i = 0; i < phi.size(); ++i)
    if (i % 2 == 0 || i + 1 == phi.size() || at_edge(i)) wide_phi.push_back(phi[i]), wide.push_back(values[i]);
  const double other = peak_of(wide_phi, wide, value).value;
  peak.error = std::abs(std::abs(peak.value) - std::abs(other)) + rounding_of_forces * scale;
  return peak;
}

// Motion between the samples: z = ω²/2 by Hermite's interpolation, its slope being ε, through the samples on either
// side and, where no load edge lies between, the next ones: of degree 3 … 7, which leaves rounding.
CrankMotion motion_between(const std::vector<MotionSample>& samples, double phi) {
  const auto after = std::upper_bound(samples.begin() + 1, samples.end() - 1, phi,
                                      [](double x, const MotionSample& p) { return x < p.phi; });
  const auto i = static_cast<std::size_t>(after - samples.begin());
  const auto smooth = [&](std::size_t k) {  // the piece that ends there
    return samples[k].phi - samples[k - 1].phi > 2.5 * beside;
  };
  std::size_t from = i - 1, to = i;
  const double begin = samples[from].phi, h = samples[to].phi - begin;
  // Over so short a piece a difference of speeds is rounding.
  if (!smooth(i)) {
    const CrankMotion& side = samples[phi - begin < 0.5 * h ? from : to].motion;
    return side;
  }
  if (from > 0 && smooth(from)) --from;
  if (to + 1 < samples.size() && smooth(to + 1)) ++to;
  // Divided differences over doubled nodes, the angle counted in h.
  constexpr std::size_t most = 8;
  std::array<double, most> x{}, c{};
  std::size_t n = 0;
  for (std::size_t k = from; k <= to; ++k)
    for (int twice = 0; twice < 2; ++twice) {
      x[n] = (samples[k].phi - begin) / h;
      c[n++] = 0.5 * samples[k].motion.omega * samples[k].motion.omega;
    }
  for (std::size_t order = 1; order < n; ++order)
    for (std::size_t k = n - 1; k >= order; --k)
      c[k] = order == 1 && k % 2 ? h * samples[from + k / 2].motion.alpha : (c[k] - c[k - 1]) / (x[k] - x[k - order]);
  const double u = (phi - begin) / h;
  double z = c[n - 1], slope = 0;
  for (std::size_t k = n - 1; k-- > 0;) {
    slope = slope * (u - x[k]) + z;
    z = z * (u - x[k]) + c[k];
  }
  return {std::copysign(std::sqrt(2 * std::max(0.0, z)), samples[i].motion.omega), slope / h, samples[i].motion.loads};
}

std::pair<Estimate, Estimate> speed_range(const std::vector<MotionSample>& samples) {
  const auto by_speed = [](const MotionSample& a, const MotionSample& b) { return a.motion.omega < b.motion.omega; };
  const auto [lowest, highest] = std::minmax_element(samples.begin(), samples.end(), by_speed);
  const double low = lowest->motion.omega, high = highest->motion.omega;
  const double scale = std::max(std::abs(low), std::abs(high));
  std::vector<double> phi;
  for (const MotionSample& s : samples) phi.push_back(s.phi);
  // By how much the speed lies above `from`, in this sense, at the most.
  const auto beyond = [&](double from, double sense) {
    std::vector<double> values;
    for (const MotionSample& s : samples) values.push_back(sense * (s.motion.omega - from));
    return measured_peak_of(
        phi, values, [&](double x) { return sense * (motion_between(samples, x).omega - from); }, scale);
  };
  const Peak above = beyond(low, 1), below = beyond(high, -1);
  return {{high - below.value, below.error}, {low + above.value, above.error}};
}

// --- the machine ---

const Section& chosen_mechanism(const Scene& scene, const std::string& wanted) {
  std::vector<std::string> names, kinds;
  for (const Kind& kind : mechanism_kinds()) kinds.push_back(kind.name);
  for (const Section& s : scene.components) {
    if (std::find(kinds.begin(), kinds.end(), s.kind->name) == kinds.end()) continue;
    if (wanted.empty() || s.name == wanted) return s;
    names.push_back(s.name);
  }
  if (names.empty())
    throw std::invalid_argument(fmt::format(
        "{}: forces are found in the joints of mechanisms ({}), and there is none on its lines; add one (kurbel keys "
        "{}), or see the torques of joints (kurbel run), forces of teeth (kurbel gears)",
        scene.file, listed(kinds), kinds.front()));
  throw std::invalid_argument(
      fmt::format("--mechanism {}: no mechanism of that name; allowed: {}", wanted, listed(names)));
}

void check(const ForcesOptions& options) {
  if (options.speed && !(std::isfinite(*options.speed) && *options.speed != 0))
    throw std::invalid_argument(fmt::format("--speed {}: must be a speed ≠ 0, e.g. \"300 rpm\"", *options.speed));
}

PrescribedCycle prescribed_cycle(OutputLoads& loads, double speed) {
  return {loads.cycle(), speed, loads.edges(speed < 0 ? -1 : 1), [&loads, speed](double phi) {
            return loads.force(phi, {speed, 0, loads.left()});
          }};
}

MotionAlong steady_motion(OutputLoads& loads, double speed, int positions) {
  MotionAlong along;
  along.begin = loads.begin(), along.cycle = loads.cycle(), along.repeats = loads.repeats();
  const int direction = speed < 0 ? -1 : 1;
  const std::vector<double> edges = loads.edges(direction);
  along.where = along.repeats ? abscissae(along.cycle, edges, direction, positions)
                              : abscissae({along.begin, along.begin + along.cycle}, edges, direction, positions);
  if (!along.repeats && direction < 0) std::reverse(along.where.begin(), along.where.end());
  along.motion.assign(along.where.size(), {speed, 0, loads.left()});
  return along;
}

double MotionAlong::mean_speed() const {
  double sum = 0;
  for (std::size_t i = 0; i < where.size(); ++i) sum += where[i].weight / std::abs(motion[i].omega);
  return std::copysign(cycle / (time > 0 ? time : sum), motion.front().omega);
}

MotionAlong sped_up(MotionAlong along, double by) {
  along.time /= 1 + by;
  for (CrankMotion& m : along.motion) m.omega *= 1 + by, m.alpha *= (1 + by) * (1 + by);
  return along;
}

double closure_of(const MotionAlong& along) {
  return (along.motion.back().omega - along.motion.front().omega) / along.mean_speed();
}

double still_to_come(const std::vector<double>& course, double noise) {
  if (course.size() < 3) return HUGE_VAL;
  const std::size_t last = course.size() - 1, quarter = std::max<std::size_t>(1, last / 4);
  const double now = course[last] - course[last - quarter];
  const double before = course[last - quarter] - course[last - 2 * quarter];
  if (std::abs(now) <= noise) return 0;
  constexpr double no_nearer =
      0.999;  // of the quarter before: shrinking so slowly cannot be distinguished from a straight run
  if (!(std::abs(now) < no_nearer * std::abs(before))) return HUGE_VAL;
  const double ratio = now / before;
  return std::abs(now) * (ratio > 0 ? ratio / (1 - ratio) : 1);
}

}  // namespace kurbel
