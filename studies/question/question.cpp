// question.cpp — the list of all questions.
#include "studies/question/question.h"

#include "studies/data/named.h"

namespace kurbel {

// Each is defined in the folder of its study.
Question run_question();
Question compare_question();
Question difference_question();
Question reduce_question();
Question size_question();
Question forces_question();
Question gears_question();
Question modes_question();
Question report_question();
Question steady_question();
Question effects_question();
Question advise_question();
Question accuracy_question();
Question sweep_question();
Question merge_question();
Question uncertainty_question();
Question export_question();  // in library/fmi
Question fit_question();

const std::vector<Question>& questions() {
  static const std::vector<Question> all = [] {
    std::vector<Question> list;
    for (Question (*const made)() :
         {run_question, compare_question, difference_question, reduce_question, size_question, forces_question,
          gears_question, modes_question, report_question, steady_question, effects_question, advise_question,
          accuracy_question, sweep_question, merge_question, uncertainty_question, fit_question, export_question})
      list.push_back(made());
    return list;
  }();
  return all;
}

const Question& question_named(const std::string& name) {
  return named(questions(), &Question::name, name, "no study {}{}; allowed: {}");
}

}  // namespace kurbel
