#pragma once
// The one cloth that stands for a panel's fabric and the layers joined to it.
#include <Eigen/Core>
#include <vector>

#include "runtime/model/model.hpp"
#include "runtime/modeller/cloth_fields.hpp"

namespace garment::modeller {

/// Share of the shear between fused layers that the glue carries, 0 .. 1. Fused cloths are 3 to 10 times as stiff in bending
/// as the face alone (Kim, Inui, Takatera 2012); full coupling would make them 20 to 100 times so.
inline constexpr double kFusedCoupling = 0.1;

/// The equivalent material of a patch of cloth (the source paper's method for interlinings; docs/physics.md, section 2):
///   mass, thickness, tensile force at equal strain, shear    add
///   bending      basted layers add their own; of n fused ones, with z the height of their middles,
///                D = sum D_i + eta (sum A_i z_i^2 - (sum A_i z_i) (sum A_i)^-1 (sum A_i z_i)),  eta = kFusedCoupling
///   friction     of the layer that lies on the body
/// Axes 1 and 2 are the panel's warp and, a quarter turn counter-clockwise from it, its weft. Plates are [3 x 3] in
/// (11, 22, 12), N m; the layers' grain may lie at any angle.
class LayeredCloth {
 public:
  LayeredCloth(const ClothFields& fields, std::size_t panel, const GridFrame& frame, const Patch& patch);

  double areal_density() const;  ///< kg/m^2
  double thickness() const;      ///< m
  double friction() const;       ///< Coulomb, on a body
  double shear() const;          ///< G, N/m per rad
  Eigen::Vector2d shear_friction() const;    ///< HG and HG5, N/m: those of all layers, as their shear
  Eigen::Vector2d bending_friction() const;  ///< HB along axes 1 and 2, N: those of all layers, fused or not
  Eigen::Matrix3d plate() const;
  /// What makes up the tensile law along the warp (0) or the weft (1).
  struct Tensile {
    int law;        ///< 2 * fabric + direction: into the model's laws of fabrics
    double factor;  ///< on its force
  };
  std::vector<Tensile> tensile(int direction) const;
  /// Force per strain that is added to it, N/m: the shear of layers that lie at an angle.
  double linear(int direction) const;

 private:
  struct Ply {
    int fabric;
    Eigen::Vector2d warp;  // in the axes above
    bool fused;
    double z;              // height of its middle over the panel's, m
  };
  Eigen::Matrix3d membrane(const Ply& ply) const;
  double factor(int direction) const { return direction == 0 ? patch_.factors.stretch_warp : patch_.factors.stretch_weft; }

  const design::Fabric& fabric(const Ply& ply) const { return fields_.garment().fabrics[ply.fabric]; }

  const ClothFields& fields_;
  Patch patch_;
  std::vector<Ply> plies_;  // the panel's own fabric first
};

/// The mean of the equivalent materials in a square about a place of a panel.
class ClothAt {
 public:
  ClothAt(const ClothFields& fields, std::size_t panel, const GridFrame& frame, const design::Point2& p, double width);

  double areal_density() const { return mean(&LayeredCloth::areal_density); }
  double thickness() const { return mean(&LayeredCloth::thickness); }
  double friction() const { return mean(&LayeredCloth::friction); }
  double shear() const { return mean(&LayeredCloth::shear); }
  Eigen::Vector2d shear_friction() const;
  Eigen::Vector2d bending_friction() const;
  Eigen::Matrix3d plate() const;
  std::vector<LayeredCloth::Tensile> tensile(int direction) const;  ///< each law once
  double linear(int direction) const;
  double rest(int direction) const;  ///< length at rest over length as cut

 private:
  double mean(double (LayeredCloth::*value)() const) const;
  std::vector<Patch> patches_;
  std::vector<LayeredCloth> cloths_;  // of the patches
};

/// Matrix of curvatures (or strains) seen along other axes: (11, 22, 12) along the unit vector `axis` and the one a quarter
/// turn counter-clockwise from it.
Eigen::Matrix3d seen_along(const Eigen::Vector2d& axis);

}  // namespace garment::modeller
