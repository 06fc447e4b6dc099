#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "radiosity/base/geometry.h"
#include "radiosity/operator/factor_rows.h"
#include "radiosity/operator/transport.h"
#include "radiosity/scene/patch_mesh.h"

namespace io {

/// An open form-factor file (.h5) of `write_form_factors`. The patches are read at once, 8 bytes a
/// row are kept of the matrix, and rows are read from the disk when they are asked for, so that its
/// size does not matter. Not for two threads at once.
///
/// All functions throw SceneError naming the file if it is no such file, of a newer version, cut
/// off or damaged; nothing is printed.
class FormFactorReader final : public radiosity::FactorRows {
 public:
  explicit FormFactorReader(const std::filesystem::path& path);
  ~FormFactorReader() override;
  FormFactorReader(FormFactorReader&& other) noexcept;
  FormFactorReader& operator=(FormFactorReader&& other) noexcept;

  /// The patches, as they were written. Of a file of before corners were stored: squares of the
  /// patches' areas about their centroids, without backs, and a warning tells so.
  [[nodiscard]] const radiosity::PatchMesh& mesh() const;
  [[nodiscard]] radiosity::Index size() const { return mesh().size(); }

  /// All finite, none negative.
  [[nodiscard]] Eigen::VectorXd row(radiosity::Index i) const override;
  [[nodiscard]] Eigen::VectorXd row_error(radiosity::Index i) const override;
  [[nodiscard]] radiosity::ExchangeArea pair(radiosity::Index i, radiosity::Index j) const override;
  /// Reads all entries once, to find out whether they are intact as far as checksums tell.
  void check_entries() const;

  /// Row sums before any correction, n values.
  [[nodiscard]] const Eigen::VectorXd& closure() const;
  [[nodiscard]] double tolerance() const;   ///< the relative error that was asked for
  [[nodiscard]] double min_factor() const;  ///< below it pairs were dropped; 0 = none were
  [[nodiscard]] bool closed() const;        ///< whether the scene was taken as closed
  /// Of the patches and options (radiosity::stream_fingerprint); may be empty.
  [[nodiscard]] const std::string& fingerprint() const;
  /// Of the scene's surfaces (FormFactorFileOptions::geometry); may be empty.
  [[nodiscard]] const std::string& geometry() const;
  /// Σ_j F_ij, n: as the operator had them that the entries, perhaps rounded, were taken from.
  [[nodiscard]] Eigen::VectorXd row_sums() const;
  /// How they were made. Files of before it was stored are refused.
  [[nodiscard]] radiosity::AssemblyReport report() const;
  [[nodiscard]] const std::vector<std::string>& warnings() const;

 private:
  struct File;
  std::unique_ptr<File> file_;
};

/// Whether the file has form factors of which all can be read, as far as its checksums tell.
bool has_intact_form_factors(const std::filesystem::path& path);

}  // namespace io
