// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/app/import/write_outputs.hpp"

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <system_error>

#include <fmt/format.h>

#include "treadmark/analysis/measured/smoothing.hpp"
#include "treadmark/app/surfaces/read_surface.hpp"
#include "treadmark/backends/create.hpp"
#include "treadmark/backends/mesh/make.hpp"
#include "treadmark/core/constants.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/core/parallel.hpp"
#include "treadmark/core/parallel_blocks.hpp"
#include "treadmark/core/parts.hpp"
#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/core/to_whole.hpp"
#include "treadmark/io/files/extension.hpp"
#include "treadmark/io/files/sha256.hpp"
#include "treadmark/io/meshes/read_mesh.hpp"
#include "treadmark/io/profiles/read_slices.hpp"
#include "treadmark/io/profiles/write_slices.hpp"
#include "treadmark/model/shape/body_name.hpp"
#include "treadmark/model/shape/natural_view.hpp"
#include "treadmark/scans/cgal/free_mesh.hpp"
#include "treadmark/scans/cgal/plane_triangulation.hpp"
#include "treadmark/scans/placement/band_frame.hpp"

namespace treadmark::app {
namespace {

using scans::natural;

double radius_of(const FittedScan& fit) {
  return fit.scan.body == Body::wheel ? fit.scan.placement.nominal_radius : 0.0;
}

void refuse_holes(const FittedScan& fit, const std::filesystem::path& file, const char* what) {
  if (fit.coverage.whole()) return;
  const scans::Hole& hole = fit.coverage.holes.front();
  const Vec2 p = fit.fitted.band.section.at(hole.s).position;
  throw Error(ErrorKind::configuration,
              fmt::format("{} cannot leave out a hole: one of {:.1f} mm stays open at {} = {:.4g} {}, y = {:.1f} mm",
                          what, 1e3 * hole.diameter, fit.scan.body == Body::wheel ? "theta" : "x",
                          fit.scan.body == Body::wheel ? fit.fitted.u_at(hole.a) * 180.0 / 3.141592653589793
                                                       : 1e3 * fit.fitted.u_at(hole.a),
                          fit.scan.body == Body::wheel ? "degrees" : "mm", 1e3 * p.x()),
              {file.string()},
              fmt::format("write triangles (.ply), which keep holes, or fill it with --set clean.hole_limit_mm={:.0f}",
                          std::ceil(1e3 * hole.diameter)));
}

/// What triangles and offsets of measured sections are made of, unless their noise has smoothed them.
SliceSet smoothed_sections(const SliceSet& sections, const io::ImportSettings& settings) {
  SliceSet out = sections;
  for (Profile& profile : out.profiles)
    if (!measured::is_smoothed(profile)) profile.smoothing.strength = 1e-9 * settings.fit.smoothing_lambda_mm3;
  return out;
}

/// share: of the tolerance below which changes along the band need no slices of their own.
SliceSet slices_of(const FittedScan& fit, const io::ImportSettings& settings, double share = 1.0) {
  if (fit.sections != nullptr) return smoothed_sections(*fit.sections, settings);
  const double tolerance = share * (settings.fit.tolerance_um > 0.0 ? 1e-6 * settings.fit.tolerance_um
                                                                    : std::clamp(fit.noise / 50.0, 0.02e-6, 0.5e-6));
  return scans::to_slices(fit.fitted, 1e-3 * settings.fit.resolution_mm, tolerance,
                          fit.scan.body == Body::wheel ? "scanned wheel" : "scanned rail");
}

TriangleMesh band_triangles(const FittedScan& fit, const io::ImportSettings& settings) {
  const double spacing = 1e-3 * settings.fit.resolution_mm;
  std::vector<Vec2> nodes = scans::triangle_nodes(fit.fitted, fit.points, fit.coverage.open, spacing);
  const bool closed = fit.fitted.band.closed;
  const double period = closed ? fit.fitted.band.length() : 0.0;
  double longest = 2.0 * spacing;
  if (settings.fit.decimate_um > 0.0) {
    // a cut across a closed band, whose nodes all stay, lets the curvature be measured from there
    std::vector<Vec2> strip = nodes;
    std::vector<std::size_t> origin(nodes.size());
    for (std::size_t k = 0; k < nodes.size(); ++k) origin[k] = k;
    if (closed)
      for (std::size_t k = 0; k < nodes.size(); ++k)
        if (nodes[k].x() < 0.51 * spacing) {
          strip.emplace_back(nodes[k].x() + period, nodes[k].y());
          origin.push_back(k);
        }
    const std::vector<double> heights = scans::sagitta(fit.fitted, strip);
    std::vector<std::uint8_t> needed(nodes.size(), 0);
    for (const std::uint32_t k : scans::decimate_plane(strip, heights, 1e-6 * settings.fit.decimate_um))
      needed[origin[k]] = 1;
    std::vector<Vec2> kept;
    for (std::size_t k = 0; k < nodes.size(); ++k)
      if (needed[k] != 0 || (closed && nodes[k].x() < 0.51 * spacing)) kept.push_back(nodes[k]);
    nodes = std::move(kept);
    longest = 1e9;
    if (!fit.coverage.whole())
      throw Error(ErrorKind::configuration, "nodes of a surface with open holes cannot be left out", {},
                  "say fit.decimate_um=0, or fill the holes");
  }
  TriangleMesh mesh;
  mesh.name = "scan";
  mesh.triangles = scans::triangulate_plane(nodes, longest, period);
  mesh.vertices.resize(nodes.size());
  constexpr std::size_t kNodes = 1024;  // of a task
  parallel_blocks(nodes.size(), kNodes, [&](std::size_t from, std::size_t to) {
    for (std::size_t k = from; k < to; ++k) mesh.vertices[k] = fit.fitted.point(nodes[k].x(), nodes[k].y());
  });
  // counter-clockwise in (a, s) looks along +z on a rail: into the material; outwards on a wheel
  if (fit.scan.body == Body::rail)
    for (auto& t : mesh.triangles) std::swap(t[1], t[2]);
  return mesh;
}

TriangleMesh free_triangles(const FittedScan& fit, const io::ImportSettings& settings) {
  std::vector<Vec3> points, outward;
  const Pose X_SC = fit.scan.placement.X_CS.inverse();
  for (std::size_t i = 0; i < fit.points.size(); ++i) {
    if (!scans::is_of_surface(fit.points.state[i])) continue;
    const Vec3 p = X_SC.apply(fit.scan.points[fit.points.index[i]]);
    points.push_back(p);
    outward.push_back(scans::direction(fit.scan.body, natural(fit.scan.body, p).u,
                                       fit.fitted.band.section.at(fit.points.s[i]).normal));
  }
  scans::FreeMeshSettings how;
  how.spacing = 1e-3 * settings.fit.resolution_mm;
  how.hole_limit = fit.coverage.limit;
  return scans::mesh_points(points, outward, how);
}

TriangleMesh triangles_of(const FittedScan& fit, const io::ImportSettings& settings) {
  if (settings.fit.mesh == "free") return free_triangles(fit, settings);
  if (fit.sections == nullptr && has_part("cgal")) return band_triangles(fit, settings);
  // measured sections, or no Delaunay triangulation: a regular grid of the splines
  if (fit.sections != nullptr && settings.fit.decimate_um > 0.0)
    throw Error(ErrorKind::configuration, "nodes of triangles of measured sections cannot be left out", {},
                "say fit.decimate_um=0, or fit.sections=fit");
  if (!fit.coverage.whole() || settings.fit.decimate_um > 0.0)
    left_out("cgal", "the triangulation of a band with holes or with fewer nodes");
  SurfaceSpec spec;
  spec.body = fit.scan.body;
  spec.nominal_radius = radius_of(fit);
  spec.shape = slices_of(fit, settings);
  return to_triangles(create_natural(std::move(spec)), {"mesh", 1e-3 * settings.fit.resolution_mm, {}});
}

void write_offset_file(const std::filesystem::path& file, const FittedScan& fit, const io::ImportSettings& settings,
                       const std::vector<std::string>& summary) {
  SurfaceSpec spec;
  spec.body = fit.scan.body;
  spec.nominal_radius = radius_of(fit);
  spec.shape = slices_of(fit, settings);
  spec.errors = fit.errors;
  spec.doubts = fit.scan.doubts;
  SurfaceSpec base;
  base.body = fit.scan.body;
  base.nominal_radius = radius_of(fit);
  if (settings.fit.base == "nominal") {
    if (!fit.scan.nominal_spec)
      throw Error(ErrorKind::configuration, "there is no nominal profile to lay offsets over", {file.string()},
                  "say fit.base=fitted");
    base.shape = fit.scan.nominal_spec->shape;
  } else {
    base.shape =
        scans::section_profile(fit.fitted, radius_of(fit), 1e-3 * settings.fit.resolution_mm, "section of the scan");
  }
  Representation wanted;
  wanted.backend = "offset";
  wanted.resolution = 1e-3 * settings.fit.resolution_mm;
  constexpr double kMargin = 0.25e-3;
  wanted.region.y_min = fit.fitted.band.section.at(fit.fitted.s_min).position.x() + kMargin;
  wanted.region.y_max = fit.fitted.band.section.at(fit.fitted.s_max).position.x() - kMargin;
  if (fit.scan.body == Body::rail) {
    wanted.region.u_min = fit.fitted.u_at(0.0);
    wanted.region.u_max = fit.fitted.u_at(fit.fitted.band.length());
  }
  write_offsets(file, create_natural(std::move(spec)), wanted, nullptr, &base,
                fmt::format("{}", fmt::join(summary, "\n")));
}

/// Where surfaces are compared along the band: at places that meet no nodes.
class Stations {
 public:
  static constexpr std::size_t kCount = 120, kAcross = 337;
  static constexpr double kMargin = 1.5e-3 + 1e-3 * 0.5;  ///< from the rims [m]

  explicit Stations(const FittedScan& fit)
      : fitted_(fit.fitted),
        first_(fitted_.band.closed ? 0.0 : kMargin),
        step_((fitted_.band.length() - 2.0 * first_) / kCount) {}

  double at(std::size_t i) const { return first_ + step_ * (static_cast<double>(i) + kOff); }
  /// Whether a place is within a distance [m] of one.
  bool near(double u, double distance) const {
    const double a = (u - fitted_.u_at(0.0)) * fitted_.band.radius, k = (a - first_) / step_ - kOff;
    return std::fabs(k - std::round(k)) * step_ <= distance;
  }

 private:
  static constexpr double kOff = 0.37;
  const scans::FittedBand& fitted_;
  double first_, step_;
};

/// Triangles of a file, all of them checked, those about the stations kept: what a smooth surface depends on there.
TriangleMesh triangles_about(const Stations& stations, const std::filesystem::path& file, Body body, double reach) {
  TriangleMesh mesh = io::read_mesh(file);
  mesh::check_mesh(mesh, body);
  std::vector<std::uint8_t> near(mesh.vertices.size());
  for (std::size_t v = 0; v < near.size(); ++v) near[v] = stations.near(natural(body, mesh.vertices[v]).u, reach);
  std::erase_if(mesh.triangles,
                [&](const auto& corners) { return !ranges::any_of(corners, [&](auto v) { return near[v] != 0; }); });
  return mesh;
}

/// Distance of the surface, as anyone reads it, from the fitted one, along the section's normals.
void compare(const std::filesystem::path& file, const FittedScan& fit, const io::ImportSettings& settings,
             const std::optional<NaturalSurface>& sections, io::ImportReport::Output& out) {
  const Stations stations(fit);
  NaturalSurface back;
  if (io::is_mesh_file(file) && settings.fit.decimate_um == 0.0) {
    constexpr double kRings = 6.0;  // of triangles; a vertex is fitted to two
    SurfaceSpec spec;
    spec.body = fit.scan.body;
    spec.nominal_radius = radius_of(fit);
    spec.shape = triangles_about(stations, file, fit.scan.body, kRings * 1e-3 * settings.fit.resolution_mm);
    back = create_natural(std::move(spec));
  } else {
    io::SurfaceSource source;
    source.geometry = io::GeometryFile{file, {}};
    source.where = {file.string(), 0, 0};
    back = read_surface(source, fit.scan.body, radius_of(fit));
  }
  constexpr std::size_t kStations = Stations::kCount, kAcross = Stations::kAcross;
  constexpr double margin = Stations::kMargin;
  std::vector<double> worst(kStations, 0.0), square(kStations, 0.0), count(kStations, 0.0), missing(kStations, 0.0);
  parallel_for(kStations, [&](std::size_t i) {
    const double a = stations.at(i);
    const Pose X_SP = natural_plane(fit.scan.body, fit.fitted.u_at(a));
    for (std::size_t k = 0; k < kAcross; ++k) {
      const double s = fit.fitted.s_min + margin +
                       (fit.fitted.s_max - fit.fitted.s_min - 2.0 * margin) * (static_cast<double>(k) + 0.41) / kAcross;
      const auto row = std::min(fit.points.rows - 1, to_whole<std::size_t>(a / fit.points.cell_a)),
                 column = std::min(fit.points.columns - 1, to_whole<std::size_t>(s / fit.points.cell_s));
      if (!fit.coverage.open.empty() && fit.coverage.open[row * fit.points.columns + column] != 0) continue;
      // seen along the section's normal, so that flanks are compared like the top
      const Vec2 p = fit.fitted.across(a, s), normal = fit.fitted.band.section.at(s).normal;
      const double tilt = std::atan2(normal.x(), normal.y()), sign = fit.scan.body == Body::wheel ? 1.0 : -1.0;
      const Pose X_SN = X_SP * Pose{Vec3(0.0, p.x(), sign * p.y()), rotation_x(-sign * tilt)};
      double d = height_at(*back.surface, X_SN, Vec2::Zero());
      if (sections) d -= height_at(*sections->surface, X_SN, Vec2::Zero());
      if (std::isnan(d)) {
        missing[i] += 1.0;
        continue;
      }
      worst[i] = std::max(worst[i], std::fabs(d));
      square[i] += d * d;
      count[i] += 1.0;
    }
  });
  double sum = 0.0, number = 0.0, none = 0.0;
  for (std::size_t i = 0; i < kStations; ++i) {
    out.height_max = std::max(out.height_max, worst[i]);
    sum += square[i];
    number += count[i];
    none += missing[i];
  }
  constexpr double kMostMissing = 0.1;
  if (none > kMostMissing * (number + none))
    throw Error(ErrorKind::input_data,
                fmt::format("it is not there at {:.0f} % of the fitted places", 100.0 * none / (number + none)));
  out.height_rms = number > 0.0 ? std::sqrt(sum / number) : 0.0;
}

}  // namespace

void check_outputs(const ImportRequest& request) {
  if (request.outputs.empty())
    throw Error(ErrorKind::configuration, "there is nothing to write", {},
                "say -o with a file *.slcs, *.slcw, *.ply, *.stl, *.obj, *.off, *.vdb or *.nvdb");
  const Body body = body_of(request);
  for (const auto& file : request.outputs) {
    const std::string extension = io::extension_of(file);
    if (!io::is_mesh_file(file) && !io::is_slices_file(file) && !is_offset_file(file))
      throw Error(ErrorKind::configuration, fmt::format("surfaces cannot be written to files '{}'", extension),
                  {file.string()},
                  "use .slcs (rail) or .slcw (wheel) for splines, .ply, .stl, .obj or .off for triangles, .vdb or "
                  ".nvdb for offsets");
    if (io::is_slices_file(file) && extension != (body == Body::wheel ? ".slcw" : ".slcs"))
      throw Error(ErrorKind::configuration,
                  fmt::format("slices of a {} are written to a file *{}", body_name(body),
                              body == Body::wheel ? ".slcw" : ".slcs"),
                  {file.string()});
    for (const auto& scan : request.scans)
      if (std::filesystem::weakly_canonical(scan) == std::filesystem::weakly_canonical(file))
        throw Error(ErrorKind::configuration, "the surface would overwrite the scan", {file.string()},
                    "choose another name");
  }
}

void check_holes(const std::filesystem::path& file, const FittedScan& fit) {
  if (io::is_slices_file(file)) refuse_holes(fit, file, "slices");
  if (is_offset_file(file)) refuse_holes(fit, file, "offsets");
}

namespace {

/// Slices of a part of a wheel hold angles from -180 to 180 degrees.
void check_angles(const SliceSet& slices, const std::filesystem::path& file) {
  constexpr double kTolerance = 1e-3, kDegrees = 180.0 / kPi;
  const double first = slices.u.front(), last = slices.u.back();
  if (slices.body == Body::rail || (first >= -kPi - kTolerance && last <= kPi + kTolerance)) return;
  throw Error(ErrorKind::configuration,
              fmt::format("slices hold angles from -180 to 180 degrees, and the scanned part would run from {:.1f} to "
                          "{:.1f}",
                          first * kDegrees, last * kDegrees),
              {file.string()}, "put its middle nearer to zero with placement.zero_deg, or write triangles (.ply)");
}

/// Writes and reads again. share: as in slices_of.
io::ImportReport::Output written(const std::filesystem::path& file, const std::filesystem::path& place,
                                 const FittedScan& fit, const io::ImportSettings& settings,
                                 const std::vector<std::string>& summary, double share) {
  io::ImportReport::Output out;
  out.file = file.filename().string();
  // What is not known of the surface.
  std::vector<std::string> unknown = to_lines(fit.scan.doubts);
  if (fit.errors) ranges::copy(to_lines(*fit.errors), std::back_inserter(unknown));
  try {
    if (io::is_slices_file(file)) {
      out.kind = "slices";
      const SliceSet slices = fit.sections != nullptr ? *fit.sections : slices_of(fit, settings, share);
      check_angles(slices, file);
      out.details = fmt::format("{} slices of {} points", slices.u.size(), slices.profiles.front().y.size());
      out.bytes = io::write_slices(place, slices, summary, unknown);
    } else if (io::is_mesh_file(file)) {
      out.kind = "triangles";
      const TriangleMesh mesh = triangles_of(fit, settings);
      out.details = fmt::format("{} triangles over {} vertices", mesh.triangles.size(), mesh.vertices.size());
      std::vector<std::string> comments = summary;
      comments.insert(comments.end(), unknown.begin(), unknown.end());
      // of which a head of few characters takes the first line
      if (io::extension_of(file) == ".stl" && !fit.scan.doubts.empty())
        comments.insert(comments.begin(), names_line(fit.scan.doubts));
      io::write_mesh(place, mesh, comments);
    } else {
      out.kind = "offsets";
      out.details = fmt::format("over the {} section", settings.fit.base);
      write_offset_file(place, fit, settings, summary);
    }
  } catch (const Error& error) {
    if (error.where().file != place.string()) throw;
    throw Error(error.kind(), error.message(), {file.string()}, error.advice());  // nobody knows the place
  }
  if (out.bytes == 0) out.bytes = std::filesystem::file_size(place);
  out.sha256 = io::sha256_file(place);  // a slices file holds that of its slices
  std::optional<NaturalSurface> sections;
  if (fit.sections != nullptr) {
    SurfaceSpec spec;
    spec.body = fit.scan.body;
    spec.nominal_radius = radius_of(fit);
    spec.shape = out.kind == "slices" ? *fit.sections : smoothed_sections(*fit.sections, settings);
    sections = create_natural(std::move(spec));
  }
  try {
    compare(place, fit, settings, sections, out);
  } catch (const Error& error) {
    throw Error(ErrorKind::input_data, "the surface that was made could not be read again: " + error.message(),
                {file.string()},
                fit.sections != nullptr ? "say fit.sections=fit"
                : settings.clean.hole_limit_mm > 0.0
                    ? "what fills a large hole may fold: lower clean.hole_limit_mm, or write triangles (.ply)"
                    : "raise fit.significance or fit.resolution_mm, or write triangles (.ply)");
  }
  return out;
}

}  // namespace

io::ImportReport::Output write_output(const std::filesystem::path& file, const std::filesystem::path& place,
                                      const FittedScan& fit, const io::ImportSettings& settings,
                                      const std::vector<std::string>& summary) {
  check_holes(file, fit);
  io::ImportReport::Output out = written(file, place, fit, settings, summary, 1.0);
  const auto near_enough = [&] { return kMicro * out.height_max <= settings.fit.written_um; };
  // changes that need no slices one by one may do so together
  if (!near_enough() && io::is_slices_file(file) && fit.sections == nullptr)
    out = written(file, place, fit, settings, summary, 0.0);
  if (!near_enough())
    throw Error(
        ErrorKind::input_data,
        fmt::format("{} read again lie up to {:.3g} mm beside the fitted surface, more than {:g} um ({:.3g} mm rms)",
                    out.kind, kMilli * out.height_max, settings.fit.written_um, kMilli * out.height_rms),
        {file.string()},
        "lower fit.resolution_mm, write another kind of file, or raise fit.written_um if that is near enough");
  return out;
}

}  // namespace treadmark::app
