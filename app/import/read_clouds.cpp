// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/app/import/read_clouds.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include <fmt/format.h>

#include "treadmark/core/constants.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/core/random.hpp"
#include "treadmark/io/files/sha256.hpp"
#include "treadmark/io/scans/read_scan.hpp"

namespace treadmark::app {
namespace {

/// The least and the next value along an axis, seen one way or the other, and how many share the first.
struct FarEnd {
  double first = std::numeric_limits<double>::infinity(), second = first;
  std::size_t count = 0;

  void look_at(double value) {
    if (value == first) {
      ++count;
    } else if (value < first) {
      second = first;
      first = value;
      count = 1;
    } else {
      second = std::min(second, value);
    }
  }
};

/// Whether a number is one that instruments write for nothing: nines, or the end of the range of whole numbers,
/// wherever the decimal point stands.
bool is_void_mark(double value) {
  std::string digits = fmt::format("{}", std::fabs(value));
  if (digits.find('e') != std::string::npos) return false;
  if (digits.find('.') != std::string::npos) digits.erase(digits.find_last_not_of('0') + 1);
  std::erase(digits, '.');
  digits.erase(0, std::min(digits.find_first_not_of('0'), digits.size()));
  constexpr std::array<std::string_view, 6> kMarks{"32768", "32767", "65535", "524288", "524287", "2147483648"};
  constexpr std::size_t kFewestNines = 3;
  return (digits.size() >= kFewestNines && digits.find_first_not_of('9') == std::string::npos) ||
         std::find(kMarks.begin(), kMarks.end(), digits) != kMarks.end();
}

/// Leaves out points whose coordinate says that there is none: many share it, and it is far from all others. What is
/// written for nothing need not be that far. Returns axes and values.
std::vector<std::pair<Eigen::Index, double>> drop_no_data(PointCloud& cloud, io::ImportReport& report) {
  constexpr std::size_t kMostValues = 6;
  constexpr double kFewest = 10.0, kLeastShare = 1e-4, kFar = 10.0, kFarOfMark = 0.1;
  std::vector<Vec3>& points = cloud.points;
  std::vector<std::pair<Eigen::Index, double>> values;
  for (std::size_t round = 0; round < kMostValues; ++round) {
    std::array<FarEnd, 3> low, high;
    for (const Vec3& p : points)
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const double value = p[static_cast<Eigen::Index>(axis)];
        low[axis].look_at(value);
        high[axis].look_at(-value);
      }
    const auto no_data = [&](const FarEnd& end, const FarEnd& other) {
      const double rest = -other.first - end.second;
      const bool mark = is_void_mark(end.first);
      const double fewest = std::max(kFewest, kLeastShare * static_cast<double>(points.size()));
      return static_cast<double>(end.count) >= (mark ? 2.0 : fewest) && std::isfinite(end.second) && rest > 0.0 &&
             end.second - end.first > (mark ? kFarOfMark : kFar) * rest;
    };
    std::optional<std::pair<std::size_t, double>> found;
    for (std::size_t axis = 0; axis < 3 && !found; ++axis) {
      if (no_data(low[axis], high[axis]))
        found = {axis, low[axis].first};
      else if (no_data(high[axis], low[axis]))
        found = {axis, -high[axis].first};
    }
    if (!found) break;
    const std::size_t axis = found->first;
    const double value = found->second;
    values.emplace_back(static_cast<Eigen::Index>(axis), value);
    const std::size_t before = points.size();
    keep_points(cloud, [&](std::size_t i) { return points[i][static_cast<Eigen::Index>(axis)] != value; });
    report.removed.push_back({kNoData, before - points.size(),
                              fmt::format("{} = {:g}, far from all others", std::string_view("xyz")[axis], value)});
  }
  return values;
}

/// The points of a matrix of heights.
io::Scan heights_of(const std::filesystem::path& file, const io::ImportSettings& settings) {
  io::MapReadOptions how;  // a rail: its places are lengths
  if (settings.scan.unit != "auto") how.unit = length_unit(settings.scan.unit);
  if (settings.map.height_unit != "auto") how.height_unit = length_unit(settings.map.height_unit);
  how.asked_by = {file.string()};
  const OffsetMap map = io::read_deviation_map(file, how);
  io::Scan out;
  out.unit = LengthUnit::metre;
  out.format = fmt::format("matrix of {} x {} heights", map.grid.nx, map.grid.ny);
  out.points_in_file = map.offset.size();
  for (int iy = 0; iy < map.grid.ny; ++iy)
    for (int ix = 0; ix < map.grid.nx; ++ix) {
      const double z = map.offset[static_cast<std::size_t>(ix) +
                                  static_cast<std::size_t>(map.grid.nx) * static_cast<std::size_t>(iy)];
      if (std::isnan(z)) {
        ++out.not_finite;
        continue;
      }
      out.cloud.points.emplace_back(map.grid.x0 + map.grid.dx * ix, map.grid.y0 + map.grid.dy * iy, z);
    }
  return out;
}

/// A cloud, or what else means points: rows of heights, and a matrix of heights at places.
io::Scan read_one(const std::filesystem::path& file, const io::ImportSettings& settings,
                  const io::ScanReadOptions& options, const Progress& progress) {
  const LengthUnit unit = settings.scan.unit == "auto" ? LengthUnit::millimetre : *length_unit(settings.scan.unit);
  const auto in_file = [&](double mm) { return kMillimetre * mm / metres_per(unit); };
  if (auto rows = io::read_height_rows(file, {in_file(settings.map.across_mm), in_file(settings.map.along_mm)}, options,
                                       progress)) {
    rows->unit = unit;
    return std::move(*rows);
  }
  if ((options.box || options.ranges) && io::is_deviation_map(file))
    throw Error(ErrorKind::configuration,
                "a box (scan.box_from) and ranges (scan.nearest ...) belong to points, and this is a matrix",
                {file.string()}, "leave them out");
  if (settings.map.values == "heights" && io::is_deviation_map(file)) return heights_of(file, settings);
  return io::read_scan(file, options, progress);
}

/// How the points of a file are read. Errors: Error(configuration) for half a box, or an empty one, or empty ranges.
io::ScanReadOptions options_for(const std::filesystem::path& file, const io::ImportSettings& settings) {
  io::ScanReadOptions out;
  out.asked_by = {file.string()};
  const auto& scan = settings.scan;
  if (scan.station.size() == 3) out.station.emplace(scan.station[0], scan.station[1], scan.station[2]);
  io::ScanRanges ranges;
  ranges.nearest = scan.nearest;
  if (scan.farthest > 0.0) ranges.farthest = scan.farthest;
  if (scan.least_intensity > 0.0) ranges.least_intensity = scan.least_intensity;
  if (ranges.farthest < ranges.nearest)
    throw Error(ErrorKind::configuration, "no point is farther than scan.nearest and nearer than scan.farthest", {},
                "scan.farthest must be the greater one");
  if (ranges.by_distance() || ranges.by_intensity()) out.ranges = ranges;
  const std::vector<double>&from = settings.scan.box_from, &to = settings.scan.box_to;
  if (from.empty() && to.empty()) return out;
  if (from.size() != 3 || to.size() != 3)
    throw Error(ErrorKind::configuration, "scan.box_from and scan.box_to belong together", {}, "give both, or none");
  out.box.emplace(Vec3(from[0], from[1], from[2]), Vec3(to[0], to[1], to[2]));
  if (out.box->isEmpty())
    throw Error(ErrorKind::configuration, "the box from scan.box_from to scan.box_to is empty", {},
                "give the least x, y and z, then the greatest");
  return out;
}

/// What files say of themselves, one after the other.
class FilesRead {
 public:
  explicit FilesRead(const ImportRequest& request) : request_(request) {}

  void add(const io::Scan& scan, Clouds& out, io::ImportReport& report) {
    const std::filesystem::path& file = request_.scans[report.inputs.size()];
    const bool first = report.inputs.empty();
    report.inputs.push_back(
        {file.filename().string(), io::sha256_file(file), scan.format, scan.points_in_file, scan.not_finite});
    not_finite_ += scan.not_finite;
    outside_ += scan.outside;
    withheld_ += scan.withheld;
    if (!first && scan.unit != out.unit)
      throw Error(ErrorKind::input_data, "the scans are in different units", {file.string()},
                  "say the unit of all of them with --unit, or convert them first");
    out.unit = scan.unit;
    out.usual_unit = scan.usual_unit;
    if (out.reference.empty()) out.reference = scan.reference;
  }

  /// points: of all files that are finite. Returns what drop_no_data does.
  std::vector<std::pair<Eigen::Index, double>> finish(std::size_t points, Clouds& out, io::ImportReport& report) const {
    out.cloud.normals.clear();  // surfaces tell their own
    out.cloud.normals.shrink_to_fit();
    out.cloud.name = request_.scans.front().string();
    report.points_read = points + not_finite_ + withheld_ + outside_;
    if (not_finite_ > 0)
      report.removed.push_back(
          {"not finite", not_finite_, "coordinates that are no numbers, as scanners write for lost points"});
    const auto& scan = request_.settings.scan;
    std::vector<std::string> why;
    if (!scan.box_from.empty()) why.emplace_back("from scan.box_from to scan.box_to");
    if (scan.nearest > 0.0 || scan.farthest > 0.0) why.emplace_back("from scan.nearest to scan.farthest");
    if (scan.least_intensity > 0.0) why.emplace_back("from scan.least_intensity on");
    if (outside_ > 0)
      report.removed.push_back({scan.box_from.empty() ? "outside the ranges" : "outside the box", outside_,
                                fmt::format("{}", fmt::join(why, ", "))});
    auto no_data = drop_no_data(out.cloud, report);
    if (withheld_ > 0) report.removed.push_back({"withheld", withheld_, "marked as deleted in the file"});
    return no_data;
  }

 private:
  const ImportRequest& request_;
  std::size_t not_finite_ = 0, withheld_ = 0, outside_ = 0;
};

}  // namespace

Clouds read_clouds(const ImportRequest& request, io::ImportReport& report, const Progress& progress) {
  Clouds out;
  FilesRead files(request);
  std::map<std::pair<std::size_t, std::uint16_t>, std::uint16_t> pass_number;
  Progress quiet;
  quiet.stop = progress.stop;
  for (std::size_t file = 0; file < request.scans.size(); ++file) {
    const io::ScanReadOptions options = options_for(request.scans[file], request.settings);
    io::Scan scan = read_one(request.scans[file], request.settings, options, quiet);
    files.add(scan, out, report);
    const std::size_t before = out.cloud.points.size();
    const std::map<std::uint16_t, Vec3> stations = std::exchange(scan.cloud.stations, {});
    if (file == 0) {
      out.cloud = std::move(scan.cloud);
    } else {
      PointCloud& to = out.cloud;
      to.points.insert(to.points.end(), scan.cloud.points.begin(), scan.cloud.points.end());
      if (!to.intensities.empty() || !scan.cloud.intensities.empty()) {
        const auto none = std::numeric_limits<float>::quiet_NaN();
        to.intensities.resize(before, none);
        to.intensities.insert(to.intensities.end(), scan.cloud.intensities.begin(), scan.cloud.intensities.end());
        to.intensities.resize(to.points.size(), none);
      }
    }
    if (request.scans.size() == 1) out.cloud.stations = stations;
    if (request.scans.size() > 1) {
      // a pass of a file is a pass of its own
      const std::vector<std::uint16_t> own = file == 0 ? std::move(out.cloud.passes) : std::move(scan.cloud.passes);
      if (file == 0) out.cloud.passes.clear();
      for (std::size_t i = before; i < out.cloud.points.size(); ++i) {
        const auto key = std::pair{file, own.empty() ? std::uint16_t{0} : own[i - before]};
        out.cloud.passes.push_back(
            pass_number.emplace(key, static_cast<std::uint16_t>(pass_number.size())).first->second);
      }
      for (const auto& [key, number] : pass_number) {
        if (key.first != file) continue;
        const auto known = stations.size() == 1 ? stations.begin() : stations.find(key.second);
        if (known != stations.end()) out.cloud.stations[number] = known->second;
      }
    }
  }
  // of some files alone they would pass for those of all
  if (pass_number.size() > 1 && out.cloud.stations.size() == 1) out.cloud.stations.clear();
  files.finish(out.cloud.points.size(), out, report);
  return out;
}

io::Scan CloudWalk::walk(std::size_t file, const std::function<void(PointCloud&)>& take,
                         const Progress& progress) const {
  io::ScanReadOptions options = options_for(request_.scans[file], request_.settings);
  options.most_points = std::numeric_limits<std::size_t>::max();
  options.batch = take;
  return io::read_scan(request_.scans[file], options, progress);
}

void CloudWalk::number_passes(std::size_t file, std::span<std::uint16_t> passes) {
  if (!several_[file]) std::fill(passes.begin(), passes.end(), std::uint16_t{0});
  if (request_.scans.size() < 2) return;
  for (std::uint16_t& pass : passes) {
    const auto key = std::pair{file, pass};
    pass = pass_number_.emplace(key, static_cast<std::uint16_t>(pass_number_.size())).first->second;
  }
}

Clouds CloudWalk::sample(std::size_t most, io::ImportReport& report, const Progress& progress) {
  constexpr std::uint64_t kSeed = 0x73616d70u;
  Clouds out;
  FilesRead files(request_);
  PointCloud& cloud = out.cloud;
  std::vector<std::uint64_t> drawn;  // of the points of the cloud
  std::uint64_t number = 0;
  std::size_t of_file = 0;  // the first of the file at hand
  const auto thin_out = [&] {
    std::size_t kept = 0;
    const std::size_t before = of_file;
    for (std::size_t i = 0; i < drawn.size(); ++i) {
      if (i == before) of_file = kept;
      if (drawn[i] % one_in_ != 0) continue;
      drawn[kept] = drawn[i];
      cloud.points[kept] = cloud.points[i];
      cloud.passes[kept++] = cloud.passes[i];
    }
    if (before == drawn.size()) of_file = kept;
    drawn.resize(kept);
    cloud.points.resize(kept);
    cloud.passes.resize(kept);
  };
  for (std::size_t file = 0; file < request_.scans.size(); ++file) {
    of_file = drawn.size();
    const io::Scan scan = walk(
        file,
        [&](PointCloud& batch) {
          for (std::size_t i = 0; i < batch.points.size(); ++i) {
            const std::uint64_t draw = Random(kSeed + number++).bits();
            if (draw % one_in_ != 0) continue;
            drawn.push_back(draw);
            cloud.points.push_back(batch.points[i]);
            cloud.passes.push_back(batch.passes.empty() ? std::uint16_t{0} : batch.passes[i]);
          }
          while (drawn.size() > most) {
            one_in_ *= 2;
            thin_out();
          }
        },
        progress);
    files.add(scan, out, report);
    several_.push_back(scan.several_passes);
    number_passes(file, std::span(cloud.passes).subspan(of_file));
  }
  if (several_.size() == 1 && !several_.front()) cloud.passes = {};
  no_data_ = files.finish(static_cast<std::size_t>(number), out, report);
  return out;
}

void CloudWalk::all(const std::function<void(PointCloud& batch)>& take, const Progress& progress) {
  for (std::size_t file = 0; file < request_.scans.size(); ++file)
    walk(
        file,
        [&](PointCloud& batch) {
          const bool passes = several_.size() > 1 || several_.front();
          batch.passes.resize(passes ? batch.points.size() : 0, 0);
          number_passes(file, batch.passes);
          std::size_t kept = 0;
          for (std::size_t i = 0; i < batch.points.size(); ++i) {
            const Vec3& p = batch.points[i];
            if (ranges::any_of(no_data_, [&](const auto& mark) { return p[mark.first] == mark.second; })) continue;
            if (passes) batch.passes[kept] = batch.passes[i];
            batch.points[kept++] = p;
          }
          batch.points.resize(kept);
          batch.passes.resize(passes ? kept : 0);
          take(batch);
        },
        progress);
}

}  // namespace treadmark::app
