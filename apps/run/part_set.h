#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "io/result/part_file.h"
#include "radiosity/base/progress.h"

namespace apps {

/// The parts that make up one computation.
struct PartSet {
  std::vector<std::filesystem::path> files;  ///< in the order of the parts
  io::FactorPart common;                     ///< what the first one tells
};

/// Finds out what the files are parts of. Throws SceneError in one line, naming the files, if one
/// is no part, if they are of different scenes, tolerances, options, versions or numbers of parts,
/// and if parts are missing or there twice.
PartSet find_parts(const std::vector<std::string>& files, const radiosity::Progress& progress);

/// Appends the records of all parts to a work file. Throws as PartReader and WorkFile do.
void gather_records(const PartSet& parts, const std::filesystem::path& work_file,
                    const radiosity::Progress& progress);

}  // namespace apps
