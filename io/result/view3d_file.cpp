#include "io/result/view3d_file.h"

#include <fmt/format.h>

#include <Eigen/LU>
#include <bit>
#include <fstream>
#include <string>

#include "io/base/atomic_file.h"

namespace io {
namespace {

/// What View3D takes emissivities to be, at least and at most.
constexpr double kLeastEmissivity = 0.001;
constexpr double kMostEmissivity = 0.999;

Eigen::MatrixXd script_f(const Eigen::MatrixXd& factors, const Eigen::VectorXd& emissivities) {
  const Eigen::VectorXd reflectances = 1 - emissivities.array();
  const Eigen::Index n = factors.rows();
  const Eigen::MatrixXd system =
      Eigen::MatrixXd::Identity(n, n) - factors * reflectances.asDiagonal();
  const Eigen::MatrixXd gebhart = system.partialPivLu().solve(factors * emissivities.asDiagonal());
  return emissivities.asDiagonal() * gebhart;
}

std::string line_of(const Eigen::VectorXd& numbers, const char* format) {
  std::string line;
  for (const double number : numbers) {
    if (!line.empty()) line += ' ';
    line += fmt::format(fmt::runtime(format), number);
  }
  return line + '\n';
}

std::string bytes_of(const Eigen::VectorXd& numbers) {
  std::string bytes;
  for (const double number : numbers) {
    const auto bits = std::bit_cast<std::uint32_t>(static_cast<float>(number));
    for (unsigned shift = 0; shift < 32; shift += 8) bytes += static_cast<char>(bits >> shift);
  }
  return bytes;
}

}  // namespace

void write_view3d(const std::filesystem::path& path, const View3dTable& table,
                  const View3dOptions& options) {
  const Eigen::VectorXd emissivities =
      table.emissivities.cwiseMax(kLeastEmissivity).cwiseMin(kMostEmissivity);
  const Eigen::MatrixXd factors =
      options.is_script_f ? script_f(table.factors, emissivities) : table.factors;
  const auto row_text = [&](const Eigen::VectorXd& numbers, const char* format) {
    return options.is_binary ? bytes_of(numbers) : line_of(numbers, format);
  };
  write_stream_atomically(path, [&](std::ofstream& stream) {
    const std::string header = fmt::format("View3D 4.0.0 {:d} {:d} {:d} {}", options.is_binary,
                                           table.is_enclosure, options.is_script_f, factors.rows());
    stream << fmt::format("{:<30}{}", header, options.is_binary ? "\r\n" : "\n");
    stream << row_text(table.areas, "{:g}");
    for (Eigen::Index s = 0; s < factors.rows() && stream; ++s) {
      stream << row_text(factors.row(s), "{:.6f}");
    }
    stream << row_text(emissivities, "{:.3f}");
  });
}

}  // namespace io
