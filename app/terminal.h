// terminal.h — how results look on a terminal: colours, one line for scripts, a log on stderr.
#pragma once

#include <functional>
#include <string>

namespace kurbel::app {

// A terminal that shows colours: a tty, without NO_COLOR, that is not "dumb".
bool wants_colour(int file_descriptor);

// Conclusion bold, INCOMPLETE red, NOT confirmed yellow. Changes no width.
std::string coloured(std::string text, const std::string& conclusion);

// A log on stderr with the time of day; empty where it is off.
std::function<void(const std::string&)> make_log(bool verbose);

}  // namespace kurbel::app
