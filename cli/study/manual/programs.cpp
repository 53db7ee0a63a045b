#include "cli/study/manual/programs.hpp"

#include <CLI/CLI.hpp>

#include "programs/controller/controller_options.hpp"
#include "programs/plant/plant_options.hpp"

namespace levitas::cli {
namespace {

ProgramText ControllerPage() {
  CLI::App app{controller_program::kDescription, controller_program::kName};
  controller_program::ControllerOptions options;
  controller_program::AddOptions(app, options);
  return {
      TreeOf(app),
      "Waits for sensor frames of a rig on its port, closes the loop and lands the rotor in the "
      "end. The first SIGINT or SIGTERM lands it, the second ends the program. amb run starts it "
      "beside a simulated rig; by itself it is for a rig of one's own.",
      "0 the rotor was landed at the end of the scenario, of the duration or at a stop; 2 usage; "
      "3 bad input file; 4 there was a trip; 1 other, such as a rig that is silent.",
      {{"share/levitas/rigs, controllers, scenarios", "Shipped files, found by their names"},
       {"trip-TIME-FAULT.lcmlog", "In --trip-folder: the 0.5 s before and after a trip"}}};
}

ProgramText RigPage(const plant_run::PlantProgram& program, const std::string& about) {
  CLI::App app{program.description, program.name};
  plant_run::PlantOptions options;
  plant_run::AddOptions(app, program, options);
  return {
      TreeOf(app),
      about +
          " The first SIGINT or SIGTERM waits while a controller holds the rotor, the second "
          "ends the program.",
      "0 the controller said goodbye, or a signal ended it; 2 usage; 3 bad input file; 1 other: no "
      "controller came, or real time was required and is refused.",
      {{"share/levitas/rigs, scenarios", "Shipped files, found by their names"}}};
}

ProgramText StudyPage() {
  CommandText line;
  line.name = "amb-study";
  line.path = line.name;
  line.meaning = "Every command of amb, those of identification, design and diagnosis included";
  return {
      line,
      "amb starts it for import, simulate, effects, identify, design, balance, diagnose, bench and "
      "manual; it lies beside amb and is of the same build, or refuses to answer. Its command line "
      "is that of amb(1).",
      "As amb(1).",
      {}};
}

}  // namespace

std::vector<ProgramText> OtherPrograms() {
  return {
      ControllerPage(),
      RigPage(plant_run::kAmbPlant,
              "The nonlinear model of a rig, stepped once for each current frame of a controller."),
      RigPage(plant_run::kAmbRig,
              "The nonlinear model of a rig, behind the CAN buses and lines of its file."),
      StudyPage()};
}

}  // namespace levitas::cli
