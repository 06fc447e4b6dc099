#pragma once

#include <CLI/App.hpp>
#include <optional>
#include <string>
#include <vector>

#include "apps/common_options.h"
#include "apps/interruption.h"

namespace apps {

/// `radiosity form-factors SCENE -o F.h5 [--by surface]`: computes the form factors, writes them to
/// a file and, by surface, to the terminal. With `--from`, only those from one point or surface.
/// Adds itself to the program and runs when that is parsed; must outlive the parsing.
class FormFactorsCommand {
 public:
  FormFactorsCommand(CLI::App& program, Interruption& interruption);
  FormFactorsCommand(const FormFactorsCommand&) = delete;
  FormFactorsCommand& operator=(const FormFactorsCommand&) = delete;

 private:
  void run() const;
  void run_from(const std::string& from) const;

  Interruption& interruption_;
  CommonOptions common_;
  ComputeOptions compute_;
  std::vector<std::string> outputs_;
  std::string by_;
  std::optional<std::string> from_;
};

}  // namespace apps
