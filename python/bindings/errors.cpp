#include "python/bindings/errors.h"

#include <pybind11/pybind11.h>

#include <exception>
#include <new>

#include "radiosity/base/error.h"

namespace python {
namespace {

namespace py = pybind11;

void raise(const char* name, const char* message) {
  const py::object type = py::module_::import("radiosity._errors").attr(name);
  PyErr_SetString(type.ptr(), message);
}

void translate(std::exception_ptr thrown) {
  try {
    if (thrown) std::rethrow_exception(thrown);
  } catch (const radiosity::MemoryShortage& error) {
    raise("MemoryShortage", error.what());
  } catch (const std::bad_alloc&) {
    raise("MemoryShortage", "out of memory");
  } catch (const radiosity::SceneError& error) {
    raise("SceneError", error.what());
  } catch (const radiosity::MeshError& error) {
    raise("MeshError", error.what());
  } catch (const radiosity::SolveError& error) {
    raise("SolveError", error.what());
  } catch (const radiosity::OutputError& error) {
    raise("OutputError", error.what());
  } catch (const radiosity::Interrupted&) {
    PyErr_SetNone(PyExc_KeyboardInterrupt);
  }
}

}  // namespace

void translate_errors() { py::register_exception_translator(&translate); }

}  // namespace python
