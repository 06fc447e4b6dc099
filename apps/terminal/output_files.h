#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace apps {

/// Whether the file is a picture (.png or .exr) by its extension.
bool is_picture(const std::filesystem::path& path);
/// Whether it holds form factors (.h5).
bool is_factor_file(const std::filesystem::path& path);

/// Whether it is glTF of one file (.glb).
bool is_glb(const std::filesystem::path& path);

/// Extensions that `solve` writes; `render` writes the pictures only. `form-factors` writes .h5
/// and, for the factors between surfaces, .csv, .txt (View3D's), .idf and .epJSON (EnergyPlus'),
/// and .dat (Elmer's) between polygons.
const std::vector<std::string>& result_extensions();
const std::vector<std::string>& picture_extensions();
const std::vector<std::string>& form_factor_extensions();

/// For the command line's check: empty if the extension of `path` is one of `allowed`, else what
/// was found and expected.
std::string check_extension(const std::string& path, const std::vector<std::string>& allowed);

/// Finds out before the long work what would fail after it. Throws OutputError if an output cannot
/// be written (io::check_writable), if it would replace the scene file, or if two are the same.
void check_outputs(const std::vector<std::string>& outputs, const std::filesystem::path& scene);

/// Throws OutputError if an output is one of the files that the scene is read from.
void check_against_inputs(const std::vector<std::string>& outputs,
                          const std::vector<std::filesystem::path>& inputs);

}  // namespace apps
