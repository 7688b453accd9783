// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/io/profiles/read_profile.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "treadmark/io/files/line_scanner.hpp"
#include "treadmark/io/files/text.hpp"
#include "treadmark/io/profiles/clean_points.hpp"
#include "treadmark/io/profiles/parse_points.hpp"

namespace treadmark::io {
namespace {

using profiles::RawPoints;

constexpr double kNearDistance_mm = 1e-4;
constexpr double kSmallestScale = 1e-6;
constexpr double kSmallestZigzagThreshold = 0.7853981633974483;  // 45 degrees
constexpr double kShortest_mm = 5.0;
constexpr double kLongest_mm = 500.0;

void check_options(const ProfileOptions& options, const std::string& file) {
  const auto refuse = [&](const std::string& message) { throw Error(ErrorKind::configuration, message, {file, 0, 0}); };
  if (!(options.scale >= kSmallestScale && std::isfinite(options.scale)))
    refuse(fmt::format("the scale of a profile must be at least {:g}, this is {:g}", kSmallestScale, options.scale));
  if (std::abs(options.mirror_y) > 1 || std::abs(options.mirror_z) > 1)
    refuse("the mirror options of a profile must be -1, 0 or 1");
  if (!(options.max_omit >= 0.0)) refuse("the share of points that may be omitted must not be negative");
  if (std::isnan(options.zigzag_threshold)) refuse("the zig-zag threshold must be a number");
}

void negate(std::vector<double>& values) {
  for (double& value : values) value = -value;
}

void shift(std::vector<double>& values, double by) {
  for (double& value : values) value += by;
}

void scale(RawPoints& points, double factor) {
  for (double& y : points.y) y *= factor;
  for (double& z : points.z) z *= factor;
}

void reverse(RawPoints& points) {
  std::reverse(points.y.begin(), points.y.end());
  std::reverse(points.z.begin(), points.z.end());
  std::reverse(points.line.begin(), points.line.end());
}

void check_count(const RawPoints& points) {
  if (points.size() < 2)
    throw Error(ErrorKind::input_data, fmt::format("a profile needs at least 2 points, there are {}", points.size()),
                {points.file, 0, 0}, "is the file truncated or its extension wrong?");
}

void filter(RawPoints& points, double near_distance, const ProfileOptions& options) {
  check_count(points);
  const std::size_t count = points.size();
  profiles::remove_near_points(points, near_distance);
  profiles::remove_zigzags(points, std::max(kSmallestZigzagThreshold, options.zigzag_threshold));
  const auto removed = static_cast<double>(count - points.size());
  if (removed > options.max_omit * static_cast<double>(count))
    throw Error(ErrorKind::input_data,
                fmt::format("cleaning removed {} of {} points as too near or zig-zag, more than a share of {:g}",
                            count - points.size(), count, options.max_omit),
                {points.file, 0, 0}, "check the points and the unit of length, or allow a larger share");
}

void check_length(const RawPoints& points, Body body) {
  const double length = profiles::total_length(points);
  if (length >= kShortest_mm && length <= kLongest_mm) return;
  const auto plausible = [](double l) { return l >= kShortest_mm && l <= kLongest_mm; };
  std::string advice = "check the points and the scale, which leads to mm";
  if (plausible(1e3 * length)) advice = "is the file in metres? use a scale of 1000";
  if (plausible(25.4 * length) && !plausible(1e3 * length)) advice = "is the file in inches? use a scale of 25.4";
  if (plausible(1e-3 * length)) advice = "is a file in mm scaled like one in metres? use a scale of 1";
  throw Error(ErrorKind::input_data,
              fmt::format("the {} profile is {:.4g} mm long, outside {:g} to {:g} mm",
                          body == Body::rail ? "rail" : "wheel", length, kShortest_mm, kLongest_mm),
              {points.file, 0, 0}, advice);
}

void check_direction(const RawPoints& points, Body body) {
  const double change = points.y.back() - points.y.front();
  if (body == Body::rail && !(change > 0.0))
    throw Error(ErrorKind::input_data, "the points of a rail profile must run with increasing y", {points.file, 0, 0},
                "check the mirror options and the order of the points");
  if (body == Body::wheel && !(change < 0.0))
    throw Error(ErrorKind::input_data, "the points of a wheel profile must run with decreasing y", {points.file, 0, 0},
                "check the mirror options and the order of the points");
}

void check_crossing(const RawPoints& points) {
  std::size_t first = 0, second = 0;
  if (!profiles::crosses_itself(points, first, second)) return;
  throw Error(ErrorKind::input_data,
              fmt::format("the profile crosses itself at y = {:.4g} mm, between the points of lines {} and {}",
                          points.y[first], points.line[first], points.line[second]),
              {points.file, points.line[second], 0}, "repair the points");
}

/// From points in mm to a profile in metres.
Profile finish(RawPoints&& points, Body body, bool inverted, const ProfileOptions& options) {
  check_count(points);
  check_length(points, body);
  if (inverted || profiles::order_is_wrong(points, body)) reverse(points);
  check_direction(points, body);
  check_crossing(points);
  scale(points, 1e-3);
  Profile profile;
  profile.body = body;
  profile.y = std::move(points.y);
  profile.z = std::move(points.z);
  profile.name = points.file;
  profile.smoothing = options.smoothing;
  return profile;
}

Profile simpack_profile(std::string_view text, const std::string& file, Body body, const ProfileOptions& options) {
  profiles::SimpackContent content = profiles::parse_simpack(text, file, body);
  RawPoints& points = content.points;
  filter(points, content.near_distance, options);
  shift(points.y, content.shift_y);
  shift(points.z, content.shift_z);
  profiles::delete_outside_y(points, content.y_min, content.y_max);
  profiles::clip_z(points, content.z_min, content.z_max);
  if (int{content.mirror_y} + options.mirror_y == 1) negate(points.y);
  if (int{content.mirror_z} + options.mirror_z == 1) negate(points.z);
  scale(points, options.scale * 1000.0 / content.units_per_metre);
  return finish(std::move(points), body, content.inversion, options);
}

RawPoints column_points(profiles::ColumnContent&& content, const ProfileOptions& options) {
  RawPoints points = std::move(content.points);
  filter(points, kNearDistance_mm / options.scale, options);
  shift(points.y, content.offset_y);
  shift(points.z, content.offset_z);
  if (options.mirror_y == 1) negate(points.y);
  return points;
}

Profile column_profile(profiles::ColumnContent&& content, Body body, const ProfileOptions& options) {
  RawPoints points = column_points(std::move(content), options);
  if (options.mirror_z == 1 || (options.mirror_z == 0 && profiles::z_points_up(points, body))) negate(points.z);
  scale(points, options.scale);
  return finish(std::move(points), body, false, options);
}

std::optional<Body> body_of(const std::string& extension) {
  if (extension == ".prr" || extension == ".ban") return Body::rail;
  if (extension == ".prw" || extension == ".whl") return Body::wheel;
  return std::nullopt;
}

void check_file(const std::filesystem::path& file, Body body, const SourcePosition& referenced_from) {
  const std::string extension = profiles::lower(file.extension().string());
  const SourcePosition where = referenced_from.file.empty() ? SourcePosition{file.string(), 0, 0} : referenced_from;
  if (extension == ".slcs" || extension == ".slcw")
    throw Error(ErrorKind::configuration,
                fmt::format("a single profile is expected, '{}' is a set of slices", file.string()), where);
  if (const std::optional<Body> named = body_of(extension); named && *named != body)
    throw Error(ErrorKind::configuration,
                fmt::format("the extension of '{}' stands for a {}, a {} profile is expected", file.string(),
                            *named == Body::rail ? "rail" : "wheel", body == Body::rail ? "rail" : "wheel"),
                where, "exchange the files");
}

}  // namespace

ProfileFormat profile_format(const std::filesystem::path& file) {
  const std::string extension = profiles::lower(file.extension().string());
  if (extension == ".prr" || extension == ".prw") return ProfileFormat::simpack;
  if (extension == ".ban" || extension == ".whl") return ProfileFormat::miniprof;
  return ProfileFormat::two_column;
}

Profile parse_profile(std::string_view text, const std::string& file, ProfileFormat format, Body body,
                      const ProfileOptions& options) {
  check_options(options, file);
  switch (format) {
    case ProfileFormat::simpack:
      return simpack_profile(text, file, body, options);
    case ProfileFormat::miniprof:
      return column_profile(profiles::parse_miniprof(text, file), body, options);
    case ProfileFormat::two_column:
      break;
  }
  return column_profile(profiles::parse_two_column(text, file), body, options);
}

std::optional<bool> looks_upside_down(const std::filesystem::path& file, Body body, const ProfileOptions& options,
                                      const SourcePosition& referenced_from) {
  check_file(file, body, referenced_from);
  check_options(options, file.string());
  const ProfileFormat format = profile_format(file);
  if (format == ProfileFormat::simpack) return std::nullopt;
  const std::string text = profiles::read_text(file, "profile", referenced_from);
  profiles::ColumnContent content = format == ProfileFormat::miniprof ? profiles::parse_miniprof(text, file.string())
                                                                      : profiles::parse_two_column(text, file.string());
  return profiles::z_points_up(column_points(std::move(content), options), body);
}

Profile read_profile(const std::filesystem::path& file, Body body, const ProfileOptions& options,
                     const SourcePosition& referenced_from) {
  check_file(file, body, referenced_from);
  return parse_profile(profiles::read_text(file, "profile", referenced_from), file.string(), profile_format(file), body,
                       options);
}

}  // namespace treadmark::io
