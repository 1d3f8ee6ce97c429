// valid_elements_test.cpp — an element whose member is misspelt, of another form, or there without its trait is none:
// each capability is misspelt once. Had it been taken, it would have done nothing and said nothing.
#include "engine/elements/valid.h"

#include <gtest/gtest.h>

#include "mechanisms/loads/slider_loads.h"

namespace kurbel::valid_elements_test {
namespace {

// --- connections ---
struct Torque {
  template <class T>
  T torque(const Twist<T>&) const {
    return T(0.0);
  }
};
struct Spring : Torque {
  static constexpr ConnectionTraits is{};
  double spring_torque(double) const { return 0; }
  double energy(double) const { return 0; }
  double twist_at(double) const { return 0; }
  double stiffness_at_rest() const { return 1; }
};
struct SpringOfMotion : Torque {
  double spring_torque(const Twist<double>&) const { return 0; }
  double energy(const Twist<double>&) const { return 0; }
  double twist_at(double) const { return 0; }
  double stiffness_at_rest() const { return 1; }
};
struct Film : Torque {
  static constexpr ConnectionTraits is{.springless = true};
};
struct Clutch : Torque {
  static constexpr ConnectionTraits is{.slips = true, .commanded = true};
  Hold hold(const Twist<double>&) const { return {}; }
  double capacity() const { return 1; }
};
static_assert(ValidConnection<Spring> && ValidConnection<Film> && ValidConnection<Clutch>);

struct WithoutTraits : Torque {
  double spring_torque(double) const { return 0; }
  double energy(double) const { return 0; }
  double twist_at(double) const { return 0; }
  double stiffness_at_rest() const { return 1; }
};
static_assert(!ValidConnection<WithoutTraits>);

struct TraitAsMember : Spring {  // as it was said once
  static constexpr bool commanded = true;
};
static_assert(!ValidConnection<TraitAsMember>);

struct TorqueOfDoublesAlone : Spring {
  double torque(const Twist<double>&) const { return 0; }
};
static_assert(!ValidConnection<TorqueOfDoublesAlone>);

struct MisspeltCapacity : Torque {
  static constexpr ConnectionTraits is{.slips = true};
  Hold hold(const Twist<double>&) const { return {}; }
  double capcity() const { return 1; }
};
static_assert(!ValidConnection<MisspeltCapacity>);

struct HoldOfAShaft : Torque {
  static constexpr ConnectionTraits is{.slips = true};
  Hold hold(const ShaftState<double>&) const { return {}; }
  double capacity() const { return 1; }
};
static_assert(!ValidConnection<HoldOfAShaft>);

struct ForgottenSlips : Spring {
  Hold hold(const Twist<double>&) const { return {}; }
};
static_assert(!ValidConnection<ForgottenSlips>);

struct SpringThatSlips : Spring {
  static constexpr ConnectionTraits is{.slips = true};
  Hold hold(const Twist<double>&) const { return {}; }
  double capacity() const { return 1; }
};
static_assert(!ValidConnection<SpringThatSlips>);

struct MisspeltStiffness : Torque {
  static constexpr ConnectionTraits is{};
  double spring_torque(double) const { return 0; }
  double energy(double) const { return 0; }
  double twist_at(double) const { return 0; }
  double stifness_at_rest() const { return 1; }
};
static_assert(!ValidConnection<MisspeltStiffness>);

struct SpringOfTheTwistOnly : Spring {
  static constexpr ConnectionTraits is{.spring_takes_motion = true};
};
static_assert(!ValidConnection<SpringOfTheTwistOnly>);

struct Hooke : SpringOfMotion {
  static constexpr ConnectionTraits is{.uses_angle = true, .turns_unevenly = true, .spring_takes_motion = true};
  template <class T>
  T turning_torque(const Twist<T>&) const {
    return T(0.0);
  }
  double rest_twist(double) const { return 0; }
  double rest_ratio(double) const { return 1; }
  double rest_ratio_slope(double) const { return 0; }
};
static_assert(ValidConnection<Hooke>);

struct MisspeltTurningTorque : SpringOfMotion {
  static constexpr ConnectionTraits is{.uses_angle = true, .spring_takes_motion = true};
  template <class T>
  T turning_torqe(const Twist<T>&) const {
    return T(0.0);
  }
};
static_assert(!ValidConnection<MisspeltTurningTorque>);

struct ForgottenUnevenness : Hooke {
  static constexpr ConnectionTraits is{.uses_angle = true, .spring_takes_motion = true};
};
static_assert(!ValidConnection<ForgottenUnevenness>);

struct MisspeltRestRatio : SpringOfMotion {
  static constexpr ConnectionTraits is{.uses_angle = true, .turns_unevenly = true, .spring_takes_motion = true};
  template <class T>
  T turning_torque(const Twist<T>&) const {
    return T(0.0);
  }
  double rest_twist(double) const { return 0; }
  double rest_ration(double) const { return 1; }
  double rest_ratio_slope(double) const { return 0; }
};
static_assert(!ValidConnection<MisspeltRestRatio>);

struct AngleWithoutMotion : Spring {
  static constexpr ConnectionTraits is{.uses_angle = true};
  template <class T>
  T turning_torque(const Twist<T>&) const {
    return T(0.0);
  }
};
static_assert(!ValidConnection<AngleWithoutMotion>);

struct MisspeltLoss : Spring {
  static constexpr ConnectionTraits is{.reports_loss = true};
  double loss_pwer(const Twist<double>&) const { return 0; }
};
static_assert(!ValidConnection<MisspeltLoss>);

struct ForgottenLoss : Spring {
  double loss_power(const Twist<double>&) const { return 0; }
};
static_assert(!ValidConnection<ForgottenLoss>);

struct Gap : Spring {
  static constexpr ConnectionTraits is{.guards = 2, .regularised_mode = 7};
  void guard(const Twist<double>&, double*) const {}
  int first_mode(const Twist<double>&) const { return 0; }
  int next_mode(const Twist<double>&, int) const { return 0; }
  std::string mode_name(int) const { return {}; }
};
static_assert(ValidConnection<Gap>);

struct ForgottenGuards : Gap {
  static constexpr ConnectionTraits is{};
};
static_assert(!ValidConnection<ForgottenGuards>);

struct MisspeltNextMode : Spring {
  static constexpr ConnectionTraits is{.guards = 2};
  void guard(const Twist<double>&, double*) const {}
  int first_mode(const Twist<double>&) const { return 0; }
  int next_mod(const Twist<double>&, int) const { return 0; }
  std::string mode_name(int) const { return {}; }
};
static_assert(!ValidConnection<MisspeltNextMode>);

struct RegularisedWithoutGuards : Spring {
  static constexpr ConnectionTraits is{.regularised_mode = 7};
};
static_assert(!ValidConnection<RegularisedWithoutGuards>);

struct Creep : SpringOfMotion {
  static constexpr ConnectionTraits is{.spring_takes_motion = true, .reports_loss = true, .states = 1};
  template <class T>
  void rates(const Twist<T>&, T*) const {}
  void first_states(const Twist<double>&, double*) const {}
  InternalState state(int) const { return {}; }
  double loss_power(const Twist<double>&) const { return 0; }
};
static_assert(ValidConnection<Creep>);

struct MisspeltFirstStates : SpringOfMotion {
  static constexpr ConnectionTraits is{.spring_takes_motion = true, .reports_loss = true, .states = 1};
  template <class T>
  void rates(const Twist<T>&, T*) const {}
  void first_state(const Twist<double>&, double*) const {}
  InternalState state(int) const { return {}; }
  double loss_power(const Twist<double>&) const { return 0; }
};
static_assert(!ValidConnection<MisspeltFirstStates>);

struct StatesWithoutLoss : Creep {
  static constexpr ConnectionTraits is{.spring_takes_motion = true, .states = 1};
};
static_assert(!ValidConnection<StatesWithoutLoss>);

struct MisspeltWords : Spring {
  static constexpr ConnectionTraits is{.described = true};
  std::string discribe() const { return {}; }
};
static_assert(!ValidConnection<MisspeltWords>);

struct ForgottenWords : Spring {
  std::string describe() const { return {}; }
};
static_assert(!ValidConnection<ForgottenWords>);

struct NoOtherForm : Spring {
  static constexpr ConnectionTraits is{.other_forms = true};
};
[[maybe_unused]] ConnectionForm undr(const NoOtherForm&, const Effects&) { return nullptr; }
static_assert(!ValidConnection<NoOtherForm>);

struct ForgottenForm : Spring {};
[[maybe_unused]] ConnectionForm under(const ForgottenForm&, const Effects&) { return nullptr; }
static_assert(!ValidConnection<ForgottenForm>);

struct MemberOfAShaftElement : Spring {
  bool opens_at_zero() const { return true; }
};
static_assert(!ValidConnection<MemberOfAShaftElement>);

// --- specifications ---
struct Settles {
  using Element = Spring;
  bool damping_hangs_on_inertia() const { return false; }
  Spring settled(double) const { return {}; }
};
struct MisspeltSettled {
  using Element = Spring;
  Spring setled(double) const { return {}; }
};
struct SpecifiedForm : Settles {
  static constexpr bool other_forms = true;
};
struct ForgottenSpecifiedForm : Settles {};
[[maybe_unused]] ConnectionForm under(const ForgottenSpecifiedForm&, const Effects&) { return nullptr; }
static_assert(ValidSpecification<Settles> && !ValidSpecification<MisspeltSettled>);
static_assert(!ValidSpecification<SpecifiedForm> && !ValidSpecification<ForgottenSpecifiedForm>);

// --- shaft elements ---
struct OnShaft {
  template <class T>
  T torque(const ShaftState<T>&) const {
    return T(0.0);
  }
};
struct Source : OnShaft {
  static constexpr ShaftTraits is{.account = Account::driving};
  bool uses_time() const { return false; }
  bool uses_speed() const { return false; }
  Rated rated() const { return {}; }
};
static_assert(ValidShaftElement<Source> && !ValidConnection<Source> && !ValidShaftElement<Spring>);

struct MisspeltRated : OnShaft {
  static constexpr ShaftTraits is{.account = Account::driving};
  bool uses_time() const { return false; }
  bool uses_speed() const { return false; }
  Rated ratd() const { return {}; }
};
static_assert(!ValidShaftElement<MisspeltRated>);

struct MisspeltUsesTime : OnShaft {
  static constexpr ShaftTraits is{.account = Account::driving};
  bool use_time() const { return false; }
  bool uses_speed() const { return false; }
  Rated rated() const { return {}; }
};
static_assert(!ValidShaftElement<MisspeltUsesTime>);

struct NoAccount : Source {
  static constexpr ShaftTraits is{};
  Account work_acount = Account::useful;
};
struct OwnAccount : Source {
  static constexpr ShaftTraits is{};
  Account work_account = Account::useful;
};
struct TwoAccounts : OwnAccount {
  static constexpr ShaftTraits is{.account = Account::driving};
};
static_assert(!ValidShaftElement<NoAccount> && ValidShaftElement<OwnAccount> && !ValidShaftElement<TwoAccounts>);

struct MisspeltHold : Source {
  static constexpr ShaftTraits is{.account = Account::harmful, .directional = true};
  Hold holds(const ShaftState<double>&) const { return {}; }
};
struct ForgottenDirection : Source {
  Hold hold(const ShaftState<double>&) const { return {}; }
};
static_assert(!ValidShaftElement<MisspeltHold> && !ValidShaftElement<ForgottenDirection>);

struct MisspeltOpening : Source {
  static constexpr ShaftTraits is{.account = Account::driving, .commanded = true};
  bool open_at_zero() const { return true; }
};
struct ReversibleByNobody : Source {
  static constexpr ShaftTraits is{.account = Account::driving, .reversible = true};
};
static_assert(!ValidShaftElement<MisspeltOpening> && !ValidShaftElement<ReversibleByNobody>);

struct MisspeltAnglePeriod : Source {
  static constexpr ShaftTraits is{.account = Account::driving, .uses_angle = true};
  double angle_perod() const { return 1; }
};
static_assert(!ValidShaftElement<MisspeltAnglePeriod>);

struct MisspeltEdge : Source {
  static constexpr ShaftTraits is{.account = Account::driving, .timed = true};
  double next_egde(double) const { return 1; }
  int mode_at(double) const { return 0; }
};
struct ForgottenTime : Source {
  double next_edge(double) const { return 1; }
  int mode_at(double) const { return 0; }
};
static_assert(!ValidShaftElement<MisspeltEdge> && !ValidShaftElement<ForgottenTime>);

struct MisspeltPeriod : Source {
  static constexpr ShaftTraits is{.account = Account::driving, .periodic = true};
  double period() const { return 1; }
};
struct MisspeltSettling : Source {
  static constexpr ShaftTraits is{.account = Account::driving, .settles = true};
  double settles_from() const { return 1; }
};
static_assert(!ValidShaftElement<MisspeltPeriod> && !ValidShaftElement<MisspeltSettling>);

struct Circuit : Source {
  static constexpr ShaftTraits is{.account = Account::driving, .states = 1, .stores = true, .feels_switching = true};
  template <class T>
  void rates(const ShaftState<T>&, T*) const {}
  void first_states(const ShaftState<double>&, double*) const {}
  InternalState state(int) const { return {}; }
  double stored(const double*) const { return 0; }
  double loss_power(const ShaftState<double>&) const { return 0; }
  void switched(const ShaftState<double>&, double*) const {}
};
struct ForgottenStore : Circuit {
  static constexpr ShaftTraits is{.account = Account::driving, .states = 1, .feels_switching = true};
};
struct ForgottenSwitch : Circuit {
  static constexpr ShaftTraits is{.account = Account::driving, .states = 1, .stores = true};
};
struct RatesOfDoublesAlone : Circuit {
  void rates(const ShaftState<double>&, double*) const {}
};
struct SwitchedWithAnotherForm : Circuit {
  void switched(double*) const {}
};
static_assert(ValidShaftElement<Circuit> && !ValidShaftElement<ForgottenStore> && !ValidShaftElement<ForgottenSwitch>);
static_assert(!ValidShaftElement<RatesOfDoublesAlone> && !ValidShaftElement<SwitchedWithAnotherForm>);

struct MisspeltStored : Source {
  static constexpr ShaftTraits is{.account = Account::driving, .states = 1, .stores = true};
  template <class T>
  void rates(const ShaftState<T>&, T*) const {}
  void first_states(const ShaftState<double>&, double*) const {}
  InternalState state(int) const { return {}; }
  double stord(const double*) const { return 0; }
  double loss_power(const ShaftState<double>&) const { return 0; }
};
static_assert(!ValidShaftElement<MisspeltStored>);

struct MisspeltModeName : Source {
  static constexpr ShaftTraits is{.account = Account::driving, .guards = 1};
  void guard(const ShaftState<double>&, double*) const {}
  int first_mode(const ShaftState<double>&) const { return 0; }
  int next_mode(const ShaftState<double>&, int) const { return 0; }
  std::string modename(int) const { return {}; }
};
static_assert(!ValidShaftElement<MisspeltModeName>);

struct CapacityOnAShaft : Source {
  double capacity() const { return 1; }
};
static_assert(!ValidShaftElement<CapacityOnAShaft>);

// --- loads on a mechanism's output ---
struct Pieces {
  static constexpr LoadTraits is{.in_pieces = true, .turns_back = true};
  template <class T>
  T value(const SliderState<T>&) const {
    return T(0.0);
  }
  bool uses_speed() const { return false; }
  void guard(const SliderState<double>&, double*) const {}
  int first_mode(const SliderState<double>&) const { return 0; }
  int next_mode(const SliderState<double>&, int) const { return 0; }
  std::string mode_name(const SliderState<double>&) const { return {}; }
  int turned_mode(const SliderState<double>&) const { return 0; }
};
struct ForgottenTurn : Pieces {
  static constexpr LoadTraits is{.in_pieces = true};
};
struct OpposesWithoutHold : Pieces {
  static constexpr LoadTraits is{.opposes = true, .in_pieces = true, .turns_back = true};
};
static_assert(SoundLoad<Pieces> && !SoundLoad<ForgottenTurn> && !SoundLoad<OpposesWithoutHold>);

TEST(ValidElements, AMisspeltMemberIsRefusedWhenItIsCompiled) {
  EXPECT_TRUE(ValidConnection<Clutch>);
  EXPECT_FALSE(ValidConnection<MisspeltCapacity>);
}

}  // namespace
}  // namespace kurbel::valid_elements_test
