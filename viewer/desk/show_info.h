#pragma once

#include <span>
#include <string>
#include <string_view>

#include "radiosity/scene/scene.h"
#include "viewer/desk/look.h"

namespace viewer {

/// How something that can be shown is told to a person.
struct ShowInfo {
  std::string_view name;        ///< as in ShowName
  std::string_view group;       ///< of `show_groups`
  std::string_view caption;     ///< "unshot light at the step"
  std::string_view unit;        ///< per band, wherever a band is no density; "" of plain numbers
  std::string_view definition;  ///< a sentence with the formula
};

/// The groups in which what can be shown is listed.
std::span<const std::string_view> show_groups();
/// Of a name that `show_names` has.
const ShowInfo& show_info(std::string_view name);
/// The caption with the unit: "illuminance (lux)".
std::string caption_with_unit(const ShowInfo& info, const radiosity::Bands& bands);

}  // namespace viewer
