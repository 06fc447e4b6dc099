#include "radiosity/scene/neighbor_groups.h"

#include <algorithm>
#include <numeric>
#include <span>
#include <unordered_map>

#include "radiosity/base/median_split.h"

namespace radiosity {
namespace {

/// Sets of no more items are not divided.
constexpr std::size_t kLargestGroup = 5;
/// Normals of a group may differ this much from item to item, along each axis.
constexpr double kFlatness = 0.3;

/// Something to be grouped.
struct Item {
  Vec3 place;
  Vec3 normal;
  std::int32_t surface;
};

/// Divides sets at the median until they are small and flat.
class GroupDivider {
 public:
  explicit GroupDivider(std::span<const Item> items) : items_(items) {
    groups_.group_of.resize(items.size());
  }

  NeighborGroups run() {
    std::vector<std::int32_t> order(items_.size());
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(), order.end(), [this](std::int32_t a, std::int32_t b) {
      return items_[a].surface < items_[b].surface;
    });
    for (auto first = order.begin(); first != order.end();) {
      const auto last = std::find_if(first, order.end(), [&](std::int32_t i) {
        return items_[i].surface != items_[*first].surface;
      });
      divide({first, last});
      first = last;
    }
    return std::move(groups_);
  }

 private:
  using Set = std::span<std::int32_t>;
  template <typename Value>
  [[nodiscard]] Box3 box_of(Set set, const Value& value) const {
    Box3 box;
    for (const std::int32_t i : set) box.extend(value(items_[i]));
    return box;
  }

  void divide(Set set) {
    const auto normal = [](const Item& item) { return item.normal; };
    const auto place = [](const Item& item) { return item.place; };
    const Box3 normals = box_of(set, normal);
    const bool is_flat = normals.sizes().maxCoeff() <= kFlatness;
    if (is_flat && set.size() <= kLargestGroup) {
      for (const std::int32_t i : set) {
        groups_.group_of[i] = static_cast<std::int32_t>(groups_.n_groups);
      }
      ++groups_.n_groups;
      return;
    }
    int axis = 0;
    if (is_flat) {
      box_of(set, place).sizes().maxCoeff(&axis);
      const auto halves =
          split_at_median(set, [&](std::int32_t i) { return items_[i].place[axis]; });
      for (const Set half : halves) divide(half);
      return;
    }
    // Faces of different directions part in the middle of their range, wherever most of them are.
    normals.sizes().maxCoeff(&axis);
    const double limit = normals.center()[axis];
    const auto middle = std::stable_partition(
        set.begin(), set.end(), [&](std::int32_t i) { return items_[i].normal[axis] < limit; });
    divide({set.begin(), middle});
    divide({middle, set.end()});
  }

  std::span<const Item> items_;
  NeighborGroups groups_;
};

/// One item per group of patches.
std::vector<Item> group_items(const PatchMesh& mesh, const NeighborGroups& groups) {
  std::vector<Item> items(groups.n_groups, Item{Vec3::Zero(), Vec3::Zero(), 0});
  std::vector<double> areas(groups.n_groups, 0);
  for (Index i = 0; i < mesh.size(); ++i) {
    const std::int32_t g = groups.group_of[i];
    items[g].place += mesh.area[i] * mesh.centroid[i];
    items[g].normal += mesh.area[i] * mesh.normal[i];
    items[g].surface = mesh.surface[i];
    areas[g] += mesh.area[i];
  }
  for (Index g = 0; g < groups.n_groups; ++g) {
    items[g].place /= areas[g];
    items[g].normal.normalize();
  }
  return items;
}

}  // namespace

NeighborGroups make_neighbor_groups(const PatchMesh& mesh) {
  std::vector<Item> items;
  std::vector<Index> patches;
  for (Index i = 0; i < mesh.size(); ++i) {
    if (mesh.family[i] >= 0) continue;
    items.push_back({mesh.centroid[i], mesh.normal[i], mesh.surface[i]});
    patches.push_back(i);
  }
  NeighborGroups groups = GroupDivider(items).run();
  std::vector<std::int32_t> group_of(mesh.size());
  for (std::size_t k = 0; k < patches.size(); ++k) group_of[patches[k]] = groups.group_of[k];
  std::unordered_map<std::int32_t, std::int32_t> group_of_family;
  for (Index i = 0; i < mesh.size(); ++i) {
    if (mesh.family[i] < 0) continue;
    const auto [place, is_new] =
        group_of_family.try_emplace(mesh.family[i], static_cast<std::int32_t>(groups.n_groups));
    group_of[i] = place->second;
    groups.n_groups += is_new ? 1 : 0;
  }
  groups.group_of = std::move(group_of);
  return groups;
}

NeighborGroups make_coarser_groups(const PatchMesh& mesh, const NeighborGroups& finer) {
  const std::vector<Item> items = group_items(mesh, finer);
  NeighborGroups groups = GroupDivider(items).run();
  std::vector<std::int32_t> group_of(mesh.size());
  for (Index i = 0; i < mesh.size(); ++i) group_of[i] = groups.group_of[finer.group_of[i]];
  groups.group_of = std::move(group_of);
  return groups;
}

}  // namespace radiosity
