#pragma once

#include <string_view>

namespace apps {

/// Lets all ranks but the first be silent: what they print goes nowhere.
class QuietRank {
 public:
  explicit QuietRank(int rank);
  ~QuietRank();
  QuietRank(const QuietRank&) = delete;
  QuietRank& operator=(const QuietRank&) = delete;

  /// Tells a line on the true stderr all the same.
  void tell(std::string_view line) const;

 private:
  int true_stderr_ = -1;
};

}  // namespace apps
