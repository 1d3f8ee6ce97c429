// mode_exponents.cpp — swings of the periodic system beside those of the mean, contacts that wipe swings out included.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/numerics/index.h"
#include "engine/periodic/floquet.h"
#include "studies/modes/mode_list.h"

namespace kurbel {
namespace {

constexpr double two_pi = 2 * std::numbers::pi;
constexpr std::size_t most_states_of_exponents = 60;
constexpr double told_of_mean = 0.01;  // of |λ|: an error of the mean that is worth a note
constexpr double near_enough = 0.5;    // of |λ|: how far an exponent may be from its mode of the mean

bool varies_with_angle(const Model& m) {
  return std::any_of(m.network.elements.begin(), m.network.elements.end(),
                     [](const Network::ShaftElement& e) { return e.element->is.uses_angle; }) ||
         std::any_of(m.elastic.begin(), m.elastic.end(),
                     [&](const ElasticJoint& e) { return m.network.joints[at(e.joint)].element->is.uses_angle; });
}

// A round's exponents, handed out to the modes.
class Exponents {
 public:
  Exponents(const FloquetSpectrum& spectrum, ModesStudy& found)
      : spectrum_(spectrum), found_(found), used_(spectrum.exponents.size(), 0) {}

  void hand_out() {
    for (Mode& mode : found_.modes)
      if (mode.lambda.imag() > 0) give_own(mode);
    give_pairs();
    tell_those_without();
    tell_largest_change();
  }

 private:
  const FloquetExponent& of(std::size_t i) const { return spectrum_.exponents[i]; }
  bool is_gone(std::size_t i) const { return of(i).exponent.real() == -HUGE_VAL; }
  // A real multiplier has the phase 0 or π, whatever motion it belongs to.
  bool is_real(std::size_t i) const { return std::abs(std::sin(of(i).exponent.imag() * spectrum_.time)) < 1e-6; }
  bool turns_over(std::size_t i) const { return std::cos(of(i).exponent.imag() * spectrum_.time) < 0; }
  static double off(const FloquetExponent& e, const Mode& mode) { return std::abs(e.exponent - mode.lambda); }

  // Of those not used yet, nearest first.
  std::vector<std::size_t> near(const Mode& mode, bool of_real_multiplier) const {
    std::vector<std::size_t> list;
    for (std::size_t i = 0; i < spectrum_.exponents.size(); ++i)
      if (!used_[i] && !is_gone(i) && of(i).exponent.imag() > 0 && is_real(i) == of_real_multiplier &&
          off(of(i), mode) < near_enough * std::abs(mode.lambda))
        list.push_back(i);
    std::sort(list.begin(), list.end(),
              [&](std::size_t a, std::size_t b) { return off(of(a), mode) < off(of(b), mode); });
    return list;
  }
  void give(Mode& mode, std::size_t i) {
    used_[i] = 1;
    mode.periodic.push_back({of(i).exponent, of(i).error, of(i).branch_by_mean});
    if (of(i).branch_by_mean)
      found_.notes.push_back(
          fmt::format("the exponent of mode {} is known but for multiples of 1/T = {:.6g} Hz: within the round its "
                      "swing is passed on to others so that its turns cannot be counted; told is the one nearest to "
                      "the mean's",
                      mode.number, 1 / spectrum_.time));
  }
  void give_own(Mode& mode) {
    const std::vector<std::size_t> own = near(mode, false);
    if (!own.empty()) give(mode, own.front());
  }

  // Two real multipliers of the same sign in place of a swing: it is locked to the round. One alone is a slow change of
  // speed.
  void give_pairs() {
    for (Mode& mode : found_.modes) {
      if (!(mode.lambda.imag() > 0) || !mode.periodic.empty()) continue;
      const std::vector<std::size_t> own = near(mode, true);
      const auto partner = std::find_if(own.begin(), own.end(), [&](std::size_t i) {
        return i != own.front() && turns_over(i) == turns_over(own.front());
      });
      if (partner == own.end()) continue;
      give(mode, own.front());
      give(mode, *partner);
      const PeriodicSwing &one = mode.periodic[0], &two = mode.periodic[1];
      found_.notes.push_back(
          fmt::format("mode {} is locked to the round by coefficients that change with the angle: it swings at {:.6g} "
                      "Hz and {:.6g} Hz, with ζ = {:.4g} and {:.4g}; the mean of the coefficients says {:.6g} Hz and "
                      "{:.4g}",
                      mode.number, one.exponent.imag() / two_pi, two.exponent.imag() / two_pi, one.ratio(), two.ratio(),
                      mode.lambda.imag() / two_pi, mode.ratio));
    }
  }

  // What sticks within the round takes directions away, two for a swing.
  void tell_those_without() {
    std::size_t gone = 0;
    for (std::size_t i = 0; i < spectrum_.exponents.size(); ++i) gone += is_gone(i);
    std::vector<Mode*> without;
    for (Mode& mode : found_.modes)
      if (mode.lambda.imag() > 0 && mode.periodic.empty()) without.push_back(&mode);
    const bool all_gone = gone >= 2 * without.size();
    for (Mode* mode : without) {
      mode->wiped_out = all_gone;
      found_.notes.push_back(
          all_gone ? fmt::format("nothing of mode {} ({:.6g} Hz by the mean) is left after a round: contacts that hold "
                                 "within it take the swing away",
                                 mode->number, mode->lambda.imag() / two_pi)
                   : fmt::format("no exponent of the periodic system lies near mode {}: its {:.6g} Hz are those of the "
                                 "mean alone, with an error that is not known",
                                 mode->number, mode->lambda.imag() / two_pi));
    }
  }

  void tell_largest_change() {
    double worst = told_of_mean;
    const Mode* of = nullptr;
    for (const Mode& mode : found_.modes) {
      if (mode.periodic.size() != 1) continue;
      const double change = std::abs(mode.periodic.front().exponent - mode.lambda) / std::abs(mode.lambda);
      if (change > worst) worst = change, of = &mode;
    }
    if (!of) return;
    const PeriodicSwing& swing = of->periodic.front();
    found_.notes.push_back(fmt::format(
        "coefficients change within the round: by the exponents of the periodic system mode {} swings at {:.6g} Hz "
        "with ζ = {:.4g}, the mean of the coefficients says {:.6g} Hz and {:.4g}",
        of->number, swing.exponent.imag() / two_pi, swing.ratio(), of->lambda.imag() / two_pi, of->ratio));
  }

  const FloquetSpectrum& spectrum_;
  ModesStudy& found_;
  std::vector<char> used_;
};

}  // namespace

void find_exponents(const Regime& regime, const CycleSamples& samples, ModesStudy& found) {
  const Model& m = *found.drive.model;
  const bool contacts_change = std::any_of(samples.events.begin(), samples.events.end(), changes_contact);
  if (!(varies_with_angle(m) || contacts_change) || m.state_count() > most_states_of_exponents) return;
  const FloquetSpectrum spectrum = floquet_exponents(*regime.map, regime.point.z);
  if (!spectrum.found())
    found.notes.push_back("no exponents of the periodic system beside the modes of the mean: " + spectrum.why);
  else
    Exponents(spectrum, found).hand_out();
}

}  // namespace kurbel
