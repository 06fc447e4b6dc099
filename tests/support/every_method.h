#pragma once

#include <gtest/gtest.h>

#include <string>

#include "radiosity/solve/solution.h"

namespace radiosity::test {

inline constexpr Method kMethods[] = {Method::conjugate_gradients, Method::jacobi,
                                      Method::gauss_seidel, Method::southwell, Method::chebyshev};

/// Names a test after its method, for INSTANTIATE_TEST_SUITE_P.
inline std::string method_test_name(const ::testing::TestParamInfo<Method>& method) {
  std::string name(method_name(method.param));
  std::erase(name, '-');
  return name;
}

}  // namespace radiosity::test
