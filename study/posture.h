#pragma once

#include <optional>
#include <string_view>

namespace study {

enum class Posture { standing, seated };

/// "standing" or "seated"; empty if the text is neither.
std::optional<Posture> posture_named(std::string_view name);

}  // namespace study
