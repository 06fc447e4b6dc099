#include "python/bindings/light_plan.h"

#include <pybind11/eigen.h>
#include <pybind11/stl.h>

#include <optional>
#include <string>
#include <vector>

#include "python/bindings/arrays.h"
#include "study/measured_plan.h"

namespace python {
namespace {

namespace py = pybind11;
using namespace radiosity;

/// n x 3: direct, indirect, error.
py::dict quantities_dict(const study::MeasuredPlanGrid& grid, Index light) {
  py::dict result;
  for (const GridQuantity& quantity : grid.light.quantities) {
    const Eigen::MatrixXd values = quantity.values.middleCols(kLightParts * light, kLightParts);
    result[py::str(quantity.name)] = values;
  }
  return result;
}

py::dict grid_dict(const study::MeasuredPlan& measured, const study::MeasuredPlanGrid& grid) {
  py::dict result;
  result["name"] = grid.plan.name;
  result["points"] = points_array(grid.light.where.points);
  result["normals"] = points_array(grid.light.where.normals);
  std::vector<std::int32_t> places;
  for (const PointPlace place : grid.light.places) {
    places.push_back(static_cast<std::int32_t>(place));
  }
  result["place"] = owned_array(std::move(places));
  result["shape"] = py::none();
  if (const auto& cells = grid.light.where.grid) {
    result["shape"] = py::make_tuple(cells->n_rows, cells->n_columns);
  }
  result["new"] = quantities_dict(grid, measured.light(study::LampAge::new_lamps));
  result["maintained"] = quantities_dict(grid, measured.light(study::LampAge::maintained));
  return result;
}

py::dict observer_dict(const study::MeasuredObserver& seen) {
  py::list sources;
  for (const GlareSource& source : seen.glare.sources) {
    py::dict entry;
    entry["surface"] = source.surface;
    entry["luminance"] = source.luminance;
    entry["solid_angle"] = source.solid_angle;
    entry["direction"] = source.direction;
    entry["position_index"] = source.position;
    sources.append(entry);
  }
  py::dict result;
  result["name"] = seen.observer.name;
  result["ugr"] = seen.glare.ugr();
  result["background"] = seen.glare.background;
  result["luminance"] = seen.glare.luminance;
  result["sources"] = sources;
  return result;
}

std::vector<Vec3> directions_of(const Array<double>& array) {
  std::vector<Vec3> directions = points_of(array);
  for (Vec3& direction : directions) direction.stableNormalize();
  return directions;
}

LightPlan points_plan(const Array<double>& points, const Array<double>& normals,
                      const std::optional<Eigen::VectorXd>& up, bool is_cylindrical,
                      const Array<double>& vertical, const Array<double>& semi_cylindrical,
                      const Array<double>& luminance_from) {
  GridPlan grid{.name = "points",
                .points = points_of(points),
                .normals = directions_of(normals),
                .is_cylindrical = is_cylindrical,
                .vertical = directions_of(vertical),
                .semi_cylindrical = directions_of(semi_cylindrical),
                .luminance_from = points_of(luminance_from)};
  if (up) grid.up = up->stableNormalized();
  return {.grids = {grid}};
}

LightPlan observer_plan(const Eigen::VectorXd& position, const Eigen::VectorXd& direction,
                        const Eigen::VectorXd& up) {
  return {.observers = {{.name = "observer",
                         .position = position,
                         .direction = direction.stableNormalized(),
                         .up = up.stableNormalized()}}};
}

}  // namespace

py::dict measure(const study::Study& study, const study::StudyOptions& options,
                 const LightPlan& plan, double efficacy, const WorkOptions& work) {
  study::MeasuredPlan measured;
  run_work(work, [&](const study::StudyEvents& events) {
    measured = study::measure_plan(study, plan, options, efficacy, events);
  });
  py::list grids;
  for (const auto& grid : measured.grids) grids.append(grid_dict(measured, grid));
  py::list observers;
  for (const auto& seen : measured.observers) observers.append(observer_dict(seen));
  py::dict result;
  result["grids"] = grids;
  result["observers"] = observers;
  return result;
}

void bind_light_plan(py::module_& module) {
  py::class_<LightPlan>(module, "LightPlan");
  module.def("points_plan", &points_plan);
  module.def("observer_plan", &observer_plan);
}

}  // namespace python
