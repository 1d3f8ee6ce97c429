// slider_crank.h — the slider-crank as an element: variable inertia, weight and slider loads reduced to its crank.
//     M = −½ I_r′ ω² + M_g(φ) + Σ F x′(φ),   and I_r(φ) adds to the shaft's inertia            (THEORY 2.1, 2.2, 2.4)
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "engine/network.h"
#include "mechanisms/reduced_mechanism.h"
#include "mechanisms/slider_loads.h"

namespace kurbel {

struct SliderCrank {
  std::string name;
  SliderCrankData data;
  std::shared_ptr<const ReducedMechanism> reduced;
  std::shared_ptr<SliderCrankBodies> bodies;  // for the independent kinetic energy
  std::vector<SliderLoad> loads;
  double x_min = 0, x_max = 0;
  double mean_inertia = 0;  // of I_r over a turn [kg·m²]
  double least_inertia = 0;
  double phase = 0;  // added to the shaft's angle [rad]

  bool has_weight() const { return data.gravity != 0; }
  double stroke() const { return x_max - x_min; }
};

class SliderCrankMaker final : public ShaftElementMaker {
 public:
  explicit SliderCrankMaker(SliderCrank crank) : crank_(std::move(crank)) {}
  const SliderCrank& crank() const { return crank_; }

  bool uses_angle() const override { return true; }
  bool directional() const override;
  Rated rated() const override;
  Account account() const override { return Account::weight; }
  double mean_inertia() const override { return crank_.mean_inertia; }
  double least_inertia() const override { return crank_.least_inertia; }
  double cycle() const override;
  InertiaAt inertia_at(double angle) const override {
    const auto [value, slope] = crank_.reduced->inertia(angle);
    return {value, slope};
  }
  double angle_period() const override { return cycle(); }
  bool uses_time() const override { return false; }
  bool uses_speed() const override;
  std::string describe() const override;
  int mode_count() const override { return 1 + static_cast<int>(crank_.loads.size()); }
  std::vector<std::pair<std::string, Account>> further_accounts() const override;
  void place(PoolSet& pools, const ShaftPorts& ports, const ShaftElementLabel& label) const override;

 private:
  SliderCrank crank_;
};

// Modes of a placed slider-crank: the sign of x′ first, then the piece of each load.
class SliderCrankPool final : public ElementPool {
 public:
  void place(SliderCrank crank, ShaftPorts at);

  void add(const Instant& now, Sums& sums) const override;
  void register_jacobian(JacobianPattern& pattern) override;
  void add_jacobian(const Instant& now, const double* alpha, double* slots) const override;
  int guard_count() const override { return guards_; }
  bool guards_are_of_angle() const override { return true; }  // over travel or crank angle, whatever the speed
  void guards(const Instant& now, double* g) const override;
  void fire(const Instant& now, int guard, int* mode) const override;
  GuardLabel label(int guard, const int* mode) const override;
  void first_modes(const Instant& now, int* mode) const override;
  void add_holds(const Instant& now, Hold* shaft, Hold* element) const override;
  double kinetic_energy_of_bodies(const Instant& now) const override;
  void add_channels(std::vector<Channel>& channels) const override;

 private:
  struct Placed {
    SliderCrank crank;
    ShaftPorts at;
    int slot_angle = 0, slot_rate = 0;
    bool watches_travel = false;  // some load depends on the direction of travel
  };
  struct GuardOwner {
    std::size_t placed;
    int load;  // −1: the sign of x′
    int which;
  };
  SliderState<double> slider(const Placed& p, const Instant& now, std::size_t load) const;
  double load_force(const Placed& p, const Instant& now) const;

  std::vector<Placed> placed_;
  std::vector<GuardOwner> owners_;
  int guards_ = 0;
};

}  // namespace kurbel
