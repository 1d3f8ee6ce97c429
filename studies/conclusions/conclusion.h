// conclusion.h — answers of a study, and the conclusion that they make.
//
//     concluded({{Topic::figures, "δ is 0.1043819"}, {Topic::bears, "\"clutch\" gets too hot", 1.3}})
//         → "\"clutch\" gets too hot.", "δ is 0.1044."
#pragma once

#include <string>
#include <vector>

namespace kurbel {

// In the order in which an engineer asks.
enum class Topic {
  runs,     // does it do its work at all?
  sure,     // are its figures confirmed?
  bears,    // does it bear what it brings? By how much not, where, and what value would mend it?
  depends,  // which effect that is off would change the answer?
  figures   // then what was asked for
};

struct Answer {
  Topic topic = Topic::figures;
  std::string sentence;  // without a full stop, as it is to be read
  double severity = 0;   // > 0: bad news, the worse the larger
};

// Bad news by question, then by severity, at most two of a question; then the others by question, each as it was given.
// With full stops, and rounded as headlines are.
std::vector<std::string> concluded(std::vector<Answer> answers);

// In one line.
std::string in_one_line(const std::vector<std::string>& sentences);

}  // namespace kurbel
