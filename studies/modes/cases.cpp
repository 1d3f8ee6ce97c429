// cases.cpp — the drive with a failure: cases of the scene; one cylinder after the other misfiring (no injection, but
// compression). Findings on the cases.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <string>

#include "engine/numerics/deadline.h"
#include "engine/reading/read_scene.h"
#include "engine/scene/messages.h"
#include "studies/claims/ranges.h"
#include "studies/findings/output.h"
#include "studies/findings/plots.h"
#include "studies/modes/modes.h"
#include "studies/modes/modes_plots.h"
#include "studies/question/question.h"
#include "studies/scenes/kinds.h"

namespace kurbel {
namespace {

// The cylinder's name, and the scene with it misfiring.
struct Misfiring {
  std::string name;
  Scene scene;
};

bool misfires(const Section& section) {
  return std::any_of(section.settings.begin(), section.settings.end(), [](const Setting& s) {
    return (s.key == "misfire" && (s.flag || !s.numbers.empty())) ||
           std::any_of(s.sections.begin(), s.sections.end(), misfires);
  });
}

// A compressor's load is over the angle, too, but does not drive.
bool is_fired(const Section& load) {
  return load.has("misfire") && load.has("work") && load.text("work") == "driving" &&
         std::any_of(load.settings.begin(), load.settings.end(),
                     [](const Setting& s) { return s.curve.over == "angle"; });
}

// For an engine by its firing order: each of its numbers.
void add_engine(const Scene& scene, std::size_t component, std::vector<Misfiring>& out) {
  const Section& engine = scene.components[component];
  std::vector<double> numbers = engine["firing_order"].numbers;
  if (numbers.size() < 2) return;
  std::sort(numbers.begin(), numbers.end());
  for (const double number : numbers) {
    Misfiring& made = out.emplace_back(Misfiring{fmt::format("cylinder {:g} of {}", number, engine.name), scene});
    std::vector<Setting>& settings = made.scene.components[component].settings;
    std::erase_if(settings, [](const Setting& s) { return s.key == "misfire"; });
    Setting misfire;
    misfire.key = "misfire", misfire.at = engine.at, misfire.given = true, misfire.numbers = {number};
    settings.push_back(std::move(misfire));
  }
}

// For a mechanism: its load, if that is a driving diagram over the angle.
void add_mechanism(const Scene& scene, std::size_t component, std::vector<Misfiring>& out) {
  const Section& mechanism = scene.components[component];
  for (std::size_t s = 0; s < mechanism.settings.size(); ++s)
    for (std::size_t k = 0; k < mechanism.settings[s].sections.size(); ++k) {
      if (!is_fired(mechanism.settings[s].sections[k])) continue;
      Misfiring& made = out.emplace_back(Misfiring{mechanism.name, scene});
      for (Setting& setting : made.scene.components[component].settings[s].sections[k].settings)
        if (setting.key == "misfire") setting.flag = setting.given = true;
    }
}

std::vector<Misfiring> misfiring(const Scene& scene) {
  std::vector<Misfiring> cases;
  for (std::size_t i = 0; i < scene.components.size(); ++i) {
    if (scene.components[i].has("firing_order") && scene.components[i].kind->name == "engine")
      add_engine(scene, i, cases);
    else
      add_mechanism(scene, i, cases);
  }
  return cases;
}

}  // namespace

ShaftStresses stresses_of_sweep(const ModesStudy& study) {
  return {.joints = study.limited,
          .normal = {"", study.sweep, study.barred, study.excitations.fundamental},
          .misfires = {},
          .link = study.link,
          .unit = study.speed_unit};
}

std::vector<Firing> find_misfires(const Scene& scene, const Effects& effects, const ModesOptions& options,
                                  const ModesStudy& normal, std::vector<std::string>& notes) {
  std::vector<Firing> found;
  if (std::any_of(scene.components.begin(), scene.components.end(), misfires)) return found;
  const std::vector<Misfiring> cases = misfiring(scene);
  if (cases.size() < 2) return found;
  ModesOptions same = options;
  same.speed = normal.drive.at.speed;
  same.slowest = normal.slowest, same.fastest = normal.fastest;
  same.spot_checks = 0, same.spots.clear(), same.torque.clear();
  same.response_alone = true;
  same.start = !normal.start_unknown;
  same.watch.progress = {};
  for (const Misfiring& one : cases) {
    if (options.watch.stopped()) break;
    options.watch.say("as " + one.name + " misfires");
    try {
      ModesStudy study = find_modes(one.scene, effects, same);
      found.push_back({one.name, std::move(study.sweep), std::move(study.barred), study.excitations.fundamental});
    } catch (const SceneError&) {
      notes.push_back(fmt::format("{} cannot misfire in this scene: its load needs \"motored\"", one.name));
    }
  }
  return found;
}

std::vector<ModesCase> find_cases(const Inquiry& inquiry, const std::vector<std::string>& names,
                                  const std::optional<Effects>& effects, const ModesOptions& options,
                                  const ModesStudy& normal) {
  const std::vector<Case> all = cases_of(inquiry.scene.text, inquiry.file);
  const bool none = names.size() == 1 && names.front() == "none";
  std::vector<std::string> known;
  for (const Case& one : all) known.push_back(one.name);
  for (const std::string& name : none ? std::vector<std::string>{} : names)
    if (std::find(known.begin(), known.end(), name) == known.end())
      throw std::invalid_argument(fmt::format("--cases {}: the scene has no such [[case]]{}; it has: {}",
                                              in_quotes(name), suggestion(name, known),
                                              known.empty() ? "none" : listed(known, "and")));
  ModesOptions same = options;
  same.slowest = normal.slowest, same.fastest = normal.fastest;
  same.spot_checks = 0, same.spots.clear(), same.torque.clear(), same.misfires = false;
  same.watch.progress = {};
  std::vector<ModesCase> found;
  for (const Case& one : all) {
    if (none || (!names.empty() && std::find(names.begin(), names.end(), one.name) == names.end())) continue;
    if (options.watch.stopped()) break;
    options.watch.say("case " + one.name);
    ModesCase& made = found.emplace_back(ModesCase{one.name, one.settings});
    try {
      const Scene scene = scene_of(one, inquiry.text, inquiry.file, inquiry.settings, all_kinds(), inquiry.allowed);
      made.study =
          std::make_shared<const ModesStudy>(find_modes(scene, effects.value_or(effects_of_modes(scene)), same));
    } catch (const OutOfTime& out) {
      made.why = out.what();
    } catch (const std::logic_error& refused) {
      made.why = refused.what();
    } catch (const std::runtime_error& failed) {
      made.why = failed.what();
    }
  }
  return found;
}

namespace modes {
namespace {

constexpr std::size_t curves_drawn = 6;

// Over the operating speeds, of one speed at that of the steady motion; NaN: the case has no such joint.
struct LargestAmplitude {
  double peak = std::nan(""), speed = 0;
};
LargestAmplitude largest_amplitude(const ModesStudy& m, const std::string& joint) {
  LargestAmplitude most;
  const auto place = std::find(m.joint_names.begin(), m.joint_names.end(), joint);
  const auto j = static_cast<std::size_t>(place - m.joint_names.begin());
  const auto look = [&](const SpeedResponse& r, double speed) {
    if (j < r.joints.size() && !(r.joints[j].peak <= most.peak)) most = {r.joints[j].peak, speed};
  };
  const OperatingSpeeds& run = m.margins.speeds;
  const double own = std::abs(m.drive.at.speed);
  if (!(run.slowest < run.fastest) || run.hold(own)) look(m.cycle ? *m.cycle : m.here, own);
  for (const SpeedResponse& r : m.sweep)
    if (r.kept && run.hold(r.speed)) look(r, r.speed);
  return most;
}

// The unchanged drive, and each computed case.
std::vector<std::pair<std::string, const ModesStudy*>> variants_of(const ModesStudy& m) {
  std::vector<std::pair<std::string, const ModesStudy*>> all = {{"as it is", &m}};
  for (const ModesCase& one : m.cases)
    if (one.study) all.emplace_back(one.name, one.study.get());
  return all;
}

// "54.92 … 65.29 (intermediate_shaft), within the operating speeds"
std::string barred_text(const ModesStudy& of) {
  std::string text;
  const OperatingSpeeds& run = of.margins.speeds;
  for (const BarredRange& b : of.barred)
    if (b.by != BarredRange::By::sign)
      text +=
          fmt::format("{}{} ({}){}", text.empty() ? "" : "; ",
                      range_text(of.speed_unit.of(b.from), of.speed_unit.of(b.to)), of.limited[b.joint].name,
                      run.known() && b.from < run.fastest && b.to > run.slowest ? ", within the operating speeds" : "");
  return text.empty() ? "none" : text;
}

Rows case_table(const ModesStudy& m) {
  Lines lines;
  const auto add = [&](const std::string& name, const std::string& settings, const ModesStudy& of) {
    std::vector<std::string> hertz_of;
    for (std::size_t k = 0; k < natural_modes(of) && k < 3; ++k)
      hertz_of.push_back(fmt::format("{:.4g}", hertz(of.modes[k].omega)));
    std::string nearest = "—";
    if (!of.margins.rows.empty()) {
      const Margin& row = of.margins.rows.front();
      nearest =
          fmt::format("mode {} and {}: {}, {}", of.margins.modes[row.mode].number, of.margins.lines[row.line].label,
                      row.margin == 0 ? "they meet within the range" : fmt::format("{:+.3g} %", 100 * row.margin),
                      row.within ? "WITHIN" : "kept");
    }
    const std::string limits = sentence_of(of.verdicts, "limit");
    lines.push_back({name, settings, fmt::format("{}", fmt::join(hertz_of, ", ")), nearest, barred_text(of),
                     limits.empty() ? "no limits are given" : capitalised(limits)});
  };
  add("as it is", "", m);
  for (const ModesCase& one : m.cases) {
    const std::string settings = fmt::format("{}", fmt::join(one.settings, "; "));
    if (one.study)
      add(one.name, settings, *one.study);
    else
      lines.push_back({one.name, settings, "not assessed", "", "", one.why});
  }
  Rows table = words_table("Cases: the same drive with a failure",
                           {"case", "set", "first natural frequencies [Hz]", "nearest margin",
                            fmt::format("barred [{}]", m.speed_unit.name), "limits"},
                           lines);
  table.heading = "cases", table.text_columns = table.text_columns_on_terminal = 6;
  return table;
}

Rows amplitude_table(const ModesStudy& m) {
  Lines lines;
  std::vector<std::string> headings = {"joint"};
  for (const auto& [name, study] : variants_of(m)) headings.push_back(name);
  for (const std::size_t j : joints_drawn(m)) {
    const std::string& joint = m.joint_names[j];
    std::vector<std::string>& line = lines.emplace_back(std::vector<std::string>{joint});
    for (const auto& [name, study] : variants_of(m)) {
      const LargestAmplitude most = largest_amplitude(*study, joint);
      line.push_back(std::isnan(most.peak)
                         ? "—"
                         : fmt::format("{} at {}", torque_text(most.peak), m.speed_unit.text(most.speed, 4)));
    }
  }
  Rows table = words_table("Largest alternating torque over the operating speeds", headings, lines);
  table.heading = "largest alternating torque over the operating speeds, by cases";
  return table;
}

std::optional<Plot> case_plot(const ModesStudy& m, std::size_t joint) {
  Plot plot{.title = fmt::format("Alternating torque in {} over the speed, by cases", m.joint_names[joint]),
            .x = {"speed of " + m.link, m.speed_unit.name},
            .y = {"peak of the torque", ""}};
  std::size_t role = 0;
  for (const auto& [name, study] : variants_of(m)) {
    const auto place = std::find(study->joint_names.begin(), study->joint_names.end(), m.joint_names[joint]);
    const auto j = static_cast<std::size_t>(place - study->joint_names.begin());
    Series curve{.name = name, .role = study == &m ? Role::elastic : further_role(++role)};
    for (const SpeedResponse& r : study->sweep)
      if (r.kept && j < r.joints.size() && std::isfinite(r.joints[j].peak))
        curve.add(m.speed_unit.of(r.speed), r.joints[j].peak);
    if (!curve.x.empty()) plot.series.push_back(std::move(curve));
  }
  if (plot.series.size() < 2) return {};
  const OperatingSpeeds& run = m.margins.speeds;
  if (run.known()) plot.bands.push_back({m.speed_unit.of(run.slowest), m.speed_unit.of(run.fastest), "", Role::green});
  return in_readable_unit(std::move(plot), "N*m");
}

// Faults in a case that the unchanged drive does not have, of a component one.
void claim_case(Findings& f, const ModesCase& one) {
  Claims claims = findings_of(*one.study).claims;
  for (Claim& claim : claims) {
    const bool known = std::any_of(f.claims.begin(), f.claims.end(), [&](const Claim& other) {
      return other.predicate == claim.predicate && other.of == claim.of &&
             (other.variant == one.name || other.load_case == claim.load_case);
    });
    if (known || !claim.is_bad() || !claim.in_conclusion) continue;
    claim.text = fmt::format("In the case {}: {}", in_quotes(one.name), claim.text);
    claim.variant = one.name;
    f.claim(std::move(claim));
  }
}

}  // namespace

void say_cases(Findings& f, Chapter in, const ModesStudy& m) {
  if (m.cases.empty()) return;
  f.say(in, case_table(m));
  if (!m.joint_names.empty() && is_forced(m)) f.say(in, amplitude_table(m));
  f.draw(in, [&m] {
    std::vector<Plot> plots;
    for (const std::size_t j : joints_drawn(m))
      if (std::optional<Plot> plot = plots.size() < curves_drawn ? case_plot(m, j) : std::nullopt)
        plots.push_back(std::move(*plot));
    return plots;
  });
  f.record("cases", each(m.cases, [](const ModesCase& one) {
             Record record = {{"name", one.name}, {"set", one.settings}};
             if (one.study)
               record.push_back({"modes", summary_of(findings_of(*one.study))});
             else
               record.push_back({"not_assessed", one.why});
             return record;
           }));
  for (const ModesCase& one : m.cases)
    if (one.study) claim_case(f, one);
}

}  // namespace modes

}  // namespace kurbel
