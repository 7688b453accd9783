// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

namespace treadmark::io {

/// Names in files of results that writer and reader share.
inline constexpr const char* kResultFormat = "treadmark result 1";
inline constexpr const char* kAxes = "x forward, y right, z down; forces and tractions act on the rail";
inline constexpr const char* kSurfaces = "surfaces";
inline constexpr const char* kSurfaceNames = "names";  // attribute of that group: its surfaces in their order

}  // namespace treadmark::io
