#pragma once

#include <optional>
#include <string>
#include <vector>

#include "io/picture/false_color.h"
#include "radiosity/scene/scene.h"
#include "radiosity/solve/quantity.h"

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace apps {

/// Whether and how pictures show a quantity in false colours.
struct FalseColorOptions {
  std::optional<std::string> quantity;  ///< its name; absent: an ordinary picture
  std::optional<long> band;             ///< from 0; absent: the mean over the bands
  std::optional<io::ColorScale> range;  ///< absent: found from what is seen
  bool logarithmic = false;
  io::ColorMap map = io::ColorMap::viridis;
};

/// Binds the options to the command and returns --false-colour; `options` must outlive the parsing.
CLI::Option* add_false_color_options(CLI::App& command, FalseColorOptions& options);

/// Throws CLI::ValidationError if the options contradict each other.
void check_false_color(const FalseColorOptions& options);

/// Throws CLI::ValidationError if the scene has no such band.
void check_band(const FalseColorOptions& options, const radiosity::Bands& bands);

/// The quantity that is shown, if any.
std::vector<radiosity::Quantity> shown_quantities(const FalseColorOptions& options);

/// What is shown of a quantity: one value per patch, and how.
struct ShownQuantity {
  Eigen::VectorXd values;
  io::FalseColorOptions options;
};

/// The band that was chosen, or the mean over all, with its title. The options have been checked.
ShownQuantity shown_quantity(const radiosity::QuantityField& field, const radiosity::Bands& bands,
                             const FalseColorOptions& options);

/// What a picture in false colours shows.
struct ShownScale {
  std::string quantity;  ///< its name
  std::string unit;
  io::ColorScale scale;
};

}  // namespace apps
