// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
// Preloaded into a program (LD_PRELOAD), fails one of its calls. What the environment says:
//
//   TREADMARK_FAULT=CLASS:N:WHAT  the N-th call of the class fails; N+ and all after it. CLASS: kClassNames. WHAT:
//   ENOSPC, EIO, EACCES,
//                                 EDQUOT, EROFS, EMFILE, ENOLCK, EINTR; SHORT (half of a write); KILL (half of the
//                                 data is written before), TERM, INT, STOP (the signal comes, the call succeeds);
//                                 VANISH (the folder is renamed before the call)
//   TREADMARK_FAULT_UNDER         folder, absolute and without links: calls for files elsewhere are left alone
//   TREADMARK_FAULT_COUNTS        file of a Counts
//   TREADMARK_FAULT_LOG           file for the operations that succeeded, for replay
//   TREADMARK_FAULT_BYTES         smallest allocation that counts, default 1
//   TREADMARK_FAULT_CLOCK         times pass by 1 ms a question, so that two runs have the same times
//
// Writes through stdio's own buffers are not seen. Memory is that of operator new, between the beginning and the end of
// main.
#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <pthread.h>
#include <signal.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/file.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <sys/time.h>
#include <sys/uio.h>
#include <time.h>
#include <unistd.h>

#include <atomic>
#include <cstdint>
#include <new>
#include <type_traits>

#include "treadmark/tests/faults/shim/shim_memory.hpp"

namespace {

using namespace treadmark::faults;

enum class Act { none, fail, shorten, kill, signal, vanish };

struct Plan {
  int cls = -1;
  unsigned long first = 0;
  bool on = false;  ///< all calls after it too
  Act act = Act::none;
  int number = 0;  ///< errno or signal
};

Plan plan;
char under[PATH_MAX];
size_t under_length = 0;
Counts own_counts{};
Counts* counts = &own_counts;
int log_file = -1;
size_t least_bytes = 1;
bool own_clock = false;
std::atomic<bool> in_main{false};
std::atomic<std::int64_t> ticks{0};
pthread_mutex_t order = PTHREAD_MUTEX_INITIALIZER;  // an operation and its line of the log belong together

template <class Function>
Function next(const char* name) {
  return reinterpret_cast<Function>(dlsym(RTLD_NEXT, name));
}
#define NEXT(name) static const auto real = next<decltype(&::name)>(#name)

void read_plan(const char* text) {
  char name[32] = {}, what[32] = {};
  char number[32] = {};
  if (sscanf(text, "%31[^:]:%31[^:]:%31s", name, number, what) != 3) abort();
  for (int i = 0; i < kClasses; ++i)
    if (strcmp(name, kClassNames[i]) == 0) plan.cls = i;
  char* end = nullptr;
  plan.first = strtoul(number, &end, 10);
  plan.on = *end == '+';
  const struct {
    const char* name;
    Act act;
    int number;
  } kWhat[] = {{"ENOSPC", Act::fail, ENOSPC}, {"EIO", Act::fail, EIO},        {"EACCES", Act::fail, EACCES},
               {"EDQUOT", Act::fail, EDQUOT}, {"EROFS", Act::fail, EROFS},    {"EMFILE", Act::fail, EMFILE},
               {"ENOLCK", Act::fail, ENOLCK}, {"EINTR", Act::fail, EINTR},    {"ENOMEM", Act::fail, ENOMEM},
               {"SHORT", Act::shorten, 0},    {"KILL", Act::kill, 0},         {"TERM", Act::signal, SIGTERM},
               {"INT", Act::signal, SIGINT},  {"STOP", Act::signal, SIGSTOP}, {"VANISH", Act::vanish, 0}};
  for (const auto& row : kWhat)
    if (strcmp(what, row.name) == 0) plan.act = row.act, plan.number = row.number;
  if (plan.cls < 0 || plan.first == 0 || plan.act == Act::none) abort();
}

__attribute__((constructor)) void begin() {
  const char* value = getenv("TREADMARK_FAULT_UNDER");
  if (value != nullptr) {
    strncpy(under, value, sizeof under - 1);
    under_length = strlen(under);
  }
  if ((value = getenv("TREADMARK_FAULT")) != nullptr) read_plan(value);
  if ((value = getenv("TREADMARK_FAULT_BYTES")) != nullptr) least_bytes = strtoul(value, nullptr, 10);
  own_clock = getenv("TREADMARK_FAULT_CLOCK") != nullptr;
  if ((value = getenv("TREADMARK_FAULT_COUNTS")) != nullptr) {
    const int file = open(value, O_RDWR);
    void* shared = mmap(nullptr, sizeof(Counts), PROT_READ | PROT_WRITE, MAP_SHARED, file, 0);
    if (shared == MAP_FAILED) abort();
    counts = static_cast<Counts*>(shared);
    close(file);
  }
  if ((value = getenv("TREADMARK_FAULT_LOG")) != nullptr) {
    const int file = open(value, O_WRONLY | O_APPEND);
    log_file = fcntl(file, F_DUPFD_CLOEXEC, 400);
    close(file);
    if (log_file < 0) abort();
  }
}

bool is_under(const char* path) {
  return under_length > 0 && strncmp(path, under, under_length) == 0 &&
         (path[under_length] == '/' || path[under_length] == '\0');
}

/// The absolute name of a path; empty where it is not under the folder.
struct Name {
  char text[PATH_MAX] = "";

  Name() = default;
  explicit Name(const char* path, int folder = AT_FDCWD) {
    if (under_length == 0 || path == nullptr) return;
    if (path[0] != '/') {
      if (folder == AT_FDCWD) {
        if (getcwd(text, sizeof text) == nullptr) text[0] = '\0';
      } else {
        of(folder);
      }
      strncat(text, "/", sizeof text - strlen(text) - 1);
    }
    strncat(text, path, sizeof text - strlen(text) - 1);
    if (!is_under(text)) text[0] = '\0';
  }
  explicit Name(int file) {
    if (under_length == 0) return;
    of(file);
    if (!is_under(text)) text[0] = '\0';
  }
  void of(int file) {
    char link[64];
    snprintf(link, sizeof link, "/proc/self/fd/%d", file);
    const ssize_t n = readlink(link, text, sizeof text - 1);
    text[n < 0 ? 0 : n] = '\0';
  }
  explicit operator bool() const { return text[0] != '\0'; }
};

/// Counts a call; whether it is one that the plan is about.
bool meets_plan(Class cls) {
  const auto i = static_cast<int>(cls);
  const auto count = counts->calls[i].fetch_add(1) + 1;
  if (i != plan.cls || plan.act == Act::none) return false;
  if (plan.on ? count < plan.first : count != plan.first) return false;
  counts->fired.fetch_add(1);
  return true;
}

[[noreturn]] void die() {
  kill(getpid(), SIGKILL);
  for (;;) pause();
}

/// What is to happen to a call for this file.
Act act_on(Class cls, const Name& name, const Name& other = {}) {
  if (!name && !other) return Act::none;
  const bool own = meets_plan(cls), any = meets_plan(Class::any);
  if (!own && !any) return Act::none;
  if (plan.act == Act::signal) {
    kill(getpid(), plan.number);
    return Act::none;
  }
  if (plan.act == Act::vanish) {
    char away[PATH_MAX + 8];
    snprintf(away, sizeof away, "%s.gone", under);
    next<decltype(&::rename)>("rename")(under, away);
    return Act::none;
  }
  if (plan.act == Act::kill && cls != Class::write) die();
  errno = plan.number;
  return plan.act;
}

bool is_failure(Act act) { return act == Act::fail; }

/// Keeps an operation and its place in the log together.
class Ordered {
 public:
  Ordered() {
    if (log_file >= 0) pthread_mutex_lock(&order);
  }
  ~Ordered() {
    const int kept = errno;
    if (log_file >= 0) pthread_mutex_unlock(&order);
    errno = kept;
  }
};

void note(char operation, const char* first, std::uint64_t offset = 0, const char* second = "",
          const void* data = nullptr, size_t size = 0) {
  if (log_file < 0) return;
  const int kept = errno;
  LogHead head{operation, offset, static_cast<std::uint32_t>(strlen(first)), static_cast<std::uint32_t>(strlen(second)),
               size};
  const iovec parts[] = {{&head, sizeof head},
                         {const_cast<char*>(first), head.first},
                         {const_cast<char*>(second), head.second},
                         {const_cast<void*>(data), size}};
  if (next<decltype(&::writev)>("writev")(log_file, parts, 4) < 0) abort();
  errno = kept;
}

/// Opening for writing; `call` opens.
template <class Call>
auto opened(const char* path, int folder, int flags, Call call) -> decltype(call()) {
  const bool writes = (flags & (O_WRONLY | O_RDWR | O_CREAT | O_TRUNC)) != 0;
  const Name name = writes ? Name(path, folder) : Name();
  if (!name) return call();
  if (is_failure(act_on(Class::open, name))) {
    if constexpr (std::is_pointer_v<decltype(call())>)
      return nullptr;
    else
      return -1;
  }
  Ordered ordered;
  struct stat before {};
  const bool there = log_file >= 0 && stat(name.text, &before) == 0;
  auto result = call();
  bool good;
  if constexpr (std::is_pointer_v<decltype(result)>)
    good = result != nullptr;
  else
    good = result >= 0;
  if (good && !there && (flags & O_CREAT) != 0) note('c', name.text);
  if (good && there && (flags & O_TRUNC) != 0) note('t', name.text);
  return result;
}

int open_flags(const char* mode) {
  const bool both = strchr(mode, '+') != nullptr;
  if (mode[0] == 'w') return O_WRONLY | O_CREAT | O_TRUNC;
  if (mode[0] == 'a') return O_WRONLY | O_CREAT;
  return both ? O_RDWR : O_RDONLY;
}

/// Writing: `call(bytes)` writes at most so many of the `size` there are.
template <class Call>
ssize_t written(int file, const void* data, size_t size, std::int64_t at, Call call) {
  const Name name(file);
  if (!name) return call(size);
  const Act act = act_on(Class::write, name);
  if (is_failure(act)) return -1;
  if (act == Act::shorten && size > 1) size = size / 2;
  Ordered ordered;
  std::int64_t offset = at;
  if (log_file >= 0 && at < 0) {
    struct stat now {};
    offset = (fcntl(file, F_GETFL) & O_APPEND) != 0 && fstat(file, &now) == 0 ? now.st_size : lseek(file, 0, SEEK_CUR);
  }
  if (act == Act::kill) {
    if (size > 1) call(size / 2);
    die();
  }
  const ssize_t n = call(size);
  if (n > 0) note('w', name.text, static_cast<std::uint64_t>(offset), "", data, static_cast<size_t>(n));
  return n;
}

/// All else: `call` acts and says 0 where it succeeded.
template <class Call>
int acted(Class cls, const Name& name, char operation, Call call, const Name& other = {}, std::uint64_t offset = 0) {
  if (!name && !other) return call();
  if (is_failure(act_on(cls, name, other))) return -1;
  Ordered ordered;
  const int result = call();
  if (result == 0 && operation != '\0') note(operation, name.text, offset, other.text);
  return result;
}

bool memory_fails(size_t size) {
  if (!in_main.load(std::memory_order_relaxed) || size < least_bytes || !meets_plan(Class::memory)) return false;
  return true;
}

}  // namespace

// NOLINTBEGIN
extern "C" {

#define OPEN(name)                                                                 \
  int name(const char* path, int flags, ...) {                                     \
    NEXT(name);                                                                    \
    va_list rest;                                                                  \
    va_start(rest, flags);                                                         \
    const mode_t mode = (flags & O_CREAT) != 0 ? va_arg(rest, mode_t) : 0;         \
    va_end(rest);                                                                  \
    return opened(path, AT_FDCWD, flags, [&] { return real(path, flags, mode); }); \
  }
OPEN(open)
OPEN(open64)

#define OPENAT(name)                                                                     \
  int name(int folder, const char* path, int flags, ...) {                               \
    NEXT(name);                                                                          \
    va_list rest;                                                                        \
    va_start(rest, flags);                                                               \
    const mode_t mode = (flags & O_CREAT) != 0 ? va_arg(rest, mode_t) : 0;               \
    va_end(rest);                                                                        \
    return opened(path, folder, flags, [&] { return real(folder, path, flags, mode); }); \
  }
OPENAT(openat)
OPENAT(openat64)

int creat(const char* path, mode_t mode) { return open(path, O_WRONLY | O_CREAT | O_TRUNC, mode); }

FILE* fopen(const char* path, const char* mode) {
  NEXT(fopen);
  return opened(path, AT_FDCWD, open_flags(mode), [&] { return real(path, mode); });
}
FILE* fopen64(const char* path, const char* mode) {
  NEXT(fopen64);
  return opened(path, AT_FDCWD, open_flags(mode), [&] { return real(path, mode); });
}

ssize_t write(int file, const void* data, size_t size) {
  NEXT(write);
  return written(file, data, size, -1, [&](size_t n) { return real(file, data, n); });
}
ssize_t pwrite(int file, const void* data, size_t size, off_t at) {
  NEXT(pwrite);
  return written(file, data, size, at, [&](size_t n) { return real(file, data, n, at); });
}
ssize_t pwrite64(int file, const void* data, size_t size, off64_t at) {
  NEXT(pwrite64);
  return written(file, data, size, at, [&](size_t n) { return real(file, data, n, at); });
}
ssize_t writev(int file, const iovec* parts, int count) {
  NEXT(writev);
  const Name name(file);
  if (!name) return real(file, parts, count);
  size_t size = 0;
  for (int i = 0; i < count; ++i) size += parts[i].iov_len;
  char* data = static_cast<char*>(malloc(size + 1));
  size_t at = 0;
  for (int i = 0; i < count; at += parts[i++].iov_len) memcpy(data + at, parts[i].iov_base, parts[i].iov_len);
  const ssize_t n = write(file, data, size);
  const int kept = errno;
  free(data);
  errno = kept;
  return n;
}

int fsync(int file) {
  NEXT(fsync);
  return acted(Class::fsync, Name(file), 's', [&] { return real(file); });
}
int fdatasync(int file) {
  NEXT(fdatasync);
  return acted(Class::fsync, Name(file), 's', [&] { return real(file); });
}

int rename(const char* from, const char* to) {
  NEXT(rename);
  return acted(
      Class::rename, Name(from), 'r', [&] { return real(from, to); }, Name(to));
}
int renameat(int from_folder, const char* from, int to_folder, const char* to) {
  NEXT(renameat);
  return acted(
      Class::rename, Name(from, from_folder), 'r', [&] { return real(from_folder, from, to_folder, to); },
      Name(to, to_folder));
}
int renameat2(int from_folder, const char* from, int to_folder, const char* to, unsigned flags) {
  NEXT(renameat2);
  return acted(
      Class::rename, Name(from, from_folder), 'r', [&] { return real(from_folder, from, to_folder, to, flags); },
      Name(to, to_folder));
}

int mkdir(const char* path, mode_t mode) {
  NEXT(mkdir);
  return acted(Class::mkdir, Name(path), 'd', [&] { return real(path, mode); });
}
int mkdirat(int folder, const char* path, mode_t mode) {
  NEXT(mkdirat);
  return acted(Class::mkdir, Name(path, folder), 'd', [&] { return real(folder, path, mode); });
}

int unlink(const char* path) {
  NEXT(unlink);
  return acted(Class::unlink, Name(path), 'u', [&] { return real(path); });
}
int rmdir(const char* path) {
  NEXT(rmdir);
  return acted(Class::unlink, Name(path), 'u', [&] { return real(path); });
}
int remove(const char* path) {
  NEXT(remove);
  return acted(Class::unlink, Name(path), 'u', [&] { return real(path); });
}
int unlinkat(int folder, const char* path, int flags) {
  NEXT(unlinkat);
  return acted(Class::unlink, Name(path, folder), 'u', [&] { return real(folder, path, flags); });
}

// A failing close has closed all the same.
int close(int file) {
  NEXT(close);
  const Name name(file);
  if (!name || (fcntl(file, F_GETFL) & O_ACCMODE) == O_RDONLY) return real(file);
  const Act act = act_on(Class::close, name);
  const int result = real(file);
  if (!is_failure(act)) return result;
  errno = plan.number;
  return -1;
}
int fclose(FILE* stream) {
  NEXT(fclose);
  const int file = fileno(stream);
  const Name name = file < 0 ? Name() : Name(file);
  if (!name || (fcntl(file, F_GETFL) & O_ACCMODE) == O_RDONLY) return real(stream);
  const Act act = act_on(Class::close, name);
  const int result = real(stream);
  if (!is_failure(act)) return result;
  errno = plan.number;
  return EOF;
}

int ftruncate(int file, off_t length) {
  NEXT(ftruncate);
  return acted(
      Class::truncate, Name(file), 't', [&] { return real(file, length); }, {}, static_cast<std::uint64_t>(length));
}
int ftruncate64(int file, off64_t length) {
  NEXT(ftruncate64);
  return acted(
      Class::truncate, Name(file), 't', [&] { return real(file, length); }, {}, static_cast<std::uint64_t>(length));
}
int truncate(const char* path, off_t length) {
  NEXT(truncate);
  return acted(
      Class::truncate, Name(path), 't', [&] { return real(path, length); }, {}, static_cast<std::uint64_t>(length));
}
int posix_fallocate(int file, off_t at, off_t length) {
  NEXT(posix_fallocate);
  return is_failure(act_on(Class::truncate, Name(file))) ? errno : real(file, at, length);
}
int fallocate(int file, int mode, off_t at, off_t length) {
  NEXT(fallocate);
  return acted(Class::truncate, Name(file), '\0', [&] { return real(file, mode, at, length); });
}

int flock(int file, int operation) {
  NEXT(flock);
  return acted(Class::lock, Name(file), '\0', [&] { return real(file, operation); });
}

// The steady clock begins at zero: a deadline of its making has passed for the system, so that nobody waits for ever.
int clock_gettime(clockid_t clock, timespec* out) noexcept {
  NEXT(clock_gettime);
  if (!own_clock) return real(clock, out);
  const std::int64_t ms = ticks.fetch_add(1);
  out->tv_sec = (clock == CLOCK_REALTIME ? 1700000000 : 1) + ms / 1000;
  out->tv_nsec = ms % 1000 * 1000000;
  return 0;
}
int gettimeofday(timeval* out, void* zone) noexcept {
  static const auto real = next<int (*)(timeval*, void*)>("gettimeofday");
  if (!own_clock) return real(out, zone);
  timespec now{};
  clock_gettime(CLOCK_REALTIME, &now);
  *out = {now.tv_sec, now.tv_nsec / 1000};
  return 0;
}
time_t time(time_t* out) noexcept {
  NEXT(time);
  if (!own_clock) return real(out);
  timespec now{};
  clock_gettime(CLOCK_REALTIME, &now);
  if (out != nullptr) *out = now.tv_sec;
  return now.tv_sec;
}

using Main = int (*)(int, char**, char**);
static Main program_main = nullptr;
static int counted_main(int argc, char** argv, char** environment) {
  in_main = true;
  const int status = program_main(argc, argv, environment);
  in_main = false;
  return status;
}
int __libc_start_main(Main main, int argc, char** argv, void (*init)(), void (*fini)(), void (*linker)(), void* stack) {
  program_main = main;
  using Start = int (*)(Main, int, char**, void (*)(), void (*)(), void (*)(), void*);
  return next<Start>("__libc_start_main")(counted_main, argc, argv, init, fini, linker, stack);
}

}  // extern "C"

// The others of the standard library call these two.
void* operator new(std::size_t size) {
  if (!memory_fails(size))
    if (void* place = malloc(size > 0 ? size : 1)) return place;
  throw std::bad_alloc();
}
void* operator new(std::size_t size, std::align_val_t alignment) {
  if (!memory_fails(size))
    if (void* place = aligned_alloc(static_cast<std::size_t>(alignment), size)) return place;
  throw std::bad_alloc();
}
void operator delete(void* place) noexcept { free(place); }
void operator delete(void* place, std::size_t) noexcept { free(place); }
void operator delete(void* place, std::align_val_t) noexcept { free(place); }
void operator delete(void* place, std::size_t, std::align_val_t) noexcept { free(place); }
// NOLINTEND
