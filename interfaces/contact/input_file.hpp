// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include "treadmark/interfaces/contact/problem.hpp"

namespace treadmark::contact {

/// Appends a case to the input file of this session (<output folder><name>.inp), which begins with the first one;
/// points of a profile that the caller has given lie in a file beside it. What cannot be written is warned about.
/// Thread-safe.
void write_input(const Problem& problem, io::Case c);
/// Ends the file, if there is one.
void close_input();

}  // namespace treadmark::contact
