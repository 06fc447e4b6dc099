#include "io/result/vtk_polydata_reader.h"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkLogger.h>
#include <vtkNew.h>
#include <vtkOutputWindow.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkStringArray.h>
#include <vtkTypeInt64Array.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <mutex>
#include <string>
#include <string_view>
#include <utility>

#include "io/base/line_reader.h"
#include "io/result/vtp_file.h"
#include "io/result/vtp_values.h"

namespace io {
namespace {

/// Keeps VTK from printing while it lives; one at a time, since all of VTK shares these settings.
class Silence {
 public:
  Silence()
      : lock_(mutex()),
        display_mode_(vtkOutputWindow::GetInstance()->GetDisplayMode()),
        verbosity_(vtkLogger::GetCurrentVerbosityCutoff()) {
    vtkOutputWindow::GetInstance()->SetDisplayModeToNever();
    vtkLogger::SetStderrVerbosity(vtkLogger::VERBOSITY_OFF);
  }
  ~Silence() {
    vtkLogger::SetStderrVerbosity(verbosity_);
    vtkOutputWindow::GetInstance()->SetDisplayMode(display_mode_);
  }
  Silence(const Silence&) = delete;
  Silence& operator=(const Silence&) = delete;

 private:
  static std::mutex& mutex() {
    static std::mutex instance;
    return instance;
  }

  std::lock_guard<std::mutex> lock_;
  int display_mode_;
  vtkLogger::Verbosity verbosity_;
};

int vtk_type(const std::string& type) {
  constexpr std::array<std::pair<std::string_view, int>, 10> kTypes = {
      {{"Int8", VTK_TYPE_INT8},
       {"UInt8", VTK_TYPE_UINT8},
       {"Int16", VTK_TYPE_INT16},
       {"UInt16", VTK_TYPE_UINT16},
       {"Int32", VTK_TYPE_INT32},
       {"UInt32", VTK_TYPE_UINT32},
       {"Int64", VTK_TYPE_INT64},
       {"UInt64", VTK_TYPE_UINT64},
       {"Float32", VTK_TYPE_FLOAT32},
       {"Float64", VTK_TYPE_FLOAT64}}};
  return std::find_if(kTypes.begin(), kTypes.end(),
                      [&](const auto& known) { return known.first == type; })
      ->second;
}

vtkSmartPointer<vtkAbstractArray> make_texts(const VtpArray& values) {
  auto array = vtkSmartPointer<vtkStringArray>::New();
  std::string_view rest = values.bytes;
  for (auto end = rest.find('\0'); end != std::string_view::npos; end = rest.find('\0')) {
    array->InsertNextValue(std::string(rest.substr(0, end)));
    rest.remove_prefix(end + 1);
  }
  return array;
}

vtkSmartPointer<vtkDataArray> make_numbers(const VtpArray& values) {
  auto array =
      vtkSmartPointer<vtkDataArray>::Take(vtkDataArray::CreateDataArray(vtk_type(values.type)));
  const std::size_t n_values = values.bytes.size() / vtp_type_size(values.type);
  array->SetNumberOfComponents(static_cast<int>(values.n_components));
  array->SetNumberOfTuples(static_cast<vtkIdType>(n_values / values.n_components));
  if (n_values > 0) std::memcpy(array->GetVoidPointer(0), values.bytes.data(), values.bytes.size());
  return array;
}

vtkSmartPointer<vtkAbstractArray> make_array(const std::string& name, const VtpArray& values) {
  vtkSmartPointer<vtkAbstractArray> array;
  if (values.type == "String") {
    array = make_texts(values);
  } else {
    array = make_numbers(values);
  }
  array->SetName(name.c_str());
  return array;
}

/// Offsets or corners, behind `n_before` zeros.
vtkSmartPointer<vtkTypeInt64Array> make_integers(const VtpFile& file, const char* name,
                                                 vtkIdType n_before,
                                                 const std::filesystem::path& path) {
  auto integers = vtkSmartPointer<vtkTypeInt64Array>::New();
  for (vtkIdType i = 0; i < n_before; ++i) integers->InsertNextValue(0);
  const auto entry = file.polygons.find(name);
  if (entry == file.polygons.end()) return integers;
  const std::string& type = entry->second.type;
  if (type.starts_with("Float") || type == "String" || entry->second.n_components != 1) {
    fail(path, std::string("is damaged: the ") + name + " of the polygons are no whole numbers");
  }
  const auto values = make_numbers(entry->second);
  integers->Resize(n_before + values->GetNumberOfTuples());
  for (vtkIdType i = 0; i < values->GetNumberOfTuples(); ++i) {
    integers->InsertNextValue(static_cast<vtkTypeInt64>(values->GetTuple1(i)));
  }
  return integers;
}

}  // namespace

vtkSmartPointer<vtkPolyData> read_polydata(const std::filesystem::path& path) {
  const Silence silence;
  const VtpFile file = read_vtp(path);
  if (file.n_other_cells > 0) {
    fail(path, "has vertices, lines or strips beside its polygons, expected patches only");
  }
  auto polydata = vtkSmartPointer<vtkPolyData>::New();
  vtkNew<vtkPoints> points;
  if (file.n_points > 0) {
    if (file.points.n_components != 3 || file.points.type == "String") {
      fail(path, "is damaged: its points are not three coordinates each");
    }
    points->SetData(make_numbers(file.points));
  }
  polydata->SetPoints(points);
  vtkNew<vtkCellArray> polygons;
  polygons->SetData(make_integers(file, "offsets", 1, path),
                    make_integers(file, "connectivity", 0, path));
  polydata->SetPolys(polygons);
  for (const auto& [name, values] : file.cells) {
    if (values.type == "String") continue;
    polydata->GetCellData()->AddArray(make_array(name, values));
  }
  for (const auto& [name, values] : file.fields) {
    polydata->GetFieldData()->AddArray(make_array(name, values));
  }
  return polydata;
}

}  // namespace io
