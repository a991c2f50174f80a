#pragma once
// The declared garment: what a script (or an imported pattern) says, as plain values, before any particle exists.
// Metres, kilograms, seconds, radians. Space: y up, the body stands on y = 0 and faces +z.
#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <variant>
#include <vector>

#include "runtime/design/closures.hpp"
#include "runtime/design/fabric.hpp"
#include "runtime/design/layers.hpp"
#include "runtime/design/panel.hpp"
#include "runtime/design/pressing.hpp"
#include "runtime/design/region.hpp"
#include "runtime/design/scene.hpp"
#include "runtime/design/seam.hpp"

namespace garment::design {

/// Edges held at a level of a body, or along a curve on it.
struct Attachment {
  std::string name;
  OriginId origin;
  std::vector<EdgePart> parts;
  std::string body, level;
  bool slide = true;    ///< may move along the level; otherwise it is held where it lies
};

/// Points of a panel held where they start in space (`hold`).
struct Pin {
  std::string name;
  OriginId origin;
  int panel = -1;
  Point2 point{0, 0};
};

/// A parametric person. Girths, heights and lengths in metres by their names in stdlib/bodies; what is not given comes
/// from the size table.
struct Mannequin {
  enum class Sex { woman, man } sex = Sex::woman;
  double size = 40;
  std::map<std::string, double> measures;
};
/// Triangle mesh read from an OBJ file; metres unless `scale` says otherwise.
struct MeshFile {
  std::string path;
  double scale = 1;
};
struct Sphere {
  double radius = 0.1;
};
struct Ellipsoid {
  Eigen::Vector3d semi_axes{0.1, 0.1, 0.1};
};
/// Upright solid cylinder, `height` along y, its base at the body's position. A round table is one.
struct Cylinder {
  double radius = 0.1, height = 0.5;
};
struct Box {
  Eigen::Vector3d size{0.1, 0.1, 0.1};
};
/// The half space below y = position.y.
struct Floor {};

struct Body {
  std::string name;
  OriginId origin;
  std::variant<Mannequin, MeshFile, Sphere, Ellipsoid, Cylinder, Box, Floor> shape;
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< of the centre (sphere, ellipsoid, box), of the base (others)
  double friction = 0.3;                               ///< Coulomb, against cloth
};

struct Garment {
  std::string title;
  std::vector<Fabric> fabrics;
  std::vector<Body> bodies;
  std::vector<Panel> panels;
  std::vector<Seam> seams;
  std::vector<Hem> hems;
  std::vector<Tack> tacks;
  std::vector<Button> buttons;
  std::vector<Zip> zips;
  std::vector<Region> regions;
  std::vector<Layer> layers;
  std::vector<Pad> pads;
  std::vector<Stacking> stackings;
  std::vector<Press> presses;
  std::vector<Starch> starches;
  std::vector<Attachment> attachments;
  std::vector<Pin> pins;
  Scene scene;
  Eigen::Vector3d gravity{0, -9.80665, 0};
};

}  // namespace garment::design
