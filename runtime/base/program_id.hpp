#pragma once
// Which program this is.
#include <string>

namespace garment {

/// Version, and the build id that the linker made of all bytes of the program (ELF note): programs of one id give the same bits.
std::string program_id();

}  // namespace garment
