// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <vector>

#include "treadmark/io/hdf5/attribute.hpp"
#include "treadmark/io/results/result_model.hpp"

namespace treadmark::io {

/// What is written at the group of a run, a case and a patch, besides their parts and fields.
std::vector<Attribute> attributes_of(const RunResult& run);
std::vector<Attribute> attributes_of(const CaseResult& result);
std::vector<Attribute> attributes_of(const PatchResult& patch);

}  // namespace treadmark::io
