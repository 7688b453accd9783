// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/io/results/subsurface_vtk.hpp"

#include <fmt/format.h>

#include "treadmark/io/results/subsurface_table.hpp"
#include "treadmark/io/results/vtk_xml.hpp"

namespace treadmark::io {

std::string block_to_vts(const SubsurfaceBlock& block, const Pose& X_TC) {
  SubsurfaceBlock turned = block;
  std::vector<double> points;
  points.reserve(3 * block.values.size());
  for (SubsurfaceValue& value : turned.values) {
    const Vec3 p_T = X_TC.apply(value.point);
    points.insert(points.end(), p_T.data(), p_T.data() + 3);
    value.displacement = X_TC.rotation * value.displacement;
    value.stress = X_TC.rotation * value.stress * X_TC.rotation.transpose();
  }
  std::string data;
  for (const SubsurfaceColumn& column : kSubsurfaceColumns) {
    if (column.unit == "m" && column.components == 1) continue;  // the places are the points
    const std::vector<double> values = column_values(turned, column);
    data += vtk_data_array(fmt::format("{}_{}", column.name, column.unit),
                           std::vector<float>(values.begin(), values.end()), column.components);
  }
  return vtk_structured_grid(fmt::format("0 {} 0 {} 0 {}", block.nx - 1, block.ny - 1, block.nz - 1), "PointData", data,
                             vtk_data_array("points_m", points, 3));
}

}  // namespace treadmark::io
