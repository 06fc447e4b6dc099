#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <span>
#include <string>

namespace io {

/// What is wrong with a reflectance, one value per band; empty if all lie in [0, 1].
std::optional<std::string> reflectance_problem(const Eigen::VectorXd& reflectance);

/// What is wrong with the values of an emission (`name`: "radiance", "temperature"...); empty if
/// all are finite and >= 0.
std::optional<std::string> emission_problem(const std::string& name, const Eigen::VectorXd& value);

/// What is wrong with vertex indices that count from 0; empty if all are below `n_vertices`.
std::optional<std::string> index_problem(std::span<const std::int64_t> indices,
                                         std::int64_t n_vertices);

/// The same of a face, which must have three or more.
std::optional<std::string> face_problem(std::span<const std::int64_t> indices,
                                        std::int64_t n_vertices);

}  // namespace io
