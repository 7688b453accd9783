// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include "treadmark/app/geometry/geometry_run.hpp"
#include "treadmark/report/page.hpp"

namespace treadmark::app {

/// Report of a wheelset on its track: both sides in contact, moved by the shift, with all functions of it, conicity
/// and, where there is one, the map over the gauge. Thread-safe.
report::Page geometry_page(const GeometryResult& result);

}  // namespace treadmark::app
