// messages.cpp — sorting and wording of error lists.
#include "engine/scene/messages.h"

#include <fmt/format.h>

#include <algorithm>

#include "engine/scene/printable.h"
#include "engine/scene/text.h"

namespace kurbel {
namespace {

std::vector<Message> sorted(std::vector<Message> messages) {
  std::stable_sort(messages.begin(), messages.end(),
                   [](const Message& a, const Message& b) { return a.file != b.file ? a.file < b.file : a.at < b.at; });
  return messages;
}

constexpr std::size_t most_shown = 100;

std::string joined(const std::vector<Message>& messages) {
  std::string text;
  for (std::size_t i = 0; i < messages.size() && i < most_shown; ++i) {
    const Message& m = messages[i];
    if (!text.empty()) text += '\n';
    text += printable(m.at.line > 0 ? fmt::format("{}:{}:{}: {}", m.file, m.at.line, m.at.column, m.text)
                                    : fmt::format("{}: {}", m.file, m.text));
  }
  if (messages.size() > most_shown) text += fmt::format("\n… and {} more messages", messages.size() - most_shown);
  return text;
}

}  // namespace

std::string in_quotes(std::string_view text) {
  constexpr std::size_t longest = 80;
  if (text.size() <= longest) return fmt::format("\"{}\"", printable(text));
  std::size_t end = longest;
  while (end > 0 && !begins_character(text[end])) --end;  // not within a character
  return fmt::format("\"{}…\"", printable(text.substr(0, end)));
}

SceneError::SceneError(std::vector<Message> list)
    : std::runtime_error(joined(sorted(list))), messages(sorted(std::move(list))) {}

void Messages::throw_if_any() const {
  if (!all_.empty()) throw SceneError(all_);
}

}  // namespace kurbel
