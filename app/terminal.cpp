// terminal.cpp — colours, one-line results, log.
#include "app/terminal.h"

#include <fmt/format.h>
#include <spdlog/sinks/stdout_sinks.h>
#include <spdlog/spdlog.h>
#include <unistd.h>

#include <cstdlib>
#include <memory>
#include <string_view>

#include "engine/units.h"

namespace kurbel::app {
namespace {

void wrap(std::string& text, std::string_view what, std::string_view code) {
  if (what.empty()) return;
  for (std::size_t at = text.find(what); at != std::string::npos;) {
    const std::string with = fmt::format("\033[{}m{}\033[0m", code, what);
    text.replace(at, what.size(), with);
    at = text.find(what, at + with.size());
  }
}

}  // namespace

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
  return [logger](const std::string& text) { logger->info("{}", text); };
}

}  // namespace kurbel::app
