// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors

#include <fmt/format.h>

#include <iterator>
#include <utility>

#include "treadmark/io/files/extension.hpp"
#include "treadmark/io/points/binary_values.hpp"
#include "treadmark/io/scans/read_scan.hpp"
#include "treadmark/io/scans/write_scan.hpp"

namespace treadmark::io {

namespace scans {

using points::put;

void BlockWriter::flush() {
  file_.write(text_);
  text_.clear();
}

void BlockWriter::commit() {
  flush();
  file_.commit();
}

void write_ply(const std::filesystem::path& file, const PointCloud& cloud, LengthUnit unit) {
  BlockWriter out(file);
  const bool normals = !cloud.normals.empty(), passes = !cloud.passes.empty();
  const double scale = 1.0 / metres_per(unit);
  out.text() = fmt::format(
      "ply\nformat binary_little_endian 1.0\ncomment unit {}\nelement vertex {}\nproperty double x\n"
      "property double y\nproperty double z\n{}{}end_header\n",
      symbol(unit), cloud.points.size(), normals ? "property float nx\nproperty float ny\nproperty float nz\n" : "",
      passes ? "property ushort pass\n" : "");
  for (std::size_t i = 0; i < cloud.points.size(); ++i) {
    for (int k = 0; k < 3; ++k) put(out.text(), scale * cloud.points[i][k]);
    for (int k = 0; normals && k < 3; ++k) put(out.text(), cloud.normals[i][k]);
    if (passes) put(out.text(), cloud.passes[i]);
    out.flush_if_full();
  }
  out.commit();
}

void write_columns(const std::filesystem::path& file, const PointCloud& cloud, LengthUnit unit, char separator) {
  BlockWriter out(file);
  const bool normals = !cloud.normals.empty(), passes = !cloud.passes.empty();
  const double scale = 1.0 / metres_per(unit);
  // tables have plain names above their columns, lists of points a comment
  if (separator == ' ') out.text() = "# ";
  auto to = std::back_inserter(out.text());
  fmt::format_to(to, "x[{0}]{1}y[{0}]{1}z[{0}]", symbol(unit), separator);
  if (normals) fmt::format_to(to, "{0}nx{0}ny{0}nz", separator);
  if (passes) fmt::format_to(to, "{0}pass", separator);
  out.text() += '\n';
  for (std::size_t i = 0; i < cloud.points.size(); ++i) {
    const Vec3 p = scale * cloud.points[i];
    fmt::format_to(to, "{1}{0}{2}{0}{3}", separator, p[0], p[1], p[2]);  // all digits that tell it from its neighbours
    if (normals) {
      const Eigen::Vector3f& n = cloud.normals[i];
      fmt::format_to(to, "{0}{1}{0}{2}{0}{3}", separator, n[0], n[1], n[2]);
    }
    if (passes) fmt::format_to(to, "{}{}", separator, cloud.passes[i]);
    out.text() += '\n';
    out.flush_if_full();
  }
  out.commit();
}

}  // namespace scans

namespace {

using Writer = void (*)(const std::filesystem::path&, const PointCloud&, LengthUnit);
constexpr Writer kByBlanks = [](auto&file, auto&cloud, auto unit) { scans::write_columns(file, cloud, unit, ' '); },
                 kByCommas = [](auto&file, auto&cloud, auto unit) { scans::write_columns(file, cloud, unit, ','); };
constexpr std::pair<std::string_view, Writer> kWriters[] = {{".ply", scans::write_ply}, {".las", scans::write_las},
                                                            {".xyz", kByBlanks},        {".asc", kByBlanks},
                                                            {".txt", kByBlanks},        {".csv", kByCommas}};

}  // namespace

std::string written_scan_extensions() {
  std::string out;
  for (const auto& [extension, writer] : kWriters) out.append(out.empty() ? "" : " ").append(extension);
  return out;
}

void require_written_scan(const std::filesystem::path& file) {
  for (const auto& [extension, writer] : kWriters)
    if (extension == extension_of(file)) return;
  throw Error(ErrorKind::configuration, fmt::format("points cannot be written to files '{}'", extension_of(file)),
              {file.string()}, "use one of " + written_scan_extensions());
}

void write_scan(const std::filesystem::path& file, const PointCloud& cloud, LengthUnit unit) {
  const auto refuse = [&](const std::string& why, const std::string& advice) {
    throw Error(ErrorKind::configuration, fmt::format("cannot write {}: {}", file.string(), why), {}, advice);
  };
  const std::size_t n = cloud.points.size();
  if (n == 0) refuse("the cloud has no points", "a file without points could not be read again");
  if ((!cloud.normals.empty() && cloud.normals.size() != n) || (!cloud.passes.empty() && cloud.passes.size() != n))
    refuse("the numbers of points, normals and passes differ", "give one for each point or none");
  for (const Vec3& p : cloud.points)
    if (!p.allFinite()) refuse("a point is not finite", "leave it out");

  require_written_scan(file);
  for (const auto& [extension, writer] : kWriters)
    if (extension == extension_of(file)) writer(file, cloud, unit);
}

}  // namespace treadmark::io
