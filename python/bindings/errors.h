#pragma once

namespace python {

/// From now on what is thrown comes out as the exceptions of radiosity/_errors.py.
void translate_errors();

}  // namespace python
