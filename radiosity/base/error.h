#pragma once

#include <stdexcept>

namespace radiosity {

/// A scene that cannot be read or makes no physical sense. The message names the file and line or
/// item, what was found and what was expected.
struct SceneError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Surfaces that cannot be turned into patches (degenerate, non-manifold, too many).
struct MeshError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// A transport problem that has no solution, or that this program cannot solve.
struct SolveError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// A problem that does not fit into memory, found out before it was begun.
struct MemoryShortage : SolveError {
  using SolveError::SolveError;
};

/// A result that cannot be written.
struct OutputError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Work stopped because the caller asked for it through `Progress::stop`.
struct Interrupted : std::runtime_error {
  Interrupted() : std::runtime_error("interrupted") {}
};

}  // namespace radiosity
