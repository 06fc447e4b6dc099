#pragma once

#include <functional>
#include <optional>
#include <string>

#include "viewer/desk/legend.h"
#include "viewer/desk/region.h"

namespace viewer {

/// A part of the window, pixels from its top left.
struct Box {
  float left = 0;
  float top = 0;
  float width = 0;
  float height = 0;

  [[nodiscard]] float right() const { return left + width; }
  [[nodiscard]] float bottom() const { return top + height; }
  [[nodiscard]] bool overlaps(const Box& other) const;
};

/// Words that lie over the picture; "" where there is nothing to say.
struct PictureWords {
  std::string badge = {};           ///< how far what is shown can be trusted
  bool is_result = false;           ///< it is a result
  std::string pinned = {};          ///< the same of pinned light beside it
  std::string message = {};         ///< what is missing
  bool is_message_central = false;  ///< it is all that is there
  double split = 0;                 ///< of the picture's width: where the light of now begins
  const Legend* legend = nullptr;   ///< or null
};

/// Size of a text, pixels, that is wrapped at a width.
struct TextExtent {
  float width = 0;
  float height = 0;
};
using TextMeasure = std::function<TextExtent(const std::string& text, float width)>;

/// Sizes that texts and margins go by.
struct TextSizes {
  float scale = 1;  ///< relative to a plain screen
  float line = 17;  ///< height of a line, pixels
  TextMeasure measure;
};

/// Around texts on a plate, pixels at scale 1.
inline constexpr float kPlateAcross = 6;
inline constexpr float kPlateAlong = 4;

/// Where the colour bar stands with its words.
struct LegendPlan {
  Box box;
  Box bar;
  float text_width = 0;
  std::size_t n_titles = 0;  ///< lines of the title that there is room for
  bool has_details = true;   ///< what the bar spans, least and greatest

  /// The place on the scale of a height in the window, beyond [0, 1] outside the bar.
  [[nodiscard]] double position(float y) const { return 1 - (y - bar.top) / bar.height; }
};

/// What lies where over the picture: nothing over anything else, and nothing outside. What there is
/// no room for is left out, the axes first and the badge last.
struct PicturePlan {
  std::optional<Box> badge;
  std::optional<Box> pinned;
  std::optional<Box> message;
  std::optional<LegendPlan> legend;
  std::optional<Box> axes;
};
PicturePlan make_picture_plan(const Region& region, const PictureWords& words,
                              const TextSizes& sizes);

/// Whether a box lies within the picture and under none of what is planned there.
bool is_clear(const PicturePlan& plan, const Region& region, const Box& box);

}  // namespace viewer
