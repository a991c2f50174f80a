#pragma once
// What a script may cost. The checks of all rooms read these constants, `garment limits` prints them.
#include <cstddef>
#include <cstdint>

namespace garment {

inline constexpr std::uint64_t kMaxSourceBytes = 4u << 20;          ///< of one source file
inline constexpr int kMaxTreeDepth = 200;                           ///< brackets, blocks, operators, chains of them
inline constexpr int kMaxUseDepth = 16;                             ///< files that use files
inline constexpr std::size_t kMaxSteps = 50'000'000;                ///< of evaluation
inline constexpr std::size_t kMaxCalls = 256;                       ///< calls within calls
inline constexpr int kMaxEvaluationDepth = 1000;                    ///< expressions and declarations within each other
inline constexpr std::size_t kMaxStatements = 100'000;              ///< made by loops
inline constexpr std::size_t kMaxPanels = 4096;
inline constexpr std::size_t kMaxParticles = 2'000'000;
inline constexpr std::size_t kMaxValueBytes = std::size_t{1} << 30;  ///< of texts, lists, records and curves
inline constexpr int kMaxValueDepth = 200;                          ///< lists and records within each other
inline constexpr std::size_t kMaxText = 1u << 20;                   ///< bytes of one text
inline constexpr std::size_t kMaxLinks = 1000;                      ///< of a chain of edges
inline constexpr int kMaxSolveDepth = 3;                            ///< solves that need each other
inline constexpr std::uint64_t kMaxMeshBytes = 200'000'000;         ///< of one mesh file

}  // namespace garment
