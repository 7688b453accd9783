// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/app/scan_surface.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include <fmt/format.h>

#include "treadmark/core/constants.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/io/files/line_scanner.hpp"
#include "treadmark/io/scans/read_scan.hpp"

namespace treadmark::app {
namespace {

void require_cloud_file(const std::filesystem::path& cloud) {
  constexpr std::array<std::string_view, 6> kWritten{".ply", ".xyz", ".asc", ".txt", ".csv", ".las"};
  const std::string extension = io::profiles::lower(cloud.extension().string());
  if (std::find(kWritten.begin(), kWritten.end(), extension) == kWritten.end())
    throw Error(ErrorKind::configuration, fmt::format("points cannot be written to files '{}'", extension),
                {cloud.string()}, "use .ply, .las, .xyz, .asc, .txt or .csv");
}

std::string vector_text(const Vec3& v, double factor, int digits) {
  return fmt::format("({:.{}f}, {:.{}f}, {:.{}f})", factor * v.x(), digits, factor * v.y(), digits, factor * v.z(),
                     digits);
}

}  // namespace

Scanned scan_surface(const std::filesystem::path& surface, const std::filesystem::path& cloud,
                     const ScanRequest& request, const Progress& progress) {
  require_cloud_file(cloud);
  const NaturalSurface natural = named_surface(surface, request.surface);
  Scanned out{surface, cloud, request.scanner, request.unit, {}};
  out.settings.body = natural.spec.body;
  out.settings.nominal_radius = natural.spec.nominal_radius;
  const Region part = part_of(natural.spec.body, request.range_x, request.range_theta);
  out.settings.u_min = part.u_min;
  out.settings.u_max = part.u_max;
  const Box3 box = natural.surface->bounds();
  if (natural.spec.body == Body::rail && !request.range_x && (std::isinf(box.min.x()) || std::isinf(box.max.x())))
    throw Error(ErrorKind::configuration, "this rail has no ends", {surface.string()},
                "say which part is scanned: --range-mm FROM,TO");
  out.scan = scans::scan_surface(*natural.surface, out.settings, progress);
  io::write_scan(cloud, out.scan.cloud, request.unit);
  return out;
}

std::string summary(const Scanned& scanned) {
  const scans::ScannerTruth& truth = scanned.scan.truth;
  std::string text = fmt::format("{}: {} points of a {} in {}, {:.4g} mm apart on {:.6g} mm^2, {} {}, seed {}\n",
                                 scanned.cloud.string(), scanned.scan.cloud.points.size(),
                                 scanned.settings.body == Body::wheel ? "wheel" : "rail", symbol(scanned.unit),
                                 kMilli * truth.spacing, kMicro * truth.area, truth.passes.size(),
                                 truth.passes.size() == 1 ? "pass" : "passes", scanned.settings.seed);
  text += fmt::format("on the surface {}, outliers {}; lost: {} in holes, {} dropped out, {} too steep\n",
                      truth.on_surface, truth.outliers, truth.lost_holes, truth.lost_drop_outs, truth.lost_occlusion);
  const Mat3& R = truth.X_CS.rotation;
  text += fmt::format("surface in the cloud: origin {} mm, x axis {}, y axis {}, z axis {}\n",
                      vector_text(truth.X_CS.origin, kMilli, 6), vector_text(R.col(0), 1.0, 9),
                      vector_text(R.col(1), 1.0, 9), vector_text(R.col(2), 1.0, 9));
  return text;
}

}  // namespace treadmark::app
