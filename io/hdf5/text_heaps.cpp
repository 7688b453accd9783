// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/io/hdf5/text_heaps.hpp"

#include <algorithm>
#include <cstdint>
#include <fstream>
#include <set>
#include <string>
#include <string_view>

namespace treadmark::io {
namespace {

// HDF5 File Format Specification, III.E: signature, version 1, three reserved bytes; size of the heap; then objects:
// index and number of references of two bytes each, four reserved ones, size of eight, the value filled up to a
// multiple of eight bytes. Index 0 is what is left free, its size with its head.
constexpr std::string_view kSignature{"GCOL\1\0\0\0", 8};
constexpr std::uint64_t kHead = 16, kLargest = std::uint64_t{1} << 32;

std::uint64_t little_endian(std::string_view bytes, std::uint64_t at, int count) {
  std::uint64_t value = 0;
  for (int i = count - 1; i >= 0; --i)
    value = value << 8 | static_cast<unsigned char>(bytes[at + static_cast<std::uint64_t>(i)]);
  return value;
}

bool sound(std::string_view heap) {
  std::set<std::uint64_t> seen;
  std::uint64_t at = kHead;
  while (at + kHead <= heap.size()) {
    const std::uint64_t index = little_endian(heap, at, 2), reserved = little_endian(heap, at + 4, 4);
    const std::uint64_t size = little_endian(heap, at + 8, 8), left = heap.size() - at;
    if (index == 0) return size == left;
    if (reserved != 0 || !seen.insert(index).second || size > left - kHead) return false;
    at += kHead + (size + 7) / 8 * 8;
  }
  return at <= heap.size();
}

bool sound_at(std::ifstream& in, std::uint64_t place, std::uint64_t file_size) {
  std::string heap(kHead, '\0');
  in.seekg(static_cast<std::streamoff>(place));
  if (!in.read(heap.data(), static_cast<std::streamsize>(heap.size()))) return false;
  const std::uint64_t size = little_endian(heap, 8, 8);
  if (size < kHead || size > file_size - place || size > kLargest) return false;
  heap.resize(size);
  in.seekg(static_cast<std::streamoff>(place));
  return in.read(heap.data(), static_cast<std::streamsize>(size)) && sound(heap);
}

}  // namespace

bool text_heaps_sound(const std::filesystem::path& file) {
  std::error_code failure;
  const std::uint64_t size = std::filesystem::file_size(file, failure);
  std::ifstream in(file, std::ios::binary);
  if (failure || !in) return true;
  constexpr std::uint64_t kPiece = std::uint64_t{1} << 20;
  const std::uint64_t overlap = kSignature.size() - 1;
  std::string piece;
  for (std::uint64_t start = 0; start < size; start += kPiece) {
    piece.resize(std::min(kPiece + overlap, size - start));
    in.clear();
    in.seekg(static_cast<std::streamoff>(start));
    if (!in.read(piece.data(), static_cast<std::streamsize>(piece.size()))) return true;
    for (auto found = piece.find(kSignature); found != std::string::npos; found = piece.find(kSignature, found + 1))
      if (!sound_at(in, start + found, size)) return false;
  }
  return true;
}

}  // namespace treadmark::io
