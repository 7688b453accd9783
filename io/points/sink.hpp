// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <array>
#include <concepts>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>

#include "treadmark/core/pose.hpp"
#include "treadmark/io/points/byte_blocks.hpp"
#include "treadmark/io/points/fields.hpp"

namespace treadmark::io::points {

/// Largest number of vertices or triangles of a mesh: indices have 32 bits and one value is kept free.
inline constexpr std::uint64_t kMostElements = 1'000'000'000;

/// Knows the place in the file and throws.
using Fail = std::function<void(const std::string& message, const std::string& advice)>;

/// Numbers of a vertex: x y z nx ny nz pass intensity.
inline constexpr std::size_t kPassValue = 6, kIntensityValue = 7, kVertexValues = 8;
using VertexValues = std::array<double, kVertexValues>;

/// Takes what parse_ply, parse_stl, parse_off and parse_obj find in a file, and decides what they look for. Where
/// kFaces, the faces are read and the file must be whole, and the sink has add_index(double) too: a corner by the
/// number of its vertex, from 0. Else reading ends behind the last vertex. Constructed from the bytes, Options, the
/// least number of bytes that a vertex takes, and a Fail. One that has set_intensities(bool) gets them. All errors are
/// Error(input_data) that name the line and column, or the byte.
template <class S>
concept Sink = requires(S sink, const LineBlocks& lines, const Field& field, const Vec3& p, const VertexValues& values,
                        std::uint64_t count, bool flag, const char* what, std::string_view text) {
  typename S::Options;
  { S::kFaces } -> std::convertible_to<bool>;
  { S::number(lines, field) } -> std::same_as<double>;
  { S::count(lines, field) } -> std::same_as<std::uint64_t>;
  S::too_few(lines, field, what);  // throws: the line of this key has too few numbers, in words
  sink.comment(text);              // may state the unit
  sink.set_content(flag, flag);    // whether add_values gets normals, and passes
  sink.expect(count, count);       // vertices and faces that the file promises from here on
  sink.add(p);                     // a vertex
  sink.add_values(values);         // a vertex with more than its place
  sink.add_corner(p);              // a vertex of STL, which repeats them for each triangle
  sink.end_face();                 // the corners since the face before are one
  sink.finish(std::string(text));  // the result, from the format in words
};

}  // namespace treadmark::io::points
