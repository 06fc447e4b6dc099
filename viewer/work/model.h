#pragma once

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <string>

#include "radiosity/operator/factor_rows.h"
#include "radiosity/operator/transport.h"
#include "radiosity/scene/patch_mesh.h"
#include "radiosity/scene/scene.h"
#include "radiosity/solve/solution.h"
#include "radiosity/visibility/visibility.h"
#include "viewer/work/light_mix.h"
#include "viewer/work/outer_light.h"

namespace viewer {

/// What is in the window. The parts are immutable and shared with the workers; each is absent until
/// it is known: a form-factor file never has light, a result file no scene.
struct Model {
  std::string path;
  std::optional<std::string> unit;  ///< of the file's coordinates, if it was asked for
  std::shared_ptr<const radiosity::Scene> scene;
  radiosity::Bands bands;
  std::optional<radiosity::Camera> camera;  ///< that the file tells
  std::shared_ptr<const radiosity::PatchMesh> mesh;
  std::shared_ptr<const radiosity::Visibility> visibility;
  /// What the patches get straight from luminaires, sun and sky, where these stood when the light
  /// was last found; or null.
  std::shared_ptr<const OuterLight> outer;
  std::shared_ptr<const radiosity::Transport> transport;
  std::shared_ptr<const radiosity::FactorRows> factors;  ///< the transport's, or a file's
  bool has_quick_rows = true;                            ///< of which none takes a product
  radiosity::Box3 bounds;                                ///< of the patches, m
};

/// The direct irradiance of a mix by luminaires, sun and sky, W/m², n x b; empty without these.
Eigen::MatrixXd outer_irradiance(const Model& model, const LightMix& mix);
/// The same of one patch, b; 0 without these.
Eigen::VectorXd outer_irradiance_at(const Model& model, const LightMix& mix,
                                    radiosity::Index patch);

/// Light on the patches of a model.
struct Light {
  enum class Kind {
    preview,   ///< rough, from progressive shooting or by rough form factors
    quick,     ///< of a mix, to the accuracy that a picture needs
    solved,    ///< to the iteration's tolerance; errors not known yet
    complete,  ///< with `radiosity_error`
    stored     ///< from a file
  };
  Kind kind = Kind::preview;
  radiosity::Solution solution;
  std::optional<double> relative_error = {};  ///< `viewer::relative_error`, if it has errors
  /// Of a preview that was solved by rough form factors: what these are off by
  /// (CompressionReport::verified_error).
  std::optional<double> factor_error = {};
  /// Of what it is the light; null if that is not known: of a file.
  std::shared_ptr<const LightMix> mix = {};
  std::shared_ptr<const OuterLight> outer = {};  ///< that it was found with; or null

  [[nodiscard]] bool is_solved() const { return kind != Kind::preview && kind != Kind::quick; }
  [[nodiscard]] bool has_errors() const { return kind == Kind::complete || kind == Kind::stored; }
};

}  // namespace viewer
