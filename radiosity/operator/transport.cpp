#include "radiosity/operator/transport.h"

#include "radiosity/base/error.h"

namespace radiosity {

const FactorRows& rows_of(const Transport& transport) {
  if (const FactorRows* rows = transport.rows()) return *rows;
  throw SolveError("this needs the rows of the form factors, which this operator does not keep");
}

const FactorRows& quick_rows_of(const Transport& transport) {
  if (!transport.has_quick_rows()) {
    throw SolveError(
        "this method goes row by row, and rows of a compressed operator take a product each: use "
        "a dense operator (--transport dense), or conjugate gradients (--method cg)");
  }
  return rows_of(transport);
}

}  // namespace radiosity
