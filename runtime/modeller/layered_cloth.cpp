#include "runtime/modeller/layered_cloth.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "runtime/base/portable_math.hpp"

namespace garment::modeller {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;

double fourth(double x) { return x * x * x * x; }

/// In the axes of a ply, turned into those of the panel.
Matrix3d turned(const Vector3d& own, const Vector2d& warp) {
  const Matrix3d turn = seen_along(warp);
  return turn.transpose() * own.asDiagonal() * turn;
}

}  // namespace

Matrix3d seen_along(const Vector2d& axis) {
  const double c = axis.x(), s = axis.y();
  Matrix3d turn;
  turn << c * c, s * s, 2 * s * c, s * s, c * c, -2 * s * c, -s * c, s * c, c * c - s * s;
  return turn;
}

LayeredCloth::LayeredCloth(const ClothFields& fields, std::size_t panel, const GridFrame& frame, const Patch& patch)
    : fields_(fields), patch_(patch) {
  const design::Garment& garment = fields.garment();
  const int fabric = garment.panels[panel].fabric;
  plies_.push_back({fabric, Vector2d(1, 0), true, 0});
  const std::vector<design::Layer>& all = fields.layers();
  std::vector<int> layers = patch.layers;
  std::stable_sort(layers.begin(), layers.end(), [&](int a, int b) { return all[a].order < all[b].order; });
  double height[2] = {garment.fabrics[fabric].thickness / 2, garment.fabrics[fabric].thickness / 2};  // on face and back
  for (int k : layers) {
    const design::Layer& layer = all[k];
    const design::Point2 warp(-portable::sin(layer.grain_angle), portable::cos(layer.grain_angle));
    const design::Point2 along = frame.warp(), across(-along.y(), along.x());
    const bool face = layer.side == design::Facing::face;
    const double half = garment.fabrics[layer.fabric].thickness / 2;
    const double z = height[face ? 0 : 1] + half;
    height[face ? 0 : 1] = z + half;
    plies_.push_back({layer.fabric, Vector2d(warp.dot(along), warp.dot(across)), layer.fused, face ? z : -z});
  }
}

double LayeredCloth::areal_density() const {
  double sum = 0;
  for (const Ply& ply : plies_) sum += fabric(ply).areal_density;
  return sum * patch_.factors.mass;
}

double LayeredCloth::thickness() const {
  double sum = 0;
  for (const Ply& ply : plies_) sum += fabric(ply).thickness;
  return sum * patch_.factors.thickness;
}

double LayeredCloth::friction() const {
  const Ply& inner = *std::min_element(plies_.begin(), plies_.end(), [](const Ply& a, const Ply& b) { return a.z < b.z; });
  return fabric(inner).friction * patch_.factors.friction;
}

/// Stiffness against small strains, N/m.
Matrix3d LayeredCloth::membrane(const Ply& ply) const {
  return turned(Vector3d(fields_.slope(ply.fabric, 0), fields_.slope(ply.fabric, 1), 4 * fabric(ply).shear_rigidity), ply.warp);
}

double LayeredCloth::shear() const {
  double sum = fabric(plies_[0]).shear_rigidity;
  for (std::size_t k = 1; k < plies_.size(); ++k) sum += membrane(plies_[k])(2, 2) / 4;
  return sum * patch_.factors.shear;
}

Vector2d LayeredCloth::shear_friction() const {
  Vector2d sum = Vector2d::Zero();
  for (const Ply& ply : plies_) {
    const double c = ply.warp.x(), s = ply.warp.y(), share = (c * c - s * s) * (c * c - s * s);
    sum += share * Vector2d(fabric(ply).shear_friction, fabric(ply).shear_friction_5);
  }
  return sum * patch_.factors.shear;
}

Vector2d LayeredCloth::bending_friction() const {
  Vector2d sum = Vector2d::Zero();
  for (const Ply& ply : plies_) {
    const double c = fourth(ply.warp.x()), s = fourth(ply.warp.y());
    const auto& hb = fabric(ply).bending_friction;
    sum += Vector2d(c * hb[0] + s * hb[1], s * hb[0] + c * hb[1]);
  }
  return sum.cwiseProduct(Vector2d(patch_.factors.bend_warp, patch_.factors.bend_weft));
}

Matrix3d LayeredCloth::plate() const {
  Matrix3d sum = Matrix3d::Zero(), a = sum, az = sum, azz = sum;
  for (const Ply& ply : plies_) {
    const design::Fabric& f = fabric(ply);
    sum += turned(Vector3d(f.bending_rigidity[0], f.bending_rigidity[1], 4 * twist_rigidity(f)), ply.warp);
    if (!ply.fused || plies_.size() == 1) continue;
    const Matrix3d stiff = membrane(ply);
    a += stiff;
    az += stiff * ply.z;
    azz += stiff * (ply.z * ply.z);
  }
  if (a.norm() > 0) {
    const Matrix3d coupled = azz - az * a.completeOrthogonalDecomposition().pseudoInverse() * az;
    sum += kFusedCoupling / 2 * (coupled + coupled.transpose());
  }
  const Vector3d root(std::sqrt(patch_.factors.bend_warp), std::sqrt(patch_.factors.bend_weft), std::sqrt(patch_.factors.twist));
  Matrix3d plate = root.asDiagonal() * sum * root.asDiagonal();
  plate.diagonal() = sum.diagonal().cwiseProduct(Vector3d(patch_.factors.bend_warp, patch_.factors.bend_weft, patch_.factors.twist));
  return plate;
}

std::vector<LayeredCloth::Tensile> LayeredCloth::tensile(int direction) const {
  std::vector<Tensile> parts;
  for (const Ply& ply : plies_)
    for (int own = 0; own < 2; ++own) {
      const double share = fourth(own == direction ? ply.warp.x() : ply.warp.y());
      if (share > 1e-9) parts.push_back({2 * ply.fabric + own, share * factor(direction)});
    }
  return parts;
}

double LayeredCloth::linear(int direction) const {
  double sum = 0;
  for (const Ply& ply : plies_) {
    const double c = ply.warp.x(), s = ply.warp.y();
    sum += 4 * c * c * s * s * fabric(ply).shear_rigidity;
  }
  return sum * factor(direction);
}

ClothAt::ClothAt(const ClothFields& fields, std::size_t panel, const GridFrame& frame, const design::Point2& p, double width)
    : patches_(fields.around(panel, p, width)) {
  for (const Patch& patch : patches_) cloths_.emplace_back(fields, panel, frame, patch);
}

double ClothAt::mean(double (LayeredCloth::*value)() const) const {
  if (cloths_.size() == 1) return (cloths_[0].*value)();
  double sum = 0;
  for (std::size_t k = 0; k < cloths_.size(); ++k) sum += patches_[k].share * (cloths_[k].*value)();
  return sum;
}

Vector2d ClothAt::shear_friction() const {
  Vector2d sum = Vector2d::Zero();
  for (std::size_t k = 0; k < cloths_.size(); ++k) sum += patches_[k].share * cloths_[k].shear_friction();
  return sum;
}

Vector2d ClothAt::bending_friction() const {
  Vector2d sum = Vector2d::Zero();
  for (std::size_t k = 0; k < cloths_.size(); ++k) sum += patches_[k].share * cloths_[k].bending_friction();
  return sum;
}

Matrix3d ClothAt::plate() const {
  if (cloths_.size() == 1) return cloths_[0].plate();
  Matrix3d sum = Matrix3d::Zero();
  for (std::size_t k = 0; k < cloths_.size(); ++k) sum += patches_[k].share * cloths_[k].plate();
  return sum;
}

std::vector<LayeredCloth::Tensile> ClothAt::tensile(int direction) const {
  std::vector<LayeredCloth::Tensile> sum;
  for (std::size_t k = 0; k < cloths_.size(); ++k)
    for (const LayeredCloth::Tensile& part : cloths_[k].tensile(direction)) {
      const double factor = patches_.size() == 1 ? part.factor : patches_[k].share * part.factor;
      auto known = std::find_if(sum.begin(), sum.end(), [&](const auto& other) { return other.law == part.law; });
      if (known != sum.end())
        known->factor += factor;
      else
        sum.push_back({part.law, factor});
    }
  return sum;
}

double ClothAt::linear(int direction) const {
  double sum = 0;
  for (std::size_t k = 0; k < cloths_.size(); ++k) sum += patches_[k].share * cloths_[k].linear(direction);
  return sum;
}

double ClothAt::rest(int direction) const {
  double sum = 0;
  for (const Patch& patch : patches_) sum += patch.share * (direction == 0 ? patch.rest_warp : patch.rest_weft);
  return sum;
}

}  // namespace garment::modeller
