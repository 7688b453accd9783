// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/app/cli/report_file.hpp"

#include "treadmark/app/report/write_page.hpp"
#include "treadmark/io/files/atomic_file.hpp"

namespace treadmark::cli {

void write_report_file(const std::filesystem::path& file, const std::function<app::report::Page()>& page) {
  if (!file.empty()) io::write_text_file(file, app::report::to_html(page()));
}

}  // namespace treadmark::cli
