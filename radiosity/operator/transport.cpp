#include "radiosity/operator/transport.h"

#include "radiosity/base/error.h"

namespace radiosity {

const FactorRows& rows_of(const Transport& transport) {
  if (const FactorRows* rows = transport.rows()) return *rows;
  throw SolveError("this needs the rows of the form factors, which this operator does not keep");
}

}  // namespace radiosity
