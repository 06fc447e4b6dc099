#include "python/bindings/scene_study.h"

#include <pybind11/eigen.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "io/picture/image_file.h"
#include "io/result/lightmap_glb.h"
#include "io/result/operator_file.h"
#include "io/result/result_file.h"
#include "python/bindings/arrays.h"
#include "python/bindings/daylight.h"
#include "python/bindings/light.h"
#include "python/bindings/light_plan.h"
#include "python/bindings/operator.h"
#include "python/bindings/work.h"
#include "radiosity/base/error.h"
#include "radiosity/picture/light_atlas.h"
#include "radiosity/picture/render.h"
#include "radiosity/solve/quantity.h"
#include "study/comfort.h"
#include "study/study.h"
#include "study/study_picture.h"

namespace python {
namespace {

namespace py = pybind11;
using namespace radiosity;

/// A study, and what it is to be.
struct KeptStudy {
  std::shared_ptr<study::Study> study;
  study::StudyOptions options;
};

KeptStudy assemble(Scene scene, const study::StudyOptions& options,
                   const std::optional<std::filesystem::path>& operator_file,
                   const py::object& report, std::size_t n_threads) {
  KeptStudy result{{}, options};
  run_work({report, n_threads}, [&](const study::StudyEvents& events) {
    if (!operator_file) {
      result.study =
          std::make_shared<study::Study>(study::assemble(std::move(scene), options, events));
      return;
    }
    io::StoredOperator stored = io::read_operator(*operator_file, events.progress, options.memory);
    study::KnownFactors known{.source = operator_file->string(),
                              .mesh = std::move(stored.mesh),
                              .transport = std::move(stored.transport),
                              .tolerance = stored.tolerance,
                              .geometry = std::move(stored.geometry)};
    result.study = std::make_shared<study::Study>(
        study::assemble(std::move(scene), std::move(known), options, events));
  });
  return result;
}

Operator operator_of(const KeptStudy& kept) {
  const auto& study = kept.study;
  return {std::shared_ptr<const PatchMesh>(study, &study->mesh),
          std::shared_ptr<const Transport>(study, study->transport.get()), study->factor_tolerance,
          study::geometry_fingerprint(study->scene)};
}

void light_up(const KeptStudy& kept, const py::object& report, std::size_t n_threads) {
  study::Study& study = *kept.study;
  study::Light light;
  run_work({report, n_threads}, [&](const study::StudyEvents& events) {
    light = study::solve_light(study.scene, study.mesh, *study.transport, kept.options, events);
  });
  study.solution = std::move(light.solution);
  study.discretisation = std::move(light.discretisation);
}

QuantityField field_of(const study::Study& study, const std::string& name, double efficacy) {
  const auto quantity = quantity_named(name);
  if (!quantity) {
    std::string known;
    for (const QuantityInfo& info : quantity_infos()) {
      known += (known.empty() ? "'" : ", '") + std::string(info.name) + "'";
    }
    throw SceneError("found quantity '" + name + "', expected one of " + known);
  }
  return make_field(*quantity, study.mesh, study.solution, study.scene.bands, efficacy);
}

/// Mean radiant temperatures, and what a person sees, at points.
py::dict comfort_at(const KeptStudy& kept, const Array<double>& points, const std::string& posture,
                    const std::string& body, const Eigen::VectorXd& up,
                    const std::optional<Eigen::VectorXd>& facing, const py::object& report,
                    std::size_t n_threads) {
  const auto named = study::posture_named(posture);
  if (!named) throw SceneError("found posture '" + posture + "', expected 'standing' or 'seated'");
  const auto model = study::body_model_named(body);
  if (!model) {
    throw SceneError("found body '" + body + "', expected 'six-planes' or 'projected-area'");
  }
  study::ComfortOptions options{.posture = *named, .body = *model, .up = Vec3(up).normalized()};
  if (facing) options.facing = Vec3(*facing);
  const std::vector<Vec3> places = points_of(points);
  std::vector<study::ComfortPoint> found;
  run_work({report, n_threads}, [&](const study::StudyEvents& events) {
    options.progress = events.progress;
    found = study::comfort(*kept.study, places, options);
  });
  const auto n = static_cast<Index>(found.size());
  const auto n_surfaces = static_cast<Index>(kept.study->mesh.surface_names.size());
  Eigen::VectorXd mean(n);
  Eigen::MatrixXd planes(n, 6);
  Eigen::MatrixXd factors(n, n_surfaces + 2);
  for (Index k = 0; k < n; ++k) {
    const study::ComfortPoint& point = found[static_cast<std::size_t>(k)];
    mean[k] = point.mean_radiant_temperature;
    planes.row(k) = Eigen::Map<const Eigen::RowVectorXd>(point.plane_temperatures.data(), 6);
    factors.row(k).head(n_surfaces) = point.surfaces.transpose();
    factors(k, n_surfaces) = point.backs;
    factors(k, n_surfaces + 1) = point.sky;
  }
  py::dict result;
  result["mean_radiant_temperature"] = std::move(mean);
  result["plane_radiant_temperatures"] = std::move(planes);
  result["factors"] = std::move(factors);
  return result;
}

/// How a picture is taken.
struct PictureOptions {
  RenderOptions render;
  study::Shading shading = study::Shading::interpolated;
  std::optional<double> exposure;
  std::optional<Camera> camera;
  std::optional<int> lightmap;  ///< texels a side, if it is one
};

Image draw(const study::Study& study, const PictureOptions& options, const Progress& progress) {
  RenderOptions render_options = options.render;
  render_options.progress = progress;
  const std::optional<Camera>& given = options.camera ? options.camera : study.scene.camera;
  const Camera camera = given ? *given : fit_camera(study.mesh, fit_camera(study.mesh));
  return study::draw(study, camera, options.shading, render_options);
}

io::ImageOptions image_options(const study::Study& study, const PictureOptions& options) {
  return {.exposure = options.exposure, .wavelengths = study.scene.bands.wavelengths};
}

/// 8-bit sRGB, height x width x 3.
py::array image(const KeptStudy& kept, const PictureOptions& options, const py::object& report,
                std::size_t n_threads) {
  io::RgbPicture picture;
  run_work({report, n_threads}, [&](const study::StudyEvents& events) {
    picture = io::srgb_picture(draw(*kept.study, options, events.progress),
                               image_options(*kept.study, options));
  });
  return owned_array(std::move(picture.bytes))
      .reshape({py::ssize_t{picture.height}, py::ssize_t{picture.width}, py::ssize_t{3}});
}

/// The light on all surfaces, to a .glb that shows it or as a picture.
void write_lightmap(const std::filesystem::path& path, const study::Study& study,
                    const PictureOptions& options, const Progress& progress) {
  const LightAtlas atlas = make_light_atlas(study.mesh, *options.lightmap);
  RenderOptions render_options = options.render;
  render_options.progress = progress;
  const Image lightmap = study::draw_lightmap(study, atlas, options.shading, render_options);
  if (path.extension() == ".glb") {
    io::write_lightmap_glb(path, study.mesh, atlas, lightmap, image_options(study, options),
                           io::up_axis(study.scene.camera));
  } else {
    io::write_image(path, lightmap, image_options(study, options));
  }
}

/// Writes a result by its extension.
void write(const KeptStudy& kept, const std::filesystem::path& path,
           const std::vector<std::string>& quantities, double efficacy,
           const PictureOptions& picture, const py::object& report, std::size_t n_threads) {
  const study::Study& study = *kept.study;
  io::ResultOptions options{.bands = study.scene.bands, .camera = study.scene.camera};
  for (const std::string& name : quantities) {
    options.quantities.push_back(field_of(study, name, efficacy));
  }
  run_work({report, n_threads}, [&](const study::StudyEvents& events) {
    if (path.extension() == ".h5") {
      io::write_operator(path, study.mesh, *study.transport,
                         {.tolerance = study.factor_tolerance,
                          .geometry = study::geometry_fingerprint(study.scene)},
                         events.progress);
    } else if (picture.lightmap) {
      write_lightmap(path, study, picture, events.progress);
    } else if (path.extension() == ".png" || path.extension() == ".exr") {
      io::write_image(path, draw(study, picture, events.progress), image_options(study, picture));
    } else {
      io::write(path, study.mesh, study.solution, options);
    }
  });
}

/// Of vectors of three.
Camera camera_of(const Eigen::VectorXd& position, const Eigen::VectorXd& direction,
                 const Eigen::VectorXd& up, double vertical_fov) {
  return {position, direction.stableNormalized(), up.stableNormalized(), vertical_fov};
}

}  // namespace

void bind_study(py::module_& module) {
  bind_light_plan(module);
  py::class_<Camera>(module, "Camera").def(py::init(&camera_of));
  py::class_<PictureOptions>(module, "PictureOptions")
      .def(py::init([](int width, int height, int samples, bool gathers,
                       std::optional<double> exposure, const std::optional<Camera>& camera,
                       std::optional<int> lightmap) {
        return PictureOptions{
            .render = {.width = width, .height = height, .samples = samples},
            .shading = gathers ? study::Shading::gathered : study::Shading::interpolated,
            .exposure = exposure,
            .camera = camera,
            .lightmap = lightmap};
      }));
  py::class_<KeptStudy>(module, "Study")
      .def_property_readonly("operator", &operator_of)
      .def_property_readonly("scene", [](const KeptStudy& kept) { return kept.study->scene; })
      .def("solve", &light_up)
      .def("light",
           [](const KeptStudy& kept) {
             return light_dict(kept.study->solution, kept.study->discretisation);
           })
      .def("quantity",
           [](const KeptStudy& kept, const std::string& name, double efficacy) {
             QuantityField field = field_of(*kept.study, name, efficacy);
             return py::make_tuple(std::move(field.values), field.unit);
           })
      .def("comfort", &comfort_at)
      .def("measure",
           [](const KeptStudy& kept, const std::optional<LightPlan>& plan, double efficacy,
              const py::object& report, std::size_t n_threads) {
             return measure(*kept.study, kept.options, plan ? *plan : kept.study->scene.light_plan,
                            efficacy, {report, n_threads});
           })
      .def("daylight_factors",
           [](const KeptStudy& kept, const Eigen::MatrixXd& points, const Eigen::MatrixXd& normals,
              const std::vector<std::string>& outdoors, double efficacy, const py::object& report,
              std::size_t n_threads) {
             Eigen::MatrixXd factors;
             run_work({report, n_threads}, [&](const study::StudyEvents& events) {
               factors = daylight_factors(*kept.study, kept.options, points, normals, outdoors,
                                          efficacy, events);
             });
             return factors;
           })
      .def("image", &image)
      .def("write", &write);
  module.def("assemble", &assemble);
}

}  // namespace python
