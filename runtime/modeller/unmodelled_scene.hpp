#pragma once
#include <functional>
#include <string>

#include "runtime/design/garment.hpp"

namespace garment::modeller {

/// Calls `say` for everything of the scene that cannot be modelled yet.
void find_unmodelled_scene(const design::Garment& garment,
                           const std::function<void(const std::string& what, OriginId origin)>& say);

}  // namespace garment::modeller
