#pragma once

#include <functional>
#include <memory>
#include <string>

#include "radiosity/base/progress.h"
#include "radiosity/operator/transport.h"
#include "radiosity/scene/patch_mesh.h"
#include "radiosity/scene/scene.h"
#include "radiosity/visibility/visibility.h"

namespace study {

/// A scene's patches, and what blocks the light between them.
struct Patches {
  radiosity::PatchMesh mesh;
  radiosity::Visibility visibility;
};

/// What the stages tell on their way, on the thread that they run on. Each may be left out.
struct StudyEvents {
  std::function<void(const std::string&)> warned = {};  ///< one line
  /// The patches are there; what it throws ends the study before the long work.
  std::function<void(const radiosity::Scene&, const Patches&)> divided = {};
  /// Rougher form factors on the way to compressed ones (TransportOptions::rough).
  std::function<void(std::unique_ptr<radiosity::Transport>)> rough = {};
  radiosity::Progress progress = {};

  void warn(const std::string& message) const {
    if (warned) warned(message);
  }
};

}  // namespace study
