// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/io/results/vtk_xml.hpp"

#include <fmt/format.h>

#include <bit>
#include <span>

#include "treadmark/io/files/base64.hpp"

namespace treadmark::io {
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

const char* vtk_byte_order() { return std::endian::native == std::endian::little ? "LittleEndian" : "BigEndian"; }

}  // namespace treadmark::io
