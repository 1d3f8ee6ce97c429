// verdicts.cpp — compares every limit with the loads of steady motion and run-up.
#include "studies/limits/verdicts.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/base/enumerators.h"
#include "studies/claims/headline.h"
#include "studies/findings/figure_text.h"

namespace kurbel {
namespace {

class Judge {
 public:
  Judge(const LimitedJoint& joint, const JointLoad& load, double speed, const RunUp& run_up, const RunUp::Peak* peak,
        const Passing* passing, const SpeedUnit& unit, std::vector<Verdict>& out)
      : joint_(joint),
        limits_(joint.limits),
        load_(load),
        speed_(speed),
        run_up_(run_up),
        peak_(peak),
        passing_(passing),
        unit_(unit),
        out_(out) {}

  void all() {
    if (limits_.nominal > 0)
      counted("nominal torque: K_A S_t |T_mean| ≤ T_KN", abs(load_.mean), limits_.nominal,
              {{"K_A", limits_.application_factor}, {"S_t", limits_.temperature_factor}}, "", "nominal_torque");
    if (limits_.maximum > 0) maximum();
    if (limits_.vibratory > 0)
      counted("vibratory torque: S_t S_f T_W ≤ T_KW", abs(load_.vibratory), limits_.vibratory,
              {{"S_t", limits_.temperature_factor}, {"S_f", limits_.frequency_factor(load_.frequency_factor)}},
              load_.frequency > 0 ? fmt::format("strongest at {:.4g} Hz", load_.frequency) : "it does not oscillate",
              "vibratory_torque");
    if (limits_.power > 0)
      add("dissipated power: P_W ≤ P_KW", abs(load_.power), limits_.power, "W", load_case::steady, "",
          "dissipated_power");
    if (limits_.shear_stress > 0)
      largest(requirement::shear, limits_.shear_stress, "Pa", 1 / limits_.polar_modulus,
              {"K_A", limits_.application_factor}, fmt::format("W_p = {:.5g} cm³", 1e6 * limits_.polar_modulus));
    if (limits_.shaft.any()) alternating_stress();
  }

 private:
  using Factor = std::pair<const char*, double>;

  // `key`: of the limit in the scene; its required value is given; null: the section is decisive.
  Verdict& add(std::string requirement, const Estimate& value, double limit, std::string unit, const char* load_case,
               std::string note, const char* key = nullptr) {
    Verdict v{value, joint_.name, std::move(requirement), limit, std::move(unit), std::move(note)};
    v.load_case = load_case;
    const double needed = v.value + v.known_error();
    if (v.state() == Compliance::exceeded && std::isfinite(needed)) {
      std::string mends = fmt::format("by an estimate it holds from {:.3g} times this diameter on, at the same torque",
                                      std::cbrt(needed / limit));
      if (key) {  // nothing of the motion depends on it
        v.remedy = Remedy{joint_.component + "." + key, enough(needed), v.unit, true};
        mends = in_words(*v.remedy);
      }
      v.note = mends + (v.note.empty() ? "" : "; ") + v.note;
    }
    out_.push_back(std::move(v));
    return out_.back();
  }
  // A torque with factors of a standard.
  void counted(const char* requirement, const Estimate& torque, double limit, const std::vector<Factor>& factors,
               const std::string& note, const char* key, const char* load_case = load_case::steady) {
    double factor = 1;
    for (const Factor& f : factors) factor *= f.second;
    Verdict& v = add(requirement, factor * torque, limit, "N*m", load_case, note, key);
    v.factor = factor, v.factors = words_of(factors);
  }
  static std::string words_of(const std::vector<Factor>& factors) {
    std::string text;
    for (const Factor& f : factors)
      if (f.second != 1) text += fmt::format("{}{} = {:.3g}", text.empty() ? "" : ", ", f.first, f.second);
    return text;
  }
  void leave(const char* requirement, double limit, const char* unit, const char* load_case) {
    out_.push_back(not_assessed(joint_.name, requirement, limit, unit, load_case, run_up_.words));
  }

  // --- the largest torque: of the start, or of the resonances below the operating speed; and of the steady motion ---

  std::string of_start() const { return fmt::format("at {:.4g} s of {}", peak_->time, run_up_.words); }
  std::string of_passing() const {
    return fmt::format("a bound: steady amplitude at {}; a quick passage stays below it",
                       unit_.text(passing_->speed, 5));
  }
  bool passes() const { return passing_ && std::abs(passing_->torque) > std::abs(load_.largest().value); }

  void maximum() {
    const double temperature = limits_.temperature_factor;
    if (peak_) {
      const Estimate start = start_torque(limits_, peak_->torque, load_.mean);
      Verdict& v =
          add(requirement::maximum, start, limits_.maximum, "N*m", load_case::start, of_start(), "maximum_torque");
      v.factors = words_of({{"S_t", temperature}, {"S_z", limits_.start_factor}});
      if (peak_->torque.value != 0 && std::isfinite(start.value))
        v.factor = start.value / std::abs(peak_->torque.value);
    } else {
      leave(requirement::maximum, limits_.maximum, "N*m", load_case::start);
      if (passes()) {
        counted(requirement::maximum, {std::abs(passing_->torque), 0}, limits_.maximum, {{"S_t", temperature}},
                of_passing(), "maximum_torque", load_case::passing);
        out_.back().bound = true;
      }
    }
    counted(requirement::maximum, abs(load_.largest()), limits_.maximum, {{"S_t", temperature}}, "", "maximum_torque");
  }

  // A stress proportional to the largest torque, by `per`; `steady_factor` applies in steady motion only.
  void largest(const char* requirement, double limit, const char* unit, double per, const Factor& steady_factor,
               const std::string& note) {
    const std::string also = note.empty() ? "" : "; " + note;
    if (peak_) {
      add(requirement, per * abs(peak_->torque), limit, unit, load_case::start, of_start() + also);
    } else {
      leave(requirement, limit, unit, load_case::start);
      if (passes())
        add(requirement, {per * std::abs(passing_->torque), 0}, limit, unit, load_case::passing, of_passing() + also)
            .bound = true;
    }
    Verdict& v =
        add(requirement, steady_factor.second * per * abs(load_.largest()), limit, unit, load_case::steady, note);
    v.factor = steady_factor.second, v.factors = words_of({steady_factor});
  }

  void alternating_stress() {
    const ShaftRating& shaft = limits_.shaft;
    const double per = 1 / limits_.polar_modulus;
    const Estimate amplitude = per * load_.amplitude();
    const auto steady = [&](const char* requirement, const Estimate& value, double limit, const std::string& note) {
      add(requirement, value, limit, "Pa", load_case::steady, note);
    };
    if (shaft.vibratory) steady(requirement::vibratory_stress, amplitude, *shaft.vibratory, "");
    if (shaft.endurance) {
      const Fatigue f = fatigue_of(shaft, amplitude, per * abs(load_.middle()));
      steady(requirement::fatigue, f.stress, *shaft.endurance, f.note);
    }
    if (shaft.yield)
      largest(requirement::yield, shaft.yield_in_shear(), "Pa", shaft.safety * per, {"K_A", 1.0},
              shaft.safety != 1 ? fmt::format("S = {:g}", shaft.safety) : "");
    if (shaft.is_of_propulsion() && std::isfinite(joint_.continuous(speed_)))
      steady(requirement::continuous, amplitude, joint_.continuous(speed_),
             fmt::format("λ = {:.3g}", joint_.speed_ratio(speed_)));
  }

  const LimitedJoint& joint_;
  const DriveLimits& limits_;
  const JointLoad& load_;
  double speed_;  // of the link [rad/s]
  const RunUp& run_up_;
  const RunUp::Peak* peak_;
  const Passing* passing_;
  const SpeedUnit& unit_;
  std::vector<Verdict>& out_;
};

}  // namespace

Fatigue fatigue_of(const ShaftRating& shaft, const Estimate& amplitude, const Estimate& mean) {
  return {
      {shaft.fatigue_stress(amplitude.value, mean.value),
       shaft.fatigue_stress(amplitude.error.value_or(0), mean.error.value_or(0))},
      fmt::format("τ_a = {:.4g} MPa, τ_m = {:.4g} MPa, τ_B = {:.4g} MPa, K_f = {:g}, S = {:g}", 1e-6 * amplitude.value,
                  1e-6 * mean.value, 1e-6 * shaft.strength_in_shear(), shaft.notch, shaft.safety)};
}

const char* name_of(Compliance c) { return enumerator_words<Compliance::not_assessed>(c); }

Compliance Verdict::state() const {
  if (!assessed) return Compliance::not_assessed;
  if (gives_way) return Compliance::exceeded;
  if (std::isnan(value) || std::isnan(known_error())) return Compliance::undecided;
  if (value + known_error() <= limit) return Compliance::holds;
  if (bound) return Compliance::not_assessed;
  return value - known_error() <= limit ? Compliance::undecided : Compliance::exceeded;
}

Verdict not_assessed(std::string component, std::string requirement, double limit, std::string unit,
                     const char* load_case, std::string why) {
  Verdict v{{std::nan(""), 0}, std::move(component), std::move(requirement), limit, std::move(unit), std::move(why)};
  v.load_case = load_case, v.assessed = false;
  return v;
}

double enough(double value) {
  if (value == 0 || !std::isfinite(value)) return value;
  const double unit = std::pow(10, std::floor(std::log10(std::abs(value))) - 3);
  return unit * std::ceil(value / unit - 1e-2);
}

std::string name_of_remedy(const Verdict& v) {
  return v.remedy ? v.remedy->key + " for " + v.requirement : std::string();
}

std::string in_words(const Remedy& r, bool up_to) {
  const std::string value = r.unit == "m" ? fmt::format("{:.4g} mm", 1e3 * r.value) : short_text(r.value, r.unit);
  return fmt::format("{}it holds {} {} = {}{}{}", r.tried ? "" : "by an estimate ", up_to ? "up to" : "from",
                     r.key.substr(r.key.rfind('.') + 1), value, up_to ? "" : " on",
                     r.tried ? (up_to ? ", and does not 1 % above" : ", and does not 1 % below") : "");
}

namespace {

// "clutch", heat of an engagement (run)
std::string name_of(const Verdict& v) {
  return fmt::format("\"{}\", {} ({})", v.component, v.requirement.substr(0, v.requirement.find(':')), v.load_case);
}

// "clutch", heat of an engagement (run): 132 % of the limit
std::string use_in_words(const Verdict& v) {
  if (v.gives_way) return name_of(v) + ": more than its capacity";
  return fmt::format("{}: {:.0f} % of the limit", name_of(v), 100 * v.share());
}

// "9.16 kN·m · 1.2 of 10 kN·m", "; it holds from …"
std::string numbers_in_words(const Verdict& v) {
  if (v.gives_way) return "it slips at " + short_text(v.limit, v.unit);
  const bool counted = v.factor != 1 && std::isfinite(v.load());
  return fmt::format("{}{} of {}{}", short_text(counted ? v.load() : v.value, v.unit),
                     counted ? fmt::format(" · {:.3g}", v.factor) : "", short_text(v.limit, v.unit),
                     v.note.empty() ? "" : "; " + v.note);
}

// Of the verdicts in that state the one nearest to its limit, or farthest beyond it; null: none.
const Verdict* worst_of(const std::vector<Verdict>& verdicts, Compliance state) {
  const Verdict* worst = nullptr;
  for (const Verdict& v : verdicts)
    if (v.state() == state && (!worst || v.share() > worst->share())) worst = &v;
  return worst;
}

// The decisive verdict: exceeded before undecided, held, and not assessed.
const Verdict* decisive(const std::vector<Verdict>& verdicts) {
  for (const Compliance state :
       {Compliance::exceeded, Compliance::undecided, Compliance::holds, Compliance::not_assessed})
    if (const Verdict* worst = worst_of(verdicts, state)) return worst;
  return nullptr;
}

std::string left_open(const std::vector<Verdict>& verdicts) {
  const Verdict* first = worst_of(verdicts, Compliance::not_assessed);
  if (!first) return {};
  const auto more = std::count_if(verdicts.begin(), verdicts.end(),
                                  [](const Verdict& v) { return v.state() == Compliance::not_assessed; }) -
                    1;
  return fmt::format("not assessed: {}{}", name_of(*first), more > 0 ? fmt::format(" and {} more", more) : "");
}

// Summary of the assessed ones.
std::string sum_up(const std::vector<Verdict>& all, const Verdict& worst, const std::string& what) {
  const auto count = [&](Compliance state) {
    return std::count_if(all.begin(), all.end(), [&](const Verdict& v) { return v.state() == state; });
  };
  const auto open = count(Compliance::not_assessed), number = static_cast<std::ptrdiff_t>(all.size()) - open;
  const bool one = number == 1;
  switch (worst.state()) {
    case Compliance::exceeded:
      return fmt::format("{}{}, {}",
                         one ? "a " + what + " is EXCEEDED, "
                             : fmt::format("{} of {} {}s EXCEEDED, worst ", count(Compliance::exceeded), number, what),
                         use_in_words(worst), numbers_in_words(worst));
    case Compliance::undecided:
      return fmt::format("{} of {} {}s undecided, {}", count(Compliance::undecided), number, what, use_in_words(worst));
    case Compliance::holds:
      return fmt::format("{}{} hold{}, {}{}",
                         one           ? (open > 0 ? "the one " : "its ") + what
                         : number == 2 ? "both " + what + "s"
                                       : fmt::format("all {} {}s", number, what),
                         open > 0 ? (one ? " that is assessed" : " that are assessed") : "", one ? "s" : "",
                         one ? "" : "the nearest ", use_in_words(worst));
    case Compliance::not_assessed:
      return {};
  }
  return {};
}

Predicate predicate_of(Compliance state) {
  constexpr Predicate of[] = {Predicate::limit_held, Predicate::limit_exceeded, Predicate::limit_undecided,
                              Predicate::not_assessed};
  return of[static_cast<std::size_t>(state)];
}

}  // namespace

std::string sentence_of(const std::vector<Verdict>& verdicts, const std::string& what) {
  const Verdict* worst = decisive(verdicts);
  if (!worst) return "";
  const std::string judged = sum_up(verdicts, *worst, what), open = left_open(verdicts);
  return judged + (judged.empty() || open.empty() ? "" : "; ") + open;
}

Claims limit_claims(const std::vector<Verdict>& verdicts, const std::string& what) {
  Claims claims;
  const Verdict* worst = decisive(verdicts);
  const auto known = [](double x) { return std::isfinite(x) ? std::optional(x) : std::nullopt; };
  for (const Verdict& v : verdicts) {
    const Compliance state = v.state();
    const std::string text = &v == worst                         ? capitalised(sentence_of(verdicts, what))
                             : state == Compliance::not_assessed ? name_of(v) + ": not assessed"
                                                                 : use_in_words(v) + ", " + numbers_in_words(v);
    std::optional<Claim> claim = claimed(predicate_of(state), text, v.component,
                                         {.at = v.at,
                                          .value = v.gives_way ? std::nullopt : known(v.value),
                                          .limit = known(v.limit),
                                          .error = v.error ? known(*v.error) : std::nullopt,
                                          .unit = v.unit});
    if (!claim) continue;
    claim->load_case = v.load_case, claim->remedy = v.remedy, claim->in_conclusion = &v == worst;
    claims.push_back(std::move(*claim));
  }
  return claims;
}

void hold_under(const std::string& condition, Claims& claims) {
  for (Claim& claim : claims) {
    if (claim.predicate != Predicate::limit_held || !claim.in_conclusion || !claim.variant.empty()) continue;
    for (const char* first : {"All ", "Both ", "Its ", "The one "})  // sum_up()
      if (claim.text.starts_with(first)) {
        claim.text[0] = static_cast<char>(claim.text[0] - 'A' + 'a');
        claim.text = capitalised(condition) + " " + claim.text;
        break;
      }
  }
}

Estimate start_torque(const DriveLimits& limits, const Estimate& peak, const Estimate& mean) {
  const double whole = std::abs(peak.value);
  if (!std::isfinite(whole)) return {whole, 0};
  const double steady = std::clamp(std::copysign(1.0, peak.value) * mean.value, 0.0, whole);
  const double most = limits.start_factor * whole, least = steady + limits.start_factor * (whole - steady);
  const double factor = limits.temperature_factor;
  return {factor * 0.5 * (most + least),
          factor * (0.5 * (most - least) + limits.start_factor * peak.error.value_or(0))};
}

std::vector<Verdict> judge(const std::vector<LimitedJoint>& joints, const SteadyLoads& loads, const RunUp& run_up,
                           const std::vector<Passing>& passing, const SpeedUnit& speed_unit) {
  std::vector<Verdict> verdicts;
  for (std::size_t i = 0; i < joints.size(); ++i)
    if (joints[i].limits.any())
      Judge(joints[i], loads.joints[i], loads.speed, run_up, run_up.found ? &run_up.peaks[i] : nullptr,
            i < passing.size() ? &passing[i] : nullptr, speed_unit, verdicts)
          .all();
  return verdicts;
}

}  // namespace kurbel
