// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "treadmark/app/report/page.hpp"
#include "treadmark/io/results/comparison_model.hpp"

namespace treadmark::app::report {

/// Report of a comparison; document: its JSON text. The frames of the page keep the comparison alive.
Page compare_page(const std::shared_ptr<const io::Comparison>& comparison, std::string document);

/// Report of a folder of `treadmark compare`: compare.json and, as far as they are there, fields.h5 or pressures.svg.
/// Errors: as io::read_comparison. Not to be called from two threads at once (HDF5).
Page compare_page(const std::filesystem::path& folder);

}  // namespace treadmark::app::report
