// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "treadmark/backends/offset/openvdb/sheet_library.hpp"
#include "treadmark/backends/offset/sheet_grid.hpp"
#include "treadmark/core/check_point.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/core/platform/ranges.hpp"

// OpenVDB's own reader trusts the sizes in a file. This one reads trees of single and half precision numbers as
// OpenVDB's format versions from 222 on have them, takes nothing before it is there, and unpacks no more than the
// values of one leaf at a time. Memory is at most some 32 times the size of the file: that is what nodes without values
// take.

namespace treadmark::offset {

namespace {

constexpr int kFarthest = 1 << 29;                              ///< voxels from the origin
constexpr int kLeafSize = 8;                                    ///< voxels along an edge
constexpr std::uint32_t kZip = 1, kActiveMask = 2, kBlosc = 4;  ///< how values are packed

/// How a transform is stored: translation, scales, then numbers that follow from the scales.
struct StoredTransform {
  std::string_view name;
  bool translates, scales;
};
constexpr StoredTransform kTransforms[] = {{"ScaleMap", false, true},
                                           {"UniformScaleMap", false, true},
                                           {"ScaleTranslateMap", true, true},
                                           {"UniformScaleTranslateMap", true, true},
                                           {"TranslationMap", true, false}};

/// What the byte before the values of a node says.
struct StoredValues {
  unsigned char inactive_values;  ///< different ones
  bool selection;                 ///< a mask says where which of them is
  bool all;                       ///< no value is left out
};
constexpr StoredValues kStored[] = {{0, false, false}, {0, false, false}, {1, false, false}, {0, true, false},
                                    {1, true, false},  {2, true, false},  {0, false, true}};

std::size_t count_on(std::string_view mask) {
  std::size_t count = 0;
  for (const char byte : mask) count += static_cast<std::size_t>(std::popcount(static_cast<unsigned char>(byte)));
  return count;
}

template <class Visit>
void for_each_on(std::string_view mask, Visit visit) {
  for (std::size_t byte = 0; byte < mask.size(); ++byte)
    for (unsigned rest = static_cast<unsigned char>(mask[byte]); rest != 0; rest &= rest - 1)
      visit(8 * static_cast<unsigned>(byte) + static_cast<unsigned>(std::countr_zero(rest)));
}

/// The beginning of a name, which may be long, for a message.
std::string short_name(std::string name) {
  constexpr std::size_t kMost = 30;
  if (name.size() > kMost) name.replace(kMost, std::string::npos, "...");
  return name;
}

/// IEEE 754 half precision.
float from_half(std::uint16_t half) {
  const int exponent = half >> 10 & 31, fraction = half & 1023;
  constexpr int kBias = 15, kDigits = 10, kSpecial = 31;
  if (exponent == kSpecial) return std::numeric_limits<float>::quiet_NaN();
  const float size = exponent == 0 ? std::ldexp(static_cast<float>(fraction), 1 - kBias - kDigits)
                                   : std::ldexp(static_cast<float>(fraction + 1024), exponent - kBias - kDigits);
  return (half >> 15) != 0 ? -size : size;
}

class SheetReader {
 public:
  SheetReader(std::string_view data, const std::filesystem::path& file) : data_(data), file_(file) {}

  SheetFile read() {
    const std::uint32_t grids = head();
    std::optional<Descriptor> chosen;
    std::string others;  // what the first of them is
    for (std::uint32_t left = grids; left > 0; --left) {
      const Descriptor grid = descriptor(grids > 1);
      if (is_offsets(grid)) {
        if (chosen)
          refuse("the VDB file holds several grids of offsets: " + chosen->title() + " and " + grid.title(),
                 "keep one of them");
        chosen = grid;
      } else if (others.empty()) {
        others = what_is(grid);
      }
      at_ = grid.end;
    }
    if (at_ != data_.size()) damaged();
    if (!chosen)
      refuse(fmt::format("the VDB file holds no grid of offsets, but {}{}", others,
                         grids > 1 ? fmt::format(" and {} more", grids - 1) : ""));
    return sheet_of(*chosen);
  }

 private:
  using Voxel = std::array<std::int32_t, 3>;
  struct Leaf {
    Voxel origin;
    std::string_view active;
  };
  struct Values {
    std::string_view stored;  ///< packed or not
    std::size_t count = 0;
    bool all = false;     ///< else those of the active voxels
    bool packed = false;  ///< as the grid says
  };
  /// Where a grid lies in the file, and what its beginning says.
  struct Descriptor {
    std::string name, type;
    std::size_t begin = 0, end = 0;
    std::map<std::string, std::string> metadata;
    std::string title() const { return '\'' + short_name(name) + '\''; }
  };
  static constexpr const char* kWay = "offsets come from treadmark convert or import, as .vdb";

  [[noreturn]] void refuse(const std::string& why, const char* advice = kWay) const {
    throw Error(ErrorKind::input_data, why, {file_.string()}, advice);
  }
  [[noreturn]] void damaged() const { refuse("the VDB file cannot be read: its content contradicts itself"); }

  std::string_view take(std::uint64_t size) {
    if (size > data_.size() - at_) damaged();
    const std::string_view bytes = data_.substr(at_, static_cast<std::size_t>(size));
    at_ += bytes.size();
    return bytes;
  }
  template <class Number>
  Number number() {
    Number value;
    std::memcpy(&value, take(sizeof(value)).data(), sizeof(value));
    return value;
  }
  std::string_view text() { return take(number<std::uint32_t>()); }

  /// The number of grids.
  std::uint32_t head() {
    constexpr std::uint32_t kLeastVersion = 222;
    constexpr std::size_t kLibraryVersion = 8, kUuid = 36;
    take(sizeof(std::uint64_t));  // the mark of VDB files
    if (number<std::uint32_t>() < kLeastVersion) refuse("the VDB file is of an old version");
    take(kLibraryVersion);
    positions_ = number<std::uint8_t>() == 1;
    take(kUuid);
    metadata();
    const auto grids = number<std::uint32_t>();
    if (grids == 0) refuse("the VDB file holds no grid");
    return grids;
  }

  Descriptor descriptor(bool several) {
    Descriptor grid;
    grid.name = text();
    grid.name = grid.name.substr(0, grid.name.find('\x1e'));  // what tells namesakes apart
    grid.type = text();
    const bool instance = !text().empty();  // of a tree that is shared with another grid
    std::array<std::uint64_t, 3> at{};      // the grid, its values, its end
    for (std::uint64_t& position : at) position = number<std::uint64_t>();
    grid.begin = at_;
    grid.end = data_.size();
    if (positions_ && !(instance && at[2] == 0)) {
      if (at[0] != at_ || at[2] < at_ || at[2] > data_.size()) damaged();
      grid.end = static_cast<std::size_t>(at[2]);
    } else if (several) {
      refuse("the grids of the VDB file have no positions", "write them into a file, not into a stream");
    }
    if (instance) refuse("the grid " + grid.title() + " of the VDB file shares its values with another one");
    compression_ = number<std::uint32_t>();
    grid.metadata = metadata();
    return grid;
  }

  static bool is_offsets(const Descriptor& grid) {
    const auto format = grid.metadata.find("format");
    return grid.name == kGridName || (format != grid.metadata.end() && format->second == kOffsetFormat);
  }

  std::string what_is(const Descriptor& grid) const {
    const auto given = grid.metadata.find("class");
    const std::string kind = given == grid.metadata.end() ? "" : given->second;
    if (kind == "level set") return "a level set " + grid.title() + " (distances from a surface: make triangles of it)";
    if (kind == "fog volume") return "a fog volume " + grid.title() + " (densities in space: make triangles of it)";
    return "a grid " + grid.title() + " without the entries that say over which base its values lie";
  }

  SheetFile sheet_of(const Descriptor& grid) {
    if (const auto kind = grid.metadata.find("class"); kind != grid.metadata.end() && kind->second != "unknown")
      refuse(fmt::format("the grid {} of the VDB file is a {}, not offsets", grid.title(), short_name(kind->second)),
             "its class must be unknown");
    half_ = grid.type == "Tree_float_5_4_3_HalfFloat";
    if (!half_ && grid.type != "Tree_float_5_4_3")
      refuse(fmt::format("the offsets of a VDB file must be single or half precision numbers, not {}",
                         short_name(grid.type)));
    at_ = grid.begin;
    compression_ = number<std::uint32_t>();
    if (compression_ > (kZip | kActiveMask | kBlosc)) refuse("the VDB file is compressed in an unknown way");
    SheetFile sheet;
    sheet.metadata = metadata();
    transform(sheet);
    tree(sheet.grid);
    if (at_ != grid.end) damaged();
    return sheet;
  }

  std::map<std::string, std::string> metadata() {
    std::map<std::string, std::string> entries;
    for (std::uint32_t left = number<std::uint32_t>(); left > 0; --left) {
      const std::string_view name = text(), type = text(), value = text();
      if (type == "string") entries[std::string(name)] = value;
    }
    return entries;
  }

  void transform(SheetFile& sheet) {
    constexpr std::size_t kDerived = 12 * sizeof(double);
    const std::string_view name = text();
    std::array<double, 3> shift{}, scale{1.0, 1.0, 1.0};
    const auto read_three = [&](std::array<double, 3>& to) {
      for (double& x : to) x = number<double>();
    };
    if (name == "AffineMap") {
      for (int row = 0; row < 4; ++row)
        for (int column = 0; column < 4; ++column) {
          const double value = number<double>();
          if (column == 3) continue;
          if (row == 3)
            shift[static_cast<std::size_t>(column)] = value;
          else if (row == column)
            scale[static_cast<std::size_t>(row)] = value;
          else if (value != 0.0)
            refuse("the transform of the offsets must not rotate or shear");
        }
    } else {
      const auto* known = ranges::find(kTransforms, name, &StoredTransform::name);
      if (known == std::end(kTransforms)) refuse("the transform of the offsets must be linear");
      if (known->translates) read_three(shift);
      if (known->scales) {
        read_three(scale);
        take(kDerived);
      }
    }
    sheet.u0 = shift[0], sheet.y0 = shift[1], sheet.du = scale[0], sheet.dy = scale[1];
    if (!(sheet.du > 0.0) || !(sheet.dy > 0.0) || !std::isfinite(sheet.du + sheet.dy + sheet.u0 + sheet.y0))
      refuse("the steps of the offsets must be positive");
  }

  /// The nodes from the root to the leaves first, then the values of the leaves in the same order.
  void tree(SheetGrid& grid) {
    constexpr std::size_t kPlaceAndValue = 16;
    if (number<std::int32_t>() != 1) damaged();
    if (number<float>() != 0.0f) refuse("the background of the offsets must be 0");
    std::uint32_t tiles = number<std::uint32_t>(), children = number<std::uint32_t>();
    for (; tiles > 0; --tiles) {
      take(kPlaceAndValue);
      if (number<std::uint8_t>() != 0) refuse_tile();
    }
    for (; children > 0; --children) {
      Voxel origin;
      for (std::int32_t& x : origin) {
        x = number<std::int32_t>();
        if (x % (1 << (kTopNode.log2 + kTopNode.child_log2)) != 0) damaged();
        if (x < -2 * kFarthest || x >= 2 * kFarthest) refuse_far();
      }
      node(kTopNode, origin);
    }
    CheckPoint check;
    for (const Leaf& leaf : leaves_) {
      check.pass();
      fill(leaf, grid);
    }
  }

  [[noreturn]] void refuse_tile() const { refuse("the offsets must not contain tiles"); }
  [[noreturn]] void refuse_far() const { refuse("the offsets lie too far from the origin of their grid"); }

  /// A node with 2^log2 children along an edge, each of 2^child_log2 voxels.
  struct NodeSize {
    unsigned log2, child_log2;
  };
  static constexpr NodeSize kTopNode{5, 7}, kNode{4, 3};

  void node(NodeSize size, const Voxel& origin) {
    const std::size_t mask_bytes = (std::size_t{1} << (3 * size.log2)) / 8;
    const std::string_view children = take(mask_bytes), active = take(mask_bytes);
    if (count_on(active) > 0) refuse_tile();
    values(active);
    for_each_on(children, [&](unsigned n) {
      const unsigned last = (1u << size.log2) - 1;
      Voxel place = origin;
      for (unsigned axis = 0; axis < 3; ++axis)
        place[axis] += static_cast<std::int32_t>((n >> ((2 - axis) * size.log2) & last) << size.child_log2);
      if (size.log2 == kTopNode.log2)
        node(kNode, place);
      else
        leaves_.push_back({place, take(kLeafSize * kLeafSize)});
    });
  }

  Values values(std::string_view active) {
    const auto kind = number<std::uint8_t>();
    if (kind >= std::size(kStored)) damaged();
    const StoredValues& stored = kStored[kind];
    take(stored.inactive_values * sizeof(float));
    if (stored.selection) take(active.size());
    Values out;
    out.all = stored.all || (compression_ & kActiveMask) == 0;
    out.count = out.all ? 8 * active.size() : count_on(active);
    const std::size_t size = out.count * (half_ ? sizeof(std::uint16_t) : sizeof(float));
    if ((compression_ & (kZip | kBlosc)) == 0 || (half_ && out.count == 0)) {
      out.stored = take(size);
      return out;
    }
    const std::size_t before = at_;
    const auto length = number<std::int64_t>();  // not positive: not packed
    if (length == std::numeric_limits<std::int64_t>::min()) damaged();
    const std::string_view bytes = take(static_cast<std::uint64_t>(length > 0 ? length : -length));
    out.packed = length > 0;
    if (!out.packed && bytes.size() != size) damaged();
    if (out.packed && (compression_ & kBlosc) != 0) check_blosc(bytes, size);
    out.stored = out.packed ? data_.substr(before, at_ - before) : bytes;
    return out;
  }

  /// Its own head says the sizes again, which the library trusts.
  void check_blosc(std::string_view bytes, std::size_t size) const {
    constexpr std::size_t kHead = 16, kUnpacked = 4, kPacked = 12;
    if (bytes.size() < kHead) damaged();
    std::uint32_t unpacked = 0, packed = 0;
    std::memcpy(&unpacked, bytes.data() + kUnpacked, sizeof(unpacked));
    std::memcpy(&packed, bytes.data() + kPacked, sizeof(packed));
    if (unpacked != size || packed != bytes.size()) damaged();
  }

  /// The values of one leaf.
  std::vector<float> unpacked(const Values& values) const {
    const std::size_t size = values.count * (half_ ? sizeof(std::uint16_t) : sizeof(float));
    std::string bytes(size, '\0');
    if (!values.packed)
      bytes = values.stored;
    else if (!sheet_library().unpack((compression_ & kBlosc) != 0, values.stored, bytes.data(), size))
      damaged();
    std::vector<float> out(values.count);
    if (!half_) {
      std::memcpy(out.data(), bytes.data(), size);
      return out;
    }
    for (std::size_t i = 0; i < out.size(); ++i) {
      std::uint16_t half = 0;
      std::memcpy(&half, bytes.data() + i * sizeof(half), sizeof(half));
      out[i] = from_half(half);
    }
    return out;
  }

  void fill(const Leaf& leaf, SheetGrid& grid) {
    if (take(leaf.active.size()) != leaf.active) damaged();
    const Values stored = values(leaf.active);
    const std::vector<float> numbers = unpacked(stored);
    Block block{};
    std::size_t next = 0;
    for_each_on(leaf.active, [&](unsigned n) {
      const auto coordinate = [&](unsigned axis) {
        return leaf.origin[axis] + static_cast<std::int32_t>(n >> (3 * (2 - axis)) & (kLeafSize - 1));
      };
      const std::int32_t i = coordinate(0), j = coordinate(1);
      if (coordinate(2) != 0) refuse("the offsets must be a sheet at k = 0");
      if (std::min(i, j) < -kFarthest || std::max(i, j) > kFarthest) refuse_far();
      const float value = numbers[stored.all ? n : next++];
      if (!std::isfinite(value)) refuse("an offset is not a number");
      block[static_cast<std::size_t>((i & (kBlockI - 1)) * kBlockJ + (j & (kBlockJ - 1)))] = value;
    });
    grid.insert({leaf.origin[0] >> 3, leaf.origin[1] >> 6}, block, 0.0f);
  }

  std::string_view data_;
  const std::filesystem::path& file_;
  std::size_t at_ = 0;
  bool positions_ = false, half_ = false;
  std::uint32_t compression_ = 0;
  std::vector<Leaf> leaves_;
};

}  // namespace

SheetFile read_sheet(std::string_view data, const std::filesystem::path& file) {
  return SheetReader(data, file).read();
}

}  // namespace treadmark::offset
