// variant_motors.cpp — rewrites the tables of motors in a scene's text.
#include "tests/coverage/variant_motors.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/scene/units.h"

namespace kurbel::coverage {
namespace {

struct Catalogue {
  double power = 0, rated_speed = 0, synchronous_speed = 0, breakdown_ratio = 0;  // SI
  std::string inertia;
  double rated_torque() const { return power / rated_speed; }
};

double si_value(const DocumentValue& table, const char* key) {
  const DocumentEntry* entry = table.find(key);
  if (!entry) return 0;
  UnitError error;
  const auto quantity = parse_quantity(entry->value.text, error);
  return quantity ? quantity->value : entry->value.number;
}

// False: no induction motor, or one that is given otherwise.
bool read_catalogue(const DocumentValue& table, Catalogue& motor) {
  const DocumentEntry *kind = table.find("kind"), *inertia = table.find("inertia");
  if (!kind || kind->value.text != "induction motor" || !inertia) return false;
  for (const DocumentEntry& entry : table.entries) {
    constexpr std::string_view plain[] = {
        "kind", "rated_power", "rated_speed", "synchronous_speed", "breakdown_ratio", "inertia"};
    if (std::find(std::begin(plain), std::end(plain), entry.key) == std::end(plain)) return false;
  }
  motor = {si_value(table, "rated_power"), si_value(table, "rated_speed"), si_value(table, "synchronous_speed"),
           si_value(table, "breakdown_ratio"), inertia->value.text};
  return motor.power > 0 && motor.rated_speed > 0 && motor.synchronous_speed > motor.rated_speed;
}

std::string two_axis(const Catalogue& m) {
  // Pole pairs are whole at a mains of some 50 Hz.
  const double turns = m.synchronous_speed / (2 * std::numbers::pi);
  const double frequency = turns * std::max(1.0, std::round(50 / turns));
  return fmt::format(
      "kind = \"induction motor\"\nrated_power = \"{:.9g} W\"\nrated_speed = \"{:.9g} rad/s\"\n"
      "synchronous_speed = \"{:.12g} rad/s\"\nbreakdown_ratio = {:.6g}\nresistance_ratio = 1.0\nfrequency = \"{:.12g} "
      "Hz\"\n",
      m.power, m.rated_speed, m.synchronous_speed, m.breakdown_ratio, frequency);
}
std::string dc_shunt(const Catalogue& m) {
  return fmt::format("kind = \"dc shunt motor\"\nstall_torque = \"{:.6g} N*m\"\nno_load_speed = \"{:.6g} rad/s\"\n",
                     8 * m.rated_torque(), m.synchronous_speed * 1.05);
}
std::string by_points(const Catalogue& m) {
  const double t = m.rated_torque(), w = m.synchronous_speed;
  return fmt::format(
      "kind = \"motor\"\ntorque = {{ over = \"speed\", unit = [\"rad/s\", \"N*m\"], points = [[0, {:.6g}], [{:.6g}, "
      "{:.6g}], [{:.6g}, {:.6g}], [{:.6g}, {:.6g}], [{:.6g}, 0], [{:.6g}, {:.6g}]] }}\n",
      2.1 * t, 0.3 * w, 1.8 * t, 0.8 * w, 2.6 * t, m.rated_speed, t, w, 1.06 * w, -2.2 * t);
}

// Lines of the table [name] become `body`.
std::string with_table(const std::string& text, const std::string& name, const std::string& body) {
  const std::string header = "[" + name + "]\n";
  const std::size_t begin = text.find(header);
  if (begin == std::string::npos) return text;
  const std::size_t end = std::min(text.find("\n[", begin + header.size()), text.size() - 1) + 1;
  return text.substr(0, begin) + header + body + text.substr(end);
}

}  // namespace

std::string with_other_motors(const std::string& text, const std::string& file, Dice& dice) {
  std::string changed = text;
  for (const DocumentEntry& entry : parse_toml(text, file).entries) {
    Catalogue motor;
    if (entry.value.type != DocumentValue::Type::table || !read_catalogue(entry.value, motor)) continue;
    const double draw = dice.uniform();
    if (draw > 1.0 / 3) continue;
    const std::string body = draw < 1.0 / 9 ? two_axis(motor) : draw < 2.0 / 9 ? dc_shunt(motor) : by_points(motor);
    changed = with_table(changed, entry.key, body + fmt::format("inertia = \"{}\"\n", motor.inertia));
  }
  return changed;
}

}  // namespace kurbel::coverage
