// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include "treadmark/core/byte_archive.hpp"
#include "treadmark/solvers/kalker/history/contact_history.hpp"

namespace treadmark::kalker {

void write(const ContactHistory& history, ByteWriter& out);

/// Errors: Error(input_data) for bytes that are no history.
ContactHistory read_history(ByteReader& in);

}  // namespace treadmark::kalker
