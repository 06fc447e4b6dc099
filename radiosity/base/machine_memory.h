#pragma once

#include <cstddef>
#include <string>

namespace radiosity {

/// Bytes that this program may reasonably take: nine tenths of what the machine has available or of
/// what the control group (container) still allows, whichever is less. The rest is for the mesh,
/// the ray tracer and the result. 0 if the system does not tell.
std::size_t usable_memory();

/// What `memory` bytes allow: 0 stands for `usable_memory`, and what the machine does not tell has
/// no limit.
std::size_t memory_limit(std::size_t memory);

/// A size rounded up to whole megabytes or, from 1000 on, hundredths of a gigabyte: "40MB",
/// "1.25GB".
std::string memory_text(std::size_t bytes);

/// A size to three digits: "0.0213 GB", "24 GB".
std::string gigabytes(std::size_t bytes);

}  // namespace radiosity
