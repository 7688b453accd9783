// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <algorithm>
#include <cmath>
#include <mutex>
#include <sstream>

#include <openvdb/io/Archive.h>
#include <openvdb/io/Compression.h>
#include <openvdb/io/File.h>
#include <openvdb/openvdb.h>
#include <openvdb/tools/MeshToVolume.h>

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

bool unpack(bool blosc, std::string_view stored, char* to, std::size_t size) {
  try {
    std::istringstream from(std::string(stored), std::ios::binary);
    if (blosc)
      openvdb::io::bloscFromStream(from, to, size);
    else
      openvdb::io::unzipFromStream(from, to, size);
    return !from.fail();
  } catch (const std::exception&) {
    return false;
  }
}

/// Triangles as OpenVDB's conversion asks for them.
struct Triangles {
  const double* vertices;
  std::size_t vertex_count;
  const std::uint32_t* corners;
  std::size_t triangle_count;

  std::size_t polygonCount() const { return triangle_count; }
  std::size_t pointCount() const { return vertex_count; }
  std::size_t vertexCount(std::size_t) const { return 3; }
  void getIndexSpacePoint(std::size_t n, std::size_t v, openvdb::Vec3d& at) const {
    const double* p = vertices + 3 * std::size_t{corners[3 * n + v]};
    at = openvdb::Vec3d(p[0], p[1], p[2]);
  }
};

SheetFault nearest(const double* vertices, std::size_t vertex_count, const std::uint32_t* corners,
                   std::size_t triangle_count, double half_width, std::vector<NearestBlock>& out) {
  start_openvdb();
  try {
    const Triangles triangles{vertices, vertex_count, corners, triangle_count};
    const auto transform = openvdb::math::Transform::createLinearTransform(1.0);
    openvdb::Int32Grid numbers(-1);
    const float width = static_cast<float>(half_width);
    // as parallel_for: a thread that waits here begins no part of another loop
    tbb::this_task_arena::isolate([&] {
      openvdb::tools::meshToVolume<openvdb::FloatGrid>(triangles, *transform, width, width,
                                                       openvdb::tools::UNSIGNED_DISTANCE_FIELD, &numbers);
    });
    for (auto leaf = numbers.tree().cbeginLeaf(); leaf; ++leaf) {
      if (leaf->isEmpty()) continue;
      NearestBlock& block = out.emplace_back();
      block.first = {leaf->origin().x(), leaf->origin().y(), leaf->origin().z()};
      for (openvdb::Index k = 0; k < block.triangle.size(); ++k)
        block.triangle[k] = leaf->isValueOn(k) ? leaf->getValue(k) : -1;
    }
    std::sort(out.begin(), out.end(), [](const NearestBlock& a, const NearestBlock& b) { return a.first < b.first; });
  } catch (const std::exception& e) {
    return {SheetFault::Kind::input_data, std::string("cannot become a level set: ") + e.what()};
  }
  return {};
}

}  // namespace

extern "C" const SheetLibrary* treadmark_sheet_library() {
  static const SheetLibrary library{TREADMARK_MODULE_VERSION, make_storage, write_sheet, unpack, nearest};
  return &library;
}

}  // namespace treadmark::offset
