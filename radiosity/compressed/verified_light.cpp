#include "radiosity/compressed/verified_light.h"

#include "radiosity/compressed/compressed_transport.h"
#include "radiosity/compressed/row_check.h"
#include "radiosity/exchange/exchange_evaluator.h"
#include "radiosity/visibility/coverage.h"

namespace radiosity {

std::optional<VerifiedLight> verify_light(const Transport& transport, const PatchMesh& mesh,
                                          const Visibility& visibility,
                                          const TransportOptions& options,
                                          const Eigen::MatrixXd& radiosity) {
  const auto* compressed = dynamic_cast<const CompressedTransport*>(&transport);
  if (compressed == nullptr) return std::nullopt;
  const Coverage coverage = find_coverage(mesh, plane_thickness(mesh));
  const ExchangeEvaluator evaluator(mesh, visibility, coverage,
                                    {.tolerance = options.tolerance, .seed = options.seed});
  RowCheck check(evaluator, mesh.area, likely_errors(*compressed), radiosity, options.seed);
  const RowCheck::Error error =
      check.decide(transport.apply(radiosity), options.tolerance, options.progress);
  return VerifiedLight{error.limit, error.n_rows};
}

}  // namespace radiosity
