#include "python/bindings/light.h"

#include <pybind11/eigen.h>
#include <pybind11/stl.h>

#include <string>
#include <utility>
#include <vector>

#include "python/bindings/arrays.h"
#include "python/bindings/operator.h"
#include "python/bindings/study_options.h"
#include "python/bindings/work.h"
#include "radiosity/base/parallel.h"
#include "radiosity/exchange/point_factors.h"
#include "radiosity/solve/exchange_network.h"
#include "radiosity/solve/importance.h"
#include "study/study.h"

namespace python {
namespace {

namespace py = pybind11;
using namespace radiosity;

py::dict solve(const Operator& factors, const Eigen::MatrixXd& exitance,
               const Eigen::MatrixXd& reflectance, const Eigen::MatrixXd& incident,
               const study::StudyOptions& options, const py::object& report,
               std::size_t n_threads) {
  study::Light light;
  run_work({report, n_threads}, [&](const study::StudyEvents& events) {
    light = study::solve_light(*factors.mesh, *factors.transport, {exitance, reflectance, incident},
                               options, events);
  });
  return light_dict(std::move(light.solution), light.discretisation);
}

Eigen::MatrixXd importance_of(const Operator& factors, const Eigen::MatrixXd& reflectance,
                              Index patch, double tolerance, const py::object& report) {
  Eigen::MatrixXd result;
  run_work({.report = report}, [&](const study::StudyEvents& events) {
    result = importance(*factors.transport, reflectance, patch,
                        {.tolerance = tolerance, .progress = events.progress});
  });
  return result;
}

py::dict exchange_of(const Operator& factors, const Eigen::VectorXd& emissivity,
                     const std::vector<std::int32_t>& node, Index n_nodes, const py::object& report,
                     std::size_t n_threads) {
  ExchangeNetwork network;
  run_work({report, n_threads}, [&](const study::StudyEvents& events) {
    network = exchange_network(*factors.transport, emissivity, node, n_nodes,
                               {.progress = events.progress});
  });
  py::dict result;
  result["gebhart"] = network.gebhart();
  result["script_f"] = network.script_f();
  result["area"] = std::move(network.area);
  result["emitting"] = std::move(network.emitting);
  result["couplings"] = std::move(network.couplings);
  result["error"] = std::move(network.error);
  result["to_space"] = std::move(network.to_space);
  result["to_backs"] = std::move(network.to_backs);
  result["error_bound"] = network.error_bound;
  return result;
}

/// Shares of what leaves each point, k x (surfaces, backs, sky).
Eigen::MatrixXd from_points(const PatchMesh& mesh, const Array<double>& points,
                            const Array<double>& normals, const py::object& report,
                            std::size_t n_threads) {
  const std::vector<Vec3> places = points_of(points);
  const std::vector<Vec3> directions = points_of(normals);
  const auto n_surfaces = static_cast<Index>(mesh.surface_names.size());
  Eigen::MatrixXd result(static_cast<Index>(places.size()), n_surfaces + 2);
  run_work({report, n_threads}, [&](const study::StudyEvents& events) {
    const Progress each{.report = {}, .stop = events.progress.stop};
    parallel_for(std::ssize(places), [&](std::ptrdiff_t k) {
      const Destinations shares = point_factors(mesh, places[k], directions[k], each);
      result.row(k).head(n_surfaces) = shares.surfaces;
      result(k, n_surfaces) = shares.backs;
      result(k, n_surfaces + 1) = shares.sky;
    });
  });
  return result;
}

}  // namespace

py::dict light_dict(Solution solution, const DiscretisationError& discretisation) {
  if (solution.incident.size() == 0)
    solution.incident.setZero(solution.radiosity.rows(), solution.radiosity.cols());
  py::dict result;
  result["net_flux"] = solution.net_flux();
  result["radiosity"] = std::move(solution.radiosity);
  result["irradiance"] = std::move(solution.irradiance);
  result["incident"] = std::move(solution.incident);
  result["exitance"] = std::move(solution.exitance);
  result["reflectance"] = std::move(solution.reflectance);
  result["error"] = std::move(solution.radiosity_error);
  result["emitted"] = std::move(solution.energy.emitted);
  result["incident_power"] = std::move(solution.energy.incident);
  result["absorbed"] = std::move(solution.energy.absorbed);
  result["temperature"] = std::move(solution.temperature);
  result["escaped"] = std::move(solution.energy.escaped);
  result["method"] = std::string(method_name(solution.method));
  result["iterations"] = solution.iterations;
  result["products"] = solution.products;
  result["residual"] = solution.residual;
  result["error_bound"] = solution.error_bound;
  result["transport_error_bound"] = solution.transport_error_bound;
  result["converged"] = solution.converged;
  result["seconds"] = solution.seconds;
  result["patch_size_error"] = discretisation.relative;
  result["patches_of_unknown_size_error"] = discretisation.n_unknown;
  return result;
}

void bind_light(py::module_& module) {
  module.def("solve", &solve);
  module.def("importance", &importance_of);
  module.def("exchange", &exchange_of);
  module.def("factors_from_points", &from_points);
}

}  // namespace python
