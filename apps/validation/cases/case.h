#pragma once

#include <cstdint>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <variant>
#include <vector>

#include "apps/validation/plot/plot.h"
#include "apps/validation/plot/surface_map.h"
#include "radiosity/base/progress.h"

namespace apps::validation {

/// A figure that a case measured, and what is asked of it.
struct Check {
  enum class Relation { at_most, at_least };
  std::string what;
  double value = 0;
  double tolerance = 0;
  std::string derivation;  ///< why this tolerance
  std::string unit{};      ///< of value and tolerance; empty: none
  Relation relation = Relation::at_most;

  /// NaN never passes.
  [[nodiscard]] bool passed() const {
    return relation == Relation::at_most ? value <= tolerance : value >= tolerance;
  }
};

struct Table {
  std::string title;
  std::vector<std::string> header;
  std::vector<std::vector<std::string>> rows;  ///< each as long as the header
};

using Figure = std::variant<Plot, SurfaceMap, Table>;

/// What a case found. Texts are plain, not HTML.
struct CaseResult {
  std::string compared;   ///< what is compared
  std::string reference;  ///< with what, and from which source
  std::vector<Check> checks{};
  std::vector<std::string> notes{};  ///< data that were left out and why; what to keep in mind
  std::vector<Figure> figures{};
};

/// What all cases work with.
struct Context {
  std::filesystem::path data;    ///< reference data, tests/data of the source
  std::filesystem::path scenes;  ///< scenes/ of the source
  std::uint64_t seed = 0;        ///< of everything sampled
  radiosity::Progress progress{};
};

/// A comparison of the program with something known.
struct Case {
  std::string name;
  std::string title;
  CaseResult (*run)(const Context& context) = nullptr;
};

/// Thrown by a case that cannot be run here; the message says why.
struct Skipped : std::runtime_error {
  using std::runtime_error::runtime_error;
};

}  // namespace apps::validation
