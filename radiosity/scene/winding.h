#pragma once

#include <cstdint>
#include <vector>

#include "radiosity/base/geometry.h"
#include "radiosity/scene/surface_pieces.h"

namespace radiosity {

/// How often a closed piece winds about a point: 1 within a solid, -1 within a hollow, 0 outside.
int winding_number(const SurfacePieces& pieces, const SurfacePiece& piece, const Vec3& point);

/// The same about many points, each in a time that grows with the logarithm of the facets: those
/// far away are taken together, as dipoles, wherever that leaves no doubt about the number. (Barill
/// et al. 2018)
class WindingNumber {
 public:
  /// Both must outlive this.
  WindingNumber(const SurfacePieces& pieces, const SurfacePiece& piece);

  /// winding_number(pieces, piece, point).
  [[nodiscard]] int about(const Vec3& point) const;

 private:
  struct Node {
    std::int32_t begin, end;  // into facets_
    std::int32_t right;       // the left child follows its parent; -1 in a leaf
    Vec3 vector_area;         // m²
    double area;              // of the facets, m²
    Vec3 center;              // of a sphere that holds them, m
    double radius;
  };
  struct Sum {
    double angle = 0;  // steradian
    double error = 0;  // that it may have
  };

  void build(std::int32_t begin, std::int32_t end);
  void add(std::int32_t node, const Vec3& point, double far_radii, Sum& sum) const;

  const SurfacePieces& pieces_;
  const SurfacePiece& piece_;
  Box3 box_;  // around the piece: nothing winds about what is outside
  std::vector<std::int32_t> facets_;
  std::vector<Node> nodes_;
};

}  // namespace radiosity
