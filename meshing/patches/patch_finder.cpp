#include "meshing/patches/patch_finder.h"

#include <algorithm>

namespace meshing {

using radiosity::Box3;
using radiosity::Index;
using radiosity::PatchMesh;
using radiosity::Vec3;

namespace {

/// Whether a segment meets a box.
bool meets(const Segment& segment, const Box3& box) {
  double enters = 0;
  double leaves = 1;
  for (int axis = 0; axis < 3; ++axis) {
    const double start = segment[0][axis];
    const double way = segment[1][axis] - start;
    const double low = box.min()[axis] - start;
    const double high = box.max()[axis] - start;
    if (way == 0) {
      if (low > 0 || high < 0) return false;
      continue;
    }
    enters = std::max(enters, std::min(low / way, high / way));
    leaves = std::min(leaves, std::max(low / way, high / way));
  }
  return enters <= leaves;
}

}  // namespace

Box3 box_of(const Segment& segment, double margin) {
  Box3 box;
  for (const Vec3& end : segment) box.extend(end);
  return radiosity::grown(box, margin);
}

PatchFinder::PatchFinder(const PatchMesh& mesh, std::span<const std::vector<Segment>> lines,
                         double tolerance)
    : mesh_(mesh), tolerance_(tolerance), boxes_(find_boxes(lines)), tree_(boxes_) {}

std::vector<Box3> PatchFinder::find_boxes(std::span<const std::vector<Segment>> lines) {
  std::vector<Box3> boxes;
  for (Index i = 0; i < mesh_.size(); ++i) {
    if (mesh_.twin[i] >= 0 && mesh_.twin[i] < i) continue;
    if (lines[mesh_.polygon[i]].empty()) continue;
    const Box3 box = patch_box(mesh_, i);
    boxes.push_back(radiosity::grown(box, tolerance_ + kLongestMove * box.diagonal().norm()));
    patch_.push_back(static_cast<std::int32_t>(i));
  }
  return boxes;
}

std::vector<std::int32_t> PatchFinder::near(const Vec3& point, std::int32_t polygon) const {
  std::vector<std::int32_t> patches;
  tree_.for_each_meeting(Box3(point, point), [&](std::int32_t k) {
    if (mesh_.polygon[patch_[k]] == polygon) patches.push_back(patch_[k]);
  });
  std::sort(patches.begin(), patches.end());
  return patches;
}

std::vector<std::int32_t> PatchFinder::near(const Segment& segment, std::int32_t polygon) const {
  std::vector<std::int32_t> patches;
  // Crossings of lines are off them by rounding.
  const double margin = 2 * tolerance_;
  // A slanted segment misses most of what its box meets.
  tree_.for_each_meeting(box_of(segment, margin), [&](std::int32_t k) {
    if (mesh_.polygon[patch_[k]] != polygon) return;
    if (meets(segment, radiosity::grown(boxes_[k], margin))) patches.push_back(patch_[k]);
  });
  std::sort(patches.begin(), patches.end());
  return patches;
}

}  // namespace meshing
