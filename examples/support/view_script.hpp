// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace sphmbs::examples {

/// One kind of thing in a scene: the files of one part of a collection.
struct ViewLayer {
  /// Which part of the collection, see io::PvdCollection::add.
  int part = 0;
  /// Particles, drawn as discs or balls; else lines and surfaces.
  bool particles = true;
  /// Array that decides on the colour, as it is called in the files; of vectors the magnitude.
  std::string array{};
  /// Of a particle [m].
  double radius = 0;
};

/// What view.py shows.
struct ViewScene {
  std::string title{};
  /// File of the collection, in the folder of the script.
  std::string collection{};
  /// 2: seen from above, in parallel projection; 3: in perspective.
  int dim = 3;
  std::vector<ViewLayer> layers{};
};

/// The scene of a gas, of a structure or of both, as sessions write them.
/// @param spacing  of the particles [m]
template <class System>
ViewScene view_of(System& system, std::string title, std::string collection, double spacing) {
  ViewScene scene{.title = std::move(title), .collection = std::move(collection)};
  constexpr bool coupled = requires { system.fluid(); };
  constexpr bool gas = coupled || requires { system.particles(); };
  scene.dim = System::dim < 3 ? 2 : 3;
  if constexpr (gas) scene.layers.push_back({.array = "pressure [Pa]", .radius = spacing / 2});
  if constexpr (!gas || coupled)
    scene.layers.push_back(
        {.part = coupled ? 1 : 0, .particles = false, .array = "velocity [m/s]"});
  return scene;
}

/// Writes view.py into a folder: a scene for ParaView 5.10 or newer, loaded by File > Load State,
/// or rendered by `pvbatch view.py --png out.png`. It reads the collection when it runs, so that it
/// may be written before the first files. `python3 view.py --check` tells without ParaView whether
/// all files and arrays are there.
/// @throws OutputError with path and reason.
void write_view_script(const std::filesystem::path& folder, const ViewScene& scene);

}  // namespace sphmbs::examples
