#include "io/result/moose_csv.h"

#include <fmt/format.h>

#include <fstream>
#include <iterator>
#include <string>

#include "io/base/atomic_file.h"

namespace io {

void write_moose_csv(const std::filesystem::path& path, const Eigen::MatrixXd& factors) {
  write_stream_atomically(path, [&](std::ofstream& stream) {
    std::string line = "subdomain_id";
    for (Eigen::Index t = 0; t < factors.cols(); ++t) line += fmt::format(",vf_to_{}", t);
    stream << line << '\n';
    for (Eigen::Index s = 0; s < factors.rows() && stream; ++s) {
      line = fmt::format("{}", s);
      for (const double factor : factors.row(s)) {
        fmt::format_to(std::back_inserter(line), ",{}", factor);
      }
      stream << line << '\n';
    }
  });
}

}  // namespace io
