#include "runtime/base/program_id.hpp"

#include <fmt/format.h>
#include <link.h>

#include <cstring>
#include <string_view>

namespace garment {
namespace {

constexpr std::size_t kAligned = 4;

std::size_t padded(std::size_t n) { return (n + kAligned - 1) / kAligned * kAligned; }

/// The description of the note "GNU" 3 in a segment of notes, as hexadecimal digits; empty: there is none.
std::string build_id_in(const char* at, std::size_t size) {
  ElfW(Nhdr) note;
  while (size >= sizeof note) {
    std::memcpy(&note, at, sizeof note);
    const std::size_t name = sizeof note, text = name + padded(note.n_namesz), end = text + padded(note.n_descsz);
    if (end > size) return {};
    if (note.n_type == NT_GNU_BUILD_ID && std::string_view(at + name, note.n_namesz) == std::string_view("GNU", 4)) {
      std::string digits;
      for (std::size_t k = 0; k < note.n_descsz; ++k) digits += fmt::format("{:02x}", static_cast<unsigned char>(at[text + k]));
      return digits;
    }
    at += end;
    size -= end;
  }
  return {};
}

int look(dl_phdr_info* info, std::size_t, void* out) {
  for (int k = 0; k < info->dlpi_phnum; ++k) {
    const auto& segment = info->dlpi_phdr[k];
    if (segment.p_type != PT_NOTE) continue;
    const std::string found = build_id_in(reinterpret_cast<const char*>(info->dlpi_addr + segment.p_vaddr), segment.p_memsz);
    if (found.empty()) continue;
    *static_cast<std::string*>(out) = found;
    break;
  }
  return 1;  // the first object is the program itself
}

}  // namespace

std::string program_id() {
  std::string id;
  ::dl_iterate_phdr(look, &id);
  return fmt::format("garment {} {}", GARMENT_VERSION, id.empty() ? "without a build id" : id);
}

}  // namespace garment
