// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors

#include "treadmark/backends/offset/file.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <numbers>
#include <optional>
#include <sstream>
#include <string_view>
#include <vector>

#include "treadmark/backends/offset/make.hpp"
#include "treadmark/backends/offset/nano_file.hpp"
#include "treadmark/backends/offset/sheet_grid.hpp"
#include "treadmark/backends/offset/vdb_file.hpp"
#include "treadmark/core/cancellation.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/core/missing_file.hpp"
#include "treadmark/core/number_text.hpp"
#include "treadmark/core/output_file.hpp"
#include "treadmark/core/to_whole.hpp"
#include "treadmark/model/shape/surface_doubts.hpp"
#include "treadmark/model/shape/surface_errors.hpp"

namespace treadmark::offset {

namespace {

namespace fs = std::filesystem;

/// What follows the VDB data, ignored by other programs: a mark, the number of bytes before it and their sum, by which
/// damage is known. It guards against nobody who means harm.
constexpr std::array<char, 8> kMark = {'T', 'M', 'K', 'S', 'U', 'M', '0', '1'};
constexpr std::size_t kTrailer = 24;
constexpr std::array<char, 8> kVdbMagic = {' ', 'B', 'D', 'V', 0, 0, 0, 0};

/// In a VDB file a random number as text follows its mark, three numbers for versions and a flag, so that no two files
/// are alike. Here it follows from the content: equal offsets give equal files.
void name_by_content(std::string& bytes) {
  constexpr std::size_t kAt = 21, kLength = 36;
  if (bytes.size() < kAt + kLength) return;
  bytes.replace(kAt, kLength, kLength, '0');
  const std::uint64_t first = sum_of(bytes.data(), bytes.size());
  const std::uint64_t second = sum_of(reinterpret_cast<const char*>(&first), sizeof(first));
  const std::string digits = fmt::format("{:016x}{:016x}", first, second);
  bytes.replace(kAt, kLength,
                fmt::format("{}-{}-{}-{}-{}", digits.substr(0, 8), digits.substr(8, 4), digits.substr(12, 4),
                            digits.substr(16, 4), digits.substr(20)));
}

void append_trailer(std::string& bytes) {
  const std::uint64_t size = bytes.size(), sum = sum_of(bytes.data(), bytes.size());
  bytes.append(kMark.data(), kMark.size());
  bytes.append(reinterpret_cast<const char*>(&size), sizeof(size));
  bytes.append(reinterpret_cast<const char*>(&sum), sizeof(sum));
}

/// The transform may have been changed by another program since the entry 'frame' was written. Returns what was
/// changed, in words.
std::string take_transform(const SheetFile& sheet, SheetFrame& f, const fs::path& file) {
  const auto refuse = [&](const char* why, const char* advice) {
    throw Error(ErrorKind::input_data, why, {file.string()}, advice);
  };
  if (!(sheet.du > 0.0) || !(sheet.dy > 0.0) || !std::isfinite(sheet.du + sheet.dy + sheet.u0 + sheet.y0))
    refuse("the steps of the offsets must be positive", "write the file again");
  const auto near = [](double a, double b) { return std::fabs(a - b) <= 1e-12 * (std::fabs(a) + std::fabs(b)); };
  if (near(f.u0, sheet.u0) && near(f.y0, sheet.y0) && near(f.du, sheet.du) && near(f.dy, sheet.dy)) return {};
  constexpr double kMostScaled = 3.0;
  const double along = sheet.du / f.du, across = sheet.dy / f.dy;
  if (std::max({along, across, 1.0 / along, 1.0 / across}) > kMostScaled)
    refuse("the transform of the offsets in the VDB file was scaled by more than 3 since they were written",
           "their places are in metres or radians: undo the change of units");
  if (f.turn > 0 && std::fabs(along - 1.0) > 1e-9)
    refuse("the transform of the offsets in the VDB file was scaled along the wheel, which they no longer go round",
           "scale it along y only");
  const std::string moved = f.body == Body::wheel ? fmt::format("{:.6g} rad", sheet.u0 - f.u0)
                                                  : fmt::format("{:.6g} mm", 1e3 * (sheet.u0 - f.u0));
  std::string remark = fmt::format(
      "the transform of the offsets in {} was changed since they were written: moved by "
      "{} along and {:.6g} mm across, steps times {:.6g} and {:.6g}. ",
      file.filename().string(), moved, 1e3 * (sheet.y0 - f.y0), along, across);
  f.u0 = sheet.u0, f.y0 = sheet.y0, f.du = sheet.du, f.dy = sheet.dy;
  return remark;
}

/// In place of OpenVDB's, by the end of its name.
bool is_nano(const fs::path& file) {
  std::string end = file.extension().string();
  for (char& c : end)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return end == ".nvdb";
}

}  // namespace

std::uint64_t sum_of(const char* data, std::size_t size, std::uint64_t before) {
  for (std::size_t i = 0; i < size; ++i) before = (before ^ static_cast<unsigned char>(data[i])) * 1099511628211ull;
  return before;
}

VdbFile open_vdb(const fs::path& file, const VdbWords& words) {
  require_file(file, "VDB file", ErrorKind::input_data);
  std::error_code problem;
  if (!fs::is_regular_file(file, problem))
    throw Error(ErrorKind::input_data, "the VDB file is not a regular file", {file.string()});
  std::ifstream in(file, std::ios::binary | std::ios::ate);
  const std::streamoff end = in ? static_cast<std::streamoff>(in.tellg()) : -1;
  const auto refuse = [&](const char* why, const char* advice = "") {
    throw Error(ErrorKind::input_data, why, {file.string()}, advice);
  };
  if (end < 0) refuse("the VDB file cannot be read");
  const auto size = static_cast<std::uint64_t>(end);
  const auto take = [&](std::uint64_t at, char* to, std::uint64_t count) {
    if (!in.seekg(static_cast<std::streamoff>(at)).read(to, static_cast<std::streamsize>(count)))
      refuse("the VDB file cannot be read");
  };
  if (size == 0) refuse("the VDB file is empty", "write it again");
  std::array<char, 8> magic{}, mark{};
  if (size >= magic.size()) take(0, magic.data(), magic.size());
  if (magic != kVdbMagic) refuse("this is not a VDB file", "was it written by OpenVDB, or by treadmark convert?");
  if (size < kVdbMagic.size() + kTrailer) return {start_openvdb(file.string()), file, size, words};
  const std::uint64_t content = size - kTrailer;
  take(content, mark.data(), mark.size());
  if (mark != kMark) return {start_openvdb(file.string()), file, size, words};  // OpenVDB wrote it
  std::array<std::uint64_t, 2> told{};                                          // number of bytes, sum
  take(content + mark.size(), reinterpret_cast<char*>(told.data()), sizeof(told));
  std::vector<char> part(std::size_t{1} << 20);
  std::uint64_t sum = sum_of(nullptr, 0);
  for (std::uint64_t at = 0; at < content; at += part.size()) {
    check_cancelled();
    const std::uint64_t count = std::min<std::uint64_t>(part.size(), content - at);
    take(at, part.data(), count);
    sum = sum_of(part.data(), count, sum);
  }
  if (told[0] != content || told[1] != sum)
    refuse("the VDB file is damaged: its check sum does not fit", "write or copy it again");
  return {start_openvdb(file.string()), file, content, words};
}

void write_vdb(const fs::path& file, const OffsetFile& content) {
  if (!content.offsets) throw Error(ErrorKind::configuration, "there are no offsets to write");
  const SheetFrame& f = content.offsets->frame;
  SheetFile sheet;
  sheet.u0 = f.u0, sheet.y0 = f.y0, sheet.du = f.du, sheet.dy = f.dy;
  sheet.metadata = to_metadata(*content.offsets, content.base);
  if (!content.notes.empty()) sheet.metadata["notes"] = content.notes;
  if (is_nano(file)) return write_file(file, nano_bytes(*content.offsets, sheet.metadata));
  std::string bytes = sheet_bytes(content.offsets->grid, sheet);
  name_by_content(bytes);
  append_trailer(bytes);
  write_file(file, bytes);
}

OffsetFile read_vdb(const fs::path& file) {
  if (is_nano(file)) return from_sheet(read_nano(file), file);
  static constexpr VdbWords kWords{"the offsets", "offsets come from treadmark convert or import, as .vdb"};
  return from_sheet(read_sheet(open_vdb(file, kWords)), file);
}

OffsetFile from_sheet(SheetFile sheet, const fs::path& file) {
  constexpr float kAbsurd = 1.0f;  // [m]
  const auto offsets = std::make_shared<SparseOffsets>();
  OffsetFile result;
  from_metadata(sheet.metadata, *offsets, result.base, file.string());
  SheetFrame& f = offsets->frame;
  result.remark = take_transform(sheet, f, file);
  const auto check = [&](const SheetGrid& grid, float most) {
    for (const SheetGrid::Entry& b : grid.blocks()) {
      for (int k = 0; k < kBlockI * kBlockJ; ++k)
        if (!(std::fabs(b.values[k]) <= most))
          throw Error(ErrorKind::input_data, "an offset in the file is no number, or greater than a metre",
                      {file.string()}, "offsets are in metres");
      if (f.turn > 0 && (b.key.bi < 0 || b.key.bi * kBlockI >= f.turn))
        throw Error(ErrorKind::input_data, "voxels in the VDB file lie beyond the turn", {file.string()});
    }
  };
  check(sheet.grid, kAbsurd);
  constexpr float kSharpest = 10.0f;  // no coefficient of a cubic spline is so many times what it goes through
  if (sheet.cubic) check(*sheet.cubic, kSharpest * kAbsurd);
  offsets->grid = std::move(sheet.grid);
  offsets->cubic = std::move(sheet.cubic);
  result.offsets = offsets;
  return result;
}

namespace {

std::string number(double v) { return fmt::format("{:.17g}", v); }
std::string list(const std::vector<double>& v) { return fmt::format("{:.17g}", fmt::join(v, " ")); }

/// The beginning of an entry, which may be long, for a message.
std::string shown(const std::string& entry) {
  constexpr std::size_t kMost = 40;
  return entry.size() > kMost ? fmt::format("{}...", std::string_view(entry).substr(0, kMost)) : entry;
}

/// Reads entries, with errors that name them.
class Reader {
 public:
  Reader(const Metadata& metadata, const std::string& file) : metadata_(metadata), file_(file) {}

  [[noreturn]] void refuse(const std::string& why) const { throw Error(ErrorKind::input_data, why, {file_}); }
  const std::string& text(const std::string& name) const {
    const auto found = metadata_.find(name);
    if (found == metadata_.end())
      refuse(fmt::format("the VDB file was not written for offsets: it lacks the entry '{}'", name));
    return found->second;
  }
  void require(const std::string& name, const std::string& wanted) const {
    if (text(name) != wanted)
      refuse(fmt::format("the entry '{}' of the VDB file is '{}', wanted is '{}'", name, shown(text(name)), wanted));
  }
  std::vector<double> numbers(const std::string& name) const {
    std::vector<double> all;
    for (std::string_view rest = text(name); !rest.empty();) {
      const std::size_t end = std::min(rest.find(' '), rest.size());
      const std::optional<double> v = finite_number(rest.substr(0, end));
      if (!v) refuse(fmt::format("the entry '{}' of the VDB file is not a list of numbers", name));
      all.push_back(*v);
      rest.remove_prefix(std::min(end + 1, rest.size()));
    }
    return all;
  }
  double one(const std::string& name) const {
    const std::vector<double> all = numbers(name);
    if (all.size() != 1) refuse(fmt::format("the entry '{}' of the VDB file must be one number", name));
    return all.front();
  }

 private:
  const Metadata& metadata_;
  const std::string& file_;
};

void write_shape(const Profile& p, Metadata& m) {
  const SmoothingOptions& s = p.smoothing;
  m.emplace("base", "points");
  m.emplace("base_name", p.name);
  m.emplace("base_y", list(p.y));
  m.emplace("base_z", list(p.z));
  m.emplace("base_smoothing", list({static_cast<double>(s.method), s.strength, s.kink_high, s.kink_low, s.kink_width}));
}
void write_shape(const StandardProfile& p, Metadata& m) {
  m.emplace("base", "standard");
  m.emplace("base_name", p.name);
}
void write_shape(const ArcChain& chain, Metadata& m) {
  std::vector<double> segments;
  for (const ArcChain::Segment& s : chain.segments) segments.insert(segments.end(), {s.length, s.curvature});
  m.emplace("base", "arcs");
  m.emplace("base_start", list({chain.start_y, chain.start_z, chain.start_angle}));
  m.emplace("base_segments", list(segments));
}

Profile read_points(const Reader& in, Body body) {
  Profile p;
  p.body = body;
  p.name = in.text("base_name");
  p.y = in.numbers("base_y");
  p.z = in.numbers("base_z");
  if (p.y.size() != p.z.size() || p.y.size() < 2)
    in.refuse("the base in the VDB file has not as many y as z, at least 2");
  const std::vector<double> s = in.numbers("base_smoothing");
  if (s.size() != 5 || !(s[0] == 0.0 || s[0] == 1.0 || s[0] == 2.0))
    in.refuse("the entry 'base_smoothing' of the VDB file is broken");
  p.smoothing = {static_cast<SmoothingOptions::Method>(to_whole<int>(s[0])), s[1], s[2], s[3], s[4]};
  return p;
}

ArcChain read_arcs(const Reader& in) {
  const std::vector<double> start = in.numbers("base_start"), segments = in.numbers("base_segments");
  if (start.size() != 3 || segments.empty() || segments.size() % 2 != 0)
    in.refuse("the arcs of the base in the VDB file are broken");
  ArcChain chain{start[0], start[1], start[2], {}};
  for (std::size_t k = 0; k < segments.size(); k += 2) chain.segments.push_back({segments[k], segments[k + 1]});
  return chain;
}

}  // namespace

Metadata to_metadata(const SparseOffsets& offsets, const SurfaceSpec& base) {
  const SheetFrame& f = offsets.frame;
  if (base.body != f.body) throw Error(ErrorKind::configuration, "the base of the offsets belongs to the other body");
  const bool wheel = f.body == Body::wheel;
  Metadata m;
  m.emplace("format", kOffsetFormat);
  m.emplace("units", "m");
  m.emplace("axes", wheel ? "i: theta [rad], j: y [m], value: radius [m]" : "i: x [m], j: y [m], value: z [m], down");
  m.emplace("body", wheel ? "wheel" : "rail");
  m.emplace("nominal_radius", number(wheel ? base.nominal_radius : 0.0));
  m.emplace("frame", list({f.u0, f.y0, f.du, f.dy, static_cast<double>(f.turn), f.first, f.last}));
  m.emplace("tolerance", number(offsets.tolerance));
  if (base.errors) m.emplace(kSurfaceErrors, fmt::format("{}", fmt::join(to_lines(*base.errors), "\n")));
  if (!base.doubts.empty()) m.emplace(kSurfaceDoubt, fmt::format("{}", fmt::join(to_lines(base.doubts), "\n")));
  if (const auto* points = std::get_if<Profile>(&base.shape))
    write_shape(*points, m);
  else if (const auto* standard = std::get_if<StandardProfile>(&base.shape))
    write_shape(*standard, m);
  else if (const auto* arcs = std::get_if<ArcChain>(&base.shape))
    write_shape(*arcs, m);
  else
    throw Error(ErrorKind::configuration,
                "the base of offsets in a file must be one section: points, arcs or a standard profile");
  return m;
}

void from_metadata(const Metadata& metadata, SparseOffsets& offsets, SurfaceSpec& base, const std::string& file) {
  const Reader in(metadata, file);
  in.require("format", kOffsetFormat);
  in.require("units", "m");
  const bool wheel = in.text("body") == "wheel";
  if (!wheel) in.require("body", "rail");
  SheetFrame& f = offsets.frame;
  f.body = base.body = wheel ? Body::wheel : Body::rail;
  base.nominal_radius = offsets.nominal_radius = in.one("nominal_radius");
  if (wheel ? !(base.nominal_radius > 0.0) : base.nominal_radius != 0.0)
    in.refuse("the nominal radius in the VDB file makes no sense");
  offsets.tolerance = in.one("tolerance");
  const std::vector<double> frame = in.numbers("frame");
  constexpr double kMostVoxels = 1 << 29;
  if (frame.size() != 7 || !(frame[2] > 0.0) || !(frame[3] > 0.0) || !(frame[4] >= 0.0 && frame[4] < kMostVoxels) ||
      (!wheel && frame[4] != 0.0) || !(frame[5] <= frame[6]) || std::fabs(frame[5]) > kMostVoxels ||
      std::fabs(frame[6]) > kMostVoxels)
    in.refuse("the entry 'frame' of the VDB file is broken");
  if (!(frame[2] >= kLeastStep) || !(frame[3] >= kLeastStep))
    in.refuse(fmt::format("the steps of the offsets in the VDB file are below {} m", kLeastStep));
  f.u0 = frame[0], f.y0 = frame[1], f.du = frame[2], f.dy = frame[3];
  f.turn = to_whole<int>(frame[4]);
  f.first = frame[5], f.last = frame[6];
  if (f.turn != frame[4] || (f.turn > 0 && std::fabs(f.turn * f.du - 2.0 * std::numbers::pi) > 1e-9))
    in.refuse("the voxels in the VDB file do not fill the turn");
  const auto lines_of = [&](std::string_view name) {
    std::vector<std::string> lines;
    const auto entry = metadata.find(std::string(name));
    if (entry == metadata.end()) return lines;
    std::istringstream text(entry->second);
    for (std::string line; std::getline(text, line);) lines.push_back(line);
    return lines;
  };
  try {
    base.errors = errors_of_lines(lines_of(kSurfaceErrors));
  } catch (const Error& error) {
    in.refuse(error.message());
  }
  base.doubts = doubts_of_lines(lines_of(kSurfaceDoubt));
  const std::string& kind = in.text("base");
  if (kind == "points")
    base.shape = read_points(in, f.body);
  else if (kind == "standard")
    base.shape = StandardProfile{in.text("base_name")};
  else if (kind == "arcs")
    base.shape = read_arcs(in);
  else
    in.refuse(fmt::format("the base '{}' in the VDB file is not known", shown(kind)));
}

}  // namespace treadmark::offset
