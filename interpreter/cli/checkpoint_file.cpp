#include "interpreter/cli/checkpoint_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <filesystem>

#include "runtime/base/archive.hpp"
#include "runtime/base/folder.hpp"
#include "runtime/base/hash.hpp"
#include "runtime/base/number.hpp"
#include "runtime/base/program_id.hpp"
#include "runtime/model/dump.hpp"

namespace garment::cli {
namespace {

constexpr std::string_view kMagic = "garment checkpoint 1\n";
constexpr std::uint64_t kMostBytes = std::uint64_t{1} << 30;
constexpr std::size_t kMostDifferences = 3;
const std::string kSlotName = "checkpoint-";

/// Eight bytes at a time, so that megabytes take a millisecond. Against accidents: whoever wants to can make bytes of any sum.
std::uint64_t check_sum(std::string_view bytes) {
  std::uint64_t sum = 0x9e3779b97f4a7c15ULL ^ bytes.size();
  while (!bytes.empty()) {
    std::uint64_t word = 0;
    const std::size_t n = std::min(bytes.size(), sizeof word);
    std::memcpy(&word, bytes.data(), n);
    sum = (sum ^ word) * 0xff51afd7ed558ccdULL;
    sum ^= sum >> 32;
    bytes.remove_prefix(n);
  }
  return sum;
}

void keep(Archive& a, CheckpointFile& file) {
  a.keep(file.number);
  if (!a.length(file.identity, 2 * sizeof(std::uint64_t))) return;
  for (auto& [what, value] : file.identity) {
    a.keep(what);
    a.keep(value);
  }
  a.keep(file.state);
}

std::string body_hash(const body::Body& body) {
  const auto& points = body.mesh.vertices;
  Sha256 sum;
  if (!points.empty()) sum.add({reinterpret_cast<const char*>(points.front().data()), points.size() * sizeof points.front()});
  return sum.hex();
}

/// How long each drape is; a file that the script reads may say so.
std::string drapes_of(const Project& project) {
  std::string text;
  for (const interpreter::Act& act : project.result.acts)
    if (const auto* drape = std::get_if<interpreter::DrapeAct>(&act.act))
      text += drape->until_rest ? fmt::format("rest {}; ", static_cast<int>(drape->settle)) : fmt::format("{} s; ", format_number(drape->duration));
  return text;
}

const std::string* find(const Identity& identity, const std::string& what) {
  for (const auto& [name, value] : identity)
    if (name == what) return &value;
  return nullptr;
}

/// Hashes tell a person nothing.
bool readable(const std::string& what) { return what.starts_with("parameter") || what.starts_with("`--") || what == "the program"; }

}  // namespace

Identity identity_of(const Project& project, const ProjectOptions& project_options, const model::Model& model, const Identity& options) {
  Identity out{{"the program", program_id()}};
  for (std::size_t i = 0; i < project.sources.size(); ++i) {
    const grammar::Source& s = project.sources[static_cast<grammar::SourceId>(i)];
    if (s.name.starts_with("-p ")) continue;  // a parameter
    const std::string name = s.name.substr(s.name.find_last_of('/') + 1);
    out.emplace_back(i == project.source ? "the script" : fmt::format("`{}`", name), sha256(s.text));
  }
  for (const interpreter::Parameter& p : project.result.parameters) out.emplace_back(fmt::format("parameter `{}`", p.name), p.value);
  if (const auto& study = project_options.study) out.emplace_back(fmt::format("`{}` of the study", study->target), study->value);
  out.insert(out.end(), options.begin(), options.end());
  out.emplace_back("what is draped", drapes_of(project));
  for (std::size_t b = 0; b < project.result.bodies.size(); ++b)
    out.emplace_back(fmt::format("the body `{}`", project.result.bodies[b].name), body_hash(project.result.bodies[b]));
  out.emplace_back("the particle model", model::hash_text(model::model_hash(model)));
  return out;
}

std::string difference(const Identity& written, const Identity& now) {
  std::vector<std::string> told;
  for (const auto& [what, value] : now) {  // several files may have one name
    if (std::find(written.begin(), written.end(), std::pair(what, value)) != written.end()) continue;
    const std::string* before = find(written, what);
    if (what == "the particle model" && !told.empty()) continue;  // it follows from the others
    told.push_back(before != nullptr && readable(what) ? fmt::format("{} (`{}`, then `{}`)", what, value, *before) : what);
  }
  for (const auto& [what, value] : written)
    if (find(now, what) == nullptr) told.push_back(what);
  if (told.size() > kMostDifferences) {
    const std::size_t more = told.size() - kMostDifferences;
    told.resize(kMostDifferences);
    told.push_back(fmt::format("{} more", more));
  }
  return fmt::format("{}", fmt::join(told, ", "));
}

std::string checkpoint_bytes(CheckpointFile file) {
  Archive content;
  keep(content, file);
  const std::string bytes = content.take();
  Archive head;
  std::uint64_t size = bytes.size(), sum = check_sum(bytes);
  head.keep(size);
  head.keep(sum);
  return std::string(kMagic) + head.take() + bytes;
}

ReadCheckpoint read_checkpoint(std::string_view bytes) {
  ReadCheckpoint out;
  if (!bytes.starts_with(kMagic)) {
    out.problem = "it is no checkpoint of this format";
    return out;
  }
  Archive head(bytes.substr(kMagic.size()));
  std::uint64_t size = 0, sum = 0;
  head.keep(size);
  head.keep(sum);
  const std::string_view content = head.rest();
  if (!head.ok() || content.size() != size) {
    out.problem = fmt::format("it has {} bytes, and should have {}", content.size(), size);
    return out;
  }
  Archive a(content);
  if (check_sum(content) == sum) keep(a, out.file);
  out.sound = check_sum(content) == sum && a.whole() && out.file.number > 0;
  if (!out.sound) out.problem = "its checksum does not fit its content";
  return out;
}

CheckpointSlots::CheckpointSlots(std::string folder, std::vector<std::string> granted, Host& host)
    : folder_(std::move(folder)), granted_(std::move(granted)), host_(host) {}

std::string CheckpointSlots::path(int slot) const {
  return (std::filesystem::path(folder_) / fmt::format("{}{}.state", kSlotName, slot + 1)).string();
}

CheckpointSlots::Found CheckpointSlots::newest() {
  Found found;
  for (int slot : {0, 1}) {
    const HostResult<std::string> bytes = host_.read_below(granted_, path(slot), kMostBytes);
    if (!bytes && bytes.error.message == "no such file") continue;
    ReadCheckpoint read;
    if (bytes) read = read_checkpoint(*bytes.value);
    else read.problem = bytes.error.message;
    if (!read.sound) {
      grammar::Diagnostic d = plain_error("G0910", fmt::format("the checkpoint `{}` is damaged: {}", path(slot), read.problem),
                                          "nothing is to be done: an older one or the start is taken instead");
      d.severity = Severity::warning;
      found.damaged.push_back(std::move(d));
      continue;
    }
    if (read.file.number <= found.file.number) continue;
    found.file = std::move(read.file);
    found.name = path(slot);
    number_ = found.file.number;
    newest_ = slot;
  }
  read_ = true;
  return found;
}

HostResult<bool> CheckpointSlots::write(Identity identity, std::string state) {
  if (!read_) remove();
  read_ = true;
  const int slot = 1 - newest_;
  HostResult<bool> written =
      host_.write_below(granted_, path(slot), checkpoint_bytes({number_ + 1, std::move(identity), std::move(state)}));
  if (!written) return written;
  newest_ = slot;
  ++number_;
  return written;
}

void CheckpointSlots::remove() {
  for (int slot : {0, 1}) host_.remove_below(granted_, path(slot));
  for (const std::string& name : folder_entries(folder_))
    if (name.starts_with(kSlotName) && name.ends_with(".tmp")) host_.remove_below(granted_, (std::filesystem::path(folder_) / name).string());
}

}  // namespace garment::cli
