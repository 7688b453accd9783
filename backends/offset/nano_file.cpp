// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/backends/offset/nano_file.hpp"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <map>
#include <memory>
#include <string_view>
#include <utility>
#include <vector>

#include <nanovdb/NanoVDB.h>

#include "treadmark/backends/offset/coefficients.hpp"
#include "treadmark/backends/offset/file.hpp"
#include "treadmark/core/check_point.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/core/missing_file.hpp"

namespace treadmark::offset {

namespace {

namespace fs = std::filesystem;

using nanovdb::GridData;
using TreeData = nanovdb::TreeData<3>;
using Leaf = nanovdb::NanoLeaf<float>::DataType;
using Lower = nanovdb::NanoLower<float>::DataType;
using Upper = nanovdb::NanoUpper<float>::DataType;
using Root = nanovdb::NanoRoot<float>::DataType;
using Blind = nanovdb::GridBlindMetaData;

/// Grids of a file stand one after the other, each behind what is said of it and its name. The names are as long as
/// they are so that grids lie in the file as NanoVDB wants them in memory.
constexpr std::size_t kAligned = NANOVDB_DATA_ALIGNMENT, kSaid = 192, kName = 32, kHead = kSaid + kName;
constexpr char kOffsetsName[] = "treadmark_offsets_over_the_base", kCubicName[] = "treadmark_spline_coefficients_3";
static_assert(sizeof(kOffsetsName) == kName && sizeof(kCubicName) == kName && kHead % kAligned == 0);

/// A check sum over the file stands where NanoVDB leaves room in the first grid, and is 0 while it is made.
constexpr std::size_t kSumAt = kHead + offsetof(GridData, mData2);

/// Of NanoVDB, for its nodes.
struct alignas(kAligned) Piece {
  std::array<char, kAligned> bytes{};
};

class Buffer {
 public:
  explicit Buffer(std::size_t size) : pieces_(size / sizeof(Piece)) {}

  template <class T>
  T& at(std::size_t place) {
    return *reinterpret_cast<T*>(reinterpret_cast<char*>(pieces_.data()) + place);
  }
  const void* data() const { return pieces_.data(); }

 private:
  std::vector<Piece> pieces_;
};

/// Nodes by their first voxels, in units of their size, and their numbers.
using Nodes = std::map<std::pair<int, int>, std::size_t>;

std::size_t counted(Nodes& nodes) {
  std::size_t n = 0;
  for (auto& [place, number] : nodes) number = n++;
  return n;
}

constexpr int kLowerSize = nanovdb::NanoLower<float>::TOTAL, kUpperSize = nanovdb::NanoUpper<float>::TOTAL;

nanovdb::Coord first_voxel(const BlockKey& key) { return {key.bi * kBlockI, key.bj * kBlockI, 0}; }
std::pair<int, int> node_of(const nanovdb::Coord& voxel, int size) { return {voxel[0] >> size, voxel[1] >> size}; }

/// Appends what is said of a grid, the grid and, unless it is empty, a text.
void append_grid(std::string& to, const SheetGrid& sheet, const SheetFrame& frame, const char* name,
                 const std::string& text) {
  const std::vector<SheetEntry> blocks = sheet.blocks();
  Nodes uppers, lowers;
  for (const SheetEntry& b : blocks) {
    lowers[node_of(first_voxel(b.key), kLowerSize)] = 0;
    uppers[node_of(first_voxel(b.key), kUpperSize)] = 0;
  }
  std::size_t size = sizeof(GridData);
  const auto room = [&size](std::size_t bytes) {
    return std::exchange(size, size + (bytes + kAligned - 1) / kAligned * kAligned);
  };
  const std::size_t tree_at = room(sizeof(TreeData)), root_at = room(sizeof(Root)),
                    tiles_at = room(counted(uppers) * sizeof(Root::Tile)),
                    uppers_at = room(uppers.size() * sizeof(Upper)), lowers_at = room(counted(lowers) * sizeof(Lower)),
                    leaves_at = room(blocks.size() * sizeof(Leaf)), blind_at = room(text.empty() ? 0 : sizeof(Blind)),
                    text_at = room(text.size());
  Buffer buffer(size);
  const auto from = [](std::size_t here, std::size_t there) {
    return static_cast<std::int64_t>(there) - static_cast<std::int64_t>(here);
  };

  nanovdb::CoordBBox box;
  std::uint64_t active = 0;
  for (std::size_t n = 0; n < blocks.size(); ++n) {
    const nanovdb::Coord first = first_voxel(blocks[n].key);
    box.expand(first);
    box.expand(first + nanovdb::Coord(kBlockI - 1, kBlockI - 1, kBlockI - 1));
    const std::size_t leaf_at = leaves_at + n * sizeof(Leaf);
    Leaf& leaf = buffer.at<Leaf>(leaf_at);
    leaf.mBBoxMin = first;
    std::fill_n(leaf.mBBoxDif, 3, static_cast<std::uint8_t>(kBlockI - 1));
    leaf.mFlags = 2;  // has a box
    for (std::uint32_t k = 0; k < kBlockI * kBlockJ; ++k) {
      leaf.mValues[k] = blocks[n].values[k];
      if (leaf.mValues[k] == 0.0f) continue;
      leaf.mValueMask.setOn(k);
      ++active;
    }
    const std::size_t lower_at = lowers_at + lowers.at(node_of(first, kLowerSize)) * sizeof(Lower);
    const std::uint32_t slot = nanovdb::NanoLower<float>::CoordToOffset(first);
    Lower& lower = buffer.at<Lower>(lower_at);
    lower.mChildMask.setOn(slot);
    lower.mTable[slot].child = from(lower_at, leaf_at);
  }
  const auto box_of = [](const std::pair<int, int>& node, int bits) {
    const int last = (1 << bits) - 1;
    const nanovdb::Coord first(node.first << bits, node.second << bits, 0);
    return nanovdb::CoordBBox(first, first + nanovdb::Coord(last, last, last));
  };
  for (const auto& [node, number] : lowers) {
    const std::size_t lower_at = lowers_at + number * sizeof(Lower);
    Lower& lower = buffer.at<Lower>(lower_at);
    lower.mBBox = box_of(node, kLowerSize);
    const nanovdb::Coord first = lower.mBBox.min();
    const std::size_t upper_at = uppers_at + uppers.at(node_of(first, kUpperSize)) * sizeof(Upper);
    const std::uint32_t slot = nanovdb::NanoUpper<float>::CoordToOffset(first);
    Upper& upper = buffer.at<Upper>(upper_at);
    upper.mChildMask.setOn(slot);
    upper.mTable[slot].child = from(upper_at, lower_at);
  }
  for (const auto& [node, number] : uppers) {
    const std::size_t upper_at = uppers_at + number * sizeof(Upper);
    Upper& upper = buffer.at<Upper>(upper_at);
    upper.mBBox = box_of(node, kUpperSize);
    auto& tile = buffer.at<Root::Tile>(tiles_at + number * sizeof(Root::Tile));
    tile.key = Root::CoordToKey(upper.mBBox.min());
    tile.child = from(root_at, upper_at);
  }
  Root& root = buffer.at<Root>(root_at);
  root.mBBox = box;
  root.mTableSize = static_cast<std::uint32_t>(uppers.size());

  TreeData& tree = buffer.at<TreeData>(tree_at);
  const std::size_t begins[] = {leaves_at, lowers_at, uppers_at, root_at};
  for (std::size_t level = 0; level < 4; ++level) tree.mNodeOffset[level] = begins[level] - tree_at;
  const std::size_t counts[] = {blocks.size(), lowers.size(), uppers.size()};
  for (std::size_t level = 0; level < 3; ++level) tree.mNodeCount[level] = static_cast<std::uint32_t>(counts[level]);
  tree.mVoxelCount = active;

  auto& grid = buffer.at<GridData>(0);
  grid.mMagic = NANOVDB_MAGIC_NUMBER;
  grid.mChecksum = ~std::uint64_t{0};  // none: ours covers the whole file
  grid.mVersion = nanovdb::Version();
  grid.setBreadthFirstOn();
  grid.mGridCount = 1;
  grid.mGridSize = size;
  std::copy_n(name, kName, grid.mGridName);
  // j = 8 J + k: y is where the first voxel of the leaf's column lies, what is left of it stands along the third axis
  const double du = frame.du, dy = frame.dy, step = kBlockI * dy;
  const double to_world[3][3] = {{du, 0.0, 0.0}, {0.0, step, 0.0}, {0.0, 0.0, dy}},
               to_voxels[3][3] = {{1.0 / du, 0.0, 0.0}, {0.0, 1.0 / step, 0.0}, {0.0, 0.0, 1.0 / dy}};
  grid.mMap.set(to_world, to_voxels, nanovdb::Vec3d(frame.u0, frame.y0, 0.0), 1.0);
  grid.mVoxelSize = nanovdb::Vec3d(du, step, dy);
  if (!blocks.empty()) {
    const auto corner = [&](const nanovdb::Coord& c, int beyond) {
      return nanovdb::Vec3d(frame.u0 + du * (c[0] + beyond), frame.y0 + step * (c[1] + beyond), dy * (c[2] + beyond));
    };
    grid.mWorldBBox = nanovdb::BBox<nanovdb::Vec3d>(corner(box.min(), 0), corner(box.max(), 1));
  }
  grid.mGridType = nanovdb::GridType::Float;
  if (!text.empty()) {
    grid.mBlindMetadataOffset = from(0, blind_at);
    grid.mBlindMetadataCount = 1;
    Blind& blind = buffer.at<Blind>(blind_at);
    blind.mByteOffset = from(blind_at, text_at);
    blind.mElementCount = text.size();
    constexpr std::string_view kEntries = "entries";
    std::copy(kEntries.begin(), kEntries.end(), blind.mName);
    std::copy(text.begin(), text.end(), &buffer.at<char>(text_at));
  }
  struct {
    std::string& bytes;
    void write(const char* data, std::size_t count) { bytes.append(data, count); }
  } stream{to};
  nanovdb::io::writeUncompressedGrid(stream, buffer.data());
}

/// A file in memory.
class MappedFile {
 public:
  explicit MappedFile(const fs::path& file) {
    const int descriptor = ::open(file.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);  // pipes are refused
    struct stat about {};
    const bool there = descriptor >= 0 && ::fstat(descriptor, &about) == 0 && S_ISREG(about.st_mode);
    if (there && about.st_size > 0) {
      size_ = static_cast<std::size_t>(about.st_size);
      data_ = ::mmap(nullptr, size_, PROT_READ, MAP_PRIVATE, descriptor, 0);
    }
    if (descriptor >= 0) ::close(descriptor);
    if (!there || data_ == MAP_FAILED)
      throw Error(ErrorKind::input_data, "the NanoVDB file cannot be read", {file.string()});
  }
  MappedFile(const MappedFile&) = delete;
  MappedFile& operator=(const MappedFile&) = delete;
  ~MappedFile() {
    if (data_ != nullptr) ::munmap(data_, size_);
  }
  std::string_view bytes() const { return {static_cast<const char*>(data_), size_}; }

 private:
  void* data_ = nullptr;
  std::size_t size_ = 0;
};

/// Takes nothing that is not within the file.
class NanoReader {
 public:
  explicit NanoReader(const fs::path& file)
      : file_(file.string()), mapped_(std::make_shared<const MappedFile>(file)), bytes_(mapped_->bytes()) {}

  SheetFile read() {
    if (bytes_.empty()) refuse("the NanoVDB file is empty", "write it again");
    if (bytes_.size() < kHead + sizeof(GridData) + sizeof(TreeData) || !magic_at(0) || !magic_at(kHead))
      refuse("this is not a NanoVDB file as Treadmark writes them", kAdvice);
    if (bytes_.compare(kSaid, kName, {kOffsetsName, kName}) != 0)
      refuse("the NanoVDB file was not written by Treadmark", kAdvice);
    if (reinterpret_cast<const GridData*>(bytes_.data() + kHead)->mVersion.getMajor() != NANOVDB_MAJOR_VERSION_NUMBER)
      refuse("the NanoVDB file is of another version", kAdvice);
    check_sum();
    SheetFile sheet;
    std::size_t at = 0;
    const GridData& first = next_grid(at, kOffsetsName);
    sheet.u0 = first.mMap.mVecD[0], sheet.y0 = first.mMap.mVecD[1];
    sheet.du = first.mMap.mMatD[0], sheet.dy = first.mMap.mMatD[4] / kBlockI;
    sheet.metadata = entries_of(first);
    sheet.grid = SheetGrid(mapped_, blocks_of(first));
    sheet.cubic.emplace(mapped_, blocks_of(next_grid(at, kCubicName)));
    if (at != bytes_.size()) damaged();
    return sheet;
  }

 private:
  static constexpr const char* kAdvice = "make it of a .vdb file: treadmark convert";

  [[noreturn]] void refuse(const char* why, const char* advice) const {
    throw Error(ErrorKind::input_data, why, {file_}, advice);
  }
  [[noreturn]] void damaged() const { refuse("the NanoVDB file is damaged", "write or copy it again"); }
  bool magic_at(std::size_t at) const {
    std::uint64_t number = 0;
    std::memcpy(&number, bytes_.data() + at, sizeof(number));
    return number == NANOVDB_MAGIC_NUMBER;
  }
  void check_sum() const {
    std::uint64_t given = 0;
    std::memcpy(&given, bytes_.data() + kSumAt, sizeof(given));
    constexpr std::array<char, sizeof(given)> kZeros{};
    const std::size_t behind = kSumAt + sizeof(given);
    std::uint64_t sum = sum_of(bytes_.data(), kSumAt);
    sum = sum_of(kZeros.data(), kZeros.size(), sum);
    if (given != sum_of(bytes_.data() + behind, bytes_.size() - behind, sum)) damaged();
  }

  /// What lies at a place of a grid, count of them.
  template <class T>
  const T* within(const GridData& grid, std::uint64_t place, std::uint64_t count) const {
    if (place % alignof(T) != 0 || place > grid.mGridSize || count > (grid.mGridSize - place) / sizeof(T)) damaged();
    return reinterpret_cast<const T*>(reinterpret_cast<const char*>(&grid) + place);
  }

  const GridData& next_grid(std::size_t& at, const char* name) const {
    const std::size_t left = bytes_.size() - at;
    if (at % kAligned != 0 || left < kHead + sizeof(GridData) + sizeof(TreeData) || !magic_at(at)) damaged();
    const auto& grid = *reinterpret_cast<const GridData*>(bytes_.data() + at + kHead);
    if (grid.mMagic != NANOVDB_MAGIC_NUMBER || std::memcmp(grid.mGridName, name, kName) != 0 ||
        grid.mGridType != nanovdb::GridType::Float || grid.mGridSize > left - kHead ||
        grid.mGridSize < sizeof(GridData) + sizeof(TreeData))
      damaged();
    at += kHead + grid.mGridSize;
    return grid;
  }

  std::vector<SheetEntry> blocks_of(const GridData& grid) const {
    constexpr int kFarthest = 1 << 29;  // voxels from the origin
    const TreeData& tree = *within<TreeData>(grid, sizeof(GridData), 1);
    const std::uint64_t begin = tree.mNodeOffset[0] + sizeof(GridData), count = tree.mNodeCount[0];
    if (begin < sizeof(GridData)) damaged();
    const Leaf* const leaves = within<Leaf>(grid, begin, count);
    std::vector<SheetEntry> blocks;
    blocks.reserve(count);
    CheckPoint check;
    for (std::uint64_t n = 0; n < count; ++n) {
      check.pass();
      const nanovdb::Coord& first = leaves[n].mBBoxMin;
      if (first[0] % kBlockI != 0 || first[1] % kBlockI != 0 || first[2] != 0) damaged();
      if (first[0] < -kFarthest || first[0] > kFarthest) damaged();
      if (first[1] < -kFarthest / kBlockI || first[1] > kFarthest / kBlockI) damaged();
      const SheetEntry entry{{first[0] / kBlockI, first[1] / kBlockI}, leaves[n].mValues};
      if (!blocks.empty() && !(blocks.back().key < entry.key)) damaged();
      if (!std::all_of(entry.values, entry.values + kBlockI * kBlockJ, [](float v) { return std::isfinite(v); }))
        damaged();
      blocks.push_back(entry);
    }
    return blocks;
  }

  Metadata entries_of(const GridData& grid) const {
    if (grid.mBlindMetadataCount != 1) damaged();
    const auto place = static_cast<std::uint64_t>(grid.mBlindMetadataOffset);
    const Blind& blind = *within<Blind>(grid, place, 1);
    std::string_view text(
        within<char>(grid, place + static_cast<std::uint64_t>(blind.mByteOffset), blind.mElementCount),
        static_cast<std::size_t>(blind.mElementCount));
    const auto word = [&] {
      const std::size_t end = text.find('\0');
      if (end == std::string_view::npos) damaged();
      const std::string_view out = text.substr(0, end);
      text.remove_prefix(end + 1);
      return std::string(out);
    };
    Metadata entries;
    while (!text.empty()) {
      std::string name = word();
      entries[std::move(name)] = word();
    }
    return entries;
  }

  std::string file_;
  std::shared_ptr<const MappedFile> mapped_;
  std::string_view bytes_;
};

}  // namespace

std::string nano_bytes(const SparseOffsets& offsets, const Metadata& entries) {
  std::string text, bytes;
  for (const auto& [name, entry] : entries) {
    text += name + '\0';
    text += entry + '\0';
  }
  append_grid(bytes, offsets.grid, offsets.frame, kOffsetsName, text);
  const SheetGrid cubic = spline_coefficients(offsets, 3, smallest_coefficient(offsets));
  append_grid(bytes, cubic, offsets.frame, kCubicName, {});
  const std::uint64_t sum = sum_of(bytes.data(), bytes.size());
  std::memcpy(bytes.data() + kSumAt, &sum, sizeof(sum));
  return bytes;
}

SheetFile read_nano(const fs::path& file) {
  require_file(file, "NanoVDB file", ErrorKind::input_data);
  return NanoReader(file).read();
}

}  // namespace treadmark::offset
