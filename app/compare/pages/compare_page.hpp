// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "treadmark/io/results/comparison_model.hpp"
#include "treadmark/report/page.hpp"

namespace treadmark::app::pages {

/// Report of a comparison; document: its JSON text. The frames of the page keep the comparison alive.
report::Page compare_page(const std::shared_ptr<const io::Comparison>& comparison, std::string document);

/// Report of a folder of `treadmark compare`: compare.json and, as far as they are there, fields.h5 or pressures.svg.
/// Errors: as io::read_comparison. Not to be called from two threads at once (HDF5).
report::Page compare_page(const std::filesystem::path& folder);

}  // namespace treadmark::app::pages
