// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/backends/offset/sheet_grid.hpp"

#include <algorithm>
#include <cmath>
#include <mutex>

#include <openvdb/io/File.h>
#include <openvdb/openvdb.h>

#include "treadmark/core/error.hpp"

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

}  // namespace

struct SheetGrid::Storage {
  Tree tree{0.0f};
};

SheetGrid::SheetGrid() {
  start_openvdb();
  storage_ = std::make_unique<Storage>();
}
SheetGrid::~SheetGrid() = default;
SheetGrid::SheetGrid(SheetGrid&&) noexcept = default;
SheetGrid& SheetGrid::operator=(SheetGrid&&) noexcept = default;

std::size_t SheetGrid::insert(const BlockKey& key, const Block& values, float tolerance) {
  const auto beyond = [tolerance](float v) { return std::fabs(v) > tolerance; };
  if (std::none_of(values.begin(), values.end(), beyond)) return 0;
  Leaf* leaf = storage_->tree.touchLeaf(folded(key));
  std::size_t active = 0;
  for (openvdb::Index k = 0; k < values.size(); ++k) {
    if (!beyond(values[k])) continue;
    leaf->setValueOn(k, values[k]);
    ++active;
  }
  return active;
}

const float* SheetGrid::block(const BlockKey& key) const {
  const Leaf* leaf = storage_->tree.probeConstLeaf(folded(key));
  return leaf == nullptr ? nullptr : leaf->buffer().data();
}

std::vector<SheetGrid::Entry> SheetGrid::blocks() const {
  std::vector<Entry> all;
  for (auto leaf = storage_->tree.cbeginLeaf(); leaf; ++leaf)
    all.push_back({{leaf->origin().x() >> 3, leaf->origin().y() >> 3}, leaf->buffer().data()});
  std::sort(all.begin(), all.end(), [](const Entry& a, const Entry& b) { return a.key < b.key; });
  return all;
}

std::size_t SheetGrid::active_count() const { return storage_->tree.activeVoxelCount(); }

std::size_t SheetGrid::memory_bytes() const { return storage_->tree.memUsage(); }

void write_sheet(const std::filesystem::path& file, const SheetGrid& grid, const SheetFile& frame) {
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
    throw Error(ErrorKind::configuration,
                std::string("the steps of the offsets are too small for a VDB file: ") + e.what(), {file.string()});
  }
  for (const auto& [name, text] : frame.metadata) sheet->insertMeta(name, openvdb::StringMetadata(text));
  auto to = sheet->getAccessor();
  for (const SheetGrid::Entry& b : grid.blocks())
    for (int k = 0; k < kBlockI * kBlockJ; ++k)
      if (b.values[k] != 0.0f)
        to.setValue({b.key.bi * kBlockI + (k >> 6), b.key.bj * kBlockJ + (k & 63), 0}, b.values[k]);
  try {
    openvdb::io::File out(file.string());
    out.setCompression(openvdb::io::COMPRESS_ACTIVE_MASK);
    out.write({sheet});
    out.close();
  } catch (const std::exception& e) {
    throw Error(ErrorKind::configuration, std::string("cannot write the offsets: ") + e.what(), {file.string()});
  }
}

SheetFile read_sheet(const std::filesystem::path& file) {
  start_openvdb();
  const auto refuse = [&](const std::string& why) -> Error { return {ErrorKind::input_data, why, {file.string()}}; };
  openvdb::FloatGrid::Ptr sheet;
  try {
    openvdb::io::File in(file.string());
    in.open(false);  // everything at once: no page of the file is read later
    if (!in.hasGrid(kGridName)) throw refuse("the VDB file holds no grid of offsets");
    sheet = openvdb::gridPtrCast<openvdb::FloatGrid>(in.readGrid(kGridName));
    in.close();
  } catch (const Error&) {
    throw;
  } catch (const std::exception& e) {
    throw refuse(std::string("the VDB file cannot be read: ") + e.what());
  }
  if (!sheet) throw refuse("the offsets of a VDB file must be single precision numbers");
  SheetFile result;
  if (!sheet->transform().isLinear()) throw refuse("the transform of the offsets must be linear");
  const auto affine = sheet->transform().baseMap()->getAffineMap();
  const openvdb::math::Mat4d m = affine->getMat4();
  result.du = m(0, 0), result.dy = m(1, 1), result.u0 = m(3, 0), result.y0 = m(3, 1);
  if (m(0, 1) != 0.0 || m(0, 2) != 0.0 || m(1, 0) != 0.0 || m(1, 2) != 0.0 || m(2, 0) != 0.0 || m(2, 1) != 0.0)
    throw refuse("the transform of the offsets must not rotate or shear");
  if (!(result.du > 0.0) || !(result.dy > 0.0) || !std::isfinite(result.du + result.dy + result.u0 + result.y0))
    throw refuse("the steps of the offsets must be positive");
  if (sheet->background() != 0.0f) throw refuse("the background of the offsets must be 0");
  for (auto meta = sheet->beginMeta(); meta != sheet->endMeta(); ++meta)
    if (meta->second->typeName() == "string") result.metadata[meta->first] = meta->second->str();

  const openvdb::CoordBBox box = sheet->evalActiveVoxelBoundingBox();
  if (!box.empty() && (box.min().z() != 0 || box.max().z() != 0)) throw refuse("the offsets must be a sheet at k = 0");
  if (!box.empty() &&
      (std::min(box.min().x(), box.min().y()) < -kFarthest || std::max(box.max().x(), box.max().y()) > kFarthest))
    throw refuse("the offsets lie too far from the origin of their grid");
  std::map<BlockKey, Block> blocks;
  for (auto v = sheet->cbeginValueOn(); v; ++v) {
    if (!v.isVoxelValue()) throw refuse("the offsets must not contain tiles");
    if (!std::isfinite(*v)) throw refuse("an offset is not a number");
    const Coord c = v.getCoord();
    Block& b = blocks.try_emplace(BlockKey{c.x() >> 3, c.y() >> 6}, Block{}).first->second;
    b[static_cast<std::size_t>(((c.x() & 7) << 6) | (c.y() & 63))] = *v;
  }
  for (const auto& [key, values] : blocks) result.grid.insert(key, values, 0.0f);
  return result;
}

}  // namespace treadmark::offset
