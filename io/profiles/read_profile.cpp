// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/io/profiles/read_profile.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <system_error>

#include "treadmark/analysis/measured/noise.hpp"
#include "treadmark/analysis/measured/smoothing.hpp"
#include "treadmark/core/constants.hpp"
#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/io/files/extension.hpp"
#include "treadmark/io/files/shape_extension.hpp"
#include "treadmark/io/files/text.hpp"
#include "treadmark/io/profiles/clean_points.hpp"
#include "treadmark/io/profiles/faults.hpp"
#include "treadmark/io/profiles/parse_points.hpp"
#include "treadmark/model/shape/body_name.hpp"

namespace treadmark::io {
namespace {

using profiles::RawPoints;

constexpr double kNearDistance_mm = 1e-4;
constexpr double kSmallestScale = 1e-6;
constexpr double kSmallestZigzagThreshold = 0.7853981633974483;  // 45 degrees
constexpr double kShortest_mm = 5.0;
constexpr double kLongest_mm = 500.0;
constexpr double kSameScale = 1e-3;

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

void scale_to_metres(measured::SectionPoints& section) {
  for (double& y : section.y) y *= kMillimetre;
  for (double& z : section.z) z *= kMillimetre;
}

void check_count(const RawPoints& points) {
  if (points.size() < 2)
    throw Error(ErrorKind::input_data, fmt::format("a profile needs at least 2 points, there are {}", points.size()),
                {points.file, 0, 0}, "is the file truncated or its extension wrong?");
}

void filter(RawPoints& points, double near_distance, const ProfileOptions& options, std::vector<std::string>& notes) {
  check_count(points);
  const std::size_t count = points.size();
  profiles::remove_near_points(points, near_distance);
  const std::size_t apart = points.size();
  if (apart < count) notes.push_back(fmt::format("{} points were removed that repeat the one before", count - apart));
  profiles::remove_zigzags(points, std::max(kSmallestZigzagThreshold, options.zigzag_threshold));
  if (points.size() < apart)
    notes.push_back(fmt::format("{} pairs of points that zigzag became one point each", apart - points.size()));
  const auto removed = static_cast<double>(count - points.size());
  if (removed > options.max_omit * static_cast<double>(count))
    throw Error(ErrorKind::input_data,
                fmt::format("cleaning removed {} of {} points as too near or zig-zag, more than a share of {:g}",
                            count - points.size(), count, options.max_omit),
                {points.file, 0, 0}, "check the points and the unit of length, or allow a larger share");
}

double extent_of(const std::vector<double>& values) {
  const auto [least, most] = ranges::minmax(values);
  return most - least;
}

/// What to set where the file states a unit that is not converted; empty where it does not, or something is set.
std::string advice_on_unit(const ProfileSource& source, double asked_scale) {
  if (!source.unknown_unit || !source.unknown_unit->of_length || asked_scale != 1.0) return {};
  const points::UnknownUnit& unit = *source.unknown_unit;
  return fmt::format("the file says that its unit is {}, which is not converted: set scale_to_mm{}",
                     profiles::printable(unit.word),
                     unit.millimetres > 0.0 ? fmt::format(" = {:g}", unit.millimetres) : " to the mm in one of it");
}

void check_length(const RawPoints& points, Body body, double asked_scale, const ProfileSource& source) {
  const double length = profiles::total_length(points);
  if (length >= kShortest_mm && length <= kLongest_mm) return;
  const auto plausible = [](double l) { return l >= kShortest_mm && l <= kLongest_mm; };
  const double across = std::hypot(extent_of(points.y), extent_of(points.z));
  if (length > kLongest_mm && plausible(across))
    throw Error(
        ErrorKind::input_data,
        fmt::format("the points do not lie in order: the way from one to the next is {:.4g} mm long in all, over "
                    "{:.4g} mm",
                    length, across),
        {points.file, 0, 0}, "sort them along the profile; are there several profiles?");
  std::string advice = "check the points and the scale, which leads to mm";
  if (plausible(1e3 * length)) advice = "is the file in metres? use a scale of 1000";
  if (plausible(25.4 * length) && !plausible(1e3 * length)) advice = "is the file in inches? use a scale of 25.4";
  if (plausible(1e-3 * length))
    advice = asked_scale == 1.0 ? "is the file in micrometres? use a scale of 0.001"
                                : "is a file in mm scaled like one in metres? use a scale of 1";
  if (std::string unit = advice_on_unit(source, asked_scale); !unit.empty()) advice = std::move(unit);
  throw Error(ErrorKind::input_data,
              fmt::format("the {} profile is {:.4g} mm long, outside {:g} to {:g} mm", body_name(body), length,
                          kShortest_mm, kLongest_mm),
              {points.file, 0, 0}, advice);
}

void check_direction(const RawPoints& points, Body body) {
  const double change = points.y.back() - points.y.front();
  if (body == Body::rail ? change > 0.0 : change < 0.0) return;
  if (extent_of(points.y) == 0.0)
    throw Error(ErrorKind::input_data, "y is the same in all points", {points.file, 0, 0},
                "which columns are y and z? name them in a line before");
  throw Error(ErrorKind::input_data,
              body == Body::rail ? "the points of a rail profile must run with increasing y"
                                 : "the points of a wheel profile must run with decreasing y",
              {points.file, 0, 0},
              profiles::seem_exchanged(points.y, points.z)
                  ? "are y and z exchanged? exchange the columns, or name them in a line before"
                  : "check the mirror options and the order of the points");
}

void check_crossing(const RawPoints& points) {
  std::size_t first = 0, second = 0;
  if (!profiles::crosses_itself(points, first, second)) return;
  throw Error(ErrorKind::input_data,
              fmt::format("the profile crosses itself at y = {:.4g} mm, between the points of lines {} and {}",
                          kMilli * points.y[first], points.line[first], points.line[second]),
              {points.file, points.line[second], 0}, "repair the points");
}

RawPoints picked(const RawPoints& points, const std::vector<std::size_t>& which) {
  RawPoints out;
  out.file = points.file;
  for (const std::size_t i : which) out.add(points.y[i], points.z[i], points.line[i]);
  profiles::remove_near_points(out, kNearDistance_mm);  // where a closed outline met itself
  return out;
}

/// Of the outline of a rail leaves the head alone, and returns all of it; nothing of other sections.
std::optional<RawPoints> keep_head(RawPoints& points, Body body, std::vector<std::string>& notes) {
  measured::SectionPoints section{body, points.y, points.z};
  scale_to_metres(section);
  const measured::RailOutline outline = measured::outline_of_rail(section);
  if (outline.head.empty() || outline.head.size() == points.size()) return std::nullopt;
  notes.push_back(fmt::format("the outline of a whole rail: contact takes its head, {} of {} points",
                              outline.head.size(), points.size()));
  RawPoints whole = picked(points, outline.whole);
  points = picked(points, outline.head);
  return whole;
}

measured::Words words_of(const ProfileOptions& options, const RawPoints& points, Body body, bool radii) {
  using measured::Turn;
  const auto turn = [](int key) { return key > 0 ? Turn::yes : key < 0 ? Turn::no : Turn::decide; };
  measured::Words words{turn(options.mirror_y), turn(options.mirror_z),
                        options.placement == ProfileOptions::Placement::automatic && !options.back_told, radii};
  if (options.placement == ProfileOptions::Placement::reference) {
    if (options.mirror_z == 0) words.mirror_z = profiles::z_points_up(points, body) ? Turn::yes : Turn::no;
    if (options.mirror_y == 0) words.mirror_y = Turn::no;
  }
  return words;
}

/// From points in mm to a profile in metres, not smoothed. own: what the file itself asks for has been done.
SourcedProfile finish(RawPoints&& points, Body body, bool inverted, bool radii, const ProfileOptions& options,
                      ProfileSource&& source) {
  check_count(points);
  std::optional<RawPoints> whole = keep_head(points, body, source.notes);
  check_length(points, body, options.scale, source);
  profiles::refuse_faults(points);
  measured::SectionPoints section{body, std::move(points.y), std::move(points.z)};
  scale_to_metres(section);
  measured::Understanding& seen = source.understood;
  points.y = section.y, points.z = section.z;  // Placement::reference judges them whatever their unit is
  seen = measured::understand(section, words_of(options, points, body, radii));
  source.mirrored_y = source.mirrored_y != seen.mirrored_y;
  source.mirrored_z = source.mirrored_z != seen.mirrored_z;
  source.notes.insert(source.notes.end(), seen.notes.begin(), seen.notes.end());
  points.y = std::move(section.y), points.z = std::move(section.z);
  source.reversed = inverted || profiles::order_is_wrong(points, body);
  if (source.reversed) reverse(points);
  check_direction(points, body);
  check_crossing(points);
  SourcedProfile out;
  out.profile.body = body;
  out.profile.y = std::move(points.y);
  out.profile.z = std::move(points.z);
  out.profile.name = points.file;
  out.profile.smoothing = options.smoothing;
  if (whole) {
    // turned as its head was, which shows more
    if (source.reversed) reverse(*whole);
    Profile& outline = out.whole.emplace();
    outline.body = body;
    outline.name = points.file;
    for (const double y : whole->y) outline.y.push_back(kMillimetre * (seen.mirrored_y ? -y : y));
    for (const double z : whole->z) outline.z.push_back(kMillimetre * (seen.mirrored_z ? -z : z));
  }
  source.lines = std::move(points.line);
  out.source = std::move(source);
  return out;
}

SourcedProfile simpack_profile(std::string_view text, const std::string& file, Body body,
                               const ProfileOptions& options) {
  profiles::SimpackContent content = profiles::parse_simpack(text, file, body);
  RawPoints& points = content.points;
  ProfileSource source;
  source.kind = "Simpack";
  source.points_in_file = points.size();
  profiles::remove_drop_outs(points, source.notes);
  filter(points, content.near_distance, options, source.notes);
  shift(points.y, content.shift_y);
  shift(points.z, content.shift_z);
  profiles::delete_outside_y(points, content.y_min, content.y_max);
  profiles::clip_z(points, content.z_min, content.z_max);
  source.mirrored_y = int{content.mirror_y} + options.mirror_y == 1;
  source.mirrored_z = int{content.mirror_z} + options.mirror_z == 1;
  if (source.mirrored_y) negate(points.y);
  if (source.mirrored_z) negate(points.z);
  source.scale_to_mm = options.scale * 1000.0 / content.units_per_metre;
  scale(points, source.scale_to_mm);
  const bool reference = options.placement == ProfileOptions::Placement::reference;
  ProfileOptions further = options;  // what the keys say has been done
  if (options.mirror_y != 0) further.mirror_y = -1;
  // the file has its own word for it, which only a flange is surer than
  if (options.mirror_z != 0 || reference || body == Body::rail) further.mirror_z = -1;
  SourcedProfile out = finish(std::move(points), body, content.inversion, false, further, std::move(source));
  if (reference) out.source.understood.doubts.clear();
  return out;
}

/// To mm: the scale that is asked for, else the unit that the file states.
double scale_of(const ProfileSource& source, const ProfileOptions& options) {
  if (options.scale != 1.0 || !source.unit || *source.unit == LengthUnit::millimetre) return options.scale;
  return 1e3 * metres_per(*source.unit);
}

RawPoints column_points(profiles::ColumnContent& content, const ProfileOptions& options) {
  RawPoints points = std::move(content.points);
  ProfileSource& source = content.source;
  source.points_in_file = points.size();
  source.scale_to_mm = scale_of(source, options);
  profiles::remove_drop_outs(points, source.notes);
  filter(points, kNearDistance_mm / source.scale_to_mm, options, source.notes);
  shift(points.y, content.offset_y);
  shift(points.z, content.offset_z);
  if (content.radius_factor > 0.0)
    for (double& z : points.z) z *= content.radius_factor;
  return points;
}

SourcedProfile column_profile(profiles::ColumnContent&& content, Body body, const ProfileOptions& options) {
  RawPoints points = column_points(content, options);
  ProfileSource& source = content.source;
  if (source.unit && options.scale != 1.0 &&
      std::abs(1e3 * metres_per(*source.unit) / options.scale - 1.0) > kSameScale)
    source.notes.push_back(fmt::format("the file says that its unit is {}, the scale of {:g} to mm is used instead",
                                       symbol(*source.unit), options.scale));
  if (std::string unit = advice_on_unit(source, options.scale); !unit.empty())
    source.doubts.push_back({"unit", std::move(unit)});
  else if (source.unknown_unit && options.scale == 1.0)
    source.notes.push_back(
        fmt::format("the file says that its unit is {}, which is none of length that is known: its "
                    "numbers were taken as mm",
                    profiles::printable(source.unknown_unit->word)));
  scale(points, source.scale_to_mm);
  return finish(std::move(points), body, false, content.radius_factor > 0.0, options, std::move(source));
}

/// Wheel profiles of GENSYS: y to the middle of the track, z down.
SourcedProfile gensys_profile(std::string_view text, const std::string& file, ProfileOptions options) {
  profiles::ColumnContent content = profiles::parse_plain_columns(text, file, 0);
  content.source.kind = "GENSYS, " + content.source.kind;
  for (double& y : content.points.y) y = -y;
  content.source.mirrored_y = true;
  if (options.mirror_z == 0) options.mirror_z = -1;
  return column_profile(std::move(content), Body::wheel, options);
}

void check_file(const std::filesystem::path& file, Body body, const SourcePosition& referenced_from) {
  const std::string extension = extension_of(file);
  const SourcePosition where = referenced_from.file.empty() ? SourcePosition{file.string(), 0, 0} : referenced_from;
  if (extension == ".slcs" || extension == ".slcw")
    throw Error(ErrorKind::configuration,
                fmt::format("a single profile is expected, '{}' is a set of slices", file.string()), where);
  if (extension == ".rail")
    throw Error(ErrorKind::configuration,
                fmt::format("'{}': rail profiles of GENSYS are not read, which way their y points is not published",
                            file.string()),
                where, "rename it to .txt, and set mirror_y if its y points to the middle of the track");
  if (const std::optional<Body> named = body_by_extension(file); named && *named != body)
    throw Error(ErrorKind::configuration,
                fmt::format("the extension of '{}' stands for a {}, a {} profile is expected", file.string(),
                            body_name(*named), body_name(body)),
                where, "exchange the files");
}

/// A name like 'a.mpt#2' or 'a.csv#2' for the second profile of a file.
struct NamedSection {
  std::filesystem::path file;
  int section = 0;
};

NamedSection section_of(const std::filesystem::path& file) {
  std::error_code ignored;
  if (std::filesystem::exists(file, ignored)) return {file, 0};
  constexpr std::size_t kMostDigits = 4;
  const std::string name = file.string();
  const std::size_t sign = name.rfind('#');
  if (sign == std::string::npos || sign + 1 == name.size() || name.size() - sign - 1 > kMostDigits ||
      name.find_first_not_of("0123456789", sign + 1) != std::string::npos)
    return {file, 0};
  return {name.substr(0, sign), std::stoi(name.substr(sign + 1))};
}

/// What the text is, whatever its name says.
ProfileFormat format_of(std::string_view text, ProfileFormat named) {
  if (named == ProfileFormat::simpack || profiles::begins_like_simpack(text)) return ProfileFormat::simpack;
  if (named == ProfileFormat::two_column && profiles::begins_like_miniprof(text)) return ProfileFormat::miniprof;
  return named;
}

/// Not smoothed.
SourcedProfile parse_text(std::string_view text, const std::string& file, ProfileFormat named, Body body,
                          const ProfileOptions& options, int section) {
  check_options(options, file);
  const std::string converted = profiles::from_utf16(text);
  if (!converted.empty()) text = converted;
  const ProfileFormat format = format_of(text, named);
  if (section > 0 && format != ProfileFormat::miniprof && format != ProfileFormat::two_column)
    throw Error(ErrorKind::configuration, "only files of MiniProf and of columns hold several profiles", {file, 0, 0},
                "leave out the number behind '#'");
  switch (format) {
    case ProfileFormat::simpack:
      return simpack_profile(text, file, body, options);
    case ProfileFormat::miniprof:
      return column_profile(profiles::parse_miniprof(text, file, body, section), body, options);
    case ProfileFormat::gensys:
      return gensys_profile(text, file, options);
    case ProfileFormat::two_column:
      break;
  }
  return column_profile(profiles::parse_plain_columns(text, file, section), body, options);
}

Profile smoothed(Profile&& profile) {
  if (profile.smoothing.method != SmoothingOptions::Method::by_noise) return std::move(profile);
  return measured::smoothed_by_noise(std::move(profile));
}

SourcedProfile unsmoothed(const std::filesystem::path& file, Body body, const ProfileOptions& options,
                          const SourcePosition& referenced_from) {
  const NamedSection named = section_of(file);
  check_file(named.file, body, referenced_from);
  return parse_text(profiles::read_text(named.file, "profile", referenced_from), named.file.string(),
                    profile_format(file), body, options, named.section);
}

}  // namespace

ProfileFormat profile_format(const std::filesystem::path& file) {
  const std::string extension = extension_of(section_of(file).file);
  if (extension == ".prr" || extension == ".prw") return ProfileFormat::simpack;
  if (extension == ".ban" || extension == ".whl" || extension == ".mpt") return ProfileFormat::miniprof;
  if (extension == ".wheel") return ProfileFormat::gensys;
  return ProfileFormat::two_column;
}

std::filesystem::path profile_file(const std::filesystem::path& name) { return section_of(name).file; }

std::optional<Body> profile_body(const std::filesystem::path& file) {
  const std::filesystem::path named = section_of(file).file;
  return can_hold(named, kProfileFile) ? body_by_extension(named) : std::nullopt;
}

Profile parse_profile(std::string_view text, const std::string& file, ProfileFormat format, Body body,
                      const ProfileOptions& options) {
  return smoothed(parse_text(text, file, format, body, options, 0).profile);
}

std::optional<bool> looks_upside_down(const std::filesystem::path& file, Body body, const ProfileOptions& options,
                                      const SourcePosition& referenced_from) {
  const NamedSection named = section_of(file);
  check_file(named.file, body, referenced_from);
  check_options(options, file.string());
  const std::string bytes = profiles::read_text(named.file, "profile", referenced_from);
  const std::string converted = profiles::from_utf16(bytes);
  const std::string& text = converted.empty() ? bytes : converted;
  const ProfileFormat format = format_of(text, profile_format(file));
  if (format == ProfileFormat::simpack || format == ProfileFormat::gensys) return std::nullopt;
  profiles::ColumnContent content = format == ProfileFormat::miniprof
                                        ? profiles::parse_miniprof(text, named.file.string(), body, named.section)
                                        : profiles::parse_plain_columns(text, named.file.string(), named.section);
  RawPoints points = column_points(content, options);
  if (options.placement == ProfileOptions::Placement::reference) return profiles::z_points_up(points, body);
  scale(points, kMillimetre * content.source.scale_to_mm);
  measured::SectionPoints section{body, std::move(points.y), std::move(points.z)};
  return measured::understand(section, {measured::Turn::no, measured::Turn::decide, false, false}).mirrored_z;
}

SourcedProfile read_sourced_profile(const std::filesystem::path& file, Body body, const ProfileOptions& options,
                                    const SourcePosition& referenced_from) {
  SourcedProfile out = unsmoothed(file, body, options, referenced_from);
  out.source.lump = measured::highest_lump(out.profile, measured::profile_noise(out.profile).across);
  out.profile = smoothed(std::move(out.profile));
  return out;
}

Profile read_profile(const std::filesystem::path& file, Body body, const ProfileOptions& options,
                     const SourcePosition& referenced_from) {
  return smoothed(unsmoothed(file, body, options, referenced_from).profile);
}

}  // namespace treadmark::io
