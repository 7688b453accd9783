// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/core/parts.hpp"
#include "treadmark/interfaces/c/calls.hpp"
#include "treadmark/interfaces/c/handles.hpp"

extern "C" tm_status tm_surface_from_scan(const char* const*, size_t, tm_body, const char* const*, size_t, char** audit,
                                          tm_surface** out) {
  if (audit != nullptr) *audit = nullptr;
  return treadmark::c::make(
      out, []() -> std::unique_ptr<tm_surface> { treadmark::left_out("scans", "the import of scans"); });
}
