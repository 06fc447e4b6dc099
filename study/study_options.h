#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>

#include "meshing/patches/patches.h"
#include "radiosity/assembly/transport_options.h"
#include "radiosity/base/work_stamp.h"
#include "radiosity/compressed/make_transport.h"
#include "radiosity/scene/scene.h"
#include "radiosity/solve/solution.h"

namespace study {

/// Where form factors are kept, which decides how many patches can be.
enum class Storage {
  memory,  ///< one operator (`radiosity::make_transport`)
  disk     ///< a work file (`radiosity::StreamedFactors`): memory is for the patches only
};

/// How a scene is divided and how exactly it is solved.
struct StudyOptions {
  meshing::PatchChoice patches = {};
  double tolerance = 1e-2;                      ///< relative error asked of the result, > 0
  std::optional<double> factor_tolerance = {};  ///< of the form factors; absent: `tolerance`
  /// Whether the surfaces enclose the space that they light; automatic = what the scene says, else
  /// found out from the form factors.
  radiosity::Closed closed = radiosity::Closed::automatic;
  std::uint64_t seed = 0;  ///< of the visibility samples
  Storage storage = Storage::memory;
  /// If it is in memory; with adaptive patches, in each of their rounds.
  radiosity::TransportKind transport = radiosity::TransportKind::automatic;
  /// Bytes for the form factors; 0 = what the machine has, or half of that for those on disk.
  std::size_t memory = 0;
  /// Where compressed form factors keep what is done, and whether what is there is gone on with, as
  /// in radiosity::TransportOptions.
  std::filesystem::path work_file = {};
  radiosity::WorkStart work_start = radiosity::WorkStart::anew;
  /// Whether what a compressed operator gives for the scene's light is checked anew, as where it
  /// was made for another (radiosity::verify_light).
  bool verifies_light = false;
  /// The processes that work on it together (TransportOptions::ranks); null: this one alone.
  radiosity::Ranks* ranks = nullptr;
  radiosity::Method method = radiosity::Method::conjugate_gradients;  ///< of the iteration
  radiosity::LinearSolver solver = {};                                ///< for Method::external
};

/// What the options and the scene's own word on being closed come to.
radiosity::Closed closedness(const radiosity::Scene& scene, radiosity::Closed asked);

/// The relative error that is asked of the form factors.
double factor_tolerance(const StudyOptions& options);

/// How an operator in memory is to be kept, by these options: dense if the scene is symmetric.
/// Throws SolveError if it is and shall be compressed, and of what several ranks cannot do:
/// methods that go by rows, adaptive patches.
radiosity::TransportChoice transport_choice(const radiosity::Scene& scene,
                                            const StudyOptions& options);

/// The tolerance of the iteration: it shall add nothing to the error of the form factors, and
/// digits cost it little.
double iteration_tolerance(double tolerance);

}  // namespace study
