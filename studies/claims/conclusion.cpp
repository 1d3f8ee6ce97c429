// conclusion.cpp — selects and orders the sentences of a conclusion.
#include "studies/claims/conclusion.h"

#include <algorithm>
#include <map>
#include <tuple>

#include "studies/claims/headline.h"

namespace kurbel {
namespace {

constexpr int most_bad_news = 2;  // of a question

std::string as_sentence(std::string sentence) {
  while (sentence.ends_with('.') || sentence.ends_with(' ') || sentence.ends_with('\n')) sentence.pop_back();
  return sentence.empty() ? sentence : capitalised(std::move(sentence)) + ".";
}

}  // namespace

std::vector<std::string> concluded(Claims claims) {
  std::erase_if(claims, [](const Claim& c) { return !c.in_conclusion; });
  std::stable_sort(claims.begin(), claims.end(), [](const Claim& a, const Claim& b) {
    const auto place = [](const Claim& c) {
      const bool bad = c.is_bad();
      // What is wrong with the machine, what else is said of it, its variants, figures.
      const int part = !c.variant.empty() ? 2 : bad ? 0 : c.topic() < Topic::figures ? 1 : 3;
      return std::tuple(part, c.topic(), bad ? -static_cast<int>(c.severity()) : 0,
                        bad && c.topic() == Topic::bears ? -c.share() : 0, bad ? c.predicate : Predicate{});
    };
    return place(a) < place(b);
  });
  std::vector<std::string> sentences;
  std::map<std::pair<bool, Topic>, int> told;
  for (const Claim& claim : claims) {
    if (claim.is_bad() && ++told[{claim.variant.empty(), claim.topic()}] > most_bad_news) continue;
    if (std::string sentence = as_sentence(headline(claim.text)); !sentence.empty())
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
