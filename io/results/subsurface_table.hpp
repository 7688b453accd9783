// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <array>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "treadmark/io/results/subsurface_block.hpp"

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

}  // namespace treadmark::io
