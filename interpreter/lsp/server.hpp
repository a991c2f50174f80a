#pragma once
// The language server: messages in, messages out, by the Language Server Protocol 3.17. One text at a time is
// interpreted, and only once no further message waits, so that fast typing costs one interpretation.
#include <functional>
#include <map>
#include <string>

#include "interpreter/lsp/answers.hpp"
#include "interpreter/lsp/inbox.hpp"

namespace garment::lsp {

using WriteBytes = std::function<void(std::string_view)>;

class Server {
 public:
  Server(ReadBytes read, WriteBytes write, Host& host, std::string stdlib_dir);

  /// Serves until `exit` or the end of the stream. True if the client asked to shut down before.
  bool run();

 private:
  enum class State { fresh, running, shut };

  void take(const Message& message);
  void take_request(const Json& id, const std::string& method, const Json& params);
  void take_notification(const std::string& method, const Json& params);
  Json answer(const std::string& method, const Json& params);
  Json initialize(const Json& params);
  void work();  ///< what is left to do while no message waits
  void publish(const Document& document);
  void unpublish(const std::string& uri);
  void send_diagnostics(const std::string& uri);

  void send(const Json& message);
  void reply(const Json& id, Json result);
  void fail(const Json& id, int code, const std::string& message);

  Inbox inbox_;
  WriteBytes write_;
  Documents documents_;
  Encoding encoding_ = Encoding::utf16;
  State state_ = State::fresh;
  bool exit_ = false;
  /// Diagnostics by the file that shows them, then by the script that found them.
  std::map<std::string, std::map<std::string, Json>> shown_;
};

}  // namespace garment::lsp
