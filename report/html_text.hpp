// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <string>
#include <string_view>

#include "treadmark/report/page.hpp"

namespace treadmark::report {

/// Text for the inside of an element or of an attribute in double quotes: markup and quotes escaped, bytes that are no
/// text replaced.
std::string html_text(std::string_view words);

/// A number as people read it: this many digits, all of whole numbers, no exponent for numbers of ordinary size, "–"
/// for what is not finite; 0 below 1e-12, which is nothing but rounding.
std::string shown(const Number& number);

/// A name that can be an id in HTML: letters, digits and dashes.
std::string html_id(std::string_view words);

}  // namespace treadmark::report
