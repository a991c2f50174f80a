#pragma once
// The open texts, what was found out about them, and the files that they use.
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "interpreter/language/interpret.hpp"
#include "interpreter/lsp/positions.hpp"
#include "interpreter/service/names.hpp"

namespace garment::lsp {

/// "file:///a%20b.garment" as a path; the text itself where it is no file.
std::string path_of(const std::string& uri);
std::string uri_of(const std::string& path);

/// One interpretation of one text.
struct Analysis {
  grammar::Sources sources;
  grammar::SourceId source = 0;
  interpreter::Interpretation result;
  service::Names names;
  grammar::Diagnostics model;  ///< laws that only the model shows; filled by `check_model`
};

struct Document {
  std::string uri, text;
  std::int64_t version = 0;
  bool changed = true;                  ///< since the last analysis
  bool model_unchecked = false;         ///< the model of the last analysis was not built yet
  std::shared_ptr<Analysis> now, good;  ///< the last analysis, and the last without an error
};

class Documents {
 public:
  Documents(Host& host, std::string stdlib_dir);

  void open(const std::string& uri, std::string text, std::int64_t version);
  /// Makes the changes of a didChange in their order. False where the text is not open or grows too long.
  bool change(const std::string& uri, const Json& changes, std::int64_t version, Encoding encoding);
  void close(const std::string& uri);
  Document* find(const std::string& uri);

  /// Interprets the text if it changed.
  void analyse(Document& document);
  /// Builds the model of an analysed text, for the laws that only the model shows.
  void check_model(Document& document);
  /// A text that changed; null if there is none. With `model`: one whose model was not checked.
  Document* next_changed();
  Document* next_unchecked();

  interpreter::InterpretOptions options_of(const std::string& uri) const;
  Host& host() { return overlay_; }
  const std::map<std::string, Document>& all() const { return documents_; }

 private:
  /// Files as the editor has them, else as the disk has them.
  class Overlay : public Host {
   public:
    Overlay(Documents& documents, Host& below) : documents_(documents), below_(below) {}
    HostResult<std::string> read_file(const std::string& path, std::uint64_t max_bytes) override;
    HostResult<bool> write_file(const std::string&, std::string_view) override {
      return {std::nullopt, {"an editor writes"}};
    }
    double seconds() override { return below_.seconds(); }
    bool interrupted() override { return below_.interrupted(); }
    std::uint64_t peak_memory() override { return below_.peak_memory(); }

   private:
    Documents& documents_;
    Host& below_;
  };

  void forget_users_of(const std::string& uri);
  body::BodyResult cached_body(const design::Body& declared, const std::string& folder);

  std::map<std::string, Document> documents_;
  Overlay overlay_;
  std::string stdlib_dir_;
  std::map<std::string, body::BodyResult> bodies_;  ///< by what is declared
};

}  // namespace garment::lsp
