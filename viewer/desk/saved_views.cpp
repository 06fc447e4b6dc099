#include "viewer/desk/saved_views.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

namespace viewer {
namespace {

auto found(const std::vector<SavedView>& views, const std::string& name) {
  return std::find_if(views.begin(), views.end(),
                      [&](const SavedView& view) { return view.name == name; });
}

}  // namespace

void save_view(std::vector<SavedView>& views, const std::string& name,
               const radiosity::Camera& camera) {
  if (name.empty()) throw std::invalid_argument("a view needs a name");
  const auto place = found(views, name);
  if (place == views.end()) {
    views.push_back({name, camera});
  } else {
    views[static_cast<std::size_t>(place - views.begin())].camera = camera;
  }
}

const SavedView& view_named(const std::vector<SavedView>& views, const std::string& name) {
  const auto place = found(views, name);
  if (place != views.end()) return *place;
  std::string names;
  for (const SavedView& view : views) names += fmt::format(" '{}'", view.name);
  throw std::invalid_argument(
      fmt::format("no view is called '{}'; there are{}", name, names.empty() ? " none" : names));
}

void forget_view(std::vector<SavedView>& views, const std::string& name) {
  view_named(views, name);
  views.erase(found(views, name));
}

std::string free_view_name(const std::vector<SavedView>& views) {
  for (std::size_t k = views.size() + 1;; ++k) {
    const std::string name = fmt::format("view {}", k);
    if (found(views, name) == views.end()) return name;
  }
}

}  // namespace viewer
