#include "report/identification/modal_files.hpp"

#include <gtest/gtest.h>

#include "common/problem.hpp"
#include "tests/support/paths.hpp"
#include "tests/support/scratch_folder.hpp"

namespace levitas::report {
namespace {

TEST(RigFileOfAnIdentification, ReadsAsTheRigThatWasWritten) {
  const levitas::test::ScratchFolder folder;
  const configuration::RigFile rig =
      configuration::LoadRig(levitas::test::SourceFolder() + "/config/rigs/flexible_rotor.yaml");
  WriteRigFile(folder / "rig.yaml", rig);
  const configuration::RigFile again = configuration::LoadRig(folder / "rig.yaml");
  EXPECT_EQ(again.numbers.channels, rig.numbers.channels);
  EXPECT_EQ(configuration::WriteRig(again), configuration::WriteRig(rig));
}

TEST(RigFileOfAnIdentification, RefusesAFolderThatIsNotThere) {
  const levitas::test::ScratchFolder folder;
  EXPECT_THROW(WriteRigFile(folder / "nowhere/rig.yaml", {}), BadInput);
}

}  // namespace
}  // namespace levitas::report
