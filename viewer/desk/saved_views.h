#pragma once

#include <string>
#include <vector>

#include "radiosity/scene/scene.h"

namespace viewer {

/// A camera that is kept, also in the scene when that is saved.
using SavedView = radiosity::View;

/// Keeps a camera by that name; one that has it is replaced. Throws std::invalid_argument if the
/// name is empty.
void save_view(std::vector<SavedView>& views, const std::string& name,
               const radiosity::Camera& camera);
/// Throws std::invalid_argument, with the names that there are, if none is called so.
const SavedView& view_named(const std::vector<SavedView>& views, const std::string& name);
/// Throws likewise.
void forget_view(std::vector<SavedView>& views, const std::string& name);
/// "view 1", or the first such name that is free.
std::string free_view_name(const std::vector<SavedView>& views);

}  // namespace viewer
