// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/core/parts.hpp"
#include "treadmark/io/hdf5/hdf5_reader.hpp"
#include "treadmark/io/hdf5/hdf5_writer.hpp"

// No file can be opened, so that there are no groups.
namespace treadmark::io {
namespace {

[[noreturn]] void without_hdf5() { left_out("hdf5", "files of fields and histories (.h5)"); }

}  // namespace

bool text_heaps_sound(const std::filesystem::path&) { return true; }

Hdf5Id::~Hdf5Id() = default;
Hdf5Silence::Hdf5Silence() = default;
Hdf5Silence::~Hdf5Silence() = default;

Hdf5Writer::Hdf5Writer(std::filesystem::path) : root_(Hdf5Id(), nullptr) { without_hdf5(); }
void Hdf5Writer::commit() { without_hdf5(); }

Hdf5GroupWriter Hdf5GroupWriter::make_group(const std::string&) const { without_hdf5(); }
void Hdf5GroupWriter::add(const Attribute&) const { without_hdf5(); }
void Hdf5GroupWriter::add(std::span<const Attribute>) const { without_hdf5(); }
void Hdf5GroupWriter::write(const Hdf5Dataset&, std::span<const double>) const { without_hdf5(); }
void Hdf5GroupWriter::write(const Hdf5Dataset&, std::span<const std::uint8_t>) const { without_hdf5(); }
void Hdf5GroupWriter::write(const Hdf5Dataset&, std::span<const std::string>) const { without_hdf5(); }
void Hdf5GroupWriter::copy_file(const std::filesystem::path&, const std::string&) const { without_hdf5(); }

Hdf5ColumnFile::Hdf5ColumnFile(std::filesystem::path, std::span<const Attribute>, std::span<const Hdf5Column>) {
  without_hdf5();
}
Hdf5ColumnFile::~Hdf5ColumnFile() = default;
void Hdf5ColumnFile::write(std::size_t, std::size_t, std::span<const double>) { without_hdf5(); }
void Hdf5ColumnFile::write(std::size_t, std::size_t, std::span<const std::uint8_t>) { without_hdf5(); }
void Hdf5ColumnFile::write(std::size_t, std::size_t, const std::string&) { without_hdf5(); }
void Hdf5ColumnFile::finish() { without_hdf5(); }

Hdf5Reader::Hdf5Reader(const std::filesystem::path& file) : root_(Hdf5Id(), file.string()) { without_hdf5(); }

bool Hdf5GroupReader::has(const std::string&) const { without_hdf5(); }
Hdf5GroupReader Hdf5GroupReader::open_group(const std::string&) const { without_hdf5(); }
std::vector<std::string> Hdf5GroupReader::names() const { without_hdf5(); }
bool Hdf5GroupReader::has_attribute(const std::string&) const { without_hdf5(); }
std::string Hdf5GroupReader::text(const std::string&) const { without_hdf5(); }
std::vector<std::string> Hdf5GroupReader::texts(const std::string&) const { without_hdf5(); }
int Hdf5GroupReader::integer(const std::string&) const { without_hdf5(); }
double Hdf5GroupReader::number(const std::string&) const { without_hdf5(); }
Vec3 Hdf5GroupReader::vector(const std::string&) const { without_hdf5(); }
Mat3 Hdf5GroupReader::matrix(const std::string&) const { without_hdf5(); }
std::string Hdf5GroupReader::text_of(const std::string&, const std::string&) const { without_hdf5(); }
std::vector<double> Hdf5GroupReader::numbers(const std::string&) const { without_hdf5(); }
std::vector<std::uint8_t> Hdf5GroupReader::bytes(const std::string&) const { without_hdf5(); }
std::vector<std::string> Hdf5GroupReader::strings(const std::string&) const { without_hdf5(); }
std::vector<double> Hdf5GroupReader::numbers(const std::string&, const std::vector<std::size_t>&) const {
  without_hdf5();
}
std::vector<std::uint8_t> Hdf5GroupReader::bytes(const std::string&, const std::vector<std::size_t>&) const {
  without_hdf5();
}
std::vector<std::size_t> Hdf5GroupReader::shape(const std::string&) const { without_hdf5(); }

}  // namespace treadmark::io
