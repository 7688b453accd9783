// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "treadmark/interfaces/contact/contact_addon.h"

namespace treadmark::contact {

/// A flag that belongs to a problem.
struct FlagRow {
  /// What becomes of a value out of range.
  enum class Outside { clamp, keep, zero, raise } outside = Outside::clamp;
  int code = 0;
  int least = 0, greatest = 0;
  int initial = 0;
};

std::span<const FlagRow> flag_rows();

/// The values of all flags.
class Flags {
 public:
  Flags();
  int operator[](int code) const;  ///< 0 for a code that is no flag
  int& at(int code);               ///< of a flag

 private:
  std::array<int, 24> values_{};
};

}  // namespace treadmark::contact
