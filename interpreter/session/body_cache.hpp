#pragma once
// Bodies that were built once in a session.
#include <map>
#include <string>

#include "runtime/body/body.hpp"

namespace garment::session {

/// Keeps built bodies by all that they are made of, so that an edit of the garment does not build its wearer
/// again. A mesh file is read once; `forget` has it read anew.
class BodyCache {
 public:
  body::BodyResult build(const design::Body& declared, Host& host, const std::string& folder);
  void forget() { bodies_.clear(); }
  /// How many bodies had to be built since the start.
  int n_built() const { return n_built_; }

 private:
  std::map<std::string, body::Body> bodies_;
  int n_built_ = 0;
};

}  // namespace garment::session
