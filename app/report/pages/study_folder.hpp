// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <filesystem>

#include "treadmark/app/report/pages/sweep_page.hpp"

namespace treadmark::app::report {

/// The folder of a study, also while runs are being solved or after they were interrupted. Errors: Error(input_data).
/// Not to be called from two threads at once.
StudyOnDisk read_study_folder(const std::filesystem::path& folder);

}  // namespace treadmark::app::report
