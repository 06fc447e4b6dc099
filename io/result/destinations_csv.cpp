#include "io/result/destinations_csv.h"

#include <fmt/format.h>

#include <fstream>

#include "io/base/atomic_file.h"
#include "io/base/csv_field.h"

namespace io {

void write_destinations_csv(const std::filesystem::path& path,
                            const std::vector<std::string>& surface_names,
                            const radiosity::DestinationEstimate& shares) {
  const auto& value = shares.value;
  const auto& error = shares.error;
  write_stream_atomically(path, [&](std::ofstream& stream) {
    stream << "destination,surface,factor,error\n";
    for (std::size_t s = 0; s < surface_names.size(); ++s) {
      const auto k = static_cast<Eigen::Index>(s);
      stream << fmt::format("surface,{},{},{}\n", csv_field(surface_names[s]), value.surfaces[k],
                            error.surfaces[k]);
    }
    stream << fmt::format("backs,,{},{}\nsky,,{},{}\n", value.backs, error.backs, value.sky,
                          error.sky);
  });
}

}  // namespace io
