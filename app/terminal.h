// terminal.h — all output of the program: results, error messages, colours, log.
#pragma once

#include <functional>
#include <string>
#include <string_view>

namespace kurbel::app {

// Opens standard streams that are closed: else the next opened file takes their place and receives output. Called first.
void open_standard_streams();

// On stdout and stderr. Control characters in names and titles are not passed to the terminal, and nothing throws:
// write errors are checked once, at the end.
void say(std::string_view text);
void complain(std::string_view text);
// A table, in colours where the terminal shows them.
void say_with_conclusion(const std::string& text, const std::string& conclusion);
// A line on stderr that the next one overwrites; empty: removes it.
void show_progress(std::string_view text);

// Why stdout did not take all output; empty: it did. `reader_left`: the pipe was closed by its reader, perhaps on purpose.
std::string why_unsaid(bool& reader_left);

// A terminal that shows colours: a tty, without NO_COLOR, that is not "dumb".
bool wants_colour(int file_descriptor);

// Conclusion bold, INCOMPLETE red, NOT confirmed yellow. Changes no width.
std::string coloured(std::string text, const std::string& conclusion);

// A log on stderr with the time of day; an empty function if it is off.
std::function<void(const std::string&)> make_log(bool verbose);

}  // namespace kurbel::app
