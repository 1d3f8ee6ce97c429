// fields.h — a table of keys, each declared once together with its member.
//
//     Fields<Spring> spring_fields() {
//       return Fields<Spring>()
//           .add(required("stiffness", "N/m", positive, "k"), &Spring::k)
//           .add(quantity("damping", "N*s/m", any_number, "c; default: none"), &Spring::c)
//           .add(choice("seat", "flat", "of its ends"), &Spring::ground, {{"flat", true}, {"open", false}});
//     }
//     void build_spring(const Section& section, const Reading<Spring>& spring, Network& net);
//     kind_of<spring_fields, build_spring>(between_shafts, "spring", "a spring")
//
// The type of the member defines that of the key: double a quantity, int a whole number, bool a flag (or, as an enum,
// words), a string a text, vectors of numbers lists, CurveData a curve, a struct with its own fields nested tables. A
// std::optional member is empty if not given. The result is a D with its location (Reading): faults refer to members, not to
// keys. Fields are read in the order of the table, so that a default may use the members above it.
//
// A key declared twice, or a member filled twice, is a std::logic_error when the table is made, at program start.
#pragma once

#include <bit>
#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <type_traits>
#include <typeinfo>
#include <utility>
#include <vector>

#include "engine/scene/keys.h"
#include "engine/scene/messages.h"

namespace kurbel {

template <class D>
class Fields;
template <class T>
class Tables;

// Source of a table, and destination of its faults.
struct Place {
  const Section* section;
  Messages* messages;
  std::string what;                             // how faults name it: gearbox "g": stages[2]
  std::size_t before = messages->all().size();  // faults before it is read
};

// Words of a text with their values.
template <class V>
using Words = std::vector<std::pair<const char*, V>>;

// A factor from the value of the key to its member: ½ for half a length, 2π for a frequency.
struct Scaled {
  explicit Scaled(double by) : factor(by) {}
  double factor;
};

namespace fields_detail {

template <class T>
inline constexpr bool is_optional = false;
template <class T>
inline constexpr bool is_optional<std::optional<T>> = true;

// The type of the key that fills such a member.
template <class M>
constexpr KeyType type_of() {
  if constexpr (is_optional<M>)
    return type_of<typename M::value_type>();
  else if constexpr (std::is_same_v<M, double>)
    return KeyType::quantity;
  else if constexpr (std::is_same_v<M, int>)
    return KeyType::integer;
  else if constexpr (std::is_same_v<M, bool>)
    return KeyType::flag;
  else if constexpr (std::is_same_v<M, std::string>)
    return KeyType::text;
  else if constexpr (std::is_same_v<M, std::vector<double>>)
    return KeyType::quantities;
  else if constexpr (std::is_same_v<M, std::vector<int>>)
    return KeyType::integers;
  else if constexpr (std::is_same_v<M, CurveData>)
    return KeyType::curve;
  else if constexpr (std::is_same_v<M, std::span<const Section>>)
    return KeyType::sections;  // for a special reader
  else
    static_assert(!sizeof(M), "no key fills a member of this type: an enum needs its words, a struct its fields");
}

int whole(double number);
std::vector<int> wholes(const std::vector<double>& numbers);

template <class M>
void set(M& member, const Setting& setting) {
  if constexpr (is_optional<M>)
    set(member.emplace(), setting);
  else if constexpr (std::is_same_v<M, double>)
    member = setting.number;
  else if constexpr (std::is_same_v<M, int>)
    member = whole(setting.number);
  else if constexpr (std::is_same_v<M, bool>)
    member = setting.flag;
  else if constexpr (std::is_same_v<M, std::string>)
    member = setting.text;
  else if constexpr (std::is_same_v<M, std::vector<double>>)
    member = setting.numbers;
  else if constexpr (std::is_same_v<M, std::vector<int>>)
    member = wholes(setting.numbers);
  else if constexpr (std::is_same_v<M, CurveData>)
    member = setting.curve;
  else
    member = setting.sections;
}

// A type-erased member of a struct: its offset and its type.
struct Member {
  std::ptrdiff_t at;
  const std::type_info* type;

  // Compilers for Linux (Itanium C++ ABI) represent a pointer to a member by its distance from the struct's begin.
  template <class D, class M>
  static Member of(M D::*member) {
    static_assert(sizeof member == sizeof(std::ptrdiff_t));
    return {std::bit_cast<std::ptrdiff_t>(member), &typeid(M)};
  }
  bool operator==(const Member& other) const { return at == other.at && *type == *other.type; }
};
template <class M>
M& as(std::byte* place) {
  return *reinterpret_cast<M*>(place);
}
using Setter = std::function<void(std::byte* member, const Setting&)>;
using Reader = std::function<void(std::byte* data, const Place&)>;

template <class M>
void set_member(std::byte* member, const Setting& setting) {
  set(as<M>(member), setting);
}

// The table without the type of its struct, so that its code is not repeated for some hundred structs. Copies share it
// until one is changed: a function that returns a chain of calls copies its result.
class FieldTable {
 public:
  FieldTable();
  FieldTable(const FieldTable& other);
  ~FieldTable();
  // Throw std::logic_error if a key or member is already in the table.
  void enter(Key key, Member member, Setter set);
  void enter(std::vector<Key>&& keys, Member member, Reader read);
  // A rule in the order of the table: default of a member, or a member derived from others.
  void enter(Reader rule);
  void check(void (*rule)());  // void (*)(const Reading<D>&)
  void read(std::byte* data, const Place& place) const;
  // Names of the keys of a member; throws std::logic_error if there are none.
  const std::vector<std::string>& names_of(Member member) const;
  const std::string& key_of(Member member, const Section& section) const;
  const std::vector<Key>& keys() const;
  std::vector<Key> take_keys();
  const std::vector<void (*)()>& rules() const;

 private:
  struct Rows;
  Rows& own();
  std::shared_ptr<Rows> rows_;
};

template <class V>
Setter by_words(const Words<V>& words) {
  return [words](std::byte* member, const Setting& s) {
    for (const auto& [word, value] : words)
      if (s.text == word) as<V>(member) = value;
  };
}
// The given key of several; null: none. A message if several are given.
const Key* one_given(const std::vector<Key>& keys, const Place& place);
template <class Form>
Reader by_forms(std::ptrdiff_t member, std::ptrdiff_t form, std::vector<Key> keys, std::vector<Form> forms) {
  return [=](std::byte* data, const Place& place) {
    const Key* const given = one_given(keys, place);
    if (!given) return;
    as<Form>(data + form) = forms[static_cast<std::size_t>(given - keys.data())];
    as<double>(data + member) = place.section->number(given->name);
  };
}
Reader nested(Key key, bool list, bool numbered, bool named, Reader put);

template <class M, class T>
concept holds = std::is_same_v<M, T> || std::is_same_v<M, std::vector<T>> || std::is_same_v<M, std::optional<T>>;

// `kind "name"`
std::string who(const Section& section);
bool refuse(const Place& place, Location at, const std::string& text);
void both_given(const Place& place, const std::string& first, const std::string& second, const std::string& at);
void belongs_to(const Place& place, const std::string& key, const std::string& owner);
[[noreturn]] void not_filled();

}  // namespace fields_detail

// The data of a section as a D, with its location.
template <class D>
class Reading : public D {
 public:
  Reading(D data, const Fields<D>& fields, Place place)
      : D(std::move(data)), fields_(&fields), place_(std::move(place)) {}

  const Section& section() const { return *place_.section; }
  Messages& messages() const { return *place_.messages; }
  const std::string& what() const { return place_.what; }
  bool valid() const { return place_.messages->all().size() == place_.before; }  // no fault since its reading began

  // The name of the key of a member; for a group the first given one.
  template <class M, class B>
  const std::string& key(M B::*member) const {
    return fields_->key_of(member, *place_.section);
  }
  // Whether it is in the file; for a group: any of its keys.
  template <class M, class B>
  bool given(M B::*member) const {
    return place_.section->given(key(member));
  }
  // The keys of a group that are in the file.
  template <class M, class B>
  std::vector<std::string> given_keys(M B::*group) const {
    std::vector<std::string> names;
    for (const std::string& name : fields_->names_of(group))
      if (place_.section->given(name)) names.push_back(name);
    return names;
  }
  template <class M, class B>
  Location where(M B::*member) const {
    return place_.section->where(key(member));
  }

  // Adds a fault at the location of the member or the table; returns false, for `return refuse(…)`.
  template <class M, class B>
  bool refuse(M B::*member, const std::string& text) const {
    return fields_detail::refuse(place_, where(member), text);
  }
  bool refuse(const std::string& key, const std::string& text) const {  // one of given_keys
    return fields_detail::refuse(place_, place_.section->where(key), text);
  }
  bool refuse(const std::string& text) const { return fields_detail::refuse(place_, place_.section->at, text); }
  // At most one of two equivalent members may be given; the fault is at the second.
  template <class M, class N, class B, class C>
  bool keep_one(M B::*first, N C::*second) const {
    if (!given(first) || !given(second)) return true;
    fields_detail::both_given(place_, key(first), key(second), key(second));
    return false;
  }
  // Faults for given members whose owner is not given, as they have no meaning then.
  template <class O, class B, class... M>
  bool drop_without(O B::*owner, M B::*... members) const {
    if (given(owner)) return true;
    bool none = true;
    const auto drop = [&](auto member) {
      if (!given(member)) return;
      none = false;
      fields_detail::belongs_to(place_, key(member), key(owner));
    };
    (drop(members), ...);
    return none;
  }

 private:
  const Fields<D>* fields_;
  Place place_;
};

template <class D>
class Fields {
 public:
  // A key and its member, of D or a base of it. Without a value of the key the member keeps its initial value.
  template <class M, class B>
  Fields& add(Key key, M B::*member) {
    key.type = fields_detail::type_of<M>();
    return enter(std::move(key), member, fields_detail::set_member<M>);
  }
  // The same with a default from the members above: another member, or a function of the data.
  template <class M, class B, class Default>
  requires std::is_invocable_v<Default, const D&> Fields& add(Key key, M B::*member, Default otherwise) {
    start(member, std::move(otherwise));
    return add(std::move(key), member);
  }
  template <class B>
  Fields& add(Key key, double B::*member, Scaled scale) {
    return enter(std::move(key), member,
                 [scale](std::byte* to, const Setting& s) { fields_detail::as<double>(to) = scale.factor * s.number; });
  }
  template <class V, class B>
  Fields& add(Key key, V B::*member, const Words<std::type_identity_t<V>>& words) {
    key.type = KeyType::text;
    for (const auto& word : words) key.choices.emplace_back(word.first);
    return enter(std::move(key), member, fields_detail::by_words(words));
  }
  // Keys of a member struct, with the default `otherwise` if given.
  template <class G, class M, class B>
  requires std::is_base_of_v<M, G> Fields& add(const Fields<G>& group, M B::*member) {
    return enter(group.keys(), member, group.template filling<M>(place_of(member).at));
  }
  template <class G, class M, class B, class Default>
  requires std::is_base_of_v<M, G> && std::is_invocable_v<Default, const D&> Fields& add(const Fields<G>& group,
                                                                                         M B::*member,
                                                                                         Default otherwise) {
    start(member, std::move(otherwise));
    return add(group, member);
  }
  // Nested tables: a list, an optional table, or one table.
  template <class M, class T, class B>
  requires fields_detail::holds<M, T> Fields& add(Key key, M B::*member, const Tables<T>& tables) {
    return enter(tables.owned(key), member, tables.template into<M>(key, place_of(member).at));
  }
  // One number that may be given in one of several forms; `as` stores the form.
  template <class Form>
  Fields& add_forms(double D::*member, Form D::*as,
                    const std::vector<std::pair<Key, std::type_identity_t<Form>>>& forms) {
    std::vector<Key> keys;
    std::vector<Form> stands_for;
    for (const auto& [key, form] : forms) keys.push_back(key), stands_for.push_back(form);
    return enter(keys, member, fields_detail::by_forms(place_of(member).at, place_of(as).at, keys, stands_for));
  }
  // A rule for members derived from those above.
  Fields& derive(void (*rule)(D&)) {
    table_.enter([rule](std::byte* data, const Place&) { rule(fields_detail::as<D>(data)); });
    return *this;
  }
  // A check of all members together; faults by Reading::refuse.
  Fields& check(void (*rule)(const Reading<D>&)) {
    table_.check(reinterpret_cast<void (*)()>(rule));
    return *this;
  }

  const std::vector<Key>& keys() const& { return table_.keys(); }
  std::vector<Key> keys() && { return table_.take_keys(); }  // of a temporary

  // Reads a valid section; faults go into the messages, with the section's kind and name unless `what` is given.
  Reading<D> read(const Section& section, Messages& messages, std::string what = "") const {
    return read_at({&section, &messages, what.empty() ? fields_detail::who(section) : std::move(what)});
  }
  Reading<D> read_at(const Place& place, D data = {}) const {
    table_.read(reinterpret_cast<std::byte*>(&data), place);
    const Reading<D> reading(std::move(data), *this, place);
    for (void (*const rule)() : table_.rules()) reinterpret_cast<void (*)(const Reading<D>&)>(rule)(reading);
    return reading;
  }

  // Names of the keys of a member; throws std::logic_error if there are none.
  template <class M, class B>
  const std::vector<std::string>& names_of(M B::*member) const {
    return table_.names_of(place_of(member));
  }
  template <class M, class B>
  const std::string& key_of(M B::*member, const Section& section) const {
    return table_.key_of(place_of(member), section);
  }
  // Reader of a member M of another struct; M is a base of D.
  template <class M>
  fields_detail::Reader filling(std::ptrdiff_t at) const {
    return [group = *this, at](std::byte* data, const Place& place) {
      M& member = fields_detail::as<M>(data + at);
      D start;
      static_cast<M&>(start) = std::move(member);
      member = group.read_at(place, std::move(start));
    };
  }

 private:
  template <class M, class B>
  static fields_detail::Member place_of(M B::*member) {
    return fields_detail::Member::of<D, M>(member);
  }
  template <class KeyOrKeys, class M, class B, class Act>
  Fields& enter(KeyOrKeys keys, M B::*member, Act act) {
    table_.enter(std::move(keys), place_of(member), std::move(act));
    return *this;
  }
  template <class M, class B, class Default>
  void start(M B::*member, Default otherwise) {
    table_.enter([=](std::byte* data, const Place&) {
      D& all = fields_detail::as<D>(data);
      all.*member = std::invoke(otherwise, std::as_const(all));
    });
  }

  fields_detail::FieldTable table_;
};

// Tables of one or several kinds nested in another. T: the data after reading, a Reading of them, or a variant of these.
template <class T>
class Tables {
 public:
  bool numbered = false;  // faults name a table by its index in the list: stages[2]
  bool named = false;     // names by the user: points.A; of one kind, whose first key may replace the table

  template <class G>
  requires std::is_constructible_v<T, Reading<G>> Tables& add(std::string name, KeyDoc doc, const Fields<G>& fields,
                                                              G start = {}) {
    kinds_.push_back(
        {.name = std::move(name), .doc = std::move(doc), .placement = Placement::nested, .keys = fields.keys()});
    readers_.push_back([fields, start](const Place& place) { return T(fields.read_at(place, start)); });
    return *this;
  }

  const std::vector<Kind>& kinds() const { return kinds_; }
  // The key of these tables.
  std::vector<Key> owned(Key& key) const {
    key.type = named ? KeyType::named : KeyType::sections;
    key.nested = &kinds_;
    return {key};
  }
  // Reader into a member of another struct. The tables must outlive the reader.
  template <class M>
  fields_detail::Reader into(const Key& key, std::ptrdiff_t at) const {
    constexpr bool list = std::is_same_v<M, std::vector<T>>;
    return fields_detail::nested(key, list, numbered, named, [this, at](std::byte* data, const Place& place) {
      M& member = fields_detail::as<M>(data + at);
      if constexpr (list)
        member.push_back(read_at(place));
      else
        member = read_at(place);
    });
  }
  T read_at(const Place& place) const {
    for (std::size_t i = 0; i < kinds_.size(); ++i)
      if (kinds_[i].name == place.section->kind->name) return readers_[i](place);
    fields_detail::not_filled();
  }

 private:
  std::vector<Kind> kinds_;
  std::vector<std::function<T(const Place&)>> readers_;
};

// The fields that a function makes, made once: a Reading refers to them.
template <auto fields>
const auto& made_once() {
  static const auto made = fields();
  return made;
}
// A kind of components by the function that makes its fields, and the one that builds from what they read.
template <auto fields, auto build>
Kind kind_of(decltype(on_a_shaft)* placed, std::string name, KeyDoc doc) {
  return placed(std::move(name), std::move(doc), made_once<fields>().keys(),
                [](const Section& section, Network& net, Messages& messages) {
                  build(section, made_once<fields>().read(section, messages), net);
                });
}

}  // namespace kurbel
