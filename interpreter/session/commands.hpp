#pragma once
// The commands of the prompt: one record each, read by the prompt itself, by `:help` and by completion.
#include <string>
#include <string_view>
#include <vector>

#include "interpreter/session/session.hpp"

namespace garment::session {

struct SessionCommand {
  std::string_view name;
  std::string_view takes;  ///< "[FILE]"; empty where it takes nothing
  std::string_view doc;
  Answer (*run)(Session&, const std::string& argument);
};

/// In the order of `:help`.
const std::vector<SessionCommand>& session_commands();
/// By its name, or by the beginning of one that no other command has.
const SessionCommand* find_command(std::string_view name);

/// What `:set` sets.
std::vector<std::string> setting_names();

}  // namespace garment::session
