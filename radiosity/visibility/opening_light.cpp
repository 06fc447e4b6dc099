#include "radiosity/visibility/opening_light.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "radiosity/polygon/polygon_quadrature.h"

namespace radiosity {
namespace {

constexpr int kSectors = 8;
constexpr int kEdgesOfSector = 4;
constexpr int kCoarseRule = 3;
constexpr int kFineRule = 4;
constexpr int kMostPartDivisions = 8;
constexpr int kMostCellDivisions = 2;

/// In the opening's own coordinates, around it.
constexpr std::array<std::array<int, 2>, 4> kOpeningCorners = {
    {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}};

using OpeningFunction = std::function<double(const Vec3&)>;

double rule_over(const ConvexPolygon& polygon, int order, const OpeningFunction& f) {
  double sum = 0;
  for_each_quadrature_point(polygon.points(), order,
                            [&](const Vec3& y, double weight) { sum += weight * f(y); });
  return sum;
}

ConvexPolygon polygon_of(std::initializer_list<Vec3> corners) {
  ConvexPolygon result;
  for (const Vec3& corner : corners) result.push_back(corner);
  return result;
}

/// Triangles and quads in four, others in a fan of triangles.
std::vector<ConvexPolygon> quarters(const ConvexPolygon& whole) {
  const auto p = whole.points();
  const auto middle = [&](std::size_t i, std::size_t j) { return Vec3(0.5 * (p[i] + p[j])); };
  if (p.size() == 3) {
    const Vec3 ab = middle(0, 1);
    const Vec3 bc = middle(1, 2);
    const Vec3 ca = middle(2, 0);
    return {polygon_of({p[0], ab, ca}), polygon_of({ab, p[1], bc}), polygon_of({ca, bc, p[2]}),
            polygon_of({ab, bc, ca})};
  }
  if (p.size() == 4) {
    const Vec3 ab = middle(0, 1);
    const Vec3 bc = middle(1, 2);
    const Vec3 cd = middle(2, 3);
    const Vec3 da = middle(3, 0);
    const Vec3 center = 0.5 * (ab + cd);
    return {polygon_of({p[0], ab, center, da}), polygon_of({ab, p[1], bc, center}),
            polygon_of({center, bc, p[2], cd}), polygon_of({da, center, cd, p[3]})};
  }
  std::vector<ConvexPolygon> fan;
  for (std::size_t k = 2; k < p.size(); ++k) fan.push_back(polygon_of({p[0], p[k - 1], p[k]}));
  return fan;
}

/// Adds ∫ f dA of a part; `allowed` is what it may be off for each m².
void integrate_part(const ConvexPolygon& part, double coarse, double allowed, int divisions,
                    const OpeningFunction& f, OpeningMean& sum) {
  const double fine = rule_over(part, kFineRule, f);
  const double change = std::abs(fine - coarse);
  const double area = vector_area(part.points()).norm();
  if (change <= allowed * area || divisions == kMostPartDivisions) {
    sum.value += fine;
    sum.error += change;
    return;
  }
  for (const ConvexPolygon& piece : quarters(part)) {
    integrate_part(piece, rule_over(piece, kCoarseRule, f), allowed, divisions + 1, f, sum);
  }
}

/// A part of an opening in coordinates from 0 to 1: along both sides, or along the radius and
/// around.
struct Cell {
  double u;
  double v;
  double width;
  double height;
};

/// f at a place within a cell, from 0 to 1 both ways, times what a disc's areas grow by outwards.
double value_in(const LuminousOpening& opening, const Cell& cell, double across, double along,
                const OpeningFunction& f) {
  const double u = cell.u + across * cell.width;
  const double v = cell.v + along * cell.height;
  if (!opening.is_round) return f(opening.at(2 * u - 1, 2 * v - 1));
  const double angle = 2 * kPi * v;
  return 2 * u * f(opening.at(u * std::cos(angle), u * std::sin(angle)));
}

/// Gauss' rule of three points a direction, degree 5, against that of degree 3 of the five of its
/// points on the cell's axes, and near by that of two a direction, too. Times the cell's share of
/// the opening.
OpeningMean cell_rule(const LuminousOpening& opening, const Cell& cell, bool is_near,
                      const OpeningFunction& f) {
  const double offset = std::sqrt(0.15);
  const std::array<double, 3> places = {0.5 - offset, 0.5, 0.5 + offset};
  constexpr std::array<double, 3> kWeights = {5. / 18, 8. / 18, 5. / 18};
  double fine = 0;
  double cross = 0;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      const double value = value_in(opening, cell, places[i], places[j], f);
      fine += kWeights[i] * kWeights[j] * value;
      if (i == 1 && j == 1) cross -= value / 9;
      if ((i == 1) != (j == 1)) cross += 5. / 18 * value;
    }
  }
  double change = std::abs(fine - cross);
  if (is_near) {
    double square = 0;
    for (const auto& [u, v] : kOpeningCorners) {
      const double step = 0.5 / std::sqrt(3.);
      square += value_in(opening, cell, 0.5 + step * u, 0.5 + step * v, f) / 4;
    }
    change = std::max(change, std::abs(fine - square));
  }
  const double share = cell.width * cell.height;
  return {share * fine, share * change};
}

/// Of the whole disc.
OpeningMean disc_rule(const LuminousOpening& opening, const OpeningFunction& f) {
  const auto ring = [&](int n, double radius) {
    double sum = 0;
    for (int k = 0; k < n; ++k) {
      const double angle = 2 * kPi * k / n;
      sum += f(opening.at(radius * std::cos(angle), radius * std::sin(angle))) / n;
    }
    return sum;
  };
  const double fine = 0.25 * f(opening.center) + 0.75 * ring(6, std::sqrt(2. / 3));
  return {fine, std::abs(fine - ring(4, std::sqrt(0.5)))};
}

}  // namespace

std::vector<ConvexPolygon> polygons_of(const LuminousOpening& opening, const Vec3& point) {
  std::vector<ConvexPolygon> result;
  if (!opening.is_round) {
    result.emplace_back();
    for (const auto& [u, v] : kOpeningCorners) result.back().push_back(opening.at(u, v) - point);
    return result;
  }
  const double step = 2 * kPi / (kSectors * kEdgesOfSector);
  const double radius = std::sqrt(step / std::sin(step));
  for (int sector = 0; sector < kSectors; ++sector) {
    ConvexPolygon& piece = result.emplace_back();
    piece.push_back(opening.center - point);
    for (int k = 0; k <= kEdgesOfSector; ++k) {
      const double angle = (sector * kEdgesOfSector + k) * step;
      piece.push_back(opening.at(radius * std::cos(angle), radius * std::sin(angle)) - point);
    }
  }
  return result;
}

OpeningMean mean_over_parts(const std::vector<ConvexPolygon>& parts, double whole, double tolerance,
                            const std::function<double(const Vec3&)>& f) {
  std::vector<double> coarse;
  double first = 0;
  for (const ConvexPolygon& part : parts) {
    coarse.push_back(rule_over(part, kCoarseRule, f));
    first += coarse.back();
  }
  OpeningMean sum;
  for (std::size_t k = 0; k < parts.size(); ++k) {
    integrate_part(parts[k], coarse[k], tolerance * first / whole, 0, f, sum);
  }
  return {sum.value / whole, sum.error / whole};
}

OpeningMean mean_over_opening(const LuminousOpening& opening, const OpeningRule& rule,
                              const std::function<double(const Vec3&)>& f) {
  const Cell all{0, 0, 1, 1};
  const OpeningMean first =
      opening.is_round ? disc_rule(opening, f) : cell_rule(opening, all, rule.is_near, f);
  const double allowed = std::max(rule.tolerance * first.value, rule.negligible);
  if (first.error <= allowed) return first;
  OpeningMean sum;
  const std::function<void(const Cell&, int)> divide = [&](const Cell& cell, int divisions) {
    const double width = cell.width / 2;
    const double height = cell.height / 2;
    for (const auto& [u, v] : kOpeningCorners) {
      const Cell quarter{u < 0 ? cell.u : cell.u + width, v < 0 ? cell.v : cell.v + height, width,
                         height};
      const OpeningMean there = cell_rule(opening, quarter, rule.is_near, f);
      if (there.error > allowed * width * height && divisions < kMostCellDivisions) {
        divide(quarter, divisions + 1);
        continue;
      }
      sum.value += there.value;
      sum.error += there.error;
    }
  };
  divide(all, 1);
  return sum;
}

}  // namespace radiosity
