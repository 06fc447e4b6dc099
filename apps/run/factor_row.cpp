#include "apps/run/factor_row.h"

#include <utility>

#include "apps/options/patch_set.h"
#include "apps/run/scene_input.h"
#include "apps/terminal/output_files.h"
#include "io/result/form_factor_reader.h"
#include "io/result/operator_file.h"
#include "radiosity/exchange/evaluated_row.h"

namespace apps {
namespace {

using namespace radiosity;

FactorRow named_row(const RowRequest& request, PatchMesh mesh, const std::string& source) {
  FactorRow row{.row = request.row, .mesh = std::move(mesh), .patches = {}, .values = {}};
  row.patches = patches_named(request.row, row.mesh, source);
  return row;
}

FactorRow evaluated(FactorRow row, const EvaluatedRowOptions& options) {
  row.values = evaluated_row(row.mesh, Visibility(row.mesh), row.patches, options);
  row.is_evaluated = true;
  return row;
}

FactorRow row_of_compressed(const RowRequest& request, const std::string& path,
                            const EvaluatedRowOptions& options) {
  io::StoredOperator stored = io::read_operator(path, options.progress);
  FactorRow row = named_row(request, std::move(stored.mesh), path);
  if (request.is_exact) return evaluated(std::move(row), options);
  row.values = joint_row(*stored.transport, row.patches);
  return row;
}

FactorRow row_of_dense(const RowRequest& request, const std::string& path,
                       const EvaluatedRowOptions& options) {
  const io::FormFactorReader reader(path);
  FactorRow row = named_row(request, reader.mesh(), path);
  if (request.is_exact) return evaluated(std::move(row), options);
  const Eigen::Map<const Eigen::VectorXd> area(row.mesh.area.data(), row.mesh.size());
  row.values = joint_row(reader, area, row.patches);
  return row;
}

}  // namespace

JointRow by_surface(const FactorRow& row) {
  const auto n = static_cast<Index>(row.mesh.surface_names.size());
  JointRow result{Eigen::VectorXd::Zero(n), Eigen::VectorXd::Zero(n)};
  for (Index j = 0; j < row.mesh.size(); ++j) {
    result.factor[row.mesh.surface[j]] += row.values.factor[j];
    result.error[row.mesh.surface[j]] += square(row.values.error[j]);
  }
  result.error = result.error.cwiseSqrt();
  return result;
}

FactorRow find_factor_row(const RowRequest& request, const CommonOptions& common,
                          const study::StudyOptions& compute, const study::StudyEvents& events) {
  const EvaluatedRowOptions options{
      .tolerance = compute.tolerance, .seed = compute.seed, .progress = events.progress};
  if (!is_factor_file(common.scene)) {
    const Scene scene = read_checked_scene(common, events);
    study::Patches patches = study::divide(scene, compute, events);
    return evaluated(named_row(request, std::move(patches.mesh), common.scene), options);
  }
  return io::is_compressed_operator(common.scene)
             ? row_of_compressed(request, common.scene, options)
             : row_of_dense(request, common.scene, options);
}

}  // namespace apps
