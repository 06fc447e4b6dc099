#pragma once

#include <imgui.h>

namespace viewer {

/// Colours of text: of what is plain, of what is to be doubted or is no result, of errors, and of
/// what was said about something else.
inline const ImVec4 kPlainInk(0.92F, 0.92F, 0.92F, 1);
inline const ImVec4 kDoubtInk(1, 0.75F, 0.25F, 1);
inline const ImVec4 kErrorInk(1, 0.45F, 0.4F, 1);
inline const ImVec4 kPastInk(0.5F, 0.5F, 0.5F, 1);

}  // namespace viewer
