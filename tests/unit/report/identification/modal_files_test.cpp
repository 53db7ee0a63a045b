#include "report/identification/modal_files.hpp"

#include <gtest/gtest.h>

#include "common/problem.hpp"
#include "tests/support/paths.hpp"
#include "tests/support/scratch_folder.hpp"

namespace levitas::cli {
namespace {

TEST(RigFileOfAnIdentification, ReadsAsTheRigThatWasWritten) {
  const levitas::test::ScratchFolder folder;
  const config::RigFile rig =
      config::LoadRig(levitas::test::SourceFolder() + "/config/rigs/flexible_rotor.yaml");
  WriteRigFile(folder / "rig.yaml", rig);
  const config::RigFile again = config::LoadRig(folder / "rig.yaml");
  EXPECT_EQ(again.numbers.channels, rig.numbers.channels);
  EXPECT_EQ(config::WriteRig(again), config::WriteRig(rig));
}

TEST(RigFileOfAnIdentification, RefusesAFolderThatIsNotThere) {
  const levitas::test::ScratchFolder folder;
  EXPECT_THROW(WriteRigFile(folder / "nowhere/rig.yaml", {}), BadInput);
}

}  // namespace
}  // namespace levitas::cli
