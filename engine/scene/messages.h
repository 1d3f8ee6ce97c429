// messages.h — faults of a user's input: where · what · got · allowed · next step.
#pragma once

#include <compare>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace kurbel {

struct Location {
  int line = 0;    // 1-based; 0 = the file as a whole
  int column = 0;  // 1-based
  friend auto operator<=>(const Location&, const Location&) = default;
};

struct Message {
  std::string file;
  Location at;
  std::string text;
};

// Collects every error of a file, so that a user sees them all at once.
class Messages {
 public:
  explicit Messages(std::string file) : file_(std::move(file)) {}
  void add(Location at, std::string text) { all_.push_back({file_, at, std::move(text)}); }
  void add_in(std::string file, Location at, std::string text) {
    all_.push_back({std::move(file), at, std::move(text)});
  }
  bool empty() const { return all_.empty(); }
  const std::string& file() const { return file_; }
  const std::vector<Message>& all() const { return all_; }
  // Throws SceneError with all messages, sorted by file and line, if there are any.
  void throw_if_any() const;

 private:
  std::string file_;
  std::vector<Message> all_;
};

// A user's text in quotes, with control characters escaped, shortened if long.
std::string in_quotes(std::string_view text);

// A scene that cannot be read or is not a machine. what() has one line "file:line:col: text" for each message
// (the first hundred).
struct SceneError : std::runtime_error {
  explicit SceneError(std::vector<Message> messages);
  std::vector<Message> messages;
};

}  // namespace kurbel
