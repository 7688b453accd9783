// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include "treadmark/model/shape/profile.hpp"

namespace treadmark {

/// As files and messages name it.
constexpr const char* body_name(Body body) { return body == Body::wheel ? "wheel" : "rail"; }

}  // namespace treadmark
