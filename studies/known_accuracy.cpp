// known_accuracy.cpp — reads the summary of an accuracy study.
#include "studies/known_accuracy.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <nlohmann/json.hpp>

namespace kurbel {
namespace {

using Json = nlohmann::json;

double number(const Json& value) { return value.is_number() ? value.get<double>() : HUGE_VAL; }

// Of the motion and of the figures; one at its level's floor, to which the references agree, counts as exact.
double largest_error(const Json& setting, const Json& level) {
  double error = number(setting.at("trajectory_error"));
  for (std::size_t i = 0; i < setting.at("figures").size(); ++i) {
    const Json &own = setting.at("figures")[i].at("numerical_error"), &floor = level.at("figures")[i].at("agreement");
    if (!own.is_number()) continue;  // the model does not yield it
    if (!(number(own) <= number(floor))) error = std::max(error, number(own));
  }
  return error;
}

}  // namespace

std::string KnownSetting::describe() const {
  return fmt::format(
      "method and tolerance by what kurbel accuracy measured of this scene: {} at {:.0e} had an error of {:.1e} in "
      "{:.3g} ms",
      method, tolerance, error, 1e3 * seconds);
}

std::string fingerprint(const std::string& scene_text) {
  std::uint64_t hash = 0xcbf29ce484222325u;
  for (const char c : scene_text) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3u;
  return fmt::format("{:016x}", hash);
}

std::optional<KnownSetting> known_setting(const std::filesystem::path& summary, const Scene& scene,
                                          const Effects& effects, double accuracy) {
  std::ifstream file(summary);
  if (!file) return {};
  const Json study = Json::parse(file, nullptr, false);
  if (study.is_discarded()) return {};
  try {
    if (study.at("fingerprint") != fingerprint(scene.text)) return {};
    std::optional<KnownSetting> best;
    for (const Json& setting : study.at("settings")) {
      const Json& levels = study.at("models");
      const auto level = std::find_if(levels.begin(), levels.end(),
                                      [&](const Json& l) { return l.at("name") == setting.at("model"); });
      if (level == levels.end() || level->at("effects") != effects.describe() || level->at("name") == "multibody")
        continue;
      const KnownSetting known{setting.at("method"), number(setting.at("tolerance")), largest_error(setting, *level),
                               number(setting.at("seconds").at("median"))};
      if (!std::isfinite(known.tolerance) || known.error > accuracy || (best && known.seconds >= best->seconds))
        continue;
      best = known;
    }
    return best;
  } catch (const Json::exception&) {  // written by another version
    return {};
  }
}

}  // namespace kurbel
