// SPDX-License-Identifier: MIT
#include "support/view_script.hpp"

#include <array>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <string>
#include <utility>

#include "support/ball_in_gas.hpp"
#include "support/catch.hpp"
#include "support/coupled_session.hpp"
#include "support/rates.hpp"

namespace {

namespace examples = sphmbs::examples;
namespace fs = std::filesystem;

struct Directory {
  fs::path path =
      fs::temp_directory_path() / ("sphmbs_view_" + std::to_string(std::random_device{}()));
  Directory() { fs::create_directories(path); }
  ~Directory() { fs::remove_all(path); }
  Directory(const Directory&) = delete;
  Directory& operator=(const Directory&) = delete;
};

std::string quoted(const fs::path& path) { return "'" + path.string() + "'"; }

/// Exit code and output of a command.
std::pair<int, std::string> shell(const std::string& command) {
  std::string output;
  std::FILE* const pipe = ::popen((command + " 2>&1").c_str(), "r");
  REQUIRE(pipe != nullptr);
  std::array<char, 4096> buffer{};
  while (std::fgets(buffer.data(), buffer.size(), pipe) != nullptr) output += buffer.data();
  return {::pclose(pipe), output};
}

bool has_python() { return shell("python3 -c 1").first == 0; }

/// Stands in for ParaView's module: has the functions that the scene may use, and no others, and
/// prints what is called and set.
constexpr const char* stand_in = R"py(
class Proxy:
    def __init__(self, name):
        object.__setattr__(self, "name", name)
    def __setattr__(self, key, value):
        print(self.name + "." + key, "=", value)
    def __getattr__(self, key):
        return lambda *a, **k: print(self.name + "." + key, a, k)

def function(name):
    def call(*a, **k):
        print(name, [getattr(x, "name", x) for x in a],
              {key: getattr(x, "name", x) for key, x in k.items()})
        return Proxy(name)
    return call

for _name in ("AnnotateTimeFilter ColorBy GetActiveViewOrCreate GetAnimationScene Render ResetCamera "
              "SaveScreenshot Show Threshold XMLPolyDataReader").split():
    globals()[_name] = function(_name)
)py";

}  // namespace

TEST_CASE("view.py finds the files and arrays of a run", "[view]") {
  if (!has_python()) {
    WARN("no python3: not tested");
    return;
  }
  const Directory directory;
  test::BallInGas<test::Gas<2>> ball({});
  const auto scene = examples::view_of(ball.system, "a \"ball\" in gas", "scene.pvd", 0.1);
  examples::write_view_script(directory.path, scene);
  const std::string script = quoted(directory.path / "view.py");
  CHECK(shell("python3 -m py_compile " + script).first == 0);
  CHECK(shell("python3 " + script + " --check").first != 0);

  sphmbs::io::PvdCollection collection(directory.path / "scene.pvd");
  CHECK_THAT(shell("python3 " + script + " --check").second,
             Catch::Contains("scene.pvd lists no files yet"));
  examples::Display<decltype(ball.system)> display(ball.system);
  display.prepare();
  for (const char* number : {"0000", "0001"}) {
    int part = 0;
    for (const std::string& name : display.write(directory.path, "ball", number, true))
      collection.add(number[3] - '0' + 0.5, name, part++);
  }
  const auto good = shell("python3 " + script + " --check");
  CHECK(good.second == "2 times, all files and arrays are there\n");
  CHECK(good.first == 0);
  CHECK(shell("cd / && python3 " + script + " --check --field 'density [kg/m3]'").first == 0);
  const auto bad = shell("python3 " + script + " --check --field density");
  CHECK(bad.first != 0);
  CHECK_THAT(bad.second, Catch::Contains("no array \"density\""));
  CHECK_THAT(bad.second, Catch::Contains("pressure [Pa], smoothing length [m], set"));

  fs::create_directories(directory.path / "paraview");
  std::ofstream(directory.path / "paraview" / "__init__.py") << "";
  std::ofstream(directory.path / "paraview" / "simple.py") << stand_in;
  const auto shown = shell("PYTHONPATH=" + quoted(directory.path) + " python3 " + script +
                           " --png out.png --time 0.6");
  CAPTURE(shown.second);
  CHECK(shown.first == 0);
  for (const char* line :
       {"fields_0000.vtp', '", "bodies_0001.vtp']", "GetAnimationScene.AnimationTime = 0.5",
        "Threshold [] {'Input': 'XMLPolyDataReader', 'Scalars': ['POINTS', 'set']}",
        "ColorBy ['Show', ('POINTS', 'pressure [Pa]')]", "Show.GaussianRadius = 0.05",
        "ColorBy ['Show', ('POINTS', 'velocity [m/s]', 'Magnitude')]", "Plain circle",
        "GetActiveViewOrCreate.InteractionMode = 2D",
        "SaveScreenshot ['out.png', 'GetActiveViewOrCreate']"})
    CHECK_THAT(shown.second, Catch::Contains(line));
}

TEST_CASE("the scenes of a gas and of a structure alone", "[view]") {
  test::BallInGas<test::Gas<2>> ball({});
  const auto gas = examples::view_of(ball.fluid, "gas", "fields.pvd", 0.1);
  REQUIRE(gas.layers.size() == 1);
  CHECK(gas.layers[0].particles);
  CHECK(gas.layers[0].part == 0);
  const auto bodies = examples::view_of(ball.bodies, "bodies", "bodies.pvd", 0);
  REQUIRE(bodies.layers.size() == 1);
  CHECK(!bodies.layers[0].particles);
  CHECK(bodies.layers[0].part == 0);
  CHECK(bodies.dim == 2);
  CHECK_THROWS_AS(examples::write_view_script("/nowhere", bodies), sphmbs::OutputError);
}
