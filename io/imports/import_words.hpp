// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "treadmark/io/imports/import_report.hpp"
#include "treadmark/model/shape/body_name.hpp"

namespace treadmark::io {

/// Numbers as the summary and the pictures of an import write them. Thread-safe.

/// "1 234 567".
std::string grouped(std::size_t count);

/// "0.123 %", of nothing "-".
std::string percent(std::size_t part, std::size_t whole);
std::string percent(double part);

/// A length [m] with three digits in um, mm or m, or "-" where it is not finite; micro is how the u of um is written.
std::string length_text(double metres, std::string_view micro = "u");

/// The error of the surface's heights: "3 um rms, 12 um largest"; where halves were not fitted what points held out
/// tell, "6 um", or "below 2.6 um" where it does not stand out of the noise; "not known" without such points.
std::string surface_error_text(const ImportReport& report, std::string_view micro = "u");

/// What one source leaves uncertain: "lateral placement: 0.12 mm across, 0.3 mrad".
std::string error_text(const ImportReport::ErrorPart& part);

/// "mm" and "um" with what a length in metres is multiplied by; um for lengths below 0.2 mm.
struct PictureUnit {
  std::string name;
  double factor = 1e3;
};
PictureUnit picture_unit(double metres);

/// Place along a band: "123.45 deg" of a wheel, "1234.5 mm" of a rail.
std::string place_text(const ImportReport& report, double u, std::string_view degree = " deg");

/// The first letters of a text (UTF-8), with dots where it was cut.
std::string shortened(std::string_view text, std::size_t letters);

/// The line of a rail in words: how far it bends to which side, between which places, and that the surface is
/// straightened along it; empty without one.
std::string line_text(const ImportReport& report);

}  // namespace treadmark::io
