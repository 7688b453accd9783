// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "treadmark/tests/faults/file_tree.hpp"
#include "treadmark/tests/faults/shim/shim_memory.hpp"

namespace treadmark::testing {

/// One operation of a program under the shim. Paths are relative to its folder, which is "".
struct Operation {
  char what = 0;  ///< as LogHead::operation
  std::string path, to, data;
  std::uint64_t offset = 0;
};

/// Reads TREADMARK_FAULT_LOG.
std::vector<Operation> read_log(const std::filesystem::path& log, const std::filesystem::path& under);

/// What got a visible name in these operations.
Versions named_in(const FileTree& before, const std::vector<Operation>& log);

/// What a cut takes of that which was not yet synchronised.
struct Loss {
  enum class Data { kept, dropped, halved, zeroed, random };
  enum class Names { kept, dropped, random };  ///< of one folder they happen in order: some first ones are kept
  Data data = Data::kept;
  Names names = Names::kept;
  unsigned seed = 0;
};

/// A disk that loses power. A file's data are safe from the fsync after them, names from the fsync of their folder
/// (POSIX, fsync; nothing that a file system gives beyond it is relied on, but for the order within a folder).
class Disk {
 public:
  explicit Disk(const FileTree& start);
  void apply(const Operation& operation);
  /// What is found when the power is back.
  FileTree after_cut(const Loss& loss) const;

 private:
  struct Name {  ///< a change of a folder's list of names
    std::string name;
    int node = -1;  ///< -1: removed
    bool safe = false;
  };
  struct Piece {  ///< a write, or a truncation
    bool truncates = false;
    std::uint64_t offset = 0;
    std::string data;
    bool safe = false;
  };
  struct Node {
    bool folder = false;
    std::map<std::string, int> entries;  ///< as the running system sees them
    std::vector<Name> names;
    std::vector<Piece> pieces;
  };
  struct Place {
    int folder = -1;
    std::string name;
  };

  int make(bool folder);
  int find(const std::string& path) const;
  Place place_of(const std::string& path) const;
  void set(const Place& place, int node);

  std::vector<Node> nodes_;
};

}  // namespace treadmark::testing
