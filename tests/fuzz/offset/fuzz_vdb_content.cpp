// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <openvdb/io/File.h>
#include <openvdb/openvdb.h>
#include <openvdb/tools/ChangeBackground.h>

#include <array>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <sstream>

#include "treadmark/backends/offset/make.hpp"
#include "treadmark/backends/offset/sheet_grid.hpp"
#include "treadmark/backends/offset/sparse_offsets.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/tests/fuzz/fuzz_target.hpp"
#include "treadmark/tests/fuzz/temporary_file.hpp"

namespace {

using openvdb::Coord;
using openvdb::FloatGrid;

/// Sound VDB files with any content. The input is text, a command a line: meta NAME TEXT, number NAME VALUE,
/// map DU DY U0 Y0 SHEAR, frustum, voxel I J K VALUE, tile LEVEL I J K VALUE, background VALUE, name NAME, doubles.
/// Unknown commands do nothing.
openvdb::GridBase::Ptr grid_of(const std::string& text) {
  constexpr int kMostValues = 200;  // a tile is cheap, but each makes nodes
  FloatGrid::Ptr grid = FloatGrid::create(0.0f);
  grid->setName(treadmark::offset::kGridName);
  bool doubles = false;
  int values = 0;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    std::string command, name;
    int i = 0, j = 0, k = 0;
    unsigned level = 0;
    float value = 0.0f;
    words >> command;
    if (command == "meta" && words >> name) {
      words.get();
      const std::string rest{std::istreambuf_iterator<char>(words), {}};
      grid->removeMeta(name);
      grid->insertMeta(name, openvdb::StringMetadata(rest));
    } else if (command == "number" && words >> name >> value) {
      grid->removeMeta(name);
      grid->insertMeta(name, openvdb::FloatMetadata(value));
    } else if (command == "map") {
      std::array<double, 5> m{};
      for (double& x : m) words >> x;
      openvdb::math::Mat4d to_world = openvdb::math::Mat4d::identity();
      to_world(0, 0) = m[0], to_world(1, 1) = m[1], to_world(2, 2) = m[1];
      to_world(3, 0) = m[2], to_world(3, 1) = m[3], to_world(0, 1) = m[4];
      grid->setTransform(openvdb::math::Transform::createLinearTransform(to_world));
    } else if (command == "frustum") {
      grid->setTransform(openvdb::math::Transform::createFrustumTransform(
          openvdb::BBoxd(openvdb::Vec3d(0.0), openvdb::Vec3d(10.0)), 0.5, 2.0, 0.1));
    } else if (command == "voxel" && words >> i >> j >> k >> value && ++values < kMostValues) {
      grid->tree().setValueOn(Coord(i, j, k), value);
    } else if (command == "tile" && words >> level >> i >> j >> k >> value && ++values < kMostValues) {
      grid->tree().addTile(1 + level % 3, Coord(i, j, k), value, true);
    } else if (command == "background" && words >> value) {
      openvdb::tools::changeBackground(grid->tree(), value);
    } else if (command == "name" && words >> name) {
      grid->setName(name);
    } else if (command == "doubles") {
      doubles = true;
    }
  }
  if (!doubles) return grid;
  const auto other = openvdb::DoubleGrid::create(0.0);
  other->setName(grid->getName());
  return other;
}

/// The end that tells a file of offsets from a damaged one (see backends/offset/file.cpp).
void seal(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  const std::string data{std::istreambuf_iterator<char>(in), {}};
  const std::uint64_t size = data.size();
  std::uint64_t sum = 14695981039346656037ull;
  for (const char c : data) sum = (sum ^ static_cast<unsigned char>(c)) * 1099511628211ull;
  std::ofstream out(file, std::ios::binary | std::ios::app);
  out << "TMKSUM01";
  out.write(reinterpret_cast<const char*>(&size), sizeof(size));
  out.write(reinterpret_cast<const char*>(&sum), sizeof(sum));
}

/// What the surfaces rely on.
void require_sound(const treadmark::offset::OffsetFile& file) {
  const treadmark::offset::SheetFrame& f = file.offsets->frame;
  const bool sound = f.du > 0.0 && f.dy > 0.0 && std::isfinite(f.du + f.dy + f.u0 + f.y0 + f.first + f.last) &&
                     (f.body == treadmark::Body::rail || std::isfinite(f.period())) && file.base.body == f.body;
  if (!sound) std::abort();
  for (const auto& block : file.offsets->grid.blocks())
    for (int k = 0; k < treadmark::offset::kBlockI * treadmark::offset::kBlockJ; ++k)
      if (!std::isfinite(block.values[k])) std::abort();
}

}  // namespace

TREADMARK_FUZZ_TARGET(fuzz_vdb_content) {
  static const treadmark::fuzz::TemporaryFile file("fuzz_vdb_content", ".vdb");
  openvdb::initialize();
  try {
    const auto grid = grid_of(std::string(reinterpret_cast<const char*>(data), size));
    openvdb::io::File out(file.path().string());
    out.setCompression(openvdb::io::COMPRESS_ACTIVE_MASK);
    out.write({grid});
    out.close();
  } catch (const std::exception&) {
    return 0;  // OpenVDB does not write this
  }
  seal(file.path());
  try {
    require_sound(treadmark::offset::read_vdb(file.path()));
  } catch (const treadmark::Error&) {
  }
  return 0;
}
