#pragma once

#include <filesystem>

#include "io/result/element_rows.h"

namespace io {

enum class ElmerFile { text, binary };

/// Writes form factors as the finite-element solver Elmer reads them (ViewFactors.dat): for each
/// radiating boundary element i a line with the number of elements that it sees, and for each of
/// these a line `i j F_ij`, counted from 1. Binary: the number of elements as int32, then for each
/// the number that it sees as int32 and for these j as int32 and F_ij as float64, least byte first.
/// Throws OutputError.
void write_elmer_factors(const std::filesystem::path& path, const ElementRows& rows,
                         ElmerFile kind = ElmerFile::text);

}  // namespace io
