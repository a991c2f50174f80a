#pragma once
// Everything a run writes: geometry, pattern, pictures, report.
#include <string>

#include "interpreter/cli/exit_codes.hpp"
#include "interpreter/cli/project.hpp"
#include "interpreter/cli/terminal.hpp"
#include "runtime/base/archive.hpp"
#include "runtime/io/pdf_writer.hpp"
#include "runtime/model/model.hpp"
#include "runtime/results/report.hpp"

namespace garment::cli {

struct OutputOptions {
  std::string folder;
  bool pictures = true;
  bool ply = false;
};

/// Writes files below one folder, or others that were granted, and remembers them for the report.
class OutputFolder {
 public:
  OutputFolder(std::string folder, Host& host, Terminal& terminal, std::vector<std::string> granted = {})
      : folder_(std::move(folder)), granted_(std::move(granted)), host_(host), terminal_(terminal) {
    granted_.insert(granted_.begin(), folder_);
  }
  /// False when a file could not be written; says so once, with the reason.
  bool write(const std::string& name, const std::string& bytes);
  bool failed() const { return failed_; }
  const std::vector<results::OutputFile>& files() const { return files_; }
  const std::string& folder() const { return folder_; }
  const std::vector<std::string>& granted() const { return granted_; }
  void keep(Archive& a);  ///< in a checkpoint: what has been written

 private:
  std::string folder_;
  std::vector<std::string> granted_;  ///< folders below which files may lie, `folder_` first
  Host& host_;
  Terminal& terminal_;
  bool failed_ = false;
  std::vector<results::OutputFile> files_;
};

/// garment.obj, body.obj, garment.glb, pattern.svg, pictures, PLY when asked.
void write_results(const OutputOptions& options, const Project& project, const model::Model& model,
                   const model::State& state, OutputFolder& out);

/// One file of a `save` act, by its ending; false (with a message) where the ending is not known or the name leaves the folder.
bool save_file(const std::string& name, const Project& project, const model::Model& model, const model::State& state,
               OutputFolder& out, const io::PaperSize& paper, Terminal& terminal);

}  // namespace garment::cli
