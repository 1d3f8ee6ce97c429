// ratings.cpp — figures of rated components, and the verdicts on them.
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
#include "studies/limits/load_cases.h"

namespace kurbel {
namespace {

// The component's own joint, or one of its segments; a continuous shaft is assessed by the torque at its middle.
bool is_joint_of(const std::string& joint, const std::string& component) {
  if (joint == component) return true;
  return joint.starts_with(component + ".") && !joint.ends_with(".in") && !joint.ends_with(".out");
}

bool rates_cycle(const ShaftRating& shaft) { return shaft.endurance || shaft.yield || shaft.vibratory; }

Figure figure_of(const char* words, const std::string& of, double value, const char* unit, double scale) {
  return Figure::of_name(Name::own(words, of), value, unit, scale);
}

// Remedy of a verdict: words, and the key's value if there is one.
struct Mend {
  std::string words = {};
  std::optional<Remedy> remedy = {};
  bool up_to = false;
  std::string more = {};  // behind the words of a remedy
};

// Results of a run for one component, against its ratings.
class Rater {
 public:
  Rater(const Result& result, const std::string& component, const std::string& only_case, std::vector<Verdict>& out)
      : result_(result), component_(component), only_case_(only_case), out_(out) {}

  void all() {
    if (const auto* rating = stated<HeatRating>()) heat(*rating);
    if (const auto* rating = stated<BeltRating>()) belt(*rating);
    if (const auto* limits = stated<CouplingLimits>()) coupling(*limits);
    if (const auto* keys = stated<ShaftKeys>()) {
      if (keys->allowable_shear_stress) shaft(*keys);
      if (rates_cycle(keys->rating)) cycle_of_stress(*keys);
      if (keys->rating.is_of_propulsion()) leave(requirement::continuous, std::nan(""), "Pa");
    }
    if (const auto* rating = stated<RimRating>()) rim(*rating);
    if (const auto* rating = stated<MotorRating>(); rating && rating->states_duty()) motor(*rating);
  }

 private:
  template <class T>
  const T* stated() const {
    return result_.model->network.data.find<T>(component_);
  }
  std::string load_case_of(std::optional<double> at) const {
    if (!only_case_.empty()) return only_case_;
    const Figure* peak = largest_torque();
    return peak && peak->at == at ? load_case_of_peak(result_, *peak) : load_case_at(result_, at);
  }
  // Whether the factors of steady motion count: at this moment, even if the value is not reached again.
  bool is_steady(std::optional<double> at) const {
    return (only_case_.empty() ? load_case_at(result_, at) : only_case_) == load_case::steady;
  }
  // `mends` gives the remedy for the factor by which the value may be too large.
  template <class Mends>
  Verdict& add(const char* requirement, const Estimate& value, std::optional<double> at, double limit, const char* unit,
               const Mends& mends) {
    Verdict v{value, component_, requirement, limit, unit, ""};
    v.load_case = load_case_of(at), v.at = at;
    if (v.state() == Compliance::exceeded || v.state() == Compliance::undecided) {
      Mend mend = mends((v.value + v.known_error()) / limit);
      if (mend.remedy) {
        v.remedy = mend.remedy;
        take_tried(v);
        mend.words = in_words(*v.remedy, mend.up_to) + mend.more;
      }
      v.note = std::move(mend.words);
    }
    if (!result_.errors_measured) v.note += std::string(v.note.empty() ? "" : "; ") + "its error was not measured";
    out_.push_back(std::move(v));
    return out_.back();
  }
  // The value found by computing the machine with it; not finite: none was found, and the remedy is an estimate.
  void take_tried(Verdict& v) const {
    const auto found = result_.remedies_tried.find(name_of_remedy(v));
    if (found != result_.remedies_tried.end() && std::isfinite(found->second))
      v.remedy->value = found->second, v.remedy->tried = true;
  }
  void leave(const char* requirement, double limit, const char* unit) {
    out_.push_back(not_assessed(component_, requirement, limit, unit, load_case::steady,
                                "kurbel steady and modes judge the steady motion"));
  }
  // The largest torque of a start, where the run has none.
  void leave_start(const char* requirement, double limit, const char* unit) {
    if (only_case_.empty() && result_.model->scene.sequence.steps.empty() && !begins_at_rest(result_.model))
      out_.push_back(not_assessed(component_, requirement, limit, unit, load_case::start,
                                  "the run does not begin at rest; kurbel modes judges a start from rest"));
  }
  // Of what one load case alone, the steady motion, does not contain; nor this run, for the reason that is given.
  void leave_to_run(const char* requirement, double limit, const char* unit, const char* not_in_run = nullptr,
                    const char* load_case = load_case::run) {
    const char* const why = only_case_.empty() ? not_in_run : "kurbel run judges it";
    if (why) out_.push_back(not_assessed(component_, requirement, limit, unit, load_case, why));
  }
  Remedy remedy(const char* key, double value, const char* unit) const {
    return {component_ + "." + key, enough(value), unit};
  }
  const Figure* found(const std::string& name) const { return result_.find(name); }

  void heat(const HeatRating& rating) {
    const Figure *hottest = found("engagement_heat." + component_), *power = found("heat_power." + component_);
    constexpr const char *engagement = "heat of an engagement: W ≤ W_allowable",
                         *mean = "mean heat power: W_total/t ≤ P_allowable";
    if (rating.engagement) leave_to_run(engagement, *rating.engagement, "J");
    if (rating.power) leave_to_run(mean, *rating.power, "W");
    if (rating.engagement && hottest)
      add(engagement, abs(*hottest), {}, *rating.engagement, "J", [](double times) {
        return Mend{
            fmt::format("by an estimate, as W goes with the square of the difference of speed, it holds where that is "
                        "{:.0f} % of what it is",
                        std::floor(100 / std::sqrt(times)))};
      });
    if (rating.power && power)
      add(mean, abs(*power), {}, *rating.power, "W", [](double times) {
        return Mend{fmt::format("by an estimate it holds with {:.0f} % of these engagements in the same time",
                                std::floor(100 / times))};
      });
    const Claim* slips = slips_closed();
    if (capacity() > 0) holding(slips);
    if (!rating.engagement && slips)
      out_.push_back(not_assessed(component_, "heat of slipping: W ≤ W_allowable", std::nan(""), "J", load_case::run,
                                  "it slips while closed, and states no allowable_heat"));
  }
  void holding(const Claim* slips) {  // what a clutch or limiter has transmitted while it was closed and did not slip
    constexpr const char* holds = "holding torque: |τ| ≤ M_s while it is closed";
    if (slips) return gives_way(holds, capacity(), *slips);
    const Figure *held = found("held_torque." + component_), *reserve = found("torque_reserve." + component_);
    leave_to_run(holds, capacity(), "N*m", held && reserve ? nullptr : "fully closed it holds no torque in this run");
    if (held && reserve) add(holds, abs(*held), held->at, capacity(), "N*m", [](double) { return Mend{}; });
  }
  void gives_way(const char* requirement, double limit, const Claim& slips) {
    Verdict v{{limit, 0}, component_, requirement, limit, "N*m", ""};
    v.gives_way = true, v.at = slips.evidence.at, v.load_case = load_case_of(v.at);
    out_.push_back(std::move(v));
  }
  double capacity() const {  // M_s [N·m]; 0: of a brake
    for (const Network::Joint& joint : result_.model->network.joints)
      if (joint.component == component_ && joint.element) return joint.element->capacity;
    return 0;
  }
  const Claim* slips_closed() const {  // null: it holds while closed
    const auto found = std::find_if(result_.claims.begin(), result_.claims.end(), [&](const Claim& c) {
      return c.of == component_ &&
             (c.predicate == Predicate::clutch_slips_closed || c.predicate == Predicate::limiter_slips ||
              c.predicate == Predicate::belt_slips || c.predicate == Predicate::slips_to_the_end);
    });
    return found == result_.claims.end() ? nullptr : &*found;
  }

  void belt(const BeltRating& b) {
    const Figure *peak = found("peak_torque." + component_), *strand = found("strand_force." + component_);
    constexpr const char *tension = "strand force: F₀ + |τ|/(2 r₁) ≤ F_allowable",
                         *reserve = "reserve against slip: S |τ| ≤ M";
    if (b.tension) leave_to_run(tension, *b.tension, "N", nullptr, load_case::start);
    if (b.reserve) leave_to_run(reserve, b.limit, "N*m", nullptr, load_case::start);
    if (b.tension && strand)
      add(tension, abs(*strand), peak ? peak->at : strand->at, *b.tension, "N", [&](double) {
        const double left = *b.tension - b.pretension, pull = strand->value + strand->error.value_or(0) - b.pretension;
        if (left <= 0) return Mend{"the pretension alone is as much"};
        return Mend{.remedy = remedy("diameter_in", 2 * b.radius * pull / left, "m")};
      });
    if (const Claim* slips = b.reserve ? nullptr : slips_closed()) gives_way("slip: |τ| ≤ M", b.limit, *slips);
    if (b.reserve && peak) {
      const bool slips = std::abs(peak->value) >= b.limit * (1 - 1e-9);
      add(reserve, *b.reserve * abs(*peak), peak->at, b.limit, "N*m", [&](double times) {
        // A slipping belt limits its torque: the torque without slip is not known.
        if (slips) return Mend{.more = "; the belt slips, so that the torque without slip is larger and not known"};
        return Mend{.remedy = remedy("pretension", b.pretension * times, "N")};
      });
      out_.back().factor = *b.reserve, out_.back().factors = fmt::format("S = {:g}", *b.reserve);
    }
  }

  // Over its segments.
  const Figure* largest_torque() const {
    const Figure* largest = nullptr;
    for (const Figure& f : result_.figures)
      if (f.what == quantities::peak_torque && is_of(f.of))
        if (!largest || std::abs(f.value) > std::abs(largest->value)) largest = &f;
    return largest;
  }

  // S_z is for starts. DIN 740-2: where they exceed the mean torque, the acting part of that is unknown here, and none counts.
  void coupling(const CouplingLimits& limits) {
    const Figure* largest = largest_torque();
    if (limits.maximum > 0 && largest) {
      const double start_factor = is_steady(largest->at) ? 1 : limits.start_factor;
      const double factor = limits.temperature_factor * start_factor;
      Verdict& v =
          add(requirement::maximum, factor * abs(*largest), largest->at, limits.maximum, "N*m", [&](double times) {
            Remedy key = remedy("maximum_torque", limits.maximum * times, "N*m");
            key.tried = true;  // nothing of the motion depends on it
            return Mend{.remedy = key};
          });
      v.bound = start_factor > 1;
      v.factor = factor;
      if (factor != 1) v.factors = fmt::format("S_t = {:g}, S_z = {:g}", limits.temperature_factor, start_factor);
      leave_start(requirement::maximum, limits.maximum, "N*m");
    }
    if (limits.nominal > 0) leave("nominal torque: K_A S_t |T_mean| ≤ T_KN", limits.nominal, "N*m");
    if (limits.vibratory > 0) leave("vibratory torque: S_t S_f T_W ≤ T_KW", limits.vibratory, "N*m");
    if (limits.power > 0) leave("dissipated power: P_W ≤ P_KW", limits.power, "W");
  }

  Mend thicker(const ShaftKeys& shaft, double times) const {
    return {.remedy = remedy("diameter", *shaft.diameter * std::cbrt(times), "m"),
            .more = shaft.bore > 0 ? ", with its bore in proportion" : ""};
  }

  void shaft(const ShaftKeys& shaft) {
    const Figure* largest = largest_torque();
    if (!largest) return;
    const double factor = is_steady(largest->at) ? shaft.application_factor : 1;
    Verdict& v = add(requirement::shear, factor / shaft.polar_modulus() * abs(*largest), largest->at,
                     *shaft.allowable_shear_stress, "Pa", [&](double times) { return thicker(shaft, times); });
    v.factor = factor;
    if (factor != 1) v.factors = fmt::format("K_A = {:g}", factor);
    leave_start(requirement::shear, *shaft.allowable_shear_stress, "Pa");
  }

  // The extremes of the whole run including the start: not repeated continuously, but a bound for every part of it.
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
    const auto mend = [&](double times) { return thicker(shaft, times); };
    const ShaftRating& rating = shaft.rating;
    const auto alternates = [&](const char* requirement, const Estimate& stress, double limit,
                                const std::string& note) {
      Verdict& v = add(requirement, stress, {}, limit, "Pa", [](double) { return Mend{}; });
      if (only_case_.empty()) v.bound = true, v.load_case = load_case::steady;
      const std::string whence =
          v.bound ? "a bound: the extremes of the whole run; kurbel steady and modes judge the steady motion" : "";
      for (const std::string& more : {whence, note})
        if (!more.empty()) v.note += (v.note.empty() ? "" : "; ") + more;
    };
    if (rating.vibratory)
      alternates(requirement::vibratory_stress, widest.amplitude() / modulus, *rating.vibratory, "");
    if (rating.endurance) {
      const Fatigue fatigue = fatigue_of(rating, widest.amplitude() / modulus, widest.middle() / modulus);
      alternates(requirement::fatigue, fatigue.stress, *rating.endurance, fatigue.note);
    }
    if (rating.yield) {
      const Figure* peak = largest_torque();
      add(requirement::yield, rating.safety * abs(largest.largest()) / modulus, peak ? peak->at : std::nullopt,
          rating.yield_in_shear(), "Pa", mend);
    }
  }
  bool is_of(const std::string& joint) const { return is_joint_of(joint, component_); }

  void rim(const RimRating& rating) {
    const Figure* speed = found("rim_speed." + component_);
    if (!speed) return;
    const auto smaller = [&](double times) {
      Remedy radius = remedy("rim_radius", 0, "m");
      radius.value = -enough(-*rating.radius / times);
      return Mend{.remedy = radius, .up_to = true};
    };
    if (rating.speed) add("rim speed: r |ω| ≤ v_allowable", abs(*speed), speed->at, *rating.speed, "m/s", smaller);
    if (!rating.stress) return;
    const double density = *rating.density, v = std::abs(speed->value);
    add("hoop stress of the rim: ρ (r ω)² ≤ σ_allowable", function_of(abs(*speed), density * v * v, 2 * density * v),
        speed->at, *rating.stress, "Pa", [&](double times) { return smaller(std::sqrt(times)); });
  }

  void motor(const MotorRating& rating) {
    const Figure* rms = found("motor_rms_torque." + component_);
    const auto* data = stated<InductionData>();
    const double rated = data ? data->rated_torque : rating.torque.value_or(0);
    constexpr const char* of_duty = "RMS torque: √(∫ M² dt/t) ≤ M_N √part on";
    if (!only_case_.empty() && rating.duty.duty == DutyRating::Duty::short_time)
      return leave_to_run(of_duty, std::nan(""), "N*m");
    if (!rms || !(rated > 0)) return;
    const auto mends = [&](double times) {
      return Mend{fmt::format("by an estimate it holds from a rated torque of {:.4g} N·m on", enough(rated * times))};
    };
    // Continuous duty is that of the steady motion, if the run reaches it: the heating of a start decays.
    const bool continuous = !rating.duty.time && !rating.duty.share && result_.find(quantities::run_up_time, "");
    if (const Figure* use = continuous ? found("thermal_use." + component_) : nullptr) {
      const bool changes = result_.model && !result_.model->commands.empty();
      add(changes ? "RMS torque of the heaviest cycle: √(∫ M² dt/T) ≤ M_N"
                  : "RMS torque of the steady cycle: √(∫ M² dt/T) ≤ M_N",
          rated * abs(*use), use->at, rated, "N*m", mends);
    } else {
      // The same heat ∫ M² dt as M_N during the rated time.
      const double span = result_.until - result_.begins_at,
                   part = rating.duty.time ? *rating.duty.time / span : rating.duty.share.value_or(1);
      add(of_duty, abs(*rms), {}, rated * std::sqrt(part), "N*m", mends);
    }
    std::string& note = out_.back().note;
    note += fmt::format("{}M_N = {:.4g} N·m; a lower bound of its heating", note.empty() ? "" : "; ", rated);
  }

  const Result& result_;
  const std::string& component_;
  const std::string& only_case_;
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
    const auto is_rated = [&](const std::string& shaft) { return is_joint_of(peak.name.of, shaft); };
    if (peak.name.what != quantities::peak_torque || std::none_of(rated.begin(), rated.end(), is_rated)) continue;
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

std::vector<Verdict> judge_ratings(const Result& result, const std::string& only_case) {
  std::vector<Verdict> verdicts;
  if (!result.complete || !result.model) return verdicts;
  for (const std::string& component : result.model->network.components)
    Rater(result, component, only_case, verdicts).all();
  // A verdict of a slipping component is kept only beside others; the slip itself is reported anyway.
  if (std::none_of(verdicts.begin(), verdicts.end(), [](const Verdict& v) { return v.assessed && !v.gives_way; }))
    std::erase_if(verdicts, [](const Verdict& v) { return v.gives_way; });
  return verdicts;
}

}  // namespace kurbel
