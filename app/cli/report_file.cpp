// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/app/cli/report_file.hpp"

#include <cstdlib>
#include <string>

#include "treadmark/app/report/pages/read_report.hpp"
#include "treadmark/app/report/write_page.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/io/files/atomic_file.hpp"

namespace treadmark::cli {

void write_report_file(const std::filesystem::path& file, const std::function<app::report::Page()>& page) {
  if (!file.empty()) io::write_text_file(file, app::report::to_html(page()));
}

ResultFolder::ResultFolder(const std::filesystem::path& folder, const std::filesystem::path& report_file)
    : path_(folder), report_file_(report_file) {
  if (!path_.empty() || report_file_.empty()) return;
  std::string name = (std::filesystem::temp_directory_path() / "treadmark-XXXXXX").string();
  if (mkdtemp(name.data()) == nullptr)
    throw Error(ErrorKind::configuration, "cannot make a temporary folder", {name}, "give a folder with -o");
  path_ = name;
  temporary_ = true;
}

ResultFolder::~ResultFolder() {
  std::error_code ignored;
  if (temporary_) std::filesystem::remove_all(path_, ignored);
}

void ResultFolder::write_report() const {
  write_report_file(report_file_, [&] { return app::report::read_report(path_); });
}

}  // namespace treadmark::cli
