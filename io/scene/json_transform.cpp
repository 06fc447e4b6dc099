#include "io/scene/json_transform.h"

#include <cmath>

#include "io/scene/scene_keys.h"
#include "radiosity/base/geometry.h"

namespace io {
namespace {

using radiosity::kPi;
using radiosity::Vec3;

Eigen::Affine3d read_matrix(const JsonItem& item) {
  if (item.size() != 4) item.fail("expected 4 rows of 4 numbers");
  Eigen::Matrix4d matrix;
  for (int row = 0; row < 4; ++row) {
    if (item[row].size() != 4) item[row].fail("expected 4 numbers");
    for (int column = 0; column < 4; ++column) matrix(row, column) = item[row][column].number();
  }
  if (matrix.row(3) != Eigen::RowVector4d(0, 0, 0, 1)) item[3].fail("expected [0, 0, 0, 1]");
  return Eigen::Affine3d(matrix);
}

Vec3 read_scale(const JsonItem& item) {
  return item.value().is_number() ? Vec3(Vec3::Constant(item.number())) : item.point();
}

Eigen::AngleAxisd read_rotation(const JsonItem& item) {
  item.check_keys(keys::kRotation);
  return {item.at("degrees").number() * kPi / 180, item.at("axis").direction()};
}

}  // namespace

Eigen::Affine3d read_transform(const JsonItem& item) {
  item.check_keys(keys::kTransform);
  Eigen::Affine3d transform = Eigen::Affine3d::Identity();
  if (const auto matrix = item.find("matrix")) {
    if (item.value().size() > 1) item.fail("expected \"matrix\" alone, found other keys beside it");
    transform = read_matrix(*matrix);
  } else {
    if (const auto translate = item.find("translate")) transform.translate(translate->point());
    if (const auto rotate = item.find("rotate")) transform.rotate(read_rotation(*rotate));
    if (const auto scale = item.find("scale")) transform.scale(read_scale(*scale));
  }
  const double determinant = transform.linear().determinant();
  if (determinant == 0 || !std::isfinite(determinant)) {
    item.fail("the transform flattens space, expected one with an inverse");
  }
  return transform;
}

}  // namespace io
