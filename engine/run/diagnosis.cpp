// diagnosis.cpp — words for a run that broke off.
#include "engine/run/diagnosis.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

#include "engine/scene/units.h"

namespace kurbel {
namespace {

using Cause = Breakdown::Kind;

constexpr std::size_t events_reported = 3, parameters_reported = 3;
const std::string edges = "edges in time", turns = "quarter turns";  // as step_limits names them

// "twist of c3" and "c3", as far as they are known; or what ends the steps from outside: "edges in time".
struct Culprit {
  std::string state, element, bound = {};
  double share = 0;  // of the steps that the bound ended
};

Culprit culprit_of(const Breakdown& broken, Equations& equations, const RunOutcome& outcome) {
  Culprit found{{}, broken.element};
  try {
    if (broken.state && *broken.state < equations.size()) {
      found.state = equations.state_name(*broken.state);
      found.element = element_behind(equations, *broken.state, outcome.t, outcome.state);
    } else if (broken.kind == Cause::budget) {
      const Scene& scene = equations.model().scene;
      for (const LimitedSteps& l : outcome.limits.ranked(equations, outcome.t, outcome.state)) {
        if (l.by == edges || l.by == turns) {
          found.bound = l.by;
          found.share = l.share;
          break;
        }
        if (!scene.find(l.element)) continue;
        found.element = l.element;
        if (!l.states.empty()) found.state = l.states[0];
        break;
      }
    }
  } catch (const std::runtime_error&) {  // what cannot be evaluated cannot be blamed further
  }
  return found;
}

std::string last_events(const std::vector<Event>& events) {
  if (events.empty()) return "no events before";
  std::string text = "last events: ";
  const std::size_t first = events.size() - std::min(events.size(), events_reported);
  for (std::size_t k = first; k < events.size(); ++k)
    text +=
        fmt::format("{}\"{}\" {} at {:.6g} s", k > first ? ", " : "", events[k].component, events[k].what, events[k].t);
  return text;
}

// "stiffness = 9e+05 N·m/rad (line 12)" of what the scene gives for a component.
std::vector<std::string> parameters_of(const Scene& scene, const std::string& component) {
  std::vector<std::string> list;
  const Section* section = scene.find(component);
  if (!section || !section->kind) return list;
  for (const Setting& setting : section->settings) {
    if (!setting.given || list.size() == parameters_reported) continue;
    const Key* const key = section->kind->key(setting.key);
    if (!key || key->type != KeyType::quantity) continue;
    list.push_back(fmt::format("{} = {}", setting.key, with_unit(setting.number, key->unit, 4)));
  }
  return list;
}

// Speed of the fastest shaft [rad/s].
double fastest(const Equations& equations, const RunOutcome& outcome) {
  double speed = 0;
  for (std::size_t s = 0; s < equations.model().free_shafts; ++s)
    speed = std::max(speed, std::abs(outcome.state[equations.speed_index(static_cast<int>(s))]));
  return speed;
}

bool is_implicit(const std::string& method) { return method.starts_with("esdirk") || method == "bdf"; }

double one_digit_up(double value) {
  const double decade = std::pow(10, std::floor(std::log10(value)));
  return std::ceil(value / decade - 1e-9) * decade;
}

std::string advice(const Breakdown& broken, const Culprit& culprit, const Equations& equations,
                   const RunOptions& options, const RunOutcome& outcome) {
  const Scene& scene = equations.model().scene;
  std::vector<std::string> ways;
  if (broken.kind == Cause::budget) {
    const double begin = options.from ? options.from->t : 0, done = (outcome.t - begin) / (options.until - begin);
    if (done > 1e-3)
      ways.push_back(fmt::format("budget = \"{:g} s\" (now {:g} s; {:.0f} % of the run is done)",
                                 one_digit_up(1.2 * options.budget / done), options.budget, 100 * done));
  }
  const double accuracy = options.accuracy > 0 ? options.accuracy : scene.run.accuracy;
  if (broken.kind != Cause::not_finite && culprit.bound.empty() && accuracy < 1e-3)
    ways.push_back(fmt::format("accuracy = {:g} (now {:g})", std::min(1e-3, 10 * accuracy), accuracy));
  if (culprit.bound == edges) {
    ways.push_back("fewer points in tables over time");
  } else if (culprit.bound == turns) {
    ways.push_back("a load or a limit for what drives so fast");
  } else if (broken.kind != Cause::restless) {
    const std::string& now = outcome.statistics.method;  // of auto, what it came to
    const char* other = options.method == "auto" && now.find("esdirk") != std::string::npos ? "bdf"
                        : is_implicit(options.method)                                       ? "dop853"
                                                                                            : "esdirk";
    ways.push_back(fmt::format("method = \"{}\" (now \"{}\")", other, options.method));
  }
  if (!culprit.element.empty()) {
    const std::vector<std::string> parameters = parameters_of(scene, culprit.element);
    std::string values;
    for (const std::string& p : parameters) values += (values.empty() ? "" : ", ") + p;
    if (!values.empty())
      ways.push_back(fmt::format("other values of \"{}\" (now {}{})", culprit.element, values,
                                 scene.find(culprit.element)->at.line > 0
                                     ? fmt::format("; line {} of the scene", scene.find(culprit.element)->at.line)
                                     : ""));
    const auto& elastic = equations.model().elastic;
    const bool flexible = std::any_of(elastic.begin(), elastic.end(), [&](const ElasticJoint& e) {
      return !e.slips && !e.springless &&
             equations.model().network.joints[static_cast<std::size_t>(e.joint)].component == culprit.element;
    });
    if (flexible) ways.push_back(fmt::format("\"{}\" rigid (leave it out of effects.elasticity)", culprit.element));
  }
  std::string text;
  for (const std::string& way : ways) text += (text.empty() ? "try " : ", or ") + way;
  return text;
}

}  // namespace

std::string diagnosis(const Breakdown& broken, Equations& equations, const RunOptions& options,
                      const RunOutcome& outcome) {
  std::string text = fmt::format("stopped at t = {:.9g} s: {}", broken.t, broken.why);
  if (broken.kind == Cause::other) return outcome.events.empty() ? text : text + "; " + last_events(outcome.events);
  const Culprit culprit = culprit_of(broken, equations, outcome);
  const char* role = broken.kind == Cause::not_finite ? "lost its value"
                     : broken.kind == Cause::restless ? "chatters"
                                                      : "keeps the steps short";
  if (!culprit.bound.empty())
    text += fmt::format("; {} end {:.0f} % of the steps{}", culprit.bound, 100 * culprit.share,
                        culprit.bound == turns ? fmt::format(", at {:.3g} rad/s", fastest(equations, outcome)) : "");
  else if (!culprit.state.empty())
    text += fmt::format("; {}{} {}{}", culprit.state.starts_with("a ") ? "" : "the ", culprit.state, role,
                        culprit.element.empty() ? "" : fmt::format(", by \"{}\"", culprit.element));
  else if (!culprit.element.empty())
    text += fmt::format("; \"{}\" {}", culprit.element, role);
  text += "; " + last_events(outcome.events);
  const std::string ways = advice(broken, culprit, equations, options, outcome);
  return ways.empty() ? text : text + "; " + ways;
}

}  // namespace kurbel
