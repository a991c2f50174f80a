#include "interpreter/lsp/inbox.hpp"

#include <algorithm>
#include <charconv>
#include <chrono>

namespace garment::lsp {
namespace {

constexpr std::size_t kMaxHeader = 8192;          // bytes of one line
constexpr std::uint64_t kMaxMessage = 32u << 20;  // bytes of one message: a script of 4 MiB, escaped
constexpr std::size_t kMaxWaiting = 256;          // messages
constexpr int kMaxDepth = 256;                    // of JSON
constexpr int kParseError = -32700;

std::string lower(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c; });
  return text;
}

/// Brackets open at once in a text of JSON, strings aside.
int depth_of(std::string_view text) {
  int depth = 0, most = 0;
  bool string = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (string && text[i] == '\\')
      ++i;
    else if (text[i] == '"')
      string = !string;
    else if (!string && (text[i] == '{' || text[i] == '['))
      most = std::max(most, ++depth);
    else if (!string && (text[i] == '}' || text[i] == ']'))
      --depth;
  }
  return most;
}

Message broken(int code, std::string why) { return {nullptr, std::move(why), code}; }

Message parsed(const std::string& body) {
  if (depth_of(body) > kMaxDepth) return broken(kInvalidRequest, "the message is nested too deep");
  try {
    Json json = Json::parse(body);
    if (!json.is_object()) return broken(kInvalidRequest, "a message is an object");
    return {std::move(json), "", 0};
  } catch (const nlohmann::json::exception&) {
    return broken(kParseError, "the message is no JSON");
  }
}

}  // namespace

/// Bytes one by one, read in blocks.
struct Inbox::Stream {
  const ReadBytes& read;
  char block[65536];
  std::size_t at = 0, size = 0;

  bool fill() {
    if (at < size) return true;
    at = 0;
    size = read(block, sizeof block);
    return size > 0;
  }
  /// A line without its end; what is longer than a header may be is cut. False at the end of the stream.
  bool line(std::string& out, bool& cut) {
    out.clear();
    cut = false;
    while (fill()) {
      const char c = block[at++];
      if (c == '\n') {
        if (!out.empty() && out.back() == '\r') out.pop_back();
        return true;
      }
      if (out.size() < kMaxHeader)
        out += c;
      else
        cut = true;
    }
    return false;
  }
  /// `n` bytes; kept if `out` is not null.
  bool body(std::uint64_t n, std::string* out) {
    while (n > 0 && fill()) {
      const std::size_t take = static_cast<std::size_t>(std::min<std::uint64_t>(n, size - at));
      if (out != nullptr) out->append(block + at, take);
      at += take;
      n -= take;
    }
    return n == 0;
  }
};

Inbox::Inbox(ReadBytes read) : read_(std::move(read)), thread_([this] { run(); }) {}
Inbox::~Inbox() { thread_.join(); }

void Inbox::push(Message message) {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [&] { return messages_.size() < kMaxWaiting; });
  if (message.json.is_object() && message.json.value("method", Json()) == "$/cancelRequest") {
    const Json params = message.json.value("params", Json::object());
    if (params.is_object() && params.contains("id") && cancelled_.size() < kMaxWaiting)
      cancelled_.insert(params["id"].dump());
    return;
  }
  messages_.push_back(std::move(message));
  changed_.notify_all();
}

void Inbox::run() {
  Stream stream{read_, {}, 0, 0};
  std::string line;
  bool cut = false, exit = false;
  std::optional<std::uint64_t> length;
  bool any = false, bad = false;
  while (!exit && stream.line(line, cut)) {
    if (!line.empty()) {
      any = true;
      const std::size_t colon = line.find(':');
      if (cut || colon == std::string::npos) {
        bad = true;
        continue;
      }
      if (lower(line.substr(0, colon)) != "content-length") continue;
      const std::size_t digits = line.find_first_not_of(" \t", colon + 1);
      std::uint64_t n = 0;
      const char* const end = line.data() + line.size();
      if (digits != std::string::npos && std::from_chars(line.data() + digits, end, n).ec == std::errc())
        length = n;
      continue;
    }
    if (!length) {
      if (any)
        push(broken(kParseError, bad ? "the header cannot be read" : "the header tells no Content-Length"));
    } else if (*length > kMaxMessage) {
      push(broken(kInvalidRequest, "the message is larger than 32 MiB"));
      if (!stream.body(*length, nullptr)) break;
    } else {
      std::string body;
      if (!stream.body(*length, &body)) {
        push(broken(kParseError, "the stream ends inside a message"));
        break;
      }
      Message message = parsed(body);
      exit = message.json.is_object() && message.json.value("method", Json()) == "exit";
      push(std::move(message));
    }
    length.reset();
    any = bad = false;
  }
  const std::lock_guard lock(mutex_);
  ended_ = true;
  changed_.notify_all();
}

std::optional<Message> Inbox::next() {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [&] { return !messages_.empty() || ended_; });
  if (messages_.empty()) return std::nullopt;
  Message message = std::move(messages_.front());
  messages_.pop_front();
  changed_.notify_all();
  return message;
}

bool Inbox::waiting() {
  const std::lock_guard lock(mutex_);
  return !messages_.empty();
}

bool Inbox::waiting_within(double seconds) {
  std::unique_lock lock(mutex_);
  changed_.wait_for(lock, std::chrono::duration<double>(seconds), [&] { return !messages_.empty() || ended_; });
  return !messages_.empty();
}

bool Inbox::take_cancelled(const Json& id) {
  const std::lock_guard lock(mutex_);
  return cancelled_.erase(id.dump()) > 0;
}

}  // namespace garment::lsp
