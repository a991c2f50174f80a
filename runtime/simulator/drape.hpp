#pragma once
// The quasi-static drape: from the placed garment to rest by force (docs/physics.md, section 3).
#include <functional>
#include <string>
#include <vector>

#include "runtime/base/finding.hpp"
#include "runtime/body/body.hpp"
#include "runtime/model/model.hpp"
#include "runtime/simulator/checkpoints.hpp"
#include "runtime/simulator/energy_balance.hpp"

namespace garment::simulator {

enum class Settle { preview, equilibrium, exact };

struct DrapeProgress {
  int step = 0;
  std::size_t particles = 0;
  double residual = 0;        ///< RMS net force over RMS particle weight
  double target = 0;          ///< residual at which the garment rests
  double largest_step = 0;    ///< m, of the last step
  const char* phase = "";     ///< "dressing", "settling", "moving"
  double time = 0, duration = 0;  ///< s, of a drape for a time: moved so far, and in all
};

struct DrapeSettings {
  Settle settle = Settle::equilibrium;
  int max_steps = 4000;
  bool self_collision = true;
  bool near_rest = false;     ///< the start comes from a coarser grid: no dressing, the true stiffness from the first step
  bool hysteresis = false;    ///< the cloth's own friction acts: at rest the weight comes on anew, in increments
  bool symmetric = false;     ///< a garment that is its own image (mirror.hpp) is kept so, as long as it comes to rest
  bool certify = true;        ///< at rest, go on until the exact test finds nothing; off for coarse grids
  std::function<void(const DrapeProgress&)> progress;  ///< called between steps; may be empty
  std::function<bool()> interrupted;                   ///< asked between steps; may be empty
  Checkpoints checkpoints;
};

enum class DrapeStatus {
  at_rest,
  interrupted,
  not_settled,
  tangled,
  diverged,
  ran,          ///< for its time: `drape for`
  not_resumed,  ///< the checkpoint is not one of this drape
};

struct DrapeReport {
  DrapeStatus status = DrapeStatus::not_settled;
  int steps = 0;
  double residual = 0;              ///< RMS residual over RMS particle weight, from the final positions
  double newton_step = 0;           ///< predicted largest Newton step, m
  bool symmetric = false;           ///< was kept as its own image to the end, and is within 3 mm of it
  double energy = 0;                ///< elastic + gravity, J
  std::size_t self_intersections = 0;   ///< triangle pairs, exact test
  std::size_t body_intersections = 0;   ///< triangle pairs cloth x body, exact test
  std::size_t inside_body = 0;          ///< particles inside a body
  std::vector<model::Vector3d> reactions;  ///< N, with which each of the model's holders pulls on the cloth
  std::vector<model::Vector3d> moments;    ///< N m, of the same about the middle of what it holds
  MotionReport motion;              ///< of `drape for`; zero seconds for a drape to rest
  Findings findings;                ///< what could not be reached, with the panel that is the cause
};

/// What a drape says of a checkpoint that is none of its own (G0810).
DrapeReport not_resumed();

/// RMS residual over RMS weight below which a garment rests.
double target_residual(Settle settle);

/// Moves `state` to rest. On return `state` holds the last consistent positions, whatever the status.
DrapeReport drape(const model::Model& model, const std::vector<body::Body>& bodies, model::State& state,
                  const DrapeSettings& settings);

}  // namespace garment::simulator
