#pragma once

#include <functional>
#include <stop_token>
#include <string_view>

#include "radiosity/base/error.h"

namespace radiosity {

/// How long work tells where it stands and learns that it should stop. Both parts are optional.
struct Progress {
  /// Called with the name of the stage ("form factors"), the work done and the total, in the unit
  /// of work that `unit` names ("pairs"). May be called from any thread, never from two at once.
  std::function<void(std::string_view stage, double done, double total, std::string_view unit)>
      report;
  /// Work ends with `Interrupted` within a fraction of a second once this is requested.
  std::stop_token stop;

  /// Throws Interrupted if stopping was requested.
  void check() const {
    if (stop.stop_requested()) throw Interrupted();
  }
};

}  // namespace radiosity
