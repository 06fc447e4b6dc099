#include "apps/run/assembled_scene.h"

#include <utility>

#include "apps/run/scene_input.h"
#include "apps/terminal/output_files.h"
#include "io/result/operator_file.h"

namespace apps {
namespace {

study::KnownFactors read_factors(const std::string& path, const study::StudyEvents& events) {
  io::StoredOperator stored = io::read_operator(path, events.progress);
  return {.source = path,
          .mesh = std::move(stored.mesh),
          .transport = std::move(stored.transport),
          .tolerance = stored.tolerance,
          .geometry = std::move(stored.geometry)};
}

}  // namespace

study::Study assemble_scene(const CommonOptions& common, const study::StudyOptions& compute,
                            const std::optional<std::string>& operator_file,
                            const study::StudyEvents& events) {
  if (operator_file) check_against_inputs(common.outputs, {*operator_file});
  radiosity::Scene scene = read_checked_scene(common, events);
  if (!operator_file) return study::assemble(std::move(scene), compute, events);
  return study::assemble(std::move(scene), read_factors(*operator_file, events), compute, events);
}

void write_operator(const std::string& path, const study::Study& study,
                    const radiosity::Progress& progress) {
  io::write_operator(
      path, study.mesh, *study.transport,
      {.tolerance = study.factor_tolerance, .geometry = study::geometry_fingerprint(study.scene)},
      progress);
}

}  // namespace apps
