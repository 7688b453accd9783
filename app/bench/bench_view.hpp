// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include "treadmark/app/bench/bench_scene.hpp"

namespace treadmark::app {

/// A view of a surface round a point of contact, from y_before (negative) to y_after beside it [m].
BenchView make_bench_view(const Surface& surface, const Vec3& contact_S, double y_before, double y_after,
                          const BenchGrid& grid);

}  // namespace treadmark::app
