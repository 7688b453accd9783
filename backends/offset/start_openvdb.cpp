// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/backends/offset/vdb_file.hpp"
#include "treadmark/core/helper_process.hpp"

namespace treadmark::offset {

std::unique_ptr<Channel> start_openvdb(const std::string& file, int longest_silence) {
  return start_helper({"treadmark-openvdb", "OpenVDB", "files of VDB and level sets", "openvdb", longest_silence},
                      file);
}

}  // namespace treadmark::offset
