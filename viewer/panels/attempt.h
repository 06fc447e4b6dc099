#pragma once

#include <exception>

#include "viewer/desk/desk.h"

namespace viewer {

/// Does what may fail; the console tells why if it does.
template <typename Work>
void attempt(Desk& desk, const Work& work) {
  try {
    work();
  } catch (const std::exception& error) {
    desk.session.tell_error(error.what());
  }
}

}  // namespace viewer
