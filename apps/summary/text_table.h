#pragma once

#include <Eigen/Core>
#include <string>
#include <string_view>
#include <vector>

namespace apps {

/// A cell for each column.
using Row = std::vector<std::string>;

/// A line of a summary: what it tells, then its value.
std::string line(std::string_view label, std::string_view value);

/// Columns as wide as their longest cell; the first is aligned left, the others right.
std::string table(const std::vector<Row>& rows);

/// All values if they are few, else their range.
std::string numbers(const Eigen::VectorXd& values);

}  // namespace apps
