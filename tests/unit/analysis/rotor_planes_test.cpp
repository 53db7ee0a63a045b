#include "analysis/rotor_planes.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "plant_sim/rotor/finite_element.hpp"
#include "tests/support/test_rigs.hpp"

namespace levitas::analysis {
namespace {

TEST(RotorPlanes, AreThoseOfCoilsProbesAndUnbalanceOfTheRig) {
  plant::PlantConfig rig;
  rig.bearings.resize(2);
  rig.bearings[0].actuator_z_m = 0.1;
  rig.bearings[0].sensor_z_m = 0.2;
  rig.bearings[1].actuator_z_m = 0.5;
  rig.bearings[1].sensor_z_m = 0.4;
  rig.unbalance = {{0.3, 1e-6, 0.0}};
  EXPECT_THAT(PlanesOf(rig), ::testing::UnorderedElementsAre(0.1, 0.2, 0.3, 0.4, 0.5));
  EXPECT_TRUE(PlanesOf(plant::PlantConfig{}).empty());
}

TEST(RotorPlanes, AreNodesOfTheMeshThatIsMadeWithThem) {
  plant::PlantConfig rig = test::QuietFlexibleRotor();
  rig.bearings[0].sensor_z_m = 0.0512345;  // where no section or element ends by itself
  const auto mesh = rotor::Assemble(rig.rotor, PlanesOf(rig));
  for (const double plane_m : PlanesOf(rig)) {
    double nearest_m = 1.0;
    for (const double node_m : mesh.node_z_m) {
      nearest_m = std::min(nearest_m, std::abs(node_m - plane_m));
    }
    EXPECT_LE(nearest_m, 1e-9) << plane_m << ": nearer places are one to the mesh";
  }
}

}  // namespace
}  // namespace levitas::analysis
