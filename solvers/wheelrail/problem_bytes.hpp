// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include "treadmark/core/byte_archive.hpp"
#include "treadmark/solvers/wheelrail/configuration.hpp"

namespace treadmark::wheelrail {

/// Everything in a problem, bit by bit, so that problems with the same bytes are the same problem. Of numerical
/// coefficients of influence there are only the bytes that there are some.
void write(const Problem& problem, ByteWriter& out);

}  // namespace treadmark::wheelrail
