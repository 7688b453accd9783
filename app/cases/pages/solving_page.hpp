// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include "treadmark/core/progress.hpp"
#include "treadmark/io/cases/case_model.hpp"
#include "treadmark/report/page.hpp"

namespace treadmark::app::pages {

/// The page of treadmark live for one case of a file (number: from 1), with the program for browsers and the files that
/// the case names in it. Errors: Error(configuration) where there is no such case or program, for a case of one patch,
/// slices, and a wheel that does not touch the rail; Cancelled; those of run_cases.
report::Page solving_page(io::CaseFile file, int number, const Progress& progress = {});

}  // namespace treadmark::app::pages
