// fields.h — a table of keys in which each key stands once, together with the member that it fills.
//
//     const Fields<Spring>& spring_fields() {
//       static const auto made =
//           Fields<Spring>()
//               .add(required("stiffness", "N/m", positive, "k"), &Spring::k)
//               .add(quantity("damping", "N*s/m", any_number, "c; default: none"), &Spring::c)
//               .add(choice("seat", "flat", "of its ends"), &Spring::ground,
//                    {{"flat", true}, {"open", false}})
//               .add(quantity("preload", "N", any_number, "default: by the stiffness"), &Spring::preload,
//                    [](const Spring& s) { return 1e-3 * s.k; });
//       return made;
//     }
//     .keys = spring_fields().keys()                          for reader, schema, docs and --set
//     const auto spring = spring_fields().read(section, messages);   for the build function
//
// The member's type is the key's: double a quantity, int a whole number, bool a flag (or, as an enum, words), a string a
// text, vectors of numbers lists, CurveData a curve, nested tables a struct with its own fields. A std::optional member
// says whether it was given. What is read is a D that knows its place (Reading): a fault names the member, not the key.
// Fields are read in the order of the table, so that a default sees what stands above it.
//
// Why so: a member pointer is checked by the compiler, is the shortest name of "this parameter" and needs no macro; a
// table by values (not by traits of the struct) lets several kinds fill one physical struct by keys of different names,
// docs and domains, which a link of a mechanism and the two sides of a gear need. A key declared twice, or a member
// filled twice, is a std::logic_error when the table is made, which is when the program starts.
#pragma once

#include <any>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "engine/scene/keys.h"
#include "engine/scene/messages.h"

namespace kurbel {

template <class D>
class Fields;
template <class T>
class Tables;

// Where a table is read, and where its faults go.
struct Place {
  const Section* section;
  Messages* messages;
  std::string what;  // how faults name it: gearbox "g": stages[2]
};

// Words of a text, each with the value that it stands for.
template <class V>
using Words = std::vector<std::pair<const char*, V>>;

// A factor between the key's value and its member's: half a length, 2π of a frequency.
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
    return KeyType::sections;  // for a reader of its own
  else
    static_assert(!sizeof(M), "no key fills a member of this type: an enum needs its words, a struct its fields");
}

// The ints next to them.
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

// Its value in the section, or null; throws std::logic_error where a required one is missing.
const Setting* found(const Key& key, const Section& section);
// Throws std::logic_error if the table has a key of this name.
void check_new(const std::vector<Key>& keys, const Key& key);
[[noreturn]] void filled_twice(const std::string& key);
[[noreturn]] void not_filled();
// `kind "name"`
std::string who(const Section& section);
void both_given(const Place& place, const std::string& first, const std::string& second, const std::string& at);
void belongs_to(const Place& place, const std::string& key, const std::string& owner);
// False, with a message, where a list stands in place of one table.
bool is_one_table(const Place& place, const std::string& key, std::size_t tables);

}  // namespace fields_detail

// What a section gives, as a D that knows where it was read.
template <class D>
class Reading : public D {
 public:
  Reading(D data, const Fields<D>& fields, Place place)
      : D(std::move(data)), fields_(&fields), place_(std::move(place)) {}

  const Section& section() const { return *place_.section; }
  Messages& messages() const { return *place_.messages; }
  const std::string& what() const { return place_.what; }

  // The name of the member's key; of a group the first given one's.
  template <class M, class B>
  std::string key(M B::*member) const;
  // Stands in the file; of a group: any of its keys.
  template <class M, class B>
  bool given(M B::*member) const {
    return place_.section->given(key(member));
  }
  // The keys of a group that stand in the file.
  template <class M, class B>
  std::vector<std::string> given_keys(M B::*group) const;
  template <class M, class B>
  Location where(M B::*member) const {
    return place_.section->where(key(member));
  }

  // A fault, at the member's place or at the table's; false, for `return refuse(…)`.
  template <class M, class B>
  bool refuse(M B::*member, const std::string& text) const {
    place_.messages->add(where(member), place_.what + ": " + text);
    return false;
  }
  bool refuse(const std::string& key, const std::string& text) const {  // one of given_keys
    place_.messages->add(place_.section->where(key), place_.what + ": " + text);
    return false;
  }
  bool refuse(const std::string& text) const {
    place_.messages->add(place_.section->at, place_.what + ": " + text);
    return false;
  }
  // Of two that say the same at most one may be given; the fault stands at the second.
  template <class M, class N, class B, class C>
  bool keep_one(M B::*first, N C::*second) const {
    if (!given(first) || !given(second)) return true;
    fields_detail::both_given(place_, key(first), key(second), key(second));
    return false;
  }
  // Those that are given mean nothing, for their owner is not.
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
  // A key and its member, of D or a base of it. Where the key has no value, the member keeps its initial one.
  template <class M, class B>
  Fields& add(Key key, M B::*member) {
    key.type = fields_detail::type_of<M>();
    return enter(std::move(key), member, [member](D& data, const Setting& s) { fields_detail::set(data.*member, s); });
  }
  // The same with a default by what was read above: another member, or a function of the data.
  template <class M, class B, class Default>
  requires std::is_invocable_v<Default, const D&> Fields& add(Key key, M B::*member, Default otherwise) {
    start(member, std::move(otherwise));
    return add(std::move(key), member);
  }
  template <class B>
  Fields& add(Key key, double B::*member, Scaled scale) {
    return enter(std::move(key), member,
                 [member, scale](D& data, const Setting& s) { data.*member = scale.factor * s.number; });
  }
  // Words that stand for values.
  template <class V, class B>
  Fields& add(Key key, V B::*member, const Words<std::type_identity_t<V>>& words) {
    key.type = KeyType::text;
    for (const auto& word : words) key.choices.emplace_back(word.first);
    return enter(std::move(key), member, [member, words](D& data, const Setting& s) {
      for (const auto& [word, value] : words)
        if (s.text == word) data.*member = value;
    });
  }
  // Keys that fill a member struct, which starts as `otherwise` says where that is given.
  template <class G, class M, class B>
  requires std::is_base_of_v<M, G> Fields& add(const Fields<G>& group, M B::*member) {
    return enter(group.keys(), member, [group, member](D& data, const Place& place) {
      G start;
      static_cast<M&>(start) = std::move(data.*member);
      data.*member = group.read_at(place, std::move(start));
    });
  }
  template <class G, class M, class B, class Default>
  requires std::is_base_of_v<M, G> && std::is_invocable_v<Default, const D&> Fields& add(const Fields<G>& group,
                                                                                         M B::*member,
                                                                                         Default otherwise) {
    start(member, std::move(otherwise));
    return add(group, member);
  }
  // Tables nested in this one: a list of them, one that may be missing, or one.
  template <class T, class B>
  Fields& add(Key key, std::vector<T> B::*member, const Tables<T>& tables) {
    return nest(std::move(key), member, tables, true,
                [member](D& data, T table) { (data.*member).push_back(std::move(table)); });
  }
  template <class T, class B>
  Fields& add(Key key, std::optional<T> B::*member, const Tables<T>& tables) {
    return nest(std::move(key), member, tables, false,
                [member](D& data, T table) { (data.*member).emplace(std::move(table)); });
  }
  template <class T, class B>
  Fields& add(Key key, T B::*member, const Tables<T>& tables) {
    return nest(std::move(key), member, tables, false, [member](D& data, T table) { data.*member = std::move(table); });
  }
  // One number that may be given in several forms, of which at most one is; `as` says which.
  template <class Form>
  Fields& add_forms(double D::*member, Form D::*as,
                    const std::vector<std::pair<Key, std::type_identity_t<Form>>>& forms) {
    std::vector<Key> keys;
    for (const auto& form : forms) keys.push_back(form.first);
    return enter(keys, member, [=](D& data, const Place& place) {
      const Key* first = nullptr;
      for (const auto& [key, form] : forms) {
        if (!place.section->given(key.name)) continue;
        if (first) fields_detail::both_given(place, first->name, key.name, key.name);
        first = &key;
        data.*as = form;
        data.*member = place.section->number(key.name);
      }
    });
  }
  // What follows from the members read above.
  Fields& derive(void (*rule)(D&)) {
    entries_.push_back({{}, {}, [rule](D& data, const Place&) { rule(data); }});
    return *this;
  }
  // What must hold of all together; faults go to Reading::refuse.
  Fields& check(void (*rule)(const Reading<D>&)) {
    rules_.push_back(rule);
    return *this;
  }

  const std::vector<Key>& keys() const& { return keys_; }
  std::vector<Key> keys() && { return std::move(keys_); }  // of one that does not last

  // Of a sound section; faults go into the messages, under the section's kind and name unless `what` is given.
  Reading<D> read(const Section& section, Messages& messages, std::string what = "") const {
    return read_at({&section, &messages, what.empty() ? fields_detail::who(section) : std::move(what)});
  }
  Reading<D> read_at(const Place& place, D data = {}) const {
    for (const Entry& entry : entries_) entry.read(data, place);
    const Reading<D> reading(std::move(data), *this, place);
    for (const auto rule : rules_) rule(reading);
    return reading;
  }

  // Of its keys; throws std::logic_error if none fills it.
  template <class M, class B>
  const std::vector<std::string>& names_of(M B::*member) const {
    if (const Entry* entry = entry_of(member)) return entry->names;
    fields_detail::not_filled();
  }

 private:
  struct Entry {
    std::vector<std::string> names;  // of its keys; none: what a member starts as, or what follows from others
    std::any member;                 // M D::*
    std::function<void(D&, const Place&)> read;
  };

  template <class M, class B>
  const Entry* entry_of(M B::*member) const {
    M D::*const wanted = member;
    for (const Entry& entry : entries_)
      if (const auto* has = std::any_cast<M D::*>(&entry.member); has && *has == wanted && !entry.names.empty())
        return &entry;
    return nullptr;
  }
  template <class M, class B>
  Fields& enter(const std::vector<Key>& keys, M B::*member, std::function<void(D&, const Place&)> read) {
    if (entry_of(member)) fields_detail::filled_twice(keys.front().name);
    M D::*const own = member;
    Entry entry{{}, own, std::move(read)};
    for (const Key& key : keys) {
      fields_detail::check_new(keys_, key);
      keys_.push_back(key);
      entry.names.push_back(key.name);
    }
    entries_.push_back(std::move(entry));
    return *this;
  }
  template <class M, class B, class Set>
  requires std::is_invocable_v<Set, D&, const Setting&> Fields& enter(const Key& key, M B::*member, Set set) {
    return enter(std::vector<Key>{key}, member, [key, set](D& data, const Place& place) {
      if (const Setting* setting = fields_detail::found(key, *place.section)) set(data, *setting);
    });
  }
  template <class M, class B, class Default>
  void start(M B::*member, Default otherwise) {
    entries_.push_back(
        {{}, {}, [=](D& data, const Place&) { data.*member = std::invoke(otherwise, std::as_const(data)); }});
  }
  template <class M, class B, class T, class Put>
  Fields& nest(Key key, M B::*member, const Tables<T>& tables, bool list, Put put) {
    key.type = tables.named ? KeyType::named : KeyType::sections;
    key.nested = &tables.kinds();
    return enter(std::vector<Key>{key}, member, [=, &tables](D& data, const Place& place) {
      const Setting* setting = fields_detail::found(key, *place.section);
      if (!setting || (!list && !fields_detail::is_one_table(place, key.name, setting->sections.size()))) return;
      for (std::size_t i = 0; i < setting->sections.size(); ++i) {
        std::string what = place.what + ": " + key.name;
        if (tables.numbered) what += "[" + std::to_string(i + 1) + "]";
        if (tables.named) what += "." + setting->sections[i].name;
        put(data, tables.read_at({&setting->sections[i], place.messages, std::move(what)}));
      }
    });
  }

  std::vector<Key> keys_;
  std::vector<Entry> entries_;
  std::vector<void (*)(const Reading<D>&)> rules_;
};

// What may stand within another table, as tables of one kind or of several. T is what each of them is read as: the
// data, the Reading of it, or a variant of such.
template <class T>
class Tables {
 public:
  bool numbered = false;  // faults name a table by its place in the list: stages[2]
  bool named = false;     // the user names each: points.A; a table of one kind whose first key may stand for it

  template <class G>
  requires std::is_constructible_v<T, Reading<G>> Tables& add(std::string name, std::string doc,
                                                              const Fields<G>& fields, G start = {}) {
    kinds_.push_back(
        {.name = std::move(name), .doc = std::move(doc), .placement = Placement::nested, .keys = fields.keys()});
    readers_.push_back([fields, start](const Place& place) { return T(fields.read_at(place, start)); });
    return *this;
  }

  const std::vector<Kind>& kinds() const { return kinds_; }
  T read_at(const Place& place) const {
    for (std::size_t i = 0; i < kinds_.size(); ++i)
      if (kinds_[i].name == place.section->kind->name) return readers_[i](place);
    fields_detail::not_filled();
  }

 private:
  std::vector<Kind> kinds_;
  std::vector<std::function<T(const Place&)>> readers_;
};

template <class D>
template <class M, class B>
std::vector<std::string> Reading<D>::given_keys(M B::*group) const {
  std::vector<std::string> names;
  for (const std::string& name : fields_->names_of(group))
    if (place_.section->given(name)) names.push_back(name);
  return names;
}

template <class D>
template <class M, class B>
std::string Reading<D>::key(M B::*member) const {
  const std::vector<std::string>& names = fields_->names_of(member);
  for (const std::string& name : names)
    if (place_.section->given(name)) return name;
  return names.front();
}

}  // namespace kurbel
