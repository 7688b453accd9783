// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "treadmark/core/error.hpp"
#include "treadmark/core/to_whole.hpp"
#include "treadmark/io/points/binary_values.hpp"
#include "treadmark/io/scans/las_header.hpp"
#include "treadmark/io/scans/write_scan.hpp"

namespace treadmark::io::scans {

namespace {

/// How coordinates become whole numbers, in the unit of the file: p = number * step + origin.
struct Quantisation {
  Vec3 step, origin, least, greatest;
};

Quantisation quantisation(const std::filesystem::path& file, const PointCloud& cloud, double scale) {
  constexpr double kFinest = 1e-10, kCoarsest = 1e-7;  // [m]
  constexpr double kMost = std::numeric_limits<std::int32_t>::max() - 1;
  Eigen::AlignedBox3d box;
  for (const Vec3& p : cloud.points) box.extend(p);
  Quantisation q;
  q.least = box.min() * scale;
  q.greatest = box.max() * scale;
  for (int k = 0; k < 3; ++k) {
    double step = kFinest;
    while (step < 0.99 * kCoarsest && 0.5 * box.sizes()[k] > 0.99 * kMost * step) step *= 10.0;
    if (0.5 * box.sizes()[k] > 0.99 * kMost * step)
      throw Error(ErrorKind::configuration,
                  fmt::format("cannot write {}: {:.0f} m of points are too long for LAS with 0.1 um", file.string(),
                              box.sizes()[k]),
                  {}, "write .ply");
    q.step[k] = step * scale;
    q.origin[k] = 0.5 * (q.least[k] + q.greatest[k]);
  }
  return q;
}

template <class T>
void set(std::string& header, std::size_t at, T value) {
  std::string bytes;
  put(bytes, value);
  std::copy(bytes.begin(), bytes.end(), header.begin() + static_cast<std::ptrdiff_t>(at));
}

void set_text(std::string& header, std::size_t at, std::string_view text) {
  std::copy(text.begin(), text.end(), header.begin() + static_cast<std::ptrdiff_t>(at));
}

/// The public header block of LAS 1.2, with neither date nor name of a project: the same points give the same file.
std::string header_of(const Quantisation& q, std::uint32_t count, LengthUnit unit, std::size_t record) {
  std::string header(las::kSize12, '\0');
  set_text(header, 0, "LASF");
  set(header, 24, std::uint8_t{1});
  set(header, 25, std::uint8_t{2});
  set_text(header, las::kSystemId, fmt::format("unit {}", symbol(unit)));
  set_text(header, las::kSoftware, "Treadmark");
  set(header, las::kHeaderSize, static_cast<std::uint16_t>(las::kSize12));
  set(header, las::kDataOffset, static_cast<std::uint32_t>(las::kSize12));
  set(header, las::kRecordLength, static_cast<std::uint16_t>(record));
  set(header, las::kCount, count);
  set(header, las::kReturns, count);  // all are first returns
  for (std::size_t k = 0; k < 3; ++k) {
    const auto axis = static_cast<Eigen::Index>(k);
    set(header, las::kScale + 8 * k, q.step[axis]);
    set(header, las::kOrigin + 8 * k, q.origin[axis]);
    set(header, las::kBounds + 16 * k, q.greatest[axis]);
    set(header, las::kBounds + 16 * k + 8, q.least[axis]);
  }
  return header;
}

}  // namespace

void write_las(const std::filesystem::path& file, const PointCloud& cloud, LengthUnit unit) {
  constexpr std::size_t kRecord = 20;  // point data format 0
  if (cloud.points.size() > std::numeric_limits<std::uint32_t>::max())
    throw Error(ErrorKind::configuration, fmt::format("cannot write {}: too many points for LAS 1.2", file.string()),
                {}, "write .ply");
  const double scale = 1.0 / metres_per(unit);
  const Quantisation q = quantisation(file, cloud, scale);
  BlockWriter out(file);
  out.text() = header_of(q, static_cast<std::uint32_t>(cloud.points.size()), unit, kRecord);
  for (std::size_t i = 0; i < cloud.points.size(); ++i) {
    const Vec3 p = scale * cloud.points[i];
    for (int k = 0; k < 3; ++k) put(out.text(), to_whole<std::int32_t>(std::round((p[k] - q.origin[k]) / q.step[k])));
    put(out.text(), std::uint16_t{0});    // intensity
    put(out.text(), std::uint8_t{0x09});  // the first of one return
    put(out.text(), std::uint8_t{0});
    put(out.text(), std::uint16_t{0});  // angle and user data
    put(out.text(), cloud.passes.empty() ? std::uint16_t{0} : cloud.passes[i]);
    out.flush_if_full();
  }
  out.commit();
}

}  // namespace treadmark::io::scans
