#include "radiosity/assembly/make_dense_transport.h"

#include <chrono>

#include "radiosity/assembly/assembly_report.h"
#include "radiosity/assembly/closure.h"
#include "radiosity/assembly/dense_memory.h"
#include "radiosity/assembly/dense_transport.h"
#include "radiosity/assembly/memory_sink.h"
#include "radiosity/scene/whole_mesh.h"
#include "radiosity/visibility/coverage.h"

namespace radiosity {

std::unique_ptr<Transport> make_dense_transport(const PatchMesh& mesh, const Visibility& visibility,
                                                const TransportOptions& options) {
  check_memory(mesh.size(), mesh.n_polygons(), options.memory,
               options.ranks != nullptr ? options.ranks->size() : 1);
  const auto start = std::chrono::steady_clock::now();
  const Eigen::VectorXd area = Eigen::Map<const Eigen::VectorXd>(mesh.area.data(), mesh.size());
  const WholeMesh whole(mesh);
  const Coverage coverage = find_coverage(whole.mesh(), plane_thickness(whole.mesh()));
  Assembly assembly = assemble_exchange_areas(mesh, whole, visibility, options, coverage);
  const Eigen::VectorXd open_area =
      (area.array() * (1 - coverage.share.head(mesh.size()).array()))(assembly.order);
  assembly.tiles.set_row_sums(assembly.row_sums);
  const ClosedRows rows =
      close_rows(assembly.tiles, assembly.row_sums, open_area, options.closed, options.tolerance);
  assembly.tiles.set_row_sums(rows.sums.present);
  assembly.report.closed = rows.is_closed;
  find_backs(mesh, visibility, assembly.order, rows.sums.present, rows.open_rows, options.seed,
             assembly.report);
  const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
  assembly.report.seconds = elapsed.count();
  return std::make_unique<DenseTransport>(DenseTransport::Parts{
      std::move(assembly.order), std::move(assembly.tiles), area, std::move(assembly.report)});
}

}  // namespace radiosity
