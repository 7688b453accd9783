// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <cstddef>
#include <string>

#include "treadmark/report/page.hpp"

namespace treadmark::report {

/// What the script needs to know of a page, as JSON text without "<": fields packed into at most field_budget bytes
/// where possible. The types are in report/web/src/data.ts.
std::string page_data(const Page& page, std::size_t field_budget);

}  // namespace treadmark::report
