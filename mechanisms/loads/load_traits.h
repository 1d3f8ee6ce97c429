// load_traits.h — traits of a load on a mechanism's output, and the check of its members against them.
#pragma once

#include <concepts>
#include <string>
#include <variant>

#include "engine/elements/element.h"
#include "engine/elements/event_kind.h"
#include "engine/elements/valid.h"
#include "engine/numerics/dual.h"
#include "mechanisms/loads/slider_state.h"

namespace kurbel {

// Traits and the members required by each; s: the local motion.
//   template <class T> T value(const SliderState<T>&) const;   every load: F [N]
//   bool uses_speed() const;                                   whether F depends on v
//   .holds, always with .opposes       Hold hold(s) const: range of forces at standstill [N]
//   .in_pieces                         void guard(s, double* g) const: both ends of the piece given by the mode;
//                                      int first_mode(s), int next_mode(s, int which), std::string mode_name(s) const
//   .turns_back                        int turned_mode(s) const: the piece after the direction of travel has changed
struct LoadTraits {
  bool opposes = false;  // changes its sign with the direction of travel
  bool holds = false;
  bool in_pieces = false;
  bool turns_back = false;
  EventKind kind = EventKind::law;  // of the event that ends a piece
};

// Whether it has exactly the members required by its traits (sound.h).
namespace valid {
template <class L>
concept Value = requires(const L& l, const SliderState<double>& s, const SliderState<Dual<1>>& dual) {
  { l.value(s) } -> std::same_as<double>;
  { l.value(dual) } -> std::same_as<Dual<1>>;
  { l.uses_speed() } -> std::same_as<bool>;
};
template <class L>
concept Holds = (L::is.holds &&
                 requires(const L& l, const SliderState<double>& s) {
                   { l.hold(s) } -> std::same_as<Hold>;
                 }) ||
                (!L::is.holds && !L::is.opposes && requires { &Free<L>::hold; });
template <class L>
concept InPieces = (L::is.in_pieces &&
                    requires(const L& l, const SliderState<double>& s, double* g) {
                      { l.guard(s, g) } -> std::same_as<void>;
                      { l.first_mode(s) } -> std::same_as<int>;
                      { l.next_mode(s, 0) } -> std::same_as<int>;
                      { l.mode_name(s) } -> std::same_as<std::string>;
                    }) ||
                   (!L::is.in_pieces && requires {
                     &Free<L>::guard;
                     &Free<L>::first_mode;
                     &Free<L>::next_mode;
                     &Free<L>::mode_name;
                   });
template <class L>
concept TurnsBack = (L::is.turns_back && L::is.in_pieces &&
                     requires(const L& l, const SliderState<double>& s) {
                       { l.turned_mode(s) } -> std::same_as<int>;
                     }) ||
                    (!L::is.turns_back && requires { &Free<L>::turned_mode; });
}  // namespace valid
template <class L>
concept SoundLoad = valid::Value<L> && valid::Holds<L> && valid::InPieces<L> && valid::TurnsBack<L>;

template <class... L>
struct LoadLaws {
  static_assert(
      (SoundLoad<L> && ...),
      "a load has value(s) and uses_speed(); with .holds (always with .opposes) Hold hold(s); with .in_pieces "
      "guard(s, double*), first_mode(s), next_mode(s, int) and mode_name(s); with .turns_back, of a law in "
      "pieces, int turned_mode(s); and none of them without its trait");
  using Any = std::variant<L...>;
};

}  // namespace kurbel
