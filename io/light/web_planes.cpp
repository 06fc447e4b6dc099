#include "io/light/web_planes.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace io {
namespace {

using radiosity::Index;
using radiosity::kPi;
using radiosity::PhotometricWeb;

double radians(double degrees) { return degrees * kPi / 180; }

}  // namespace

std::string angle_problem(const std::string& what, const std::vector<double>& angles, double least,
                          double most) {
  for (std::size_t k = 0; k < angles.size(); ++k) {
    if (!(angles[k] >= least && angles[k] <= most)) {
      return fmt::format("{} angle {} is outside [{}, {}]", what, angles[k], least, most);
    }
    if (k > 0 && !(angles[k] > angles[k - 1])) {
      return fmt::format("{} angle {} does not follow {}, expected increasing ones", what,
                         angles[k], angles[k - 1]);
    }
  }
  return "";
}

void mirror_planes(double sum, GivenPlanes& given) {
  std::vector<std::pair<double, Index>> all;  // with the column that they have
  for (std::size_t k = 0; k < given.planes.size(); ++k) {
    const double here = given.planes[k];
    all.emplace_back(here, static_cast<Index>(k));
    if (sum - here != here) all.emplace_back(sum - here, static_cast<Index>(k));
  }
  std::sort(all.begin(), all.end());
  Eigen::MatrixXd intensity(given.intensity.rows(), static_cast<Index>(all.size()));
  given.planes.clear();
  for (const auto& [plane, column] : all) {
    intensity.col(static_cast<Index>(given.planes.size())) = given.intensity.col(column);
    given.planes.push_back(plane);
  }
  given.intensity = std::move(intensity);
}

PhotometricWeb make_web(const GivenPlanes& given) {
  PhotometricWeb web{given.type, {}, {}, given.intensity};
  const bool is_c = given.type == PhotometricWeb::Type::c;
  const bool has_horizontal_pole = given.type == PhotometricWeb::Type::b;
  std::vector<double> polar = has_horizontal_pole ? given.planes : given.vertical;
  if (has_horizontal_pole) web.intensity.transposeInPlace();
  for (const double angle : polar) web.polar.push_back(radians(is_c ? angle : angle + 90));
  for (const double angle : has_horizontal_pole ? given.vertical : given.planes) {
    web.azimuth.push_back(radians(angle));
  }
  return web;
}

}  // namespace io
