// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <algorithm>
#include <cmath>
#include <mutex>
#include <sstream>

#include <openvdb/io/Archive.h>
#include <openvdb/io/File.h>
#include <openvdb/openvdb.h>

#include "treadmark/backends/offset/openvdb/sheet_library.hpp"

namespace treadmark::offset {

namespace {

using Tree = openvdb::FloatTree;
using Leaf = Tree::LeafNodeType;
using openvdb::Coord;

void start_openvdb() {
  static std::once_flag once;
  std::call_once(once, [] { openvdb::initialize(); });
}

Coord folded(const BlockKey& key) { return {key.bi * kBlockI, key.bj * kBlockI, 0}; }

constexpr int kFarthest = 1 << 29;  ///< voxels from the origin

class Storage final : public SheetStorage {
 public:
  std::size_t insert(const BlockKey& key, const Block& values, float tolerance) override {
    const auto beyond = [tolerance](float v) { return std::fabs(v) > tolerance; };
    if (std::none_of(values.begin(), values.end(), beyond)) return 0;
    Leaf* leaf = tree_.touchLeaf(folded(key));
    std::size_t active = 0;
    for (openvdb::Index k = 0; k < values.size(); ++k) {
      if (!beyond(values[k])) continue;
      leaf->setValueOn(k, values[k]);
      ++active;
    }
    return active;
  }

  const float* block(const BlockKey& key) const override {
    const Leaf* leaf = tree_.probeConstLeaf(folded(key));
    return leaf == nullptr ? nullptr : leaf->buffer().data();
  }

  std::vector<SheetEntry> blocks() const override {
    std::vector<SheetEntry> all;
    for (auto leaf = tree_.cbeginLeaf(); leaf; ++leaf)
      all.push_back({{leaf->origin().x() >> 3, leaf->origin().y() >> 3}, leaf->buffer().data()});
    std::sort(all.begin(), all.end(), [](const SheetEntry& a, const SheetEntry& b) { return a.key < b.key; });
    return all;
  }

  std::size_t active_count() const override { return tree_.activeVoxelCount(); }
  std::size_t memory_bytes() const override { return tree_.memUsage(); }

 private:
  Tree tree_{0.0f};
};

std::unique_ptr<SheetStorage> make_storage() {
  start_openvdb();
  return std::make_unique<Storage>();
}

/// What openvdb::io::File writes, into a stream.
struct InMemory : openvdb::io::Archive {
  void write(std::ostream& to, const openvdb::GridCPtrVec& grids) const { Archive::write(to, grids, true); }
};

SheetFault write_sheet(std::string& bytes, const std::vector<SheetEntry>& blocks, const SheetFrameAndData& frame) {
  start_openvdb();
  const auto sheet = openvdb::FloatGrid::create(0.0f);
  sheet->setName(kGridName);
  sheet->setGridClass(openvdb::GRID_UNKNOWN);
  openvdb::math::Mat4d to_world = openvdb::math::Mat4d::identity();
  // The sheet's thickness means nothing; OpenVDB refuses transforms whose determinant is below 3e-15.
  constexpr double kThinnest = 1e-3;
  to_world.preScale(openvdb::Vec3d(frame.du, frame.dy, std::max(frame.dy, kThinnest)));
  to_world.postTranslate(openvdb::Vec3d(frame.u0, frame.y0, 0.0));
  try {
    sheet->setTransform(openvdb::math::Transform::createLinearTransform(to_world));
  } catch (const std::exception& e) {
    return {SheetFault::Kind::configuration,
            std::string("the steps of the offsets are too small for a VDB file: ") + e.what()};
  }
  for (const auto& [name, text] : frame.metadata) sheet->insertMeta(name, openvdb::StringMetadata(text));
  auto to = sheet->getAccessor();
  for (const SheetEntry& b : blocks)
    for (int k = 0; k < kBlockI * kBlockJ; ++k)
      if (b.values[k] != 0.0f)
        to.setValue({b.key.bi * kBlockI + (k >> 6), b.key.bj * kBlockJ + (k & 63), 0}, b.values[k]);
  try {
    std::ostringstream text(std::ios::binary);
    InMemory out;
    out.setCompression(openvdb::io::COMPRESS_ACTIVE_MASK);
    out.write(text, {sheet});
    bytes = std::move(text).str();
  } catch (const std::exception& e) {
    return {SheetFault::Kind::configuration, std::string("cannot write the offsets: ") + e.what()};
  }
  return {};
}

SheetFault read_sheet(const std::filesystem::path& file, SheetFrameAndData& result, std::map<BlockKey, Block>& blocks) {
  start_openvdb();
  const auto refuse = [](std::string why) -> SheetFault { return {SheetFault::Kind::input_data, std::move(why)}; };
  openvdb::FloatGrid::Ptr sheet;
  try {
    openvdb::io::File in(file.string());
    in.open(false);  // everything at once: no page of the file is read later
    if (!in.hasGrid(kGridName)) return refuse("the VDB file holds no grid of offsets");
    sheet = openvdb::gridPtrCast<openvdb::FloatGrid>(in.readGrid(kGridName));
    in.close();
  } catch (const std::exception& e) {
    return refuse(std::string("the VDB file cannot be read: ") + e.what());
  }
  if (!sheet) return refuse("the offsets of a VDB file must be single precision numbers");
  if (!sheet->transform().isLinear()) return refuse("the transform of the offsets must be linear");
  const auto affine = sheet->transform().baseMap()->getAffineMap();
  const openvdb::math::Mat4d m = affine->getMat4();
  result.du = m(0, 0), result.dy = m(1, 1), result.u0 = m(3, 0), result.y0 = m(3, 1);
  if (m(0, 1) != 0.0 || m(0, 2) != 0.0 || m(1, 0) != 0.0 || m(1, 2) != 0.0 || m(2, 0) != 0.0 || m(2, 1) != 0.0)
    return refuse("the transform of the offsets must not rotate or shear");
  if (!(result.du > 0.0) || !(result.dy > 0.0) || !std::isfinite(result.du + result.dy + result.u0 + result.y0))
    return refuse("the steps of the offsets must be positive");
  if (sheet->background() != 0.0f) return refuse("the background of the offsets must be 0");
  for (auto meta = sheet->beginMeta(); meta != sheet->endMeta(); ++meta)
    if (meta->second->typeName() == "string") result.metadata[meta->first] = meta->second->str();

  const openvdb::CoordBBox box = sheet->evalActiveVoxelBoundingBox();
  if (!box.empty() && (box.min().z() != 0 || box.max().z() != 0)) return refuse("the offsets must be a sheet at k = 0");
  if (!box.empty() &&
      (std::min(box.min().x(), box.min().y()) < -kFarthest || std::max(box.max().x(), box.max().y()) > kFarthest))
    return refuse("the offsets lie too far from the origin of their grid");
  for (auto v = sheet->cbeginValueOn(); v; ++v) {
    if (!v.isVoxelValue()) return refuse("the offsets must not contain tiles");
    if (!std::isfinite(*v)) return refuse("an offset is not a number");
    const Coord c = v.getCoord();
    Block& b = blocks.try_emplace(BlockKey{c.x() >> 3, c.y() >> 6}, Block{}).first->second;
    b[static_cast<std::size_t>(((c.x() & 7) << 6) | (c.y() & 63))] = *v;
  }
  return {};
}

}  // namespace

extern "C" const SheetLibrary* treadmark_sheet_library() {
  static const SheetLibrary library{TREADMARK_MODULE_VERSION, make_storage, write_sheet, read_sheet};
  return &library;
}

}  // namespace treadmark::offset
