// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <fcntl.h>

#include <cstdio>

namespace treadmark {

/// Whether two files or folders now have each other's name, at one instant; false where the system cannot do that.
inline bool exchange_names([[maybe_unused]] const char* a, [[maybe_unused]] const char* b) {
#if defined(RENAME_EXCHANGE)
  return ::renameat2(AT_FDCWD, a, AT_FDCWD, b, RENAME_EXCHANGE) == 0;
#else
  return false;
#endif
}

}  // namespace treadmark
