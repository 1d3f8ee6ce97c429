// oil_film.cpp — finite journal bearings by relaxation, and the film parameter of pins over a cycle.
#include "studies/forces/oil_film.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string_view>

namespace kurbel {
namespace {

using std::numbers::pi;

// ∂(h³ ∂p/∂θ)/∂θ + (D/L)² ∂(h³ ∂p/∂ζ)/∂ζ = 6 dh/dθ, h = 1 + ε cos θ, p ≥ 0 (Swift and Stieber), over Sommerfeld's angle γ,
// h = (1 − ε²)/(1 − ε cos γ), in which narrow gaps take as many cells as wide ones. By successive over-relaxation, projected.
double load_on_grid(double e, double slenderness, int cells) {
  const int n = 8 * cells;  // around; `cells` from the middle to an end
  const double s = std::sqrt((1 - e) * (1 + e)), dg = 2 * pi / n, dz = 1.0 / cells;
  const auto gap = [&](double gamma) { return s * s / (1 - e * std::cos(gamma)); };
  const std::size_t width = static_cast<std::size_t>(cells) + 1;
  std::vector<double> p((static_cast<std::size_t>(n) + 1) * width), back, ahead, across, source;
  for (int i = 0; i <= n; ++i) {
    const double h = gap(i * dg), before = gap((i - 0.5) * dg), after = gap((i + 0.5) * dg);
    back.push_back(before * before * s / (dg * dg)), ahead.push_back(after * after * s / (dg * dg));
    across.push_back(std::pow(h, 4) / s / (slenderness * slenderness * dz * dz));
    source.push_back(6 * (after - before) / dg);
  }
  const double over = 2 / (1 + pi / n);
  constexpr double settled = 1e-10;
  constexpr int most_sweeps = 100000;
  for (int sweep = 0; sweep < most_sweeps; ++sweep) {
    double change = 0, largest = 0;
    for (std::size_t i = 1; i < static_cast<std::size_t>(n); ++i)
      for (std::size_t j = 0; j + 1 < width; ++j) {
        double& here = p[i * width + j];
        const double beside = p[i * width + (j == 0 ? 1 : j - 1)] + p[i * width + j + 1];
        const double wanted =
            (back[i] * p[(i - 1) * width + j] + ahead[i] * p[(i + 1) * width + j] + across[i] * beside - source[i]) /
            (back[i] + ahead[i] + 2 * across[i]);
        const double next = std::max(0.0, here + over * (wanted - here));
        change = std::max(change, std::abs(next - here)), largest = std::max(largest, next);
        here = next;
      }
    if (change <= settled * largest) break;
  }
  double along = 0, aside = 0;
  for (int i = 1; i < n; ++i) {
    double sum = 0;  // ∫ p dζ over half the length, Simpson's rule
    for (std::size_t j = 0; j < width; ++j)
      sum += p[static_cast<std::size_t>(i) * width + j] * (j == 0 || j + 1 == width ? 1 : j % 2 == 1 ? 4 : 2) * dz / 3;
    const double gamma = i * dg, below = 1 - e * std::cos(gamma);
    along += sum * (std::cos(gamma) - e) / below * dg * s / below;
    aside += sum * s * std::sin(gamma) / below * dg * s / below;
  }
  return std::hypot(along, aside);
}

const RubbingJoint* film_data(const MechanismJoints& joints, std::string_view name) {
  for (const RubbingJoint& j : joints.joints)
    if (j.name == name && j.film()) return &j;
  return nullptr;
}

double rotation_of(const PositionForces& p, std::string_view body) {
  for (const LinkForces& l : p.forces.links)
    if (l.name == body) return l.omega;
  return 0;  // the frame
}

}  // namespace

Estimate bearing_load_number(double e, double slenderness) {
  if (!(e > 0 && e < 1 && slenderness > 0))
    throw std::invalid_argument(
        fmt::format("bearing: eccentricity {:g}, L/D = {:g}; must be in (0, 1) and > 0", e, slenderness));
  constexpr int cells = 16;
  return estimate_from(load_on_grid(e, slenderness, cells), load_on_grid(e, slenderness, cells / 2), 0.0);
}

Estimate least_film(double load_number, double slenderness) {
  if (load_number <= 0) return {1, 0.0};
  // By bisection of log(1 − ε) on the fine grid's value; the load's error over its slope is the film's.
  double low = std::log(least_gap), high = -1e-3;
  const auto load_at = [&](double log_gap) { return bearing_load_number(-std::expm1(log_gap), slenderness); };
  if (load_at(low).value < load_number) return {0, least_gap};
  while (high - low > 1e-4) {
    const double middle = 0.5 * (low + high);
    (load_at(middle).value > load_number ? low : high) = middle;
  }
  constexpr double aside = 0.01;
  const Estimate load = load_at(low), beyond = load_at(low - aside);
  const double slope = std::log(beyond.value / load.value) / aside, gap = std::exp(low);
  return {gap, gap * (*load.error / load.value / slope + 1e-4)};
}

std::string PinFilm::words() const {
  if (dry) return "dry";
  std::vector<const char*> kinds;
  if (boundary > 0) kinds.push_back("boundary");
  if (mixed > 0) kinds.push_back("mixed");
  if (boundary + mixed < 1) kinds.push_back("fluid");
  return fmt::format("{}", fmt::join(kinds, ", "));
}

std::vector<PinFilm> films_of(const MechanismJoints& joints, const ForceCycle& cycle) {
  std::vector<PinFilm> films;
  const std::vector<JointForces>& all = cycle.positions.front().forces.joints;
  for (std::size_t k = 0; k < all.size(); ++k) {
    const RubbingJoint* j = all[k].slides ? nullptr : film_data(joints, all[k].name);
    if (!j) continue;
    PinFilm film;
    film.joint = all[k].name;
    const double rough = std::hypot(j->roughness, j->bore_roughness);
    film.dry = j->viscosity == 0;
    double most = -1;
    std::vector<double> numbers;
    const double by = j->clearance * j->clearance / (j->film_length * j->radius * j->radius);
    for (const PositionForces& p : cycle.positions) {
      const JointForces& here = p.forces.joints[k];
      const double load = here.force.magnitude(),
                   speed = j->radius * std::abs(rotation_of(p, here.on) - rotation_of(p, here.from));
      const double number = load == 0 ? 0 : load * by / (j->viscosity * speed);  // ∞ where it stands
      numbers.push_back(number);
      if (number > most) most = number, film.phi = p.forces.state.phi, film.load = load, film.speed = speed;
    }
    if (film.dry) {
      film.boundary = 1, film.film.error = film.parameter.error = 0;
      films.push_back(film);
      continue;
    }
    const double slenderness = j->film_length / (2 * j->radius);
    film.film = j->clearance * least_film(most, slenderness);
    film.parameter = (1 / rough) * film.film;
    const auto share_above = [&](double parameter) {  // of positions with a smaller λ
      const double gap = parameter * rough / j->clearance;
      const double limit = gap >= 1 ? 0 : bearing_load_number(1 - std::max(gap, least_gap), slenderness).value;
      return static_cast<double>(
                 std::count_if(numbers.begin(), numbers.end(), [&](double w) { return w > limit || gap >= 1; })) /
             static_cast<double>(numbers.size());
    };
    film.boundary = share_above(boundary_below);
    film.mixed = share_above(fluid_above) - film.boundary;
    films.push_back(film);
  }
  return films;
}

}  // namespace kurbel
