// advise_question.cpp — kurbel advise: the cheapest set of effects that stays within a tolerance.
#include <fmt/format.h>

#include <stdexcept>

#include "studies/advise/advise.h"
#include "studies/files/whole_file.h"
#include "studies/question/question.h"

namespace kurbel {
namespace {

struct AdviseRequest : AdviseOptions {
  std::string write;  // file of the scene with the effects advised
};

StudyOutput advised(const Inquiry& inquiry, AdviseRequest asked) {
  if (!asked.write.empty())
    if (const std::string why = why_no_file_at(asked.write); !why.empty())
      throw std::invalid_argument(fmt::format("--write {}: {}", asked.write, why));
  asked.simulate = inquiry.simulation();
  Advice advice = advise(inquiry.scene, asked);
  if (!asked.write.empty() && advice.complete && !inquiry.watch.stopped()) write_whole(asked.write, advice.lean_scene);
  return output_of(std::move(advice));
}

}  // namespace

Question advise_question() {
  return make_question(
      {.place = 100,
       .name = "advise",
       .arguments = "scene.toml --within 1%",
       .help = "the cheapest set of effects whose figures stay within a tolerance",
       .does = "the cheapest set of effects whose figures stay within a tolerance of the fullest model; "
               "screened, then run; `--write lean.toml`"},
      OptionsOf<AdviseRequest>()
          .add({.name = "within",
                .doc = "deviation allowed from the fullest model (default: 1 %)",
                .example = "1 %",
                .what = "a part, 1e-12 … 1",
                .domain = {.low = 1e-12, .high = 1}},
               &AdviseOptions::within)
          .add({.name = "figures",
                .doc = "figures that count, joined by commas, e.g. delta,peak_torque.main_coupling (default: all)"},
               &AdviseOptions::figures)
          .add({.name = "write", .doc = "writes the scene with the effects advised"}, &AdviseRequest::write)
          .add({.name = "no_held_out", .doc = "skips the check at other loads and speeds"}, &AdviseOptions::held_out,
               false),
      advised);
}

}  // namespace kurbel
