#include "viewer/script/luminaire_actions.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "viewer/desk/luminaires.h"

namespace viewer {
namespace {

void choose(Stage& stage, ScriptArguments& arguments) {
  if (arguments.has("luminaire") && arguments.value("luminaire").is_null()) {
    choose_luminaire(stage.desk, std::nullopt);
    return;
  }
  const std::string name = arguments.name("luminaire");
  const auto& luminaires = stage.desk.luminaires;
  const auto found = std::find_if(luminaires.begin(), luminaires.end(),
                                  [&](const LuminaireFacts& facts) { return facts.name == name; });
  if (found == luminaires.end()) {
    throw std::invalid_argument(fmt::format("no luminaire is called '{}'; there are {}", name,
                                            luminaires.empty() ? "none" : "others"));
  }
  choose_luminaire(stage.desk, static_cast<std::size_t>(found - luminaires.begin()));
}

}  // namespace

std::map<std::string, ActionKind> luminaire_actions() {
  return {{"choose-luminaire", {"luminaire", at_once(choose)}}};
}

}  // namespace viewer
