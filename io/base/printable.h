#pragma once

#include <string>
#include <string_view>

namespace io {

/// `text` as it may go to a terminal, in one line: without what a terminal would obey or what would
/// show it other than it is (control characters C0, DEL and C1, raw or in UTF-8; line and paragraph
/// separators; marks that reverse the direction of writing; bytes that are no UTF-8). Each of them
/// becomes a space or, where it is no space, "?". Words of more than 240 bytes are cut in their
/// middle, texts of more than 2,000 at their end, so that what a file holds never fills the screen.
std::string printable(std::string_view text);

/// A JSON text that means the same, but for a terminal: the same characters, which can only stand
/// within its strings, are escaped ("\\u009b"). `text` is UTF-8.
std::string printable_json(std::string_view text);

/// A word that a file has, for a message that tells what was found: in quotes, printable, and cut
/// after 40 bytes.
std::string in_quotes(std::string_view word);

}  // namespace io
