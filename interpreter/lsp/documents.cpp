#include "interpreter/lsp/documents.hpp"

#include <algorithm>
#include <cmath>

#include "interpreter/language/modelling.hpp"
#include "interpreter/language/program.hpp"
#include "runtime/base/number.hpp"
#include "runtime/modeller/unmodelled.hpp"

namespace garment::lsp {
namespace {

constexpr std::size_t kMaxText =
    16u << 20;  // what is longer than 4 MiB is not read, but an editor may hold it
constexpr std::size_t kMaxDocuments = 256;
constexpr std::size_t kMaxBodies = 16;
constexpr double kMaxParticles = 50'000;  // of a garment whose model is built while it is being written

int hex(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  return c >= 'A' && c <= 'F' ? c - 'A' + 10 : -1;
}

/// About how many particles a garment has.
double particles_of(const design::Garment& garment) {
  double n = 0;
  for (const design::Panel& panel : garment.panels) {
    double area = 0;
    for (const design::Edge& edge : panel.edges) area += edge.curve.area_term();
    n += std::abs(area) / (panel.resolution * panel.resolution);
  }
  return n;
}

std::string folder_of(const std::string& path) {
  const std::size_t slash = path.rfind('/');
  return slash == std::string::npos ? "." : path.substr(0, std::max<std::size_t>(slash, 1));
}

/// A body as declared, as text; nothing for those that come from a file, which may change.
std::optional<std::string> key_of(const design::Body& body) {
  std::string key = body.name + '|' + format_number(body.friction);
  for (int k = 0; k < 3; ++k) key += '|' + format_number(body.position[k]);
  const auto* person = std::get_if<design::Mannequin>(&body.shape);
  if (person == nullptr) return std::nullopt;  // plain shapes are quick to build
  key += person->sex == design::Mannequin::Sex::woman ? "|woman|" : "|man|";
  key += format_number(person->size);
  for (const auto& [name, value] : person->measures) key += '|' + name + '=' + format_number(value);
  return key;
}

}  // namespace

std::string path_of(const std::string& uri) {
  if (uri.rfind("file://", 0) != 0) return uri;
  std::string path;
  std::size_t i = uri.find('/', 7);  // after the host, which is empty or this machine
  for (; i < uri.size(); ++i) {
    if (uri[i] == '%' && i + 2 < uri.size() && hex(uri[i + 1]) >= 0 && hex(uri[i + 2]) >= 0) {
      path += static_cast<char>(hex(uri[i + 1]) * 16 + hex(uri[i + 2]));
      i += 2;
    } else {
      path += uri[i];
    }
  }
  return path;
}

std::string uri_of(const std::string& path) {
  if (path.empty() || path[0] != '/') return path;
  static const char* const digits = "0123456789ABCDEF";
  std::string uri = "file://";
  for (const char c : path) {
    const bool plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
                       std::string_view("/-._~").find(c) != std::string_view::npos;
    const unsigned char byte = static_cast<unsigned char>(c);
    if (plain)
      uri += c;
    else
      (uri += '%') += {digits[byte >> 4], digits[byte & 15]};
  }
  return uri;
}

HostResult<std::string> Documents::Overlay::read_file(const std::string& path, std::uint64_t max_bytes) {
  for (const auto& [uri, document] : documents_.documents_)
    if (path_of(uri) == path && document.text.size() <= max_bytes) return {document.text, {}};
  return below_.read_file(path, max_bytes);
}

Documents::Documents(Host& host, std::string stdlib_dir)
    : overlay_(*this, host), stdlib_dir_(std::move(stdlib_dir)) {}

void Documents::open(const std::string& uri, std::string text, std::int64_t version) {
  if (documents_.size() >= kMaxDocuments && !documents_.contains(uri)) return;
  if (text.size() > kMaxText) text.resize(kMaxText);
  Document& document = documents_[uri];
  document.uri = uri;
  document.text = std::move(text);
  document.version = version;
  document.changed = true;
  forget_users_of(uri);
}

bool Documents::change(const std::string& uri, const Json& changes, std::int64_t version, Encoding encoding) {
  Document* document = find(uri);
  if (document == nullptr) return false;
  for (const Json& change : changes) {
    const std::string& text = change.at("text").get_ref<const std::string&>();
    if (!change.contains("range")) {
      if (text.size() > kMaxText) return false;
      document->text = text;
      continue;
    }
    const Lines lines(document->text, encoding);
    const std::uint32_t begin = lines.offset(change["range"].at("start"));
    const std::uint32_t end = std::max(begin, lines.offset(change["range"].at("end")));
    if (document->text.size() - (end - begin) + text.size() > kMaxText) return false;
    document->text.replace(begin, end - begin, text);
  }
  document->version = version;
  document->changed = true;
  forget_users_of(uri);
  return true;
}

void Documents::close(const std::string& uri) {
  documents_.erase(uri);
  forget_users_of(uri);
}

Document* Documents::find(const std::string& uri) {
  const auto found = documents_.find(uri);
  return found == documents_.end() ? nullptr : &found->second;
}

/// Texts that use this file, or could not find a file, may mean something else now.
void Documents::forget_users_of(const std::string& uri) {
  const std::string path = path_of(uri);
  for (auto& [other, document] : documents_) {
    if (other == uri || document.now == nullptr) continue;
    const interpreter::Interpretation& result = document.now->result;
    const bool misses = std::any_of(result.diagnostics.begin(), result.diagnostics.end(),
                                    [](const grammar::Diagnostic& d) { return d.code == "G0318"; });
    if (misses || result.program->loaded.contains(path)) document.changed = true;
  }
}

interpreter::InterpretOptions Documents::options_of(const std::string& uri) const {
  interpreter::InterpretOptions options;
  options.stdlib_dir = stdlib_dir_;
  options.script_dir = folder_of(path_of(uri));
  auto* self = const_cast<Documents*>(this);
  options.build_bodies = false;
  options.warn_unused = true;
  options.build_body = [self](const design::Body& declared, Host&, const std::string& folder) {
    return self->cached_body(declared, folder);
  };
  return options;
}

body::BodyResult Documents::cached_body(const design::Body& declared, const std::string& folder) {
  const std::optional<std::string> key = key_of(declared);
  if (!key) return body::build_body(declared, overlay_, folder);
  const auto found = bodies_.find(*key);
  // Findings point into the text that they were made for: only what had none is kept.
  if (found != bodies_.end()) return found->second;
  body::BodyResult built = body::build_body(declared, overlay_, folder);
  if (!built.findings.empty()) return built;
  if (bodies_.size() >= kMaxBodies) bodies_.clear();
  return bodies_[*key] = std::move(built);
}

void Documents::analyse(Document& document) {
  if (!document.changed) return;
  document.changed = false;
  auto analysis = std::make_shared<Analysis>();
  analysis->source = analysis->sources.add(path_of(document.uri), document.text);
  analysis->result =
      interpreter::interpret(analysis->sources, analysis->source, overlay_, options_of(document.uri));
  analysis->names = service::names_of(analysis->result);
  document.now = analysis;
  document.model_unchecked = analysis->result.ok();
  if (analysis->result.ok() || document.good == nullptr) document.good = analysis;
}

void Documents::check_model(Document& document) {
  document.model_unchecked = false;
  if (document.now == nullptr || !document.now->result.ok()) return;
  Analysis& analysis = *document.now;
  const interpreter::Interpretation& result = analysis.result;
  Findings findings = modeller::find_unmodelled(result.garment, Severity::warning);
  if (findings.empty() && !result.garment.panels.empty() && particles_of(result.garment) < kMaxParticles) {
    std::vector<body::Body> bodies;
    for (const design::Body& declared : result.garment.bodies) {
      body::BodyResult built = cached_body(declared, options_of(document.uri).script_dir);
      findings.insert(findings.end(), built.findings.begin(), built.findings.end());
      if (built.body) bodies.push_back(std::move(*built.body));
    }
    if (bodies.size() == result.garment.bodies.size()) {
      const Findings more = interpreter::model_of(result.garment, bodies, result.acts).findings;
      findings.insert(findings.end(), more.begin(), more.end());
    }
  }
  analysis.model = interpreter::to_diagnostics(findings, result.origins);
}

Document* Documents::next_changed() {
  for (auto& [uri, document] : documents_)
    if (document.changed) return &document;
  return nullptr;
}

Document* Documents::next_unchecked() {
  for (auto& [uri, document] : documents_)
    if (document.model_unchecked) return &document;
  return nullptr;
}

}  // namespace garment::lsp
