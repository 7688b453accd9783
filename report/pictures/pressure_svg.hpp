// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <string>

#include "treadmark/io/results/result_model.hpp"

namespace treadmark::pictures {

/// Contact pressure of all cases as one SVG picture: a panel per case, the same scales in all, seen along the contact
/// normal with x to the right. The lateral axis runs along the contact plane, counted from the patch's y in track axes.
/// Patches of more than 96 elements in a direction are drawn from averaged blocks of elements. Needs the fields of the
/// patches; a case without is an empty panel that says why. Thread-safe.
/// Errors: Error(configuration) for fields that do not match their grid.
std::string pressure_svg(const io::RunResult& run);

}  // namespace treadmark::pictures
