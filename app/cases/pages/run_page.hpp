// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <memory>
#include <string>

#include "treadmark/report/page.hpp"

namespace treadmark::app::pages {

/// Report of a run: cases of a wheel on a rail, or of one patch. document: JSON text of the result, may be empty.
report::Page run_page(const std::shared_ptr<const io::RunResult>& run, std::string document);

/// What went wrong in a run and what is doubtful. name: of the run, where a page has several.
void add_run_banners(const io::RunResult& run, report::Section& overview, const std::string& name = {});

}  // namespace treadmark::app::pages
