// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <filesystem>
#include <string_view>

#include "treadmark/model/contact/numerical_influence.hpp"

namespace treadmark::io {

/// Reads a file of numerical influence coefficients as CONTACT takes them (C = 9):
///   NMATRIX IACONVX / LQUASID XYZORDR / ISYMMX ISYMMY / MX MY DX DY
/// and for iy = -MY+1 ... MY-1 two header lines and MX lines
///   ix x  Ann Anx Any  Axn Axx Axy  Ayn Ayx Ayy     (Axn: displacement in x by pressure; ix = 0 ... MX-1; lengths in
///   mm)
/// What lies at ix < 0 follows from the symmetry in x: Anx, Axn, Axy and Ayx are odd, the others even.
/// Supported: one matrix (NMATRIX = 1), body 1 the rail (IACONVX = 1), LQUASID = 0, order n, x, y (312), ISYMMX = 1,
/// ISYMMY = 0. Errors: Error(input_data) with file, line and column for a file that is broken, Error(configuration) for
/// what is not supported. Memory is taken only for what the text can hold. Thread-safe.
NumericalInfluence read_influence(const std::filesystem::path& file);
NumericalInfluence parse_influence(std::string_view text, const std::filesystem::path& name);

}  // namespace treadmark::io
