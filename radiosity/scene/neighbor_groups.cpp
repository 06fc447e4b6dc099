#include "radiosity/scene/neighbor_groups.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <span>
#include <unordered_map>

#include "radiosity/base/median_split.h"
#include "radiosity/base/parallel.h"

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
    std::vector<Set> sets;
    for (auto first = order.begin(); first != order.end();) {
      const auto last = std::find_if(first, order.end(), [&](std::int32_t i) {
        return items_[i].surface != items_[*first].surface;
      });
      sets.emplace_back(first, last);
      first = last;
    }
    sets = divide_large(std::move(sets));
    // Groups are numbered as if one set were divided after the other.
    std::vector<std::int32_t> n_groups(sets.size(), 0);
    const auto n_sets = static_cast<std::ptrdiff_t>(sets.size());
    parallel_for(n_sets, [&](std::ptrdiff_t k) { divide(sets[k], n_groups[k]); });
    std::vector<std::int32_t> first(sets.size() + 1, 0);
    std::partial_sum(n_groups.begin(), n_groups.end(), first.begin() + 1);
    parallel_for(n_sets, [&](std::ptrdiff_t k) {
      for (const std::int32_t i : sets[k]) groups_.group_of[i] += first[k];
    });
    groups_.n_groups = first.back();
    return std::move(groups_);
  }

 private:
  using Set = std::span<std::int32_t>;
  /// The parts of sets, in their order, none of which has more than some thousand items.
  [[nodiscard]] std::vector<Set> divide_large(std::vector<Set> sets) const {
    constexpr std::size_t kLargest = 16384;
    const auto is_large = [](Set set) { return set.size() > kLargest; };
    while (std::any_of(sets.begin(), sets.end(), is_large)) {
      std::vector<std::array<Set, 2>> halves(sets.size());
      parallel_for(static_cast<std::ptrdiff_t>(sets.size()), [&](std::ptrdiff_t k) {
        halves[k] = is_large(sets[k]) ? split(sets[k]) : std::array<Set, 2>{sets[k], Set()};
      });
      sets.clear();
      for (const auto& both : halves) {
        for (const Set half : both) {
          if (!half.empty()) sets.push_back(half);
        }
      }
    }
    return sets;
  }

  template <typename Value>
  [[nodiscard]] Box3 box_of(Set set, const Value& value) const {
    Box3 box;
    for (const std::int32_t i : set) box.extend(value(items_[i]));
    return box;
  }

  /// Divides a set, counting its groups.
  void divide(Set set, std::int32_t& n_groups) {
    if (set.size() <= kLargestGroup && is_flat(normals_of(set))) {
      for (const std::int32_t i : set) groups_.group_of[i] = n_groups;
      ++n_groups;
      return;
    }
    for (const Set half : split(set)) divide(half, n_groups);
  }

  [[nodiscard]] Box3 normals_of(Set set) const {
    return box_of(set, [](const Item& item) { return item.normal; });
  }
  [[nodiscard]] static bool is_flat(const Box3& normals) {
    return normals.sizes().maxCoeff() <= kFlatness;
  }

  /// The halves of a set that is no group.
  [[nodiscard]] std::array<Set, 2> split(Set set) const {
    const Box3 normals = normals_of(set);
    int axis = 0;
    if (is_flat(normals)) {
      box_of(set, [](const Item& item) { return item.place; }).sizes().maxCoeff(&axis);
      return split_at_median(set, [&](std::int32_t i) { return items_[i].place[axis]; });
    }
    // Faces of different directions part in the middle of their range, wherever most of them are.
    normals.sizes().maxCoeff(&axis);
    const double limit = normals.center()[axis];
    const auto middle = std::stable_partition(
        set.begin(), set.end(), [&](std::int32_t i) { return items_[i].normal[axis] < limit; });
    return {Set(set.begin(), middle), Set(middle, set.end())};
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
