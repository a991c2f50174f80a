#pragma once
// Messages as they come in: a thread takes them off the byte stream, so that the server knows what waits
// while it works.
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <functional>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <thread>

#include "interpreter/lsp/positions.hpp"

namespace garment::lsp {

constexpr int kInvalidRequest = -32600;  // JSON-RPC

/// Gives up to `size` bytes into `at`; 0 at the end of the stream.
using ReadBytes = std::function<std::size_t(char* at, std::size_t size)>;

/// A message, or what was wrong with the bytes that should have been one.
struct Message {
  Json json;
  std::string broken;  ///< for people; empty for a message
  int code = 0;        ///< of the JSON-RPC error
};

class Inbox {
 public:
  explicit Inbox(ReadBytes read);
  ~Inbox();
  Inbox(const Inbox&) = delete;
  Inbox& operator=(const Inbox&) = delete;

  /// Waits for the next message; nothing once the stream has ended and all was taken.
  std::optional<Message> next();
  /// True if a message waits.
  bool waiting();
  /// The same, but gives a message so long to come while the stream is open.
  bool waiting_within(double seconds);
  /// True once the request was cancelled by a message that waits; forgets it.
  bool take_cancelled(const Json& id);

 private:
  struct Stream;
  void run();
  void push(Message message);

  ReadBytes read_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<Message> messages_;
  std::set<std::string> cancelled_;
  bool ended_ = false;
  std::thread thread_;
};

}  // namespace garment::lsp
