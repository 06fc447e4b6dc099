#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>

#include "radiosity/assembly/transport_options.h"
#include "radiosity/base/work_part.h"
#include "radiosity/compressed/make_compressed_transport.h"
#include "radiosity/scene/patch_mesh.h"

namespace io {

/// Version of the layout of parts, to be raised when an older reader would misread it.
inline constexpr std::int64_t kPartVersion = 1;

/// Which part of which form factors a file holds, and all that it takes to make them whole.
struct FactorPart {
  radiosity::WorkPart part;
  bool is_compressed = false;
  std::string scene;        ///< the name of its file, for messages
  std::string program;      ///< version of the program that made it, likewise
  std::string geometry;     ///< of the scene's surfaces (study::geometry_fingerprint)
  std::string fingerprint;  ///< of the whole computation
  double tolerance = 1e-3;  ///< relative error asked of the form factors
  radiosity::Closed closed = radiosity::Closed::automatic;
  std::uint64_t seed = 0;
  double min_factor = 0;           ///< of those that are not compressed
  radiosity::ExpectedLight light;  ///< of compressed ones
};

/// Writes a part of form factors to an HDF5 file: /records, the bytes of its work file's records,
/// which `visit_records` hands over; patches, surfaces and polygons as write_form_factors has them;
/// the rest as attributes and /light. Beside and renamed into place. Throws OutputError (a full
/// disk, say), Interrupted.
void write_part(const std::filesystem::path& path, const radiosity::PatchMesh& mesh,
                const FactorPart& part,
                const std::function<void(const radiosity::RecordVisitor&)>& visit_records);

/// An open file of write_part. All functions throw SceneError naming the file if it is none, of a
/// newer version, cut off or damaged.
class PartReader {
 public:
  explicit PartReader(const std::filesystem::path& path);
  ~PartReader();
  PartReader(PartReader&& other) noexcept;
  PartReader& operator=(PartReader&& other) noexcept;

  [[nodiscard]] const std::filesystem::path& path() const;
  [[nodiscard]] const FactorPart& part() const;  ///< without `light`
  [[nodiscard]] radiosity::PatchMesh read_mesh() const;
  [[nodiscard]] radiosity::ExpectedLight read_light() const;
  /// Visits the bytes of all records, in pieces that need not end where a record does.
  void visit_records(const radiosity::RecordVisitor& visit) const;

 private:
  struct File;
  std::unique_ptr<File> file_;
};

/// Whether the file is that part of that computation, whole and intact.
bool has_intact_part(const std::filesystem::path& path, radiosity::WorkPart part,
                     const std::string& fingerprint);

}  // namespace io
