// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors

#include "treadmark/io/hdf5/hdf5_file.hpp"

#include <dlfcn.h>
#include <fcntl.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <hdf5.h>
#include <sys/file.h>
#include <unistd.h>
#include <zlib.h>

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <set>
#include <string>
#include <string_view>

#include "treadmark/core/cancellation.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/core/missing_file.hpp"
#include "treadmark/core/never_cancelled.hpp"
#include "treadmark/core/output_file.hpp"
#include "treadmark/core/parallel.hpp"
#include "treadmark/io/hdf5/hdf5_reader.hpp"
#include "treadmark/io/hdf5/hdf5_writer.hpp"

namespace treadmark::io {

// Writer and reader share this file because it alone knows the HDF5 library.

/// Part of a dataset that is stored as a whole: where it begins, and its bytes with zeros beyond the ends.
struct Hdf5Chunk {
  std::vector<hsize_t> offset;
  std::vector<unsigned char> bytes;
};

namespace {

/// Loaded when it is first used: it brings some thirty libraries along, most of them for networks. Nothing is left to
/// be done at the end of a process: where a damaged file keeps it from closing its objects it would say so on the
/// terminal.
void* hdf5_library() {
  static void* const library = [] {
    void* loaded = nullptr;
    for (const char* file : {TREADMARK_HDF5_NAME, TREADMARK_HDF5_FILE})
      if (loaded == nullptr) loaded = dlopen(file, RTLD_LAZY | RTLD_LOCAL);
    for (const char* first : {"H5dont_atexit", "H5open"}) {
      void* const call = loaded != nullptr ? dlsym(loaded, first) : nullptr;
      if (call == nullptr)
        throw Error(ErrorKind::configuration, fmt::format("cannot load HDF5: {}", dlerror()), {},
                    "install " TREADMARK_HDF5_NAME);
      reinterpret_cast<herr_t (*)()>(call)();
    }
    return loaded;
  }();
  return library;
}

template <class Symbol>
Symbol* hdf5_symbol(const char* name) {
  if (void* const place = dlsym(hdf5_library(), name); place != nullptr) return reinterpret_cast<Symbol*>(place);
  throw Error(ErrorKind::configuration, fmt::format("HDF5 has no {}", name), {}, "install " TREADMARK_HDF5_NAME);
}

/// A function or a number of the library.
#define TREADMARK_TEXT(name) #name
#define HDF5(name)                                                                       \
  (*[] {                                                                                 \
    static auto* const hdf5_place = hdf5_symbol<decltype(::name)>(TREADMARK_TEXT(name)); \
    return hdf5_place;                                                                   \
  }())

constexpr unsigned kReadOnly = 0, kTruncate = 2;  // H5F_ACC_RDONLY, H5F_ACC_TRUNC, macros that call the library
constexpr int kDeflateLevel = 4;
constexpr hsize_t kLongestChunk = 16384;  // elements of a dataset of one dimension
constexpr hsize_t kMaxChunk = 512;        // elements along a side: chunks stay below 3 MiB
constexpr hssize_t kMostValues = hssize_t{1} << 34;
constexpr unsigned kMostAttributes = 1000;  // in the header of an object
constexpr long kLongestName = 4096;
constexpr double kDensest = 1100.0;  // deflate packs no closer
constexpr std::size_t kMostPending = std::size_t{64} << 20, kMostDatasets = 4096;

[[noreturn]] void cannot_write(std::string_view what) {
  throw Error(ErrorKind::configuration, fmt::format("HDF5: cannot write {}", what), {},
              "check that the disk is not full and the folder is writable");
}

[[noreturn]] void cannot_read(const std::string& file, const std::string& what) {
  throw Error(ErrorKind::input_data, fmt::format("HDF5: cannot read {}", what), {file, 0, 0},
              "give a file of results that is complete");
}

Hdf5Id written(hid_t id, std::string_view what) {
  if (id < 0) cannot_write(what);
  return Hdf5Id(id);
}

void check_name(const std::string& name) {
  if (!name.empty() && name != "." && name.find('/') == std::string::npos && name.find('\0') == std::string::npos)
    return;
  throw Error(ErrorKind::configuration, fmt::format("\"{}\" cannot be the name of an object in an HDF5 file", name), {},
              "choose a name without slashes");
}

Hdf5Id string_type() {
  Hdf5Id type(HDF5(H5Tcopy)(HDF5(H5T_C_S1_g)));
  if (type.get() < 0 || HDF5(H5Tset_size)(type.get(), H5T_VARIABLE) < 0 ||
      HDF5(H5Tset_cset)(type.get(), H5T_CSET_UTF8) < 0)
    cannot_write("texts");
  return type;
}

Hdf5Id make_space(const std::vector<hsize_t>& size, const std::string& name) {
  return written(size.empty() ? HDF5(H5Screate)(H5S_SCALAR)
                              : HDF5(H5Screate_simple)(static_cast<int>(size.size()), size.data(), nullptr),
                 name);
}

/// Properties of a new object: without times, so that equal contents give equal bytes; attributes in its header, which
/// has a check sum.
Hdf5Id timeless(hid_t kind, const std::string& name) {
  Hdf5Id creation = written(HDF5(H5Pcreate)(kind), name);
  if (HDF5(H5Pset_obj_track_times)(creation.get(), false) < 0 ||
      HDF5(H5Pset_attr_phase_change)(creation.get(), kMostAttributes, 0) < 0)
    cannot_write(name);
  return creation;
}

std::vector<const char*> pointers(std::span<const std::string> texts) {
  std::vector<const char*> out;
  for (const std::string& text : texts) out.push_back(text.c_str());
  return out;
}

/// Writes an attribute of an object.
struct AttributeWriter {
  hid_t object;
  const std::string& name;

  void write(hid_t type, const std::vector<hsize_t>& size, const void* data) const {
    const Hdf5Id space = make_space(size, name);
    const Hdf5Id attribute =
        written(HDF5(H5Acreate2)(object, name.c_str(), type, space.get(), H5P_DEFAULT, H5P_DEFAULT), name);
    if (HDF5(H5Awrite)(attribute.get(), type, data) < 0) cannot_write(name);
  }
  void operator()(int value) const { write(HDF5(H5T_NATIVE_INT_g), {}, &value); }
  void operator()(double value) const { write(HDF5(H5T_NATIVE_DOUBLE_g), {}, &value); }
  void operator()(const Vec3& value) const { write(HDF5(H5T_NATIVE_DOUBLE_g), {3}, value.data()); }
  void operator()(const Mat3& value) const {
    const Mat3 rows = value.transpose();  // stored by columns: HDF5 counts by rows
    write(HDF5(H5T_NATIVE_DOUBLE_g), {3, 3}, rows.data());
  }
  void operator()(const std::string& value) const {
    const char* text = value.c_str();
    write(string_type().get(), {}, &text);
  }
  void operator()(const std::vector<std::string>& values) const {
    const auto texts = pointers(values);
    write(string_type().get(), {values.size()}, texts.empty() ? static_cast<const void*>(&name) : texts.data());
  }
};

/// Whole layers of two dimensions, cut to keep chunks small.
std::vector<hsize_t> chunk_size(const std::vector<hsize_t>& size) {
  std::vector<hsize_t> chunk = size;
  const hsize_t largest = size.size() == 1 ? kLongestChunk : size.size() == 2 ? kMaxChunk : kMaxChunk / 4;
  for (hsize_t& length : chunk) length = std::min(length, largest);
  if (size.size() > 2) chunk[0] = 1;
  return chunk;
}

/// The bytes of numbers of `width` bytes, the first ones of all, then the second ones: what the shuffle filter of the
/// library makes of them.
std::vector<unsigned char> shuffled(const std::vector<unsigned char>& bytes, std::size_t width) {
  const std::size_t count = bytes.size() / width;
  std::vector<unsigned char> out(bytes.size());
  for (std::size_t b = 0; b < width; ++b)
    for (std::size_t i = 0; i < count; ++i) out[b * count + i] = bytes[i * width + b];
  return out;
}

/// A dataset cut into chunks, in the order of the library.
std::vector<Hdf5Chunk> cut(const std::vector<hsize_t>& size, const std::vector<hsize_t>& chunk,
                           const unsigned char* data, std::size_t width) {
  const std::size_t rank = size.size();
  std::vector<std::size_t> step(rank, width), step_in_chunk(rank, width);  // bytes from one index to the next
  for (std::size_t k = rank; --k > 0;) {
    step[k - 1] = step[k] * size[k];
    step_in_chunk[k - 1] = step_in_chunk[k] * chunk[k];
  }
  std::vector<Hdf5Chunk> out;
  std::vector<hsize_t> offset(rank, 0);
  const auto copy = [&](const auto& self, std::size_t k, const unsigned char* from, unsigned char* to) -> void {
    const std::size_t count = std::min(chunk[k], size[k] - offset[k]);
    if (k + 1 == rank) {
      std::memcpy(to, from, count * width);
      return;
    }
    for (std::size_t i = 0; i < count; ++i)
      self(self, k + 1, from + i * step[k] + offset[k + 1] * step[k + 1], to + i * step_in_chunk[k]);
  };
  for (bool more = true; more;) {
    Hdf5Chunk& one = out.emplace_back(Hdf5Chunk{offset, std::vector<unsigned char>(step_in_chunk[0] * chunk[0], 0)});
    copy(copy, 0, data + offset[0] * step[0], one.bytes.data());
    more = false;
    for (std::size_t k = rank; k-- > 0 && !more;) {
      offset[k] += chunk[k];
      more = offset[k] < size[k];
      if (!more) offset[k] = 0;
    }
  }
  return out;
}

}  // namespace

/// The library compresses on one thread: so chunks are collected, compressed on all and handed over as they are to be
/// stored, in their order.
struct Hdf5Pending {
  struct Dataset {
    Hdf5Id id;
    std::string name;
    std::size_t width;
    std::vector<Hdf5Chunk> chunks;
  };
  std::vector<Dataset> datasets;
  std::size_t bytes = 0;

  void add(Dataset dataset) {
    for (const Hdf5Chunk& chunk : dataset.chunks) bytes += chunk.bytes.size();
    datasets.push_back(std::move(dataset));
    if (bytes >= kMostPending || datasets.size() >= kMostDatasets) write();
  }

  void write() {
    std::vector<std::pair<const Dataset*, Hdf5Chunk*>> all;
    for (Dataset& dataset : datasets)
      for (Hdf5Chunk& chunk : dataset.chunks) all.emplace_back(&dataset, &chunk);
    {
      const NeverCancelled whole;
      parallel_for(all.size(), [&](std::size_t k) {
        const auto& [dataset, chunk] = all[k];
        const std::vector<unsigned char> plain = shuffled(chunk->bytes, dataset->width);
        uLongf size = compressBound(plain.size());
        chunk->bytes.resize(size);
        if (compress2(chunk->bytes.data(), &size, plain.data(), plain.size(), kDeflateLevel) != Z_OK)
          cannot_write(dataset->name);
        chunk->bytes.resize(size);
      });
    }
    for (const auto& [dataset, chunk] : all)
      if (HDF5(H5Dwrite_chunk)(dataset->id.get(), H5P_DEFAULT, 0, chunk->offset.data(), chunk->bytes.size(),
                               chunk->bytes.data()) < 0)
        cannot_write(dataset->name);
    datasets.clear();
    bytes = 0;
  }
};

namespace {

/// pending: where values to be compressed go; none for those that are not numbers.
void write_values(hid_t group, const Hdf5Dataset& what, hid_t type, const void* data, std::size_t count,
                  Hdf5Pending* pending) {
  check_name(what.name);
  const std::vector<hsize_t> size(what.shape.begin(), what.shape.end());
  hsize_t wanted = 1;
  for (const hsize_t length : size) wanted *= length;
  if (wanted != count)
    throw Error(ErrorKind::configuration,
                fmt::format("{} has {} values where its shape asks for {}", what.name, count, wanted));
  const Hdf5Id space = make_space(size, what.name), creation = timeless(HDF5(H5P_CLS_DATASET_CREATE_ID_g), what.name);
  const bool compressed = pending != nullptr && what.compressed && !size.empty() && count > 0 &&
                          HDF5(H5Zfilter_avail)(H5Z_FILTER_DEFLATE) > 0;
  const std::vector<hsize_t> chunk = compressed ? chunk_size(size) : std::vector<hsize_t>{};
  if (compressed &&
      (HDF5(H5Pset_chunk)(creation.get(), static_cast<int>(size.size()), chunk.data()) < 0 ||
       HDF5(H5Pset_shuffle)(creation.get()) < 0 || HDF5(H5Pset_deflate)(creation.get(), kDeflateLevel) < 0))
    cannot_write(what.name);
  Hdf5Id dataset =
      written(HDF5(H5Dcreate2)(group, what.name.c_str(), type, space.get(), H5P_DEFAULT, creation.get(), H5P_DEFAULT),
              what.name);
  if (!compressed && count > 0 && HDF5(H5Dwrite)(dataset.get(), type, H5S_ALL, H5S_ALL, H5P_DEFAULT, data) < 0)
    cannot_write(what.name);
  AttributeWriter{dataset.get(), "unit"}(what.unit);
  AttributeWriter{dataset.get(), "meaning"}(what.meaning);
  if (!compressed) return;
  const std::size_t width = HDF5(H5Tget_size)(type);
  pending->add(
      {std::move(dataset), what.name, width, cut(size, chunk, static_cast<const unsigned char*>(data), width)});
}

/// Memory of a file, which the library leaves to the image where it would free it at the end.
void* grow(void* old, std::size_t size, H5FD_file_image_op_t, void*) { return std::realloc(old, size); }
void* begin_image(std::size_t size, H5FD_file_image_op_t operation, void* image) {
  return grow(nullptr, size, operation, image);
}
void* copy_image(void* to, const void* from, std::size_t size, H5FD_file_image_op_t, void*) {
  return std::memcpy(to, from, size);
}
herr_t end_image(void* memory, H5FD_file_image_op_t operation, void* image) {
  if (operation == H5FD_FILE_IMAGE_OP_FILE_CLOSE)
    static_cast<Hdf5Image*>(image)->bytes.reset(static_cast<char*>(memory));
  else
    std::free(memory);
  return 0;
}
void* same_image(void* image) { return image; }
herr_t keep_image(void*) { return 0; }

/// A file in memory: writing to a disk that is full would leave the library in a state that it does not survive. The
/// oldest format with check sums, so that damage does not mislead the library.
Hdf5Id open_in_memory(const std::string& name, Hdf5Image& image) {
  constexpr std::size_t kIncrement = std::size_t{1} << 20;
  H5FD_file_image_callbacks_t calls{begin_image, copy_image, grow, end_image, same_image, keep_image, &image};
  const Hdf5Id creation = timeless(HDF5(H5P_CLS_FILE_CREATE_ID_g), name),
               access = written(HDF5(H5Pcreate)(HDF5(H5P_CLS_FILE_ACCESS_ID_g)), name);
  if (HDF5(H5Pset_libver_bounds)(access.get(), H5F_LIBVER_V18, H5F_LIBVER_V18) < 0 ||
      HDF5(H5Pset_fclose_degree)(access.get(), H5F_CLOSE_STRONG) < 0 ||  // groups may still be open
      // nothing in reserve: the image ends where the file does
      HDF5(H5Pset_meta_block_size)(access.get(), 0) < 0 || HDF5(H5Pset_small_data_block_size)(access.get(), 0) < 0 ||
      HDF5(H5Pset_fapl_core)(access.get(), kIncrement, false) < 0 ||
      HDF5(H5Pset_file_image_callbacks)(access.get(), &calls) < 0)
    cannot_write(name);
  return written(HDF5(H5Fcreate)(name.c_str(), kTruncate, creation.get(), access.get()), name);
}

// What stands behind the content of a file: this and eight hexadecimal digits (CRC-32 of ISO 3309).
constexpr std::string_view kCheckSum = "treadmark-crc32 ";
constexpr std::size_t kDigits = 8;

uLong crc_of(uLong before, std::string_view bytes) {
  return crc32_z(before, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size());
}

std::string check_sum_text(uLong crc) { return fmt::format("{}{:08x}", kCheckSum, crc); }

/// Of a file that was cut off in the end of it.
bool ends_within_check_sum(std::string_view end) {
  const std::size_t at = end.rfind(kCheckSum.substr(0, 5));
  return at != std::string_view::npos && at > 0 && kCheckSum.starts_with(end.substr(at, kCheckSum.size()));
}

/// False where a file is not as Hdf5Writer left it. Earlier versions and other programs write no check sum.
bool check_sum_holds(const std::filesystem::path& file) {
  constexpr std::size_t kBehind = kCheckSum.size() + kDigits;
  std::error_code failure;
  const std::uint64_t size = std::filesystem::file_size(file, failure);
  std::ifstream in(file, std::ios::binary);
  if (failure || !in || size < kBehind) return true;
  std::string behind(kBehind, '\0'), piece(std::min<std::uint64_t>(size, std::uint64_t{1} << 20), '\0');
  in.seekg(static_cast<std::streamoff>(size - kBehind));
  if (!in.read(behind.data(), kBehind)) return true;
  if (!behind.starts_with(kCheckSum)) return !ends_within_check_sum(behind);
  in.seekg(0);
  uLong crc = 0;
  for (std::uint64_t left = size - kBehind; left > 0;) {
    const std::size_t count = static_cast<std::size_t>(std::min<std::uint64_t>(left, piece.size()));
    if (!in.read(piece.data(), static_cast<std::streamsize>(count))) return true;
    crc = crc_of(crc, {piece.data(), count});
    left -= count;
  }
  return behind == check_sum_text(crc);
}

/// Whether a program holds the lock that HDF5 takes of files that it writes.
bool is_locked(const std::filesystem::path& file) {
  const int descriptor = ::open(file.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) return false;
  const bool locked = ::flock(descriptor, LOCK_SH | LOCK_NB) != 0 && errno == EWOULDBLOCK;
  ::close(descriptor);
  return locked;
}

Hdf5Id open_to_read(const std::filesystem::path& file) {
  require_file(file, "file of results", ErrorKind::input_data);
  const auto refuse = [&](const char* what) {
    if (is_locked(file))
      throw Error(ErrorKind::input_data, "HDF5: another program has the file open for writing", {file.string()},
                  "close it there first");
    cannot_read(file.string(), what);
  };
  if (!check_sum_holds(file)) refuse("the file: it is damaged, or another program has changed it");
  if (!text_heaps_sound(file)) refuse("the file: it is damaged");
  Hdf5Id id(HDF5(H5Fopen)(file.c_str(), kReadOnly, H5P_DEFAULT));
  if (id.get() < 0) refuse("the file");
  return id;
}

/// Number of values in a data space; negative where it cannot be read.
hssize_t count_of(const Hdf5Id& space) {
  const hssize_t count = space.get() < 0 ? -1 : HDF5(H5Sget_simple_extent_npoints)(space.get());
  return count > kMostValues ? -1 : count;
}

/// Reads count texts with read(type, where to put pointers); false where they are none.
template <class Read>
bool read_texts(const Hdf5Id& stored, hssize_t count, std::vector<std::string>& out, Read read) {
  if (stored.get() < 0 || count < 0 || HDF5(H5Tis_variable_str)(stored.get()) <= 0) return false;
  std::vector<char*> texts(static_cast<std::size_t>(count), nullptr);
  const bool done = count == 0 || read(stored.get(), texts.data()) >= 0;  // as stored: ASCII is not converted to UTF-8
  for (char* text : texts) {
    if (done) out.emplace_back(text == nullptr ? "" : text);
    HDF5(H5free_memory)(text);
  }
  return done;
}

std::vector<std::string> attribute_texts(hid_t object, const std::string& name, const std::string& file) {
  std::vector<std::string> out;
  const Hdf5Id attribute(HDF5(H5Aopen)(object, name.c_str(), H5P_DEFAULT));
  if (attribute.get() < 0) cannot_read(file, "the attribute " + name);
  const Hdf5Id type(HDF5(H5Aget_type)(attribute.get())), space(HDF5(H5Aget_space)(attribute.get()));
  if (!read_texts(type, count_of(space), out,
                  [&](hid_t text, char** to) { return HDF5(H5Aread)(attribute.get(), text, to); }))
    cannot_read(file, "the attribute " + name);
  return out;
}

std::string first_text(std::vector<std::string> texts, const std::string& name, const std::string& file) {
  if (texts.size() != 1) cannot_read(file, "the attribute " + name);
  return std::move(texts.front());
}

/// Numbers of an attribute, exactly so many.
void read_attribute(hid_t object, const std::string& name, H5T_class_t kind, hid_t type, hssize_t count, void* out,
                    const std::string& file) {
  const Hdf5Id attribute(HDF5(H5Aopen)(object, name.c_str(), H5P_DEFAULT));
  if (attribute.get() < 0) cannot_read(file, "the attribute " + name);
  const Hdf5Id stored(HDF5(H5Aget_type)(attribute.get())), space(HDF5(H5Aget_space)(attribute.get()));
  if (stored.get() < 0 || HDF5(H5Tget_class)(stored.get()) != kind || count_of(space) != count ||
      HDF5(H5Aread)(attribute.get(), type, out) < 0)
    cannot_read(file, "the attribute " + name);
}

std::vector<std::size_t> shape_of(hid_t group, const std::string& name, const std::string& file) {
  const Hdf5Id dataset(HDF5(H5Dopen2)(group, name.c_str(), H5P_DEFAULT));
  if (dataset.get() < 0) cannot_read(file, name);
  const Hdf5Id space(HDF5(H5Dget_space)(dataset.get()));
  hsize_t size[H5S_MAX_RANK] = {};
  const int rank = space.get() < 0 ? -1 : HDF5(H5Sget_simple_extent_dims)(space.get(), size, nullptr);
  if (rank < 0) cannot_read(file, name);
  return {size, size + rank};
}

void require_shape(const std::vector<std::size_t>& found, const std::vector<std::size_t>& wanted,
                   const std::string& name, const std::string& file) {
  if (found == wanted) return;
  cannot_read(
      file, fmt::format("{}: it has the shape [{}], not [{}]", name, fmt::join(found, ", "), fmt::join(wanted, ", ")));
}

/// A chunk whose place is lost would read as zeros, one whose filters are left out as noise: its index has no check
/// sum.
bool chunks_are_there(const Hdf5Id& dataset, const Hdf5Id& space) {
  const Hdf5Id creation(HDF5(H5Dget_create_plist)(dataset.get()));
  if (creation.get() < 0) return false;
  if (HDF5(H5Pget_layout)(creation.get()) != H5D_CHUNKED) return true;
  hsize_t size[H5S_MAX_RANK] = {}, chunk[H5S_MAX_RANK] = {}, offset[H5S_MAX_RANK] = {};
  const int rank = HDF5(H5Sget_simple_extent_dims)(space.get(), size, nullptr);
  if (rank < 1 || HDF5(H5Pget_chunk)(creation.get(), rank, chunk) != rank) return false;
  for (int k = rank - 1; k >= 0;) {
    haddr_t place = HADDR_UNDEF;
    hsize_t stored = 0, found = 0;  // the latter by the way that reading takes
    unsigned left_out = 0;          // of the filters, of which all are in use
    if (HDF5(H5Dget_chunk_info_by_coord)(dataset.get(), offset, &left_out, &place, &stored) < 0 ||
        place == HADDR_UNDEF || left_out != 0 || HDF5(H5Dget_chunk_storage_size)(dataset.get(), offset, &found) < 0 ||
        found != stored)
      return false;
    for (k = rank - 1; k >= 0 && (offset[k] += chunk[k]) >= size[k]; --k) offset[k] = 0;
  }
  return true;
}

template <class Value>
std::vector<Value> read_values(hid_t group, const std::string& name, hid_t type, const std::string& file) {
  const Hdf5Id dataset(HDF5(H5Dopen2)(group, name.c_str(), H5P_DEFAULT));
  if (dataset.get() < 0) cannot_read(file, name);
  const Hdf5Id space(HDF5(H5Dget_space)(dataset.get()));
  const hssize_t count = count_of(space);
  if (count < 0) cannot_read(file, name);
  // A damaged file may claim any number of values.
  const double stored = static_cast<double>(HDF5(H5Dget_storage_size)(dataset.get()));
  if (static_cast<double>(count) * static_cast<double>(sizeof(Value)) > kDensest * stored) cannot_read(file, name);
  if (count > 0 && !chunks_are_there(dataset, space)) cannot_read(file, name + ": a part of it is lost");
  std::vector<Value> out(static_cast<std::size_t>(count));
  if (count > 0 && HDF5(H5Dread)(dataset.get(), type, H5S_ALL, H5S_ALL, H5P_DEFAULT, out.data()) < 0)
    cannot_read(file, name);
  return out;
}

}  // namespace

Hdf5Id::~Hdf5Id() {
  if (id_ >= 0) HDF5(H5Idec_ref)(id_);
}

Hdf5Silence::Hdf5Silence() {
  H5E_auto2_t function = nullptr;
  HDF5(H5Eget_auto2)(H5E_DEFAULT, &function, &data_);
  function_ = reinterpret_cast<void*>(function);
  HDF5(H5Eset_auto2)(H5E_DEFAULT, nullptr, nullptr);
}

Hdf5Silence::~Hdf5Silence() { HDF5(H5Eset_auto2)(H5E_DEFAULT, reinterpret_cast<H5E_auto2_t>(function_), data_); }

Hdf5GroupWriter Hdf5GroupWriter::make_group(const std::string& name) const {
  check_name(name);
  const Hdf5Id creation = timeless(HDF5(H5P_CLS_GROUP_CREATE_ID_g), name);
  return {written(HDF5(H5Gcreate2)(id_.get(), name.c_str(), H5P_DEFAULT, creation.get(), H5P_DEFAULT), name), pending_};
}

void Hdf5GroupWriter::add(const Attribute& attribute) const {
  std::visit(AttributeWriter{id_.get(), attribute.name}, attribute.value);
}

void Hdf5GroupWriter::add(std::span<const Attribute> attributes) const {
  for (const Attribute& one : attributes) add(one);
}

void Hdf5GroupWriter::write(const Hdf5Dataset& dataset, std::span<const double> values) const {
  write_values(id_.get(), dataset, HDF5(H5T_NATIVE_DOUBLE_g), values.data(), values.size(), pending_.get());
}

void Hdf5GroupWriter::write(const Hdf5Dataset& dataset, std::span<const std::uint8_t> values) const {
  write_values(id_.get(), dataset, HDF5(H5T_NATIVE_UINT8_g), values.data(), values.size(), pending_.get());
}

void Hdf5GroupWriter::write(const Hdf5Dataset& dataset, std::span<const std::string> values) const {
  write_values(id_.get(), dataset, string_type().get(), pointers(values).data(), values.size(), nullptr);
}

void Hdf5GroupWriter::copy_file(const std::filesystem::path& source, const std::string& name) const {
  check_name(name);
  const Hdf5Id file = open_to_read(source);
  if (HDF5(H5Ocopy)(file.get(), "/", id_.get(), name.c_str(), H5P_DEFAULT, H5P_DEFAULT) < 0)
    cannot_read(source.string(), "the file: it is damaged");
}

Hdf5Writer::Hdf5Writer(std::filesystem::path file)
    : target_(std::move(file)),
      file_(open_in_memory(target_.string(), image_)),
      root_(written(HDF5(H5Gopen2)(file_.get(), "/", H5P_DEFAULT), target_.string()), std::make_shared<Hdf5Pending>()) {
}

void Hdf5Writer::commit() {
  root_.pending_->write();
  root_ = {Hdf5Id(), nullptr};
  const ssize_t size =
      HDF5(H5Fflush)(file_.get(), H5F_SCOPE_GLOBAL) < 0 ? -1 : HDF5(H5Fget_file_image)(file_.get(), nullptr, 0);
  if (size < 0 || HDF5(H5Fclose)(file_.release()) < 0 || !image_.bytes) cannot_write(target_.string());
  const std::string_view content(image_.bytes.get(), static_cast<std::size_t>(size));
  OutputFile file(target_);
  file.write(content);
  file.write(check_sum_text(crc_of(0, content)));
  file.commit();
  image_.bytes.reset();
}

namespace {

Hdf5Id type_of(const Hdf5Column& column) {
  using Kind = Hdf5Column::Kind;
  Hdf5Id type = written(HDF5(H5Tcopy)(column.kind == Kind::text   ? HDF5(H5T_C_S1_g)
                                      : column.kind == Kind::byte ? HDF5(H5T_NATIVE_UINT8_g)
                                                                  : HDF5(H5T_NATIVE_DOUBLE_g)),
                        column.name);
  if (column.kind == Kind::text &&
      (HDF5(H5Tset_size)(type.get(), column.width) < 0 || HDF5(H5Tset_cset)(type.get(), H5T_CSET_UTF8) < 0 ||
       HDF5(H5Tset_strpad)(type.get(), H5T_STR_NULLPAD) < 0))
    cannot_write(column.name);
  return type;
}

/// Makes a column without values; where they are to stand.
std::uint64_t make_column(hid_t group, const Hdf5Column& column) {
  check_name(column.name);
  const Hdf5Id space = make_space({column.rows}, column.name), type = type_of(column),
               creation = timeless(HDF5(H5P_CLS_DATASET_CREATE_ID_g), column.name);
  if (HDF5(H5Pset_alloc_time)(creation.get(), H5D_ALLOC_TIME_EARLY) < 0 ||
      HDF5(H5Pset_fill_time)(creation.get(), H5D_FILL_TIME_NEVER) < 0)
    cannot_write(column.name);
  const Hdf5Id dataset = written(
      HDF5(H5Dcreate2)(group, column.name.c_str(), type.get(), space.get(), H5P_DEFAULT, creation.get(), H5P_DEFAULT),
      column.name);
  AttributeWriter{dataset.get(), "unit"}(column.unit);
  AttributeWriter{dataset.get(), "meaning"}(column.meaning);
  if (column.rows == 0) return 0;
  const haddr_t place = HDF5(H5Dget_offset)(dataset.get());
  if (place == HADDR_UNDEF) cannot_write(column.name);
  return place;
}

/// The heads of the columns are small; what they make room for must be there before the library begins.
void require_room(const std::filesystem::path& file, std::span<const Hdf5Column> columns) {
  constexpr std::uintmax_t kHead = 4096, kMega = 1000000;
  std::uintmax_t wanted = kHead;
  for (const Hdf5Column& column : columns) wanted += kHead + column.rows * column.width;
  std::error_code unknown;
  const std::filesystem::space_info room = std::filesystem::space(file.parent_path(), unknown);
  if (!unknown && room.available < wanted)
    throw Error(ErrorKind::configuration, fmt::format("HDF5: {} MB do not fit on the disk", wanted / kMega), {},
                "make room there, or choose another folder");
}

}  // namespace

Hdf5ColumnFile::Hdf5ColumnFile(std::filesystem::path file, std::span<const Attribute> attributes,
                               std::span<const Hdf5Column> columns)
    : file_(std::move(file)) {
  const Hdf5Silence silence;
  require_room(file_, columns);
  {
    const Hdf5Id creation = timeless(HDF5(H5P_CLS_FILE_CREATE_ID_g), file_.string()),
                 access = written(HDF5(H5Pcreate)(HDF5(H5P_CLS_FILE_ACCESS_ID_g)), file_.string());
    if (HDF5(H5Pset_libver_bounds)(access.get(), H5F_LIBVER_V18, H5F_LIBVER_V18) < 0 ||
        HDF5(H5Pset_fclose_degree)(access.get(), H5F_CLOSE_STRONG) < 0)
      cannot_write(file_.string());
    Hdf5Id made = written(HDF5(H5Fcreate)(file_.c_str(), kTruncate, creation.get(), access.get()), file_.string());
    {
      const Hdf5Id root = written(HDF5(H5Gopen2)(made.get(), "/", H5P_DEFAULT), file_.string());
      for (const Attribute& attribute : attributes)
        std::visit(AttributeWriter{root.get(), attribute.name}, attribute.value);
      for (const Hdf5Column& column : columns) places_.push_back({make_column(root.get(), column), column.width});
    }
    if (HDF5(H5Fclose)(made.release()) < 0) cannot_write(file_.string());
  }
  descriptor_ = ::open(file_.c_str(), O_RDWR | O_CLOEXEC);
  if (descriptor_ < 0) cannot_write(file_.string());
}

Hdf5ColumnFile::~Hdf5ColumnFile() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

void Hdf5ColumnFile::put(std::uint64_t at, const void* bytes, std::size_t size) {
  const char* from = static_cast<const char*>(bytes);
  while (size > 0) {
    const ssize_t done = ::pwrite(descriptor_, from, size, static_cast<off_t>(at));
    if (done < 0 && errno == EINTR) continue;
    if (done <= 0) cannot_write(file_.string());
    from += done, at += static_cast<std::uint64_t>(done), size -= static_cast<std::size_t>(done);
  }
}

void Hdf5ColumnFile::write(std::size_t column, std::size_t row, std::span<const double> values) {
  put(places_.at(column).offset + row * sizeof(double), values.data(), values.size_bytes());
}

void Hdf5ColumnFile::write(std::size_t column, std::size_t row, std::span<const std::uint8_t> values) {
  put(places_.at(column).offset + row, values.data(), values.size());
}

void Hdf5ColumnFile::write(std::size_t column, std::size_t row, const std::string& text) {
  std::string padded = text;
  padded.resize(places_.at(column).width, '\0');
  put(places_[column].offset + row * padded.size(), padded.data(), padded.size());
}

void Hdf5ColumnFile::finish() {
  uLong crc = 0;
  std::uint64_t at = 0;
  for (std::string piece(std::size_t{1} << 20, '\0');;) {
    check_cancelled();
    const ssize_t count = ::pread(descriptor_, piece.data(), piece.size(), static_cast<off_t>(at));
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) cannot_write(file_.string());
    if (count == 0) break;
    crc = crc_of(crc, {piece.data(), static_cast<std::size_t>(count)});
    at += static_cast<std::uint64_t>(count);
  }
  const std::string sum = check_sum_text(crc);
  put(at, sum.data(), sum.size());
  if (::fsync(descriptor_) != 0 && errno != EINVAL && errno != ENOTSUP) cannot_write(file_.string());
}

bool Hdf5GroupReader::has(const std::string& name) const {
  const htri_t there = HDF5(H5Lexists)(id_.get(), name.c_str(), H5P_DEFAULT);
  if (there < 0) cannot_read(file_, name);
  return there > 0;
}

Hdf5GroupReader Hdf5GroupReader::open_group(const std::string& name) const {
  Hdf5Id id(HDF5(H5Gopen2)(id_.get(), name.c_str(), H5P_DEFAULT));
  if (id.get() < 0) cannot_read(file_, name);
  return {std::move(id), file_};
}

std::vector<std::string> Hdf5GroupReader::names() const {
  // In one pass: a name by its index costs the library a sorting of all.
  std::vector<std::string> out;
  const auto take = [](hid_t, const char* name, const H5L_info_t*, void* to) -> herr_t {
    try {
      static_cast<std::vector<std::string>*>(to)->emplace_back(name);
    } catch (...) {  // never through the library's own frames
      return -1;
    }
    return static_cast<std::vector<std::string>*>(to)->back().size() <= kLongestName ? 0 : -1;
  };
  if (HDF5(H5Literate)(id_.get(), H5_INDEX_NAME, H5_ITER_INC, nullptr, take, &out) < 0)
    cannot_read(file_, "the names in a group");
  return out;
}

bool Hdf5GroupReader::has_attribute(const std::string& name) const {
  const htri_t there = HDF5(H5Aexists)(id_.get(), name.c_str());
  if (there < 0) cannot_read(file_, "the attribute " + name);
  return there > 0;
}

int Hdf5GroupReader::integer(const std::string& name) const {
  int value = 0;
  read_attribute(id_.get(), name, H5T_INTEGER, HDF5(H5T_NATIVE_INT_g), 1, &value, file_);
  return value;
}

double Hdf5GroupReader::number(const std::string& name) const {
  double value = 0.0;
  read_attribute(id_.get(), name, H5T_FLOAT, HDF5(H5T_NATIVE_DOUBLE_g), 1, &value, file_);
  return value;
}

Vec3 Hdf5GroupReader::vector(const std::string& name) const {
  Vec3 value;
  read_attribute(id_.get(), name, H5T_FLOAT, HDF5(H5T_NATIVE_DOUBLE_g), 3, value.data(), file_);
  return value;
}

Mat3 Hdf5GroupReader::matrix(const std::string& name) const {
  Mat3 rows;  // stored by columns: HDF5 counts by rows
  read_attribute(id_.get(), name, H5T_FLOAT, HDF5(H5T_NATIVE_DOUBLE_g), 9, rows.data(), file_);
  return rows.transpose();
}

std::string Hdf5GroupReader::text(const std::string& name) const { return first_text(texts(name), name, file_); }

std::vector<std::string> Hdf5GroupReader::texts(const std::string& name) const {
  return attribute_texts(id_.get(), name, file_);
}

std::string Hdf5GroupReader::text_of(const std::string& dataset, const std::string& name) const {
  const Hdf5Id object(HDF5(H5Dopen2)(id_.get(), dataset.c_str(), H5P_DEFAULT));
  if (object.get() < 0) cannot_read(file_, dataset);
  return first_text(attribute_texts(object.get(), name, file_), name, file_);
}

std::vector<double> Hdf5GroupReader::numbers(const std::string& dataset) const {
  return read_values<double>(id_.get(), dataset, HDF5(H5T_NATIVE_DOUBLE_g), file_);
}

std::vector<std::uint8_t> Hdf5GroupReader::bytes(const std::string& dataset) const {
  return read_values<std::uint8_t>(id_.get(), dataset, HDF5(H5T_NATIVE_UINT8_g), file_);
}

std::vector<std::size_t> Hdf5GroupReader::shape(const std::string& dataset) const {
  return shape_of(id_.get(), dataset, file_);
}

std::vector<double> Hdf5GroupReader::numbers(const std::string& dataset, const std::vector<std::size_t>& wanted) const {
  require_shape(shape(dataset), wanted, dataset, file_);
  return numbers(dataset);
}

std::vector<std::uint8_t> Hdf5GroupReader::bytes(const std::string& dataset,
                                                 const std::vector<std::size_t>& wanted) const {
  require_shape(shape(dataset), wanted, dataset, file_);
  return bytes(dataset);
}

std::vector<std::string> Hdf5GroupReader::strings(const std::string& dataset) const {
  const Hdf5Id object(HDF5(H5Dopen2)(id_.get(), dataset.c_str(), H5P_DEFAULT));
  if (object.get() < 0) cannot_read(file_, dataset);
  const Hdf5Id type(HDF5(H5Dget_type)(object.get())), space(HDF5(H5Dget_space)(object.get()));
  std::vector<std::string> out;
  const auto read = [&](hid_t text, char** to) {
    return HDF5(H5Dread)(object.get(), text, H5S_ALL, H5S_ALL, H5P_DEFAULT, to);
  };
  if (!read_texts(type, count_of(space), out, read)) cannot_read(file_, dataset);
  return out;
}

Hdf5Reader::Hdf5Reader(const std::filesystem::path& file)
    : file_(open_to_read(file)), root_(Hdf5Id(HDF5(H5Gopen2)(file_.get(), "/", H5P_DEFAULT)), file.string()) {}

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
