// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <filesystem>
#include <string>
#include <system_error>

#include <stdlib.h>  // NOLINT(modernize-deprecated-headers): mkdtemp of POSIX

#include "treadmark/app/import/import_scan.hpp"
#include "treadmark/app/surfaces/named_surface.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/interfaces/c/calls.hpp"
#include "treadmark/interfaces/c/handles.hpp"
#include "treadmark/interfaces/c/surfaces.hpp"
#include "treadmark/model/shape/body_name.hpp"

namespace treadmark::c {
namespace {

/// A new folder for files that live as long as it.
class PassingFolder {
 public:
  PassingFolder() {
    std::string pattern = (std::filesystem::temp_directory_path() / "treadmark-XXXXXX").string();
    if (::mkdtemp(pattern.data()) == nullptr)
      throw Error(ErrorKind::configuration, "no folder can be made for files in between", {pattern},
                  "set TMPDIR to where there is room");
    path_ = pattern;
  }
  ~PassingFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  PassingFolder(const PassingFolder&) = delete;
  PassingFolder& operator=(const PassingFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

}  // namespace
}  // namespace treadmark::c

using namespace treadmark;
using namespace treadmark::c;

extern "C" tm_status tm_surface_from_scan(const char* const* files, size_t n_files, tm_body body,
                                          const char* const* settings, size_t n_settings, char** audit,
                                          tm_surface** out) {
  if (audit != nullptr) *audit = nullptr;
  return make(out, [&] {
    const Body which = body_of(body);
    app::ImportRequest request;
    for (const std::string& file : texts_of(files, n_files, "files must be n texts")) request.scans.emplace_back(file);
    require(!request.scans.empty(), "there must be a file at least");
    for (const std::string& setting : texts_of(settings, n_settings, "settings must be n texts"))
      io::set_import_setting(request.settings, setting);
    request.settings.scan.body = body_name(which);
    require(request.settings.scan.rails == "one", "a surface is one rail: leave scan.rails out");
    const PassingFolder folder;
    request.outputs = {folder.path() / (which == Body::wheel ? "scan.slcw" : "scan.slcs")};
    const io::ImportReport report = app::import_scan(request, callers_progress());
    auto made = natural_surface(app::named_surface(request.outputs.front(), {which, report.nominal_radius, 1.0, {}}));
    if (audit != nullptr) *audit = lasting(io::import_json(report, false));
    return made;
  });
}
