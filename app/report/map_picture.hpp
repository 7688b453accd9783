// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <string>

#include "treadmark/app/report/page.hpp"

namespace treadmark::app::report {

/// A map as an SVG picture, averaged where it is finer than the picture; places without values stay empty. Thread-safe.
std::string map_svg(const MapView& map, const std::string& title);

}  // namespace treadmark::app::report
