// reach_sized.cpp — finds δ of the sized machine's steady motion, and the flywheel for the demanded δ.
#include "studies/size/reach_sized.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "studies/cycle/classical.h"
#include "studies/run/compare.h"

namespace kurbel {
namespace {

constexpr const char* by_work = "Wittenbauer";

class Reach {
 public:
  Reach(Sizing& sizing, const Scene& scene, const SizeOptions& options, std::optional<double> start_speed)
      : s_(sizing),
        scene_(scene),
        options_(options),
        others_(s_.motor_inertia + s_.gearbox_inertia + s_.other_inertia),
        start_speed_(start_speed),
        orbits_(scene, parts(sizing, options), options.simulation.watch) {}

  void run() {
    if (!s_.needed) return look_without();
    if (s_.basis == CycleBasis::classical && !s_.operating) return reach_family();
    reach();
  }

 private:
  // A member of a family is found at once or never: elastic losses brake a drive that balances the rigid load only.
  static SizedOrbits::Parts parts(const Sizing& s, const SizeOptions& options) {
    SizedOrbits::Parts parts{s.flywheel, s.link, s.motor, options.at};
    constexpr int few_periods = 40;
    if ((s.basis == CycleBasis::classical && !s.operating) || s.held) parts.most_periods = few_periods;
    if (s.held) parts.held = s.mid_speed;
    return parts;
  }

  // The work equation needs no flywheel; checks whether the machine without one meets δ, too.
  void look_without() {
    Effects effects = scene_.effects;
    const SizedModel as =
        is_elastic(*compile_at(scene_, effects, options_.at)) ? SizedModel::elastic : SizedModel::rigid;
    SizedOrbit orbit = orbits_.at(0, effects, {}, options_.simulation.measure_error);
    if (!orbit.found && s_.flywheel_now > 0)  // a shaft between couplings needs some inertia
      orbit = orbits_.at(s_.flywheel_now, effects, {}, options_.simulation.measure_error);
    constexpr double missed = 0.01;
    if (!orbit.found || orbit.crank.value <= s_.delta * (1 + missed)) return;
    s_.reached.push_back({orbit, as, SizedBy::constant_drive, "no flywheel"});
    note(orbit, as);
    meet(as, orbit, effects);
    s_.needed = true;
  }

  // Balanced torques that depend on the angle only: the cycle follows from energy.
  void reach_family() {
    if (std::abs(s_.cycle.drive.mean() / s_.diagram.mean_torque() - 1) > 1e-6) {
      s_.notes.push_back("no steady motion: the drive of the scene does not balance its load at any speed");
      return;
    }
    const SpeedCycle cycle(s_.diagram, s_.cycle.mechanism, s_.exact.inertia, s_.mid_speed);
    DeltaReached exact;
    exact.sized_by = by_work, exact.flywheel = s_.methods.front().flywheel.value;
    exact.crank.value = exact.motor.value = cycle.delta();
    exact.mid_speed = 0.5 * (cycle.fastest().value + cycle.slowest().value);
    for (int k = 0; k <= curve_points; ++k) {
      exact.phi.push_back(s_.cycle.drive.length() * k / curve_points);
      exact.speed.push_back(cycle.speed(exact.phi.back()));
    }
    s_.reached.push_back(std::move(exact));
    start_speed_ = cycle.speed(0);
    reach();
  }

  // By the steady motions of the machine, first rigid.
  void reach() {
    Effects elastic = scene_.effects;
    if (!is_elastic(*compile_at(scene_, elastic, options_.at))) elastic.all_elastic = true;
    const auto elastic_model = compile_at(scene_, elastic, options_.at);
    const Effects rigid = rigid_twin(*elastic_model);
    const double flywheel = s_.methods.front().flywheel.value;
    const SizedOrbit with_motor = ask(SizedModel::rigid, SizedBy::constant_drive, by_work, flywheel, rigid);
    const bool elastic_too = is_elastic(*elastic_model);
    s_.stalls = s_.operating && with_motor.stops;
    if (s_.operating && with_motor.found) start_speed_ = with_motor.start_speed;
    if (elastic_too && !s_.stalls) ask(SizedModel::elastic, SizedBy::constant_drive, by_work, flywheel, elastic);
    if (!s_.operating || !(with_motor.found || s_.stalls)) return;
    count_slope(with_motor, rigid);
    if (!s_.soft) {
      if (s_.stalls) s_.break_off(s_.soft_why);
      return;
    }
    if (!s_.meeting || s_.meeting->name != s_.soft->name)
      take(*as_rigid_->orbit, SizedModel::rigid, SizedBy::slope, s_.soft->name);
    if (s_.soft->none_needed) return;
    if (elastic_too) ask(SizedModel::elastic, SizedBy::slope, s_.soft->name, s_.soft->flywheel.value, elastic);
    if (s_.stalls && !s_.meeting) adopt(SizedModel::rigid, *as_rigid_, rigid, s_.soft->name);
  }

  SizedOrbit ask(SizedModel as, SizedBy by, const std::string& sized_by, double flywheel, const Effects& effects) {
    const std::string name = name_of(as);
    options_.simulation.watch.at(name + ", " + sized_by, 0);
    SizedOrbit orbit = orbits_.at(flywheel, effects, start_speed_, options_.simulation.measure_error);
    if (orbit.found) {
      take(orbit, as, by, sized_by);
      meet_if_missed(as, by, orbit, effects);
    } else if ((s_.operating && !(orbit.stops && as == SizedModel::rigid)) ||
               (s_.basis == CycleBasis::steady && !s_.held)) {
      s_.break_off(fmt::format("{} ({}): {}", name, sized_by, orbit.why));
    } else {
      s_.notes.push_back(fmt::format("{} ({}): {}", name, sized_by, orbit.why));
    }
    return orbit;
  }
  void take(const SizedOrbit& orbit, SizedModel as, SizedBy by, const std::string& sized_by) {
    s_.reached.push_back({orbit, as, by, sized_by});
    note(orbit, as);
  }
  void meet_if_missed(SizedModel as, SizedBy by, const SizedOrbit& orbit, const Effects& effects) {
    const bool last = as == SizedModel::elastic || !is_elastic(*compile_at(scene_, scene_.effects, options_.at));
    const double off = orbit.crank.value / s_.delta - 1;
    constexpr double missed = 0.01, far_smoother = -0.5;
    const bool heavier = off > missed;
    const bool lighter = s_.basis == CycleBasis::steady && off < -missed && off > far_smoother;
    if ((by == SizedBy::constant_drive || s_.stalls) && last && !s_.meeting && (heavier || lighter))
      meet(as, orbit, effects);
  }

  // The flywheel with which the rigid machine has the demanded δ, as its torques depend on the speed.
  void count_slope(const SizedOrbit& with_motor, const Effects& rigid) {
    if (with_motor.found) s_.with_motor = with_motor;
    const SizedOrbits::Meeting& found = as_rigid(with_motor, rigid);
    if (found.orbit) {
      s_.soft = method(by_slope(), found);
      s_.soft_speed = found.orbit->mid_speed;
      start_speed_ = found.orbit->start_speed;
    } else {
      s_.soft_why = found.unknown.empty()
                        ? "no inertia tried gives the demanded δ with the torques as they are over the speed"
                        : "the inertia that gives the demanded δ with the torques as they are over the speed is not "
                          "assessed: " +
                              found.unknown;
    }
  }
  std::string by_slope() const { return slope_of_what(s_).substr(4) + " counted"; }
  // Searched for once: for a rigid machine it is also the flywheel that meets the demand.
  const SizedOrbits::Meeting& as_rigid(const SizedOrbit& first, const Effects& rigid) {
    constexpr double met = 1e-9;
    if (!as_rigid_) as_rigid_ = orbits_.meeting(s_.delta, first, others_, rigid, met);
    return *as_rigid_;
  }
  SizeMethod method(const std::string& name, const SizedOrbits::Meeting& found) const {
    const double on_shaft = found.orbit->flywheel + others_;
    return {name,
            on_shaft * s_.flywheel_ratio * s_.flywheel_ratio,
            {found.orbit->flywheel, found.error},
            flywheel_by_parts(on_shaft, s_.motor_inertia, s_.gearbox_inertia),
            found.orbit->crank.value,
            found.none_needed};
  }
  // A note found with several flywheels and models is given once.
  void note(const SizedOrbit& orbit, SizedModel as) {
    for (const std::string& what : orbit.notes) {
      const std::string which = fmt::format("{}: ", name_of(as));
      if (std::none_of(s_.notes.begin(), s_.notes.end(), [&](const std::string& n) {
            return n == what || n.ends_with(": " + what) ||
                   (n.starts_with(which + "the drive ") && what.starts_with("the drive "));
          }))
        s_.notes.push_back(which + what);
    }
  }

  // The flywheel with which the actual machine has the demanded δ.
  void meet(SizedModel as, const SizedOrbit& first, const Effects& effects) {
    constexpr double met = 1e-5;
    const bool as_with_slope = s_.operating && as == SizedModel::rigid;
    const SizedOrbits::Meeting found =
        as_with_slope ? as_rigid(first, effects) : orbits_.meeting(s_.delta, first, others_, effects, met);
    const char* which = as == SizedModel::elastic ? "elastic" : "rigid";
    if ((!found.orbit || found.none_needed) && first.crank.value <= s_.delta) return;  // smooth enough as it is
    if (!found.orbit) {
      s_.meeting_words = fmt::format(
          "no flywheel was found with which the {} machine has δ = {:g}: the least of {} steady motions is {:.4g}, "
          "with {:.6g} kg·m²{}",
          which, s_.delta, found.orbits, found.least, found.least_at, found.slips.empty() ? "" : "; " + found.slips);
      if (!found.unknown.empty())
        s_.meeting_words += "; the search failed, which does not say that there is none: " + found.unknown;
      return;
    }
    adopt(as, found, effects, as_with_slope ? by_slope() : fmt::format("steady motion, {}", which));
    s_.reached.push_back({*found.orbit, as, as_with_slope ? SizedBy::slope : SizedBy::steady_motion, s_.meeting->name});
  }
  void adopt(SizedModel as, const SizedOrbits::Meeting& found, const Effects& effects, const std::string& name) {
    s_.meeting = method(name, found);
    s_.meeting_words =
        fmt::format("a flywheel of {:.6g} kg·m² meets δ = {:g} with {} ({}{})", found.orbit->flywheel, s_.delta,
                    effects.describe() == scene_.effects.describe() ? "the scene's effects"
                    : as == SizedModel::elastic                     ? "all of its elasticity"
                                                                    : "none of its elasticity",
                    as == SizedModel::elastic ? "elastic" : "rigid",
                    effects.describe() == "none" ? std::string() : ": " + effects.describe());
  }

  Sizing& s_;
  const Scene& scene_;
  const SizeOptions& options_;
  double others_;  // what turns with the flywheel, on its shaft [kg·m²]
  std::optional<double> start_speed_;
  SizedOrbits orbits_;
  std::optional<SizedOrbits::Meeting> as_rigid_;
};

}  // namespace

void reach_sized(Sizing& sizing, const Scene& scene, const SizeOptions& options, std::optional<double> start_speed) {
  Reach(sizing, scene, options, start_speed).run();
}

// Parts omitted by the work equation, and their contribution to δ.
void report_omitted(Sizing& s, const std::vector<std::string>& beyond) {
  const std::string what = fmt::format("{}", fmt::join(beyond, ", "));
  const DeltaReached *rigid = nullptr, *elastic = nullptr;
  for (const DeltaReached& r : s.reached)
    if (r.by == SizedBy::constant_drive) (r.model == SizedModel::elastic ? elastic : rigid) = &r;
  constexpr double varies = 1e-9;  // less is rounding
  if (s.delta_of_orbit && *s.delta_of_orbit < varies) {
    s.notes.push_back("in its steady motion the speed does not vary");
  } else if (s.delta_of_orbit) {
    const double least = *s.delta_of_orbit, by_work = s.delta_now;
    s.notes.push_back(
        fmt::format("the work equation of the rigid machine omits {}: at the scene's own inertia it gives {}, the "
                    "steady cycle has δ = {:.4g}",
                    what.empty() ? "what the scene's effects change" : what,
                    std::isnan(by_work) ? "no cycle (the machine would stop)"
                                        : fmt::format("δ = {:.4g} ({:+.3g} %)", by_work, 100 * (by_work / least - 1)),
                    least));
  } else if (!what.empty()) {
    s.notes.push_back(
        fmt::format("classical: {} omitted{}", what, beyond.size() == 1 ? " is" : " are") +
        (rigid ? fmt::format("; with it the sized machine has δ = {:.4g} instead of {:g}", rigid->crank.value, s.delta)
               : std::string()));
  }
  if (rigid && elastic && s.basis == CycleBasis::classical)
    s.notes.push_back(
        fmt::format("the work equation omits elasticity: with it δ is {:.4g} instead of {:.4g} ({:+.3g} %)",
                    elastic->crank.value, rigid->crank.value, 100 * (elastic->crank.value / rigid->crank.value - 1)));
}

}  // namespace kurbel
