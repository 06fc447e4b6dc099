#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace radiosity::test {

/// What came of reading damaged files of one format.
struct FuzzReport {
  long n_read = 0;
  long n_refused = 0;
  double slowest = 0;               ///< s
  std::vector<std::string> faults;  ///< "mutant 17: ..."; empty if all was well
};

/// "obj", "ply", "stl", "off", "msh", "gltf", "glb", "json", "csv", "vtu", "vtp", "h5". The .mtl
/// belongs to "obj" and is damaged as often.
const std::vector<std::string>& fuzz_formats();

/// Reads the mutants first, first + 1, ..., first + n - 1 of small files of a format: bytes
/// flipped, cut off, doubled, taken out or put in, numbers replaced, brackets nested deep. Each
/// must be read or refused with an exception of ours whose message is one line of at most 2,100
/// bytes, in at most 10 s. Same number, same mutant. `folder` gets the files; the last one stays
/// there, so that a crash can be repeated.
FuzzReport fuzz_reader(const std::string& format, std::uint64_t first, long n,
                       const std::filesystem::path& folder);

}  // namespace radiosity::test
