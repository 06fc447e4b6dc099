#include "radiosity/solve/solve_conditions.h"

#include <cmath>
#include <cstdint>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "radiosity/solve/solve.h"
#include "radiosity/solve/trapped_light.h"

namespace radiosity {
namespace {

/// Heats that add up to less than this share of their magnitudes add up to nothing.
constexpr double kHeatRounding = 1e-12;

/// What is given to the patches, W, in the first column in which that is anything.
double given_heat(const PatchMesh& mesh, const Conditions& conditions,
                  const std::vector<std::int32_t>& patches) {
  for (Index c = 0; c < conditions.exitance.cols(); ++c) {
    double heat = 0;
    double magnitude = 0;
    for (const std::int32_t patch : patches) {
      const double given = mesh.area[patch] * conditions.exitance(patch, c);
      heat += given;
      magnitude += std::abs(given);
    }
    if (std::abs(heat) > kHeatRounding * magnitude) return heat;
  }
  return 0;
}

std::string floating_group(const PatchMesh& mesh, const Conditions& conditions,
                           const TrappedLight& trapped) {
  std::set<std::string> names;
  for (const std::int32_t patch : trapped.patches) {
    names.insert(mesh.surface_names[mesh.surface[patch]]);
  }
  const double heat = given_heat(mesh, conditions, trapped.patches);
  std::ostringstream text;
  text << "no surface of a floating group has a temperature and nothing leaves it: ";
  const char* comma = "";
  for (const std::string& name : names) {
    text << comma << name;
    comma = ", ";
  }
  if (heat != 0) {
    text << "; " << heat << " W are given to it in all, which nothing can take up";
  } else {
    text << "; the heat given to it adds up to 0, so that any temperature would do";
  }
  text << "; expected a temperature of one of them, or an opening";
  return text.str();
}

}  // namespace

Solution solve(const PatchMesh& mesh, const Transport& transport, const Conditions& conditions,
               const SolveOptions& options) {
  try {
    return solve(transport, conditions.exitance, conditions.reflectance, options);
  } catch (const TrappedLight& trapped) {
    if (conditions.emissivity.size() == 0) throw;
    throw SolveError(floating_group(mesh, conditions, trapped));
  }
}

}  // namespace radiosity
