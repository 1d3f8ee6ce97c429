// terminal.h — all that the program says goes through here: results, complaints, colours, a log.
#pragma once

#include <functional>
#include <string>
#include <string_view>

namespace kurbel::app {

// A stream that was closed would be the next file that is opened, and what is printed would go into it. Called first.
void open_standard_streams();

// On stdout and stderr. No terminal obeys what stands in a name or a title, and nothing throws: whether all of it could
// be written is asked once, at the end.
void say(std::string_view text);
void complain(std::string_view text);
// A table, in colours where the terminal shows them.
void say_with_conclusion(const std::string& text, const std::string& conclusion);
// A line on stderr that the next one is written over; empty: none any more.
void show_progress(std::string_view text);

// Why stdout did not take all that was said; empty: it did. Its reader may have gone on purpose: then `reader_left`.
std::string why_unsaid(bool& reader_left);

// A terminal that shows colours: a tty, without NO_COLOR, that is not "dumb".
bool wants_colour(int file_descriptor);

// Conclusion bold, INCOMPLETE red, NOT confirmed yellow. Changes no width.
std::string coloured(std::string text, const std::string& conclusion);

// A log on stderr with the time of day; empty where it is off.
std::function<void(const std::string&)> make_log(bool verbose);

}  // namespace kurbel::app
