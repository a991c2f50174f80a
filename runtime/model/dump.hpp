#pragma once
// The Model and the State as text and as hashes.
#include <cstdint>
#include <string>

#include "runtime/model/model.hpp"

namespace garment::model {

/// FNV-1a (64 bit) over the bit patterns of the positions, in order: equal exactly where all positions are
/// equal bit for bit (0 and -0 differ).
std::uint64_t state_hash(const State& state);

/// The same over all arrays and tables of the Model, in the order of model_arrays.hpp. Names and origins do
/// not count.
std::uint64_t model_hash(const Model& model);

/// 16 hexadecimal digits.
std::string hash_text(std::uint64_t hash);

/// Counts, mass, panels with areas, seams with lengths, and the hash; a line each, ends with a newline.
std::string summary_text(const Model& model);

/// All arrays and tables as one JSON object, numbers printed so that they read back to the same bits.
std::string dump_json(const Model& model);

}  // namespace garment::model
