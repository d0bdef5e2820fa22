// SPDX-License-Identifier: MIT
#include "support/view_script.hpp"

#include <cerrno>
#include <fstream>
#include <string_view>
#include <system_error>

#include <nlohmann/json.hpp>

#include <sphmbs/core/error.hpp>

namespace sphmbs::examples {
namespace {

constexpr std::string_view head = R"py(# A scene for ParaView 5.10 or newer.
#   paraview:              File > Load State..., this file
#   pvbatch view.py --png out.png [--time 0.5] [--field "density [kg/m3]"]
#   python3 view.py --check       are all files and arrays there? Needs no ParaView.
import argparse
import json
import os
import re
import sys
import xml.etree.ElementTree as xml

try:
    FOLDER = os.path.dirname(os.path.abspath(__file__))
except NameError:  # some versions load states without telling where they are
)py";

constexpr std::string_view body = R"py(

def options():
    parser = argparse.ArgumentParser(description=SCENE["title"])
    parser.add_argument("--png", help="render into this file")
    parser.add_argument("--time", type=float, help="show this time [s]; else the last one")
    parser.add_argument("--field", help="array that colours particles")
    parser.add_argument("--size", type=int, nargs=2, default=[1600, 1000], help="in pixels")
    parser.add_argument("--all", action="store_true", help="show virtual particles too")
    parser.add_argument("--check", action="store_true", help="look for files and arrays only")
    # ParaView itself may have options that are none of this script's.
    return parser.parse_known_args(sys.argv[1:])[0]


def series():
    """Files of each part, and the times of the collection."""
    files, times = {}, []
    for entry in xml.parse(os.path.join(FOLDER, SCENE["collection"])).iter("DataSet"):
        path = os.path.join(FOLDER, entry.get("file"))
        files.setdefault(int(entry.get("part", "0")), []).append(path)
        time = float(entry.get("timestep"))
        if time not in times:
            times.append(time)
    if not times:
        sys.exit("error: " + SCENE["collection"] + " lists no files yet")
    return files, times


def arrays(path):
    """Names of the point arrays of a .vtp file, with their numbers of components."""
    with open(path, "rb") as file:
        text = file.read(65536).split(b"<AppendedData")[0].decode()
    found = re.search(r"<PointData>(.*?)</PointData>", text, re.S).group(1)
    elements = xml.fromstring("<all>" + found + "</all>")
    return {a.get("Name"): int(a.get("NumberOfComponents")) for a in elements}


def coloured(layer, given, path):
    """The array that colours a layer and whether it is a vector."""
    name = given.field if given.field and layer["particles"] else layer["array"]
    known = arrays(path)
    if name not in known:
        sys.exit("error: no array \"" + name + "\" in " + path + ", which has " +
                 ", ".join(known))
    return name, known[name] > 1


def check(given):
    files, times = series()
    for layer in SCENE["layers"]:
        for path in files[layer["part"]]:
            coloured(layer, given, path)
            if layer["particles"] and "set" not in arrays(path):
                sys.exit("error: no array \"set\" in " + path)
    print(len(times), "times, all files and arrays are there")


def show(given):
    from paraview.simple import (AnnotateTimeFilter, ColorBy, GetActiveViewOrCreate,
                                 GetAnimationScene, Render, ResetCamera, SaveScreenshot, Show,
                                 Threshold, XMLPolyDataReader)
    files, times = series()
    view = GetActiveViewOrCreate("RenderView")
    view.ViewSize = given.size
    # The files themselves say their times.
    readers = {part: XMLPolyDataReader(FileName=paths) for part, paths in files.items()}
    scene = GetAnimationScene()
    scene.UpdateAnimationUsingDataTimeSteps()
    wanted = times[-1] if given.time is None else given.time
    scene.AnimationTime = min(times, key=lambda time: abs(time - wanted))

    for layer in SCENE["layers"]:
        source = readers[layer["part"]]
        if layer["particles"] and not given.all:
            source = Threshold(Input=source, Scalars=["POINTS", "set"])
            source.LowerThreshold = 0  # gas; virtual particles have a number
            source.UpperThreshold = 0
        display = Show(source, view)
        if layer["particles"]:
            display.SetRepresentationType("Point Gaussian")
            display.ShaderPreset = "Plain circle" if SCENE["dim"] == 2 else "Sphere"
            display.GaussianRadius = layer["radius"]
        else:
            display.SetRepresentationType("Surface")
            display.LineWidth = 3
        name, vector = coloured(layer, given, files[layer["part"]][-1])
        ColorBy(display, ("POINTS", name, "Magnitude") if vector else ("POINTS", name))
        display.RescaleTransferFunctionToDataRange(False, True)
        display.SetScalarBarVisibility(view, True)
    Show(AnnotateTimeFilter(Input=next(iter(readers.values()))), view)

    if SCENE["dim"] == 2:
        view.InteractionMode = "2D"
        view.CameraParallelProjection = 1
        view.CameraFocalPoint = [0, 0, 0]
        view.CameraPosition = [0, 0, 1]
        view.CameraViewUp = [0, 1, 0]
    else:
        view.CameraFocalPoint = [0, 0, 0]
        view.CameraPosition = [1, -2, 0.8]
        view.CameraViewUp = [0, 0, 1]
    ResetCamera(view)
    Render(view)
    if given.png:
        SaveScreenshot(given.png, view, ImageResolution=given.size)


given = options()
if given.check:
    check(given)
else:
    show(given)
)py";

}  // namespace

void write_view_script(const std::filesystem::path& folder, const ViewScene& scene) {
  nlohmann::ordered_json layers = nlohmann::ordered_json::array();
  for (const ViewLayer& layer : scene.layers)
    layers.push_back({{"part", layer.part},
                      {"particles", layer.particles},
                      {"array", layer.array},
                      {"radius", layer.radius}});
  const nlohmann::ordered_json json = {{"title", scene.title},
                                       {"collection", scene.collection},
                                       {"dim", scene.dim},
                                       {"layers", layers}};
  const nlohmann::json here = std::filesystem::absolute(folder).string();
  const std::filesystem::path path = folder / "view.py";
  std::ofstream file(path, std::ios::binary);
  file << head << "    FOLDER = " << here << "\n\nSCENE = json.loads(r\"\"\"" << json.dump(2)
       << "\"\"\")\n"
       << body;
  file.close();
  if (!file)
    throw OutputError("cannot write " + path.string() + ": " +
                      std::generic_category().message(errno));
}

}  // namespace sphmbs::examples
