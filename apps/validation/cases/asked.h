#pragma once

namespace apps::validation {

/// What cases ask of the library, where what it promises does not depend on the scene.
inline constexpr double kAskedOfSolver = 1e-8;    ///< SolveOptions::tolerance
inline constexpr double kAskedOfFactors = 1e-9;   ///< unobstructed pairs
inline constexpr double kAskedOfRowSums = 1e-10;  ///< docs/command-line.md: rows of closed scenes

}  // namespace apps::validation
