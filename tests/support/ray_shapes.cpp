#include "tests/support/ray_shapes.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace radiosity::test {

void RayShapes::add(std::int32_t face, const Vec3& a, const Vec3& b, const Vec3& d, double most) {
  const Vec3 u = b - a;
  const Vec3 v = d - a;
  const Vec3 cross = u.cross(v);
  if (cross.isZero(0)) return;
  const double square = cross.squaredNorm();
  const Vec3 along_u = v.cross(cross) / square;
  const Vec3 along_v = cross.cross(u) / square;
  const Vec3 normal = cross / std::sqrt(square);
  nx_.push_back(normal.x());
  ny_.push_back(normal.y());
  nz_.push_back(normal.z());
  offset_.push_back(normal.dot(a));
  ux_.push_back(along_u.x());
  uy_.push_back(along_u.y());
  uz_.push_back(along_u.z());
  u0_.push_back(along_u.dot(a));
  vx_.push_back(along_v.x());
  vy_.push_back(along_v.y());
  vz_.push_back(along_v.z());
  v0_.push_back(along_v.dot(a));
  most_.push_back(most);
  face_.push_back(face);
}

void RayShapes::append(const RayShapes& other, std::size_t k) {
  nx_.push_back(other.nx_[k]);
  ny_.push_back(other.ny_[k]);
  nz_.push_back(other.nz_[k]);
  offset_.push_back(other.offset_[k]);
  ux_.push_back(other.ux_[k]);
  uy_.push_back(other.uy_[k]);
  uz_.push_back(other.uz_[k]);
  u0_.push_back(other.u0_[k]);
  vx_.push_back(other.vx_[k]);
  vy_.push_back(other.vy_[k]);
  vz_.push_back(other.vz_[k]);
  v0_.push_back(other.v0_[k]);
  most_.push_back(other.most_[k]);
  face_.push_back(other.face_[k]);
}

void RayShapes::find_hits(const Vec3& origin, const Vec3& direction,
                          std::vector<double>& distances) const {
  const std::size_t n = size();
  distances.resize(n);
  const double ox = origin.x(), oy = origin.y(), oz = origin.z();
  const double dx = direction.x(), dy = direction.y(), dz = direction.z();
  for (std::size_t k = 0; k < n; ++k) {
    const double height = offset_[k] - (nx_[k] * ox + ny_[k] * oy + nz_[k] * oz);
    const double t = height / (nx_[k] * dx + ny_[k] * dy + nz_[k] * dz);
    const double x = ox + t * dx;
    const double y = oy + t * dy;
    const double z = oz + t * dz;
    const double u = ux_[k] * x + uy_[k] * y + uz_[k] * z - u0_[k];
    const double v = vx_[k] * x + vy_[k] * y + vz_[k] * z - v0_[k];
    const bool is_hit = (t > 0) & (u >= 0) & (v >= 0) & (u + v <= most_[k]) & (std::max(u, v) <= 1);
    distances[k] = is_hit ? t : std::numeric_limits<double>::infinity();
  }
}

}  // namespace radiosity::test
