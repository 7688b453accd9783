// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/scans/line/line_doubts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "treadmark/core/constants.hpp"
#include "treadmark/core/median.hpp"
#include "treadmark/core/to_whole.hpp"

namespace treadmark::scans {
namespace {

constexpr std::size_t kMostLooked = 400'000;

double share_of(std::vector<double>& values, double share) {
  const auto at = values.begin() + to_whole<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

/// "1.00 to 2.00 m, 5.00 to 6.50 m and 3 more places", from the beginning of the line.
template <class Part>
std::string places_of(const std::vector<Part>& parts, double begin) {
  constexpr std::size_t kMostTold = 3;
  std::string out;
  for (std::size_t k = 0; k < std::min(kMostTold, parts.size()); ++k)
    out += fmt::format("{}{:.2f} to {:.2f} m", k > 0 ? ", " : "", parts[k].from - begin, parts[k].to - begin);
  if (parts.size() > kMostTold) out += fmt::format(" and {} more places", parts.size() - kMostTold);
  return out;
}

std::optional<measured::Doubt> gaps_of(const FoundLine& found) {
  if (found.gaps.empty()) return std::nullopt;
  return measured::Doubt{
      "line_gap",
      fmt::format("nothing of the rail was scanned from {} of its line, which was taken on from both sides: "
                  "what lies behind may be shifted along it; scan these places, or cut the scan there",
                  places_of(found.gaps, found.line.from()))};
}

std::optional<measured::Doubt> kinks_of(const FoundLine& found) {
  if (found.kinks.empty()) return std::nullopt;
  const auto most = std::max_element(found.kinks.begin(), found.kinks.end(),
                                     [](const LineKink& a, const LineKink& b) { return a.off < b.off; });
  return measured::Doubt{
      "line_kink",
      fmt::format(
          "from {} of its line the rail lies off the smooth line that is followed, up to {:.3f} mm between "
          "{:.2f} and {:.2f} m: it bends more suddenly than {} there, as at a bent weld, or its section changes; "
          "that is left in the surface, and may be listed as damage",
          places_of(found.kinks, found.line.from()), kMilli * most->off, most->from - found.line.from(),
          most->to - found.line.from(),
          found.chosen > 0.0 ? fmt::format("splines of {:.2g} m follow", found.chosen) : std::string("evenly"))};
}

/// Behind a gap that is too long to be crossed, or where the rail could not be followed. straight: points along the
/// line, those that are kept.
std::optional<measured::Doubt> beyond_ends(std::span<const Vec3> straight, const RailLine& line) {
  constexpr double kShare = 0.02;  // of the points
  std::size_t beyond = 0;
  for (const Vec3& p : straight) beyond += p.x() < line.from() - kLeastGap || p.x() > line.to() + kLeastGap ? 1 : 0;
  if (beyond == 0 || static_cast<double>(beyond) < kShare * static_cast<double>(straight.size())) return std::nullopt;
  return measured::Doubt{
      "line_gap",
      fmt::format("{:.0f} % of the points lie beyond the ends of the {:.2f} m along which the rail could be followed: "
                  "nothing is known of its line there; scan what is missing between, or import the parts alone",
                  100.0 * static_cast<double>(beyond) / static_cast<double>(straight.size()), line.length())};
}

/// Something narrow beside the rail, about as high as its head.
struct RailBeside {
  double from = 0.0, to = 0.0;                        ///< along the line [m]
  double first = 0.0, last = 0.0;                     ///< how far to the right it lies at both ends [m]
  double nearest = 0.0, least = 0.0, greatest = 0.0;  ///< to the right; the nearest is the smallest without sign [m]
  std::size_t pieces = 0;
};

/// By pieces of the line and cells across. straight: as above.
std::vector<RailBeside> rails_beside(std::span<const Vec3> straight, const RailLine& line) {
  constexpr double kOwn = 0.1, kFrom = 0.25, kFarthest = 8.0, kCell = 20e-3;  // across [m]
  constexpr double kHigh = 0.1, kMoreBeside = 0.03;                           // up and down [m]
  constexpr double kPiece = 1.0, kFewestOwn = 200.0, kLeastPart = 0.1,
                   kWidest = 0.2;                  // [m]; points; of own points; [m]
  constexpr double kDrift = 0.15, kSkipped = 5.0;  // across for each metre along, more than switches do; [m]
  const auto is_high = [](const Vec3& p) { return std::fabs(p.z()) < kHigh + kMoreBeside * std::fabs(p.y()); };
  double own = 0.0;
  for (const Vec3& p : straight) own += std::fabs(p.y()) < kOwn && is_high(p) ? 1.0 : 0.0;
  if (!(own > kFewestOwn)) return {};
  const auto pieces = to_whole<std::size_t>(std::clamp(std::min(line.length() / kPiece, own / kFewestOwn), 1.0, 100e3));
  const double piece = line.length() / static_cast<double>(pieces), own_of_piece = own / static_cast<double>(pieces);
  const auto cells = to_whole<std::size_t>(2.0 * kFarthest / kCell);
  struct Cell {
    double points = 0.0, sum = 0.0;
  };
  std::map<std::size_t, std::map<std::size_t, Cell>> rows;  // by piece, then cell
  for (const Vec3& p : straight) {
    const double at = (p.x() - line.from()) / piece, across = (p.y() + kFarthest) / kCell;
    if (!(at >= 0.0 && at < static_cast<double>(pieces) && across >= 0.0 && across < static_cast<double>(cells)) ||
        std::fabs(p.y()) < kFrom || !is_high(p))
      continue;
    Cell& cell = rows[to_whole<std::size_t>(at)][to_whole<std::size_t>(across)];
    cell.points += 1.0, cell.sum += p.y();
  }
  std::vector<RailBeside> out;
  for (const auto& [number, row] : rows) {
    const double from = line.from() + piece * static_cast<double>(number);
    for (auto cell = row.begin(); cell != row.end();) {
      double points = 0.0, sum = 0.0;
      const std::size_t first = cell->first;
      std::size_t last = first;
      constexpr std::size_t kOpen = 2;  // cells without points do not part a head
      for (; cell != row.end() && cell->first <= last + kOpen; ++cell) {
        last = cell->first;
        points += cell->second.points, sum += cell->second.sum;
      }
      if (points < kLeastPart * own_of_piece || kCell * static_cast<double>(last + 1 - first) > kWidest) continue;
      const double across = sum / points;
      RailBeside* known = nullptr;
      for (RailBeside& one : out)
        if (from > one.from && from - one.to < kSkipped &&
            std::fabs(across - one.last) < kOwn + kDrift * (from + piece - one.to))
          known = &one;
      if (known == nullptr) known = &out.emplace_back(RailBeside{from, from, across, across, across, across, across});
      known->to = from + piece;
      known->last = across;
      if (std::fabs(across) < std::fabs(known->nearest)) known->nearest = across;
      known->least = std::min(known->least, across), known->greatest = std::max(known->greatest, across);
      ++known->pieces;
    }
  }
  const std::size_t fewest = std::min<std::size_t>(3, pieces);
  std::erase_if(out, [&](const RailBeside& one) { return one.pieces < fewest; });
  return out;
}

/// straight: as above.
std::optional<measured::Doubt> others_of(std::span<const Vec3> straight, const std::vector<RailBeside>& rails,
                                         double from) {
  if (!rails.empty()) {
    constexpr std::size_t kMostTold = 5;
    std::string places;
    for (std::size_t k = 0; k < std::min(kMostTold, rails.size()); ++k) {
      const double middle = 0.5 * (rails[k].first + rails[k].last);
      places += fmt::format("{}{:.2f} m to its {} from {:.2f} to {:.2f} m", k > 0 ? ", " : "", std::fabs(middle),
                            middle < 0.0 ? "left" : "right", rails[k].from - from, rails[k].to - from);
    }
    if (rails.size() > kMostTold) places += fmt::format(" and {} more", rails.size() - kMostTold);
    return measured::Doubt{
        "several_rails",
        fmt::format("beside this rail lie others, by place along its line: {}; they are left out: cut out one, say "
                    "which by placement.line, or import both rails of its track by scan.rails=both",
                    places)};
  }
  constexpr double kBeside = 0.25, kShare = 0.02;  // [m]; of the points
  std::vector<double> along, across;
  for (const Vec3& p : straight) {
    if (!(std::hypot(p.y(), p.z()) > kBeside)) continue;
    along.push_back(p.x() - from);
    across.push_back(p.y());
  }
  if (along.empty() || static_cast<double>(along.size()) < kShare * static_cast<double>(straight.size()))
    return std::nullopt;
  constexpr double kAlmostNone = 0.01, kAlmostAll = 0.99;
  const double beside = median_of(across);
  return measured::Doubt{
      "several_rails",
      fmt::format("{:.0f} % of the points lie beside this rail, usually {:.2f} m to its {}, from {:.2f} to {:.2f} m of "
                  "its line: they are left out; are there several rails or tracks in the scan? cut out one, or say "
                  "which by placement.line",
                  100.0 * static_cast<double>(along.size()) / static_cast<double>(straight.size()), std::fabs(beside),
                  beside < 0.0 ? "left" : "right", share_of(along, kAlmostNone), share_of(along, kAlmostAll))};
}

/// Rails that come near this one.
std::optional<measured::Doubt> switches_of(const std::vector<RailBeside>& rails, double from) {
  constexpr double kNear = 0.4, kMoves = 0.15;  // [m]
  std::string places;
  for (const RailBeside& one : rails)
    if (std::fabs(one.nearest) < kNear && one.greatest - one.least > kMoves) {
      const bool comes = std::fabs(one.last) < std::fabs(one.first);
      places += fmt::format("{}{} from {:.2f} to {:.2f} m, {:.2f} m to {:.2f} m to its {}", places.empty() ? "" : ", ",
                            comes ? "one comes nearer" : "one leaves it", one.from - from, one.to - from,
                            std::fabs(one.first), std::fabs(one.last), one.nearest < 0.0 ? "left" : "right");
    }
  if (places.empty()) return std::nullopt;
  return measured::Doubt{
      "switch",
      fmt::format("other rails meet this one, by place along its line: {}; is it a switch? where they are nearer than "
                  "0.25 m they count as points of this rail: cut the scan before it",
                  places)};
}

/// Of one pass, in the order of its points.
std::optional<measured::Doubt> backward(std::span<const double> along, double from, double length) {
  constexpr std::size_t kBlocks = 1000, kFewest = 50;
  constexpr double kNarrow = 0.2, kBack = 0.5;  // of the length; [m]
  const std::size_t size = std::max(kFewest, along.size() / kBlocks), blocks = along.size() / size;
  constexpr std::size_t kFewestBlocks = 8;
  if (blocks < kFewestBlocks) return std::nullopt;
  std::vector<double> middles, widths;
  for (std::size_t b = 0; b < blocks; ++b) {
    std::vector<double> block(along.begin() + static_cast<std::ptrdiff_t>(b * size),
                              along.begin() + static_cast<std::ptrdiff_t>((b + 1) * size));
    constexpr double kTenth = 0.1;
    widths.push_back(share_of(block, 1.0 - kTenth) - share_of(block, kTenth));
    middles.push_back(median_of(block));
  }
  // points in any order say nothing of runs
  if (median_of(widths) > kNarrow * length) return std::nullopt;
  std::size_t on = 0;
  for (std::size_t b = 1; b < blocks; ++b) on += middles[b] > middles[b - 1] ? 1 : 0;
  const double way = 2 * on >= blocks - 1 ? 1.0 : -1.0;
  double farthest = way * middles.front(), back = 0.0, low = 0.0, high = 0.0;
  for (const double middle : middles) {
    if (const double off = farthest - way * middle; off > std::max(kBack, back)) {
      back = off;
      low = way * middle;
      high = farthest;
    }
    farthest = std::max(farthest, way * middle);
  }
  if (!(back > 0.0)) return std::nullopt;
  const double one = way * low - from, other = way * high - from;
  return measured::Doubt{
      "backward_run",
      fmt::format("after {:.2f} m of the line the points go back to {:.2f} m, so that places between were scanned "
                  "twice: both are taken for one pass, and where they do not lie on each other noise is the larger; "
                  "number the passes, or cut one of them out",
                  other, one)};
}

}  // namespace

std::vector<measured::Doubt> line_doubts(std::span<const Vec3> points, std::span<const std::uint8_t> keep,
                                         std::span<const std::uint16_t> passes, const FoundLine& found) {
  std::vector<measured::Doubt> out;
  if (auto doubt = gaps_of(found)) out.push_back(*std::move(doubt));
  if (auto doubt = kinks_of(found)) out.push_back(*std::move(doubt));
  std::vector<Vec3> straight;
  std::vector<std::uint16_t> pass_of;
  const std::size_t stride = 1 + points.size() / kMostLooked;
  for (std::size_t i = 0; i < points.size(); i += stride) {
    if (!keep.empty() && keep[i] == 0) continue;
    straight.push_back(points[i]);
    pass_of.push_back(passes.empty() ? std::uint16_t{0} : passes[i]);
  }
  found.line.straighten(straight);
  if (auto doubt = beyond_ends(straight, found.line)) out.push_back(*std::move(doubt));
  const std::vector<RailBeside> rails = rails_beside(straight, found.line);
  if (auto doubt = others_of(straight, rails, found.line.from())) out.push_back(*std::move(doubt));
  if (auto doubt = switches_of(rails, found.line.from())) out.push_back(*std::move(doubt));
  std::map<std::uint16_t, std::vector<double>> along;
  for (std::size_t i = 0; i < straight.size(); ++i)
    if (std::hypot(straight[i].y(), straight[i].z()) < kLeastGap) along[pass_of[i]].push_back(straight[i].x());
  for (const auto& [pass, places] : along)
    if (auto doubt = backward(places, found.line.from(), found.line.length())) {
      out.push_back(*std::move(doubt));
      break;
    }
  return out;
}

}  // namespace treadmark::scans
