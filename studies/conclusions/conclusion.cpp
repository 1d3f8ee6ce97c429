// conclusion.cpp — the one place that chooses and orders what is said first.
#include "studies/conclusions/conclusion.h"

#include <algorithm>
#include <map>
#include <tuple>

#include "studies/conclusions/headline.h"

namespace kurbel {
namespace {

constexpr int most_bad_news = 2;  // of a question

bool is_bad(const Answer& a) { return a.severity > 0; }

std::string as_sentence(std::string sentence) {
  while (sentence.ends_with('.') || sentence.ends_with(' ') || sentence.ends_with('\n')) sentence.pop_back();
  return sentence.empty() ? sentence : capitalised(std::move(sentence)) + ".";
}

}  // namespace

std::vector<std::string> concluded(std::vector<Answer> answers) {
  std::stable_sort(answers.begin(), answers.end(), [](const Answer& a, const Answer& b) {
    return std::tuple(!is_bad(a), a.topic, -a.severity) < std::tuple(!is_bad(b), b.topic, -b.severity);
  });
  std::vector<std::string> sentences;
  std::map<Topic, int> told;
  for (const Answer& a : answers) {
    if (is_bad(a) && ++told[a.topic] > most_bad_news) continue;
    if (std::string sentence = as_sentence(headline(a.sentence)); !sentence.empty())
      sentences.push_back(std::move(sentence));
  }
  return sentences;
}

std::string in_one_line(const std::vector<std::string>& sentences) {
  std::string text;
  for (const std::string& sentence : sentences) text += (text.empty() ? "" : " ") + sentence;
  return text;
}

}  // namespace kurbel
