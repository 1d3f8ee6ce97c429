// terminal.cpp — output without control characters; colours; log.
#include "app/terminal.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <spdlog/sinks/stdout_sinks.h>
#include <spdlog/spdlog.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <system_error>

#include "engine/scene/printable.h"

namespace kurbel::app {
namespace {

int stdout_error = 0;  // the first one

void write_to(std::FILE* stream, std::string_view text) {
  const bool whole = std::fwrite(text.data(), 1, text.size(), stream) == text.size();
  if (!whole && stream == stdout && stdout_error == 0) stdout_error = errno;
}

void wrap(std::string& text, std::string_view what, std::string_view code) {
  if (what.empty()) return;
  for (std::size_t at = text.find(what); at != std::string::npos;) {
    const std::string with = fmt::format("\033[{}m{}\033[0m", code, what);
    text.replace(at, what.size(), with);
    at = text.find(what, at + with.size());
  }
}

}  // namespace

void open_standard_streams() {
  // Opened in the wrong mode: a closed stream stays unreadable or unwritable.
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
    if (fcntl(stream, F_GETFD) < 0 && errno == EBADF)
      if (open("/dev/null", stream == STDIN_FILENO ? O_WRONLY : O_RDONLY) != stream) _exit(3);
}

void say(std::string_view text) { write_to(stdout, printable_lines(text)); }

void complain(std::string_view text) {
  std::fflush(stdout);
  write_to(stderr, printable_lines(text));
}

void say_with_conclusion(const std::string& text, const std::string& conclusion) {
  const std::string clean = printable_lines(text);
  write_to(stdout, wants_colour(STDOUT_FILENO) ? coloured(clean, printable_lines(conclusion)) : clean);
}

void show_progress(std::string_view text) { write_to(stderr, "\r\033[K" + printable(text)); }

std::string why_unsaid(bool& reader_left) {
  errno = 0;
  if (std::fflush(stdout) != 0 && stdout_error == 0) stdout_error = errno;
  if (std::ferror(stdout) && stdout_error == 0) stdout_error = EIO;
  reader_left = stdout_error == EPIPE;
  return stdout_error == 0 ? "" : std::generic_category().message(stdout_error);
}

bool wants_colour(int file_descriptor) {
  const char* no_colour = std::getenv("NO_COLOR");
  const char* terminal = std::getenv("TERM");
  if (no_colour && *no_colour) return false;
  return isatty(file_descriptor) && terminal && std::string_view(terminal) != "dumb";
}

std::string coloured(std::string text, const std::string& conclusion) {
  if (!conclusion.empty())
    if (const std::size_t at = text.find(conclusion); at != std::string::npos)
      text.replace(at, conclusion.size(), "\033[1m" + conclusion + "\033[0m");
  wrap(text, "INCOMPLETE", "31");
  wrap(text, "NOT confirmed", "33");
  return text;
}

std::function<void(const std::string&)> make_log(bool verbose) {
  if (!verbose) return {};
  const auto logger = std::make_shared<spdlog::logger>("kurbel", std::make_shared<spdlog::sinks::stderr_sink_mt>());
  logger->set_pattern("[%H:%M:%S.%e] %v");
  logger->flush_on(spdlog::level::info);
  return [logger](const std::string& text) { logger->info("{}", printable(text)); };
}

}  // namespace kurbel::app
