// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <algorithm>
#include <cmath>
#include <fstream>
#include <ios>
#include <new>
#include <sstream>
#include <vector>

#include <openvdb/io/Archive.h>
#include <openvdb/io/Stream.h>
#include <openvdb/openvdb.h>
#include <openvdb/tools/Count.h>
#include <openvdb/tools/MeshToVolume.h>

#include "treadmark/backends/offset/vdb_messages.hpp"
#include "treadmark/core/helper_program.hpp"

namespace treadmark::offset {

namespace {

VdbGrid about(const openvdb::GridBase& grid) {
  VdbGrid out;
  out.name = grid.getName();
  out.type = grid.type();
  for (auto entry = grid.beginMeta(); entry != grid.endMeta(); ++entry)
    if (entry->second->typeName() == "string")
      out.metadata[entry->first] = static_cast<const openvdb::StringMetadata&>(*entry->second).value();
  if (!grid.transform().isLinear()) return out;
  out.linear = 1;
  const openvdb::math::Mat4d to_world = grid.transform().baseMap()->getAffineMap()->getMat4();
  for (int row = 0; row < 4; ++row)
    for (int column = 0; column < 3; ++column)
      out.to_world[static_cast<std::size_t>(3 * row + column)] = to_world(row, column);
  return out;
}

template <class Grid>
void put_content(Channel& c, const Grid& grid) {
  const auto& tree = grid.tree();
  c.put(static_cast<float>(tree.background()));
  // threads would take of the bounded memory
  c.put<std::int64_t>(openvdb::tools::countActiveTiles(tree, /*threaded=*/false) > 0 ? 1 : 0);
  std::int64_t count = 0;
  for (auto leaf = tree.cbeginLeaf(); leaf; ++leaf) count += leaf->isEmpty() ? 0 : 1;
  c.put(count);
  for (auto leaf = tree.cbeginLeaf(); leaf; ++leaf) {
    if (leaf->isEmpty()) continue;
    VdbLeaf out;
    for (int axis = 0; axis < 3; ++axis) out.first[static_cast<std::size_t>(axis)] = leaf->origin()[axis];
    for (openvdb::Index k = 0; k < out.value.size(); ++k) {
      if (!leaf->isValueOn(k)) continue;
      out.active[k / 64] |= std::uint64_t{1} << (k % 64);
      out.value[k] = static_cast<float>(leaf->getValue(k));
    }
    c.put(out);
  }
}

/// All grids of a file. Its reader does not ask whether there was something to read, so the stream says so.
openvdb::GridPtrVecPtr read_grids(const std::string& file, std::uint64_t size, std::string& fault) {
  try {
    std::ifstream from(file, std::ios::binary);
    from.exceptions(std::ios::failbit | std::ios::badbit);
    openvdb::io::Stream stream(from, /*delayLoad=*/false);
    if (static_cast<std::uint64_t>(std::streamoff(from.tellg())) == size) return stream.getGrids();
    fault = "its content contradicts itself";
  } catch (const std::ios_base::failure&) {
    fault = "it ends too early";
  } catch (const std::bad_alloc&) {
    fault = "it asks for more memory than a file of its size can fill";
  } catch (const std::exception& e) {
    fault = e.what();
  }
  return nullptr;
}

void read(Channel& c) {
  const auto file = c.take_list<std::string>();
  const auto size = c.take<std::uint64_t>();
  // A leaf of doubles has 4 kB, and nodes of 32 and 256 kB take a thirtieth of that in the file.
  constexpr std::uint64_t kPerByte = 64, kAlways = 512 << 20;
  bound_what_a_file_takes(kAlways + kPerByte * size);
  std::string fault;
  const openvdb::GridPtrVecPtr grids = read_grids(file, size, fault);
  c.put_list(fault);
  if (grids == nullptr) return;
  c.put(static_cast<std::int64_t>(grids->size()));
  for (const openvdb::GridBase::Ptr& grid : *grids) put(c, about(*grid));
  const auto number = static_cast<std::size_t>(c.take<std::int64_t>());
  if (number >= grids->size()) return;
  const openvdb::GridBase& chosen = *(*grids)[number];
  if (chosen.isType<openvdb::FloatGrid>())
    put_content(c, static_cast<const openvdb::FloatGrid&>(chosen));
  else if (chosen.isType<openvdb::DoubleGrid>())
    put_content(c, static_cast<const openvdb::DoubleGrid&>(chosen));
}

/// What openvdb::io::File writes, into a stream.
struct InMemory : openvdb::io::Archive {
  void write(std::ostream& to, const openvdb::GridCPtrVec& grids) const { Archive::write(to, grids, true); }
};

std::string file_of(const std::array<double, 4>& frame, const Metadata& entries,
                    const std::vector<SheetBlock>& blocks) {
  const auto sheet = openvdb::FloatGrid::create(0.0f);
  sheet->setName(kGridName);
  sheet->setGridClass(openvdb::GRID_UNKNOWN);
  const auto& [u0, y0, du, dy] = frame;
  openvdb::math::Mat4d to_world = openvdb::math::Mat4d::identity();
  // The sheet's thickness means nothing; OpenVDB refuses transforms whose determinant is below 3e-15.
  constexpr double kThinnest = 1e-3;
  to_world.preScale(openvdb::Vec3d(du, dy, std::max(dy, kThinnest)));
  to_world.postTranslate(openvdb::Vec3d(u0, y0, 0.0));
  sheet->setTransform(openvdb::math::Transform::createLinearTransform(to_world));
  for (const auto& [name, text] : entries) sheet->insertMeta(name, openvdb::StringMetadata(text));
  auto to = sheet->getAccessor();
  for (const SheetBlock& b : blocks)
    for (int k = 0; k < kBlockI * kBlockJ; ++k)
      if (const float value = b.values[static_cast<std::size_t>(k)]; value != 0.0f)
        to.setValue({b.key.bi * kBlockI + (k >> 6), b.key.bj * kBlockJ + (k & 63), 0}, value);
  std::ostringstream bytes(std::ios::binary);
  InMemory out;
  out.setCompression(openvdb::io::COMPRESS_ACTIVE_MASK);
  out.write(bytes, {sheet});
  return std::move(bytes).str();
}

void write(Channel& c) {
  const auto frame = c.take<std::array<double, 4>>();
  const Metadata entries = take_entries(c);
  const auto blocks = c.take_list<std::vector<SheetBlock>>();
  std::string fault, bytes;
  try {
    bytes = file_of(frame, entries, blocks);
  } catch (const openvdb::ArithmeticError& e) {
    fault = std::string("the steps of the offsets are too small for a VDB file: ") + e.what();
  } catch (const std::exception& e) {
    fault = std::string("cannot write the offsets: ") + e.what();
  }
  c.put_list(fault);
  if (fault.empty()) c.put_list(bytes);
}

/// As OpenVDB's conversion asks for them.
struct Triangles {
  const std::vector<std::array<double, 3>>& vertices;
  const std::vector<std::array<std::uint32_t, 3>>& corners;

  std::size_t polygonCount() const { return corners.size(); }
  std::size_t pointCount() const { return vertices.size(); }
  std::size_t vertexCount(std::size_t) const { return 3; }
  void getIndexSpacePoint(std::size_t n, std::size_t v, openvdb::Vec3d& at) const {
    const std::array<double, 3>& p = vertices[corners[n][v]];
    at = openvdb::Vec3d(p[0], p[1], p[2]);
  }
};

std::vector<NearestBlock> nearest_blocks(const Triangles& triangles, float width, int threads) {
  const auto transform = openvdb::math::Transform::createLinearTransform(1.0);
  openvdb::Int32Grid numbers(-1);
  tbb::task_arena(threads).execute([&] {
    openvdb::tools::meshToVolume<openvdb::FloatGrid>(triangles, *transform, width, width,
                                                     openvdb::tools::UNSIGNED_DISTANCE_FIELD, &numbers);
  });
  std::vector<NearestBlock> out;
  for (auto leaf = numbers.tree().cbeginLeaf(); leaf; ++leaf) {
    if (leaf->isEmpty()) continue;
    NearestBlock& block = out.emplace_back();
    block.first = {leaf->origin().x(), leaf->origin().y(), leaf->origin().z()};
    for (openvdb::Index k = 0; k < block.triangle.size(); ++k)
      block.triangle[k] = leaf->isValueOn(k) ? leaf->getValue(k) : -1;
  }
  std::sort(out.begin(), out.end(), [](const NearestBlock& a, const NearestBlock& b) { return a.first < b.first; });
  return out;
}

void nearest(Channel& c) {
  const auto vertices = c.take_list<std::vector<std::array<double, 3>>>();
  const auto corners = c.take_list<std::vector<std::array<std::uint32_t, 3>>>();
  const auto width = static_cast<float>(c.take<double>());
  const auto threads = static_cast<int>(c.take<std::int64_t>());
  std::string fault;
  std::vector<NearestBlock> blocks;
  try {
    blocks = nearest_blocks({vertices, corners}, width, threads);
  } catch (const std::exception& e) {
    fault = std::string("cannot become a level set: ") + e.what();
  }
  c.put_list(fault);
  if (fault.empty()) c.put_list(blocks);
}

void serve(Channel& c) {
  openvdb::initialize();
  switch (c.take<VdbTask>()) {
    case VdbTask::read:
      return read(c);
    case VdbTask::write:
      return write(c);
    case VdbTask::nearest:
      return nearest(c);
  }
}

}  // namespace
}  // namespace treadmark::offset

int main(int count, char** arguments) {
  return treadmark::serve_as_helper(count, arguments, TREADMARK_MODULE_VERSION, treadmark::offset::serve);
}
