// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace treadmark::offset {

/// The bytes of a VDB file, without the check sum that write_vdb adds. Errors: Error(input_data) for a file that is
/// missing, empty, damaged or no VDB file.
std::vector<char> vdb_bytes(const std::filesystem::path& file);

/// The beginning of a name, which may be long, for a message.
std::string short_name(std::string name);

/// Reads trees of single and half precision numbers as OpenVDB's format versions from 222 on have them. OpenVDB's own
/// reader trusts the sizes in a file; this one takes nothing before it is there, and unpacks no more than the values of
/// one leaf at a time. Memory is at most some 32 times the size of the file: that is what nodes without values take.
class VdbTreeReader {
 public:
  virtual ~VdbTreeReader() = default;

 protected:
  using Voxel = std::array<std::int32_t, 3>;
  static constexpr int kFarthest = 1 << 29;  ///< voxels from the origin
  static constexpr int kLeafSize = 8;        ///< voxels along an edge

  /// Where a grid lies in the file, and what its beginning says.
  struct Descriptor {
    std::string name, type;
    std::size_t begin = 0, end = 0;
    std::map<std::string, std::string> metadata;
    std::string title() const { return '\'' + short_name(name) + '\''; }
    /// What it calls itself; empty: nothing.
    std::string kind() const {
      const auto given = metadata.find("class");
      return given == metadata.end() ? std::string() : given->second;
    }
  };
  struct Leaf {
    Voxel origin{};
    std::string_view active;    ///< bits, [64 i + 8 j + k]
    std::vector<float> values;  ///< of all voxels, or of the active ones
    bool all = false;
  };
  /// voxel . matrix + shift = world, rows as in the file.
  struct Transform {
    std::array<std::array<double, 3>, 3> matrix{{{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}}};
    std::array<double, 3> shift{};
  };

  /// what: the values, in messages: "the offsets"; advice: where such files come from.
  VdbTreeReader(std::string_view data, const std::filesystem::path& file, std::string what, std::string advice)
      : data_(data), file_(file), what_(std::move(what)), advice_(std::move(advice)) {}

  [[noreturn]] void refuse(const std::string& why, const std::string& advice) const;
  [[noreturn]] void refuse(const std::string& why) const { refuse(why, advice_); }
  [[noreturn]] void damaged() const;
  [[noreturn]] void refuse_far() const;

  /// All grids of the file.
  std::vector<Descriptor> grids();
  /// A grid that is none of those wanted, in words.
  static std::string what_is(const Descriptor& grid);
  /// The transform and the tree of a grid. Its leaves go to take_leaf.
  void read_grid(const Descriptor& grid);

  const std::map<std::string, std::string>& metadata_of_grid() const { return metadata_; }

  /// May refuse.
  virtual void take_transform(const Transform& transform) = 0;
  virtual void take_background(float background) = 0;
  virtual void take_leaf(const Leaf& leaf) = 0;

  /// visit(index of a voxel) for each bit that is set.
  template <class Visit>
  static void for_each_on(std::string_view mask, Visit visit) {
    for (std::size_t byte = 0; byte < mask.size(); ++byte)
      for (unsigned rest = static_cast<unsigned char>(mask[byte]); rest != 0; rest &= rest - 1)
        visit(8 * static_cast<unsigned>(byte) + static_cast<unsigned>(std::countr_zero(rest)));
  }

 private:
  struct Place {
    Voxel origin{};
    std::string_view active;
  };
  struct Values {
    std::string_view stored;  ///< packed or not
    std::size_t count = 0;
    bool all = false;     ///< else those of the active voxels
    bool packed = false;  ///< as the grid says
  };
  /// A node with 2^log2 children along an edge, each of 2^child_log2 voxels.
  struct NodeSize {
    unsigned log2, child_log2;
  };
  static constexpr NodeSize kTopNode{5, 7}, kNode{4, 3};

  std::string_view take(std::uint64_t size);
  template <class Number>
  Number number() {
    Number value;
    std::memcpy(&value, take(sizeof(value)).data(), sizeof(value));
    return value;
  }
  std::string_view text() { return take(number<std::uint32_t>()); }
  std::uint32_t head();
  Descriptor descriptor(bool several);
  std::map<std::string, std::string> metadata();
  Transform transform();
  void tree();
  [[noreturn]] void refuse_tile() const;
  void node(NodeSize size, const Voxel& origin);
  Values values(std::string_view active);
  void check_blosc(std::string_view bytes, std::size_t size) const;
  std::vector<float> unpacked(const Values& values) const;

  std::string_view data_;
  const std::filesystem::path& file_;
  std::string what_, advice_;
  std::size_t at_ = 0;
  bool positions_ = false, half_ = false;
  std::uint32_t compression_ = 0;
  std::map<std::string, std::string> metadata_;
  std::vector<Place> leaves_;
};

}  // namespace treadmark::offset
