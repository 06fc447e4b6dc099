#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "io/picture/color_map.h"
#include "radiosity/base/geometry.h"
#include "radiosity/scene/scene.h"
#include "radiosity/solve/quantity.h"
#include "viewer/desk/hidden_surfaces.h"
#include "viewer/work/known.h"
#include "viewer/work/session.h"

namespace viewer {

/// What the patches' colours show.
enum class Show {
  true_color,    ///< the light as the eye would see it
  work_plane,    ///< what arrives at a work plane, before the light or what there is of it
  grid,          ///< the same on a grid of the scene
  quantity,      ///< a quantity of the solution
  area,          ///< of the patches
  unseen,        ///< share of each patch's form factors that is missing to 1
  direct,        ///< irradiance straight from the emitters
  indirect,      ///< irradiance by way of reflections
  form_factors,  ///< the row of the selected patch
  arriving,      ///< what each patch sends to the selected patch
  light_path,    ///< what each patch's exitance contributes to the selected patch, by all ways
  watched,       ///< radiosity at a step of the recorded iteration, in true colour
  unshot         ///< light not passed on yet at that step
};

/// Which of the scene's grids is shown, and what of it.
struct GridChoice {
  std::size_t grid = 0;        ///< of the scene's plan
  std::size_t quantity = 0;    ///< of those it measures: 0 = the illuminance of its plane
  bool is_maintained = false;  ///< by lamps that have aged; false: by new ones

  friend bool operator==(const GridChoice&, const GridChoice&) = default;
};

/// How later light is compared with light that was pinned.
enum class Comparison {
  none,
  wipe,       ///< side by side, in two parts of the picture
  difference  ///< now minus pinned
};

/// How the scene is drawn.
struct Look {
  Show show = Show::true_color;
  radiosity::Quantity quantity = radiosity::Quantity::illuminance;  ///< if show is `quantity`
  std::optional<radiosity::Index> band = {};  ///< of what has bands; absent: their mean
  bool logarithmic = false;
  std::optional<io::ColorScale> range = {};  ///< absent: one that fits
  io::ScaleChoice fit = {};                  ///< which values a range that fits spans
  io::ColorMap map = io::ColorMap::viridis;
  bool isolines = false;  ///< of what is smooth
  bool numbers = false;   ///< at the points of a work plane
  double stops = 0;       ///< exposure beyond the automatic one, in powers of 2
  bool smooth = true;
  bool edges = false;
  bool outlines = true;  ///< of surfaces, under false colours
  bool hide_backs = true;
  bool back_outlines = true;  ///< of faces whose backs are hidden
  bool axes = true;           ///< in a corner
  bool luminaires = true;     ///< marks where they are and aim
  bool polar_curves = false;  ///< of all of them
  HiddenSurfaces hidden = {};
  GridChoice grid = {};
  std::optional<double> tick_spacing = {};  ///< of a linear bar's values; absent: one that fits
  std::size_t step = 0;                     ///< frame of the recorded iteration
  Comparison comparison = Comparison::none;
};

/// What can be shown, with the name that scripts use ("true-colour", "illuminance",
/// "form-factors").
struct ShowName {
  std::string_view name;
  Show show = Show::true_color;
  radiosity::Quantity quantity = radiosity::Quantity::radiosity;
};
std::span<const ShowName> show_names();
/// Empty if there is no such name; "color" and underscores are understood, too.
std::optional<ShowName> show_named(std::string_view name);
/// The name of what a look shows.
std::string_view show_name(const Look& look);

/// The patches that see an opening although the scene is taken as closed: worth a look where the
/// unseen share is shown. Null before there are form factors.
const std::vector<std::int32_t>* open_patches(const Known& known);

/// Whether it can be had of what is open: the eye sees nothing of a thermal scene.
bool is_offered(const ShowName& name, const Session& session);
/// Whether values of neighbours may be blended: not where each is of its own patch.
bool is_smooth(const Look& look);
/// Whether a plane with its own values lies before the patches: what is shown of them is the light.
bool is_plane(Show show);
/// Whether values spread over decades, so that a linear scale shows little of them.
bool is_wide(Show show);

/// The moment of a recorded iteration that is shown; null if there is none or something else is.
const IterationFrame* watched_frame(const IterationRecord* record, const Look& look);

/// One value per patch, in a unit.
struct ShownField {
  std::vector<std::string> title;  ///< lines: what, unit, band
  std::string unit = {};           ///< "" of plain numbers
  Eigen::VectorXd values;          ///< n; not finite = nothing is known
  double least_range = 0;          ///< what is smaller is no more than rounding
};

/// The values in false colour; empty if true colour is shown or nothing is known (yet).
std::optional<ShownField> shown_field(const Known& known, const Look& look);

/// Radiosity that is shown in true colour, n x b; empty if there is none (yet).
std::optional<Eigen::MatrixXd> shown_radiosity(const Known& known, const Look& look);

/// "mean of 3 bands", "red", "550 nm".
std::string band_title(const radiosity::Bands& bands, std::optional<radiosity::Index> band);

}  // namespace viewer
