// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <vector>

#include "treadmark/backends/offset/sheet_grid.hpp"
#include "treadmark/core/check_point.hpp"
#include "treadmark/core/error.hpp"

// OpenVDB's own reader trusts the sizes in a file. This one reads what write_sheet writes, a tree of single precision
// numbers without compression but for inactive values (OpenVDB, format versions from 222 on), and takes nothing
// before it is there. Memory is at most some 32 times the size of the file: that is what nodes without values take.

namespace treadmark::offset {

namespace {

constexpr int kFarthest = 1 << 29;  ///< voxels from the origin
constexpr int kLeafSize = 8;        ///< voxels along an edge

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

class SheetReader {
 public:
  SheetReader(std::string_view data, const std::filesystem::path& file) : data_(data), file_(file) {}

  SheetFile read() {
    head();
    SheetFile sheet;
    sheet.metadata = metadata();
    transform(sheet);
    tree(sheet.grid);
    if (at_ != data_.size()) damaged();
    return sheet;
  }

 private:
  using Voxel = std::array<std::int32_t, 3>;
  struct Leaf {
    Voxel origin;
    std::string_view active;
  };
  struct Values {
    std::string_view bytes;
    bool all;  ///< else those of the active voxels
  };

  [[noreturn]] void refuse(const std::string& why) const {
    throw Error(ErrorKind::input_data, why, {file_.string()}, "offsets are read from files written by write_vdb");
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

  void head() {
    constexpr std::uint32_t kLeastVersion = 222, kActiveMask = 2;
    constexpr std::size_t kLibraryVersion = 8, kUuid = 36, kPositions = 24;
    take(sizeof(std::uint64_t));  // the mark of VDB files
    if (number<std::uint32_t>() < kLeastVersion) refuse("the VDB file is of an old version");
    take(kLibraryVersion);
    if (number<std::uint8_t>() != 1) damaged();  // whether grids have positions
    take(kUuid);
    metadata();
    if (number<std::uint32_t>() != 1 || text() != kGridName) refuse("the VDB file holds no grid of offsets");
    if (text() != "Tree_float_5_4_3") refuse("the offsets of a VDB file must be single precision numbers");
    if (!text().empty()) damaged();  // a tree that is shared with another grid
    take(kPositions);
    if (number<std::uint32_t>() != kActiveMask) refuse("the offsets of a VDB file must not be compressed");
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
      const auto* known = std::ranges::find(kTransforms, name, &StoredTransform::name);
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
    return {take(sizeof(float) * (stored.all ? 8 * active.size() : count_on(active))), stored.all};
  }

  void fill(const Leaf& leaf, SheetGrid& grid) {
    if (take(leaf.active.size()) != leaf.active) damaged();
    const Values stored = values(leaf.active);
    Block block{};
    std::size_t next = 0;
    for_each_on(leaf.active, [&](unsigned n) {
      const auto coordinate = [&](unsigned axis) {
        return leaf.origin[axis] + static_cast<std::int32_t>(n >> (3 * (2 - axis)) & (kLeafSize - 1));
      };
      const std::int32_t i = coordinate(0), j = coordinate(1);
      if (coordinate(2) != 0) refuse("the offsets must be a sheet at k = 0");
      if (std::min(i, j) < -kFarthest || std::max(i, j) > kFarthest) refuse_far();
      float value = 0.0f;
      std::memcpy(&value, stored.bytes.data() + sizeof(float) * (stored.all ? n : next++), sizeof(value));
      if (!std::isfinite(value)) refuse("an offset is not a number");
      block[static_cast<std::size_t>((i & (kBlockI - 1)) * kBlockJ + (j & (kBlockJ - 1)))] = value;
    });
    grid.insert({leaf.origin[0] >> 3, leaf.origin[1] >> 6}, block, 0.0f);
  }

  std::string_view data_;
  const std::filesystem::path& file_;
  std::size_t at_ = 0;
  std::vector<Leaf> leaves_;
};

}  // namespace

SheetFile read_sheet(std::string_view data, const std::filesystem::path& file) {
  return SheetReader(data, file).read();
}

}  // namespace treadmark::offset
