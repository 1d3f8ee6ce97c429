// reduce.cpp — reduction of inertias and torques at positions of the cycle, harmonics, elastic chain.
#include "studies/reduce/reduce.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "engine/numerics/angles.h"
#include "engine/numerics/deadline.h"
#include "engine/numerics/index.h"
#include "engine/orbit/default_moment.h"
#include "engine/scene/units.h"
#include "engine/values/dense_tables.h"
#include "studies/reduce/along_cycle.h"
#include "studies/reduce/mechanism_words.h"
#include "studies/reduce/targets.h"
#include "studies/validity/outside_data.h"
#include "studies/validity/substitutes.h"

namespace kurbel {
namespace {

constexpr double looser_sampling = 1e-9;

class Reducer : MachineOnBasis {
 public:
  Reducer(const Scene& scene, const ReduceOptions& options)
      : scene_(as_of(scene, scene.effects, options.at)), options_(options) {
    r_.is_of(scene);
  }

  MachineReduction run() {
    const auto whole = compile_at(scene_, scene_.effects, options_.at);
    if (const std::optional<AngleRange> range = rocking_range(*whole, options_.range))
      look_over(*range);
    else
      r_.basis = choose_basis(scene_, options_.at, options_.basis, !options_.speed);
    r_.link = model().node_label(model().reduction_node);
    choose_target();
    if (machine_) {
      r_.begin = machine_->begin(), r_.cycle = machine_->cycle();
      drive_slope_ = choose_speed(*machine_, options_, r_);
      if (!beyond_.empty() && !options_.speed && machine_->uses_speed())
        r_.speed_source += "; an estimate: " + omitted();
    } else {
      find_cycle();
    }
    const Model& m = model();  // without a cycle it is another one
    for (const WorkAccount& account : m.accounts)
      r_.accounts.push_back(fmt::format("{} ({})", account.name, name_of(account.kind)));
    r_.constant_inertia = on_link() / (r_.to_ratio * r_.to_ratio);
    for (int k = 0; k < options_.positions + (r_.over_a_range ? 1 : 0); ++k)
      r_.positions.push_back(position(k, whole_way().place(k, options_.positions)));
    add_curve();
    add_spectra();
    if (machine_) r_.outside_data = outside_data(*machine_, r_.speed);
    if (!r_.outside_data.empty()) drop_errors();
    r_.chain = elastic_chain(m, target_node_);
    add_notes();
    r_.paths = point_paths(model());
    if (options_.also)
      for (const double phi : options_.also(r_)) r_.also.push_back(position(-1, phi));
    return std::move(r_);
  }

 private:
  // A crank that rocks has no steady cycle over its angle.
  void look_over(const AngleRange& range) {
    if (options_.basis == CycleBasis::steady)
      throw std::invalid_argument("--basis steady: a crank that rocks has no steady cycle over its angle");
    beyond_ = beyond_the_rigid_machine(scene_, options_.at);
    machine_.emplace(compile_at(scene_, classical_effects(scene_), options_.at), range);
    r_.over_a_range = true;
  }

  AngleRange whole_way() const { return {r_.begin, r_.begin + r_.cycle}; }
  double on_link() const { return machine_ ? machine_->constant_inertia() : constant_inertia(*model_); }

  Orbit orbit_of(std::shared_ptr<const Model> model, int most_periods) const {
    OrbitOptions options = orbit_options(scene_.run);
    options.most_periods = most_periods;
    Orbit orbit = find_orbit(std::move(model), options);
    Deadline::check();
    return orbit;
  }
  void find_cycle() {
    if (options_.speed)
      throw std::invalid_argument(
          fmt::format("--speed: the torques depend on more than angle and speed ({}), so they are those along the "
                      "steady cycle, which has its own speed; omit the option, or use --basis classical",
                      fmt::join(beyond_, ", ")));
    const Orbit orbit = orbit_of(model_, OrbitOptions{}.most_periods);
    if (!orbit.repeats()) return without_a_cycle(orbit.words);
    const bool other = target_node_ != model().reduction_node;
    const std::vector<int> nodes = other ? std::vector<int>{target_node_} : std::vector<int>{};
    try {
      along_.emplace(orbit_cycle(orbit, nodes), other ? target_node_ : -1);
    } catch (const std::invalid_argument& error) {  // the link turns back
      return without_a_cycle(error.what());
    }
    looser_ = looser_orbit_cycle(orbit, nodes);
    r_.outside_data = outside_data(*orbit.map, orbit.point);
    r_.cycle = along_->cycle().way();
    r_.sense = along_->cycle().sense;
    r_.to_ratio = along_->mean_ratio();
    r_.speed = r_.sense * along_->cycle().mid_speed();
    r_.speed_source = "the mid speed of the steady cycle that the scene's start leads to";
  }
  // The rigid machine still gives inertia, and torques at a given speed.
  void without_a_cycle(const std::string& why) {
    const std::string text = fmt::format("there is no steady cycle to look at: {}", why);
    if (options_.basis) throw std::invalid_argument(text);
    try {
      make_rigid(scene_, options_.at);
    } catch (const std::invalid_argument&) {
      throw std::invalid_argument(
          fmt::format("the torques depend on more than angle and speed ({}), and {}", fmt::join(beyond_, ", "), text));
    }
    r_.basis = CycleBasis::classical;
    has_cycle_ = false;
    r_.notes.push_back(text);
    r_.cycle = machine_->cycle();
    drive_slope_ = choose_speed(*machine_, options_, r_);
  }
  std::string omitted() const {
    return fmt::format("{} {} omitted", fmt::join(beyond_, ", "), beyond_.size() == 1 ? "is" : "are");
  }

  void choose_target() {
    target_node_ = model().reduction_node;
    r_.to = r_.link;
    if (options_.to.empty()) return;
    const std::string& to = options_.to;
    if (to.ends_with(".slider") || to.ends_with(".rocker")) {
      slider_ = std::make_unique<SliderRatio>(compile_at(scene_, classical_effects(scene_), options_.at),
                                              to.substr(0, to.size() - 7));
      if (!slider_->found() || slider_->rocks() != to.ends_with(".rocker")) refuse_target(model(), to);
      r_.to = to;
      r_.to_output = true;
      r_.to_rocker = slider_->rocks();
      r_.turns_back = least_ratio() < 0.15 * largest_ratio();
      note_motion_of_output();
      return;
    }
    target_node_ = node_named(model(), to);
    r_.to = to;
    r_.to_ratio = model().node_ratio[at(target_node_)];
  }

  // Whether an oscillating output may be the reduction link itself.
  void note_motion_of_output() {
    if (r_.over_a_range && r_.turns_back) {
      r_.notes.push_back(
          fmt::format("{} moves to and fro: near its dead centres quantities reduced to it grow as 1/x′² and 1/x′, and "
                      "figures hold "
                      "between them",
                      r_.to));
      return;
    }
    const bool rocks = r_.to_rocker;
    const std::string equation = rocks ? "I_r ε + ½ I_r′ ω² = M_d − M_c" : "m_r a + ½ m_r′ v² = F_d − F_c";
    r_.notes.push_back(
        r_.turns_back
            ? fmt::format("{} moves to and fro: near its dead centres quantities reduced to it grow as 1/x′² and 1/x′, "
                          "and figures hold between them; its mean velocity over a cycle is zero, so that it has no δ: "
                          "kurbel steady gives that of \"{}\". Between two dead centres it moves by {}, but no motion "
                          "goes through them that way: kurbel run integrates it over time",
                          r_.to, r_.link, equation)
            : fmt::format(
                  "{} may be the reduction link: it moves by {} throughout, which is the equation of \"{}\" over x′; "
                  "kurbel run integrates it over time and records its position, velocity and acceleration",
                  r_.to, equation, r_.link));
  }

  // On the link first; then all inertias over the square of the ratio, all torques over the ratio.
  ReducedPosition position(int number, double phi) {
    if (machine_) machine_->set_modes(phi, r_.speed);
    const RigidMachine::At on_link = machine_ ? machine_->at(phi, r_.speed, true) : along_->at(phi);
    const double mechanism = machine_ ? machine_->mechanism_inertia(phi).value : along_->mechanism_inertia(phi);
    ReducedPosition p;
    p.number = number;
    p.phi = phi;
    std::tie(p.omega, p.alpha) = along_ ? along_->motion(phi) : std::pair(r_.speed, 0.0);
    double ratio = r_.to_ratio, second = 0;
    if (along_) {
      const RatioAt turning = along_->ratio(phi);
      ratio = turning.first, second = turning.second;
      if (std::abs(ratio) < 1e-9) {
        p.singular = "it stands still, so what is reduced to it is infinite";
        return p;
      }
    }
    if (slider_) {
      const RatioAt x = (*slider_)(phi);
      ratio = x.first, second = x.second;
      p.ratio = ratio;
      if (std::abs(ratio) < 1e-9 * largest_ratio()) {
        p.singular = "dead centre: it stands still, so what is reduced to it is infinite";
        return p;
      }
    }
    const double squared = ratio * ratio;
    p.inertia = on_link.inertia / squared;
    p.mechanism_inertia = mechanism / squared;
    p.drive_inertia = machine_ ? machine_->constant_inertia() / squared : p.inertia - p.mechanism_inertia;
    // By the coordinate of the target: d(I/x′²)/dx = (I′ − 2 I x″/x′)/x′³.
    p.slope = (on_link.slope - 2 * on_link.inertia * second / ratio) / (squared * ratio);
    for (std::size_t k = 0; k < on_link.share.size(); ++k) {
      const double share = on_link.share[k] / ratio;
      p.share.push_back(share);
      (model().accounts[k].kind == Account::driving ? p.drive : p.load) += share;
    }
    p.load = -p.load + 0.0;
    return p;
  }

  double largest_ratio() {
    if (largest_ratio_ == 0)
      for (int k = 0; k < 64; ++k) largest_ratio_ = std::max(largest_ratio_, std::abs((*slider_)(sample(k)).first));
    return largest_ratio_;
  }

  // In the sense of the greatest ratio: < 0 if it reverses.
  double least_ratio() {
    double least = HUGE_VAL, sense = (*slider_)(sample(0)).first < 0 ? -1 : 1;
    for (int k = 0; k < 64; ++k) least = std::min(least, sense * (*slider_)(sample(k)).first);
    return least;
  }
  // One of 64 angles of a turn or of the range.
  double sample(int k) const {
    const bool ranged = machine_ && machine_->has_range();
    return (ranged ? machine_->begin() : 0) + (ranged ? machine_->cycle() : turn) * (k + 0.3) / 64;
  }

  // Both sides of every edge are points of the curve.
  void add_curve() {
    constexpr int points = 720;
    std::vector<double> phis;
    for (int k = 0; k <= points; ++k) phis.push_back(whole_way().place(k, points));
    for (const double edge : edges()) {
      phis.push_back(edge - 1e-7);
      phis.push_back(edge + 1e-7);
    }
    std::sort(phis.begin(), phis.end());
    for (const double phi : phis) {
      if (!whole_way().holds(phi)) continue;
      ReducedPosition p = position(0, phi);
      // Near a dead centre the reduced mass leaves the plot range.
      if (slider_ && std::abs(*p.ratio) < 0.15 * largest_ratio()) continue;
      if (p.singular.empty()) r_.curve.push_back(std::move(p));
    }
  }
  std::vector<double> edges() {
    if (machine_) return machine_->periodic() || machine_->has_range() ? cycle_edges(*machine_) : std::vector<double>{};
    std::vector<double> list = along_->cycle().speed.breaks();
    if (along_->cycle().sense < 0)
      for (double& s : list) s = r_.cycle - s;
    return list;
  }

  // I_r, M_d and M_c over the cycle.
  using Functions = std::array<Piecewise, 3>;
  Functions functions_of(const OrbitCycle& c) const { return {c.inertia, c.cycle.drive, c.cycle.load}; }
  Functions functions_at(double sampling) {
    const MachineCycle c = machine_cycle(*machine_, r_.speed, sampling);
    return {c.mechanism.value + c.mechanism.value.constant(machine_->constant_inertia()), c.drive, c.load};
  }

  // Spectra, and with looser tolerances for the errors.
  void add_spectra() {
    if (machine_ && !machine_->periodic()) return;
    const Functions fine = machine_ ? functions_at(cycle_sampling) : functions_of(along_->cycle());
    std::optional<Functions> loose;
    if (machine_)
      loose = functions_at(looser_sampling);
    else if (looser_)
      loose = functions_of(*looser_);
    constexpr std::pair<const char*, const char*> named[] = {
        {"reduced inertia I_r", "kg*m2"}, {"driving torque M_d", "N*m"}, {"resisting torque M_c", "N*m"}};
    const int orders = static_cast<int>(std::lround(options_.orders * r_.cycle / turn));
    // What rounding of torques, and of the speed at which they balance, leaves where they cancel.
    const double dust = std::numeric_limits<double>::epsilon() *
                        std::max(16 * model().torque_scale, 4 * std::abs(drive_slope_ * r_.speed));
    for (std::size_t i = 0; i < fine.size(); ++i) {
      Spectrum s = spectrum(named[i].first, named[i].second, fine[i], orders);
      if (loose) {
        const Spectrum other = spectrum(named[i].first, named[i].second, (*loose)[i], orders);
        const double left =
            std::max(rounding * std::sqrt(s.mean_square) + (i > 0 || along_ ? within() : 0) * fine[i].largest(),
                     i > 0 ? dust : 0);
        for (std::size_t n = 0; n < s.harmonics.size(); ++n)
          s.harmonics[n].amplitude =
              estimate_from(s.harmonics[n].amplitude.value, other.harmonics[n].amplitude.value, left);
      }
      if (along_ && along_->cycle().sense < 0)
        for (Harmonic& h : s.harmonics) h.phase = -h.phase;
      // −180° and 180° are the same phase: rounding would choose between them.
      for (Harmonic& h : s.harmonics)
        if (h.phase < -pi + 1e-8) h.phase += turn;
      r_.spectra.push_back(std::move(s));
    }
    r_.mean_drive.value = fine[1].mean();
    r_.mean_load.value = fine[2].mean();
    if (!loose) return;
    r_.inertia_error = largest_difference(fine[0], (*loose)[0]) + (along_ ? within() * fine[0].largest() : 0);
    const double drive = std::max(within() * fine[1].largest(), dust),
                 load = std::max(within() * fine[2].largest(), dust);
    r_.drive_error = largest_difference(fine[1], (*loose)[1]) + drive;
    r_.load_error = largest_difference(fine[2], (*loose)[2]) + load;
    r_.mean_drive = estimate_from(r_.mean_drive.value, (*loose)[1].mean(), rounding * fine[1].largest() + drive);
    r_.mean_load = estimate_from(r_.mean_load.value, (*loose)[2].mean(), rounding * fine[2].largest() + load);
  }
  // For torques, and for inertia if it depends on the motion that they cause.
  void drop_errors() {
    for (std::optional<double>* error : {&r_.drive_error, &r_.load_error, &r_.mean_drive.error, &r_.mean_load.error})
      error->reset();
    if (along_) r_.inertia_error.reset();
    for (std::size_t i = along_ ? 0 : 1; i < r_.spectra.size(); ++i)
      for (Harmonic& h : r_.spectra[i].harmonics) h.amplitude.error.reset();
  }
  double within() const { return left_by_tables(scene_); }
  void add_notes() {
    for (const auto notes_of : {substitutes, mechanism_notes})
      for (const std::string& note : notes_of(model())) r_.notes.push_back(note);
    if (machine_ && machine_->uses_time())
      r_.notes.push_back("some torque depends on time; the torques are those at t = 0");
    if (r_.over_a_range)
      r_.notes.push_back(
          fmt::format("a crank rocks: all is over a range of the angle of {}, {:.4g}° to {:.4g}°, and there are no "
                      "harmonics; towards "
                      "the ends of its arc what is reduced to it has no bound (--range gives another range)",
                      r_.link, r_.begin / degree, (r_.begin + r_.cycle) / degree));
    else if (machine_ && !machine_->periodic())
      r_.notes.push_back("the machine has no cycle, its parts never come back together; there are no harmonics");
    add_note_on_basis();
    add_note_on_peaks();
    if (slider_) {
      r_.notes.push_back(
          fmt::format("forces on {} count along its way: they drive where they have the sign of its speed x′", r_.to));
      std::string omitted;
      for (const ReducedPosition& p : r_.positions)
        if (!p.singular.empty())
          omitted += fmt::format("{}{} ({:.4g}°)", omitted.empty() ? "" : ", ", p.number, p.phi * 360 / turn);
      if (!omitted.empty())
        r_.notes.push_back(fmt::format(
            "omitted: position {}: a dead centre, where {} stands still; {} are infinite there", omitted, r_.to,
            r_.to_rocker ? "reduced inertia I_r/x′² and torque M/x′"
                         : "reduced mass m_r = I_r/x′² and force F_r = M/x′"));
    }
  }

  // Along a cycle: the motion is included; at constant speed: the difference to the steady cycle.
  void add_note_on_basis() {
    if (along_) {
      r_.notes.push_back(fmt::format(
          "torques and reduced inertia are those along the steady cycle with the scene's effects: they are "
          "not functions of one angle and its speed alone, because of {}; I_r = 2T/ω², I_drive = I_r − I_em",
          fmt::join(beyond_, ", ")));
      if (r_.sense < 0)
        r_.notes.push_back(
            fmt::format("\"{}\" turns backwards: torques count along its motion, M_d > 0 drives it on", r_.link));
      if (r_.mean_drive.value < -r_.mean_drive.error.value_or(rounding * std::abs(r_.mean_drive.value)))
        r_.notes.push_back(fmt::format("the drive brakes on average: it takes {} from the machine",
                                       with_unit(-r_.mean_drive.value * along_->cycle().mean_speed(), "W", 4)));
      return;
    }
    if (!beyond_.empty()) r_.notes.push_back("classical: " + omitted());
    if (!machine_->uses_speed() || !machine_->periodic() || !has_cycle_ || options_.speed) return;
    constexpr int enough_periods = 40;
    try {
      const Orbit orbit = orbit_of(compile_at(scene_, scene_.effects, options_.at), enough_periods);
      if (!orbit.repeats()) return;
      const OrbitCycle c = orbit_cycle(orbit);
      double off = 0;
      for (int k = 0; k < 64; ++k) {
        const double s = c.way() * (k + 0.5) / 64;
        const double rigid = machine_->constant_inertia() + machine_->mechanism_inertia(c.sense * s).value;
        off = std::max(off, std::abs(c.inertia.value(s) / rigid - 1));
      }
      r_.notes.push_back(fmt::format(
          "classical: at constant speed, rigid; the fluctuation of the speed is neglected{}: in the steady cycle (mid "
          "speed {}) the mean driving torque is {}, the mean resisting torque {}, and 2T/ω² {}",
          and_effects(), r_.speed_unit.text(c.mid_speed(), 4), in_place_of(c.cycle.drive.mean(), r_.mean_drive.value),
          in_place_of(c.cycle.load.mean(), r_.mean_load.value),
          off < 1e-6 ? "is I_r" : fmt::format("differs from I_r by {:.2g} % at most", 100 * off)));
    } catch (const std::invalid_argument&) {  // no steady cycle over the link's angle
    }
  }
  // "17.51 N·m instead of 16.2 N·m"; "as here" if four digits are equal, or if the
  // difference is within the precision of the steady motion.
  std::string in_place_of(double really, double here) const {
    constexpr double precision = 1e-8;  // of the torques
    const std::string a = fmt::format("{:.4g} N·m", really), b = fmt::format("{:.4g} N·m", here);
    const bool equal = a == b || std::abs(really - here) <= precision * model().torque_scale;
    return equal ? b + ", as here" : a + " instead of " + b;
  }
  std::string and_effects() const {
    return scene_.effects.describe() == "none" ? "" : fmt::format(", and {}", scene_.effects.describe());
  }

  // Twelve positions may miss a peak of ten degrees.
  void add_note_on_peaks() {
    double seen = 0;
    for (const ReducedPosition& p : r_.positions) seen = std::max(seen, std::abs(p.load));
    const auto peak = std::max_element(r_.curve.begin(), r_.curve.end(), [](const auto& a, const auto& b) {
      return std::abs(a.load) < std::abs(b.load);
    });
    if (peak == r_.curve.end() || std::abs(peak->load) <= 1.05 * seen) return;
    r_.notes.push_back(
        fmt::format("between the positions the resistance reaches {} at {:.4g}°; more --positions show it",
                    with_unit(peak->load, r_.to_output && !r_.to_rocker ? "N" : "N*m", 4), peak->phi * 360 / turn));
  }

  static constexpr double rounding = rounding_of_reduction;

  const Scene scene_;
  const ReduceOptions& options_;
  std::optional<AlongCycle> along_;
  std::optional<OrbitCycle> looser_;
  MachineReduction r_;
  int target_node_ = 0;
  double drive_slope_ = 0;  // of choose_speed
  bool has_cycle_ = true;   // as far as it is known
  std::unique_ptr<SliderRatio> slider_;
  double largest_ratio_ = 0;
};

}  // namespace

MachineReduction reduce(const Scene& scene, const ReduceOptions& options) {
  const Deadline deadline(scene.run.budget);
  ReduceOptions asked = options;
  const std::string later = choose_default_moment(scene, scene.effects, orbit_options(scene.run), asked.at);
  MachineReduction reduction = Reducer(scene, asked).run();
  if (!later.empty()) reduction.notes.push_back(later);
  return reduction;
}

}  // namespace kurbel
