#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "apps/options/common_options.h"
#include "apps/run/part_set.h"
#include "apps/terminal/interruption.h"
#include "radiosity/operator/transport.h"
#include "radiosity/scene/patch_mesh.h"
#include "radiosity/stream/streamed_factors.h"
#include "study/study_events.h"

namespace CLI {
class App;
}  // namespace CLI

namespace apps {

/// `radiosity merge PART... -o F.h5`: puts the parts of `form-factors --part` together, to the same
/// bytes as without. Adds itself to the program and runs when that is parsed; must outlive the
/// parsing.
class MergeCommand {
 public:
  MergeCommand(CLI::App& program, Interruption& interruption);
  MergeCommand(const MergeCommand&) = delete;
  MergeCommand& operator=(const MergeCommand&) = delete;

 private:
  void run() const;
  /// What became of the parts.
  struct Merged {
    radiosity::AssemblyReport report;
    std::uint64_t bytes = 0;
    radiosity::DroppedFactors dropped{};
  };
  [[nodiscard]] Merged merge_streamed(const PartSet& parts, const radiosity::PatchMesh& mesh,
                                      const std::filesystem::path& work_file,
                                      const study::StudyEvents& events) const;
  [[nodiscard]] Merged merge_compressed(const PartSet& parts, const radiosity::PatchMesh& mesh,
                                        const std::filesystem::path& work_file,
                                        const study::StudyEvents& events) const;

  Interruption& interruption_;
  CommonOptions common_;
  std::vector<std::string> parts_;
  std::string memory_;
};

}  // namespace apps
