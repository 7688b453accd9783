// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <span>
#include <string>
#include <vector>

namespace treadmark::io {

/// Rectangle in pixels, y downwards.
struct ChartBox {
  double x = 0.0, y = 0.0, width = 0.0, height = 0.0;
};

/// A point that wants a text beside it [px].
struct LabelPoint {
  double x = 0.0, y = 0.0, radius = 0.0;
  std::string text;
};

/// Where the text goes: its baseline's start (left end).
struct LabelPlace {
  double x = 0.0, y = 0.0;
};

/// Rough width of a text in the pictures' font.
double text_width(const std::string& text, double font_size);

/// Places of the texts, in the order of the points: beside, above or below each, inside the box, on as few markers and
/// other texts as can be found one after the other. Points without a text are only kept clear. Thread-safe.
std::vector<LabelPlace> place_labels(std::span<const LabelPoint> points, const ChartBox& box, double font_size);

}  // namespace treadmark::io
