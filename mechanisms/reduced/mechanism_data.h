// mechanism_data.h — the description of a mechanism of any kind, as a value.
//
// A kind of mechanism is a struct D of lengths and masses, with the following functions. D converts implicitly to
// MechanismData.
//     std::vector<double> values_of(const D&);                  all values: equal ones share their tables
//     PlanarLinkage linkage_of(const D&, long double phi);      its bodies and joints, with their series in φ
//     LinkageDrawing drawing_of(const D&);                      its drawing, and the type of its output
//     double D::gravity                                         [m/s²]
// where there is something to say,
//     DataFaults faults_of(const D&);                           what is wrong with it
//     std::vector<PlanePoint> places_of(const D&, double phi);  by which it is drawn, of a drawing that names no joints
//     std::optional<CrankArc> arc_of(const D&);                 within which angles its crank rocks
//     std::string locks_of(const D&);                           what happens at their ends, in words
//     int turns_of(const D&);                                   of the crank until the links come back without change points
//     double drawn_at(const D&);                                φ of a position in which its lengths are exact
//     std::optional<long double> stands_at(const D&);           where its output stands still but for rounding
//     std::string undetermined_reactions(const D&);             why reactions are undetermined; empty: they are not
// and, if its joints are unknown or its output is not on one of its bodies, instead of the general Simbody model
//     std::unique_ptr<MechanismBodies> own_bodies(const D&);
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <typeindex>
#include <utility>
#include <vector>

#include "mechanisms/bodies/mechanism_tree.h"
#include "mechanisms/bodies/sketched_linkage.h"
#include "mechanisms/linkages/four_bar.h"
#include "mechanisms/linkages/knuckle_press.h"
#include "mechanisms/linkages/quick_return.h"
#include "mechanisms/linkages/slider_crank.h"
#include "mechanisms/linkages/slotted_lever.h"

namespace kurbel {

// The run-time of exported components (library/fmi) contains no Simbody: tables are in the component's data.
#ifdef KURBEL_FMI_RUNTIME
inline constexpr bool has_bodies = false;
#else
inline constexpr bool has_bodies = true;
#endif

class MechanismData {
 public:
  template <class D>
  requires requires(const D& data) { drawing_of(data); }
  MechanismData(D given) : data_(std::make_shared<const D>(std::move(given))) {
    const D* const d = static_cast<const D*>(data_.get());  // valid as long as data_
    Held held(typeid(D));
    held.values = values_of(*d);
    held.drawing = drawing_of(*d);
    held.gravity = d->gravity;
    held.linkage = [d](long double phi) { return linkage_of(*d, phi); };
    if constexpr (has_bodies && requires { stands_at(*d); })
      if (const auto x = stands_at(*d)) held.linkage = standing(std::move(held.linkage), *x);
    if constexpr (requires { faults_of(*d); }) held.faults = [d] { return faults_of(*d); };
    if constexpr (requires { places_of(*d, 0.0); }) held.places = [d](double phi) { return places_of(*d, phi); };
    if constexpr (has_bodies && requires { own_bodies(*d); }) held.own_bodies = [d] { return own_bodies(*d); };
    if constexpr (requires { arc_of(*d); }) held.arc = arc_of(*d);
    if constexpr (requires { locks_of(*d); }) held.locks = locks_of(*d);
    if constexpr (requires { turns_of(*d); }) held.turns = turns_of(*d);
    if constexpr (requires { drawn_at(*d); }) held.drawn_at = drawn_at(*d);
    if constexpr (requires { undetermined_reactions(*d); }) held.undetermined = undetermined_reactions(*d);
    held_ = std::make_shared<const Held>(std::move(held));
  }

  // Null if it is of another kind.
  template <class D>
  const D* as() const {
    return kind() == typeid(D) ? static_cast<const D*>(data_.get()) : nullptr;
  }
  std::type_index kind() const { return held_->kind; }
  // A force along a travel within a linkage, not a mechanism.
  bool is_travel() const { return kind() == typeid(LinkageTravelData); }
  const std::vector<double>& values() const { return held_->values; }
  PlanarLinkage linkage(long double phi) const { return held_->linkage(phi); }
  ClosedForm closed_form(long double phi) const { return closed_form_of(linkage(phi)); }
  const LinkageDrawing& drawing() const { return held_->drawing; }
  std::vector<PlanePoint> places(double phi) const;    // of the drawing
  bool rocks() const { return held_->drawing.rocks; }  // the output is an angle
  double gravity() const { return held_->gravity; }
  const std::optional<CrankArc>& arc() const { return held_->arc; }  // empty: the crank turns
  const std::string& locks() const { return held_->locks; }          // empty: the text of the named mechanisms
  const std::string& undetermined() const { return held_->undetermined; }

  bool joints_are_known() const { return !held_->own_bodies; }
  // Input of the Simbody model. Throws std::invalid_argument with the first fault of the data.
  BodiesOf bodies_of() const;
  // Throws as bodies_of; null without Simbody.
  std::unique_ptr<MechanismBodies> make_bodies() const;

 private:
  using LinkageAt = std::function<PlanarLinkage(long double)>;
  static LinkageAt standing(LinkageAt moving, long double x);
  struct Held {
    explicit Held(std::type_index of) : kind(of) {}
    std::type_index kind;
    std::vector<double> values;
    LinkageDrawing drawing;
    double gravity = 0;
    LinkageAt linkage;
    std::function<DataFaults()> faults;
    std::function<std::vector<PlanePoint>(double)> places;
    std::function<std::unique_ptr<MechanismBodies>()> own_bodies;
    std::optional<CrankArc> arc;
    std::string locks, undetermined;
    int turns = 1;
    std::optional<double> drawn_at;
  };

  std::shared_ptr<const void> data_;
  std::shared_ptr<const Held> held_;
};

inline std::unique_ptr<MechanismBodies> make_bodies(const MechanismData& data) { return data.make_bodies(); }

// Takes 1 … 3 µs.
ReducedSample closed_sample(const MechanismData& data, double phi);
// closure_determinant is 1: the branch is right by construction.
ReducedSample rounded(const ClosedForm& form);

}  // namespace kurbel
