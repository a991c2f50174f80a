// Files below granted folders: no way out by links, `..`, absolute paths, devices or pipes.
#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <sys/stat.h>

#include "runtime/base/host.hpp"

namespace {

namespace fs = std::filesystem;
using garment::Host;
using garment::system_host;

/// A folder of its own, removed at the end: granted/ with a file and a folder, outside/ with a secret.
struct Folders {
  fs::path root;
  Folders() {
    std::string name = (fs::temp_directory_path() / "garment_access_XXXXXX").string();
    REQUIRE(::mkdtemp(name.data()) != nullptr);
    root = name;
    fs::create_directories(root / "granted/inner");
    fs::create_directories(root / "granted_too");
    fs::create_directories(root / "outside");
    write(root / "granted/here.txt", "here");
    write(root / "granted/inner/below.txt", "below");
    write(root / "outside/secret.txt", "secret");
    write(root / "granted_too/sibling.txt", "sibling");
  }
  ~Folders() { fs::remove_all(root); }
  static void write(const fs::path& path, const std::string& text) { std::ofstream(path) << text; }
  static std::string read(const fs::path& path) {
    std::ifstream in(path);
    return {std::istreambuf_iterator<char>(in), {}};
  }
  std::string granted() const { return (root / "granted").string(); }
  std::string at(const std::string& path) const { return (root / "granted").string() + "/" + path; }

  garment::HostResult<std::string> try_read(const std::string& path) const {
    return system_host().read_below({granted()}, path, 1000);
  }
  bool denied_read(const std::string& path) const {
    const auto got = try_read(path);
    return !got && got.error.denied;
  }
  bool denied_write(const std::string& path) const {
    const auto got = system_host().write_below({granted()}, path, "x");
    return !got && got.error.denied;
  }
};

}  // namespace

TEST_CASE("reading stays below the granted folder") {
  const Folders f;
  CHECK(*f.try_read(f.at("here.txt")).value == "here");
  CHECK(*f.try_read(f.at("inner/../inner/below.txt")).value == "below");
  CHECK(f.denied_read(f.at("../outside/secret.txt")));
  CHECK(f.denied_read((f.root / "outside/secret.txt").string()));
  CHECK(f.denied_read("/etc/passwd"));
  CHECK(f.denied_read("/proc/self/environ"));
  CHECK(f.denied_read((f.root / "granted_too/sibling.txt").string()));  // its name only begins alike
  // What does not exist outside is refused in the same words as what does.
  CHECK(f.denied_read(f.at("../outside/no_such_file.txt")));
  CHECK_FALSE(f.denied_read(f.at("no_such_file.txt")));
  CHECK_FALSE(f.try_read(f.at("no_such_file.txt")));
  CHECK(*system_host().read_below({f.granted(), (f.root / "outside").string()}, f.at("../outside/secret.txt"), 99).value ==
        "secret");
}

TEST_CASE("links do not lead out") {
  const Folders f;
  fs::create_symlink(f.root / "outside/secret.txt", f.at("link.txt"));
  fs::create_symlink(f.root / "outside", f.at("folder"));
  fs::create_symlink("here.txt", f.at("inside_link.txt"));
  CHECK(f.denied_read(f.at("link.txt")));
  CHECK(f.denied_read(f.at("folder/secret.txt")));
  CHECK(*f.try_read(f.at("inside_link.txt")).value == "here");
  CHECK(f.denied_write(f.at("folder/new.txt")));
  CHECK_FALSE(fs::exists(f.root / "outside/new.txt"));
  // A link at the place itself is replaced; what it names stays as it was.
  CHECK(system_host().write_below({f.granted()}, f.at("link.txt"), "mine"));
  CHECK(Folders::read(f.root / "outside/secret.txt") == "secret");
  CHECK(Folders::read(f.at("link.txt")) == "mine");
  CHECK_FALSE(fs::is_symlink(f.at("link.txt")));
  // A granted folder that is itself named by a link is the folder it names.
  fs::create_symlink(f.granted(), f.root / "alias");
  CHECK(*system_host().read_below({(f.root / "alias").string()}, (f.root / "alias/here.txt").string(), 99).value == "here");
}

TEST_CASE("only regular files are opened") {
  const Folders f;
  REQUIRE(::mkfifo(f.at("pipe").c_str(), 0600) == 0);
  for (const char* name : {"pipe", "inner", "."}) {
    const auto got = f.try_read(f.at(name));
    CHECK_FALSE(got);
  }
  CHECK_FALSE(system_host().read_below({"/dev"}, "/dev/zero", 10));
  CHECK_FALSE(system_host().read_below({"/proc"}, "/proc/self/environ", 10000));
  CHECK_FALSE(system_host().write_below({f.granted()}, f.at("pipe"), "x"));
  CHECK_FALSE(system_host().write_below({f.granted()}, f.at("inner"), "x"));
  CHECK_FALSE(f.try_read(f.at("here.txt") + std::string(5000, 'x')));
}

TEST_CASE("writing stays below the granted folder and makes folders there") {
  const Folders f;
  CHECK(system_host().write_below({f.granted()}, f.at("a/b/c.txt"), "text"));
  CHECK(Folders::read(f.at("a/b/c.txt")) == "text");
  CHECK(system_host().write_below({f.granted()}, f.at("here.txt"), "new"));
  CHECK(Folders::read(f.at("here.txt")) == "new");
  CHECK(f.denied_write(f.at("../outside/x.txt")));
  CHECK(f.denied_write(f.at("a/../../outside/x.txt")));
  CHECK(f.denied_write((f.root / "outside/x.txt").string()));
  CHECK_FALSE(fs::exists(f.root / "outside/x.txt"));
  CHECK_FALSE(system_host().write_below({f.granted()}, f.at("inner/.."), "x"));
  CHECK(system_host().write_below({(f.root / "fresh").string()}, (f.root / "fresh/x.txt").string(), "made"));
  int files = 0;  // no temporary file is left
  for (const auto& entry : fs::recursive_directory_iterator(f.root)) files += entry.is_regular_file() ? 1 : 0;
  CHECK(files == 6);
}

TEST_CASE("a confined host reads below its folders and writes nothing") {
  const Folders f;
  garment::ConfinedHost host(system_host(), {f.granted()});
  CHECK(*host.read_file(f.at("here.txt"), 10).value == "here");
  CHECK(host.read_file((f.root / "outside/secret.txt").string(), 10).error.denied);
  CHECK_FALSE(host.write_file(f.at("x.txt"), "x"));
  CHECK_FALSE(fs::exists(f.at("x.txt")));
}

TEST_CASE("removing stays below the granted folder, and takes links, not what they name") {
  const Folders f;
  fs::create_symlink(f.root / "outside/secret.txt", f.at("link.txt"));
  fs::create_symlink(f.root / "outside", f.at("folder"));
  const auto remove = [&](const std::string& path) { system_host().remove_below({f.granted()}, path); };
  for (const std::string& path : {f.at("../outside/secret.txt"), (f.root / "outside/secret.txt").string(), f.at("folder/secret.txt"),
                                  f.at("no_such_file.txt"), f.at("inner")})
    remove(path);
  CHECK(Folders::read(f.root / "outside/secret.txt") == "secret");
  CHECK(fs::exists(f.at("inner/below.txt")));
  remove(f.at("link.txt"));
  remove(f.at("here.txt"));
  CHECK_FALSE(fs::exists(fs::symlink_status(f.at("link.txt"))));
  CHECK_FALSE(fs::exists(f.at("here.txt")));
  CHECK(Folders::read(f.root / "outside/secret.txt") == "secret");
}
