#pragma once

#include <hdf5.h>

#include "radiosity/operator/transport.h"

/// How an operator was made, in an HDF5 file: /closure (row sums before any correction), /covered,
/// /backs, /pairs, attributes closed and open_rows.
namespace io::hdf5 {

/// Throws HdfError.
void write_report(hid_t file, const radiosity::AssemblyReport& report);

/// What write_report wrote of n patches. Throws HdfError.
radiosity::AssemblyReport read_report(hid_t file, radiosity::Index n);

}  // namespace io::hdf5
