// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <sys/socket.h>

#include <algorithm>
#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <type_traits>

namespace treadmark {

/// The other end is gone, or says what makes no sense.
struct Broken {};

/// What Treadmark and a program that it has started (core/helper_process.hpp) say to each other. Both are of one build
/// on one machine, so numbers go as they are.
class Channel {
 public:
  virtual ~Channel() = default;

  /// From now on no more is taken than this [bytes]: what asks for more is Broken.
  void allow(std::uint64_t bytes) { left_ = bytes; }

  template <class T>
  void put(const T& value) {
    static_assert(std::is_trivially_copyable_v<T>);
    put_bytes(&value, sizeof(T));
  }
  template <class T>
  void put_list(const T& list) {
    put(static_cast<std::int64_t>(list.size()));
    put_bytes(list.data(), list.size() * sizeof(list[0]));
  }
  template <class T>
  T take() {
    static_assert(std::is_trivially_copyable_v<T>);
    spend(sizeof(T));
    T value;
    take_bytes(&value, sizeof(T));
    return value;
  }
  template <class List>
  List take_list() {
    using Element = typename List::value_type;
    constexpr std::int64_t kAtOnce = 65'536;
    const auto size = take<std::int64_t>();
    if (size < 0 || static_cast<std::uint64_t>(size) > left_ / sizeof(Element)) throw Broken{};
    spend(static_cast<std::uint64_t>(size) * sizeof(Element));
    List list;
    // no more memory than there is something to fill it
    for (std::int64_t have = 0; have < size;) {
      const std::int64_t more = std::min(kAtOnce, size - have);
      list.resize(static_cast<std::size_t>(have + more));
      take_bytes(list.data() + have, static_cast<std::size_t>(more) * sizeof(Element));
      have += more;
    }
    return list;
  }

 protected:
  virtual void put_bytes(const void* data, std::size_t size) = 0;
  /// Also Broken where the other end says nothing for too long.
  virtual void take_bytes(void* data, std::size_t size) = 0;

 private:
  void spend(std::uint64_t bytes) {
    if (bytes > left_) throw Broken{};
    left_ -= bytes;
  }

  std::uint64_t left_ = std::uint64_t{64} << 30;
};

/// Where start_helper puts the program's end of the socket.
inline constexpr int kHelperSocket = 3;
/// The exit status of a program of another version.
inline constexpr int kOtherVersion = 2;

/// One end of a socket.
class SocketChannel : public Channel {
 public:
  explicit SocketChannel(int socket) : socket_(socket) {}

 protected:
  void put_bytes(const void* data, std::size_t size) override {
    const char* bytes = static_cast<const char*>(data);
    while (size > 0) {
      const ssize_t n = ::send(socket_, bytes, size, MSG_NOSIGNAL);
      if (n < 0 && errno == EINTR) continue;
      if (n <= 0) throw Broken{};
      bytes += n, size -= static_cast<std::size_t>(n);
    }
  }
  void take_bytes(void* data, std::size_t size) override {
    char* bytes = static_cast<char*>(data);
    while (size > 0) {
      const ssize_t n = ::recv(socket_, bytes, size, 0);
      if (n < 0 && errno == EINTR) continue;
      if (n <= 0) throw Broken{};
      bytes += n, size -= static_cast<std::size_t>(n);
    }
  }

  int socket_;
};

}  // namespace treadmark
