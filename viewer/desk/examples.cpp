#include "viewer/desk/examples.h"

#include <exception>
#include <utility>

#include "io/scene/scene_file.h"
#include "radiosity/base/error.h"

namespace viewer {
namespace {

/// Tells the name first, then the picture. One that cannot be read has neither.
template <typename Tell>
void read_example(Example example, const radiosity::Progress& progress, const Tell& tell) {
  try {
    const radiosity::Scene scene = io::read_scene(example.path, {.progress = progress});
    if (!scene.name.empty()) example.name = scene.name;
    example.description = scene.description;
    tell(example);
    example.picture = std::make_shared<const io::RgbPicture>(example_picture(scene, progress));
    tell(example);
  } catch (const radiosity::Interrupted&) {
    throw;
  } catch (const std::exception&) {
    // Whoever opens it is told why.
  }
}

}  // namespace

const Example* Examples::named(const std::string& name) const {
  for (const Example& example : list_) {
    if (std::filesystem::path(example.path).stem() == name) return &example;
  }
  return nullptr;
}

void Examples::look() {
  if (std::exchange(is_looked_at_, true) || list_.empty()) return;
  worker_.start([this, list = list_](const Worker::Context& context) {
    for (std::size_t k = 0; k < list.size(); ++k) {
      if (list[k].picture) continue;
      read_example(list[k], context.progress, [&](const Example& read) {
        context.post([this, k, read] { list_[k] = read; });
      });
    }
  });
}

void Examples::stop() {
  if (!worker_.is_busy()) return;
  worker_.cancel();
  is_looked_at_ = false;
}

}  // namespace viewer
