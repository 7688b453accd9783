// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <atomic>
#include <cstdint>

namespace treadmark::faults {

/// The kinds of calls that are counted apart, in the order of kClassNames.
enum class Class { open, write, fsync, rename, mkdir, unlink, close, truncate, lock, any, memory };
inline constexpr const char* kClassNames[] = {"open",  "write",    "fsync", "rename", "mkdir",  "unlink",
                                              "close", "truncate", "lock",  "any",    "memory", "malloc"};
inline constexpr int kClasses = 11;

/// What a program under the shim and its test share: a file that both map, so that it outlives a kill.
struct Counts {
  std::atomic<std::uint64_t> calls[kClasses];  ///< so far
  std::atomic<std::uint64_t> fired;            ///< faults that were injected
};

/// One operation of the log, followed by both paths and the data.
struct LogHead {
  char operation;            ///< c create, t truncate to `offset`, w write, s fsync, r rename, d mkdir, u unlink
  std::uint64_t offset = 0;  ///< [bytes]
  std::uint32_t first = 0;   ///< length of the path
  std::uint32_t second = 0;  ///< length of the new path of a rename
  std::uint64_t data = 0;    ///< [bytes] that were written
};

}  // namespace treadmark::faults
