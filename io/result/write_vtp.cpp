#include "io/result/write_vtp.h"

#include <vtkPolyData.h>

#include "io/result/vtk_polydata.h"

void radiosity_io_write_vtp(const std::filesystem::path& path, const radiosity::PatchMesh& mesh,
                            const radiosity::Solution& solution,
                            const std::vector<radiosity::QuantityField>& quantities,
                            const std::optional<radiosity::Bands>& bands,
                            const std::optional<radiosity::Camera>& camera) {
  io::write_polydata(path, *io::make_polydata(mesh, solution, quantities, bands, camera));
}
