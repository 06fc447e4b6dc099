#pragma once

#include <optional>
#include <string>

#include "apps/options/common_options.h"
#include "study/study.h"

namespace apps {

/// Reads the scene and makes its form factors, or takes those of a file if one is named. Throws
/// OutputError if an output is that file; as read_checked_scene, io::read_operator and
/// study::assemble do.
study::Study assemble_scene(const CommonOptions& common, const study::StudyOptions& compute,
                            const std::optional<std::string>& operator_file,
                            const study::StudyEvents& events);

/// Writes the form factors so that they can be used for other light. It may take a while, and may
/// be cut off.
void write_operator(const std::string& path, const study::Study& study,
                    const radiosity::Progress& progress);

}  // namespace apps
