#include "plant_sim/rotor/beam_element.hpp"

#include <cmath>
#include <numbers>

namespace levitas::rotor {
namespace {

// Every matrix of the element has this pattern: six numbers, see (4)-(6).
struct Pattern {
  double d;   // deflection on itself
  double ds;  // deflection on its slope
  double ss;  // slope on itself
  double f;   // deflection on the far deflection
  double fs;  // deflection on the far slope
  double sf;  // slope on the far slope
};

Eigen::Matrix4d Fill(const Pattern& p) {
  Eigen::Matrix4d m;
  m << p.d, p.ds, p.f, p.fs,    //
      p.ds, p.ss, -p.fs, p.sf,  //
      p.f, -p.fs, p.d, -p.ds,   //
      p.fs, p.sf, -p.ds, p.ss;  //
  return m;
}

}  // namespace

double CrossSectionM2(const Section& piece) {
  const double outer = piece.outer_diameter_m;
  const double inner = piece.inner_diameter_m;
  return std::numbers::pi / 4.0 * (outer * outer - inner * inner);
}

BeamElement MakeBeamElement(const Material& material, const Section& piece) {
  const double l = piece.length_m;
  const double area = CrossSectionM2(piece);
  const double second_moment =
      std::numbers::pi / 64.0 *
      (std::pow(piece.outer_diameter_m, 4) - std::pow(piece.inner_diameter_m, 4));
  const double v = material.poisson;
  const double shear_pa = material.young_pa / (2.0 * (1.0 + v));
  const double kappa = 6.0 * (1.0 + v) / (7.0 + 6.0 * v);
  const double bending = material.young_pa * second_moment;
  const double phi = 12.0 * bending / (kappa * shear_pa * area * l * l);  // (2)
  const double square = (1.0 + phi) * (1.0 + phi);

  // Translation, (4).
  const double mt = material.density_kg_per_m3 * area * l / square;
  const Pattern translation{mt * (13.0 / 35.0 + 7.0 * phi / 10.0 + phi * phi / 3.0),
                            mt * l * (11.0 / 210.0 + 11.0 * phi / 120.0 + phi * phi / 24.0),
                            mt * l * l * (1.0 / 105.0 + phi / 60.0 + phi * phi / 120.0),
                            mt * (9.0 / 70.0 + 3.0 * phi / 10.0 + phi * phi / 6.0),
                            -mt * l * (13.0 / 420.0 + 3.0 * phi / 40.0 + phi * phi / 24.0),
                            -mt * l * l * (1.0 / 140.0 + phi / 60.0 + phi * phi / 120.0)};

  // Rotation of the section, (5): diametral inertia per length is rho I, polar is twice that.
  const double mr = material.density_kg_per_m3 * second_moment / (l * square);
  const Pattern rotation{mr * 6.0 / 5.0,
                         mr * l * (1.0 / 10.0 - phi / 2.0),
                         mr * l * l * (2.0 / 15.0 + phi / 6.0 + phi * phi / 3.0),
                         -mr * 6.0 / 5.0,
                         mr * l * (1.0 / 10.0 - phi / 2.0),
                         mr * l * l * (-1.0 / 30.0 - phi / 6.0 + phi * phi / 6.0)};

  // Bending and shear, (6).
  const double k = bending / (l * l * l * (1.0 + phi));
  const Pattern elastic{12.0 * k,  6.0 * l * k, (4.0 + phi) * l * l * k,
                        -12.0 * k, 6.0 * l * k, (2.0 - phi) * l * l * k};

  BeamElement element;
  element.mass = Fill(translation) + Fill(rotation);
  element.gyroscopic = 2.0 * Fill(rotation);
  element.stiffness = Fill(elastic);
  return element;
}

}  // namespace levitas::rotor
