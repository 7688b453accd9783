// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/app/fmu/fmu_file.hpp"

#include <fmt/format.h>
#include <zip.h>

#include <map>
#include <memory>
#include <utility>

#include "treadmark/app/fmu/resources.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/core/modules.hpp"
#include "treadmark/core/output_file.hpp"
#include "treadmark/io/cases/file_kind.hpp"
#include "treadmark/io/cases/read_case.hpp"

namespace treadmark::fmi {
namespace {

namespace fs = std::filesystem;

using Files = std::map<std::string, std::string>;  ///< contents by name in the archive

/// What every FMU takes along, compressed once, when Treadmark is built.
constexpr const char* kLibraries = "binaries.zip";

void add_folder(const fs::path& folder, const std::string& as, Files& files) {
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder))
    if (entry.is_regular_file())
      files[as + '/' + entry.path().lexically_relative(folder).generic_string()] = io::read_text(entry.path());
}

/// The folder with the shared library and what goes with it, for a pair one that knows no vehicles.
fs::path library_folder(bool pair) {
  const char* const name = pair ? "fmu-pair" : "fmu";
  std::error_code failed;
  for (const fs::path& place : module_folders())
    if (fs::exists(place / name / kLibraries, failed)) return place / name;
  throw Error(ErrorKind::configuration, "there is no library for FMUs beside this program", {},
              "install Treadmark again");
}

struct Discarded {
  void operator()(zip_t* archive) const { zip_discard(archive); }
};
struct Released {
  void operator()(zip_source_t* source) const { zip_source_free(source); }
};

[[noreturn]] void fail(const fs::path& output, const char* why) {
  throw Error(ErrorKind::configuration, fmt::format("cannot write {}: {}", output.string(), why));
}

/// A zip archive in memory, with the libraries under `as`. Times are those of the format's first day, so that the same
/// files make the same bytes.
std::string archive_of(const Files& files, const fs::path& libraries, const std::string& as, const fs::path& output) {
  zip_error_t error;
  zip_error_init(&error);
  int unreadable = 0;
  const std::unique_ptr<zip_t, Discarded> prepared(zip_open(libraries.c_str(), ZIP_RDONLY, &unreadable));
  if (prepared == nullptr) fail(output, (libraries.string() + " cannot be read: install Treadmark again").c_str());
  std::unique_ptr<zip_source_t, Released> memory(zip_source_buffer_create(nullptr, 0, 0, &error));
  if (memory == nullptr) fail(output, zip_error_strerror(&error));
  std::unique_ptr<zip_t, Discarded> archive(zip_open_from_source(memory.get(), ZIP_TRUNCATE, &error));
  if (archive == nullptr) fail(output, zip_error_strerror(&error));
  zip_source_keep(memory.get());  // the archive has taken the first hold on it
  const auto add = [&](const std::string& name, zip_source_t* content, zip_uint32_t mode) {
    constexpr zip_uint16_t kFirstDay = (1 << 5) | 1;
    const zip_int64_t added = content == nullptr ? -1 : zip_file_add(archive.get(), name.c_str(), content, 0);
    if (added < 0) {
      zip_source_free(content);
      fail(output, zip_strerror(archive.get()));
    }
    const auto index = static_cast<zip_uint64_t>(added);
    zip_file_set_dostime(archive.get(), index, 0, kFirstDay, 0);
    zip_file_set_external_attributes(archive.get(), index, 0, ZIP_OPSYS_UNIX, mode << 16);
  };
  for (const auto& [name, bytes] : files)
    add(name, zip_source_buffer(archive.get(), bytes.data(), bytes.size(), 0), 0100644u);
  const auto count = static_cast<zip_uint64_t>(zip_get_num_entries(prepared.get(), 0));
  for (zip_uint64_t i = 0; i < count; ++i)
    add(as + '/' + zip_get_name(prepared.get(), i, 0),
        zip_source_zip(archive.get(), prepared.get(), i, ZIP_FL_COMPRESSED, 0, -1), 0100755u);
  if (zip_close(archive.get()) != 0) fail(output, zip_strerror(archive.get()));
  (void)archive.release();  // closed

  zip_stat_t about;
  zip_stat_init(&about);
  if (zip_source_open(memory.get()) != 0 || zip_source_stat(memory.get(), &about) != 0)
    fail(output, zip_error_strerror(zip_source_error(memory.get())));
  std::string bytes(about.size, '\0');
  const zip_int64_t read = zip_source_read(memory.get(), bytes.data(), bytes.size());
  zip_source_close(memory.get());
  if (read != static_cast<zip_int64_t>(bytes.size())) fail(output, "the archive cannot be read back");
  return bytes;
}

}  // namespace

WrittenFmu write_fmu(const FmuContent& content) {
  // Never committed: gone with this object. Not beside the output, which may be a pipe.
  const OutputFolder stage(fs::temp_directory_path(), OutputFolder::Old::kept);
  Description about;
  about.name = content.output.stem().string();
  about.title = write_resources(content, stage.path());
  about.token = token_of(stage.path());
  const auto model = open_model(stage.path());
  const fs::path library = library_folder(!io::is_simulation_file(content.input));

  Files files;
  add_folder(stage.path(), "resources", files);
  add_folder(library / "licenses", "documentation/licenses", files);
  files["documentation/index.html"] = model_page(*model, about, content.version);
  files["modelDescription.xml"] = model_description(*model, about, content.version);
  const std::string bytes =
      archive_of(files, library / kLibraries,
                 content.version == Version::fmi3 ? "binaries/x86_64-linux" : "binaries/linux64", content.output);
  write_file(content.output, bytes);
  return {about.title, model->variables().all().size(), bytes.size()};
}

}  // namespace treadmark::fmi
