// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <string>
#include <vector>

#include "treadmark/io/profiles/raw_points.hpp"

namespace treadmark::io::profiles {

/// Removes points that an instrument writes where it saw nothing: -9999 and the like, and 0 0 beside the profile. Any
/// unit. Notes say how many and where the first is. Error(input_data) when too few points are left to trust them.
void remove_drop_outs(RawPoints& points, std::vector<std::string>& notes);

/// Faults that make a contact wrong for certain, in points in mm: Error(input_data), placed at the line, for a spike
/// and for a second profile behind the first.
void refuse_faults(const RawPoints& points);

/// The middle value; 0 of none.
double median(std::vector<double> values);

/// Whether z runs one way over more than y, which goes to and fro: then y and z are exchanged.
bool seem_exchanged(const std::vector<double>& y, const std::vector<double>& z);

}  // namespace treadmark::io::profiles
