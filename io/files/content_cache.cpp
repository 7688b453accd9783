// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/io/files/content_cache.hpp"

#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iterator>
#include <system_error>
#include <utility>

#include "treadmark/core/output_file.hpp"
#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/io/files/sha256.hpp"

namespace treadmark::io {
namespace {

namespace fs = std::filesystem;

/// A file: this line, the digest of all behind it, the length of the key, key, content.
constexpr std::string_view kFirstLine = "treadmark kept result 1\n";
constexpr std::string_view kEnding = ".kept";
constexpr std::size_t kDigest = 64;

std::string packed(std::string_view key, std::span<const std::byte> content) {
  const std::uint64_t length = key.size();
  std::string body(sizeof length, '\0');
  std::memcpy(body.data(), &length, sizeof length);
  body += key;
  body.append(reinterpret_cast<const char*>(content.data()), content.size());
  return std::string(kFirstLine) + sha256_hex(body) + body;
}

std::optional<std::vector<std::byte>> unpacked(std::string_view file, std::string_view key) {
  std::uint64_t length = 0;
  if (file.size() < kFirstLine.size() + kDigest + sizeof length || !file.starts_with(kFirstLine)) return {};
  file.remove_prefix(kFirstLine.size());
  const std::string_view digest = file.substr(0, kDigest), body = file.substr(kDigest);
  if (sha256_hex(body) != digest) return {};
  std::memcpy(&length, body.data(), sizeof length);
  const std::string_view rest = body.substr(sizeof length);
  if (length != key.size() || !rest.starts_with(key)) return {};
  const auto content = std::as_bytes(std::span(rest.substr(key.size())));
  return std::vector<std::byte>(content.begin(), content.end());
}

const char* setting(const char* name) {
  const char* value = std::getenv(name);
  return value != nullptr && *value != '\0' ? value : nullptr;
}

}  // namespace

ContentCache::ContentCache(fs::path folder, std::uintmax_t most) : folder_(std::move(folder)), most_(most) {}

std::optional<ContentCache> ContentCache::from_environment() {
  if (const char* own = setting("TREADMARK_CACHE"))
    return std::string_view(own) == "off" ? std::nullopt : std::optional(ContentCache(own));
  // Of the base directories only absolute ones count (XDG Base Directory Specification).
  if (const char* base = setting("XDG_CACHE_HOME"); base != nullptr && fs::path(base).is_absolute())
    return ContentCache(fs::path(base) / "treadmark");
  if (const char* home = setting("HOME"); home != nullptr && fs::path(home).is_absolute())
    return ContentCache(fs::path(home) / ".cache" / "treadmark");
  return std::nullopt;
}

fs::path ContentCache::file_of(std::string_view key) const {
  return folder_ / (sha256_hex(key) + std::string(kEnding));
}

std::optional<std::vector<std::byte>> ContentCache::find(std::string_view key) const noexcept {
  try {
    const fs::path file = file_of(key);
    std::error_code error;
    if (!fs::is_regular_file(file, error) || fs::file_size(file, error) > most_ || error) return {};
    std::ifstream in(file, std::ios::binary);
    const std::string bytes{std::istreambuf_iterator<char>(in), {}};
    auto content = unpacked(bytes, key);
    if (content) fs::last_write_time(file, fs::file_time_type::clock::now(), error);
    return content;
  } catch (...) {
    return {};
  }
}

void ContentCache::keep(std::string_view key, std::span<const std::byte> content) const noexcept {
  try {
    make_folder(folder_);
    write_file(file_of(key), packed(key, content));
    remove_oldest();
  } catch (...) {
    // Made anew the next time.
  }
}

void ContentCache::remove_oldest() const {
  struct Entry {
    fs::file_time_type used;
    fs::path file;
    std::uintmax_t size;
  };
  std::vector<Entry> entries;
  std::uintmax_t all = 0;
  std::error_code error;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder_)) {
    if (entry.path().extension() != kEnding || !entry.is_regular_file(error)) continue;
    const Entry one{entry.last_write_time(error), entry.path(), entry.file_size(error)};
    if (error) continue;  // somebody else has removed it
    all += one.size;
    entries.push_back(one);
  }
  ranges::sort(entries,
               [](const Entry& a, const Entry& b) { return std::pair(a.used, a.file) < std::pair(b.used, b.file); });
  for (const Entry& entry : entries) {
    if (all <= most_) return;
    if (fs::remove(entry.file, error)) all -= entry.size;
  }
}

}  // namespace treadmark::io
