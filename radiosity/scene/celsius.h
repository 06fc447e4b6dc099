#pragma once

#include <optional>
#include <span>
#include <string>

namespace radiosity {

/// What is to be told of temperatures that are all from 10 to 60 K, as rooms and machines have in
/// degrees Celsius; 0 K, as of space, and NaN are left out of account. Nothing if there are none,
/// or others.
std::optional<std::string> celsius_warning(std::span<const double> kelvins);

}  // namespace radiosity
