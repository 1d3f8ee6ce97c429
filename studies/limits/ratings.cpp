// ratings.cpp — figures of what is rated, and the verdicts on them.
#include "studies/limits/ratings.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "drivetrain/couplings/coupling_keys.h"
#include "drivetrain/friction/belt.h"
#include "drivetrain/induction/induction_law.h"
#include "drivetrain/shared/rating_keys.h"
#include "engine/numerics/index.h"
#include "studies/findings/figure_text.h"

namespace kurbel {
namespace {

// A component's own, or that of one of its segments; a continuous shaft is judged by the torque in its middle.
bool is_joint_of(const std::string& joint, const std::string& component) {
  if (joint == component) return true;
  return joint.starts_with(component + ".") && !joint.ends_with(".in") && !joint.ends_with(".out");
}

bool rates_cycle(const ShaftRating& shaft) { return shaft.endurance || shaft.yield || shaft.vibratory; }

Figure figure_of(const char* words, const std::string& of, double value, const char* unit, double scale) {
  return Figure::of_name(Name::own(words, of), value, unit, scale);
}

// What a run found of one component, against what it states.
class Rater {
 public:
  Rater(const Result& result, const std::string& component, std::vector<Verdict>& out)
      : result_(result), component_(component), out_(out) {}

  void all() {
    if (const auto* rating = stated<HeatRating>()) heat(*rating);
    if (const auto* rating = stated<BeltRating>()) belt(*rating);
    if (const auto* limits = stated<CouplingLimits>(); limits && limits->maximum > 0) coupling(*limits);
    if (const auto* keys = stated<ShaftKeys>()) {
      if (keys->allowable_shear_stress) shaft(*keys);
      if (rates_cycle(keys->rating)) cycle_of_stress(*keys);
    }
    if (const auto* rating = stated<RimRating>()) rim(*rating);
    if (const auto* rating = stated<MotorRating>(); rating && rating->states_duty()) motor(*rating);
  }

 private:
  template <class T>
  const T* stated() const {
    return result_.model->network.data.find<T>(component_);
  }
  // `mends` makes words of the value that would hold; it gets how many times too large the value may be.
  template <class Mends>
  void add(const char* requirement, const Estimate& value, double limit, const char* unit, const Mends& mends) {
    Verdict v{component_, requirement, value.value, limit, unit, "", value.error.value_or(0)};
    if (v.state() != Compliance::holds) v.note = mends((v.value + v.error) / limit);
    if (!result_.errors_measured) v.note += std::string(v.note.empty() ? "" : "; ") + "its error was not measured";
    out_.push_back(std::move(v));
  }
  std::optional<Estimate> found(const std::string& name) const {
    const Figure* f = result_.find(name);
    return f ? std::optional(abs(*f)) : std::nullopt;
  }

  void heat(const HeatRating& rating) {
    const auto hottest = found("engagement_heat." + component_), power = found("heat_power." + component_);
    if (rating.engagement && hottest)
      add("heat of an engagement: W ≤ W_allowable", *hottest, *rating.engagement, "J", [](double times) {
        return fmt::format(
            "as W goes with the square of the difference of speed: it holds where that is {:.0f} % of what it is",
            std::floor(100 / std::sqrt(times)));
      });
    if (rating.power && power)
      add("mean heat power: W_total/t ≤ P_allowable", *power, *rating.power, "W", [](double times) {
        return fmt::format("it holds with {:.0f} % of these engagements in the same time", std::floor(100 / times));
      });
  }

  void belt(const BeltRating& b) {
    const auto peak = found("peak_torque." + component_), strand = found("strand_force." + component_);
    if (b.tension && strand)
      add("strand force: F₀ + |τ|/(2 r₁) ≤ F_allowable", *strand, *b.tension, "N", [&](double) {
        const double left = *b.tension - b.pretension, pull = strand->value + strand->error.value_or(0) - b.pretension;
        if (left <= 0) return std::string("the pretension alone is as much");
        return fmt::format("it holds from diameter_in = {:.4g} mm on, at the same torque and pretension",
                           2e3 * b.radius * pull / left);
      });
    if (b.reserve && peak)
      add("reserve against slip: S |τ| ≤ M", *b.reserve * *peak, b.limit, "N*m", [&](double times) {
        return fmt::format(
            "{}it holds from pretension = {:.4g} N on{}", peak->value >= b.limit * (1 - 1e-9) ? "it slips; " : "",
            b.pretension * times,
            peak->value >= b.limit * (1 - 1e-9) ? " at the least: what it would carry then is more" : "");
      });
  }

  // Of its segments.
  std::optional<Estimate> largest_torque() const {
    std::optional<Estimate> largest;
    for (const Figure& f : result_.figures)
      if (f.what == quantities::peak_torque && is_of(f.of))
        if (!largest || std::abs(f.value) > largest->value) largest = abs(f);
    return largest;
  }

  // DIN 740-2: where starts weigh more than the mean torque, how much of that acts is not known here, and none counts.
  void coupling(const CouplingLimits& limits) {
    const auto largest = largest_torque();
    if (!largest) return;
    const double factor = limits.temperature_factor * limits.start_factor;
    add(requirement::maximum, factor * *largest, limits.maximum, "N*m", [&](double times) {
      return fmt::format("it holds from maximum_torque = {:.4g} N·m on", limits.maximum * times);
    });
    out_.back().bound = limits.start_factor > 1;
    if (factor != 1)
      out_.back().note += fmt::format("{}S_t = {:g}, S_z = {:g}", out_.back().note.empty() ? "" : "; ",
                                      limits.temperature_factor, limits.start_factor);
  }

  void shaft(const ShaftKeys& shaft) {
    const double modulus = shaft.polar_modulus();
    const auto largest = largest_torque();
    if (!largest) return;
    add("shear stress: |T|/W_p ≤ τ_allowable", *largest / modulus, *shaft.allowable_shear_stress, "Pa",
        [&](double times) {
          return fmt::format("it holds from diameter = {:.4g} mm on, with its bore in proportion, at the same torque",
                             1e3 * *shaft.diameter * std::cbrt(times));
        });
  }

  // The widest cycle that rainflow could count: of the segment where it is worst.
  void cycle_of_stress(const ShaftKeys& shaft) {
    const double modulus = shaft.polar_modulus();
    JointLoad widest, largest;
    for (const Figure& f : result_.figures) {
      if (!f.name.starts_with("greatest_torque.") || !is_of(f.of)) continue;
      const Figure* least = result_.find("least_torque." + f.of);
      if (!least) continue;
      JointLoad load;
      load.upper = f, load.lower = *least;
      if (load.amplitude().value >= widest.amplitude().value) widest = load;
      if (std::abs(load.largest().value) >= std::abs(largest.largest().value)) largest = load;
    }
    const auto thicker = [&](double times) {
      return fmt::format("it holds from diameter = {:.4g} mm on, with its bore in proportion, at the same torque",
                         1e3 * *shaft.diameter * std::cbrt(times));
    };
    const ShaftRating& rating = shaft.rating;
    if (rating.vibratory)
      add(requirement::vibratory_stress, widest.amplitude() / modulus, *rating.vibratory, "Pa", thicker);
    if (rating.endurance) {
      const Fatigue fatigue = fatigue_of(rating, widest.amplitude() / modulus, widest.middle() / modulus);
      add(requirement::fatigue, fatigue.stress, *rating.endurance, "Pa", thicker);
      std::string& note = out_.back().note;
      note += (note.empty() ? "" : "; ") + fatigue.note;
    }
    if (rating.yield)
      add(requirement::yield, rating.safety * abs(largest.largest()) / modulus, rating.yield_in_shear(), "Pa", thicker);
  }
  bool is_of(const std::string& joint) const { return is_joint_of(joint, component_); }

  void rim(const RimRating& rating) {
    const auto speed = found("rim_speed." + component_);
    if (!speed) return;
    const auto smaller = [&](double times) {
      return fmt::format("it holds up to rim_radius = {:.4g} mm at this speed", 1e3 * *rating.radius / times);
    };
    if (rating.speed) add("rim speed: r |ω| ≤ v_allowable", *speed, *rating.speed, "m/s", smaller);
    if (!rating.stress) return;
    const double density = *rating.density, v = speed->value;
    add("hoop stress of the rim: ρ (r ω)² ≤ σ_allowable", function_of(*speed, density * v * v, 2 * density * v),
        *rating.stress, "Pa", [&](double times) { return smaller(std::sqrt(times)); });
  }

  void motor(const MotorRating& rating) {
    const auto rms = found("motor_rms_torque." + component_);
    const auto* data = stated<InductionData>();
    const double rated = data ? data->rated_torque : rating.torque.value_or(0);
    if (!rms || !(rated > 0)) return;
    const auto mends = [&](double times) {
      return fmt::format("it holds from a rated torque of {:.4g} N·m on", rated * times);
    };
    // Continuous duty is that of the steady motion, where the run comes to one: a start is soon forgotten.
    const bool continuous = !rating.duty.time && !rating.duty.share && result_.find(quantities::run_up_time, "");
    if (const auto use = continuous ? found("thermal_use." + component_) : std::nullopt) {
      const bool changes = result_.model && !result_.model->commands.empty();
      add(changes ? "RMS torque of the heaviest cycle: √(∫ M² dt/T) ≤ M_N"
                  : "RMS torque of the steady cycle: √(∫ M² dt/T) ≤ M_N",
          rated * *use, rated, "N*m", mends);
    } else {
      // What makes the same heat ∫ M² dt as M_N in the time for which it is stated.
      const double span = result_.until - result_.begins_at,
                   part = rating.duty.time ? *rating.duty.time / span : rating.duty.share.value_or(1);
      add("RMS torque: √(∫ M² dt/t) ≤ M_N √part on", *rms, rated * std::sqrt(part), "N*m", mends);
    }
    std::string& note = out_.back().note;
    note += fmt::format("{}M_N = {:.4g} N·m; a lower bound of its heating", note.empty() ? "" : "; ", rated);
  }

  const Result& result_;
  const std::string& component_;
  std::vector<Verdict>& out_;
};

void add_heat_figures(const std::string& component, std::vector<Figure>& list) {
  for (const auto& [words, unit] : {std::pair("engagement_heat", "J"), {"slip_time", "s"}, {"heat_power", "W"}})
    list.push_back(figure_of(words, component, 0, unit, 0));
}

}  // namespace

std::unique_ptr<HeatRecorder> heat_recorder_of(const Model& model) {
  std::vector<std::string> watched;
  for (const auto& [component, rating] : model.network.data.all<HeatRating>()) watched.push_back(component);
  return watched.empty() ? nullptr : std::make_unique<HeatRecorder>(watched);
}

std::vector<ExtremeOf> rim_speeds_of(const Model& model) {
  std::vector<ExtremeOf> wanted;
  for (const auto& [component, rating] : model.network.data.all<RimRating>()) {
    const int node = model.network.ports.at(component).out, shaft = model.shaft_of_node[at(node)];
    const double gain = *rating.radius * model.gain_of_node[at(node)];
    ExtremeOf rim{.name = Name::own("rim_speed", component),
                  .unit = "m/s",
                  .scale = std::abs(gain) * model.speed_scale * model.scale_ratio[at(node)] /
                           std::max(1e-300, std::abs(model.gain_of_node[at(node)])),
                  .value = [=](const Snapshot& now) { return gain * now.now.speed[shaft]; },
                  .rate = [=](const Snapshot& now) { return gain * now.alpha[shaft]; }};
    rim.slope = rim.rate;
    wanted.push_back(std::move(rim));
  }
  return wanted;
}

std::vector<ExtremeOf> shaft_torques_of(const Model& model) {
  std::vector<ExtremeOf> wanted;
  std::vector<std::string> rated;
  for (const auto& [component, shaft] : model.network.data.all<ShaftKeys>())
    if (rates_cycle(shaft.rating)) rated.push_back(component);
  if (rated.empty()) return wanted;
  for (const ExtremeOf& peak : extremes_of(model)) {
    if (peak.name.what != quantities::peak_torque) continue;
    if (std::none_of(rated.begin(), rated.end(),
                     [&](const std::string& shaft) { return is_joint_of(peak.name.of, shaft); }))
      continue;
    for (const auto& [words, functional] :
         {std::pair("greatest_torque", Functional::greatest), {"least_torque", Functional::least}}) {
      wanted.push_back(peak);
      wanted.back().name = Name::own(words, peak.name.of), wanted.back().functional = functional;
    }
  }
  return wanted;
}

std::vector<Figure> rating_figures(const Model& model, const HeatRecorder* heat, const std::vector<Figure>& known,
                                   double energy, double duration) {
  std::vector<Figure> figures;
  if (heat && duration > 0)
    for (const HeatRecorder::Heated& h : heat->heated()) {
      figures.push_back(figure_of("engagement_heat", h.component, h.largest, "J", energy));
      figures.push_back(figure_of("slip_time", h.component, h.slips, "s", duration));
      figures.push_back(figure_of("heat_power", h.component, h.total / duration, "W", energy / duration));
    }
  for (const auto& [component, belt] : model.network.data.all<BeltRating>())
    for (const Figure& f : known)
      if (f.what == quantities::peak_torque && f.of == component) {
        const double tight = belt.tight_strand(f.value), usual = belt.tight_strand(belt.limit);
        figures.push_back(figure_of("strand_force", component, tight, "N", usual));
        figures.push_back(figure_of("slack_force", component, 2 * belt.pretension - tight, "N", usual));
      }
  return figures;
}

std::vector<Figure> watched_figure_list(const Model& model) {
  std::vector<Figure> list;
  for (const std::string& component : model.network.components) {
    if (model.network.data.find<HeatRating>(component)) add_heat_figures(component, list);
    if (model.network.data.find<BeltRating>(component))
      for (const char* words : {"strand_force", "slack_force"}) list.push_back(figure_of(words, component, 0, "N", 0));
  }
  return list;
}

std::vector<Figure> rating_figure_list(const Model& model) {
  std::vector<Figure> list;
  const ComponentData& data = model.network.data;
  for (const std::string& component : model.network.components) {
    const auto* heat = data.find<HeatRating>(component);
    if (heat && (heat->engagement || heat->power)) add_heat_figures(component, list);
    const auto* belt = data.find<BeltRating>(component);
    if (belt && (belt->tension || belt->reserve)) list.push_back(figure_of("strand_force", component, 0, "N", 0));
    const auto* motor = data.find<MotorRating>(component);
    if (motor && motor->states_duty()) list.push_back(figure_of("motor_rms_torque", component, 0, "N*m", 0));
    if (data.find<RimRating>(component)) list.push_back(figure_of("rim_speed", component, 0, "m/s", 0));
  }
  for (const ExtremeOf& torque : shaft_torques_of(model)) list.push_back(Figure::of_name(torque.name, 0, torque.unit));
  return list;
}

std::vector<Verdict> judge_ratings(const Result& result) {
  std::vector<Verdict> verdicts;
  if (!result.complete || !result.model) return verdicts;
  for (const std::string& component : result.model->network.components) Rater(result, component, verdicts).all();
  return verdicts;
}

}  // namespace kurbel
