#include "io/result/hdf5_report.h"

#include <cstdint>
#include <vector>

#include "io/result/hdf5_input.h"
#include "io/result/hdf5_output.h"

namespace io::hdf5 {

using radiosity::AssemblyReport;
using radiosity::Index;

namespace {

constexpr hsize_t kPairCounts = 7;

Eigen::VectorXd read_shares(hid_t file, const char* name, Index n) {
  const auto values = read_all<double>(file, name, {static_cast<hsize_t>(n)});
  return Eigen::Map<const Eigen::VectorXd>(values.data(), n);
}

}  // namespace

void write_report(hid_t file, const AssemblyReport& report) {
  write_attribute(file, "closed", static_cast<std::int32_t>(report.closed));
  write_attribute(file, "open_rows", report.open_rows);
  write_list(file, "closure", report.row_sums);
  write_list(file, "covered", report.covered);
  write_list(file, "backs", report.backs);
  write_list(
      file, "pairs",
      std::vector<std::int64_t>{report.facing, report.visible, report.hidden, report.undecided,
                                report.partial, report.known, report.rays});
}

AssemblyReport read_report(hid_t file, Index n) {
  AssemblyReport report;
  report.closed = read_attribute<std::int32_t>(file, "closed") != 0;
  report.open_rows = read_attribute<std::int64_t>(file, "open_rows");
  report.row_sums = read_shares(file, "closure", n);
  report.covered = read_shares(file, "covered", n);
  report.backs = read_shares(file, "backs", n);
  const Eigen::ArrayXd gap = (1 - report.covered.array() - report.row_sums.array()).abs();
  report.closure_mean = gap.mean();
  report.closure_max = gap.maxCoeff();
  const auto pairs = read_all<std::int64_t>(file, "pairs", {kPairCounts});
  report.facing = pairs[0];
  report.visible = pairs[1];
  report.hidden = pairs[2];
  report.undecided = pairs[3];
  report.partial = pairs[4];
  report.known = pairs[5];
  report.rays = pairs[6];
  return report;
}

}  // namespace io::hdf5
