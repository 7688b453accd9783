// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <string>
#include <string_view>

namespace treadmark::pictures {

/// Pieces of SVG pictures. All functions are thread-safe.

/// Rectangle in pixels, y downwards.
struct Box {
  double x = 0.0, y = 0.0, width = 0.0, height = 0.0;

  double right() const { return x + width; }
  double bottom() const { return y + height; }
  double middle_x() const { return x + 0.5 * width; }
  double middle_y() const { return y + 0.5 * height; }
};

/// Text for the inside of an element: markup escaped; control characters and bytes that are not UTF-8 become blanks
/// and question marks.
std::string xml_text(std::string_view words);

/// A text element; anchor is "start", "middle" or "end", more are further attributes with a leading blank.
std::string svg_text(double x, double y, std::string_view words, const char* anchor = "middle", const char* more = "");

/// The same, turned by so many degrees about its place.
std::string turned_text(double x, double y, std::string_view words, const char* anchor = "middle", int degrees = -90);

/// A rectangle of a class, as an outline; more: as above.
std::string svg_box(const char* name, const Box& box, std::string_view more = "");

/// A filled rectangle to 0.01 px.
std::string svg_cell(const Box& box, std::string_view fill);

/// Elements as a group whose origin is moved to (x, y); a class may be empty.
std::string svg_group(std::string_view name, double x, double y, const std::string& elements);

/// Three significant digits or all before the point.
std::string three_digits(double value);

/// "label [unit]", without a unit the label.
std::string with_unit(std::string_view label, std::string_view unit);

/// Rough width of a text in the pictures' font.
double text_width(const std::string& text, double font_size);

/// Opens a picture on white paper: the svg element, then the rules of a style sheet. Close with "</svg>\n".
std::string svg_head(double width, double height, int font_size, std::string_view style);

}  // namespace treadmark::pictures
