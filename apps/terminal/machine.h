#pragma once

#include <string>

namespace apps {

/// The processor, the number of its threads and the operating system, as the system tells them.
std::string machine_text();

/// The time now, ISO 8601, UTC: "2024-05-31T12:00:00Z".
std::string time_text();

}  // namespace apps
