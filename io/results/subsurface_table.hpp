// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "treadmark/io/results/result_model.hpp"

namespace treadmark::io {

/// A quantity of the points below the surface: the name and unit it has in every field file.
struct SubsurfaceColumn {
  std::string_view name, unit, meaning;
  int components;
  void (*append)(const SubsurfaceValue& value, std::vector<double>& out);
  void (*put)(const double* components, SubsurfaceValue& value);  ///< the way back
};

extern const std::array<SubsurfaceColumn, 9> kSubsurfaceColumns;

/// All values of a column, components of a point together, points in the order of the block.
std::vector<double> column_values(const SubsurfaceBlock& block, const SubsurfaceColumn& column);

/// Throws Error(configuration) unless every block has nx ny nz values. where ("case 1, patch 2: ") begins the message.
void check_blocks(std::span<const SubsurfaceBlock> blocks, const std::string& where);

/// A block of points as VTK XML structured grid (.vts): points at their places in track axes [m], displacement and
/// stress in track axes too (contact axes for a basic case, whose X_TC is the identity), as point data named with their
/// units. The block has nx ny nz values. Thread-safe.
std::string block_to_vts(const SubsurfaceBlock& block, const Pose& X_TC);

/// A DataArray element with its values as base64, preceded by their size in bytes.
std::string vtk_data_array(const std::string& name, const std::vector<double>& values, int components);
std::string vtk_data_array(const std::string& name, const std::vector<float>& values, int components);
std::string vtk_data_array(const std::string& name, const std::vector<std::uint8_t>& values, int components);
std::string vtk_data_array(const std::string& name, const std::vector<std::int32_t>& values, int components);

/// A structured grid of one piece; extent reads "0 nx 0 ny 0 nz". data_element is CellData or PointData, data and
/// points are DataArray elements.
std::string vtk_structured_grid(const std::string& extent, const std::string& data_element, const std::string& data,
                                const std::string& points);

/// Polygons (.vtp) of as many corners each: their points one after the other; point_data and points are DataArray
/// elements.
std::string vtk_polygons(std::size_t corners_each, const std::vector<std::int32_t>& corners, std::size_t point_count,
                         const std::string& point_data, const std::string& points);

/// A collection (.pvd) of files; entries are DataSet elements, see vtk_entry.
std::string vtk_collection(const std::string& entries);
std::string vtk_entry(double time, int part, const std::string& file);

/// "LittleEndian" or "BigEndian".
const char* vtk_byte_order();

}  // namespace treadmark::io
