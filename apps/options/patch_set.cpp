#include "apps/options/patch_set.h"

#include <fmt/format.h>

#include <CLI/StringTools.hpp>
#include <CLI/TypeTools.hpp>
#include <algorithm>

#include "io/base/json_item.h"
#include "radiosity/base/error.h"

namespace apps {
namespace {

[[noreturn]] void refuse_row(const std::string& text, const radiosity::PatchMesh& mesh,
                             const std::string& source) {
  const auto& names = mesh.surface_names;
  const auto nearest =
      std::min_element(names.begin(), names.end(), [&](const auto& a, const auto& b) {
        return io::edit_distance(text, a) < io::edit_distance(text, b);
      });
  throw radiosity::SceneError(
      fmt::format("{}: there is no surface '{}' and no patch of that number; there are {} patches, "
                  "and the nearest surface is '{}'",
                  source, text, mesh.size(), nearest == names.end() ? "" : *nearest));
}

}  // namespace

std::vector<std::int32_t> patches_named(const std::string& text, const radiosity::PatchMesh& mesh,
                                        const std::string& source) {
  std::vector<std::int32_t> patches;
  const auto n = static_cast<std::int32_t>(mesh.size());
  for (std::int32_t i = 0; i < n; ++i) {
    if (mesh.surface_names[mesh.surface[i]] == text) patches.push_back(i);
  }
  if (!patches.empty()) return patches;
  std::int32_t patch = -1;
  if (!CLI::detail::lexical_cast(text, patch) || patch < 0 || patch >= n) {
    refuse_row(text, mesh, source);
  }
  return {patch};
}

}  // namespace apps
