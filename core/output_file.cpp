// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/core/output_file.hpp"

#include <dirent.h>
#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstdio>
#include <functional>
#include <iterator>
#include <optional>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "treadmark/core/cancellation.hpp"
#include "treadmark/core/copy_bytes.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/core/output_claim.hpp"
#include "treadmark/core/platform/exchange_names.hpp"
#include "treadmark/core/platform/from_chars.hpp"

namespace treadmark {

namespace {

namespace fs = std::filesystem;

constexpr const char* kPart = ".part";
constexpr int kMostLinks = 40;
constexpr std::size_t kLongestStem = 200;  // names of 255 bytes are the longest that file systems take

std::string advice_of(int error) {
  switch (error) {
    case ENOSPC:
    case EDQUOT:
    case EFBIG:
      return "make room on the disk, or choose another output path";
    case EIO:
      return "check the disk, or choose another output path";
    case ELOOP:
      return "mend the symbolic link, or choose another output path";
    case EMFILE:
    case ENFILE:
      return "raise the limit of open files (ulimit -n)";
    case EPIPE:
      return "nobody reads the other end";
    default:
      return "choose another output path or make the folder writable";
  }
}

/// Whether a name is ".TARGET.partPID-NUMBER".
bool is_hidden_name(const std::string& name) {
  const std::size_t part = name.rfind(kPart);
  if (name.size() < 2 || name[0] != '.' || part == std::string::npos || part < 2) return false;
  const std::string rest = name.substr(part + 5);
  return rest.find_first_not_of("0123456789-") == std::string::npos && rest.find('-') != std::string::npos;
}

/// Users know a file by the name that it is to have.
fs::path shown(const fs::path& path) {
  fs::path out;
  for (const fs::path& part : path)
    if (!is_hidden_name(part.string())) out /= part;
  return out;
}

[[noreturn]] void cannot_write(const fs::path& path, const std::string& why, const std::string& advice) {
  throw Error(ErrorKind::configuration, "cannot write " + shown(path).string() + ": " + why, {}, advice);
}

[[noreturn]] void cannot_write(const fs::path& path, int error) {
  cannot_write(path, std::generic_category().message(error), advice_of(error));
}

int open_retrying(const char* path, int flags, mode_t mode = 0) {
  int descriptor = -1;
  do descriptor = ::open(path, flags | O_CLOEXEC, mode);
  while (descriptor < 0 && errno == EINTR);
  return descriptor;
}

/// 0 or an error number. File systems without it (EINVAL, ENOTSUP) cannot do better.
int to_disk(int descriptor) {
  int result = 0;
  do result = ::fsync(descriptor);
  while (result != 0 && errno == EINTR);
  return result == 0 || errno == EINVAL || errno == ENOTSUP || errno == EROFS ? 0 : errno;
}

int folder_to_disk(const fs::path& folder) {
  const int descriptor = open_retrying(folder.empty() ? "." : folder.c_str(), O_RDONLY | O_DIRECTORY);
  if (descriptor < 0) return errno == EACCES ? 0 : errno;  // a folder may be writable and not readable
  const int error = to_disk(descriptor);
  ::close(descriptor);
  return error;
}

/// The number in /proc/self/fd/N or /dev/fd/N.
std::optional<int> descriptor_number(const fs::path& path) {
  const std::string folder = path.parent_path().string(), name = path.filename().string();
  const std::string own = "/proc/" + std::to_string(::getpid()) + "/fd";
  if (folder != "/proc/self/fd" && folder != "/dev/fd" && folder != own) return {};
  int number = -1;
  const auto [end, error] = from_chars(name.data(), name.data() + name.size(), number);
  if (error != std::errc{} || end != name.data() + name.size() || number < 0) return {};
  return number;
}

/// Follows symbolic links, also to what does not exist, up to a descriptor.
fs::path without_links(const fs::path& named) {
  fs::path path = named;
  for (int link = 0;; ++link) {
    std::error_code error;
    if (descriptor_number(path)) return path;
    const fs::file_status status = fs::symlink_status(path, error);
    if (error && status.type() != fs::file_type::not_found) cannot_write(named, error.value());
    if (status.type() != fs::file_type::symlink) return path;
    if (link == kMostLinks) cannot_write(named, ELOOP);
    const fs::path next = fs::read_symlink(path, error);
    if (error) cannot_write(named, error.value());
    path = next.is_absolute() ? next : path.parent_path() / next;
  }
}

/// Makes the folder that a path lies in; those that were not there, the inner ones first.
std::vector<fs::path> make_parents(const fs::path& named, const fs::path& path) {
  const fs::path folder = path.parent_path();
  std::vector<fs::path> missing;
  std::error_code error;
  if (folder.empty() || fs::is_directory(folder, error)) return missing;
  // The entries of new folders are brought to the disk, too.
  for (fs::path at = folder; !at.empty() && !fs::exists(at, error) && at != at.parent_path(); at = at.parent_path())
    missing.push_back(at);
  fs::create_directories(folder, error);
  if (error) cannot_write(named, error.value());
  for (const fs::path& made : missing)
    if (const int failed = folder_to_disk(made.parent_path()); failed != 0) cannot_write(named, failed);
  return missing;
}

/// What hidden names of a target begin with.
std::string hidden_start(const fs::path& target) {
  std::string name = target.filename().string();
  if (name.size() > kLongestStem) {
    const std::size_t tail = std::hash<std::string>{}(name);
    name = name.substr(0, kLongestStem - 20) + '-' + std::to_string(tail);
  }
  return '.' + name + kPart;
}

fs::path hidden_name(const fs::path& target, const fs::path& folder) {
  static std::atomic<unsigned> count{0};
  return folder / (hidden_start(target) + std::to_string(::getpid()) + '-' + std::to_string(count++));
}

bool same_file(int descriptor, const fs::path& path) {
  struct stat open_one {
  }, named{};
  return ::fstat(descriptor, &open_one) == 0 && ::lstat(path.c_str(), &named) == 0 && open_one.st_dev == named.st_dev &&
         open_one.st_ino == named.st_ino;
}

/// Waits for who looks whether its maker is dead. Where the file system knows no locks, nobody is taken for dead.
void hold(int descriptor, int operation = LOCK_SH) {
  while (::flock(descriptor, operation) != 0 && errno == EINTR) {
  }
}

/// Writers hold a lock on what they write, which ends with them; a shared one, as who reads a file just renamed may
/// lock it too (HDF5).
void remove_if_dead(const fs::path& path) {
  const int descriptor = open_retrying(path.c_str(), O_RDONLY | O_NONBLOCK | O_NOFOLLOW);
  if (descriptor < 0) return;
  std::error_code ignored;
  if (::flock(descriptor, LOCK_EX | LOCK_NB) == 0 && same_file(descriptor, path)) fs::remove_all(path, ignored);
  ::close(descriptor);
}

/// start: what the names begin with; empty: all of them.
void remove_dead(const fs::path& folder, const std::string& start) noexcept {
  try {
    std::vector<fs::path> found;
    std::error_code error;
    fs::directory_iterator entry(folder.empty() ? fs::path(".") : folder, error);
    for (const fs::directory_iterator end; !error && entry != end; entry.increment(error)) {
      const std::string name = entry->path().filename().string();
      if (name.starts_with(start.empty() ? "." : start) && is_hidden_name(name)) found.push_back(entry->path());
    }
    for (const fs::path& path : found) remove_if_dead(path);
  } catch (...) {  // what is left over disturbs nobody
  }
}

}  // namespace

OutputFile::OutputFile(const fs::path& target) : named_(target), target_(target) {
  if (!target.has_filename()) cannot_write(named_, "not a file name", "name a file");
  target_ = without_links(target);
  if (const auto number = descriptor_number(target_)) {
    descriptor_ = ::fcntl(*number, F_DUPFD_CLOEXEC, 0);
    if (descriptor_ < 0) fail(errno);
    return;
  }
  struct stat old {};
  const bool exists = ::stat(target_.c_str(), &old) == 0;
  if (exists && S_ISDIR(old.st_mode)) cannot_write(named_, "it is a folder", "choose another output path");
  refuse_input_as_output(target_);
  if (exists && !S_ISREG(old.st_mode)) {
    descriptor_ = open_retrying(target_.c_str(), O_WRONLY | O_NOCTTY);
    if (descriptor_ < 0) fail(errno);
    return;
  }
  make_parents(named_, target_);
  remove_dead(target_.parent_path(), hidden_start(target_));
  constexpr mode_t kForAll = 0666;  // the umask says for whom
  do {
    temporary_ = hidden_name(target_, target_.parent_path());
    descriptor_ = open_retrying(temporary_.c_str(), O_WRONLY | O_CREAT | O_EXCL, kForAll);
    if (descriptor_ < 0 && errno != EEXIST) {
      const int error = errno;
      temporary_.clear();
      fail(error);
    }
    if (descriptor_ < 0) continue;
    hold(descriptor_);
    // Another writer may have taken the new file for one that a dead process left.
    if (same_file(descriptor_, temporary_)) break;
    ::close(descriptor_);
    descriptor_ = -1;
  } while (true);
  constexpr mode_t kPermissions = 0777;
  if (exists) static_cast<void>(::fchmod(descriptor_, old.st_mode & kPermissions));
}

OutputFile::~OutputFile() {
  if (descriptor_ >= 0 && !temporary_.empty()) ::unlink(temporary_.c_str());
  if (descriptor_ >= 0) ::close(descriptor_);
}

void OutputFile::fail(int error) const { cannot_write(named_, error); }

void OutputFile::write(std::string_view bytes) {
  constexpr std::size_t kPiece = std::size_t{1} << 24;  // what slow disks take within the time of a check point
  while (!bytes.empty()) {
    check_cancelled();
    const ssize_t count = ::write(descriptor_, bytes.data(), std::min(bytes.size(), kPiece));
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) fail(count == 0 ? EIO : errno);
    bytes.remove_prefix(static_cast<std::size_t>(count));
  }
}

void OutputFile::commit() {
  if (!temporary_.empty()) {
    if (const int error = to_disk(descriptor_); error != 0) fail(error);
    if (::rename(temporary_.c_str(), target_.c_str()) != 0) fail(errno);
    temporary_.clear();
    if (const int error = folder_to_disk(target_.parent_path()); error != 0) fail(error);
  }
  if (::close(std::exchange(descriptor_, -1)) != 0 && errno != EINTR) fail(errno);
}

void write_file(const fs::path& target, std::string_view bytes) {
  OutputFile file(target);
  file.write(bytes);
  file.commit();
}

void copy_bytes(const fs::path& made, const fs::path& target) {
  const auto cannot_read = [&](int error) {
    cannot_write(target, "what is to be written there cannot be read back: " + std::generic_category().message(error),
                 advice_of(error));
  };
  const int from = open_retrying(made.c_str(), O_RDONLY);
  if (from < 0) cannot_read(errno);
  const struct Closed {
    int descriptor;
    ~Closed() { ::close(descriptor); }
  } closed{from};
  OutputFile file(target);
  std::vector<char> piece(std::size_t{1} << 20);
  for (;;) {
    const ssize_t count = ::read(from, piece.data(), piece.size());
    if (count == 0) break;
    if (count > 0)
      file.write({piece.data(), static_cast<std::size_t>(count)});
    else if (errno != EINTR)
      cannot_read(errno);
  }
  file.commit();
}

OutputFolder::OutputFolder(const fs::path& target, Old old) : target_(without_links(target)) {
  if (!target_.has_filename()) target_ = target_.parent_path();  // "folder/"
  std::error_code error;
  if (fs::exists(target_, error) && !fs::is_directory(target_, error))
    cannot_write(target, "it is a file", "choose another output folder");
  // A folder that is kept may be one that nothing can be put beside.
  const fs::path beside = old == Old::kept ? target_ : target_.parent_path();
  made_ = make_parents(target_, beside / "x");
  const fs::path name = target_.filename() == "." || target_.filename() == ".." ? fs::path("output") : target_;
  remove_dead(beside, hidden_start(name));
  do {
    temporary_ = hidden_name(name, beside);
    if (!fs::create_directory(temporary_, error)) {
      if (!error) continue;
      temporary_.clear();
      fail(error);
    }
    lock_ = open_retrying(temporary_.c_str(), O_RDONLY | O_DIRECTORY);
    if (lock_ < 0 && errno == ENOENT) continue;
    if (lock_ >= 0) hold(lock_);
    if (lock_ < 0 || same_file(lock_, temporary_)) break;
    ::close(std::exchange(lock_, -1));
  } while (true);
}

OutputFolder::~OutputFolder() {
  if (!temporary_.empty()) remove_quietly(temporary_);
  for (const fs::path& folder : made_) ::rmdir(folder.c_str());  // only where nothing lies in it
  if (lock_ >= 0) ::close(lock_);
}

void OutputFolder::fail(const std::error_code& error) const { cannot_write(target_, error.value()); }

void OutputFolder::replace(const fs::path& as) {
  if (!as.empty()) target_ = as;
  made_.clear();
  if (const int error = folder_to_disk(temporary_); error != 0) cannot_write(target_, error);
  std::error_code error;
  if (fs::exists(target_, error)) {
    if (!exchange_names(temporary_.c_str(), target_.c_str())) {
      const fs::path aside = hidden_name(target_, target_.parent_path());
      fs::rename(target_, aside, error);
      if (error) fail(error);
      fs::rename(temporary_, target_, error);
      if (error) fail(error);
      temporary_ = aside;
    }
  } else {
    fs::rename(temporary_, target_, error);
    if (error) fail(error);
    temporary_.clear();
  }
  if (const int failed = folder_to_disk(target_.parent_path()); failed != 0) cannot_write(target_, failed);
  if (!temporary_.empty()) remove_quietly(std::exchange(temporary_, {}));
}

void OutputFolder::move_into(const std::string& last, const std::function<void()>& then) {
  const FolderLock lock(target_);
  std::error_code error;
  std::vector<fs::path> files;
  std::vector<fs::path> folders{target_};
  for (fs::recursive_directory_iterator entry(temporary_, error), end; !error && entry != end; entry.increment(error)) {
    const fs::path name = entry->path().lexically_relative(temporary_);
    if (entry->is_directory()) {
      fs::create_directories(target_ / name, error);
      if (error) fail(error);
      folders.push_back(target_ / name);
    } else if (name != last) {
      files.push_back(name);
    }
  }
  if (error) fail(error);
  std::stable_sort(files.begin(), files.end(), [](const fs::path& a, const fs::path& b) {
    return std::distance(a.begin(), a.end()) > std::distance(b.begin(), b.end());
  });
  const auto folder_written = [&](const fs::path& folder) {
    if (const int failed = folder_to_disk(folder); failed != 0) cannot_write(folder, failed);
  };
  const auto move = [&](const fs::path& name) {
    refuse_input_as_output(target_ / name);
    if (fs::is_symlink(fs::symlink_status(target_ / name, error)) || is_stream(target_ / name))
      return copy_bytes(temporary_ / name, target_ / name);
    fs::rename(temporary_ / name, target_ / name, error);
    if (error) cannot_write(target_ / name, error.value());
  };
  if (!last.empty()) {
    fs::remove(target_ / last, error);
    if (error) fail(error);
    folder_written(target_);
  }
  for (std::size_t i = 0; i < files.size(); ++i) {
    // What names other files must not reach the disk before them.
    if (i > 0 && !files[i].has_parent_path() && files[i - 1].has_parent_path())
      for (const fs::path& folder : folders) folder_written(folder);
    move(files[i]);
  }
  for (const fs::path& folder : folders) folder_written(folder);
  if (!last.empty()) {
    move(last);
    folder_written(target_);
  }
  if (then) then();
  made_.clear();
  remove_quietly(std::exchange(temporary_, {}));
}

bool is_stream(const fs::path& target) noexcept {
  std::error_code unknown;
  const fs::file_status status = fs::status(target, unknown);
  return fs::exists(status) && !fs::is_regular_file(status) && !fs::is_directory(status);
}

void make_folder(const fs::path& folder) {
  make_parents(folder, folder / "x");
  std::error_code error;
  if (!fs::is_directory(folder, error)) cannot_write(folder, error ? error.value() : ENOTDIR);
}

void remove_file(const fs::path& file) {
  std::error_code error;
  const bool removed = fs::remove(file, error);
  if (error) cannot_write(file, error.value());
  if (!removed) return;
  if (const int failed = folder_to_disk(file.parent_path()); failed != 0) cannot_write(file, failed);
}

FolderLock::FolderLock(const fs::path& folder) {
  if (is_hidden_name(folder.filename().string())) return;  // nobody else writes there, and its maker holds it
  descriptor_ = open_retrying(folder.empty() ? "." : folder.c_str(), O_RDONLY | O_DIRECTORY);
  if (descriptor_ >= 0) hold(descriptor_, LOCK_EX);
}

FolderLock::~FolderLock() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

void remove_quietly(const fs::path& folder) noexcept {
  std::error_code ignored;
  fs::remove_all(folder, ignored);
}

void remove_leftovers(const fs::path& folder) noexcept { remove_dead(folder, {}); }

}  // namespace treadmark
