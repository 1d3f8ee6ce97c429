// mode_exponents.cpp — modes of the periodic system compared with those of the mean, including modes suppressed by contacts.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "engine/numerics/angles.h"
#include "engine/numerics/index.h"
#include "engine/periodic/floquet.h"
#include "studies/modes/mode_list.h"

namespace kurbel {
namespace {

constexpr std::size_t most_states_of_exponents = 60;
constexpr double reported_of_mean = 0.01;  // of |λ|: an error of the mean that is worth a note
constexpr double near_enough = 0.5;        // of |λ|: how far an exponent may be from its mode of the mean
constexpr double fades = 5;                // e-foldings in a cycle: what is left then is less than a hundredth
constexpr double varies_much = 0.01;       // of ω, over the angles of the cycle
constexpr double explained = 0.5;  // |ln μ − λT|: a change that this slow mode of the cycle's mean suffices for

bool varies_with_angle(const Model& m) {
  return std::any_of(m.network.elements.begin(), m.network.elements.end(),
                     [](const Network::ShaftElement& e) { return e.element->is.uses_angle; }) ||
         std::any_of(m.elastic.begin(), m.elastic.end(),
                     [&](const ElasticJoint& e) { return m.network.joints[at(e.joint)].element->is.uses_angle; });
}

// Assigns a period's exponents to the modes.
class Exponents {
 public:
  Exponents(const FloquetSpectrum& spectrum, bool contacts_change, ModesStudy& found)
      : spectrum_(spectrum), contacts_change_(contacts_change), found_(found), used_(spectrum.exponents.size(), 0) {
    for (Mode& mode : found.modes) slowest_first_.push_back(&mode);
    std::stable_sort(slowest_first_.begin(), slowest_first_.end(),
                     [](const Mode* a, const Mode* b) { return a->magnitude() < b->magnitude(); });
  }

  void hand_out() {
    give_own();
    give_pairs();
    report_missing_exponents();
    report_decayed();
    report_largest_change();
  }

 private:
  struct Candidate {
    std::size_t number;
    PeriodicMode vibration;
    double off;  // from the mode's λ [1/s]
  };
  const FloquetExponent& of(std::size_t i) const { return spectrum_.exponents[i]; }
  bool is_gone(std::size_t i) const { return of(i).exponent.real() == -HUGE_VAL; }
  // A real multiplier has the phase 0 or π, whatever motion it belongs to.
  bool is_real(std::size_t i) const { return std::abs(std::sin(of(i).exponent.imag() * spectrum_.time)) < 1e-6; }

  const std::complex<double>* mean_of(std::size_t i) const {
    return of(i).mode < 0 ? nullptr : &spectrum_.modes[at(of(i).mode)].exponent;
  }
  static bool is_near(std::complex<double> s, const Mode& mode) {
    return std::abs(s - mode.lambda) < near_enough * std::abs(mode.lambda);
  }
  // A change of speed as a whole, which does not oscillate in the period's mean system either.
  bool is_slow(std::size_t i) const {
    const std::complex<double>* mean = mean_of(i);
    return mean && mean->imag() == 0 && std::abs(of(i).exponent - *mean) * spectrum_.time < explained;
  }

  // If contacts change within the period, the motion alternates between different machines, and its number of
  // oscillations per period is a matter of definition.
  PeriodicMode as_near_as_can_be(std::size_t i, const Mode& mode) const {
    PeriodicMode vibration{of(i).exponent, of(i).error, of(i).branch_by_mean};
    if (!contacts_change_ && !vibration.branch_by_mean) return vibration;
    const double turn = 2 * pi / spectrum_.time;
    const double turns = std::round((mode.lambda.imag() - vibration.exponent.imag()) / turn);
    vibration.branch_by_mean = vibration.branch_by_mean || turns != 0;
    vibration.exponent += std::complex<double>(0, turns * turn);
    return vibration;
  }

  // Those not used yet, nearest first.
  std::vector<Candidate> near(const Mode& mode, bool of_real_multiplier) const {
    std::vector<Candidate> list;
    for (std::size_t i = 0; i < spectrum_.exponents.size(); ++i) {
      if (used_[i] || is_gone(i) || is_slow(i) || is_real(i) != of_real_multiplier) continue;
      const PeriodicMode vibration = as_near_as_can_be(i, mode);
      if (vibration.exponent.imag() > 0 && is_near(vibration.exponent, mode))
        list.push_back({i, vibration, std::abs(vibration.exponent - mode.lambda)});
    }
    std::sort(list.begin(), list.end(), [](const Candidate& a, const Candidate& b) { return a.off < b.off; });
    return list;
  }
  void give(Mode& mode, const Candidate& candidate) {
    used_[candidate.number] = 1;
    mode.periodic.push_back(candidate.vibration);
    if (!candidate.vibration.branch_by_mean || (mode.periodic.size() > 1 && mode.periodic.front().branch_by_mean))
      return;
    found_.notes.push_back(
        fmt::format("frequencies of mode {} in the periodic system are known except for multiples of 1/T = {:.6g} Hz: "
                    "other parts take over the vibration within the cycle, so that its turns cannot be counted; given "
                    "are those nearest to the mean's",
                    mode.number, 1 / spectrum_.time));
  }
  void give_own() {
    for (Mode* mode : slowest_first_) {
      if (!(mode->lambda.imag() > 0)) continue;
      const std::vector<Candidate> own = near(*mode, false);
      if (own.empty()) continue;
      give(*mode, own.front());
      use_conjugate_of(own.front().number);
    }
  }
  void use_conjugate_of(std::size_t number) {
    for (std::size_t i = 0; i < spectrum_.exponents.size(); ++i)
      if (!used_[i] && std::abs(of(i).exponent - std::conj(of(number).exponent)) < 1e-9 * std::abs(of(number).exponent))
        used_[i] = 1;
  }

  // Two real multipliers instead of an oscillation: it is locked to the period. A single one is a slow change of speed.
  void give_pairs() {
    for (Mode* place : slowest_first_) {
      Mode& mode = *place;
      if (!(mode.lambda.imag() > 0) || !mode.periodic.empty()) continue;
      const std::vector<Candidate> own = near(mode, true);
      if (own.size() < 2) continue;
      give(mode, own[0]);
      give(mode, own[1]);
      const PeriodicMode &one = mode.periodic[0], &two = mode.periodic[1];
      found_.notes.push_back(fmt::format(
          "mode {} is locked to the cycle by what changes within it: it oscillates at {:.6g} Hz and {:.6g} Hz, "
          "with ζ = {:.4g} and {:.4g}; the mean of the coefficients says {:.6g} Hz and {:.4g}",
          mode.number, one.exponent.imag() / (2 * pi), two.exponent.imag() / (2 * pi), one.ratio(), two.ratio(),
          mode.lambda.imag() / (2 * pi), mode.ratio));
    }
  }

  // The spectrum is complete: a mode without a remaining oscillating exponent does not oscillate. Sticking contacts
  // remove degrees of freedom.
  void report_missing_exponents() {
    bool gone = false;
    for (std::size_t i = 0; i < spectrum_.exponents.size(); ++i) gone = gone || is_gone(i);
    for (Mode& mode : found_.modes) {
      if (!(mode.lambda.imag() > 0) || !mode.periodic.empty()) continue;
      mode.only_of_mean = !may_have_one_left(mode);
      const std::string which =
          fmt::format("mode {} ({:.6g} Hz by the mean)", mode.number, mode.lambda.imag() / (2 * pi));
      found_.notes.push_back(
          !mode.only_of_mean ? "no exponent of the periodic system lies near " + which +
                                   ": its figures are those of the mean alone, with an error that is not known"
          : gone
              ? "nothing of " + which + " remains after a cycle: contacts that stick within it suppress the vibration"
              : which +
                    " does not oscillate in the periodic system: changes within the cycle turn it into a slow decay");
    }
  }
  // One that oscillates and belongs to no other mode of the period's mean system.
  bool may_have_one_left(const Mode& mode) const {
    for (std::size_t i = 0; i < spectrum_.exponents.size(); ++i) {
      if (used_[i] || is_gone(i) || is_real(i)) continue;
      const std::complex<double>* mean = mean_of(i);
      if (!mean || is_near({mean->real(), std::abs(mean->imag())}, mode)) return true;
    }
    return false;
  }

  void report_decayed() {
    for (Mode& mode : found_.modes) {
      if (mode.periodic.empty() || mode.greatest - mode.least < varies_much * mode.omega) continue;
      mode.fades_within_cycle = -mode.periodic.front().exponent.real() * spectrum_.time > fades;
      if (mode.fades_within_cycle)
        found_.notes.push_back(fmt::format(
            "mode {} decays long before the end of a cycle: a vibration that starts at one angle has the frequency of "
            "the drive held there, between {:.4g} and {:.4g} Hz (undamped); {:.4g} Hz is the mean over the cycle",
            mode.number, mode.least / (2 * pi), mode.greatest / (2 * pi),
            mode.periodic.front().exponent.imag() / (2 * pi)));
    }
  }

  void report_largest_change() {
    double worst = reported_of_mean;
    const Mode* of = nullptr;
    for (const Mode& mode : found_.modes) {
      if (mode.periodic.size() != 1) continue;
      const double change = std::abs(mode.periodic.front().exponent - mode.lambda) / std::abs(mode.lambda);
      if (change > worst) worst = change, of = &mode;
    }
    if (!of) return;
    const PeriodicMode& vibration = of->periodic.front();
    found_.notes.push_back(fmt::format(
        "coefficients change within the cycle: by the exponents of the periodic system mode {} oscillates at {:.6g} Hz "
        "with ζ = {:.4g}, the mean of the coefficients says {:.6g} Hz and {:.4g}",
        of->number, vibration.exponent.imag() / (2 * pi), vibration.ratio(), of->lambda.imag() / (2 * pi), of->ratio));
  }

  const FloquetSpectrum& spectrum_;
  bool contacts_change_;
  ModesStudy& found_;
  std::vector<Mode*> slowest_first_;
  std::vector<char> used_;
};

}  // namespace

void find_exponents(const Orbit& orbit, const CycleSamples& samples, ModesStudy& found) {
  const Model& m = *found.drive.model;
  const bool contacts_change = std::any_of(samples.events.begin(), samples.events.end(), changes_contact);
  if (!(varies_with_angle(m) || contacts_change) || m.state_count() > most_states_of_exponents) return;
  const FloquetSpectrum spectrum = floquet_exponents(*orbit.map, orbit.point.z);
  if (!spectrum.found())
    found.notes.push_back("no exponents of the periodic system beside the modes of the mean: " + spectrum.why);
  else
    Exponents(spectrum, contacts_change, found).hand_out();
}

}  // namespace kurbel
