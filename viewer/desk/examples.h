#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "viewer/desk/example.h"
#include "viewer/work/worker.h"

namespace viewer {

/// The scenes that come with the program, to be offered: named at once, read and drawn in the
/// background once somebody looks.
class Examples {
 public:
  void find(const std::filesystem::path& folder) { list_ = find_examples(folder); }
  [[nodiscard]] const std::vector<Example>& list() const { return list_; }
  /// The one whose file has that name, without its extension; null if there is none.
  [[nodiscard]] const Example* named(const std::string& name) const;

  /// Begins to read and draw those that have no picture yet, if that has not been begun.
  void look();
  /// Gives up what is not done yet, until somebody looks again.
  void stop();
  /// Takes in what has been done. Whether there was something.
  bool update() { return worker_.deliver(); }
  [[nodiscard]] bool is_busy() const { return worker_.is_busy(); }

 private:
  std::vector<Example> list_;
  bool is_looked_at_ = false;
  Worker worker_;  // last, so that it ends first
};

}  // namespace viewer
