// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

namespace treadmark::io {

/// A finite number rounded to 12 significant digits, as JSON files hold it: changes of unit leave no tail of nines.
/// Thread-safe.
double twelve_digits(double value);

}  // namespace treadmark::io
