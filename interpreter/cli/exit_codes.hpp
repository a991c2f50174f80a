#pragma once
// What the program returns to the shell; documented in --help and the README.

namespace garment::cli {

enum ExitCode : int {
  kOk = 0,
  kDiagnostics = 1,
  kUsage = 2,
  kInputOutput = 3,
  kSimulationFailed = 4,
  kExpectFailed = 5,
  kInterrupted = 130,
};

}  // namespace garment::cli
