#include "io/result/pvtp_file.h"

#include <fmt/format.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkIdList.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>

#include <fstream>
#include <string>
#include <vector>

#include "io/base/atomic_file.h"
#include "io/base/xml_escaped.h"
#include "io/result/vtk_polydata.h"

namespace io {
namespace {

vtkSmartPointer<vtkPolyData> make_whole(const radiosity::PatchMesh& mesh,
                                        const radiosity::Solution& solution,
                                        const ResultOptions& options) {
  return make_polydata(mesh, solution, options.quantities, options.bands, options.camera);
}

/// The cells from `begin` to before `end` with the points that they have, numbered as they are met.
void copy_cells(vtkPolyData& whole, vtkIdType begin, vtkIdType end, vtkPolyData& piece) {
  std::vector<vtkIdType> number(whole.GetNumberOfPoints(), -1);
  auto points = vtkSmartPointer<vtkPoints>::New();
  points->SetDataTypeToDouble();
  auto polygons = vtkSmartPointer<vtkCellArray>::New();
  auto corners = vtkSmartPointer<vtkIdList>::New();
  for (vtkIdType cell = begin; cell < end; ++cell) {
    whole.GetCellPoints(cell, corners);
    polygons->InsertNextCell(static_cast<int>(corners->GetNumberOfIds()));
    for (vtkIdType k = 0; k < corners->GetNumberOfIds(); ++k) {
      vtkIdType& own = number[corners->GetId(k)];
      if (own < 0) own = points->InsertNextPoint(whole.GetPoint(corners->GetId(k)));
      polygons->InsertCellPoint(own);
    }
  }
  piece.SetPoints(points);
  piece.SetPolys(polygons);
}

vtkSmartPointer<vtkPolyData> make_piece(vtkPolyData& whole, PiecePart part) {
  const vtkIdType n = whole.GetNumberOfCells();
  const vtkIdType begin = n * part.part / part.n_parts;
  const vtkIdType end = n * (part.part + 1) / part.n_parts;
  auto piece = vtkSmartPointer<vtkPolyData>::New();
  copy_cells(whole, begin, end, *piece);
  for (int a = 0; a < whole.GetCellData()->GetNumberOfArrays(); ++a) {
    vtkDataArray& all = *whole.GetCellData()->GetArray(a);
    auto own = vtkSmartPointer<vtkDataArray>::Take(all.NewInstance());
    own->SetName(all.GetName());
    own->SetNumberOfComponents(all.GetNumberOfComponents());
    own->SetNumberOfTuples(end - begin);
    if (begin < end) all.GetTuples(begin, end - 1, own);
    piece->GetCellData()->AddArray(own);
  }
  piece->GetCellData()->SetActiveScalars("radiosity");
  piece->SetFieldData(whole.GetFieldData());
  return piece;
}

std::string declared(vtkDataArray& array, const char* name) {
  return fmt::format(R"(      <PDataArray type="{}" Name="{}" NumberOfComponents="{}"/>)",
                     array.GetDataType() == VTK_INT ? "Int32" : "Float64", name,
                     array.GetNumberOfComponents()) +
         "\n";
}

}  // namespace

std::filesystem::path piece_path(const std::filesystem::path& pvtp, int part) {
  std::filesystem::path path = pvtp;
  path.replace_filename(fmt::format("{}_{}.vtp", pvtp.stem().string(), part));
  return path;
}

void write_piece(const std::filesystem::path& pvtp, PiecePart part,
                 const radiosity::PatchMesh& mesh, const radiosity::Solution& solution,
                 const ResultOptions& options) {
  const auto whole = make_whole(mesh, solution, options);
  write_polydata(piece_path(pvtp, part.part), *make_piece(*whole, part));
}

void write_piece_index(const std::filesystem::path& pvtp, int n_parts,
                       const radiosity::PatchMesh& mesh, const radiosity::Solution& solution,
                       const ResultOptions& options) {
  const auto whole = make_whole(mesh, solution, options);
  std::string text =
      "<?xml version=\"1.0\"?>\n"
      "<VTKFile type=\"PPolyData\" version=\"1.0\" byte_order=\"LittleEndian\" "
      "header_type=\"UInt64\">\n"
      "  <PPolyData GhostLevel=\"0\">\n"
      "    <PCellData Scalars=\"radiosity\">\n";
  for (int a = 0; a < whole->GetCellData()->GetNumberOfArrays(); ++a) {
    vtkDataArray& array = *whole->GetCellData()->GetArray(a);
    text += declared(array, array.GetName());
  }
  text += "    </PCellData>\n    <PPoints>\n";
  text += declared(*whole->GetPoints()->GetData(), "Points");
  text += "    </PPoints>\n";
  for (int part = 0; part < n_parts; ++part) {
    text += fmt::format("    <Piece Source=\"{}\"/>\n",
                        xml_escaped(piece_path(pvtp, part).filename().string()));
  }
  text += "  </PPolyData>\n</VTKFile>\n";
  write_stream_atomically(pvtp, [&](std::ofstream& stream) { stream << text; });
}

}  // namespace io
