#pragma once
#include <functional>
#include <string>

#include "runtime/design/garment.hpp"

namespace garment::modeller {

/// Told what cannot be modelled ("zip `placket`") and where it was declared.
using SayUnmodelled = std::function<void(const std::string& what, OriginId origin)>;

void find_unmodelled_cloth(const design::Garment& garment, const SayUnmodelled& say);

}  // namespace garment::modeller
