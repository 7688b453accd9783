// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace treadmark::io {

/// Results that take long, kept in a folder by what decides them. An entry is found only by its whole key and only
/// with all its bytes as they were kept; anything else in the folder is as if it were not there. Nothing here fails: a
/// folder that cannot be read or written finds and keeps nothing. Any number of threads and processes share a folder.
class ContentCache {
 public:
  static constexpr std::uintmax_t kMostBytes = 256u << 20;

  /// What is kept longest without use goes first where all entries together would have more than most bytes.
  explicit ContentCache(std::filesystem::path folder, std::uintmax_t most = kMostBytes);

  /// In $TREADMARK_CACHE, else $XDG_CACHE_HOME/treadmark, else ~/.cache/treadmark. Nothing where TREADMARK_CACHE is
  /// "off", or without any of them.
  static std::optional<ContentCache> from_environment();

  std::optional<std::vector<std::byte>> find(std::string_view key) const noexcept;
  void keep(std::string_view key, std::span<const std::byte> content) const noexcept;

  const std::filesystem::path& folder() const { return folder_; }
  /// Where an entry of this key lies, or would.
  std::filesystem::path file_of(std::string_view key) const;

 private:
  void remove_oldest() const;

  std::filesystem::path folder_;
  std::uintmax_t most_;
};

}  // namespace treadmark::io
