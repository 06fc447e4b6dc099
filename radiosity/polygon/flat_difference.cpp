#include "radiosity/polygon/flat_difference.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace radiosity {
namespace {

/// The line through an edge; on its left is the polygon's inside.
struct EdgeLine {
  Point2 start;
  Point2 along;  // unit
  [[nodiscard]] double height(const Point2& point) const { return cross2(along, point - start); }
};

EdgeLine edge_line(const FlatPolygon& polygon, std::size_t k) {
  const Point2& start = polygon[k];
  const Point2& end = polygon[k + 1 < polygon.size() ? k + 1 : 0];
  return {start, (end - start).normalized()};
}

/// How far the corners of a part are on the left of a line.
struct PartHeights {
  std::vector<double> of_corner;
  bool any_left = false;
  bool any_right = false;

  PartHeights(const FlatPolygon& part, const EdgeLine& line, double margin) {
    for (const Point2& corner : part) {
      const double height = line.height(corner);
      of_corner.push_back(std::abs(height) <= margin ? 0 : height);
      any_left |= of_corner.back() > 0;
      any_right |= of_corner.back() < 0;
    }
  }
};

/// What of a part is on the left (sign 1) or right (-1) of the line that the heights are of.
FlatPolygon side_of(const FlatPolygon& part, const PartHeights& heights, double sign) {
  FlatPolygon result;
  for (std::size_t k = 0; k < part.size(); ++k) {
    const std::size_t next = k + 1 < part.size() ? k + 1 : 0;
    const double height = heights.of_corner[k];
    const double height_next = heights.of_corner[next];
    if (sign * height >= 0) result.push_back(part[k]);
    if (height * height_next < 0) {
      const double s = height / (height - height_next);
      result.push_back(part[k] + s * (part[next] - part[k]));
    }
  }
  return result;
}

/// Whether one edge of the polygon has the whole part outside.
bool is_missed(const FlatPolygon& part, const std::vector<EdgeLine>& lines, double margin) {
  return std::any_of(lines.begin(), lines.end(), [&](const EdgeLine& line) {
    return std::all_of(part.begin(), part.end(),
                       [&](const Point2& corner) { return line.height(corner) <= margin; });
  });
}

/// Appends what the polygon leaves of a part.
void add_rest(FlatPolygon part, const std::vector<EdgeLine>& lines, double margin,
              std::vector<FlatPolygon>& rests) {
  if (is_missed(part, lines, margin)) {
    rests.push_back(std::move(part));
    return;
  }
  const std::size_t first = rests.size();
  FlatPolygon inside = part;
  for (const EdgeLine& line : lines) {
    const PartHeights heights(inside, line, margin);
    if (!heights.any_left) {  // nothing is taken away
      rests.resize(first);
      rests.push_back(std::move(part));
      return;
    }
    if (!heights.any_right) continue;
    rests.push_back(side_of(inside, heights, -1));
    inside = side_of(inside, heights, 1);
  }
}

}  // namespace

double flat_area(const FlatPolygon& polygon) {
  double sum = 0;
  for (std::size_t k = 2; k < polygon.size(); ++k) {
    sum += cross2(polygon[k - 1] - polygon[0], polygon[k] - polygon[0]);
  }
  return 0.5 * sum;
}

bool holds(const FlatPolygon& polygon, const Point2& point, double margin) {
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    if (edge_line(polygon, k).height(point) < -margin) return false;
  }
  return true;
}

void subtract(const FlatPolygon& polygon, double margin, std::vector<FlatPolygon>& parts) {
  std::vector<EdgeLine> lines;
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const EdgeLine line = edge_line(polygon, k);
    if (line.along.squaredNorm() > 0) lines.push_back(line);
  }
  std::vector<FlatPolygon> rests;
  for (FlatPolygon& part : parts) add_rest(std::move(part), lines, margin, rests);
  parts = std::move(rests);
}

}  // namespace radiosity
