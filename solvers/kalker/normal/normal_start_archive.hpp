// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include "treadmark/core/byte_archive.hpp"
#include "treadmark/solvers/kalker/normal/normal_solver.hpp"

namespace treadmark::kalker {

void write(const NormalStart& start, ByteWriter& out);

/// Errors: Error(input_data) for bytes that are no start values.
NormalStart read_normal_start(ByteReader& in);

}  // namespace treadmark::kalker
