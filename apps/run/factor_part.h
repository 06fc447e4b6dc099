#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "apps/run/made_part.h"
#include "apps/terminal/interruption.h"
#include "io/result/part_file.h"
#include "radiosity/stream/streamed_factors.h"
#include "study/study.h"

namespace apps {

/// The third of sixteen for "3/16"; nothing if the text is no part of at most
/// radiosity::kMostParts.
std::optional<radiosity::WorkPart> parse_part(const std::string& text);
/// For the command line's check: empty if it is one, else what was found.
std::string check_part(const std::string& text);

/// Where a part of what goes to `output` is written: F.3-of-16.h5 for F.h5.
std::filesystem::path part_path(const std::filesystem::path& output, radiosity::WorkPart part);

/// What a part's file tells of the computation, but for its light.
io::FactorPart described_part(const radiosity::Scene& scene, const study::StudyOptions& options,
                              const radiosity::Fingerprint& fingerprint, radiosity::WorkPart part);

/// Makes a part of all form factors, in the work file, and writes it. Throws OutputError,
/// Interrupted.
MadePart write_streamed_part(const std::filesystem::path& path, const study::Patches& patches,
                             const io::FactorPart& part, const radiosity::StreamOptions& options,
                             radiosity::TileStore& store, Interruption& interruption);

/// The same of compressed ones, in StudyOptions::work_file.
MadePart write_compressed_part(const std::filesystem::path& path, const radiosity::Scene& scene,
                               const study::Patches& patches, io::FactorPart part,
                               const study::StudyOptions& options, const study::StudyEvents& events,
                               Interruption& interruption);

}  // namespace apps
