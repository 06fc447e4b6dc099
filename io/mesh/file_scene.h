#pragma once

#include <string>
#include <vector>

#include "radiosity/scene/scene.h"

namespace io {

/// Whether whoever reads a mesh file wants its materials. If not, a missing .mtl is no fault.
enum class MeshMaterials { wanted, not_needed };

/// A scene as a file gives it.
struct FileScene {
  radiosity::Scene scene;
  /// Faults of the file that were read all the same, one line each: what, where, and what was made
  /// of it. `read_scene` makes them warnings, or refuses the first.
  std::vector<std::string> repairs;
};

/// Faults of one kind in a file: the first is described, the others are counted.
class RepairCount {
 public:
  /// `where` and `what` of the first: "room.obj:12", "usemtl names no material".
  void add(const std::string& where, const std::string& what) {
    if (n_++ == 0) first_ = where + ": " + what;
  }
  /// Appends the line to `repairs` if there were any; `consequence` completes it.
  void report(const std::string& consequence, std::vector<std::string>& repairs) const {
    if (n_ == 0) return;
    const std::string more = n_ > 1 ? " (and " + std::to_string(n_ - 1) + " more like this)" : "";
    repairs.push_back(first_ + more + "; " + consequence);
  }
  [[nodiscard]] bool empty() const { return n_ == 0; }

 private:
  long n_ = 0;
  std::string first_;
};

}  // namespace io
