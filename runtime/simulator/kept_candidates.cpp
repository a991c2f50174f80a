#include "runtime/simulator/kept_candidates.hpp"

#include <algorithm>

namespace garment::simulator {
namespace {

constexpr int kFew = 3, kMany = 16;                   // positions that a list serves, before the next has more or less room
constexpr double kLeastListRoom = 0.1, kMostListRoom = 0.4;   // spacings; beyond, a particle's own neighbours fill the list

}  // namespace

bool KeptCandidates::refresh(const std::vector<Vector3d>& x) {
  ++served_;
  if (known_ && candidates_.complete(mesh_, x, nullptr, mesh_.largest_contact_distance)) return false;
  rebuild(x);
  return true;
}

void KeptCandidates::renew(const std::vector<Vector3d>& x) {
  served_ = 0;
  rebuild(x);
}

void KeptCandidates::rebuild(const std::vector<Vector3d>& x) {
  if (known_) room_ *= served_ < kFew ? 1.5 : served_ > kMany ? 0.75 : 1;
  room_ = std::clamp(room_, kLeastListRoom * spacing_, kMostListRoom * spacing_);
  served_ = 0;
  candidates_.rebuild(mesh_, x, mesh_.largest_contact_distance + room_);
  known_ = true;
}

}  // namespace garment::simulator
