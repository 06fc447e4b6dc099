#include "io/result/row_csv.h"

#include <fmt/format.h>

#include <fstream>

#include "io/base/atomic_file.h"
#include "io/base/csv_field.h"

namespace io {

void write_row_csv(const std::filesystem::path& path, const radiosity::PatchMesh& mesh,
                   const radiosity::JointRow& row) {
  write_stream_atomically(path, [&](std::ofstream& stream) {
    stream << "patch,surface,factor,error\n";
    for (radiosity::Index j = 0; j < mesh.size() && stream; ++j) {
      stream << fmt::format("{},{},{},{}\n", j, csv_field(mesh.surface_names[mesh.surface[j]]),
                            row.factor[j], row.error[j]);
    }
  });
}

}  // namespace io
