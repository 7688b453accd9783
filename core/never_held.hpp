// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <variant>

namespace treadmark {

/// An alternative that no variant holds. Of a variant with only texts, lists and plain types libstdc++ 12 takes for
/// granted that it holds one of them, and so destroys one that was never made when there is no memory to copy it. With
/// this alternative it asks.
struct NeverHeld {
  NeverHeld() = delete;
  NeverHeld(const NeverHeld&) {}  // NOLINT(modernize-use-equals-default): must not be trivial
  NeverHeld& operator=(const NeverHeld&) = default;
  operator std::monostate() const { return {}; }  // for visitors
};

}  // namespace treadmark
