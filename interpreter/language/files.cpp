#include "interpreter/language/files.hpp"


namespace garment::interpreter {
namespace {

bool stays_below(const std::string& path) {
  if (path.empty() || path[0] == '/' || path.find('\\') != std::string::npos ||
      path.find('\0') != std::string::npos)
    return false;
  std::size_t at = 0;
  while (at <= path.size()) {
    std::size_t end = path.find('/', at);
    if (end == std::string::npos) end = path.size();
    if (path.compare(at, end - at, "..") == 0) return false;
    at = end + 1;
  }
  return true;
}

}  // namespace

namespace {

void refuse_empty(Program& program, const std::string& path, Span span) {
  if (path.empty() || path.find('\0') != std::string::npos)
    fail(program, Message("G0328", "the file name is empty", span).help("give a name in quotes"));
}

}  // namespace

std::string readable_path(Program& program, const std::string& path, Span span) {
  refuse_empty(program, path, span);
  if (program.options.allow_read.empty() && !stays_below(path))
    fail(program, Message("G0328", "`" + path + "` lies outside the script's folder", span)
                      .help("put the file beside the script and name it without `/` at the start and without `..`, or "
                            "grant its folder with `--allow-read`"));
  return path;
}

std::string writable_path(Program& program, const std::string& path, Span span) {
  refuse_empty(program, path, span);
  if (program.options.allow_write.empty() && !stays_below(path))
    fail(program, Message("G0328", "`" + path + "` lies outside the folder for results", span)
                      .help("give a plain file name: `-o` says where it goes; other folders are granted with "
                            "`--allow-write`"));
  return path;
}

}  // namespace garment::interpreter
