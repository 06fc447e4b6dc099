#pragma once

#include <Eigen/Core>
#include <filesystem>

namespace io {

/// Writes form factors between surfaces as MOOSE's ViewFactorVectorPostprocessor does into its
/// .csv: `subdomain_id,vf_to_0,vf_to_1,...`, a row for each surface, numbered from 0. Throws
/// OutputError.
void write_moose_csv(const std::filesystem::path& path, const Eigen::MatrixXd& factors);

}  // namespace io
