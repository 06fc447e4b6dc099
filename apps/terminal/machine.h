#pragma once

#include <string>

namespace apps {

/// The processor, the number of its threads and the operating system, as the system tells them.
std::string machine_text();

/// The time now, ISO 8601, UTC: "2024-05-31T12:00:00Z".
std::string time_text();

/// Has blocks of up to 256 MB that were freed used again rather than given back to the system,
/// since fresh memory costs more than a product that is done in it; half a gigabyte at most is
/// kept. Does nothing where the C library is not GNU's.
void keep_freed_memory();

}  // namespace apps
