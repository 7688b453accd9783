// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/io/results/write_hdf5.hpp"

#include <fmt/format.h>
#include <hdf5.h>

#include <algorithm>
#include <string>
#include <string_view>
#include <utility>

#include "treadmark/core/error.hpp"
#include "treadmark/io/results/atomic_file.hpp"
#include "treadmark/io/results/attributes.hpp"
#include "treadmark/io/results/field_table.hpp"
#include "treadmark/io/results/subsurface_table.hpp"

namespace treadmark::io {
namespace {

constexpr int kDeflateLevel = 4;
constexpr hsize_t kMaxChunk = 512;  // elements along a side: chunks stay below 2 MiB

[[noreturn]] void fail(std::string_view what) {
  throw Error(ErrorKind::configuration, fmt::format("HDF5: cannot write {}", what), {},
              "check that the disk is not full and the folder is writable");
}

/// Owns an HDF5 identifier.
class Handle {
 public:
  Handle(hid_t id, herr_t (*closer)(hid_t), std::string_view what) : id_(id), close_(closer) {
    if (id_ < 0) fail(what);
  }
  ~Handle() {
    if (id_ >= 0) close_(id_);
  }
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;
  operator hid_t() const noexcept { return id_; }

  /// Closes now and reports failure, which the destructor cannot: data may be flushed only here.
  void close(std::string_view what) {
    if (close_(std::exchange(id_, -1)) < 0) fail(what);
  }

 private:
  hid_t id_;
  herr_t (*close_)(hid_t);
};

/// Keeps the HDF5 library from printing its error stack.
class QuietErrors {
 public:
  QuietErrors() {
    H5Eget_auto2(H5E_DEFAULT, &function_, &data_);
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  }
  ~QuietErrors() { H5Eset_auto2(H5E_DEFAULT, function_, data_); }
  QuietErrors(const QuietErrors&) = delete;
  QuietErrors& operator=(const QuietErrors&) = delete;

 private:
  H5E_auto2_t function_ = nullptr;
  void* data_ = nullptr;
};

void write_attribute(hid_t object, const std::string& name, hid_t type, hid_t space, const void* data) {
  const Handle attribute(H5Acreate2(object, name.c_str(), type, space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose, name);
  if (H5Awrite(attribute, type, data) < 0) fail(name);
}

void add(hid_t object, const std::string& name, double value) {
  const Handle space(H5Screate(H5S_SCALAR), H5Sclose, name);
  write_attribute(object, name, H5T_NATIVE_DOUBLE, space, &value);
}

void add(hid_t object, const std::string& name, int value) {
  const Handle space(H5Screate(H5S_SCALAR), H5Sclose, name);
  write_attribute(object, name, H5T_NATIVE_INT, space, &value);
}

void add(hid_t object, const std::string& name, const Vec3& value) {
  const hsize_t size = 3;
  const Handle space(H5Screate_simple(1, &size, nullptr), H5Sclose, name);
  write_attribute(object, name, H5T_NATIVE_DOUBLE, space, value.data());
}

void add(hid_t object, const std::string& name, const Mat3& value) {
  const hsize_t size[2] = {3, 3};
  const Handle space(H5Screate_simple(2, size, nullptr), H5Sclose, name);
  const Mat3 rows = value.transpose();  // stored by columns: HDF5 counts by rows
  write_attribute(object, name, H5T_NATIVE_DOUBLE, space, rows.data());
}

Handle string_type(const std::string& name) {
  return {[&] {
            const hid_t type = H5Tcopy(H5T_C_S1);
            if (type >= 0 && (H5Tset_size(type, H5T_VARIABLE) < 0 || H5Tset_cset(type, H5T_CSET_UTF8) < 0)) {
              H5Tclose(type);
              return hid_t{-1};
            }
            return type;
          }(),
          H5Tclose, name};
}

void add(hid_t object, const std::string& name, const std::string& value) {
  const Handle type = string_type(name);
  const Handle space(H5Screate(H5S_SCALAR), H5Sclose, name);
  const char* text = value.c_str();
  write_attribute(object, name, type, space, &text);
}

void add(hid_t object, const std::string& name, const std::vector<std::string>& values) {
  const Handle type = string_type(name);
  const hsize_t size = values.size();
  const Handle space(H5Screate_simple(1, &size, nullptr), H5Sclose, name);
  std::vector<const char*> texts;
  for (const std::string& value : values) texts.push_back(value.c_str());
  write_attribute(object, name, type, space, texts.empty() ? static_cast<const void*>(&name) : texts.data());
}

Handle make_group(hid_t parent, const std::string& name) {
  return {H5Gcreate2(parent, name.c_str(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), H5Gclose, name};
}

/// Whole layers of two dimensions, cut to keep chunks below 3 MiB.
std::vector<hsize_t> chunk_size(const std::vector<hsize_t>& size) {
  std::vector<hsize_t> chunk = size;
  const hsize_t largest = size.size() == 2 ? kMaxChunk : kMaxChunk / 4;
  for (hsize_t& length : chunk) length = std::min(length, largest);
  if (size.size() > 2) chunk[0] = 1;
  return chunk;
}

/// A dataset of any number of dimensions; those of two and more are compressed.
void write_dataset(hid_t group, const std::string& name, hid_t type, const void* data, const std::vector<hsize_t>& size,
                   const std::string& unit, const std::string& meaning) {
  const int rank = static_cast<int>(size.size());
  const Handle space(H5Screate_simple(rank, size.data(), nullptr), H5Sclose, name);
  const Handle creation(H5Pcreate(H5P_DATASET_CREATE), H5Pclose, name);
  const bool empty = std::find(size.begin(), size.end(), 0u) != size.end();
  if (rank >= 2 && !empty && H5Zfilter_avail(H5Z_FILTER_DEFLATE) > 0) {
    const std::vector<hsize_t> chunk = chunk_size(size);
    if (H5Pset_chunk(creation, rank, chunk.data()) < 0 || H5Pset_shuffle(creation) < 0 ||
        H5Pset_deflate(creation, kDeflateLevel) < 0)
      fail(name);
  }
  Handle dataset(H5Dcreate2(group, name.c_str(), type, space, H5P_DEFAULT, creation, H5P_DEFAULT), H5Dclose, name);
  if (H5Dwrite(dataset, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, data) < 0) fail(name);
  add(dataset, "unit", unit);
  add(dataset, "meaning", meaning);
  dataset.close(name);
}

void write_fields(hid_t group, const PatchResult& patch) {
  const PatchFields& fields = patch.fields;
  const Grid2& grid = fields.grid;
  if (grid.size() == 0) return;
  std::vector<double> x, s;
  for (int ix = 0; ix < grid.nx; ++ix) x.push_back(grid.x(ix));
  for (int iy = 0; iy < grid.ny; ++iy) s.push_back(grid.y(iy));
  const std::vector<hsize_t> size{s.size(), x.size()};
  write_dataset(group, "x", H5T_NATIVE_DOUBLE, x.data(), {x.size()}, "m", "element centres along the columns");
  write_dataset(group, "s", H5T_NATIVE_DOUBLE, s.data(), {s.size()}, "m", "element centres along the rows");
  for (const FieldColumn& column : kFieldColumns) {
    const std::vector<double>& values = fields.*column.values;
    if (values.empty()) continue;
    write_dataset(group, std::string(column.name), H5T_NATIVE_DOUBLE, values.data(), size,
                  std::string(patch.shift ? column.unit_shift : column.unit), std::string(column.meaning));
  }
  if (!fields.row_angle.empty())
    write_dataset(group, "row_angle", H5T_NATIVE_DOUBLE, fields.row_angle.data(), {s.size()}, "rad",
                  "inclination of the rows of a curved reference against the contact plane");
  if (!fields.state.empty())
    write_dataset(group, "state", H5T_NATIVE_UINT8, fields.state.data(), size, "1",
                  "0 exterior, 1 adhesion, 2 slip, 3 plastic");
}

void write_subsurface(hid_t patch_group, const std::vector<SubsurfaceBlock>& blocks) {
  if (blocks.empty()) return;
  const Handle parent = make_group(patch_group, "subsurface");
  int number = 0;
  for (const SubsurfaceBlock& block : blocks) {
    const Handle group = make_group(parent, fmt::format("block{}", ++number));
    for (const SubsurfaceColumn& column : kSubsurfaceColumns) {
      const std::vector<double> values = column_values(block, column);
      std::vector<hsize_t> size;
      for (const int length : {block.nz, block.ny, block.nx}) size.push_back(static_cast<hsize_t>(length));
      if (column.components > 1) size.push_back(static_cast<hsize_t>(column.components));
      write_dataset(group, std::string(column.name), H5T_NATIVE_DOUBLE, values.data(), size, std::string(column.unit),
                    std::string(column.meaning));
    }
  }
}

void add_all(hid_t object, const std::vector<Attribute>& attributes) {
  for (const Attribute& one : attributes) std::visit([&](const auto& value) { add(object, one.name, value); }, one.value);
}

void write_patch(hid_t group, const PatchResult& patch) {
  add_all(group, attributes_of(patch));
  write_fields(group, patch);
  write_subsurface(group, patch.subsurface);
}

void write_case(hid_t group, const CaseResult& result) {
  add_all(group, attributes_of(result));
  int number = 0;
  for (const PatchResult& patch : result.patches) {
    ++number;
    check_field_sizes(patch.fields, result.number, number);
    check_blocks(patch.subsurface, fmt::format("case {}, patch {}: ", result.number, number));
    const Handle patch_group = make_group(group, fmt::format("patch_{}", number));
    write_patch(patch_group, patch);
  }
}

void write_run(hid_t file, const RunResult& run) {
  add_all(file, attributes_of(run));
  for (const CaseResult& result : run.cases) {
    const Handle group = make_group(file, fmt::format("case_{:04}", result.number));
    write_case(group, result);
  }
}

}  // namespace

void write_hdf5(const std::filesystem::path& path, const RunResult& run) {
  const QuietErrors quiet;
  AtomicFile target(path);
  Handle file(H5Fcreate(target.temporary().c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT), H5Fclose, path.string());
  write_run(file, run);
  file.close(path.string());
  target.commit();
}

}  // namespace treadmark::io
