#pragma once
// Spheres -> picture, in software, without a display. Each pixel casts rays (a grid of samples), the nearest
// surface wins, and what a pixel sees is shaded once a surface: a key light with soft shadows, sky light
// dimmed by the neighbours (ambient occlusion from the spheres themselves), the liquid as a light tint along
// the line of sight. Every pixel is a pure function of the scene, so the bytes do not depend on the number of
// threads.
#include <memory>
#include <vector>

#include "base/vec.h"
#include "model/height_field.h"
#include "report/colour.h"
#include "report/png_image.h"

namespace pigment::report {

struct Sphere {
  Vec3 centre;  // um
  double radius = 0;
  Colour colour;
};

// Lengthwise boxes around the spheres: the substrate's slab and the liquid.
struct Box {
  Vec3 lower = Vec3::Zero(), upper = Vec3::Zero();
};

// Keeps the half space normal . x <= offset; a sphere that the plane cuts shows a filled face.
struct CuttingPlane {
  Vec3 normal;  // unit vector, out of what is kept
  double offset = 0;
};

struct Connection {  // a rod between two points, drawn as a cylinder
  Vec3 from, to;
  double radius = 0;
  Colour colour;
};

struct SphereScene {
  std::vector<Sphere> spheres;
  std::vector<Connection> connections;
  std::vector<CuttingPlane> cuts;
  std::vector<Box> substrate;  // none or one
  std::shared_ptr<const HeightField> ground = nullptr;  // its upper face, where that is not flat; the box ends at its crests
  std::vector<Box> liquid;     // none or one; its upper face is the free surface
};

// Looks along `forward`; right, up and forward are orthonormal. The picture's centre shows `target`.
struct Camera {
  Vec3 right, up, forward, target;
  double width = 1;         // um across the picture in the plane through target
  double eye_distance = 0;  // um from the eye to target; 0: parallel rays (orthographic)

  static Camera side();                                               // along +y, z up
  static Camera top();                                                // along -z, y up
  static Camera oblique(double azimuth = 32, double elevation = 24);  // degrees
  // Centres and scales so that both corners' box fits a picture of this shape, with a margin (fraction of the
  // picture).
  void frame(const Box&, int width_pixels, int height_pixels, double margin = 0.03);
  // Pixel coordinates (from the left, from the top) of a point.
  std::pair<double, double> project(const Vec3&, int width_pixels, int height_pixels) const;
};

struct RenderSettings {
  int width = 1200, height = 900;  // pixels
  int samples = 3;                 // rays a pixel and direction
  bool shading = true;             // off: flat colours, for masks and tests
  Colour background_top = from_srgb(255, 255, 255), background_bottom = from_srgb(238, 241, 245);
};

Image render(const SphereScene&, const Camera&, const RenderSettings&);

}  // namespace pigment::report
