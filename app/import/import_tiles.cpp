// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/app/import/import_tiles.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <iterator>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <system_error>
#include <type_traits>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "treadmark/app/import/fill_report.hpp"
#include "treadmark/app/import/import_steps.hpp"
#include "treadmark/app/import/tile_fit.hpp"
#include "treadmark/app/import/write_outputs.hpp"
#include "treadmark/app/surfaces/read_surface.hpp"
#include "treadmark/app/surfaces/written_surface.hpp"
#include "treadmark/app/version.hpp"
#include "treadmark/core/byte_archive.hpp"
#include "treadmark/core/cancellation.hpp"
#include "treadmark/core/constants.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/core/median.hpp"
#include "treadmark/core/parallel.hpp"
#include "treadmark/core/to_whole.hpp"
#include "treadmark/io/files/part_log.hpp"
#include "treadmark/io/files/sha256.hpp"
#include "treadmark/io/imports/import_words.hpp"
#include "treadmark/io/profiles/read_slices.hpp"
#include "treadmark/io/profiles/write_slices.hpp"
#include "treadmark/io/scans/read_scan.hpp"
#include "treadmark/model/shape/natural_view.hpp"
#include "treadmark/scans/fit/half_fits.hpp"

namespace treadmark::app {
namespace {

constexpr double kTileOverlap = 1.6;   // [m]; what points there say falls by about two for each 64 mm
constexpr double kFromTheLine = 0.25;  // points farther from it are none of the rail's [m]

/// Points of all tiles, and what became of these, in the file that an interrupted import leaves.
class TileFile {
 public:
  TileFile(const TilePlan& plan, const std::filesystem::path& file, const std::string& identity)
      : plan_(plan), log_(file, identity), waiting_(plan.tiles()), pieces_(plan.tiles(), 0) {}

  bool is_sorted() const { return log_.has(part(plan_.tiles(), 0)); }

  void add(std::size_t tile, const Vec3& point, std::uint32_t number) {
    TilePoints& to = waiting_[tile];
    to.points.push_back(point);
    to.numbers.push_back(number);
    constexpr std::size_t kMostWaiting = 2'000'000;  // 56 MB
    if (++held_ >= kMostWaiting)
      put_down(static_cast<std::size_t>(
          std::max_element(waiting_.begin(), waiting_.end(),
                           [](const auto& a, const auto& b) { return a.points.size() < b.points.size(); }) -
          waiting_.begin()));
  }

  /// After the last point. what: is there again when the file is opened again.
  void finish_sorting(std::span<const std::size_t> what) {
    for (std::size_t tile = 0; tile < waiting_.size(); ++tile)
      if (!waiting_[tile].points.empty()) put_down(tile);
    ByteWriter out;
    out.put(what);
    log_.add(part(plan_.tiles(), 0), out.bytes());
  }
  std::vector<std::size_t> sorted() const {
    std::vector<std::size_t> what;
    const std::vector<std::byte> bytes = log_.content(part(plan_.tiles(), 0));
    ByteReader(bytes).get(what);
    return what;
  }

  /// Of the window of a tile, in the order of their numbers.
  TilePoints window(std::size_t tile) const {
    const TileRange range = plan_.window(tile);
    const double from = plan_.band.from + plan_.along(range.from), to = plan_.band.from + plan_.along(range.to);
    std::vector<std::pair<std::uint32_t, Vec3>> found;
    for (std::size_t k = range.from / plan_.length; k * plan_.length < range.to; ++k)
      for (std::size_t piece = 0; log_.has(part(k, piece)); ++piece) {
        check_cancelled();
        std::vector<double> places;
        std::vector<std::uint32_t> numbers;
        const std::vector<std::byte> bytes = log_.content(part(k, piece));
        ByteReader in(bytes);
        in.get(places);
        in.get(numbers);
        if (places.size() != 3 * numbers.size()) refuse_saved_state("points lack coordinates");
        for (std::size_t i = 0; i < numbers.size(); ++i)
          if (const double x = places[3 * i]; x >= from && x <= to)
            found.emplace_back(numbers[i], Vec3(x, places[3 * i + 1], places[3 * i + 2]));
      }
    std::sort(found.begin(), found.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
    TilePoints out;
    for (const auto& [number, point] : found) {
      out.numbers.push_back(number);
      out.points.push_back(point);
    }
    return out;
  }

  /// What became of a tile: what is there from before, or what fit() makes of it.
  template <class Fit>
  FittedTile tile(std::size_t number, const Fit& fit) {
    const std::size_t key = part(number, kFitted);
    FittedTile out;
    if (log_.has(key)) {
      const std::vector<std::byte> bytes = log_.content(key);
      ByteReader in(bytes);
      FittedTile::each(out, [&](auto& member) { in.get(member); });
      const std::size_t slices = std::max<std::size_t>(1, out.along.size()), curves = out.error_at.size();
      if (out.open.size() != plan_.own(number).count() || out.y.size() != out.z.size() || out.y.size() % slices != 0 ||
          out.errors.size() != curves * out.error_y.size() || out.error_y.size() != out.error_z.size())
        refuse_saved_state("a tile is not one of this rail");
      return out;
    }
    out = fit();
    ByteWriter bytes;
    FittedTile::each(std::as_const(out), [&](const auto& member) {
      if constexpr (std::is_arithmetic_v<std::decay_t<decltype(member)>>)
        bytes.put(member);
      else
        bytes.put(std::span(member));
    });
    log_.add(key, bytes.bytes());
    return out;
  }

  void remove() { log_.remove(); }

 private:
  static constexpr std::size_t kPieces = std::size_t{1} << 20, kFitted = kPieces - 1;
  static std::size_t part(std::size_t tile, std::size_t piece) { return tile * kPieces + piece; }

  /// The same pieces each time: which points wait depends on their order only.
  void put_down(std::size_t tile) {
    check_cancelled();
    const TilePoints points = std::exchange(waiting_[tile], {});
    held_ -= points.points.size();
    const std::size_t key = part(tile, pieces_[tile]++);
    if (log_.has(key)) return;
    ByteWriter out;
    out.put(std::span<const double>(points.points.front().data(), 3 * points.points.size()));
    out.put(std::span<const std::uint32_t>(points.numbers));
    log_.add(key, out.bytes());
  }

  const TilePlan& plan_;
  io::PartLog log_;
  std::vector<TilePoints> waiting_;
  std::vector<std::size_t> pieces_;
  std::size_t held_ = 0;
};

/// What the points depend on, so that an unfinished import may go on.
std::string identity_of(const ImportRequest& request, const io::ImportReport& report) {
  std::string out = report.version + git_revision() + '\n' + report.settings_toml;
  for (const auto& input : report.inputs) out += input.sha256 + '\n';
  for (const std::string* name : {&request.settings.placement.line, &request.settings.placement.nominal}) {
    std::error_code ignored;
    if (std::filesystem::is_regular_file(*name, ignored)) out += io::sha256_file(*name) + '\n';
  }
  return out;
}

/// All that the sample tells.
TilePlan plan_of(const OnSection& found, const io::ImportSettings& settings, double finest) {
  TilePlan plan;
  plan.section = found.projection.band.section;
  plan.project = {Body::rail, 1.0, 1e-3 * settings.clean.farthest_mm, finest};
  plan.band = scans::intervals_of(found.projection);
  scans::ProjectSettings of_one = plan.project;
  of_one.part = scans::BandIntervals{plan.band.from, plan.band.step, 1};
  plan.halvings = scans::project({}, {}, Pose{}, plan.section, of_one).points.halvings_a;
  plan.rows = plan.band.count << plan.halvings;
  // windows begin where tiles of the noise do (LocalNoise), and where every fourth interval does, so that sums are
  // those of all in the same order
  constexpr std::size_t kTogether = 4;
  const std::size_t cells = std::size_t{1} << plan.halvings,
                    even = std::max(kTogether,
                                    scans::LocalNoise::kTileCells / std::min(cells, scans::LocalNoise::kTileCells));
  const auto intervals = [&](double length) {
    return even * to_whole<std::size_t>(std::max(1.0, std::ceil(length / plan.band.step / static_cast<double>(even))));
  };
  plan.length = intervals(settings.tiles.length_m);
  plan.overlap = intervals(kTileOverlap);
  plan.noise.outlier_factor = settings.clean.outlier_factor;
  plan.noise.most_flagged = settings.clean.edge_share;
  plan.coverage = {1e-3 * settings.clean.hole_limit_mm, settings.clean.least_filled};
  plan.fit = fit_settings(settings);
  plan.fit.rows_of_whole = plan.rows;
  plan.spacing = 1e-3 * settings.fit.resolution_mm;
  plan.halves = found.halves;
  constexpr std::size_t kMostMapRows = 4096;
  while (plan.band.count > kMostMapRows * plan.map_intervals && plan.length % (2 * plan.map_intervals) == 0)
    plan.map_intervals *= 2;
  if (!settings.fit.errors) return plan;
  // two beside each other see different halves of the points
  constexpr std::size_t kPlaces = 16;
  constexpr double kApart = 20e-3;
  for (std::size_t k = 0; k < kPlaces; ++k) {
    const double at = plan.along(plan.band.count) * (static_cast<double>(k) + 0.5) / static_cast<double>(kPlaces);
    plan.error_stations.push_back(at - 0.5 * kApart);
    plan.error_stations.push_back(at + 0.5 * kApart);
  }
  return plan;
}

/// Looks at some tiles for what is usual, which all share then.
void learn_the_usual(TilePlan& plan, const TileFile& file, const io::ImportSettings& settings) {
  constexpr std::size_t kMostTrials = 5;
  const std::size_t trials = std::min(kMostTrials, plan.tiles());
  std::vector<double> noise, window, sweeps, gap_a, gap_s, limit, first, last;
  for (std::size_t k = 0; k < trials; ++k) {
    check_cancelled();
    const std::size_t tile = (2 * k + 1) * plan.tiles() / (2 * trials);
    const FittedTile found = fit_tile(plan, tile, file.window(tile), true);
    if (found.noise == 0.0) continue;  // hardly any points
    noise.push_back(found.noise);
    window.push_back(found.noise_window);
    sweeps.push_back(found.sweeps);
    gap_a.push_back(found.coverage.gap_a), gap_s.push_back(found.coverage.gap_s);
    limit.push_back(found.coverage.limit);
    first.push_back(static_cast<double>(found.coverage.first_column));
    last.push_back(static_cast<double>(found.coverage.last_column));
  }
  if (noise.empty())
    throw Error(ErrorKind::input_data, "the places along the rail that were looked at have hardly any points", {},
                "is most of it missing? cut out the part that was scanned");
  plan.noise.typical = median_of(noise);
  plan.noise.window = to_whole<int>(median_of(window));
  plan.fit.sweeps = to_whole<int>(median_of(sweeps));
  plan.usual.gap_a = median_of(gap_a), plan.usual.gap_s = median_of(gap_s);
  plan.usual.limit = median_of(limit);
  plan.usual.first_column = to_whole<std::size_t>(median_of(first));
  plan.usual.last_column = to_whole<std::size_t>(median_of(last));
  if (plan.usual.last_column <= plan.usual.first_column + 8)
    throw Error(ErrorKind::input_data, "no part of the running band is covered by points along enough of its length",
                {}, "lower clean.least_filled, or scan more of it");
  constexpr double kOfNoise = 1.0 / 50.0, kFinestTolerance = 0.02e-6, kCoarsestTolerance = 0.5e-6;
  plan.tolerance = settings.fit.tolerance_um > 0.0
                       ? 1e-6 * settings.fit.tolerance_um
                       : std::clamp(kOfNoise * plan.noise.typical, kFinestTolerance, kCoarsestTolerance);
  plan.damage_threshold = damage_threshold(settings, plan.noise.typical);
}

/// A part of the rail without open holes, and the slices that it has.
struct Stretch {
  double from = 0.0, to = 0.0;  ///< from the beginning of the band [m]
  SliceSet slices;              ///< u from the beginning of the band
  std::vector<double> checks;   ///< as FittedTile's
};

/// What all tiles together are.
class JoinedTiles {
 public:
  JoinedTiles(const TilePlan& plan, io::ImportReport& report) : plan_(plan), report_(report) {}

  void add(std::size_t number, FittedTile tile) {
    const TileRange own = plan_.own(number);
    for (std::size_t k = 0; k < own.count(); ++k)
      if (tile.open[k] != 0) open_.push_back(own.from + k);
    tiles_.push_back(std::move(tile));
  }

  std::vector<scans::Damage> damage() const {
    std::vector<scans::Damage> out;
    for (const FittedTile& tile : tiles_)
      for (std::size_t k = 0; k + 5 < tile.damage.size(); k += 6)
        out.push_back({tile.damage[k], tile.damage[k + 1], tile.damage[k + 2], tile.damage[k + 3], tile.damage[k + 4],
                       tile.damage[k + 5]});
    std::stable_sort(out.begin(), out.end(),
                     [](const auto& a, const auto& b) { return std::fabs(a.volume) > std::fabs(b.volume); });
    return out;
  }

  /// Intervals with open holes, and what is between two or at an end and too short for a surface of its own.
  std::vector<TileRange> gaps() const {
    constexpr double kShortestStretch = 0.25;  // [m]
    const auto is_short = [&](std::size_t from, std::size_t to) { return plan_.along(to - from) < kShortestStretch; };
    std::vector<TileRange> out;
    for (const std::size_t interval : open_)
      if (!out.empty() && is_short(out.back().to, interval))
        out.back().to = interval + 1;
      else
        out.push_back({out.empty() && is_short(0, interval) ? 0 : interval, interval + 1});
    if (!out.empty() && is_short(out.back().to, plan_.band.count)) out.back().to = plan_.band.count;
    return out;
  }

  /// Takes the slices of all tiles.
  std::vector<Stretch> stretches() {
    constexpr double kRounding = 1e-9;  // [m]
    std::vector<Stretch> out;
    std::size_t from = 0;
    std::vector<TileRange> gaps = this->gaps();
    gaps.push_back({plan_.band.count, plan_.band.count});
    for (const TileRange& gap : gaps) {
      if (gap.from > from) {
        out.emplace_back();
        out.back().from = plan_.along(from), out.back().to = plan_.along(gap.from);
      }
      from = gap.to;
    }
    std::size_t at = 0;
    for (FittedTile& tile : tiles_) {
      const std::size_t points = tile.along.empty() ? 0 : tile.y.size() / tile.along.size();
      for (std::size_t k = 0; k < tile.along.size(); ++k) {
        while (at < out.size() && tile.along[k] > out[at].to + kRounding) ++at;
        if (at == out.size() || tile.along[k] < out[at].from - kRounding) continue;
        SliceSet& to = out[at].slices;
        const auto begin = static_cast<std::ptrdiff_t>(k * points), end = begin + static_cast<std::ptrdiff_t>(points);
        Profile& profile = to.profiles.emplace_back();
        profile.body = Body::rail;
        profile.y.assign(tile.y.begin() + begin, tile.y.begin() + end);
        profile.z.assign(tile.z.begin() + begin, tile.z.begin() + end);
        to.u.push_back(tile.along[k]);
      }
      for (std::size_t k = 0; k + 3 < tile.checks.size(); k += 4)
        for (Stretch& stretch : out)
          if (tile.checks[k] > stretch.from + plan_.band.step && tile.checks[k] < stretch.to - plan_.band.step)
            stretch.checks.insert(stretch.checks.end(), tile.checks.begin() + static_cast<std::ptrdiff_t>(k),
                                  tile.checks.begin() + static_cast<std::ptrdiff_t>(k + 4));
      tile.along = tile.y = tile.z = tile.checks = {};
    }
    std::erase_if(out, [](const Stretch& stretch) { return stretch.slices.u.size() < 4; });
    return out;
  }

  std::optional<SurfaceErrors> errors(double u_of_zero) const {
    SurfaceErrors out;
    for (const FittedTile& tile : tiles_) {
      if (tile.error_at.empty()) continue;
      out.y = tile.error_y, out.z = tile.error_z;
      const auto places = static_cast<std::ptrdiff_t>(tile.error_y.size());
      for (std::size_t k = 0; k < tile.error_at.size(); ++k) {
        out.u.push_back(plan_.band.from + tile.error_at[k] - u_of_zero);
        const auto begin = tile.errors.begin() + static_cast<std::ptrdiff_t>(k) * places;
        out.draws.emplace_back(begin, begin + places);
      }
    }
    return out.draws.empty() ? std::nullopt : std::optional(std::move(out));
  }

  void fill(double u_zero, std::size_t sorted) {
    io::ImportReport& r = report_;
    double square_used = 0.0, square_held = 0.0, variance = 0.0;
    std::size_t outliers = 0, duplicates = 0;
    for (const FittedTile& tile : tiles_) {
      r.fitted_points += tile.used, r.held_out_points += tile.held_out;
      outliers += tile.outliers, duplicates += tile.duplicates;
      square_used += tile.square_used, square_held += tile.square_held_out, variance += tile.variance_held_out;
      r.residual_max = std::max(r.residual_max, tile.largest);
      r.residual_histogram.resize(std::max(r.residual_histogram.size(), tile.histogram.size()), 0);
      for (std::size_t k = 0; k < tile.histogram.size(); ++k) r.residual_histogram[k] += tile.histogram[k];
      for (std::size_t k = 0; k + 4 < tile.holes.size(); k += 5)
        r.holes.push_back({plan_.band.from + tile.holes[k] - u_zero, plan_.section.at(tile.holes[k + 1]).position.x(),
                           tile.holes[k + 2], tile.holes[k + 3], tile.holes[k + 4] != 0.0, tile.holes[k + 1]});
      r.hole_area += tile.open_area;
    }
    std::stable_sort(r.holes.begin(), r.holes.end(),
                     [](const auto& a, const auto& b) { return a.diameter > b.diameter; });
    const auto rms = [](double square, std::size_t count) {
      return count > 0 ? std::sqrt(std::max(0.0, square) / static_cast<double>(count)) : 0.0;
    };
    r.residual_rms = rms(square_used, r.fitted_points);
    r.held_out_rms = rms(square_held, r.held_out_points);
    r.held_out_error = rms(square_held - variance, r.held_out_points);
    r.points_used = r.fitted_points + r.held_out_points;
    r.removed.push_back({"far from the section", sorted - std::min(sorted, r.points_used + outliers + duplicates),
                         "beside its ends, or farther above or below than clean.farthest_mm"});
    r.removed.push_back({"duplicates", duplicates, "at the very place of another point"});
    r.removed.push_back({"outliers", outliers, "far from a quadratic through the points around, or hardly any around"});
    r.residual_range = 6.0 * plan_.noise.typical;
    r.noise = plan_.noise.typical;
    r.gap_a = plan_.usual.gap_a, r.gap_s = plan_.usual.gap_s, r.hole_limit = plan_.usual.limit;
    r.damage_threshold = plan_.damage_threshold;
    const double cell_s = plan_.section.length() / static_cast<double>(columns());
    const double s_min = cell_s * static_cast<double>(plan_.usual.first_column),
                 s_max = cell_s * static_cast<double>(plan_.usual.last_column);
    r.area = plan_.along(plan_.band.count) * (s_max - s_min);
    for (const auto& hole : r.holes) r.hole_area += hole.filled ? hole.area : 0.0;
    r.y_min = plan_.section.at(s_min).position.x(), r.y_max = plan_.section.at(s_max).position.x();
    r.u_min = plan_.band.from - u_zero, r.u_max = r.u_min + plan_.along(plan_.band.count);
    for (const scans::Damage& d : damage())
      r.damage.push_back({plan_.band.from + d.a - u_zero, plan_.section.at(d.s).position.x(), d.length, d.width,
                          d.depth, d.volume, d.s});
    fill_maps();
  }

 private:
  std::size_t columns() const {
    for (const FittedTile& tile : tiles_)
      if (tile.columns > 0) return tile.columns;
    return 1;
  }

  void fill_maps() {
    io::ImportReport& r = report_;
    io::BandMap* const maps[] = {&r.density, &r.removed_map, &r.fitted, &r.residual, &r.noise_map};
    for (std::size_t k = 0; k < std::size(maps); ++k) {
      io::BandMap& map = *maps[k];
      map.columns = columns();
      map.s_max = plan_.section.length();
      for (std::size_t tile = 0; tile < tiles_.size(); ++tile) {
        const std::vector<float>& part = tiles_[tile].maps[k];
        const std::size_t own = (plan_.own(tile).count() + plan_.map_intervals - 1) / plan_.map_intervals;
        map.value.insert(map.value.end(), part.begin(), part.end());
        map.rows += own;
        map.value.resize(map.rows * map.columns, static_cast<float>(kNaN));
      }
      map.a_min = r.u_min;
      map.a_max = r.u_min + plan_.band.step * static_cast<double>(map.rows * plan_.map_intervals);
    }
    for (double s = 0.0; s <= plan_.section.length(); s += 0.25e-3) {
      const Vec2 p = plan_.section.at(s).position;
      r.section.emplace_back(p.x(), -p.y());
    }
  }

  const TilePlan& plan_;
  io::ImportReport& report_;
  std::vector<FittedTile> tiles_;
  std::vector<std::size_t> open_;
};

class TiledImport {
 public:
  TiledImport(const ImportRequest& request, const Progress& progress)
      : request_(request), settings_(request.settings), progress_(progress), clock_(report_, progress, kSteps) {
    report_.version = version();
    report_.settings_toml = io::import_settings_toml(settings_);
  }

  io::ImportReport import() {
    const CancellationScope scope(progress_.stop);
    clock_.begin("reading");
    CloudWalk walk(request_);
    Clouds sample = walk.sample(to_whole<std::size_t>(settings_.tiles.sample_points), report_, in_percent());
    const std::size_t read_so_far = report_.removed.size();
    scan_ = find_place(std::move(sample), request_, report_, clock_);
    report_.removed.resize(read_so_far);  // strays of the sample alone
    report_.spacing /= std::sqrt(static_cast<double>(walk.one_in()));
    clock_.begin("section");
    const double finest = finest_of(settings_, report_.spacing);
    constexpr double kCells = 4e-3;  // of the sample: all along the rail there must not be too many
    plan_ = plan_of(on_its_section(scan_, settings_, finest, std::max(finest, kCells), settings_.fit.errors), settings_,
                    finest);
    constexpr std::size_t kMostDots = 6000;
    for (std::size_t i = 0; i < scan_.points.size(); i += 1 + scan_.points.size() / kMostDots) {
      const Vec3 p_S = scan_.placement.X_CS.apply_inverse(scan_.points[i]);
      report_.raw_section.emplace_back(p_S.y(), p_S.z());
    }
    scan_.points = {}, scan_.passes = {}, scan_.keep = {};  // the sample has said all

    clock_.begin("sorting");
    TileFile file(plan_, unfinished_file(request_), identity_of(request_, report_));
    if (!file.is_sorted()) sort(walk, file);
    count_no_data(file.sorted());
    report_.removed.push_back({"beside the line", file.sorted().at(1),
                               fmt::format("farther than {:g} mm from the line of the rail", kMilli * kFromTheLine)});
    report_.removed.push_back({"past the ends", file.sorted().at(2), "where hardly any points are"});
    clock_.begin("what is usual");
    learn_the_usual(plan_, file, settings_);
    JoinedTiles tiles(plan_, report_);
    fit(file, tiles);
    finish(tiles, file.sorted().at(0));
    file.remove();
    clock_.end();
    return std::move(report_);
  }

 private:
  static constexpr std::size_t kSteps = 8;

  /// Points without data by all points: the sample had some of them only.
  void count_no_data(const std::vector<std::size_t>& sorted) {
    std::vector<io::ImportReport::Removed>& removed = report_.removed;
    const auto is_other = [](const auto& one) { return one.reason != kNoData; };
    const auto first = std::stable_partition(removed.begin(), removed.end(), is_other);
    if (first == removed.end()) return;
    first->count = report_.points_read - std::min(report_.points_read, sorted.at(0) + sorted.at(1) + sorted.at(2));
    for (auto one = removed.begin(); one != first; ++one) first->count -= std::min(first->count, one->count);
    for (auto one = first + 1; one != removed.end(); ++one) first->why += "; " + one->why;
    removed.erase(first + 1, removed.end());
  }

  /// For readers: how far a step is.
  Progress in_percent() {
    Progress out;
    out.stop = progress_.stop;
    out.report = [this](std::size_t done, std::size_t all, const std::string& what) {
      clock_.tell(fmt::format("({}: {:.0f} %)", what,
                              100.0 * static_cast<double>(done) / static_cast<double>(std::max<std::size_t>(1, all))));
    };
    return out;
  }

  void sort(CloudWalk& walk, TileFile& file) {
    std::uint32_t number = 0;
    std::size_t sorted = 0, beside = 0, past = 0;
    walk.all(
        [&](PointCloud& batch) {
          for (Vec3& p : batch.points) p *= scan_.metres;
          for (const auto& lay : scan_.laid_by) lay(batch.points, batch.passes);
          for (const Vec3& p : batch.points) {
            const Vec3 p_S = scan_.placement.X_CS.apply_inverse(p);
            const double place = (p_S.x() - plan_.band.from) / plan_.band.step;
            const std::uint32_t own = number++;
            if (std::hypot(p_S.y(), p_S.z()) > kFromTheLine) {
              ++beside;
            } else if (!(place >= 0.0 && place < static_cast<double>(plan_.band.count))) {
              ++past;
            } else {
              file.add(to_whole<std::size_t>(std::floor(place)) / plan_.length, p_S, own);
              ++sorted;
            }
          }
        },
        in_percent());
    const std::size_t counts[] = {sorted, beside, past};
    file.finish_sorting(counts);
  }

  void fit(TileFile& file, JoinedTiles& tiles) {
    using Clock = std::chrono::steady_clock;
    clock_.begin("tiles");
    Clock::time_point start = Clock::now();
    std::size_t fitted = 0;
    for (std::size_t k = 0; k < plan_.tiles(); ++k) {
      check_cancelled();
      const double seconds = std::chrono::duration<double>(Clock::now() - start).count();
      const std::string left =
          fitted == 0 ? ""
                      : fmt::format(", {:.1f} min left", seconds / static_cast<double>(fitted) *
                                                             static_cast<double>(plan_.tiles() - k) / 60.0);
      clock_.tell(fmt::format("{} of {}{}", k + 1, plan_.tiles(), left));
      bool here = false;
      tiles.add(k, file.tile(k, [&] {
        here = true;
        return fit_tile(plan_, k, file.window(k));
      }));
      if (here)
        ++fitted;
      else
        start = Clock::now();  // it was there from before
    }
  }

  std::string place_of(double along) const { return fmt::format("x = {:.3f} m", plan_.band.from + along - u_zero_); }

  void finish(JoinedTiles& tiles, std::size_t sorted) {
    scans::Band band{Body::rail, 1.0, plan_.section, plan_.band.from, plan_.band.from + plan_.along(plan_.band.count),
                     false};
    u_zero_ = zero_of(scan_, band, tiles.damage(), settings_, report_);
    lay_zero(scan_, u_zero_);
    fill_line(scan_, settings_, report_);
    fill_placement(scan_, report_);
    report_.nominal_section = scan_.nominal;
    tiles.fill(u_zero_, sorted);
    std::shared_ptr<const SurfaceErrors> errors;
    if (std::optional<SurfaceErrors> known = tiles.errors(u_zero_))
      errors = with_sources(std::move(*known), scan_, settings_, report_);
    tell_gaps(tiles.gaps());
    clock_.begin("writing");
    std::vector<Stretch> stretches = tiles.stretches();
    if (stretches.empty())
      throw Error(ErrorKind::input_data, "nowhere along the rail is there a surface without holes that stay open",
                  {request_.scans.front().string()}, "fill larger ones with --set clean.hole_limit_mm=MM");
    const std::vector<std::string> summary = summary_lines(report_);
    std::vector<std::string> unknown = to_lines(scan_.doubts);
    if (errors) {
      const std::vector<std::string> lines = to_lines(*errors);
      unknown.insert(unknown.end(), lines.begin(), lines.end());
    }
    const std::filesystem::path& output = request_.outputs.front();
    StagedOutputs staged;
    for (std::size_t k = 0; k < stretches.size(); ++k) {
      const std::filesystem::path file = stretches.size() == 1
                                             ? output
                                             : output.parent_path() / fmt::format("{}-{}{}", output.stem().string(),
                                                                                  k + 1, output.extension().string());
      clock_.tell(file.filename().string());
      report_.outputs.push_back(write(stretches[k], file, staged.place(file), summary, unknown));
    }
    staged.commit();
  }

  /// Where the surface ends, and goes on.
  void tell_gaps(const std::vector<TileRange>& gaps) {
    constexpr std::size_t kMostTold = 10;
    if (gaps.empty()) return;
    std::string where;
    for (std::size_t k = 0; k < std::min(kMostTold, gaps.size()); ++k)
      where += fmt::format("{}{} to {:.3f} m", k > 0 ? ", " : "", place_of(plan_.along(gaps[k].from)),
                           plan_.band.from + plan_.along(gaps[k].to) - u_zero_);
    report_.warnings.push_back(
        fmt::format("surface_gaps: holes of more than {:.1f} mm stay open, and the surface has no part there: {}{}; "
                    "clean.hole_limit_mm says which are filled",
                    kMilli * plan_.usual.limit, where,
                    gaps.size() > kMostTold ? fmt::format(" and at {} more places", gaps.size() - kMostTold) : ""));
  }

  io::ImportReport::Output write(Stretch& stretch, const std::filesystem::path& file,
                                 const std::filesystem::path& place, const std::vector<std::string>& summary,
                                 const std::vector<std::string>& unknown) {
    io::ImportReport::Output out;
    out.file = file.filename().string();
    out.kind = "slices";
    SliceSet& slices = stretch.slices;
    slices.body = Body::rail;
    slices.name = "scanned rail";
    for (double& u : slices.u) u += plan_.band.from - u_zero_;
    out.details = fmt::format("{} slices of {} points", slices.u.size(), slices.profiles.front().y.size());
    naming(file, place, [&] { out.bytes = io::write_slices(place, slices, summary, unknown); });
    out.sha256 = io::sha256_file(place);
    slices = {};
    io::SurfaceSource source;
    source.geometry = io::GeometryFile{place, {}};
    source.where = {place.string(), 0, 0};
    const NaturalSurface back = naming(file, place, [&] { return read_surface(source, Body::rail, 0.0); });
    check(stretch, *back.surface, file, out);
    return out;
  }

  /// Holds what was written against what was fitted.
  void check(const Stretch& stretch, const Surface& surface, const std::filesystem::path& file,
             io::ImportReport::Output& out) const {
    const std::size_t count = stretch.checks.size() / 4;
    std::vector<double> off(count, 0.0);
    parallel_for(count, [&](std::size_t k) {
      const double* const at = stretch.checks.data() + 4 * k;
      const Pose X_SP = natural_plane(Body::rail, plan_.band.from + at[0] - u_zero_);
      off[k] = height_at(surface, X_SP * Pose{Vec3(0.0, at[1], at[2]), rotation_x(at[3])}, Vec2::Zero());
    });
    double square = 0.0;
    for (std::size_t k = 0; k < count; ++k) {
      // no height at all is as far off as can be
      const double d = std::isnan(off[k]) ? kInfinity : std::fabs(off[k]);
      square += d * d;
      if (kMicro * d > settings_.fit.written_um)
        throw Error(ErrorKind::input_data,
                    fmt::format("slices read again lie {:.3g} mm beside the fitted surface at {}, more than {:g} um",
                                kMilli * d, place_of(stretch.checks[4 * k]), settings_.fit.written_um),
                    {file.string()}, "lower fit.resolution_mm, or raise fit.written_um if that is near enough");
      out.height_max = std::max(out.height_max, d);
    }
    if (count > 0) out.height_rms = std::sqrt(square / static_cast<double>(count));
  }

  const ImportRequest& request_;
  const io::ImportSettings& settings_;
  const Progress& progress_;
  io::ImportReport report_;
  StepClock clock_;
  PlacedScan scan_;
  TilePlan plan_;
  double u_zero_ = 0.0;
};

/// Why a scan cannot go by tiles; empty: it can.
std::string not_by_tiles(const ImportRequest& request) {
  if (body_of(request) != Body::rail) return "only rails are imported tile by tile";
  if (request.outputs.size() != 1 || !io::is_slices_file(request.outputs.front()))
    return "tiles become slices: one output *.slcs";
  if (!request.truth.empty()) return "with --truth all points are needed at once";
  if (request.settings.scan.register_mm > 0.0) return "scans are laid on each other (scan.register_mm) in memory only";
  if (request.settings.fit.sections == "keep")
    return "cross-sections are kept (fit.sections) of all points at once only";
  for (const std::filesystem::path& scan : request.scans)
    if (!io::is_scan_file(scan) || io::is_deviation_map(scan) || io::is_height_rows(scan))
      return fmt::format("{} holds no list of points", scan.filename().string());
  return {};
}

}  // namespace

bool goes_by_tiles(const ImportRequest& request) {
  const auto& tiles = request.settings.tiles;
  if (tiles.use == "never") return false;
  if (tiles.use == "always") {
    if (const std::string why = not_by_tiles(request); !why.empty())
      throw Error(ErrorKind::configuration, "tiles.use = always cannot be: " + why, {}, "say tiles.use=auto or never");
    return true;
  }
  double bytes = 0.0;
  for (const std::filesystem::path& scan : request.scans) {
    std::error_code missing;
    const auto size = std::filesystem::file_size(scan, missing);
    if (!missing) bytes += static_cast<double>(size);
  }
  constexpr double kMega = 1e6;
  return bytes > kMega * tiles.from_MB && not_by_tiles(request).empty();
}

std::filesystem::path unfinished_file(const ImportRequest& request) {
  std::filesystem::path file = request.outputs.empty() ? "import" : request.outputs.front();
  return file += ".unfinished";
}

io::ImportReport import_tiles(const ImportRequest& request, const Progress& progress) {
  return TiledImport(request, progress).import();
}

}  // namespace treadmark::app
