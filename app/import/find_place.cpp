// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/app/import/find_place.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include <fmt/format.h>

#include "treadmark/app/import/layout_match.hpp"
#include "treadmark/backends/create.hpp"
#include "treadmark/backends/profile_library.hpp"
#include "treadmark/core/constants.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/io/files/extension.hpp"
#include "treadmark/io/files/shape_extension.hpp"
#include "treadmark/io/profiles/read_profile.hpp"
#include "treadmark/io/scans/read_scan.hpp"
#include "treadmark/model/shape/body_name.hpp"
#include "treadmark/model/shape/natural_view.hpp"
#include "treadmark/scans/cleaning/band_points.hpp"
#include "treadmark/scans/cleaning/pass_steps.hpp"
#include "treadmark/scans/cleaning/thin.hpp"
#include "treadmark/scans/line/line_doubts.hpp"
#include "treadmark/scans/line/track_rails.hpp"
#include "treadmark/scans/strays/stray_points.hpp"

namespace treadmark::app {
namespace {

std::optional<Vec3> direction_of(const std::vector<double>& list) {
  if (list.size() != 3) return std::nullopt;
  return Vec3(list[0], list[1], list[2]).normalized();
}

/// (y, v): v is the profile's z of a wheel, -z of a rail.
scans::Section nominal_section(Body body, const std::vector<Vec2>& nominal) {
  std::vector<Vec2> points;
  points.reserve(nominal.size());
  for (const Vec2& p : nominal) points.emplace_back(p.x(), body == Body::wheel ? p.y() : -p.y());
  return scans::Section(points);
}

/// Marks strays among thinned points; connects lines of a scanner that are far apart before it gives up on clusters.
std::vector<std::uint8_t> keep_without_strays(const std::vector<Vec3>& points, const scans::SurfaceElements& elements,
                                              const io::ImportSettings& settings, io::ImportReport& report) {
  // where only large cubes show a surface they are too few to judge their neighbours by
  constexpr std::size_t kFewest = 100;
  constexpr int kHalvings = 10;
  scans::ThinnedPoints thinned = scans::thin(points, elements.centre, elements.size);
  for (int k = 1; k <= kHalvings && thinned.position.size() < kFewest; ++k)
    thinned = scans::thin(points, elements.centre, std::ldexp(elements.size, -k));
  if (thinned.position.size() < kFewest) {
    report.warnings.push_back(
        fmt::format("the points lie at {} places only: none was judged to be stray", thinned.position.size()));
    return std::vector<std::uint8_t>(points.size(), 1);
  }
  scans::StraySettings how;
  how.outlier_distance = settings.clean.stray_distance * elements.size;
  how.least_cluster = settings.clean.stray_cluster;
  constexpr double kMostInClusters = 0.05;
  scans::StrayResult found;
  const auto in_clusters = [&] {
    return static_cast<double>(found.cluster_points) / static_cast<double>(thinned.position.size());
  };
  for (double gap = 6.0; gap < 200.0; gap *= 3.0) {
    found = scans::find_strays(thinned.position, how);
    if (in_clusters() <= kMostInClusters) break;
    how.cluster_gap = 3.0 * gap * found.spacing;
  }
  std::vector<std::uint8_t> keep(points.size(), 0);
  const bool clusters_count = in_clusters() <= kMostInClusters;
  if (!clusters_count)
    report.warnings.push_back(fmt::format(
        "{:.0f} % of the points lie in groups apart from the largest one; they were all kept", 100.0 * in_clusters()));
  std::size_t outliers = 0, clusters = 0;
  for (std::size_t v = 0; v < thinned.voxels.count(); ++v) {
    const scans::Stray stray = found.of_point[v];
    const bool kept = stray == scans::Stray::no || (stray == scans::Stray::cluster && !clusters_count);
    for (const std::uint32_t i : thinned.voxels.points_of(v)) keep[i] = kept ? 1 : 0;
    if (kept) continue;
    (stray == scans::Stray::outlier ? outliers : clusters) += thinned.voxels.points_of(v).size();
  }
  report.removed.push_back(
      {"stray points", outliers,
       fmt::format("mean distance to the {} nearest of the thinned points beyond {}", how.neighbours,
                   settings.clean.stray_distance > 0.0
                       ? fmt::format("{:g} times their size", settings.clean.stray_distance)
                       : "4 times the usual one")});
  report.removed.push_back({"stray clusters", clusters,
                            fmt::format("{} groups with less than {:g} of the points of the largest one",
                                        clusters_count ? found.clusters : 0, settings.clean.stray_cluster)});
  return keep;
}

/// What the points leave open about the place, with its numbers.
void doubt_place(PlacedScan& scan, io::ImportReport& report) {
  const scans::Placement& placement = scan.placement;
  constexpr double kRadius = 0.05e-3, kDirection = 1e-3, kSymmetric = 0.05e-3;
  if (placement.radius_error > kRadius || placement.direction_error > kDirection)
    report.warnings.push_back(
        fmt::format("the axle is not known well: {:.0f} degrees of the circumference leave the radius uncertain by "
                    "{:.2g} mm and the direction of the axle by {:.2g} mrad (standard errors); {}",
                    placement.arc * 180.0 / kPi, kMilli * placement.radius_error, kMilli * placement.direction_error,
                    scans::kKnowMore));
  if (placement.moved_by_back != 0.0)
    report.warnings.push_back(
        fmt::format("y = 0 is 70 mm from the back of the flange, {:.2f} mm from where the flange of {} would put it: "
                    "is the flange worn?",
                    kMilli * std::fabs(placement.moved_by_back), report.nominal));
  for (const measured::Doubt& doubt : placement.doubts) {
    report.warnings.push_back(fmt::format("{}: {}", doubt.name, doubt.text));
    scan.doubts.push_back({doubt.name, doubt.text});
  }
  if (!placement.match || !placement.match->ways) return;
  const scans::SectionMatch::Ways& ways = *placement.match->ways;
  if (ways.clear || !(ways.asymmetry > kSymmetric)) return;
  const std::string unclear = fmt::format(
      "which side of the rail is its gauge side is not clear: its points lie {:.3f} mm from {} on average, "
      "turned round {:.3f} mm; its sides differ by {:.2f} mm",
      kMilli * ways.here, report.nominal, kMilli * ways.turned, kMilli * ways.asymmetry);
  report.warnings.push_back(unclear +
                            ". x of the rail was taken to run as the axis of the scan does that is nearest; say "
                            "placement.forward, with the gauge side to the left, to settle it");
  scan.doubts.push_back({"gauge_side", unclear});
}

scans::PlaceSettings place_settings(const PlacedScan& scan, const io::ImportSettings& settings) {
  scans::PlaceSettings out;
  out.body = scan.body;
  if (!scan.nominal.empty()) out.nominal = nominal_section(scan.body, scan.nominal);
  if (settings.placement.nominal_radius_mm > 0.0) out.radius = 1e-3 * settings.placement.nominal_radius_mm;
  out.up = direction_of(settings.placement.up);
  out.forward = direction_of(settings.placement.forward);
  return out;
}

}  // namespace

Body body_of(const ImportRequest& request) {
  if (request.settings.scan.body != "auto") return request.settings.scan.body == "wheel" ? Body::wheel : Body::rail;
  for (const auto& output : request.outputs)
    if (const auto named = io::body_by_extension(output)) return *named;
  throw Error(ErrorKind::configuration, "nothing says whether the scan is that of a wheel or a rail",
              {request.scans.front().string()}, "say --body wheel or --body rail");
}

namespace {

/// More points of a rail's nominal section (y, z) where it is steep, and on to its ends, so that they are some half
/// millimetre apart along its flanks too.
void resolve_flanks(const Surface& surface, std::vector<Vec2>& points) {
  constexpr double kApart = 0.5e-3, kFinest = 1e-7;
  const auto height = [&](double y) {
    double z = 0.0;
    HeightsOut out;
    out.z = {&z, 1};
    section_heights(surface, Body::rail, 0.0, {&y, 1}, out);
    return z;
  };
  // the ends, between the last place with a height and the next without
  const double step = points[1].x() - points[0].x();
  for (const double way : {-1.0, 1.0}) {
    Vec2 end = way < 0.0 ? points.front() : points.back();
    for (double reach = 0.5 * step; reach > kFinest; reach *= 0.5)
      if (const double z = height(end.x() + way * reach); !std::isnan(z)) end = {end.x() + way * reach, z};
    points.insert(way < 0.0 ? points.begin() : points.end(), end);
  }
  std::vector<Vec2> out{points.front()};
  for (std::size_t k = 1; k < points.size(); ++k) {
    std::vector<Vec2> ahead{points[k]};
    while (!ahead.empty()) {
      const Vec2 from = out.back(), to = ahead.back();
      if ((to - from).norm() <= kApart || to.x() - from.x() <= 2.0 * kFinest) {
        if (to.x() > from.x()) out.push_back(to);
        ahead.pop_back();
        continue;
      }
      const double y = 0.5 * (from.x() + to.x());
      ahead.emplace_back(y, height(y));
    }
  }
  points = std::move(out);
}

}  // namespace

void read_nominal(const ImportRequest& request, PlacedScan& scan) {
  std::string name = request.settings.placement.nominal;
  if (name == "none") return;
  if (name == "auto") name = scan.body == Body::wheel ? "S1002" : "60E1";
  SurfaceSpec spec;
  spec.body = scan.body;
  if (library_body(name)) {
    spec.shape = StandardProfile{name};
  } else {
    spec.shape = io::read_profile(name, scan.body, {}, {});
  }
  constexpr double kAnyRadius = 0.5;
  spec.nominal_radius = scan.body == Body::wheel ? kAnyRadius : 0.0;
  const NaturalSurface natural = create_natural(spec);
  std::vector<double> y, h;
  constexpr double kFarthest = 0.15, kStep = 0.2e-3;
  for (double at = -kFarthest; at <= kFarthest; at += kStep) y.push_back(at);
  h.resize(y.size());
  HeightsOut out;
  out.z = h;
  section_heights(*natural.surface, scan.body, 0.0, y, out);
  for (std::size_t k = 0; k < y.size(); ++k)
    if (!std::isnan(h[k])) scan.nominal.emplace_back(y[k], h[k] - spec.nominal_radius);
  if (scan.body == Body::rail) resolve_flanks(*natural.surface, scan.nominal);
  scan.nominal_spec = spec;
}

namespace {

/// The unit that was given, that of the file, that of such files, or that which makes the size that of the body.
LengthUnit find_unit(const Clouds& clouds, const io::ImportSettings& settings, Body body,
                     const scans::RoughPlace& rough, io::ImportReport& report) {
  const char* const what = body_name(body);
  if (settings.scan.unit != "auto") {
    report.unit_from = "given";
    return *length_unit(settings.scan.unit);
  }
  if (clouds.unit) {
    report.unit_from = "the file";
    return *clouds.unit;
  }
  if (clouds.usual_unit) {
    report.unit_from = "what is usual in such files";
    try {
      scans::check_unit(body, rough.size, *clouds.usual_unit);
    } catch (const Error& error) {
      throw Error(error.kind(), error.message(), {},
                  fmt::format("files of this kind are in {}: is it one {} alone, cut out of all around it? if its "
                              "numbers are in another unit, say it with --unit",
                              symbol(*clouds.usual_unit), what));
    }
    return *clouds.usual_unit;
  }
  report.unit_from = fmt::format("the size of the {}", what);
  const LengthUnit unit = scans::unit_by_size(body, rough.size);
  // no scanner that writes fractions of a metre stands so far away
  constexpr double kFarthest = 100.0;
  const double away = rough.elements.centre.norm() * metres_per(unit);
  if (unit != LengthUnit::metre && away > kFarthest)
    throw Error(ErrorKind::input_data,
                fmt::format("in {} the size would be that of a {}, but it lies {:.4g} m from the origin: are these "
                            "coordinates of a map?",
                            symbol(unit), what, away),
                {}, fmt::format("if it is one {} alone, say the unit with --unit; else cut it out", what));
  return unit;
}

/// The line that was given, in the unit of its file or of such files, else of the scan: points along it [m].
std::vector<Vec3> read_line(const std::string& name, LengthUnit unit) {
  const std::filesystem::path file = name;
  if (!io::is_scan_file(file))
    throw Error(
        ErrorKind::configuration, fmt::format("placement.line: {} is no file of points", name), {name},
        "give points along the rail, x y z in the scan's frame, in a file as scans are, or a file (.toml) with a "
        "[layout]; or say auto or straight");
  io::Scan scan = io::read_scan(file);
  const double factor = metres_per(scan.unit.value_or(scan.usual_unit.value_or(unit)));
  for (Vec3& p : scan.cloud.points) p *= factor;
  return std::move(scan.cloud.points);
}

/// A rail, first some piece of it and then along its line.
class RailOnItsLine {
 public:
  RailOnItsLine(PlacedScan& scan, const io::ImportSettings& settings, io::ImportReport& report)
      : scan_(scan), settings_(settings), report_(report) {
    if (settings.scan.unit != "auto") unit_ = length_unit(settings.scan.unit);
    if (io::extension_of(settings.placement.line) == ".toml") layout_ = layout_line(settings.placement.line);
  }

  /// A piece whose width tells the unit; none of a short rail.
  std::optional<scans::RoughPlace> piece(const scans::SurfaceElements& whole,
                                         const std::optional<LengthUnit>& of_file) {
    const std::optional<LengthUnit> unit = unit_ ? unit_ : of_file;
    std::optional<Vec3> near;
    if (is_given()) {
      if (!unit)
        throw Error(ErrorKind::configuration, "a line in the scan's unit (placement.line) needs this unit", {},
                    "say it with --unit");
      given_points_ = read_line(settings_.placement.line, *unit);
      if (given_points_.empty())
        throw Error(ErrorKind::input_data, "placement.line: the file has no points", {settings_.placement.line});
      near = given_points_[given_points_.size() / 2] / metres_per(*unit);
    }
    auto found = scans::find_piece(scan_.points, scan_.keep, whole, unit, near);
    long_ = found.has_value();
    return found;
  }

  /// Somebody wants to know.
  bool is_asked_for() const { return is_given() || layout_.has_value(); }

  /// By points; a layout is for later.
  bool is_given() const {
    return settings_.placement.line != "auto" && settings_.placement.line != "straight" && !layout_;
  }

  /// Finds the line, and straightens the points along it if it is bent; rough and how are then about those.
  /// base: piece, or all of a short rail. All in metres.
  void follow(const scans::RoughPlace& base, scans::RoughPlace& rough, scans::PlaceSettings& how, bool must) {
    try {
      const Pose start = scans::first_frame(base, how);
      std::optional<scans::RailLine> given;
      if (is_given()) given = line_without_jumps(-start.rotation.col(2));
      if (given) require_near(*given, start.origin);
      // passes are not laid on each other better than that
      const double least = long_ ? scans::kLeastDeviation : std::max(scans::kLeastDeviation, report_.pass_after);
      scan_.line = scans::find_line(scan_.points, long_ ? of_one_pass() : scan_.keep, base, rough.elements, how,
                                    given ? &*given : nullptr, least);
      if (given) compare_with(*given);
      if (layout_) {
        const LayoutMatch match = match_layout(*layout_, 1e-3 * settings_.placement.line_beside_mm, scan_.line->line);
        io::ImportReport::Line& line = report_.line.emplace();
        line.given_largest = match.largest;
        line.given_rms = match.rms;
      }
    } catch (const Error& error) {
      if (must || is_given() || layout_) throw;
      // sparse lines and short pieces stay what they were without a line
      if (long_)
        report_.warnings.push_back(
            fmt::format("the line of the rail was not found, which is taken to be straight: {}", error.message()));
      return;
    }
    constexpr double kLong = 2.0;  // from which runs and gaps are looked for [m]
    bool others = false;
    if (scan_.line->line.length() > kLong)
      for (const measured::Doubt& doubt : scans::line_doubts(scan_.points, scan_.keep, scan_.passes, *scan_.line)) {
        report_.warnings.push_back(fmt::format("{}: {}", doubt.name, doubt.text));
        scan_.doubts.push_back({doubt.name, doubt.text});
        others = others || doubt.name == "several_rails" || doubt.name == "switch";
      }
    // where no rail was seen as a whole it must be, once what is beside it is gone
    if (!scan_.line->bent && !others && !must) return;
    if (scan_.line->bent) {
      scan_.line->line.straighten(scan_.points);
      scan_.laid_by.emplace_back([line = scan_.line->line](std::span<Vec3> points, std::span<const std::uint16_t>) {
        line.straighten(points);
      });
      drop_beside(scan_.points);
    } else {
      std::vector<Vec3> straight = scan_.points;
      scan_.line->line.straighten(straight);
      drop_beside(straight);
    }
    rough = scans::find_roughly(scan_.points, scan_.keep, Body::rail);
    if (!scan_.line->bent) return;
    how.up = -Vec3::UnitZ();
    if (how.forward) how.forward = Vec3::UnitX();
  }

 private:
  /// Passes that are not aligned yet would bend and twist the line between them: flags of the one that reaches
  /// farthest, if it goes all along.
  std::vector<std::uint8_t> of_one_pass() const {
    std::map<std::uint16_t, Eigen::AlignedBox3d> reach;
    Eigen::AlignedBox3d all;
    for (std::size_t i = 0; i < scan_.passes.size(); ++i) {
      if (!scan_.keep.empty() && scan_.keep[i] == 0) continue;
      reach[scan_.passes[i]].extend(scan_.points[i]);
      all.extend(scan_.points[i]);
    }
    const auto longest = std::max_element(reach.begin(), reach.end(), [](const auto& a, const auto& b) {
      return a.second.diagonal().norm() < b.second.diagonal().norm();
    });
    constexpr double kAllAlong = 0.95;
    if (reach.size() < 2 || longest->second.diagonal().norm() < kAllAlong * all.diagonal().norm()) return scan_.keep;
    std::vector<std::uint8_t> out(scan_.points.size());
    for (std::size_t i = 0; i < out.size(); ++i)
      out[i] = scan_.passes[i] == longest->first && (scan_.keep.empty() || scan_.keep[i] != 0) ? 1 : 0;
    return out;
  }

  /// What is beside the rail would pass for a part of it where its middle and its outermost section are looked for;
  /// what is far beyond its ends lies along a line that nobody has seen. straight: the points along the line.
  void drop_beside(std::span<const Vec3> straight) {
    constexpr double kBeside = 0.25;  // [m]
    if (scan_.keep.empty()) scan_.keep.assign(straight.size(), 1);
    const double from = scan_.line->line.from() - scans::kLeastGap, to = scan_.line->line.to() + scans::kLeastGap;
    std::size_t count = 0;
    for (std::size_t i = 0; i < straight.size(); ++i) {
      const Vec3& p = straight[i];
      if (scan_.keep[i] == 0 || (std::hypot(p.y(), p.z()) <= kBeside && p.x() >= from && p.x() <= to)) continue;
      scan_.keep[i] = 0;
      ++count;
    }
    report_.removed.push_back(
        {"beside the line", count,
         fmt::format("farther than {:g} mm from the line of the rail, or than {:g} mm beyond its ends",
                     kMilli * kBeside, kMilli * scans::kLeastGap)});
  }

  scans::RailLine line_without_jumps(const Vec3& up) {
    std::vector<scans::LineJump> jumps;
    scans::RailLine out = scans::line_through(given_points_, up, &jumps);
    if (jumps.empty()) return out;
    constexpr std::size_t kMostTold = 5;
    std::string places;
    for (std::size_t k = 0; k < std::min(kMostTold, jumps.size()); ++k)
      places += fmt::format("{}{:.3g} m after {:.2f} m", k > 0 ? ", " : "", jumps[k].size, jumps[k].along);
    report_.warnings.push_back(fmt::format(
        "line_jump: the points of placement.line jump aside or back: {}{}; they were taken to go on from "
        "there as before, which the line that is found does not depend on but across gaps",
        places,
        jumps.size() > kMostTold ? fmt::format(" and at {} more places", jumps.size() - kMostTold) : std::string()));
    return out;
  }

  void require_near(const scans::RailLine& given, const Vec3& rail) const {
    constexpr double kFarthest = 2.0;  // [m]
    const auto place = given.locate(rail, given.nearest(rail));
    const double off = place ? std::hypot(place->y(), place->z()) : kInfinity;
    if (off > kFarthest)
      throw Error(ErrorKind::configuration,
                  fmt::format("placement.line: the rail that was found lies {:.3g} m from the line", off),
                  {settings_.placement.line}, "are its points in the scan's frame and unit?");
  }

  void compare_with(const scans::RailLine& given) {
    double largest = 0.0, squares = 0.0, count = 0.0;
    for (const scans::LineStation& station : scan_.line->stations) {
      const Vec3 here = scan_.line->line.position(station.along);
      const auto place = given.locate(here, given.nearest(here));
      if (!place || place->x() < given.from() || place->x() > given.to()) continue;
      const double off = std::hypot(place->y(), place->z());
      largest = std::max(largest, off);
      squares += off * off;
      count += 1.0;
    }
    io::ImportReport::Line& line = report_.line.emplace();
    if (count > 0.0) line.given_largest = largest, line.given_rms = std::sqrt(squares / count);
  }

  PlacedScan& scan_;
  const io::ImportSettings& settings_;
  io::ImportReport& report_;
  std::optional<LengthUnit> unit_;
  std::optional<LayoutLine> layout_;
  std::vector<Vec3> given_points_;
  bool long_ = false;
};

}  // namespace

Pose frame_in_cloud(const PlacedScan& scan, double x) {
  const Pose X_CS = scan.placement.X_CS * Pose{Vec3(x, 0.0, 0.0), Mat3::Identity()};
  if (!scan.straightened()) return X_CS;
  return scan.line->line.at(X_CS.origin.x()) * Pose{Vec3(0.0, X_CS.origin.y(), X_CS.origin.z()), X_CS.rotation};
}

Vec3 straightened(const PlacedScan& scan, const Vec3& point) {
  if (!scan.straightened()) return point;
  Vec3 out = point;
  scan.line->line.straighten({&out, 1});
  return out;
}

void fill_line(const PlacedScan& scan, const io::ImportSettings& settings, io::ImportReport& report) {
  if (!scan.line) return;
  const scans::FoundLine& found = *scan.line;
  const Pose& X_CS = scan.placement.X_CS;
  io::ImportReport::Line out = report.line.value_or(io::ImportReport::Line{});
  out.bent = found.bent;
  out.deviation = found.deviation;
  const std::optional<Vec3> up = direction_of(settings.placement.up);
  const auto x_of = [&](double along) {
    return X_CS.apply_inverse(found.bent ? Vec3(along, 0.0, 0.0) : found.line.position(along)).x();
  };
  const double from = found.line.from(), to = found.line.to();
  const bool reversed = x_of(to) < x_of(from);
  const double way = reversed ? -1.0 : 1.0, first = found.line.roll(reversed ? to : from);
  for (const scans::LineStation& station : found.stations) {
    io::ImportReport::LinePlace place;
    place.x = x_of(station.along);
    Pose frame = X_CS * Pose{Vec3(place.x, 0.0, 0.0), Mat3::Identity()};
    place.curvature_error = station.error.lateral;
    place.vertical_error = station.error.vertical;
    if (found.bent) {
      const double y = X_CS.origin.y(), z = X_CS.origin.z();
      frame = found.line.at(station.along) * Pose{Vec3(0.0, y, z), X_CS.rotation};
      // in the axes of the surface, and of its x axis, which lies beside the line
      const double stretch = 1.0 - station.turn.lateral * y - station.turn.vertical * z;
      const Vec3 bend = Vec3(0.0, station.turn.lateral, station.turn.vertical) / stretch,
                 error(0.0, station.error.lateral, station.error.vertical);
      const Mat3& R = X_CS.rotation;
      place.curvature = bend.dot(R.col(1));
      place.vertical = bend.dot(R.col(2));
      place.curvature_error = error.cwiseProduct(R.col(1)).norm();
      place.vertical_error = error.cwiseProduct(R.col(2)).norm();
    }
    place.place = frame.origin;
    place.twist_error = station.error.twist;
    if (found.bent) {
      place.twist = station.turn.twist;
      place.roll = way * (found.line.roll(station.along) - first);
    }
    if (up) {
      place.roll = -std::asin(std::clamp(frame.rotation.col(1).dot(*up), -1.0, 1.0));
      place.gradient = std::asin(std::clamp(frame.rotation.col(0).dot(*up), -1.0, 1.0));
    }
    out.places.push_back(place);
  }
  if (reversed) std::reverse(out.places.begin(), out.places.end());
  report.line = std::move(out);
}

namespace {

void refuse_map_coordinates(const Clouds& clouds, const io::ImportSettings& settings) {
  if (settings.scan.unit == "auto" && !clouds.reference.empty())
    throw Error(ErrorKind::input_data,
                "the coordinates are those of a map: the file names the coordinate system " + clouds.reference, {},
                "if the points are those of one wheel or rail alone, say the unit of the map with --unit; else cut it "
                "out and export it in the scanner's own coordinates");
}

}  // namespace

SeparateRails separate_rails(Clouds both, const io::ImportSettings& settings, io::ImportReport& report) {
  refuse_map_coordinates(both, settings);
  scans::PlaceSettings how;
  how.body = Body::rail;
  how.up = direction_of(settings.placement.up);
  how.forward = direction_of(settings.placement.forward);
  scans::RoughPlace whole;
  whole.elements = scans::look_for_elements(both.cloud.points);
  std::optional<LengthUnit> unit = both.unit ? both.unit : both.usual_unit;
  if (settings.scan.unit != "auto") unit = length_unit(settings.scan.unit);
  std::optional<scans::RoughPlace> piece = scans::find_piece(both.cloud.points, {}, whole.elements, unit);
  if (!piece)
    throw Error(
        ErrorKind::input_data, "no rail was found by whose side the other one could be looked for", {},
        "both rails of a track must be scanned along a metre at least; cut out what is none of them (scan.box_from), "
        "and say the unit with --unit");
  const double factor = metres_per(find_unit(both, settings, Body::rail, *piece, report));
  std::vector<Vec3> points = both.cloud.points;
  for (Vec3& p : points) p *= factor;
  scans::scale(whole, factor);
  scans::scale(*piece, factor);
  const scans::FoundLine found = scans::find_line(points, {}, *piece, whole.elements, how);
  const scans::TrackRails rails = scans::separate_rails(points, found.line);
  // what lies beside both: the other one of these is no surprise
  std::vector<Vec3> others;
  std::vector<std::uint16_t> passes_of_others;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (rails.of_point[i] == rails.other) continue;
    others.push_back(points[i]);
    if (!both.cloud.passes.empty()) passes_of_others.push_back(both.cloud.passes[i]);
  }
  for (const measured::Doubt& doubt : scans::line_doubts(others, {}, passes_of_others, found))
    if (doubt.name == "several_rails" || doubt.name == "switch")
      report.warnings.push_back(fmt::format("{}: {}", doubt.name, doubt.text));
  SeparateRails out;
  out.clouds[0] = both;
  out.clouds[1] = std::move(both);
  for (const std::size_t side : {0u, 1u}) {
    Clouds& one = out.clouds[side];
    keep_points(one.cloud, [&](std::size_t i) {
      return rails.of_point[i] == (side == 0 ? scans::TrackRail::left : scans::TrackRail::right);
    });
    out.forward[side] = side == 0 ? Vec3(-rails.forward) : rails.forward;
  }
  return out;
}

PlacedScan find_place(Clouds clouds, const ImportRequest& request, io::ImportReport& report, StepClock& clock) {
  const io::ImportSettings& settings = request.settings;
  refuse_map_coordinates(clouds, settings);
  PlacedScan scan;
  scan.body = body_of(request);
  read_nominal(request, scan);
  report.nominal = scan.nominal_spec ? (settings.placement.nominal == "auto"
                                            ? (scan.body == Body::wheel ? "S1002" : "60E1")
                                            : std::filesystem::path(settings.placement.nominal).filename().string())
                                     : "none";
  scan.points = std::move(clouds.cloud.points);
  scan.passes = std::move(clouds.cloud.passes);
  scan.intensities = std::move(clouds.cloud.intensities);
  scan.stations = std::move(clouds.cloud.stations);

  clock.begin("stray points");
  if (settings.clean.strays)
    scan.keep = keep_without_strays(scan.points, scans::look_for_elements(scan.points), settings, report);

  clock.begin("placement");
  const bool look_along = scan.body == Body::rail && settings.placement.line != "straight";
  scans::RoughPlace rough;
  std::optional<Error> no_body;  // as a whole, which a long rail in a curve need not be
  try {
    rough = scans::find_roughly(scan.points, scan.keep, scan.body);
  } catch (const Error& error) {
    if (!look_along) throw;
    no_body = error;
    rough.elements = scans::look_for_elements(scan.points, scan.keep);
  }
  RailOnItsLine on_line(scan, settings, report);
  std::optional<scans::RoughPlace> piece;
  if (look_along) piece = on_line.piece(rough.elements, clouds.unit ? clouds.unit : clouds.usual_unit);
  if (no_body && !piece) throw Error(*no_body);
  report.spacing = rough.elements.spacing;
  const LengthUnit unit = find_unit(clouds, settings, scan.body, piece ? *piece : rough, report);
  scans::check_unit(scan.body, piece ? piece->size : rough.size, unit);
  report.unit = symbol(unit);
  const double factor = scan.metres = metres_per(unit);
  for (Vec3& p : scan.points) p *= factor;
  for (auto& [pass, place] : scan.stations) place *= factor;
  scans::scale(rough, factor);
  if (piece) scans::scale(*piece, factor);
  report.spacing *= factor;
  scans::PlaceSettings how = place_settings(scan, settings);
  // what bends by less than its section is wide is placed, and its passes aligned, before
  if (piece) on_line.follow(*piece, rough, how, no_body.has_value());
  scan.placement = scans::place(scan.points, scan.keep, rough, how);

  if (settings.scan.pass_steps && !scan.passes.empty()) {
    clock.begin_extra("passes");
    const double radius = scan.body == Body::wheel ? scan.placement.nominal_radius : 1.0;
    constexpr int kRounds = 2;
    for (int round = 0; round < kRounds; ++round) {
      const scans::Projection projection =
          scans::project(scan.points, scan.keep, scan.placement.X_CS, scan.placement.section,
                         {scan.body, radius, 1e-3 * settings.clean.farthest_mm, 2e-3});
      const scans::PassSteps steps = scans::find_pass_steps(projection.points, projection.band, scan.passes);
      if (steps.passes.empty()) break;
      scans::apply(steps, scan.passes, scan.placement.X_CS, scan.points);
      scan.laid_by.emplace_back(
          [steps, X_CS = scan.placement.X_CS](std::span<Vec3> points, std::span<const std::uint16_t> passes) {
            scans::apply(steps, passes, X_CS, points);
          });
      if (round == 0) report.pass_before = steps.before;
      report.pass_after = steps.after;
      scan.pass_error = steps.unexplained;
      for (std::size_t k = 0; k < steps.passes.size(); ++k) {
        const scans::PassStep& step = steps.passes[k];
        if (round == 0) report.passes.push_back({step.pass, step.points, Vec3::Zero(), Vec3::Zero()});
        if (k < report.passes.size()) {
          report.passes[k].shift_S += step.shift_S;
          report.passes[k].turn_S += step.turn_S;
        }
        if (round == 0 && step.shared == 0)
          report.warnings.push_back(fmt::format("pass {} overlaps with no other and was left where it is", step.pass));
      }
      scan.placement = scans::place(scan.points, scan.keep, rough, how);
    }
  }
  // of shorter rails even tight curves bend less than damage begins at, and damage may be all along them
  constexpr double kShortest = 0.25;  // [m]
  if (look_along && !piece && (2.0 * rough.elements.radius >= kShortest || on_line.is_asked_for())) {
    on_line.follow(rough, rough, how, false);
    if (scan.straightened()) scan.placement = scans::place(scan.points, scan.keep, rough, how);
  }
  doubt_place(scan, report);
  // files and cases must agree on a radius: one that people write down
  constexpr double kRound = 0.01e-3;
  if (scan.body == Body::wheel)
    scan.placement.nominal_radius = kRound * std::round(scan.placement.nominal_radius / kRound);
  if (settings.placement.nominal_radius_mm > 0.0 && scan.body == Body::wheel) {
    const double given = 1e-3 * settings.placement.nominal_radius_mm;
    constexpr double kFar = 60e-3;
    if (std::fabs(given - scan.placement.nominal_radius) > kFar)
      throw Error(ErrorKind::input_data,
                  fmt::format("the scanned wheel has a radius of {:.2f} mm, not {:.2f} mm",
                              1e3 * scan.placement.nominal_radius, 1e3 * given),
                  {}, "leave the nominal radius out, or is the unit another one?");
    scan.placement.nominal_radius = given;
  }
  return scan;
}

}  // namespace treadmark::app
