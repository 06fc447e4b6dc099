#include "io/vtk_polydata.h"

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
#include <string>
#include <vector>

#include "io/atomic_file.h"
#include "radiosity/error.h"

namespace io {
namespace {

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

void add_surface_names(vtkPolyData& polydata, const std::vector<std::string>& names) {
  vtkNew<vtkStringArray> array;
  array->SetName("surface_names");
  for (const std::string& name : names) array->InsertNextValue(name);
  polydata.GetFieldData()->AddArray(array);
}

}  // namespace

vtkSmartPointer<vtkPolyData> make_polydata(
    const PatchMesh& mesh, const Solution& solution,
    const std::vector<radiosity::QuantityField>& quantities) {
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
  for (const radiosity::QuantityField& quantity : quantities) {
    add_array(*polydata, std::string(quantity.info.column).c_str(), quantity.values);
  }
  add_surface_names(*polydata, mesh.surface_names);
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
