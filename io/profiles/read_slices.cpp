// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/io/profiles/read_slices.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "treadmark/core/parallel.hpp"
#include "treadmark/io/files/sha256.hpp"
#include "treadmark/io/files/shape_extension.hpp"
#include "treadmark/io/files/text.hpp"
#include "treadmark/io/profiles/read_profile.hpp"
#include "treadmark/io/profiles/record_reader.hpp"
#include "treadmark/io/profiles/slice_file.hpp"
#include "treadmark/io/profiles/slice_sum.hpp"
#include "treadmark/model/shape/body_name.hpp"

namespace treadmark::io {

namespace slice_lists {

struct SliceEntry {
  double value = 0.0;  ///< as written, in the user's unit
  double u = 0.0;      ///< mm or rad
  std::string name;
  SourcePosition where_value, where_name, where_features;
};

/// What the slices file itself says: a set without profiles, and where they are.
struct SliceList {
  SliceSet set;
  std::vector<SliceEntry> entries;
};

/// A slices file whose slices are not read yet.
struct OpenList {
  std::string text;
  std::filesystem::path folder;
  SliceList list;
};

}  // namespace slice_lists

namespace {

using namespace slice_lists;

using profiles::RecordReader;

constexpr int kFewestSlices = 4;
constexpr int kMostSlices = 1'000'000;
constexpr int kMostFeatures = 10'000;
constexpr std::size_t kMostPointsOfAllSlices = 50'000'000;
constexpr double kSmallestStep = 1e-3;     // between slice values, in the user's unit
constexpr double kAngleTolerance = 1e-4;   // rad: angles are often written with four decimals
constexpr double kLengthTolerance = 1e-6;  // m

struct Header {
  double offset = 0.0, scale = 1.0;
  int slices = 0, features = 0, kinks = 0, accelerations = 0;
  bool approximate = false;
};

Header read_header(RecordReader& in) {
  Header h;
  h.offset = in.number("OFFSET");
  h.scale = in.number("SCALE");
  if (!(h.scale > 0.0)) in.fail("SCALE must be positive");
  in.end_record();
  h.slices = in.integer("NSLC");
  if (h.slices < kFewestSlices || h.slices > kMostSlices)
    in.fail(fmt::format("the number of slices must be {} to {}, this is {}", kFewestSlices, kMostSlices, h.slices));
  in.end_record();
  const auto count = [&](const char* what) {
    const int n = in.integer(what);
    if (n < 0 || n > kMostFeatures) in.fail(fmt::format("{} must be 0 to {}, this is {}", what, kMostFeatures, n));
    return n;
  };
  h.features = count("NFEAT");
  h.kinks = count("NKINK");
  h.accelerations = count("NACCEL");
  in.end_record();
  const int method = in.integer("INTPOL");
  if (method != 1 && method != 2) in.fail("INTPOL must be 1 (interpolate) or 2 (approximate)");
  h.approximate = method == 2;
  in.end_record();
  return h;
}

std::vector<SliceEntry> read_entries(RecordReader& in, const Header& h) {
  std::vector<SliceEntry> entries;
  for (int i = 1; i <= h.slices; ++i) {
    SliceEntry entry;
    entry.value = in.number(fmt::format("slice {} of {}", i, h.slices));
    entry.where_value = in.position();
    entry.u = h.scale * (h.offset + entry.value);
    if (!std::isfinite(entry.u)) in.fail("the position of the slice is out of range");
    if (!entries.empty() && !(entry.value > entries.back().value + kSmallestStep))
      in.fail(fmt::format("slice {} at {:g} must lie more than {:g} beyond the one before, which is at {:g}", i,
                          entry.value, kSmallestStep, entries.back().value),
              "put the slices in increasing order");
    if (!entries.empty() && !(entry.u > entries.back().u)) in.fail("the slice cannot be told from the one before");
    entry.name = in.name(fmt::format("the file name of slice {}", i));
    entry.where_name = in.position();
    in.end_record();
    entries.push_back(std::move(entry));
  }
  return entries;
}

void check_angles(const std::vector<SliceEntry>& entries) {
  constexpr double pi = std::numbers::pi;
  for (const SliceEntry& entry : entries)
    if (std::abs(entry.u) > 1.5 * pi + kAngleTolerance)
      throw Error(ErrorKind::input_data, fmt::format("the angle {:g} rad lies outside -1.5 pi to 1.5 pi", entry.u),
                  entry.where_value, "wheel slices are placed in radians; SCALE converts other units");
  const double first = entries.front().u, last = entries.back().u;
  const bool inside = first >= -pi - kAngleTolerance && last <= pi + kAngleTolerance;
  const bool around = first <= -pi + kAngleTolerance && last >= pi - kAngleTolerance;
  if (!inside && !around)
    throw Error(
        ErrorKind::input_data,
        fmt::format("the angles run from {:g} to {:g} rad: they must lie in -pi to pi or contain it", first, last),
        (last > pi + kAngleTolerance ? entries.back() : entries.front()).where_value,
        "shift the angles with OFFSET or leave out slices");
}

/// Part numbers, counted from 1: each stands for the feature at the end of that part.
std::vector<int> read_feature_numbers(RecordReader& in, int count, int features, const char* what) {
  std::vector<int> numbers;
  for (int i = 1; i <= count; ++i) {
    const int number = in.integer(fmt::format("{} {} of {}", what, i, count));
    if (number < 1 || number > features - 2)
      in.fail(fmt::format("a {} must be a feature from 1 to NFEAT-2 = {}, this is {}", what, features - 2, number));
    numbers.push_back(number);
  }
  if (count > 0) in.end_record();
  std::sort(numbers.begin(), numbers.end());
  numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
  return numbers;
}

std::vector<std::vector<double>> read_features(RecordReader& in, const Header& h, std::vector<SliceEntry>& entries) {
  std::vector<std::vector<double>> features;
  if (h.features <= 1) return features;
  for (SliceEntry& entry : entries) {
    const auto number = static_cast<int>(features.size()) + 1;
    const double value = in.number(fmt::format("the feature line {} of {}", number, h.slices));
    entry.where_features = in.position();
    if (std::abs(value - entry.value) > kSmallestStep)
      in.fail(fmt::format("feature line {} is for {:g}, slice {} is at {:g}", number, value, number, entry.value),
              "feature lines repeat the slice positions in the same order");
    std::vector<double> row;
    double previous = -1.0;
    bool ended = false;
    for (int f = 1; f <= h.features; ++f) {
      const double s_mm = in.number(fmt::format("feature {} of {} of slice {}", f, h.features, number));
      if (s_mm < 0.0) {
        ended = previous >= 0.0;
        row.push_back(std::numeric_limits<double>::quiet_NaN());
        continue;
      }
      if (ended) in.fail(fmt::format("feature {} follows a missing one", f), "only leading or trailing ones may miss");
      if (s_mm <= previous)
        in.fail(fmt::format("feature {} at {:g} mm does not lie beyond the one before at {:g} mm", f, s_mm, previous));
      previous = s_mm;
      row.push_back(1e-3 * s_mm);
    }
    in.end_record();
    if (std::count_if(row.begin(), row.end(), [](double s) { return !std::isnan(s); }) < 2)
      throw Error(ErrorKind::input_data, fmt::format("slice {} has fewer than two features", number),
                  entry.where_features);
    features.push_back(std::move(row));
  }
  return features;
}

double length_of(const Profile& profile) {
  double length = 0.0;
  for (std::size_t i = 1; i < profile.y.size(); ++i)
    length += std::hypot(profile.y[i] - profile.y[i - 1], profile.z[i] - profile.z[i - 1]);
  return length;
}

void fit_to_profile(std::vector<double>& row, const Profile& profile, const SourcePosition& where) {
  const double length = length_of(profile);
  for (std::size_t f = 0; f < row.size(); ++f) {
    if (!(row[f] > length)) continue;
    const bool last = f + 1 == row.size();
    const bool room = f == 0 || !(row[f - 1] >= length);
    if ((!last && row[f] > length + kLengthTolerance) || !room)
      throw Error(ErrorKind::input_data,
                  fmt::format("feature {} at {:g} mm has no place on the profile '{}', which is {:g} mm long", f + 1,
                              1e3 * row[f], profile.name, 1e3 * length),
                  where, "features are measured in mm from the first point of the slice");
    row[f] = length;
  }
}

SliceList read_list(std::string_view text, const std::string& file, Body body) {
  RecordReader in(text, file);
  const Header header = read_header(in);
  SliceList out;
  out.entries = read_entries(in, header);
  if (body == Body::wheel) check_angles(out.entries);
  out.set.kinks = read_feature_numbers(in, header.kinks, header.features, "kink");
  // accelerations of the lateral parametrisation change no surface
  read_feature_numbers(in, header.accelerations, header.features, "acceleration");
  out.set.body = body;
  out.set.name = file;
  out.set.approximate_u = header.approximate;
  out.set.features = read_features(in, header, out.entries);
  if (in.more()) in.fail("there are data after the last record", "do NSLC and NFEAT count all of them?");
  return out;
}

/// Slices of two writings would be a surface that never was.
void check_sum(std::string_view text, const SliceList& list, const std::filesystem::path& folder) {
  const std::size_t found = text.find(kSumOfSlices);
  if (found == std::string_view::npos || (found > 0 && text[found - 1] != '\n')) return;
  std::string_view expected = text.substr(found + kSumOfSlices.size());
  const std::string_view behind = expected.substr(std::min(expected.size(), expected.find('\n') + 1));
  expected = expected.substr(0, expected.find_first_of("\r\n"));
  std::string sums;
  for (const SliceEntry& entry : list.entries) {
    std::filesystem::path slice = folder / profiles::portable_path(entry.name);
    std::error_code code;
    if (!std::filesystem::is_regular_file(slice, code)) return;  // told by name where it is read
    sums += sha256_file(slice) + '\n';
  }
  if (sha256_hex(sums + std::string(behind)) == expected || sha256_hex(sums) == expected) return;
  const auto line = static_cast<int>(std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(found), '\n'));
  throw Error(ErrorKind::input_data, "the slices are not those that this file was written with",
              {list.set.name, line + 1, 1}, "write them again; if they were changed on purpose, remove this line");
}

/// [m] along a rail, [rad] about a wheel
double place_of(const SliceEntry& entry, Body body) { return body == Body::rail ? 1e-3 * entry.u : entry.u; }

SliceSet load_profiles(SliceList&& list, Body body, const SliceLoader& load) {
  SliceSet set = std::move(list.set);
  std::size_t points = 0;
  for (std::size_t i = 0; i < list.entries.size(); ++i) {
    const SliceEntry& entry = list.entries[i];
    set.u.push_back(place_of(entry, body));
    set.profiles.push_back(load(entry.name, entry.where_name));
    points += set.profiles.back().y.size();
    if (points > kMostPointsOfAllSlices)
      throw Error(ErrorKind::input_data, "the slices have more than 50 million points together", entry.where_name,
                  "thin out the points");
    if (!set.features.empty()) fit_to_profile(set.features[i], set.profiles.back(), entry.where_features);
  }
  return set;
}

}  // namespace

bool is_slices_file(const std::filesystem::path& file) { return can_hold(file, kSlicesFile); }

SliceSet parse_slices(std::string_view text, const std::string& file, Body body, const SliceLoader& load) {
  return load_profiles(read_list(text, file, body), body, load);
}

namespace {

OpenList open_list(const std::filesystem::path& file, Body body, const SourcePosition& referenced_from) {
  if (is_slices_file(file) && body_by_extension(file) != body)
    throw Error(ErrorKind::configuration,
                fmt::format("the extension of '{}' stands for {} slices, a {} is expected", file.string(),
                            body == Body::rail ? "wheel" : "rail", body_name(body)),
                referenced_from.file.empty() ? SourcePosition{file.string(), 0, 0} : referenced_from,
                "exchange the files");
  OpenList out;
  out.text = profiles::read_text(file, "slices", referenced_from);
  out.folder = profiles::portable_path(file.string()).parent_path();
  out.list = read_list(out.text, file.string(), body);
  return out;
}

/// As the options say, with what all slices together decide: their check sum, and which way up they are.
ProfileOptions options_of_all(const OpenList& from, Body body, const ProfileOptions& options) {
  check_sum(from.text, from.list, from.folder);
  ProfileOptions how = options;
  if (how.smoothing.method == SmoothingOptions::Method::by_noise)  // slices have been fitted
    how.smoothing.method = SmoothingOptions::Method::spline;
  if (options.mirror_z != 0) return how;
  // all slices the same way up: damage can make some of them look otherwise
  std::size_t up = 0, down = 0, own = 0;
  for (const SliceEntry& entry : from.list.entries) {
    const auto turned =
        looks_upside_down(from.folder / profiles::portable_path(entry.name), body, options, entry.where_name);
    ++(!turned ? own : *turned ? up : down);
  }
  how.mirror_z = own > 0 ? 0 : up > down ? 1 : -1;
  return how;
}

}  // namespace

SliceSet read_slices(const std::filesystem::path& file, Body body, const ProfileOptions& options,
                     const SourcePosition& referenced_from) {
  OpenList from = open_list(file, body, referenced_from);
  const ProfileOptions how = options_of_all(from, body, options);
  return load_profiles(std::move(from.list), body, [&](const std::string& name, const SourcePosition& where) {
    return read_profile(from.folder / profiles::portable_path(name), body, how, where);
  });
}

struct SliceFile::Content {
  OpenList from;
  ProfileOptions how;

  Profile profile(std::size_t i) const {
    const SliceEntry& entry = from.list.entries[i];
    return read_profile(from.folder / profiles::portable_path(entry.name), Body::rail, how, entry.where_name);
  }
};

SliceFile::SliceFile(const std::filesystem::path& file, const ProfileOptions& options,
                     const SourcePosition& referenced_from)
    : content_(std::make_unique<Content>()) {
  content_->from = open_list(file, Body::rail, referenced_from);
  content_->how = options;
}

SliceFile::~SliceFile() = default;

std::vector<double> SliceFile::u() const {
  std::vector<double> out;
  for (const SliceEntry& entry : content_->from.list.entries) out.push_back(place_of(entry, Body::rail));
  return out;
}

bool SliceFile::has_features() const { return !content_->from.list.set.features.empty(); }

void SliceFile::check() { content_->how = options_of_all(content_->from, Body::rail, content_->how); }

SliceSet SliceFile::read(std::size_t from, std::size_t to) const {
  SliceSet out = content_->from.list.set;
  out.u.resize(to - from);
  out.profiles.resize(to - from);
  parallel_for(to - from, [&](std::size_t k) {
    out.u[k] = place_of(content_->from.list.entries[from + k], Body::rail);
    out.profiles[k] = content_->profile(from + k);
  });
  return out;
}

}  // namespace treadmark::io
