// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/backends/offset/vdb_tree_reader.hpp"

#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "treadmark/backends/offset/openvdb/sheet_library.hpp"
#include "treadmark/core/check_point.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/core/platform/ranges.hpp"

namespace treadmark::offset {

namespace {

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

/// IEEE 754 half precision.
float from_half(std::uint16_t half) {
  const int exponent = half >> 10 & 31, fraction = half & 1023;
  constexpr int kBias = 15, kDigits = 10, kSpecial = 31;
  if (exponent == kSpecial) return std::numeric_limits<float>::quiet_NaN();
  const float size = exponent == 0 ? std::ldexp(static_cast<float>(fraction), 1 - kBias - kDigits)
                                   : std::ldexp(static_cast<float>(fraction + 1024), exponent - kBias - kDigits);
  return (half >> 15) != 0 ? -size : size;
}

}  // namespace

std::string short_name(std::string name) {
  constexpr std::size_t kMost = 30;
  if (name.size() > kMost) name.replace(kMost, std::string::npos, "...");
  return name;
}

void VdbTreeReader::refuse(const std::string& why, const std::string& advice) const {
  throw Error(ErrorKind::input_data, why, {file_.string()}, advice);
}

void VdbTreeReader::damaged() const { refuse("the VDB file cannot be read: its content contradicts itself"); }
void VdbTreeReader::refuse_tile() const { refuse(what_ + " must not contain tiles"); }
void VdbTreeReader::refuse_far() const { refuse(what_ + " lie too far from the origin of their grid"); }

std::string_view VdbTreeReader::take(std::uint64_t size) {
  if (size > data_.size() - at_) damaged();
  const std::string_view bytes = data_.substr(at_, static_cast<std::size_t>(size));
  at_ += bytes.size();
  return bytes;
}

std::vector<VdbTreeReader::Descriptor> VdbTreeReader::grids() {
  std::vector<Descriptor> all;
  const std::uint32_t count = head();
  for (std::uint32_t left = count; left > 0; --left) {
    all.push_back(descriptor(count > 1));
    at_ = all.back().end;
  }
  if (at_ != data_.size()) damaged();
  return all;
}

/// The number of grids.
std::uint32_t VdbTreeReader::head() {
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

VdbTreeReader::Descriptor VdbTreeReader::descriptor(bool several) {
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

std::string VdbTreeReader::what_is(const Descriptor& grid) {
  const std::string kind = grid.kind();
  if (kind == "level set")
    return "a level set " + grid.title() + " (distances from a surface: cases take it in shape.solids)";
  if (kind == "fog volume") return "a fog volume " + grid.title() + " (densities in space: make triangles of it)";
  return "a grid " + grid.title() + " without the entries that say over which base its values lie";
}

void VdbTreeReader::read_grid(const Descriptor& grid) {
  half_ = grid.type == "Tree_float_5_4_3_HalfFloat";
  if (!half_ && grid.type != "Tree_float_5_4_3")
    refuse(
        fmt::format("{} of a VDB file must be single or half precision numbers, not {}", what_, short_name(grid.type)));
  at_ = grid.begin;
  compression_ = number<std::uint32_t>();
  if (compression_ > (kZip | kActiveMask | kBlosc)) refuse("the VDB file is compressed in an unknown way");
  metadata_ = metadata();
  take_transform(transform());
  tree();
  if (at_ != grid.end) damaged();
}

std::map<std::string, std::string> VdbTreeReader::metadata() {
  std::map<std::string, std::string> entries;
  for (std::uint32_t left = number<std::uint32_t>(); left > 0; --left) {
    const std::string_view name = text(), type = text(), value = text();
    if (type == "string") entries[std::string(name)] = value;
  }
  return entries;
}

VdbTreeReader::Transform VdbTreeReader::transform() {
  constexpr std::size_t kDerived = 12 * sizeof(double);
  const std::string_view name = text();
  Transform out;
  if (name == "AffineMap" || name == "UnitaryMap") {
    for (std::size_t row = 0; row < 4; ++row)
      for (std::size_t column = 0; column < 4; ++column) {
        const double value = number<double>();
        if (column < 3) (row < 3 ? out.matrix[row] : out.shift)[column] = value;
      }
    return out;
  }
  const auto* known = ranges::find(kTransforms, name, &StoredTransform::name);
  if (known == std::end(kTransforms)) refuse("the transform of " + what_ + " must be linear");
  if (known->translates)
    for (double& x : out.shift) x = number<double>();
  if (known->scales) {
    for (std::size_t axis = 0; axis < 3; ++axis) out.matrix[axis][axis] = number<double>();
    take(kDerived);
  }
  return out;
}

/// The nodes from the root to the leaves first, then the values of the leaves in the same order.
void VdbTreeReader::tree() {
  constexpr std::size_t kPlaceAndValue = 16;
  if (number<std::int32_t>() != 1) damaged();
  take_background(number<float>());
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
  for (const Place& place : leaves_) {
    check.pass();
    if (take(place.active.size()) != place.active) damaged();
    const Values stored = values(place.active);
    take_leaf({place.origin, place.active, unpacked(stored), stored.all});
  }
}

void VdbTreeReader::node(NodeSize size, const Voxel& origin) {
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

VdbTreeReader::Values VdbTreeReader::values(std::string_view active) {
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
void VdbTreeReader::check_blosc(std::string_view bytes, std::size_t size) const {
  constexpr std::size_t kHead = 16, kUnpacked = 4, kPacked = 12;
  if (bytes.size() < kHead) damaged();
  std::uint32_t unpacked = 0, packed = 0;
  std::memcpy(&unpacked, bytes.data() + kUnpacked, sizeof(unpacked));
  std::memcpy(&packed, bytes.data() + kPacked, sizeof(packed));
  if (unpacked != size || packed != bytes.size()) damaged();
}

/// The values of one leaf.
std::vector<float> VdbTreeReader::unpacked(const Values& values) const {
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

}  // namespace treadmark::offset
