#include "radiosity/exchange/cut_off.h"

#include <algorithm>
#include <array>
#include <vector>

#include "radiosity/base/parallel.h"
#include "radiosity/polygon/exchange_area.h"

namespace radiosity {
namespace {

/// Relative error of the bounds: they are no more than that.
constexpr double kBoundTolerance = 1e-6;

/// A box in the coordinates of a basis: the translations, and what is across them.
struct Prism {
  Eigen::Matrix3d basis;
  Box3 box;

  [[nodiscard]] Vec3 corner(const Vec3& coordinates) const { return basis * coordinates; }
};

Eigen::Matrix3d basis_of(const std::vector<Symmetry::Translation>& translations) {
  Eigen::Matrix3d basis;
  basis.col(0) = translations[0].step;
  if (translations.size() == 1) {
    basis.col(1) = basis.col(0).unitOrthogonal();
    basis.col(2) = basis.col(0).cross(basis.col(1)).normalized();
  } else {
    basis.col(1) = translations[1].step;
    basis.col(2) = basis.col(0).cross(basis.col(1)).normalized();
  }
  return basis;
}

/// That of the images that are reckoned with, up to where the next ones begin.
Prism find_prism(const PatchMesh& part, const Symmetry& symmetry) {
  Prism prism{basis_of(symmetry.translations), {}};
  const Eigen::Matrix3d inverse = prism.basis.inverse();
  Symmetry others = symmetry;
  others.translations.clear();
  std::vector<Motion> motions = image_motions(others);
  motions.push_back({});
  for (const Motion& motion : motions) {
    for (const Vec3& vertex : part.vertices) prism.box.extend(inverse * motion(vertex));
  }
  const Box3 cell = prism.box;
  for (std::size_t k = 0; k < symmetry.translations.size(); ++k) {
    const auto axis = static_cast<Index>(k);
    const double next = symmetry.translations[k].n_images + 1;
    prism.box.min()[axis] = cell.max()[axis] - next;
    prism.box.max()[axis] = cell.min()[axis] + next;
  }
  return prism;
}

/// The ends of the prism, facing inwards.
std::vector<std::array<Vec3, 4>> ends_of(const Prism& prism, std::size_t n_translations) {
  std::vector<std::array<Vec3, 4>> ends;
  for (std::size_t k = 0; k < n_translations; ++k) {
    const auto axis = static_cast<Index>(k);
    const Index u = (axis + 1) % 3;
    const Index v = (axis + 2) % 3;
    for (const double place : {prism.box.min()[axis], prism.box.max()[axis]}) {
      std::array<Vec3, 4> end;
      for (int corner = 0; corner < 4; ++corner) {
        Vec3 coordinates;
        coordinates[axis] = place;
        coordinates[u] = corner == 1 || corner == 2 ? prism.box.max()[u] : prism.box.min()[u];
        coordinates[v] = corner >= 2 ? prism.box.max()[v] : prism.box.min()[v];
        end[corner] = prism.corner(coordinates);
      }
      if (vector_area(end).dot(prism.corner(prism.box.center()) - end[0]) < 0) {
        std::swap(end[1], end[3]);
      }
      ends.push_back(end);
    }
  }
  return ends;
}

}  // namespace

Eigen::VectorXd cut_off_bound(const PatchMesh& part, const Symmetry& symmetry) {
  Eigen::VectorXd bound = Eigen::VectorXd::Zero(part.size());
  if (symmetry.translations.empty()) return bound;
  const Prism prism = find_prism(part, symmetry);
  const auto ends = ends_of(prism, symmetry.translations.size());
  const double least_area = square(plane_thickness(part));
  parallel_for(part.size(), [&](Index i) {
    std::vector<Vec3> corners;
    for (int k = 0; k < part.n_corners(i); ++k) corners.push_back(part.corner(i, k));
    for (const auto& end : ends) {
      if (vector_area(end).norm() <= least_area) continue;  // all in one plane: nothing is seen
      bound[i] += exchange_area(corners, end, kBoundTolerance) / part.area[i];
    }
    bound[i] = std::min(bound[i], 1.0);
  });
  return bound;
}

}  // namespace radiosity
