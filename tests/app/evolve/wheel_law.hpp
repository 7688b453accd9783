// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <string>

namespace treadmark::testing {

/// How a wheel wears in studies of evolutions.
inline const std::string kLaw = R"(
[evolve.wheel.law]
theory = "archard"
source = "assumed"
hardness_GPa = 3.0
k = [1e-4]
)";

}  // namespace treadmark::testing
