// slider_loads.h — forces on a mechanism's output over its motion.
//
// Written for a slider; for a rocking output read angle [rad] for position and N·m for N.
// F is positive along +x, towards the extended end (maximum x; the folded end is the minimum). Tables and profiles are
// given over the distance d to the working end and are positive if they push the slider away from it; d = x_end − x at an
// extended working end, x − x_end at a folded one.
#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <variant>

#include "engine/elements/element.h"
#include "engine/elements/event_kind.h"
#include "engine/elements/piece_guard.h"
#include "engine/numerics/curve.h"
#include "engine/numerics/dual.h"
#include "mechanisms/loads/compressor_force.h"
#include "mechanisms/loads/load_traits.h"
#include "mechanisms/loads/plain_forces.h"
#include "mechanisms/loads/rounded_profile.h"
#include "mechanisms/loads/slider_state.h"

namespace kurbel {

// Relative to the stroke, a position so near to an edge counts as on it, so that rounding errors do not select the piece.
inline constexpr double on_edge = 1e-12;

// The piece after the direction of travel has changed. It is kept if it is valid to rounding error, so that an edge just
// passed is not passed again.
template <class Law>
int piece_kept(const Law& law, const SliderState<double>& s, int pieces) {
  if (s.mode < -1 || s.mode > pieces) return law.first_mode(s);
  const double d = law.end.distance(s.x), near = on_edge * law.stroke;
  const bool holds = d >= law.piece_begin(s) - near && d <= law.piece_end(s) + near;
  return holds ? s.mode : law.first_mode(s);
}

// Press force over travel: the nominal force within the last millimetres before the working end, only in the working
// stroke; then break-through. It never drives, and at standstill it holds against motion towards the end.
struct PressForce {
  static constexpr LoadTraits is{
      .opposes = true, .holds = true, .in_pieces = true, .turns_back = true, .kind = EventKind::load_edge};
  WorkingEnd end;
  Curve profile;  // piecewise linear over the distance to the working end; zero outside
  double stroke = 1;

  // nominal force F from d = travel on, reached within `rise`; drops to zero over `drop` from d = breakthrough on.
  static PressForce make(WorkingEnd end, double stroke, double force, double travel, double rise, double breakthrough,
                         double drop) {
    // From the end outwards; beyond the end the force is constant.
    const double inner = breakthrough > 0 ? breakthrough : -stroke, begin = breakthrough > 0 ? inner - drop : inner;
    return {end, Curve({begin, inner, travel - rise, travel}, {0, force, force, 0}, Curve::Form::linear), stroke};
  }

  template <class T>
  T value(const SliderState<T>& s) const {
    if (!end.approached(s.travel)) return T(0.0);
    return -static_cast<double>(end.side) * profile.value_in(s.mode, end.distance(s.x));
  }
  bool uses_speed() const { return false; }
  Hold hold(const SliderState<double>& s) const {
    // On an edge, the greater value of both sides: any force within the jump is possible.
    const double d = end.distance(s.x), near = on_edge * stroke;
    return end.hold(
        std::max(profile.value_in(profile.piece(d - near), d), profile.value_in(profile.piece(d + near), d)));
  }
  double piece_begin(const SliderState<double>& s) const { return profile.piece_begin(s.mode); }
  double piece_end(const SliderState<double>& s) const { return profile.piece_end(s.mode); }
  void guard(const SliderState<double>& s, double* g) const {
    g[0] = g[1] = 1;
    if (!end.approached(s.travel)) return;
    g[0] = std::min(1.0, (end.distance(s.x) - piece_begin(s)) / stroke);
    g[1] = std::min(1.0, (piece_end(s) - end.distance(s.x)) / stroke);
  }
  int first_mode(const SliderState<double>& s) const { return profile.piece(end.distance(s.x)); }
  int turned_mode(const SliderState<double>& s) const {
    return piece_kept(*this, s, static_cast<int>(profile.x().size()) - 1);
  }
  int next_mode(const SliderState<double>& s, int which) const { return PieceGuard::next(profile, s.mode, which); }
  std::string mode_name(const SliderState<double>& s) const {
    const double middle = 0.5 * (profile.piece_begin(s.mode) + profile.piece_end(s.mode));
    if (!std::isfinite(middle) || profile.value_in(s.mode, middle) == 0) return "load ends";
    return "load edge";
  }
};

// Force over travel by table, with a separate branch for the return stroke if given. At standstill the force is that of
// the return branch plus a static force up to the difference of the branches, like gas between closed valves: the actual
// force lies between the branches.
struct TravelForce {
  static constexpr LoadTraits is{.holds = true, .in_pieces = true, .turns_back = true};
  WorkingEnd end;
  Curve approach, retreat;  // over the distance to the working end; retreat may be empty
  double stroke = 1;

  const Curve& branch(int travel) const { return retreat.empty() || end.approached(travel) ? approach : retreat; }
  template <class T>
  T value(const SliderState<T>& s) const {
    return -static_cast<double>(end.side) * branch(s.travel).value_in(s.mode, end.distance(s.x));
  }
  bool uses_speed() const { return false; }
  Hold hold(const SliderState<double>& s) const {
    if (retreat.empty()) return {};
    const double d = end.distance(s.x);
    return end.hold_beyond(approach.value(d) - retreat.value(d));
  }
  void guard(const SliderState<double>& s, double* g) const {
    PieceGuard::guard(branch(s.travel), s.mode, end.distance(s.x), stroke, g);
  }
  int first_mode(const SliderState<double>& s) const { return branch(s.travel).piece(end.distance(s.x)); }
  double piece_begin(const SliderState<double>& s) const { return branch(s.travel).piece_begin(s.mode); }
  double piece_end(const SliderState<double>& s) const { return branch(s.travel).piece_end(s.mode); }
  int turned_mode(const SliderState<double>& s) const {
    return piece_kept(*this, s, static_cast<int>(branch(s.travel).x().size()) - 1);
  }
  int next_mode(const SliderState<double>& s, int which) const {
    return PieceGuard::next(branch(s.travel), s.mode, which);
  }
  std::string mode_name(const SliderState<double>&) const { return {}; }
};

// Force over the crank angle: indicator diagram of a two-stroke (period 360°) or four-stroke (720°) machine.
struct AngleForce {
  static constexpr LoadTraits is{.in_pieces = true};
  WorkingEnd end;
  Curve curve;  // periodic [rad] → [N]
  template <class T>
  T value(const SliderState<T>& s) const {
    return -static_cast<double>(end.side) * PieceGuard::value(curve, s.mode, s.phi);
  }
  bool uses_speed() const { return false; }
  void guard(const SliderState<double>& s, double* g) const {
    PieceGuard::guard(curve, s.mode, value_of(s.phi), 1.0, g);
  }
  int first_mode(const SliderState<double>& s) const { return PieceGuard::first(curve, s.phi); }
  int next_mode(const SliderState<double>& s, int which) const { return PieceGuard::next(curve, s.mode, which); }
  std::string mode_name(const SliderState<double>&) const { return {}; }
};

// One chamber of a cylinder by its pressure over travel: F = ∓A (p − p_out), away from the working end for A > 0. The
// chamber on the other side of the piston has A < 0; both are measured from the same end.
struct ChamberOverTravel : TravelForce {
  double area = 0, outside = 0;  // A [m²], p_out [Pa]

  template <class T>
  T value(const SliderState<T>& s) const {
    return area * (TravelForce::value(s) + static_cast<double>(end.side) * outside);
  }
  Hold hold(const SliderState<double>& s) const {
    if (retreat.empty()) return {};
    const double d = end.distance(s.x);
    return end.hold_beyond(area * (approach.value(d) - retreat.value(d)));
  }
};

// The same over the crank angle.
struct ChamberOverAngle : AngleForce {
  double area = 0, outside = 0;  // A [m²], p_out [Pa]

  template <class T>
  T value(const SliderState<T>& s) const {
    return area * (AngleForce::value(s) + static_cast<double>(end.side) * outside);
  }
};

// PressForce with rounded edges, for the effect load_edges off.
struct RoundedPressForce {
  static constexpr LoadTraits is{.opposes = true, .holds = true};
  WorkingEnd end;
  RoundedProfile profile;

  template <class T>
  T value(const SliderState<T>& s) const {
    if (!end.approached(s.travel)) return T(0.0);
    return -static_cast<double>(end.side) * profile.value(end.distance(s.x));
  }
  bool uses_speed() const { return false; }
  Hold hold(const SliderState<double>& s) const { return end.hold(profile.value(end.distance(s.x))); }
};

// TravelForce or AngleForce with rounded edges.
struct RoundedTableForce {
  static constexpr LoadTraits is{.holds = true};
  WorkingEnd end;
  RoundedProfile approach, retreat;  // retreat may be empty
  double period = 0;                 // > 0: over the crank angle

  template <class T>
  T value(const SliderState<T>& s) const {
    const RoundedProfile& branch = retreat.empty() || end.approached(s.travel) ? approach : retreat;
    return -static_cast<double>(end.side) * branch.value(period > 0 ? s.phi : end.distance(s.x));
  }
  bool uses_speed() const { return false; }
  Hold hold(const SliderState<double>& s) const {
    if (retreat.empty()) return {};
    return end.hold_beyond(approach.value(end.distance(s.x)) - retreat.value(end.distance(s.x)));
  }
};

struct SliderLoad {
  LoadLaws<ConstantForce, OpposingForce, MediumResistance, PressForce, TravelForce, AngleForce, CompressorForce,
           RoundedPressForce, RoundedTableForce, ChamberOverTravel, ChamberOverAngle, LinearMotorForce,
           SpringForce>::Any law;
  std::string name;  // "press.load"
  Account account = Account::useful;
  bool mirrored = false;  // its diagram is a default for a missing one (mirrored.h)
  double rounding = 0;    // half width of the rounding of edges, if they are rounded [m] or [rad]; 0: not given

  // Evaluates a question on the law.
  template <class Question>
  auto ask(const Question& question) const {
    return std::visit(question, law);
  }

  bool can_be_rounded() const;  // piecewise linear, with a given width
  SliderLoad rounded() const;

  bool depends_on_travel() const {  // on the sign of the slider's speed
    return ask([](const auto& l) {
      using L = std::decay_t<decltype(l)>;
      if constexpr (requires { l.retreat; }) return !l.retreat.empty();
      if constexpr (std::is_same_v<L, CompressorForce>) return true;
      return L::is.opposes;
    });
  }
  bool directional() const {
    return ask([](const auto& l) { return l.is.opposes; });
  }
  bool uses_speed() const {
    return ask([](const auto& l) { return l.uses_speed(); });
  }
  double period() const {
    if (const auto* over_angle = std::get_if<AngleForce>(&law)) return over_angle->curve.period();
    if (const auto* chamber = std::get_if<ChamberOverAngle>(&law)) return chamber->curve.period();
    const auto* rounded_table = std::get_if<RoundedTableForce>(&law);
    return rounded_table ? rounded_table->period : 0;
  }
  double greatest_force() const;

  template <class T>
  T value(const SliderState<T>& s) const {
    return ask([&](const auto& l) { return T(l.value(s)); });
  }
  Hold hold(const SliderState<double>& s) const {  // none where the law has none
    return ask([&](const auto& l) {
      if constexpr (std::decay_t<decltype(l)>::is.holds) return l.hold(s);
      return Hold{};
    });
  }

  // Events: each piece of a law lies between two guards; the mode is the active piece.
  bool has_pieces() const {
    return ask([](const auto& l) { return l.is.in_pieces; });
  }
  void guard(const SliderState<double>& s, double* g) const {  // both ends of the piece
    ask([&](const auto& l) {
      if constexpr (std::decay_t<decltype(l)>::is.in_pieces) l.guard(s, g);
    });
  }
  int next_piece(const SliderState<double>& s, int which) const {  // the piece beyond that end
    return ask([&](const auto& l) {
      if constexpr (std::decay_t<decltype(l)>::is.in_pieces) return l.next_mode(s, which);
      return s.mode;
    });
  }
  std::string piece_name(const SliderState<double>& s) const {  // for reports
    return ask([&](const auto& l) {
      if constexpr (std::decay_t<decltype(l)>::is.in_pieces) return l.mode_name(s);
      return std::string{};
    });
  }
  EventKind piece_kind() const {  // for programs
    return ask([](const auto& l) { return l.is.kind; });
  }
  void take_first_piece(const SliderState<double>& s, int& mode) const {  // at the present position
    ask([&](const auto& l) {
      if constexpr (std::decay_t<decltype(l)>::is.in_pieces) mode = l.first_mode(s);
    });
  }
  // Change of branch when the slider reverses within its stroke.
  bool follows_travel() const {
    return ask([](const auto& l) { return l.is.turns_back; });
  }
  void follow_travel(const SliderState<double>& s, int& mode) const {
    ask([&](const auto& l) {
      if constexpr (std::decay_t<decltype(l)>::is.turns_back) mode = l.turned_mode(s);
    });
  }
};

inline bool SliderLoad::can_be_rounded() const {
  if (!(rounding > 0)) return false;
  if (const auto* l = std::get_if<TravelForce>(&law)) return l->approach.form() == Curve::Form::linear;
  if (const auto* l = std::get_if<AngleForce>(&law)) return l->curve.form() == Curve::Form::linear;
  return std::holds_alternative<PressForce>(law);
}

inline SliderLoad SliderLoad::rounded() const {
  SliderLoad smooth = *this;
  if (!can_be_rounded()) return smooth;
  if (const auto* l = std::get_if<PressForce>(&law)) {
    smooth.law = RoundedPressForce{l->end, RoundedProfile(l->profile, rounding)};
  } else if (const auto* table = std::get_if<TravelForce>(&law)) {
    smooth.law =
        RoundedTableForce{table->end, RoundedProfile(table->approach, rounding),
                          table->retreat.empty() ? RoundedProfile() : RoundedProfile(table->retreat, rounding)};
  } else if (const auto* over_angle = std::get_if<AngleForce>(&law)) {
    smooth.law =
        RoundedTableForce{over_angle->end, RoundedProfile(over_angle->curve, rounding), {}, over_angle->curve.period()};
  }
  return smooth;
}

inline double SliderLoad::greatest_force() const {
  struct Greatest {
    double operator()(const ConstantForce& l) const { return std::abs(l.force); }
    double operator()(const OpposingForce& l) const { return l.force; }
    double operator()(const MediumResistance&) const { return 0; }
    double operator()(const PressForce& l) const { return l.profile.max_abs(); }
    double operator()(const TravelForce& l) const { return std::max(l.approach.max_abs(), l.retreat.max_abs()); }
    double operator()(const AngleForce& l) const { return l.curve.max_abs(); }
    double operator()(const CompressorForce& l) const { return l.greatest(); }
    double operator()(const RoundedPressForce& l) const { return l.profile.greatest(); }
    double operator()(const RoundedTableForce& l) const {
      return std::max(l.approach.greatest(), l.retreat.greatest());
    }
    static double of_chamber(double area, double outside, double pressure) {
      return std::abs(area) * std::max(pressure, outside);
    }
    double operator()(const ChamberOverTravel& l) const {
      return of_chamber(l.area, l.outside, std::max(l.approach.max_abs(), l.retreat.max_abs()));
    }
    double operator()(const ChamberOverAngle& l) const { return of_chamber(l.area, l.outside, l.curve.max_abs()); }
    double operator()(const LinearMotorForce& l) const { return l.force; }
    double operator()(const SpringForce& l) const { return l.greatest; }
  };
  return std::visit(Greatest{}, law);
}

}  // namespace kurbel
