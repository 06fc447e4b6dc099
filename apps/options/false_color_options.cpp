#include "apps/options/false_color_options.h"

#include <fmt/format.h>

#include <CLI/App.hpp>
#include <algorithm>

#include "apps/options/quantity_options.h"
#include "apps/terminal/number_list.h"

namespace apps {
namespace {

using radiosity::Bands;
using radiosity::QuantityField;

std::optional<io::ColorScale> as_range(const std::string& text) {
  const auto numbers = as_numbers(text, 2);
  if (!numbers || !(numbers->front() < numbers->back())) return std::nullopt;
  return io::ColorScale{.low = numbers->front(), .high = numbers->back(), .logarithmic = false};
}

std::string check_range(const std::string& text) {
  if (as_range(text)) return "";
  return fmt::format("found '{}', expected two numbers LO,HI, the first one smaller", text);
}

std::string check_band_number(const std::string& text) {
  const auto number = as_number(text);
  if (number && *number >= 0 && *number == static_cast<double>(static_cast<long>(*number)))
    return "";
  return fmt::format("found '{}', expected a whole number from 0 on", text);
}

std::string map_names() {
  std::string names;
  for (const io::ColorMap map : io::color_maps()) {
    names += fmt::format("{}{}", names.empty() ? "" : ", ", io::color_map_name(map));
  }
  return names;
}

std::string check_color_map(const std::string& text) {
  if (io::color_map_named(text)) return "";
  return fmt::format("found '{}', expected one of {}", text, map_names());
}

/// The lines above the bar.
std::vector<std::string> title_of(const QuantityField& field, const Bands& bands,
                                  const FalseColorOptions& options) {
  std::string name(field.info.name);
  std::replace(name.begin(), name.end(), '-', ' ');
  std::vector<std::string> title = {name};
  if (!field.unit.empty()) title.push_back(field.unit);
  if (field.info.is_photometric || bands.count() == 1) return title;
  title.push_back(options.band ? band_names(bands)[static_cast<std::size_t>(*options.band)]
                               : fmt::format("mean of {} bands", bands.count()));
  return title;
}

}  // namespace

CLI::Option* add_false_color_options(CLI::App& command, FalseColorOptions& options) {
  const std::string group = "False colours";
  auto* quantity = command
                       .add_option("--false-colour,--false-color", options.quantity,
                                   "Show a quantity (see `solve --quantity`) in false colours, "
                                   "with a labelled bar added at the right of a .png; an .exr has "
                                   "its values")
                       ->check(check_quantity)
                       ->type_name("Q")
                       ->group(group);
  command
      .add_option("--band", options.band,
                  "Show this band of the quantity, from 0; default: the mean over the bands")
      ->check(check_band_number)
      ->needs(quantity)
      ->type_name("K")
      ->group(group);
  command
      .add_option_function<std::string>(
          "--range", [&options](const std::string& text) { options.range = as_range(text); },
          "Values at the ends of the bar; default: from the smallest seen to what 98 % stay below")
      ->check(check_range)
      ->needs(quantity)
      ->type_name("LO,HI")
      ->group(group);
  command
      .add_option_function<std::string>(
          "--colour-map,--color-map",
          [&options](const std::string& text) { options.map = *io::color_map_named(text); },
          "Colours: " + map_names() + "; default: viridis")
      ->check(check_color_map)
      ->needs(quantity)
      ->type_name("M")
      ->group(group);
  command.add_flag("--log", options.logarithmic, "Make the bar logarithmic")
      ->needs(quantity)
      ->group(group);
  return quantity;
}

void check_false_color(const FalseColorOptions& options) {
  if (options.logarithmic && options.range && !(options.range->low > 0)) {
    throw CLI::ValidationError("--range", "with --log both ends must be above 0");
  }
  if (options.band &&
      radiosity::quantity_info(*radiosity::quantity_named(*options.quantity)).is_photometric) {
    throw CLI::ValidationError("--band", *options.quantity + " has no bands");
  }
}

void check_band(const FalseColorOptions& options, const Bands& bands) {
  if (options.band && *options.band >= bands.count()) {
    throw CLI::ValidationError("--band", fmt::format("found {}, but the scene's bands are 0 to {}",
                                                     *options.band, bands.count() - 1));
  }
}

std::vector<radiosity::Quantity> shown_quantities(const FalseColorOptions& options) {
  if (!options.quantity) return {};
  return {*radiosity::quantity_named(*options.quantity)};
}

ShownQuantity shown_quantity(const QuantityField& field, const Bands& bands,
                             const FalseColorOptions& options) {
  ShownQuantity shown;
  shown.values = field.info.is_photometric
                     ? Eigen::VectorXd(field.values.col(0))
                     : radiosity::mean_over_bands(field.values, bands.wavelengths);
  if (options.band) shown.values = field.values.col(*options.band);
  shown.options = {.title = title_of(field, bands, options),
                   .channel = std::string(field.info.column),
                   .scale = options.range,
                   .logarithmic = options.logarithmic,
                   .map = options.map};
  if (shown.options.scale) shown.options.scale->logarithmic = options.logarithmic;
  return shown;
}

}  // namespace apps
