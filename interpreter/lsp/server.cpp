#include "interpreter/lsp/server.hpp"

#include <exception>

namespace garment::lsp {
namespace {

constexpr double kPause = 0.3;  // s in the typing, after which the model is built: that takes a large garment half a second

constexpr int kNoSuchMethod = -32601, kInvalidParams = -32602, kInternal = -32603;
constexpr int kNotInitialized = -32002, kCancelled = -32800;

using Answer = Json (*)(const Question&);

Answer find_answer(const std::string& method) {
  static const std::map<std::string, Answer, std::less<>> answers = {
      {"textDocument/hover", answer_hover},
      {"textDocument/completion", answer_completion},
      {"textDocument/signatureHelp", answer_signature},
      {"textDocument/definition", answer_definition},
      {"textDocument/implementation", answer_partners},
      {"textDocument/references", answer_references},
      {"textDocument/documentHighlight", answer_highlight},
      {"textDocument/documentSymbol", answer_symbols},
      {"textDocument/foldingRange", answer_folding},
      {"textDocument/formatting", answer_formatting},
      {"textDocument/codeAction", answer_actions},
      {"textDocument/prepareRename", answer_prepare_rename},
      {"textDocument/rename", answer_rename},
      {"textDocument/semanticTokens/full", answer_tokens},
      {"garment/seamPartners", answer_partners},
  };
  const auto found = answers.find(method);
  return found == answers.end() ? nullptr : found->second;
}

Json capabilities() {
  return Json{
      {"textDocumentSync", {{"openClose", true}, {"change", 2}, {"save", true}}},
      {"hoverProvider", true},
      {"completionProvider", {{"triggerCharacters", {".", ":", "("}}, {"resolveProvider", false}}},
      {"signatureHelpProvider", {{"triggerCharacters", {"(", ","}}}},
      {"definitionProvider", true},
      {"implementationProvider", true},
      {"referencesProvider", true},
      {"documentHighlightProvider", true},
      {"documentSymbolProvider", true},
      {"foldingRangeProvider", true},
      {"documentFormattingProvider", true},
      {"codeActionProvider", {{"codeActionKinds", {"quickfix"}}}},
      {"renameProvider", {{"prepareProvider", true}}},
      {"semanticTokensProvider", {{"legend", token_legend()}, {"full", true}}},
  };
}

bool is_id(const Json& id) { return id.is_string() || id.is_number(); }

}  // namespace

Server::Server(ReadBytes read, WriteBytes write, Host& host, std::string stdlib_dir)
    : inbox_(std::move(read)), write_(std::move(write)), documents_(host, std::move(stdlib_dir)) {}

void Server::send(const Json& message) {
  const std::string body = message.dump(-1, ' ', false, Json::error_handler_t::replace);
  write_("Content-Length: " + std::to_string(body.size()) + "\r\n\r\n" + body);
}

void Server::reply(const Json& id, Json result) {
  send(Json{{"jsonrpc", "2.0"}, {"id", id}, {"result", std::move(result)}});
}

void Server::fail(const Json& id, int code, const std::string& message) {
  send(Json{{"jsonrpc", "2.0"}, {"id", id}, {"error", {{"code", code}, {"message", message}}}});
}

bool Server::run() {
  while (!exit_) {
    if (!inbox_.waiting()) work();
    const std::optional<Message> message = inbox_.next();
    if (!message) return false;
    take(*message);
  }
  return state_ == State::shut;
}

void Server::take(const Message& message) {
  if (!message.broken.empty()) return fail(nullptr, message.code, message.broken);
  const Json& json = message.json;
  const Json id = json.value("id", Json());
  if (!json.contains("method")) {
    // An answer to a question: none is ever asked.
    if (!json.contains("result") && !json.contains("error"))
      fail(is_id(id) ? id : Json(), kInvalidRequest, "the message has no method");
    return;
  }
  if (!json["method"].is_string())
    return fail(is_id(id) ? id : Json(), kInvalidRequest, "the method is no text");
  const std::string method = json["method"].get<std::string>();
  const Json params = json.value("params", Json::object());
  if (!json.contains("id")) return take_notification(method, params);
  if (!is_id(id)) return fail(nullptr, kInvalidRequest, "an id is a number or a text");
  take_request(id, method, params);
}

void Server::take_request(const Json& id, const std::string& method, const Json& params) {
  if (inbox_.take_cancelled(id)) return fail(id, kCancelled, "cancelled");
  if (state_ == State::fresh && method != "initialize")
    return fail(id, kNotInitialized, "`initialize` comes first");
  if (state_ == State::shut) return fail(id, kInvalidRequest, "the server was asked to shut down");
  try {
    reply(id, answer(method, params));
  } catch (const Refused& refused) {
    fail(id, refused.code, refused.message);
  } catch (const Json::exception&) {
    fail(id, kInvalidParams, "`" + method + "` was asked with other parameters than the protocol says");
  } catch (const std::exception& e) {
    fail(id, kInternal, e.what());
  }
}

Json Server::answer(const std::string& method, const Json& params) {
  if (method == "initialize") return initialize(params);
  if (method == "shutdown") {
    state_ = State::shut;
    return nullptr;
  }
  const Answer found = find_answer(method);
  if (found == nullptr) throw Refused{kNoSuchMethod, "there is no `" + method + "`"};
  const std::string uri = params.at("textDocument").at("uri").get<std::string>();
  Document* document = documents_.find(uri);
  if (document == nullptr) throw Refused{kInvalidParams, "`" + uri + "` is not open"};
  documents_.analyse(*document);
  return found(Question{documents_, *document, params, encoding_});
}

Json Server::initialize(const Json& params) {
  if (state_ == State::running) throw Refused{kInvalidRequest, "`initialize` came before"};
  state_ = State::running;
  std::string encoding = "utf-16";
  const Json general = params.value("capabilities", Json::object()).value("general", Json::object());
  // UTF-16 unless the client would rather have another.
  if (const Json offered = general.value("positionEncodings", Json::array());
      offered.is_array() && !offered.empty())
    if (offered[0] == "utf-8" || offered[0] == "utf-32") encoding = offered[0].get<std::string>();
  if (encoding == "utf-8") encoding_ = Encoding::utf8;
  if (encoding == "utf-32") encoding_ = Encoding::utf32;
  Json able = capabilities();
  able["positionEncoding"] = encoding;
  return Json{{"capabilities", able}, {"serverInfo", {{"name", "garment"}, {"version", GARMENT_VERSION}}}};
}

void Server::take_notification(const std::string& method, const Json& params) {
  if (method == "exit") {
    exit_ = true;
    return;
  }
  if (state_ != State::running) return;
  try {
    if (method == "textDocument/didOpen") {
      const Json& document = params.at("textDocument");
      documents_.open(document.at("uri").get<std::string>(), document.at("text").get<std::string>(),
                      document.value("version", std::int64_t{0}));
    } else if (method == "textDocument/didChange") {
      const Json& document = params.at("textDocument");
      documents_.change(document.at("uri").get<std::string>(), params.at("contentChanges"),
                        document.value("version", std::int64_t{0}), encoding_);
    } else if (method == "textDocument/didClose") {
      const std::string uri = params.at("textDocument").at("uri").get<std::string>();
      documents_.close(uri);
      unpublish(uri);
    } else if (method == "textDocument/didSave") {
      // What the script reads may have changed with it.
      if (Document* document = documents_.find(params.at("textDocument").at("uri").get<std::string>()))
        document->changed = true;
    }
  } catch (const Json::exception&) {
    send(Json{
        {"jsonrpc", "2.0"},
        {"method", "window/logMessage"},
        {"params",
         {{"type", 2}, {"message", "`" + method + "` came with other parameters than the protocol says"}}}});
  } catch (const std::exception& e) {
    send(Json{{"jsonrpc", "2.0"},
              {"method", "window/logMessage"},
              {"params", {{"type", 1}, {"message", e.what()}}}});
  }
}

void Server::work() {
  while (!inbox_.waiting()) {
    if (Document* document = documents_.next_changed()) {
      documents_.analyse(*document);
      publish(*document);
    } else if (Document* unchecked = documents_.next_unchecked()) {
      if (inbox_.waiting_within(kPause)) return;
      documents_.check_model(*unchecked);
      if (!unchecked->now->model.empty()) publish(*unchecked);
    } else {
      return;
    }
  }
}

void Server::publish(const Document& document) {
  std::map<std::string, Json> found = diagnostics_of(document, encoding_);
  for (auto& [file, by_script] : shown_)
    if (by_script.contains(document.uri) && !found.contains(file)) found[file] = Json::array();
  for (auto& [file, list] : found) {
    if (list.empty() && file != document.uri)
      shown_[file].erase(document.uri);
    else
      shown_[file][document.uri] = std::move(list);
    send_diagnostics(file);
  }
}

void Server::unpublish(const std::string& uri) {
  std::vector<std::string> files{uri};
  for (auto& [file, by_script] : shown_)
    if (by_script.erase(uri) > 0 && file != uri) files.push_back(file);
  for (const std::string& file : files) send_diagnostics(file);
}

void Server::send_diagnostics(const std::string& uri) {
  Json all = Json::array();
  for (const auto& [script, list] : shown_[uri])
    for (const Json& one : list) all.push_back(one);
  Json params{{"uri", uri}};
  if (const Document* document = documents_.find(uri)) params["version"] = document->version;
  params["diagnostics"] = std::move(all);
  if (shown_[uri].empty()) shown_.erase(uri);
  send(Json{{"jsonrpc", "2.0"}, {"method", "textDocument/publishDiagnostics"}, {"params", params}});
}

}  // namespace garment::lsp
