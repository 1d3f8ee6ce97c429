// messages.cpp — sorting and wording of error lists.
#include "engine/messages.h"

#include <fmt/format.h>

#include <algorithm>

namespace kurbel {
namespace {

std::vector<Message> sorted(std::vector<Message> messages) {
  std::stable_sort(messages.begin(), messages.end(), [](const Message& a, const Message& b) {
    return a.file != b.file ? a.file < b.file : a.at < b.at;
  });
  return messages;
}

std::string joined(const std::vector<Message>& messages) {
  std::string text;
  for (const Message& m : messages) {
    if (!text.empty()) text += '\n';
    text += m.at.line > 0 ? fmt::format("{}:{}:{}: {}", m.file, m.at.line, m.at.column, m.text)
                          : fmt::format("{}: {}", m.file, m.text);
  }
  return text;
}

}  // namespace

SceneError::SceneError(std::vector<Message> list)
    : std::runtime_error(joined(sorted(list))), messages(sorted(std::move(list))) {}

void Messages::throw_if_any() const {
  if (!all_.empty()) throw SceneError(all_);
}

}  // namespace kurbel
