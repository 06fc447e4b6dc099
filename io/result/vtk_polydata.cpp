#include "io/result/vtk_polydata.h"

#include <fmt/format.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkIntArray.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkStringArray.h>
#include <vtkXMLPolyDataWriter.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <fstream>
#include <span>
#include <string>
#include <vector>

#include "io/base/atomic_file.h"
#include "io/result/bands_name.h"
#include "radiosity/base/error.h"

namespace io {
namespace {

using radiosity::Bands;
using radiosity::Index;
using radiosity::PatchMesh;
using radiosity::Solution;

vtkSmartPointer<vtkPoints> make_points(const PatchMesh& mesh) {
  auto points = vtkSmartPointer<vtkPoints>::New();
  points->SetDataTypeToDouble();
  points->SetNumberOfPoints(static_cast<vtkIdType>(mesh.vertices.size()));
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    points->SetPoint(static_cast<vtkIdType>(i), mesh.vertices[i].data());
  }
  return points;
}

vtkSmartPointer<vtkCellArray> make_polygons(const PatchMesh& mesh) {
  auto polygons = vtkSmartPointer<vtkCellArray>::New();
  polygons->AllocateEstimate(mesh.size(), 4);
  for (Index i = 0; i < mesh.size(); ++i) {
    const std::array<vtkIdType, 4> corners = {mesh.corners[i][0], mesh.corners[i][1],
                                              mesh.corners[i][2], mesh.corners[i][3]};
    polygons->InsertNextCell(mesh.n_corners(i), corners.data());
  }
  return polygons;
}

void add_array(vtkPolyData& polydata, const char* name, const Eigen::MatrixXd& values) {
  assert(values.rows() == polydata.GetNumberOfCells());
  vtkNew<vtkDoubleArray> array;
  array->SetName(name);
  array->SetNumberOfComponents(static_cast<int>(values.cols()));
  array->SetNumberOfTuples(values.rows());
  using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  Eigen::Map<RowMajor>(array->GetPointer(0), values.rows(), values.cols()) = values;
  polydata.GetCellData()->AddArray(array);
}

void add_array(vtkPolyData& polydata, const char* name, const std::vector<std::int32_t>& values) {
  vtkNew<vtkIntArray> array;
  array->SetName(name);
  array->SetNumberOfTuples(static_cast<vtkIdType>(values.size()));
  std::copy(values.begin(), values.end(), array->GetPointer(0));
  polydata.GetCellData()->AddArray(array);
}

void add_field(vtkPolyData& polydata, const char* name, const std::vector<std::string>& texts) {
  vtkNew<vtkStringArray> array;
  array->SetName(name);
  for (const std::string& text : texts) array->InsertNextValue(text);
  polydata.GetFieldData()->AddArray(array);
}

void add_field(vtkPolyData& polydata, const char* name, const std::vector<int>& values) {
  vtkNew<vtkIntArray> array;
  array->SetName(name);
  for (const int value : values) array->InsertNextValue(value);
  polydata.GetFieldData()->AddArray(array);
}

void add_field(vtkPolyData& polydata, const char* name, std::span<const double> values) {
  vtkNew<vtkDoubleArray> array;
  array->SetName(name);
  for (const double value : values) array->InsertNextValue(value);
  polydata.GetFieldData()->AddArray(array);
}

void add_bands(vtkPolyData& polydata, Index n_bands, const std::optional<Bands>& bands) {
  if (!bands) {
    if (n_bands == 1) add_field(polydata, "bands", {"grey"});
    if (n_bands == 3) add_field(polydata, "bands", {"rgb"});
    return;
  }
  assert(bands->count() == n_bands);
  add_field(polydata, "bands", {std::string(bands_name(bands->kind))});
  if (!bands->wavelengths.empty()) {
    add_field(polydata, "wavelengths", std::span(bands->wavelengths));
  }
  if (!bands->edges.empty()) add_field(polydata, "band_edges", std::span(bands->edges));
}

void add_camera(vtkPolyData& polydata, const radiosity::Camera& camera) {
  std::vector<double> numbers;
  for (const radiosity::Vec3& vector : {camera.position, camera.direction, camera.up}) {
    numbers.insert(numbers.end(), vector.begin(), vector.end());
  }
  numbers.push_back(camera.vertical_fov);
  add_field(polydata, "camera", std::span<const double>(numbers));
}

/// What the solver says of the whole. Not its time, so that equal solutions give equal files.
void add_solve_report(vtkPolyData& polydata, const Solution& solution) {
  const auto add_number = [&](const char* name, double value) {
    add_field(polydata, name, std::span(&value, 1));
  };
  const auto add_energy = [&](const char* name, const Eigen::VectorXd& watts) {
    if (watts.size() > 0) add_field(polydata, name, std::span(watts.data(), watts.size()));
  };
  add_energy("energy_emitted", solution.energy.emitted);
  add_energy("energy_incident", solution.energy.incident);
  add_energy("energy_absorbed", solution.energy.absorbed);
  add_energy("energy_escaped", solution.energy.escaped);
  add_field(polydata, "solve_method", {std::string(method_name(solution.method))});
  add_field(polydata, "solve_iterations", std::vector{solution.iterations});
  add_field(polydata, "solve_converged", std::vector{static_cast<int>(solution.converged)});
  add_number("solve_products", solution.products);
  add_number("solve_residual", solution.residual);
  add_number("solve_error_bound", solution.error_bound);
  add_number("transport_error_bound", solution.transport_error_bound);
}

}  // namespace

vtkSmartPointer<vtkPolyData> make_polydata(const PatchMesh& mesh, const Solution& solution,
                                           const std::vector<radiosity::QuantityField>& quantities,
                                           const std::optional<Bands>& bands,
                                           const std::optional<radiosity::Camera>& camera) {
  auto polydata = vtkSmartPointer<vtkPolyData>::New();
  polydata->SetPoints(make_points(mesh));
  polydata->SetPolys(make_polygons(mesh));
  add_array(*polydata, "radiosity", solution.radiosity);
  add_array(*polydata, "irradiance", solution.irradiance);
  add_array(*polydata, "exitance", solution.exitance);
  add_array(*polydata, "reflectance", solution.reflectance);
  add_array(*polydata, "radiosity_error", solution.radiosity_error);
  add_array(*polydata, "area", Eigen::Map<const Eigen::VectorXd>(mesh.area.data(), mesh.size()));
  add_array(*polydata, "surface", mesh.surface);
  add_array(*polydata, "polygon", mesh.polygon);
  add_array(*polydata, "net_flux", solution.net_flux());
  if (solution.temperature.size() > 0) {
    // Not "temperature", which would make it the material's of a scene read from this file.
    add_array(*polydata, "surface_temperature", solution.temperature);
  }
  add_array(*polydata, "twin", mesh.twin);
  add_array(*polydata, "family", mesh.family);
  for (const radiosity::QuantityField& quantity : quantities) {
    add_array(*polydata, std::string(quantity.info.column).c_str(), quantity.values);
  }
  add_field(*polydata, "surface_names", mesh.surface_names);
  add_field(*polydata, "surface_two_sided",
            std::vector<int>(mesh.surface_two_sided.begin(), mesh.surface_two_sided.end()));
  add_field(*polydata, "radiosity_version", std::vector{kResultVersion});
  add_bands(*polydata, solution.radiosity.cols(), bands);
  add_solve_report(*polydata, solution);
  if (camera) add_camera(*polydata, *camera);
  polydata->GetCellData()->SetActiveScalars("radiosity");
  return polydata;
}

void write_polydata(const std::filesystem::path& path, vtkPolyData& polydata) {
  // Through memory, since VTK's way with a full disk is to print, to leak and to delete the file.
  vtkNew<vtkXMLPolyDataWriter> writer;
  writer->SetInputData(&polydata);
  writer->SetDataModeToAppended();
  writer->EncodeAppendedDataOff();
  writer->SetHeaderTypeToUInt64();
  writer->WriteToOutputStringOn();
  if (writer->Write() != 1) {
    throw radiosity::OutputError(fmt::format("{}: VTK cannot encode the result", path.string()));
  }
  const std::string file = writer->GetOutputString();
  write_stream_atomically(path, [&](std::ofstream& stream) { stream << file; });
}

}  // namespace io
