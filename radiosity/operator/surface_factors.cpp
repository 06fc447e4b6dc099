#include "radiosity/operator/surface_factors.h"

#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

namespace radiosity {
namespace {

/// Which surface each patch belongs to, as columns of 0 and 1.
Eigen::MatrixXd members(const PatchMesh& mesh) {
  const auto n_surfaces = static_cast<Index>(mesh.surface_names.size());
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(mesh.size(), n_surfaces);
  for (Index i = 0; i < mesh.size(); ++i) result(i, mesh.surface[i]) = 1;
  return result;
}

Eigen::MatrixXd divided_by_areas(const PatchMesh& mesh, Eigen::MatrixXd rows) {
  const Eigen::VectorXd areas = surface_areas(mesh);
  for (Index s = 0; s < rows.rows(); ++s) {
    if (areas[s] > 0) rows.row(s) /= areas[s];
  }
  return rows;
}

/// Whether a patch of a surface is in front of another one of it.
bool sees_itself(const PatchMesh& mesh, std::int32_t surface, double thickness) {
  std::vector<Index> patches;
  for (Index i = 0; i < mesh.size(); ++i) {
    if (mesh.surface[i] == surface) patches.push_back(i);
  }
  constexpr double kSameNormal = 1e-12;
  Index last = -1;
  for (const Index i : patches) {
    const auto height = [&](const Vec3& point) {
      return mesh.normal[i].dot(point - mesh.centroid[i]);
    };
    // Most patches lie in the plane of the one before.
    if (last >= 0 && (mesh.normal[i] - mesh.normal[last]).norm() <= kSameNormal &&
        std::abs(height(mesh.centroid[last])) <= thickness) {
      continue;
    }
    last = i;
    for (const Index j : patches) {
      for (int k = 0; k < mesh.n_corners(j); ++k) {
        if (height(mesh.corner(j, k)) > thickness) return true;
      }
    }
  }
  return false;
}

}  // namespace

Eigen::VectorXd surface_areas(const PatchMesh& mesh) {
  Eigen::VectorXd areas = Eigen::VectorXd::Zero(static_cast<Index>(mesh.surface_names.size()));
  for (Index i = 0; i < mesh.size(); ++i) areas[mesh.surface[i]] += mesh.area[i];
  return areas;
}

Eigen::MatrixXd surface_form_factors(const PatchMesh& mesh, const Transport& transport) {
  const Eigen::MatrixXd reached = transport.apply(members(mesh));
  Eigen::MatrixXd exchange = Eigen::MatrixXd::Zero(reached.cols(), reached.cols());
  for (Index i = 0; i < mesh.size(); ++i) {
    exchange.row(mesh.surface[i]) += mesh.area[i] * reached.row(i);
  }
  // What keeps the row sums of rounded entries is light that patches would send to themselves.
  const double thickness = plane_thickness(mesh);
  for (std::int32_t s = 0; s < exchange.rows(); ++s) {
    if (exchange(s, s) != 0 && !sees_itself(mesh, s, thickness)) exchange(s, s) = 0;
  }
  return divided_by_areas(mesh, std::move(exchange));
}

Eigen::MatrixXd surface_form_factor_errors(const PatchMesh& mesh, const Transport& transport) {
  const Eigen::MatrixXd error = transport.apply_error(members(mesh));
  Eigen::MatrixXd variances = Eigen::MatrixXd::Zero(error.cols(), error.cols());
  for (Index i = 0; i < mesh.size(); ++i) {
    variances.row(mesh.surface[i]) += (mesh.area[i] * error.row(i)).cwiseAbs2();
  }
  variances.diagonal() *= 2;
  return divided_by_areas(mesh, variances.cwiseSqrt());
}

SurfaceFactorSums::SurfaceFactorSums(const PatchMesh& mesh)
    : mesh_(mesh),
      exchange_(Eigen::MatrixXd::Zero(static_cast<Index>(mesh.surface_names.size()),
                                      static_cast<Index>(mesh.surface_names.size()))) {}

void SurfaceFactorSums::add_row(Index i, const Eigen::VectorXd& row) {
  const std::int32_t from = mesh_.surface[i];
  for (Index j = 0; j < row.size(); ++j) {
    exchange_(from, mesh_.surface[j]) += mesh_.area[i] * row[j];
  }
}

Eigen::MatrixXd SurfaceFactorSums::factors() const { return divided_by_areas(mesh_, exchange_); }

}  // namespace radiosity
