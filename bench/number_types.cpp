// number_types.cpp — would elements whose parameters are template values (Coupling<P>) pay, for four machines of a sweep
// in the lanes of one register, and for derivatives by parameters? A prototype by itself; read by callgrind:
//     g++ -std=c++20 -O3 -DNDEBUG -I. bench/number_types.cpp -o number_types        (and with -mavx2 -mfma)
//     valgrind --tool=callgrind --callgrind-out-file=counts.out ./number_types && callgrind_annotate --inclusive=yes counts.out
// Its answer stands in engine/elements/README.md.
#include <array>
#include <cmath>
#include <cstdio>
#include <experimental/simd>

#include "drivetrain/couplings/backlash.h"
#include "drivetrain/couplings/coupling.h"
#include "engine/numerics/dual.h"

namespace kurbel {
namespace {

using Lanes = std::experimental::fixed_size_simd<double, 4>;
constexpr int masses = 16, evaluations = 100;

// --- laws with parameters of type P, motion of type P ---
template <class P>
struct CouplingOf {
  P stiffness, damping;
  P torque(const P& angle, const P& rate) const { return stiffness * angle + damping * rate; }
};
template <class P>
struct KlossOf {
  P breakdown_torque, synchronous_speed, breakdown_slip;
  P torque(const P& speed) const {
    const P slip = (synchronous_speed - speed) / synchronous_speed;
    return 2.0 * breakdown_torque * breakdown_slip * slip / (slip * slip + breakdown_slip * breakdown_slip);
  }
};
// Backlash after "no pulling" (drivetrain/couplings/backlash.h): every machine has its own mode, so that lanes compute
// all pieces and choose.
template <class P>
struct BacklashOf {
  P stiffness, damping, gap;
};
double backlash_torque(const BacklashOf<double>& b, int mode, double angle, double rate) {
  if (mode == 0 || std::abs(mode) == 3) return 0;
  const double side = mode > 0 ? 1 : -1, p = side * angle - 0.5 * b.gap, v = side * rate;
  return side * (std::abs(mode) == 2 ? 2 * b.stiffness * p : b.stiffness * p + b.damping * v);
}
Lanes backlash_torque(const BacklashOf<Lanes>& b, const Lanes& mode, const Lanes& angle, const Lanes& rate) {
  using std::experimental::abs;
  Lanes side = 1.0, torque;
  where(mode < 0.0, side) = -1.0;
  const Lanes p = side * angle - 0.5 * b.gap, v = side * rate;
  torque = b.stiffness * p + b.damping * v;
  where(abs(mode) == 2.0, torque) = 2.0 * b.stiffness * p;
  where(mode == 0.0 || abs(mode) == 3.0, torque) = 0.0;
  return side * torque;
}

// --- a chain of masses with a motor at one end and a load at the other ---
template <class P>
struct Machine {
  std::array<CouplingOf<P>, masses - 1> coupling;
  std::array<P, masses> inertia;
  KlossOf<P> motor;
  P load;
};
template <class P>
struct State {
  std::array<P, masses - 1> twist, twist_rate;
  std::array<P, masses> speed, rate;
};
template <class P>
void right_hand_side(const Machine<P>& m, State<P>& s) {
  std::array<P, masses> torque{};
  torque[0] = m.motor.torque(s.speed[0]);
  torque[masses - 1] = -m.load * s.speed[masses - 1] * s.speed[masses - 1];
  for (std::size_t i = 0; i + 1 < masses; ++i) {
    s.twist_rate[i] = s.speed[i] - s.speed[i + 1];
    const P tau = m.coupling[i].torque(s.twist[i], s.twist_rate[i]);
    torque[i] = torque[i] - tau;
    torque[i + 1] = torque[i + 1] + tau;
  }
  for (std::size_t i = 0; i < masses; ++i) s.rate[i] = torque[i] / m.inertia[i];
}

double varied(int lane, std::size_t i) { return 1 + 0.01 * lane + 0.001 * static_cast<double>(i); }
template <class P>
P of_lane(int lane, double value, std::size_t i) {
  if constexpr (std::is_same_v<P, Lanes>)
    return Lanes([&](auto k) { return value * varied(static_cast<int>(k), i); });
  else
    return P(value * varied(lane, i));
}
template <class P>
void fill(Machine<P>& m, State<P>& s, int lane) {
  for (std::size_t i = 0; i < masses; ++i) {
    m.inertia[i] = of_lane<P>(lane, 0.2, i);
    s.speed[i] = of_lane<P>(lane, 150, i);
    if (i + 1 == masses) break;
    m.coupling[i] = {of_lane<P>(lane, 1e4, i), of_lane<P>(lane, 2, i)};
    s.twist[i] = of_lane<P>(lane, 1e-3, i);
  }
  m.motor = {of_lane<P>(lane, 300, 0), of_lane<P>(lane, 157, 0), of_lane<P>(lane, 0.1, 0)};
  m.load = of_lane<P>(lane, 1e-3, 0);
}

// --- what is counted: `evaluations` times each ---
template <class P, int machines>
[[gnu::noinline]] void chain(std::array<Machine<P>, machines>& m, std::array<State<P>, machines>& s) {
  for (int n = 0; n < evaluations; ++n)
    for (std::size_t k = 0; k < machines; ++k) right_hand_side(m[k], s[k]);
}
[[gnu::noinline]] void chain_four_one_after_another(std::array<Machine<double>, 4>& m,
                                                    std::array<State<double>, 4>& s) {
  chain<double, 4>(m, s);
}
[[gnu::noinline]] void chain_four_lanes(std::array<Machine<Lanes>, 1>& m, std::array<State<Lanes>, 1>& s) {
  chain<Lanes, 1>(m, s);
}
[[gnu::noinline]] double gap_four_one_after_another(const std::array<BacklashOf<double>, 4>& b, const int (*mode)[4],
                                                    double& angle) {
  double sum = 0;
  for (int n = 0; n < evaluations; ++n)
    for (std::size_t k = 0; k < 4; ++k) sum += backlash_torque(b[k], mode[n % 8][k], angle, 0.1);
  return sum;
}
[[gnu::noinline]] double gap_four_lanes(const BacklashOf<Lanes>& b, const std::array<Lanes, 8>& mode, double& angle) {
  Lanes sum = 0.0;
  for (int n = 0; n < evaluations; ++n)
    sum += backlash_torque(b, mode[static_cast<std::size_t>(n % 8)], Lanes(angle), Lanes(0.1));
  return reduce(sum);
}

// ∂(accelerations)/∂k of one coupling among all, at a state.
[[gnu::noinline]] double by_parameter_dual(Machine<Dual<1>>& m, State<Dual<1>>& s) {
  for (int n = 0; n < evaluations; ++n) {
    m.coupling[7].stiffness = Dual<1>::input(1e4, 0);
    right_hand_side(m, s);
  }
  return s.rate[7].d[0];
}
[[gnu::noinline]] double by_parameter_whole_difference(Machine<double>& m, State<double>& s) {
  double slope = 0;
  for (int n = 0; n < evaluations; ++n) {
    const double k = 1e4, h = 6e-6 * k;
    m.coupling[7].stiffness = k + h;
    right_hand_side(m, s);
    const double up = s.rate[7];
    m.coupling[7].stiffness = k - h;
    right_hand_side(m, s);
    slope = (up - s.rate[7]) / (2 * h);
  }
  return slope;
}
// A parameter belongs to one element: that one alone is asked twice, as it is today (double parameters).
[[gnu::noinline]] double by_parameter_own_difference(Coupling& c, const Twist<double>& x, double inertia) {
  double slope = 0;
  for (int n = 0; n < evaluations; ++n) {
    const double k = c.stiffness, h = 6e-6 * k;
    c.stiffness = k + h;
    const double up = c.torque(x);
    c.stiffness = k - h;
    slope = -(up - c.torque(x)) / (2 * h) / inertia;
    c.stiffness = k;
    asm volatile("" : "+m"(slope), "+m"(c));  // nothing of it may be computed once for all
  }
  return slope;
}

}  // namespace
}  // namespace kurbel

int main() {
  using namespace kurbel;
  std::array<Machine<double>, 4> four;
  std::array<State<double>, 4> state;
  for (int k = 0; k < 4; ++k) fill(four[static_cast<std::size_t>(k)], state[static_cast<std::size_t>(k)], k);
  std::array<Machine<Lanes>, 1> lanes;
  std::array<State<Lanes>, 1> of_lanes;
  fill(lanes[0], of_lanes[0], 0);
  chain_four_one_after_another(four, state);
  chain_four_lanes(lanes, of_lanes);
  double most = 0;
  for (std::size_t k = 0; k < 4; ++k)
    for (std::size_t i = 0; i < masses; ++i)
      most = std::max(most, std::abs(of_lanes[0].rate[i][k] / state[k].rate[i] - 1));
  std::printf("lanes against one after another: %.1e relative\n", most);

  const int mode[8][4] = {{0, 0, 1, 1}, {1, 1, 0, 2}, {1, 1, 1, 1},   {-1, -1, 3, 0},
                          {0, 0, 0, 0}, {2, 1, 1, 1}, {-1, 0, 1, -3}, {1, 2, 2, 1}};
  std::array<BacklashOf<double>, 4> gap;
  BacklashOf<Lanes> gaps{of_lane<Lanes>(0, 1e4, 0), of_lane<Lanes>(0, 2, 0), of_lane<Lanes>(0, 1e-3, 0)};
  for (int k = 0; k < 4; ++k)
    gap[static_cast<std::size_t>(k)] = {of_lane<double>(k, 1e4, 0), of_lane<double>(k, 2, 0),
                                        of_lane<double>(k, 1e-3, 0)};
  std::array<Lanes, 8> modes;
  for (std::size_t n = 0; n < 8; ++n) modes[n] = Lanes([&](auto k) { return static_cast<double>(mode[n][k]); });
  double angle = 2e-3;
  std::printf("backlash: %.10g, %.10g\n", gap_four_one_after_another(gap, mode, angle),
              gap_four_lanes(gaps, modes, angle));

  Machine<Dual<1>> dual;
  State<Dual<1>> dual_state;
  fill(dual, dual_state, 0);
  const double exact = by_parameter_dual(dual, dual_state);
  fill(four[0], state[0], 0);
  const double whole = by_parameter_whole_difference(four[0], state[0]);
  Coupling own{1e4, four[0].coupling[7].damping};
  const Twist<double> x{state[0].twist[7], state[0].speed[7] - state[0].speed[8]};
  const double local = by_parameter_own_difference(own, x, four[0].inertia[7]);
  // Of a law that is no straight line in its parameter: Kloss by the breakdown slip, at 150 rad/s.
  const auto kloss = [](auto slip) {
    return KlossOf<decltype(slip)>{300.0, 157.0, slip}.torque(decltype(slip)(150.0));
  };
  const double h = 6e-6 * 0.1, slope = kloss(Dual<1>::input(0.1, 0)).d[0];
  std::printf("by a breakdown slip: differences %.1e off\n",
              std::abs((kloss(0.1 + h) - kloss(0.1 - h)) / (2 * h) / slope - 1));
  std::printf("by a stiffness: %.12g exact; differences of the whole %.1e, of its element %.1e off\n", exact,
              std::abs(whole / exact - 1), std::abs(local / exact - 1));
}
