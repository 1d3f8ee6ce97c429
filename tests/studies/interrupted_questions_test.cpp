// interrupted_questions_test.cpp — whatever a question has when it is interrupted can be shown: as text, JSON and a page.
#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <exception>
#include <string>
#include <thread>

#include "studies/question/question.h"
#include "tests/support/scenes.h"

namespace kurbel::interrupted_questions_test {
namespace {

GivenOptions options_of(const std::string& question) {
  if (question == "size") return {{"delta", "0.05"}};
  if (question == "advise") return {{"within", "1 %"}};
  return {};
}

// Interrupted after so long; 0: from the start.
void show_interrupted(const Question& question, const Scene& scene, std::chrono::microseconds after) {
  std::atomic<bool> interrupted = after.count() == 0;
  Inquiry inquiry{.scene = scene, .text = scene.text, .file = scene.file, .settings = {}};
  inquiry.watch = {.interrupted = &interrupted};
  const std::jthread signal([&] {
    std::this_thread::sleep_for(after);
    interrupted = true;
  });
  try {
    const StudyOutput output = question.answer(inquiry, options_of(question.name));
    EXPECT_FALSE(output.text(true).empty() && output.brief);
    EXPECT_FALSE(output.json().empty());
    EXPECT_FALSE(output.report().title.empty());
  } catch (const std::exception& error) {  // refused: the command says why
    EXPECT_FALSE(std::string(error.what()).empty());
  }
}

class InterruptedQuestions : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Scenes, InterruptedQuestions, testing::Values("crank_press", "worn_crank_pin", "gear_pair"));

TEST_P(InterruptedQuestions, ShowWhatTheyHave) {
  const Scene scene = test::scene_file(std::string("scenes/") + GetParam() + ".toml");
  for (const Question& question : questions()) {
    SCOPED_TRACE(question.name);
    for (const int after : {0, 1500, 9000, 30000}) show_interrupted(question, scene, std::chrono::microseconds(after));
  }
}

}  // namespace
}  // namespace kurbel::interrupted_questions_test
