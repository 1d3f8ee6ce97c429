// run_answers.cpp — a run that does what it should, in a sentence; and what keeps it from that.
#include "studies/answers/run_answers.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "drivetrain/shared/rating_keys.h"
#include "engine/numerics/index.h"
#include "studies/conclusions/headline.h"
#include "studies/findings/figure_text.h"
#include "studies/limits/ratings.h"

namespace kurbel {
namespace {

std::string first_line(const std::string& text) { return text.substr(0, text.find('\n')); }

class RunWords {
 public:
  explicit RunWords(const Result& result) : r_(result), p_(result.periods) {}

  // What a sound run comes to.
  std::string all() const {
    if (p_.steady) return steady();
    const Figure* last = figure(quantities::final_speed);
    const std::string end = !last                  ? std::string()
                            : last->value == 0     ? "at rest"
                            : all_but_rests(*last) ? fmt::format("all but at rest ({})", speed(last->value))
                                                   : "at " + speed(last->value);
    if (r_.model && !r_.model->commands.empty())
      return fmt::format("\"{}\" goes through its operating sequence{}", link(), end.empty() ? "" : " and ends " + end);
    if (p_.remaining || p_.without_limit)
      return fmt::format("\"{}\" has not come to a steady motion by {}: {}", link(), seconds(r_.until), p_.verdict);
    return end.empty() ? std::string() : fmt::format("\"{}\" is {} after {}", link(), end, seconds(r_.until));
  }

 private:
  // What still trembles in shafts that are held.
  bool all_but_rests(const Figure& last) const {
    return r_.model && std::abs(last.value) < 0.01 * r_.model->speed_scale;
  }
  std::string steady() const {
    const Figure* mean = figure(quantities::mean_speed);
    std::string text = fmt::format("\"{}\" runs steadily at {}", link(), speed(mean ? mean->value : p_.steady_speed));
    if (p_.run_up_end) text += fmt::format(" from {} on", seconds(*p_.run_up_end));
    if (p_.run_down_begin) text += fmt::format(", runs down from {}", seconds(*p_.run_down_begin));
    if (p_.standstill) text += fmt::format(" and rests at {}", seconds(*p_.standstill));
    return text;
  }
  std::string link() const { return r_.model ? r_.model->network.nodes[at(r_.model->reduction_node)].component : "it"; }
  const Figure* figure(const QuantityKind& what) const { return r_.model ? r_.find(what, link()) : nullptr; }
  std::string speed(double value) const {
    return told_shortly(value, "rad/s", r_.model ? r_.model->scene.speed_unit : SpeedUnit{});
  }
  static std::string seconds(double t) { return told_shortly(t, "s"); }

  const Result& r_;
  const Periods& p_;
};

void overloaded_motors(const Result& r, std::vector<Answer>& answers) {
  for (const Figure& f : r.figures) {
    const bool by_torque = f.words() == "thermal_use";
    if (!by_torque && f.words() != "current_use") continue;
    if (!r.model || !(f.value - f.error.value_or(0) > 1)) continue;
    const char* of = r.model->commands.empty() ? "its steady motion" : "its heaviest cycle";
    if (std::optional<Answer> answer = overload_answer(*r.model, f.of, f.value, by_torque, of))
      answers.push_back(std::move(*answer));
  }
}

}  // namespace

std::optional<Answer> overload_answer(const Model& model, const std::string& motor, double use, bool by_torque,
                                      const std::string& of) {
  const auto* rating = model.network.data.find<MotorRating>(motor);
  if (!rating || rating->states_duty() || !(use > 1)) return {};
  const std::optional<double> rated = by_torque ? rating->torque : std::nullopt;
  return Answer{Topic::bears,
                fmt::format("\"{}\" gets too hot: the {} of {} is {:.0f} % of the rated one{}", motor,
                            by_torque ? "RMS torque" : "RMS current", of, 100 * use,
                            rated ? fmt::format("; it holds from a rated torque of {:.4g} N·m on", *rated * use) : ""),
                use};
}

std::vector<Answer> run_answers(const Result& r, const std::string& whose) {
  if (!r.complete) return {{Topic::runs, capitalised(whose) + "INCOMPLETE: " + first_line(r.diagnosis), 100}};
  std::vector<Answer> answers = r.answers;
  if (std::none_of(answers.begin(), answers.end(), [](const Answer& a) { return a.topic == Topic::runs; }))
    if (std::string words = RunWords(r).all(); !words.empty()) answers.push_back({Topic::runs, std::move(words)});
  overloaded_motors(r, answers);
  if (r.unconfirmed()) answers.push_back({Topic::sure, "NOT confirmed: " + r.accuracy_in_words(), 1});
  for (Answer& a : answers) a.sentence = capitalised(whose + a.sentence);
  return answers;
}

std::vector<Answer> rating_answers(const std::vector<Verdict>& verdicts) {
  if (verdicts.empty()) return {};
  return {{Topic::bears, capitalised(sentence_of(verdicts, "rating")), worst_excess(verdicts)}};
}

}  // namespace kurbel
