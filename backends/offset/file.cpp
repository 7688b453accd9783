// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <array>
#include <cmath>
#include <cstring>
#include <fstream>
#include <vector>

#include "treadmark/backends/offset/make.hpp"
#include "treadmark/backends/offset/metadata.hpp"
#include "treadmark/backends/offset/sheet_grid.hpp"
#include "treadmark/core/error.hpp"

namespace treadmark::offset {

namespace {

namespace fs = std::filesystem;

/// What follows the VDB data, ignored by other programs: a mark, the number of bytes before it and their sum. OpenVDB
/// trusts what it reads, so a damaged file must be known before.
constexpr std::array<char, 8> kMark = {'T', 'M', 'K', 'S', 'U', 'M', '0', '1'};
constexpr std::size_t kTrailer = 24;
constexpr std::array<char, 8> kVdbMagic = {' ', 'B', 'D', 'V', 0, 0, 0, 0};

/// FNV-1a (Fowler, Noll, Vo) over 64 bits.
std::uint64_t sum_of(const char* data, std::size_t size) {
  std::uint64_t h = 14695981039346656037ull;
  for (std::size_t i = 0; i < size; ++i) h = (h ^ static_cast<unsigned char>(data[i])) * 1099511628211ull;
  return h;
}

std::vector<char> read_all(const fs::path& file) {
  std::error_code problem;
  if (!fs::is_regular_file(file, problem))
    throw Error(ErrorKind::input_data, "the VDB file does not exist or is not a file", {file.string()});
  std::ifstream in(file, std::ios::binary | std::ios::ate);
  const std::streamoff size = in ? static_cast<std::streamoff>(in.tellg()) : -1;
  if (size < 0) throw Error(ErrorKind::input_data, "the VDB file cannot be read", {file.string()});
  std::vector<char> data(static_cast<std::size_t>(size));
  in.seekg(0);
  if (size > 0 && !in.read(data.data(), size))
    throw Error(ErrorKind::input_data, "the VDB file cannot be read", {file.string()});
  return data;
}

void append_trailer(const fs::path& file) {
  const std::vector<char> data = read_all(file);
  const std::uint64_t size = data.size(), sum = sum_of(data.data(), data.size());
  std::ofstream out(file, std::ios::binary | std::ios::app);
  out.write(kMark.data(), kMark.size());
  out.write(reinterpret_cast<const char*>(&size), sizeof(size));
  out.write(reinterpret_cast<const char*>(&sum), sizeof(sum));
  out.close();
  if (!out) throw Error(ErrorKind::configuration, "cannot write the offsets", {file.string()});
}

void require_sound(const fs::path& file) {
  const std::vector<char> data = read_all(file);
  const auto refuse = [&](const char* why, const char* advice) {
    throw Error(ErrorKind::input_data, why, {file.string()}, advice);
  };
  if (data.empty()) refuse("the VDB file is empty", "write it again");
  if (data.size() < kVdbMagic.size() || !std::equal(kVdbMagic.begin(), kVdbMagic.end(), data.begin()))
    refuse("this is not a VDB file", "offsets are read from files written by write_vdb");
  const char* trailer = data.data() + data.size() - kTrailer;
  if (data.size() < kTrailer + kVdbMagic.size() || !std::equal(kMark.begin(), kMark.end(), trailer))
    refuse("the VDB file is cut off, or was written by another program",
           "offsets are read from files written by write_vdb");
  std::uint64_t size = 0, sum = 0;
  std::memcpy(&size, trailer + 8, sizeof(size));
  std::memcpy(&sum, trailer + 16, sizeof(sum));
  if (size != data.size() - kTrailer || sum != sum_of(data.data(), data.size() - kTrailer))
    refuse("the VDB file is damaged: its check sum does not fit", "write or copy it again");
}

}  // namespace

void write_vdb(const fs::path& file, const OffsetFile& content) {
  if (!content.offsets) throw Error(ErrorKind::configuration, "there are no offsets to write");
  const SheetFrame& f = content.offsets->frame;
  SheetFile sheet;
  sheet.u0 = f.u0, sheet.y0 = f.y0, sheet.du = f.du, sheet.dy = f.dy;
  sheet.metadata = to_metadata(*content.offsets, content.base);
  if (!content.notes.empty()) sheet.metadata["notes"] = content.notes;
  write_sheet(file, content.offsets->grid, sheet);
  append_trailer(file);
}

OffsetFile read_vdb(const fs::path& file) {
  constexpr float kAbsurd = 1.0f;  // [m]
  require_sound(file);
  SheetFile sheet = read_sheet(file);
  const auto offsets = std::make_shared<SparseOffsets>();
  OffsetFile result;
  from_metadata(sheet.metadata, *offsets, result.base, file.string());
  const SheetFrame& f = offsets->frame;
  const auto near = [](double a, double b) { return std::fabs(a - b) <= 1e-12 * (std::fabs(a) + std::fabs(b)); };
  if (!near(f.u0, sheet.u0) || !near(f.y0, sheet.y0) || !near(f.du, sheet.du) || !near(f.dy, sheet.dy))
    throw Error(ErrorKind::input_data, "transform and entry 'frame' of the VDB file contradict each other",
                {file.string()});
  for (const SheetGrid::Entry& b : sheet.grid.blocks()) {
    for (int k = 0; k < kBlockI * kBlockJ; ++k)
      if (std::fabs(b.values[k]) > kAbsurd)
        throw Error(ErrorKind::input_data, "an offset in the VDB file is greater than a metre", {file.string()},
                    "offsets are in metres");
    if (f.turn > 0 && (b.key.bi < 0 || b.key.bi * kBlockI >= f.turn))
      throw Error(ErrorKind::input_data, "voxels in the VDB file lie beyond the turn", {file.string()});
  }
  offsets->grid = std::move(sheet.grid);
  result.offsets = offsets;
  return result;
}

}  // namespace treadmark::offset
