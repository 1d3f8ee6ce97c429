// mechanism_data.h — the data of a mechanism of any kind, as a value.
//
// A linkage is a struct D of lengths and masses (mechanisms/linkages); these functions stand beside it and are all that
// is ever asked of it. D becomes a MechanismData by itself.
//     std::vector<double> values_of(const D&);                  all of them: who is equal has the same tables
//     std::unique_ptr<MechanismBodies> make_bodies(const D&);   its Simbody model; throws std::invalid_argument
//     ClosedForm closed_form(const D&, long double phi);        its loops in closed form (closed_forms.h)
//     PlanarLinkage linkage_of(const D&, long double phi);      its bodies and joints, with their series in φ
//     LinkageDrawing drawing_of(const D&);                      how it is drawn, and whether its output rocks
//     double D::gravity                                         [m/s²]
// and, of one whose crank may be unable to turn,
//     std::optional<CrankArc> arc_of(const D&);                 within which angles it rocks
//     std::string locks_of(const D&);                           what happens at their ends, in words
// and, of one that is described link by link,
//     std::vector<std::string> words_about(const D&);           its structure, its transmission angles
//     std::string undetermined_reactions(const D&);             why reactions have no values; empty: they have
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <typeindex>
#include <utility>
#include <vector>

#include "mechanisms/reduced/closed_forms.h"

namespace kurbel {

// What runs an exported component (library/fmi) holds no Simbody: tables come with the component's data.
#ifdef KURBEL_FMI_RUNTIME
inline constexpr bool has_bodies = false;
#else
inline constexpr bool has_bodies = true;
#endif

class MechanismData {
 public:
  template <class D>
  requires requires(const D& data) { drawing_of(data); }
  MechanismData(D data) : rocks_(drawing_of(data).rocks), held_(std::make_shared<const Of<D>>(std::move(data))) {}

  // Null where it is of another kind.
  template <class D>
  const D* as() const {
    return kind() == typeid(D) ? &static_cast<const Of<D>&>(*held_).data : nullptr;
  }
  std::type_index kind() const { return held_->kind(); }
  std::vector<double> values() const { return held_->values(); }
  std::unique_ptr<MechanismBodies> make_bodies() const { return held_->bodies(); }  // null without Simbody
  ClosedForm closed_form(long double phi) const { return held_->closed(phi); }
  PlanarLinkage linkage(long double phi) const { return held_->linkage(phi); }
  LinkageDrawing drawing() const { return held_->drawing(); }
  bool rocks() const { return rocks_; }  // the output is an angle
  double gravity() const { return held_->gravity(); }
  std::optional<CrankArc> arc() const { return held_->arc(); }  // empty: the crank turns
  std::string locks() const { return held_->locks(); }          // empty: as the named mechanisms do
  std::vector<std::string> about() const { return held_->about(); }
  std::string undetermined() const { return held_->undetermined(); }

 private:
  struct Held {
    virtual ~Held() = default;
    virtual std::type_index kind() const = 0;
    virtual std::vector<double> values() const = 0;
    virtual std::unique_ptr<MechanismBodies> bodies() const = 0;
    virtual ClosedForm closed(long double phi) const = 0;
    virtual PlanarLinkage linkage(long double phi) const = 0;
    virtual LinkageDrawing drawing() const = 0;
    virtual double gravity() const = 0;
    virtual std::optional<CrankArc> arc() const = 0;
    virtual std::string locks() const = 0;
    virtual std::vector<std::string> about() const = 0;
    virtual std::string undetermined() const = 0;
  };
  template <class D>
  struct Of final : Held {
    D data;
    explicit Of(D given) : data(std::move(given)) {}
    std::type_index kind() const override { return typeid(D); }
    std::vector<double> values() const override { return values_of(data); }
    std::unique_ptr<MechanismBodies> bodies() const override {
      if constexpr (has_bodies)
        return kurbel::make_bodies(data);
      else
        return nullptr;
    }
    ClosedForm closed(long double phi) const override { return kurbel::closed_form(data, phi); }
    PlanarLinkage linkage(long double phi) const override { return linkage_of(data, phi); }
    LinkageDrawing drawing() const override { return drawing_of(data); }
    double gravity() const override { return data.gravity; }
    std::optional<CrankArc> arc() const override {
      if constexpr (requires { arc_of(data); })
        return arc_of(data);
      else
        return {};
    }
    std::string locks() const override {
      if constexpr (requires { locks_of(data); })
        return locks_of(data);
      else
        return {};
    }
    std::vector<std::string> about() const override {
      if constexpr (requires { words_about(data); })
        return words_about(data);
      else
        return {};
    }
    std::string undetermined() const override {
      if constexpr (requires { undetermined_reactions(data); })
        return undetermined_reactions(data);
      else
        return {};
    }
  };

  bool rocks_;
  std::shared_ptr<const Held> held_;
};

// Rounded to double; costs 1 … 3 µs. The branch is right by construction: closure_determinant is 1.
ReducedSample closed_sample(const MechanismData& data, double phi);

}  // namespace kurbel
