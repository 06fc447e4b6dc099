#include "radiosity/meter/photometer.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "radiosity/polygon/directions_to_polygon.h"
#include "radiosity/polygon/point_to_polygon.h"

namespace radiosity {
namespace {

Eigen::MatrixXd luminous_exitance(const PatchMesh& mesh, std::span<const Lighting> lights,
                                  const Eigen::VectorXd& weights) {
  Eigen::MatrixXd result =
      Eigen::MatrixXd::Zero(mesh.size(), kLightParts * static_cast<Index>(lights.size()));
  for (std::size_t k = 0; k < lights.size(); ++k) {
    const Solution& solution = lights[k].solution;
    const Index first = kLightParts * static_cast<Index>(k);
    result.col(first) = solution.exitance * weights;
    result.col(first + 1) = (solution.radiosity - solution.exitance) * weights;
    if (solution.radiosity_error.size() > 0) {
      result.col(first + 2) = solution.radiosity_error * weights;
    }
  }
  return result;
}

}  // namespace

Photometer::Photometer(const PatchMesh& mesh, std::span<const Lighting> lights,
                       const Eigen::VectorXd& weights)
    : Photometer(mesh, lights, weights, luminous_exitance(mesh, lights, weights)) {}

Photometer::Photometer(const PatchMesh& mesh, std::span<const Lighting> lights,
                       const Eigen::VectorXd& weights, Eigen::MatrixXd exitance)
    : exitance_(std::move(exitance)),
      columns_(exitance_.cols()),
      gather_(mesh, exitance_),
      weights_(weights) {
  for (const Lighting& light : lights) incident_.emplace_back(light.scene, mesh);
}

void Photometer::add_incident(const Vec3& point, const Vec3& normal,
                              Eigen::Ref<Eigen::RowVectorXd> light) const {
  Eigen::VectorXd bands = Eigen::VectorXd::Zero(weights_.size());
  for (std::size_t k = 0; k < incident_.size(); ++k) {
    bands.setZero();
    const double error = incident_[k].add(point, normal, bands);
    const Index first = kLightParts * static_cast<Index>(k);
    light[first] += weights_.dot(bands);
    light[first + 2] += error * weights_.sum();
  }
}

Photometer::Around Photometer::around(const Vec3& point, const Vec3& up, bool is_on_patch,
                                      std::span<const Vec3> directions,
                                      std::span<const Vec3> halves) const {
  const auto n_planes = static_cast<Index>(directions.size());
  const auto n_halves = static_cast<Index>(halves.size());
  Around result{.planes = Eigen::MatrixXd::Zero(n_planes, columns_),
                .cylinder = Eigen::RowVectorXd::Zero(columns_),
                .half_cylinders = Eigen::MatrixXd::Zero(n_halves, columns_)};
  for (const double side : {1.0, -1.0}) {
    if (side < 0 && is_on_patch) continue;
    const Vec3 axis = side * up;
    gather_.look(point, axis, [&](std::int32_t patch, std::span<const Vec3> piece) {
      const Eigen::RowVectorXd luminance = exitance_.row(patch % exitance_.rows()) / kPi;
      for (Index k = 0; k < n_planes; ++k) {
        // π F = ∫ max(0, n·u) dω
        result.planes.row(k) +=
            kPi * point_to_polygon(Vec3::Zero(), directions[k], piece) * luminance;
      }
      result.cylinder += cylinder_integral(piece, axis) / kPi * luminance;
      if (n_halves == 0) return;
      const Vec3 vector = light_vector(piece);
      for (Index k = 0; k < n_halves; ++k) {
        result.half_cylinders.row(k) += halves[k].dot(vector) / kPi * luminance;
      }
    });
  }
  for (Index k = 0; k < n_planes; ++k) {
    Eigen::RowVectorXd row = result.planes.row(k);
    add_incident(point, directions[k], row);
    result.planes.row(k) = row;
  }
  Eigen::RowVectorXd mean = Eigen::RowVectorXd::Zero(columns_);
  const Vec3 first = up.unitOrthogonal();
  const Vec3 second = up.cross(first);
  for (int k = 0; k < kAzimuths; ++k) {
    const double angle = 2 * kPi * k / kAzimuths;
    add_incident(point, std::cos(angle) * first + std::sin(angle) * second, mean);
  }
  mean /= kAzimuths;
  for (Index k = 0; k < columns_; k += kLightParts) {
    mean[k + 2] += square(kPi / kAzimuths) / 3 * mean[k];
  }
  result.cylinder += mean;
  for (Index k = 0; k < n_halves; ++k) {
    Eigen::RowVectorXd ahead = Eigen::RowVectorXd::Zero(columns_);
    Eigen::RowVectorXd behind = ahead;
    add_incident(point, halves[k], ahead);
    add_incident(point, -halves[k], behind);
    result.half_cylinders.row(k) += result.cylinder + (ahead - behind) / kPi;
    for (Index c = 2; c < columns_; c += kLightParts) {
      result.half_cylinders(k, c) += 2 / kPi * behind[c];  // errors add up
    }
  }
  return result;
}

}  // namespace radiosity
