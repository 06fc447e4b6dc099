#pragma once

#include <optional>
#include <string>
#include <vector>

namespace apps {

/// The fields between the commas.
std::vector<std::string> split_at_commas(const std::string& text);

/// The finite number that the whole text spells; empty if it spells none.
std::optional<double> as_number(const std::string& text);

/// The finite numbers of "1,-2,3e4"; empty if any field is none or there are not `count` of them.
std::optional<std::vector<double>> as_numbers(const std::string& text, std::size_t count);

/// For the command line's check: empty if `text` is a finite number above zero, else what was
/// found. (CLI::PositiveNumber lets NaN pass.)
std::string check_positive(const std::string& text);
/// The same for a number above 0 and below 1.
std::string check_share(const std::string& text);

}  // namespace apps
