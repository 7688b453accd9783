// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include "treadmark/core/byte_archive.hpp"
#include "treadmark/solvers/kalker/tangential/tangential_solver.hpp"

namespace treadmark::kalker {

void write(const TangentialStart& start, ByteWriter& out);

/// Errors: Error(input_data) for bytes that are no start values.
TangentialStart read_tangential_start(ByteReader& in);

}  // namespace treadmark::kalker
