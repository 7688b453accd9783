// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/app/import/truth.hpp"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <system_error>
#include <vector>

#include "treadmark/app/import/fill_report.hpp"
#include "treadmark/app/surfaces/named_surface.hpp"
#include "treadmark/app/surfaces/read_surface.hpp"
#include "treadmark/core/constants.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/core/missing_file.hpp"
#include "treadmark/core/parallel.hpp"
#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/core/to_whole.hpp"
#include "treadmark/io/files/extension.hpp"
#include "treadmark/io/files/sha256.hpp"
#include "treadmark/io/files/shape_extension.hpp"
#include "treadmark/io/json/json_tree.hpp"
#include "treadmark/model/shape/body_name.hpp"
#include "treadmark/model/shape/natural_view.hpp"
#include "treadmark/scans/placement/band_frame.hpp"

namespace treadmark::app {
namespace {

using Path = std::filesystem::path;
using Vector6 = Eigen::Matrix<double, 6, 1>;
using Matrix6 = Eigen::Matrix<double, 6, 6>;

void require_body(const Path& file, Body is, Body wanted) {
  if (is != wanted)
    throw Error(ErrorKind::configuration,
                fmt::format("the reference is a {}, the scan shall become a {}", body_name(is), body_name(wanted)),
                {file.string()}, "name the reference of this scan");
}

Pose read_pose(const io::JsonTree& pose) {
  Pose out;
  const std::vector<io::JsonTree> rows = pose.at("rows_mm").items();
  if (rows.size() != 3) pose.at("rows_mm").refuse("has no three rows");
  for (int i = 0; i < 3; ++i) {
    const std::vector<double> row = rows[static_cast<std::size_t>(i)].numbers();
    if (row.size() != 4) rows[static_cast<std::size_t>(i)].refuse("has no four numbers");
    for (int j = 0; j < 3; ++j) out.rotation(i, j) = row[static_cast<std::size_t>(j)];
    out.origin[i] = row[3] / kMilli;
  }
  constexpr double kRound = 1e-6;
  const Mat3 product = out.rotation.transpose() * out.rotation;
  if (!((product - Mat3::Identity()).cwiseAbs().maxCoeff() < kRound && out.rotation.determinant() > 0.0 &&
        out.origin.allFinite()))
    pose.at("rows_mm").refuse("is no rotation and origin");
  return out;
}

/// The surface of a scan: beside the truth, where the scan was made, or a name of the profile library.
Path surface_of(const Path& truth, const Path& named) {
  std::error_code ignored;
  for (const Path& place : {truth.parent_path() / named, named})
    if (std::filesystem::exists(place, ignored)) return place;
  if (library_body_of(named)) return named;
  throw Error(ErrorKind::configuration, fmt::format("the surface that was scanned is not there: {}", named.string()),
              {truth.string()}, "put it beside this file, or start where the scan was made");
}

/// The line along which a rail was scanned: beside the truth, or where the scan was made.
LayoutLine line_of_scan(const Path& truth, const io::JsonTree& line) {
  const Path named = line.text("file");
  std::error_code ignored;
  for (const Path& place : {truth.parent_path() / named, named}) {
    if (!std::filesystem::exists(place, ignored)) continue;
    if (line.text("sha256") != io::sha256_file(place))
      throw Error(ErrorKind::configuration, "the line has changed since the rail was scanned along it",
                  {place.string()}, "scan it again, or bring back the file of the line");
    return layout_line(place);
  }
  throw Error(ErrorKind::configuration,
              fmt::format("the line along which the rail was scanned is not there: {}", named.string()),
              {truth.string()}, "put it beside this file, or start where the scan was made");
}

Truth read_scan_truth(const Path& file, Body body) {
  const io::JsonTree json = io::read_json_file(file);
  const auto part = [&](const char* key) {
    if (!json.find(key))
      throw Error(ErrorKind::input_data, fmt::format("this is not what treadmark scan --truth writes: no \"{}\"", key),
                  {file.string()}, "name its file, or the file of the true surface");
    return json.at(key);
  };
  const io::JsonTree surface = part("surface"), cloud = part("cloud");
  Truth out;
  out.file = file;
  require_body(file, surface.at("body").one_of({"wheel", "rail"}) == 0 ? Body::wheel : Body::rail, body);
  out.X_CT = read_pose(part("surface_in_cloud"));
  out.points = cloud.count("points");
  if (const auto line = json.find("line")) out.line = line_of_scan(file, *line);
  out.surface = surface_of(file, surface.text("file"));
  if (const auto sum = surface.find("sha256"); sum && sum->text() != io::sha256_file(out.surface))
    throw Error(ErrorKind::configuration, "the surface has changed since it was scanned", {out.surface.string()},
                "scan it again, or bring back the file that was scanned");
  NamedSurface how;
  how.body = body;
  if (body == Body::wheel && !is_offset_file(out.surface))
    how.nominal_radius = surface.number("nominal_radius_mm") / kMilli;
  if (const auto scale = surface.find("scale_to_mm")) how.scale_to_mm = scale->number();
  if (const auto set = surface.find("set")) how.overrides = set->texts();
  out.natural = named_surface(out.surface, how);
  return out;
}

/// Places of the surface in rows of equal station: y across, v out of the material; NaN = nothing to compare.
struct Places {
  Body body = Body::rail;
  std::size_t rows = 0, columns = 0;
  std::vector<double> u, y, v;
  io::BandMap map;  ///< without values

  std::size_t index(std::size_t row, std::size_t column) const { return row * columns + column; }
};

constexpr double kMargin = 1.5e-3;  // from the rims [m]
constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

/// Where a place along the band counts from: a of the surface's u.
double along_of(const scans::FittedBand& fitted, double u) {
  const scans::Band& band = fitted.band;
  const double a = (u + fitted.u_zero) * band.radius - band.a_min;
  return band.closed ? a - band.length() * std::floor(a / band.length()) : a;
}

Places places_of(const FittedScan& fit) {
  constexpr std::size_t kMostRows = 3000, kMostColumns = 256;
  const scans::FittedBand& fitted = fit.fitted;
  const scans::Band& band = fitted.band;
  Places out;
  out.body = fit.scan.body;
  out.rows = std::min(fit.points.rows, kMostRows);
  out.columns = std::min(fit.points.columns, kMostColumns);
  const double begin = band.closed ? -std::numbers::pi : fitted.u_at(0.0);
  out.map.rows = out.rows;
  out.map.columns = out.columns;
  out.map.a_min = begin * band.radius;
  out.map.a_max = out.map.a_min + band.length();
  out.map.s_max = band.section.length();
  out.u.resize(out.rows);
  out.y.assign(out.rows * out.columns, kNone);
  out.v = out.y;
  std::optional<NaturalSurface> sections;
  if (fit.sections != nullptr) {
    SurfaceSpec spec;
    spec.body = out.body;
    spec.nominal_radius = out.body == Body::wheel ? fit.scan.placement.nominal_radius : 0.0;
    spec.shape = *fit.sections;
    sections = create_natural(std::move(spec));
  }
  const double step_s = band.section.length() / static_cast<double>(out.columns);
  parallel_for(out.rows, [&](std::size_t r) {
    const double along = band.length() * (static_cast<double>(r) + 0.5) / static_cast<double>(out.rows);
    out.u[r] = begin + along / band.radius;
    if (!band.closed && (along < kMargin || along > band.length() - kMargin)) return;
    const double a = along_of(fitted, out.u[r]);
    const auto row = std::min(fit.points.rows - 1, to_whole<std::size_t>(a / fit.points.cell_a));
    for (std::size_t c = 0; c < out.columns; ++c) {
      const double s = step_s * (static_cast<double>(c) + 0.5);
      if (s < fitted.s_min + kMargin || s > fitted.s_max - kMargin) continue;
      const auto column = std::min(fit.points.columns - 1, to_whole<std::size_t>(s / fit.points.cell_s));
      if (!fit.coverage.open.empty() && fit.coverage.open[row * fit.points.columns + column] != 0) continue;
      const Vec2 p = fitted.across(a, s);
      out.y[out.index(r, c)] = p.x();
      out.v[out.index(r, c)] = p.y();
    }
    if (!sections) return;
    const std::size_t first = out.index(r, 0);
    HeightsOut heights;
    std::vector<double> y(out.columns), z(out.columns);
    for (std::size_t c = 0; c < out.columns; ++c) y[c] = std::isnan(out.y[first + c]) ? 0.0 : out.y[first + c];
    heights.z = z;
    section_heights(*sections->surface, out.body, out.u[r], y, heights);
    for (std::size_t c = 0; c < out.columns; ++c)
      out.v[first + c] = std::isnan(out.y[first + c]) ? kNone : out.body == Body::wheel ? z[c] : -z[c];
  });
  return out;
}

/// Of the places of a row: how far the surface stands out of the truth along its normal [m], and, in the surface's
/// frame, where they are and these normals.
struct Row {
  std::vector<double> error;
  std::vector<Vec3> place, normal;
};

Row compare_row(const Places& places, std::size_t row, const Surface& truth, const Pose& X_TS) {
  const std::size_t first = places.index(row, 0), count = places.columns;
  const Pose X_SP = natural_plane(places.body, places.u[row]);
  const double out_of_material = places.body == Body::wheel ? 1.0 : -1.0;  // z of the plane
  std::vector<Vec2> points(count);
  std::vector<double> z(count), along(count), across(count);
  for (std::size_t c = 0; c < count; ++c)
    points[c] = {0.0, std::isnan(places.y[first + c]) ? 0.0 : places.y[first + c]};
  HeightsOut heights;
  heights.z = z;
  heights.dzdx = along;
  heights.dzdy = across;
  truth.heights_at(X_TS * X_SP, points, heights);
  Row out;
  out.error.assign(count, kNone);
  out.place.resize(count);
  out.normal.resize(count);
  for (std::size_t c = 0; c < count; ++c) {
    const double v = places.v[first + c];
    if (std::isnan(places.y[first + c]) || std::isnan(v) || std::isnan(z[c])) continue;
    const Vec3 normal = Vec3(-along[c], -across[c], 1.0).normalized();
    out.error[c] = (v - out_of_material * z[c]) * normal.z();
    out.place[c] = X_SP.apply({0.0, points[c].y(), out_of_material * v});
    out.normal[c] = X_SP.rotation * (out_of_material * normal);
  }
  return out;
}

std::vector<float> compare_all(const Places& places, const Surface& truth, const Pose& X_TS) {
  std::vector<float> out(places.rows * places.columns);
  parallel_for(places.rows, [&](std::size_t r) {
    const Row row = compare_row(places, r, truth, X_TS);
    for (std::size_t c = 0; c < places.columns; ++c) out[places.index(r, c)] = static_cast<float>(row.error[c]);
  });
  return out;
}

std::vector<float> known_of(const std::vector<float>& values) {
  std::vector<float> out;
  out.reserve(values.size());
  for (const float value : values)
    if (std::isfinite(value)) out.push_back(value);
  return out;
}

/// Rigid motion in the surface's frame (before X_TS) that lays the surface on the truth best. Directions in which the
/// truth does not resist (along a straight rail, round a wheel) stay as they are.
Pose best_motion(const Places& places, const Surface& truth, const Pose& X_TS) {
  constexpr int kMostSteps = 8;
  constexpr std::size_t kMostRows = 400;
  constexpr double kLength = 0.1;    // turns count by what they move at this distance [m]
  constexpr double kResists = 1e-6;  // least resistance, of the greatest
  constexpr double kSettled = 1e-9;  // [m]
  const std::size_t every = std::max<std::size_t>(1, places.rows / kMostRows);
  const std::size_t rows = (places.rows + every - 1) / every;
  Pose motion;
  for (int step = 0; step < kMostSteps; ++step) {
    std::vector<Matrix6> squares(rows, Matrix6::Zero());
    std::vector<Vector6> sums(rows, Vector6::Zero());
    parallel_for(rows, [&](std::size_t i) {
      const Row row = compare_row(places, i * every, truth, X_TS * motion);
      for (std::size_t c = 0; c < places.columns; ++c) {
        if (std::isnan(row.error[c])) continue;
        const Vec3 normal = motion.rotation * row.normal[c], place = motion.apply(row.place[c]);
        Vector6 way;
        way << normal, place.cross(normal) / kLength;
        squares[i] += way * way.transpose();
        sums[i] -= row.error[c] * way;
      }
    });
    Matrix6 square = Matrix6::Zero();
    Vector6 sum = Vector6::Zero();
    for (std::size_t i = 0; i < rows; ++i) square += squares[i], sum += sums[i];
    const Eigen::SelfAdjointEigenSolver<Matrix6> modes(square);
    Vector6 move = Vector6::Zero();
    for (int k = 0; k < 6; ++k)
      if (modes.eigenvalues()[k] > kResists * modes.eigenvalues()[5])
        move += modes.eigenvectors().col(k) * (modes.eigenvectors().col(k).dot(sum) / modes.eigenvalues()[k]);
    const Vec3 turn = move.tail<3>() / kLength;
    const double angle = turn.norm();
    const Pose moved{move.head<3>(),
                     angle > 0.0 ? Mat3(Eigen::AngleAxisd(angle, turn / angle)) : Mat3(Mat3::Identity())};
    motion = moved * motion;
    if (move.norm() < kSettled) break;
  }
  return motion;
}

/// Frame on frame, stations counted from the same place.
Pose along_pose(Body body, double along, bool reversed) {
  if (body == Body::wheel) return {Vec3::Zero(), rotation_y(along)};
  return {Vec3(along, 0.0, 0.0), reversed ? rotation_z(kPi) : Mat3(Mat3::Identity())};
}

struct Along {
  double at = 0.0;  ///< station of the truth at u = 0
  bool reversed = false;
};

Along along_of(Body body, const Pose& X_TS) {
  const Mat3& R = X_TS.rotation;
  if (body == Body::wheel) return {std::atan2(R(0, 2), R(2, 2)), false};
  return {X_TS.origin.x(), R(0, 0) < 0.0};
}

/// Of a surface whose frame is known in the cloud.
Along along_in_cloud(const Truth& truth, const PlacedScan& scan) {
  const Pose X_TS = truth.X_CT->inverse() * frame_in_cloud(scan);
  const LineFrames& line = truth.line.frames;
  if (!line) return along_of(scan.body, X_TS);
  // the nearest of places some apart, on or before the line or behind it
  constexpr double kApart = 1.0, kBeyond = 20.0;  // [m]
  double near = X_TS.origin.x(), least = (line(near).origin - X_TS.origin).squaredNorm();
  for (double at = -kBeyond; at < truth.line.length + kBeyond; at += kApart)
    if (const double square = (line(at).origin - X_TS.origin).squaredNorm(); square < least) least = square, near = at;
  const double at = place_along(line, X_TS.origin, near);
  if (std::isnan(at)) return along_of(scan.body, X_TS);
  return {at, line(at).rotation.col(0).dot(X_TS.rotation.col(0)) < 0.0};
}

/// The shift along the band at which surface and truth vary most alike. A tie: the least shift.
Along find_along(const FittedScan& fit, const Truth& truth) {
  constexpr std::size_t kColumns = 32;
  constexpr double kLeastStep = 1e-3, kLongest = 4.0, kBeyond = 1.0;  // [m]
  constexpr double kCommon = 0.5, kBetter = 1e-4;
  const scans::FittedBand& fitted = fit.fitted;
  const scans::Band& band = fitted.band;
  const Body body = fit.scan.body;
  if (truth.natural.constant_profile()) return {};
  const double length = band.length(), step = std::max(kLeastStep, length / (kLongest / kLeastStep));
  const bool round = body == Body::wheel;
  const double turn = 2.0 * std::numbers::pi;
  const double even = round ? turn / std::ceil(turn * band.radius / step) : step;  // of u
  const auto steps_of = [&](double range) { return to_whole<std::size_t>(std::max(2.0, std::round(range / even))); };
  const std::size_t stations = steps_of(length / band.radius);
  const double begin = band.closed ? -std::numbers::pi : fitted.u_at(0.0);
  // as far as the truth goes, of one without ends some way
  const Box3 box = truth.natural.surface->bounds();
  const double from = round ? -std::numbers::pi : std::max(box.min.x(), -kBeyond - length),
               to = round ? std::numbers::pi : std::min(box.max.x(), kBeyond + length);
  if (!(from < to)) return {};
  const std::size_t truth_stations = steps_of(to - from);
  const double s_step = (fitted.s_max - fitted.s_min - 2.0 * kMargin) / kColumns;

  const auto sampled = [&](std::size_t count, const auto& value) {
    std::vector<float> out(count * kColumns, std::numeric_limits<float>::quiet_NaN());
    parallel_for(count, [&](std::size_t i) { value(i, std::span(out).subspan(i * kColumns, kColumns)); });
    return out;
  };
  const auto s_of = [&](std::size_t c) { return fitted.s_min + kMargin + s_step * (static_cast<double>(c) + 0.5); };
  const std::vector<float> found = sampled(stations, [&](std::size_t i, std::span<float> row) {
    const double a = along_of(fitted, begin + even * (static_cast<double>(i) + 0.5));
    for (std::size_t c = 0; c < kColumns; ++c) row[c] = static_cast<float>(fitted.field.value(a, s_of(c)));
  });
  std::array<double, kColumns> mean{};
  for (std::size_t i = 0; i < found.size(); ++i)
    mean[i % kColumns] += static_cast<double>(found[i]) / static_cast<double>(stations);
  const auto truth_rows = [&](double sign) {
    return sampled(truth_stations, [&](std::size_t k, std::span<float> row) {
      std::vector<double> y(kColumns), z(kColumns);
      for (std::size_t c = 0; c < kColumns; ++c) y[c] = sign * band.section.at(s_of(c)).position.x();
      HeightsOut heights;
      heights.z = z;
      section_heights(*truth.natural.surface, body, from + even * (static_cast<double>(k) + 0.5), y, heights);
      for (std::size_t c = 0; c < kColumns; ++c) {
        const scans::Section::Point at = band.section.at(s_of(c));
        const double out = body == Body::wheel ? z[c] : -z[c];
        row[c] = static_cast<float>((out - at.position.y()) * at.normal.y());
      }
    });
  };

  Along best;
  double best_score = std::numeric_limits<double>::infinity();
  for (const bool reversed : {false, true}) {
    if (reversed && round) continue;
    const std::vector<float> known = truth_rows(reversed ? -1.0 : 1.0);
    const auto n = static_cast<std::ptrdiff_t>(stations), m = static_cast<std::ptrdiff_t>(truth_stations);
    // candidate k: station 0 of the surface lies on station k of the truth
    const std::ptrdiff_t first = round ? 0 : -n, last = round ? m : m + n;
    std::vector<double> score(static_cast<std::size_t>(last - first), std::numeric_limits<double>::infinity());
    parallel_for(score.size(), [&](std::size_t q) {
      const std::ptrdiff_t k = first + static_cast<std::ptrdiff_t>(q);
      std::array<double, kColumns> sum{}, squares{}, count{};
      double alone = 0.0, without = 0.0;
      for (std::ptrdiff_t i = 0; i < n; ++i) {
        std::ptrdiff_t at = reversed ? k - i : k + i;
        if (round) at %= m;
        const bool there = at >= 0 && at < m;
        const float* a = found.data() + i * static_cast<std::ptrdiff_t>(kColumns);
        const float* b = known.data() + (there ? at : 0) * static_cast<std::ptrdiff_t>(kColumns);
        for (std::size_t c = 0; c < kColumns; ++c) {
          const double e = static_cast<double>(a[c]) - b[c];
          if (!there || std::isnan(e)) {
            // as against a plain truth: damage that lies beside it is no agreement
            alone += (a[c] - mean[c]) * (a[c] - mean[c]);
            without += 1.0;
            continue;
          }
          sum[c] += e;
          squares[c] += e * e;
          count[c] += 1.0;
        }
      }
      double total = 0.0, all = 0.0;
      for (std::size_t c = 0; c < kColumns; ++c)
        if (count[c] > 0.0) total += squares[c] - sum[c] * sum[c] / count[c], all += count[c];
      if (all > kCommon * static_cast<double>(n) * kColumns) score[q] = (total + alone) / (all + without);
    });
    const auto along_at = [&](double k) {
      // u of the truth at the surface's u = 0
      const double first_u = begin + 0.5 * even;
      const double at = from + even * (k + 0.5);
      const double along = reversed ? at + first_u : at - first_u;
      return round ? wrap_angle(along) : along;
    };
    std::ptrdiff_t least = -1;
    double least_score = best_score;
    for (std::size_t q = 0; q < score.size(); ++q) {
      const auto k = static_cast<double>(first + static_cast<std::ptrdiff_t>(q));
      const bool better = score[q] < (1.0 - kBetter) * least_score;
      const bool nearer = least >= 0 && score[q] < (1.0 + kBetter) * least_score &&
                          std::fabs(along_at(k)) < std::fabs(along_at(static_cast<double>(first + least)));
      if (better || nearer) {
        least = static_cast<std::ptrdiff_t>(q);
        least_score = std::min(least_score, score[q]);
      }
    }
    if (least < 0) continue;
    best_score = least_score;
    best = {along_at(static_cast<double>(first + least)), reversed};
  }
  return best;
}

void warn(io::ImportReport& report, const Truth& truth, const std::string& what) {
  report.warnings.push_back(
      fmt::format("{} {}: is it the reference of this scan?", truth.file.filename().string(), what));
}

}  // namespace

Truth read_truth(const Path& file, Body body, double nominal_radius) {
  if (io::extension_of(file) == ".json") return read_scan_truth(file, body);
  std::error_code ignored;
  const std::optional<Body> library = library_body_of(file);
  if (!library && !std::filesystem::is_regular_file(file, ignored))
    throw MissingFile(
        ErrorKind::configuration, "there is no such file of the reference", {file.string()},
        advice_on_missing(file, "name what treadmark scan --truth wrote, or the file of the true surface"));
  if (const auto named = io::body_by_extension(file)) require_body(file, *named, body);
  if (library) require_body(file, *library, body);
  NamedSurface how;
  if (!is_offset_file(file)) {
    how.body = body;
    how.nominal_radius = body == Body::wheel ? nominal_radius : 0.0;
  }
  Truth out;
  out.file = out.surface = file;
  out.natural = named_surface(file, how);
  require_body(file, out.natural.spec.body, body);
  return out;
}

void check_points(const Truth& truth, std::size_t points_read) {
  if (truth.points && *truth.points != points_read)
    throw Error(
        ErrorKind::configuration,
        fmt::format("the reference is that of a cloud of {} points, and {} were read", *truth.points, points_read),
        {truth.file.string()},
        "name the reference of this cloud; of a part of it, the surface itself: --truth " + truth.surface.string());
}

void compare_with_truth(const Truth& truth, const FittedScan& fit, io::ImportReport& report) {
  const Body body = fit.scan.body;
  const Surface& surface = *truth.natural.surface;
  const Places places = places_of(fit);
  Along along = truth.X_CT ? along_in_cloud(truth, fit.scan) : find_along(fit, truth);
  Pose X_TS = along_pose(body, along.at, along.reversed);
  const auto enough = [&](std::size_t known) {
    constexpr std::size_t kFewest = 500, kPart = 20;
    return known >= kFewest && kPart * known >= places.y.size();
  };
  if (!enough(known_of(compare_all(places, surface, X_TS)).size())) {
    warn(report, truth, "has hardly a place in common with the surface, which was not compared with it");
    return;
  }
  Pose motion = best_motion(places, surface, X_TS);
  if (!truth.X_CT) {
    // where nothing tells which stations belong together, a shift along the band is no error
    const Along more = along_of(body, motion);
    const Pose shift = along_pose(body, more.at, false);
    X_TS = X_TS * shift;
    motion = shift.inverse() * motion;
    along.at += along.reversed ? -more.at : more.at;
  }
  io::ImportReport::Truth out;
  out.file = truth.file.filename().string();
  out.surface = truth.surface.filename().string();
  out.from_scan = truth.X_CT.has_value();
  out.along = body == Body::wheel ? wrap_angle(along.at) : along.at;
  out.reversed = along.reversed;
  out.placed = distances_of(known_of(compare_all(places, surface, X_TS)));
  std::vector<float> errors = compare_all(places, surface, X_TS * motion);
  std::vector<float> known = known_of(errors);
  out.places = known.size();
  out.beside =
      static_cast<std::size_t>(ranges::count_if(places.v, [](double v) { return !std::isnan(v); })) - known.size();
  out.shape = distances_of(std::move(known));
  out.shift_S = motion.origin;
  const Eigen::AngleAxisd turn(motion.rotation);
  out.turn_S = turn.angle() * turn.axis();
  report.truth_map = places.map;
  report.truth_map.value = std::move(errors);
  constexpr double kSurelyWrong = 1e-3;
  if (out.shape.rms > kSurelyWrong || out.placed.rms > kSurelyWrong)
    warn(report, truth,
         fmt::format("lies {:.3g} mm (rms) from the surface, {:.3g} mm where both are best aligned",
                     kMilli * out.placed.rms, kMilli * out.shape.rms));
  report.truth = std::move(out);
}

}  // namespace treadmark::app
