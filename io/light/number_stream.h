#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "io/base/line_reader.h"

namespace io {

/// The numbers of a text, in lines of any length, apart by blanks or commas.
class NumberStream {
 public:
  /// Goes on behind the reader's line, or with the rest of that line.
  explicit NumberStream(LineReader& lines) : lines_(lines) {}

  /// The next number. `what` names it in the SceneError that is thrown if it is none or not finite.
  double next(std::string_view what);
  /// A whole number from `least` to `most`.
  long next_count(std::string_view what, long least, long most);
  std::vector<double> next_list(std::string_view what, long n);
  /// The next word; empty at the end of the file.
  std::string_view next_word();
  /// SceneError "luminaire.ies:12: message", of the line of the last number.
  [[noreturn]] void fail(const std::string& message) const { lines_.fail(message); }

 private:
  LineReader& lines_;
  std::string_view rest_;
};

}  // namespace io
