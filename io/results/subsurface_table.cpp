// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors

#include "treadmark/io/results/subsurface_table.hpp"

#include <fmt/format.h>

#include <bit>
#include <span>

#include "treadmark/core/error.hpp"
#include "treadmark/io/files/text.hpp"

namespace treadmark::io {

namespace {

void append(const Vec3& vector, std::vector<double>& out) { out.insert(out.end(), vector.data(), vector.data() + 3); }

}  // namespace

const std::array<SubsurfaceColumn, 9> kSubsurfaceColumns{{
    {"x", "m", "place of the point, longitudinal", 1,
     [](const SubsurfaceValue& v, std::vector<double>& out) { out.push_back(v.point.x()); },
     [](const double* in, SubsurfaceValue& v) { v.point.x() = *in; }},
    {"s", "m", "place of the point, lateral", 1,
     [](const SubsurfaceValue& v, std::vector<double>& out) { out.push_back(v.point.y()); },
     [](const double* in, SubsurfaceValue& v) { v.point.y() = *in; }},
    {"n", "m", "place of the point, depth: negative in the wheel", 1,
     [](const SubsurfaceValue& v, std::vector<double>& out) { out.push_back(v.point.z()); },
     [](const double* in, SubsurfaceValue& v) { v.point.z() = *in; }},
    {"displacement", "m", "of the body that has the point: x, s, n", 3,
     [](const SubsurfaceValue& v, std::vector<double>& out) { append(v.displacement, out); },
     [](const double* in, SubsurfaceValue& v) { v.displacement = Vec3(in); }},
    {"stress", "Pa", "tensor by rows: xx xs xn sx ss sn nx ns nn, tension positive", 9,
     [](const SubsurfaceValue& v, std::vector<double>& out) {
       for (int row = 0; row < 3; ++row) append(v.stress.row(row), out);
     },
     [](const double* in, SubsurfaceValue& v) {
       for (int row = 0; row < 3; ++row) v.stress.row(row) = Vec3(in + std::ptrdiff_t{3} * row);
     }},
    {"hydrostatic", "Pa", "mean of the normal stresses", 1,
     [](const SubsurfaceValue& v, std::vector<double>& out) { out.push_back(v.hydrostatic); },
     [](const double* in, SubsurfaceValue& v) { v.hydrostatic = *in; }},
    {"von_mises", "Pa", "equivalent stress of von Mises", 1,
     [](const SubsurfaceValue& v, std::vector<double>& out) { out.push_back(v.von_mises); },
     [](const double* in, SubsurfaceValue& v) { v.von_mises = *in; }},
    {"tresca", "Pa", "greatest minus least principal stress", 1,
     [](const SubsurfaceValue& v, std::vector<double>& out) { out.push_back(v.tresca); },
     [](const double* in, SubsurfaceValue& v) { v.tresca = *in; }},
    {"principal", "Pa", "principal stresses, the greatest first", 3,
     [](const SubsurfaceValue& v, std::vector<double>& out) { append(v.principal, out); },
     [](const double* in, SubsurfaceValue& v) { v.principal = Vec3(in); }},
}};

std::vector<double> column_values(const SubsurfaceBlock& block, const SubsurfaceColumn& column) {
  std::vector<double> out;
  out.reserve(block.values.size() * static_cast<std::size_t>(column.components));
  for (const SubsurfaceValue& value : block.values) column.append(value, out);
  return out;
}

void check_blocks(std::span<const SubsurfaceBlock> blocks, const std::string& where) {
  int number = 0;
  for (const SubsurfaceBlock& block : blocks) {
    ++number;
    const bool positive = block.nx > 0 && block.ny > 0 && block.nz > 0;
    const auto length = [](int n) { return static_cast<std::size_t>(n); };
    if (positive && block.values.size() == length(block.nx) * length(block.ny) * length(block.nz)) continue;
    throw Error(ErrorKind::configuration,
                fmt::format("{}block {} of points below the surface has {} values for {} by {} by {} points", where,
                            number, block.values.size(), block.nx, block.ny, block.nz));
  }
}

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

namespace {

template <class T>
std::string data_array(const char* type, const std::string& name, const std::vector<T>& values, int components) {
  const std::uint64_t size = values.size() * sizeof(T);
  return fmt::format(
      "        <DataArray type=\"{}\" Name=\"{}\" NumberOfComponents=\"{}\" format=\"binary\">{}{}</DataArray>\n", type,
      name, components, to_base64(std::as_bytes(std::span(&size, 1))), to_base64(std::as_bytes(std::span(values))));
}

}  // namespace

std::string vtk_data_array(const std::string& name, const std::vector<double>& values, int components) {
  return data_array("Float64", name, values, components);
}

std::string vtk_data_array(const std::string& name, const std::vector<float>& values, int components) {
  return data_array("Float32", name, values, components);
}

std::string vtk_data_array(const std::string& name, const std::vector<std::uint8_t>& values, int components) {
  return data_array("UInt8", name, values, components);
}

std::string vtk_data_array(const std::string& name, const std::vector<std::int32_t>& values, int components) {
  return data_array("Int32", name, values, components);
}

std::string vtk_polygons(std::size_t corners_each, const std::vector<std::int32_t>& corners, std::size_t point_count,
                         const std::string& point_data, const std::string& points) {
  std::vector<std::int32_t> ends;
  ends.reserve(corners.size() / corners_each);
  for (std::size_t i = corners_each; i <= corners.size(); i += corners_each)
    ends.push_back(static_cast<std::int32_t>(i));
  return fmt::format(R"(<?xml version="1.0"?>
<VTKFile type="PolyData" version="1.0" byte_order="{}" header_type="UInt64">
  <PolyData>
    <Piece NumberOfPoints="{}" NumberOfVerts="0" NumberOfLines="0" NumberOfStrips="0" NumberOfPolys="{}">
      <PointData>
{}      </PointData>
      <Points>
{}      </Points>
      <Polys>
{}{}      </Polys>
    </Piece>
  </PolyData>
</VTKFile>
)",
                     vtk_byte_order(), point_count, ends.size(), point_data, points,
                     vtk_data_array("connectivity", corners, 1), vtk_data_array("offsets", ends, 1));
}

std::string vtk_structured_grid(const std::string& extent, const std::string& data_element, const std::string& data,
                                const std::string& points) {
  return fmt::format(R"(<?xml version="1.0"?>
<VTKFile type="StructuredGrid" version="1.0" byte_order="{}" header_type="UInt64">
  <StructuredGrid WholeExtent="{}">
    <Piece Extent="{}">
      <{}>
{}      </{}>
      <Points>
{}      </Points>
    </Piece>
  </StructuredGrid>
</VTKFile>
)",
                     vtk_byte_order(), extent, extent, data_element, data, data_element, points);
}

std::string vtk_collection(const std::string& entries) {
  return fmt::format(R"(<?xml version="1.0"?>
<VTKFile type="Collection" version="1.0" byte_order="{}" header_type="UInt64">
  <Collection>
{}  </Collection>
</VTKFile>
)",
                     vtk_byte_order(), entries);
}

std::string vtk_entry(double time, int part, const std::string& file) {
  return fmt::format("    <DataSet timestep=\"{}\" group=\"\" part=\"{}\" file=\"{}\"/>\n", time, part, file);
}

const char* vtk_byte_order() { return std::endian::native == std::endian::little ? "LittleEndian" : "BigEndian"; }

}  // namespace treadmark::io
