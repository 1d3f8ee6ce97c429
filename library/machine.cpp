// machine.cpp — validated machines from scene files and texts.
#include <kurbel/figures.h>

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <string_view>

#include "engine/base/find_by.h"
#include "engine/model/model.h"
#include "engine/reading/read_scene.h"
#include "engine/scene/document.h"
#include "engine/scene/units.h"
#include "library/machine_parts.h"
#include "studies/run/simulate.h"
#include "studies/scenes/kinds.h"

namespace kurbel {
namespace {

std::vector<std::string> as_lines(const Settings& settings) {
  std::vector<std::string> lines;
  for (const auto& [path, value] : settings) lines.push_back(path + "=" + value);
  return lines;
}

std::shared_ptr<const MachineParts> read(const std::string& text, const std::string& file,
                                         const std::vector<std::string>& settings) {
  auto parts = std::make_shared<MachineParts>(MachineParts{text, file, settings, {}, {}});
  return answered([&] {
    const auto settled = std::make_shared<const SettledText>(text, file, settings);
    parts->placed = [settled](const SceneError& error) { return settled->placed(error); };
    parts->scene = parse_scene(*settled, all_kinds());
    return parts;
  });
}

}  // namespace

BadScene bad_scene(const SceneError& error) {
  std::vector<Fault> faults;
  for (const Message& m : error.messages)
    faults.push_back({for_callers(m.file), m.at.line, m.at.column, for_callers(m.text)});
  return BadScene(for_callers(error.what()), std::move(faults));
}

std::string for_callers(const std::string& message) {
  const auto is_letter = [](char c) { return c >= 'a' && c <= 'z'; };
  std::string words;
  bool quoted = false, command = false;
  for (std::size_t i = 0; i < message.size();) {
    const std::string_view rest = std::string_view(message).substr(i);
    const bool begins = i == 0 || std::string_view(" (\n").find(message[i - 1]) != std::string_view::npos;
    if (rest.front() == '"') quoted = !quoted;
    if (!quoted && std::string_view(";:,)\n").find(rest.front()) != std::string_view::npos) command = false;
    if (!quoted && begins && rest.starts_with("kurbel ")) command = true;
    if (quoted || command || !begins || !rest.starts_with("--") || rest.size() < 3 || !is_letter(rest[2])) {
      words += message[i++];
      continue;
    }
    for (i += 2; i < message.size() && (is_letter(message[i]) || message[i] == '-'); ++i)
      words += message[i] == '-' ? '_' : message[i];
  }
  return words;
}

Watch watch_of(const Watcher& watcher) { return {.interrupted = watcher.interrupted, .progress = watcher.progress}; }

void refuse_name(const std::string& what, const std::string& name, const std::vector<std::string>& names) {
  throw std::out_of_range(fmt::format("{} has no {}{}", what, in_quotes(name), suggestion(name, names)));
}

Machine Machine::from_file(const std::string& path, const Settings& settings) {
  const std::string text = answered([&] { return read_text_file(path, max_scene_bytes); });
  return Machine(read(text, path, as_lines(settings)));
}

Machine Machine::from_text(const std::string& text, const std::string& file, const Settings& settings) {
  return Machine(read(text, file, as_lines(settings)));
}

Machine Machine::with(const Settings& settings) const {
  std::vector<std::string> all = parts_->settings;
  // The last setting of a path holds.
  for (const std::string& line : as_lines(settings)) {
    const std::string path = line.substr(0, line.find('=') + 1);
    std::erase_if(all, [&](const std::string& there) { return there.starts_with(path); });
    all.push_back(line);
  }
  return Machine(read(parts_->text, parts_->file, all));
}

std::string Machine::title() const { return parts_->scene.title; }
std::string Machine::file() const { return parts_->file; }
std::string Machine::text() const { return parts_->scene.text; }
std::string Machine::effects() const { return parts_->scene.effects.describe(); }
double Machine::until() const { return parts_->scene.run.until; }
double Machine::accuracy() const { return parts_->scene.run.accuracy; }

std::vector<std::string> Machine::components() const {
  std::vector<std::string> names;
  for (const Section& section : parts_->scene.components) names.push_back(section.name);
  return names;
}

std::string Machine::explain() const {
  return asked_of(*parts_, [&] { return compile(parts_->scene, parts_->scene.effects)->explain(); });
}

std::vector<std::pair<std::string, std::string>> Machine::figures() const {
  return asked_of(*parts_, [&] {
    std::vector<std::pair<std::string, std::string>> all;
    for (const Figure& f : figure_list(*compile(parts_->scene, parts_->scene.effects)))
      all.emplace_back(f.name, f.unit);
    return all;
  });
}

const FigureValue* FigureValues::find(const std::string& name) const { return find_by(all_, &FigureValue::name, name); }

const FigureValue& FigureValues::operator[](const std::string& name) const {
  if (const FigureValue* const found = find(name)) return *found;
  std::vector<std::string> names;
  for (const FigureValue& v : all_) names.push_back(v.name);
  refuse_name("the result", name, names);
}

TimeSeries Trajectory::operator[](const std::string& name) const {
  const auto found = std::find(names_.begin(), names_.end(), name);
  if (found == names_.end()) refuse_name("the trajectory", name, names_);
  return {kept_, values_->data() + (found - names_.begin()), rows(), names_.size()};
}

}  // namespace kurbel
