// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace treadmark::io {

/// A DataArray element with its values as base64, preceded by their size in bytes.
std::string vtk_data_array(const std::string& name, const std::vector<double>& values, int components);
std::string vtk_data_array(const std::string& name, const std::vector<float>& values, int components);
std::string vtk_data_array(const std::string& name, const std::vector<std::uint8_t>& values, int components);

/// A structured grid of one piece; extent reads "0 nx 0 ny 0 nz". data_element is CellData or PointData, data and
/// points are DataArray elements.
std::string vtk_structured_grid(const std::string& extent, const std::string& data_element, const std::string& data,
                                const std::string& points);

/// "LittleEndian" or "BigEndian".
const char* vtk_byte_order();

}  // namespace treadmark::io
