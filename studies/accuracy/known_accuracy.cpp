// known_accuracy.cpp — reads the summary of an accuracy study.
#include "studies/accuracy/known_accuracy.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <system_error>

#include "engine/scene/document.h"

namespace kurbel {
namespace {

using Json = nlohmann::json;

constexpr std::size_t largest_summary = 100'000'000;

[[noreturn]] void refuse(const std::filesystem::path& file, Location at, const std::string& text) {
  throw SceneError({{file.string(), at, text}});
}

std::string text_of(const std::filesystem::path& file) {
  std::error_code error;
  const auto status = std::filesystem::status(file, error);
  if (!std::filesystem::exists(status))
    refuse(file, {}, "--setting: no such file; kurbel accuracy SCENE writes one and prints its path");
  if (std::filesystem::is_directory(status))
    refuse(file, {}, "--setting: is a folder; give the summary.json that kurbel accuracy SCENE wrote");
  try {
    return read_text_file(file.string(), largest_summary);
  } catch (const SceneError& unreadable) {
    refuse(file, {}, "--setting: " + unreadable.messages.front().text);
  }
}

Json parsed(const std::filesystem::path& file, const std::string& text) {
  try {
    return Json::parse(text);
  } catch (const Json::parse_error& error) {
    const std::size_t end = std::min(error.byte > 0 ? error.byte - 1 : 0, text.size());
    const auto line = 1 + std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(end), '\n');
    const std::size_t newline = text.rfind('\n', end == 0 ? 0 : end - 1);
    const std::size_t column = end - (newline == std::string::npos || end == 0 ? 0 : newline + 1) + 1;
    refuse(file, {static_cast<int>(line), static_cast<int>(column)},
           "--setting: is no JSON here; give the summary.json that kurbel accuracy SCENE wrote, unchanged");
  } catch (const Json::out_of_range&) {
    refuse(file, {},
           "--setting: holds a number beyond 1e308; give the summary.json that kurbel accuracy SCENE wrote, unchanged");
  }
}

double number(const Json& value) { return value.is_number() ? value.get<double>() : HUGE_VAL; }

// Largest error of motion and figures; one at its level's floor, where the references agree, counts as exact.
double largest_error(const Json& setting, const Json& level) {
  double error = number(setting.at("trajectory_error"));
  for (std::size_t i = 0; i < setting.at("figures").size(); ++i) {
    const Json &own = setting.at("figures").at(i).at("numerical_error"),
               &floor = level.at("figures").at(i).at("agreement");
    if (!own.is_number()) continue;  // the model does not yield it
    if (!(number(own) <= number(floor))) error = std::max(error, number(own));
  }
  return error;
}

// All settings of the model with these effects.
std::vector<KnownSetting> settings_of(const std::filesystem::path& file, const Json& study, const Effects& effects) {
  std::vector<KnownSetting> found;
  const Json& levels = study.at("models");
  for (const Json& setting : study.at("settings")) {
    const auto level =
        std::find_if(levels.begin(), levels.end(), [&](const Json& l) { return l.at("name") == setting.at("model"); });
    if (level == levels.end() || level->at("effects") != effects.describe() || level->at("name") == "multibody")
      continue;
    found.push_back({file.string(), setting.at("method").get<std::string>(), number(setting.at("tolerance")),
                     largest_error(setting, *level), number(setting.at("seconds").at("median"))});
    if (!(found.back().tolerance > 0 && found.back().tolerance < 1)) found.pop_back();  // the work diagram has none
  }
  return found;
}

void check(const std::filesystem::path& file, const KnownSetting& known) {
  try {
    check_method(known.method, "reduced");
  } catch (const std::invalid_argument& error) {
    refuse(file, {}, fmt::format("--setting: {}", error.what()));
  }
}

}  // namespace

std::string KnownSetting::describe() const {
  return fmt::format(
      "method and tolerance by --setting {}: {} at {:.0e}, which had an error of {:.1e} in {:.3g} ms when kurbel "
      "accuracy measured this scene",
      file, method, tolerance, error, 1e3 * seconds);
}

std::string fingerprint(const std::string& scene_text) {
  std::uint64_t hash = 0xcbf29ce484222325u;
  for (const char c : scene_text) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3u;
  return fmt::format("{:016x}", hash);
}

KnownSetting known_setting(const std::filesystem::path& summary, const Scene& scene, const Effects& effects,
                           double accuracy) {
  const Json study = parsed(summary, text_of(summary));
  try {
    const std::string of = study.at("fingerprint").get<std::string>();
    if (of != fingerprint(scene.text))
      refuse(summary, {},
             fmt::format("--setting: was measured of another scene than {} as it stands now (fingerprint {}, not {}); "
                         "run kurbel accuracy {} again",
                         scene.file, of, fingerprint(scene.text), scene.file));
    const std::vector<KnownSetting> all = settings_of(summary, study, effects);
    if (all.empty())
      refuse(summary, {},
             fmt::format("--setting: holds no setting for the effects {}; run with those of one of its models, or "
                         "without --setting",
                         effects.describe()));
    std::optional<KnownSetting> best;
    double least = HUGE_VAL;
    for (const KnownSetting& known : all) {
      least = std::min(least, known.error);
      if (known.error <= accuracy && (!best || known.seconds < best->seconds)) best = known;
    }
    if (!best)
      refuse(summary, {},
             fmt::format("--setting: no setting had an error of {:.1e} or less, the least was {:.1e}; request less "
                         "(--accuracy), or run without --setting",
                         accuracy, least));
    check(summary, *best);
    return *best;
  } catch (const Json::exception&) {
    refuse(summary, {},
           "--setting: is no summary of kurbel accuracy, or of another version of it; run kurbel accuracy SCENE and "
           "give the file that it names");
  }
}

}  // namespace kurbel
