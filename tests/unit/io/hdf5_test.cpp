// SPDX-License-Identifier: MIT
#include "sphmbs/io/hdf5.hpp"

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <limits>
#include <random>
#include <string>
#include <thread>
#include <vector>

#include "sphmbs/core/error.hpp"
#include "support/catch.hpp"
#include "support/errors.hpp"

using namespace sphmbs;
using io::Hdf5Part;
using io::Hdf5Series;
using io::PointArray;
using io::detail::Hdf5Handle;

namespace {

struct Directory {
  std::filesystem::path path = std::filesystem::temp_directory_path() /
                               ("sphmbs_hdf5_" + std::to_string(std::random_device{}()));
  Directory() { std::filesystem::create_directories(path); }
  ~Directory() { std::filesystem::remove_all(path); }
  Directory(const Directory&) = delete;
  Directory& operator=(const Directory&) = delete;
};

// Reads as docs/hdf5.md says: along with the writer, or after it.
struct Reader {
  explicit Reader(const std::filesystem::path& path)
      : file(H5Fopen(path.string().c_str(), H5F_ACC_RDONLY | H5F_ACC_SWMR_READ, H5P_DEFAULT),
             H5Fclose) {}

  bool open() const { return file >= 0; }

  std::vector<hsize_t> extent(const std::string& name) const {
    const Hdf5Handle set(H5Dopen2(file, name.c_str(), H5P_DEFAULT), H5Dclose);
    const Hdf5Handle space(H5Dget_space(set), H5Sclose);
    std::vector<hsize_t> sizes(static_cast<std::size_t>(H5Sget_simple_extent_ndims(space)));
    H5Sget_simple_extent_dims(space, sizes.data(), nullptr);
    return sizes;
  }

  // Rows of a data set; empty where HDF5 refuses to read them.
  template <class T>
  std::vector<T> rows(const std::string& name, hsize_t first, hsize_t count) const {
    const Hdf5Handle set(H5Dopen2(file, name.c_str(), H5P_DEFAULT), H5Dclose);
    const Hdf5Handle space(H5Dget_space(set), H5Sclose);
    std::vector<hsize_t> size = extent(name), begin(size.size(), 0);
    hsize_t values = 1;
    size[0] = count;
    begin[0] = first;
    for (const hsize_t s : size) values *= s;
    H5Sselect_hyperslab(space, H5S_SELECT_SET, begin.data(), nullptr, size.data(), nullptr);
    const Hdf5Handle memory(H5Screate_simple(static_cast<int>(size.size()), size.data(), nullptr),
                            H5Sclose);
    std::vector<T> read(values);
    if (H5Dread(set, io::detail::hdf5_type<T>(), memory, space, H5P_DEFAULT, read.data()) < 0)
      read.clear();
    return read;
  }

  std::size_t frames() const { return extent("time")[0]; }

  template <class T>
  std::vector<T> frame(const std::string& part, const std::string& name, std::size_t k) const {
    const auto range = rows<std::uint64_t>(part + "/rows", k, 1);
    return rows<T>(part + "/" + name, range.at(0), range.at(1) - range.at(0));
  }

  std::string attribute(const std::string& object, const char* name) const {
    const Hdf5Handle attribute(
        H5Aopen_by_name(file, object.c_str(), name, H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
    const Hdf5Handle type(H5Aget_type(attribute), H5Tclose);
    char* text = nullptr;
    if (H5Aread(attribute, type, &text) < 0 || text == nullptr) return "no attribute";
    std::string copy = text;
    H5free_memory(text);
    return copy;
  }

  Hdf5Handle file;
};

// Frame k of gas that flies apart: every value tells its frame.
struct Frame {
  explicit Frame(int k, std::size_t n = 50)
      : points(3 * n, 0.5 + k),
        arrays{{"pressure [Pa]", 1, std::vector<double>(n, 1e5 + k)},
               {"velocity [m/s]", 3, std::vector<float>(3 * n, static_cast<float>(k))}} {}
  std::array<Hdf5Part, 1> parts() const { return {{{"gas", points, arrays}}}; }

  std::vector<double> points;
  std::vector<PointArray> arrays;
};

// The number of frames that can be read, -1 where the file or one of its frames cannot.
int good_frames(const std::filesystem::path& path) {
  const io::detail::Hdf5Quiet quiet;
  const Reader reader(path);
  if (!reader.open()) return -1;
  const int frames = static_cast<int>(reader.frames());
  for (int k = 0; k < frames; ++k) {
    const auto number = static_cast<std::size_t>(k);
    const std::vector<double> p = reader.frame<double>("gas", "pressure", number);
    const std::vector<float> v = reader.frame<float>("gas", "velocity", number);
    const bool good = reader.rows<double>("time", number, 1) == std::vector<double>{0.1 * k} &&
                      !p.empty() && p == std::vector<double>(p.size(), 1e5 + k) &&
                      v == std::vector<float>(3 * p.size(), static_cast<float>(k));
    if (!good) return -1;
  }
  return frames;
}

}  // namespace

TEST_CASE("an HDF5 series holds frames of several parts bit for bit", "[io]") {
  const Directory directory;
  const std::filesystem::path path = directory.path / "run.h5";
  Hdf5Series series(path, "two parts");
  const std::vector<double> points{0.1, -0.0, 1e-310, 3.0, 1e300, 2.0};
  const std::vector<double> pressure{101325.0, std::numeric_limits<double>::infinity()};
  const std::vector<float> velocity{1.0F, 2.0F, 0.0F, -3.5F, 4.0F, 0.0F};
  const std::vector<std::int32_t> id{-1, std::numeric_limits<std::int32_t>::max()};
  const std::vector<std::uint8_t> set{0, 255};
  const std::vector<PointArray> of_gas{{"pressure [Pa]", 1, pressure},
                                       {"velocity [m/s]", 3, velocity},
                                       {"id", 1, id},
                                       {"set", 1, set}};
  const std::vector<double> node{7.0, 8.0, 9.0};
  const std::vector<PointArray> of_bodies{{"axial strain [-]", 1, std::vector<float>{0.25F}}};
  const std::vector<Hdf5Part> first{{"gas", points, of_gas}, {"bodies", node, of_bodies}};
  series.add(0.1, first);
  // 40 000 particles take three chunks; then there are none, then two again.
  const std::size_t many = 40000;
  std::vector<double> places(3 * many);
  for (std::size_t i = 0; i < places.size(); ++i) places[i] = 0.5 * static_cast<double>(i);
  const std::vector<PointArray> of_many{{"pressure [Pa]", 1, std::vector<double>(many, 2.0)},
                                        {"velocity [m/s]", 3, std::vector<float>(3 * many, 3.0F)},
                                        {"id", 1, std::vector<std::int32_t>(many, 4)},
                                        {"set", 1, std::vector<std::uint8_t>(many, 5)}};
  const std::vector<PointArray> of_none{{"pressure [Pa]", 1, std::vector<double>{}},
                                        {"velocity [m/s]", 3, std::vector<float>{}},
                                        {"id", 1, std::vector<std::int32_t>{}},
                                        {"set", 1, std::vector<std::uint8_t>{}}};
  series.add(0.2, std::vector<Hdf5Part>{{"gas", places, of_many}, {"bodies", node, of_bodies}});
  series.add(0.3, std::vector<Hdf5Part>{{"gas", {}, of_none}, {"bodies", node, of_bodies}});
  series.add(0.4, first);
  CHECK(series.size() == 4);

  // While it is open for writing, and afterwards.
  for (const bool closed : {false, true}) {
    if (closed) series.close();
    const Reader reader(path);
    REQUIRE(reader.open());
    REQUIRE(reader.frames() == 4);
    CHECK(reader.rows<double>("time", 0, 4) == std::vector<double>{0.1, 0.2, 0.3, 0.4});
    for (const std::size_t k : {0u, 3u}) {
      const std::vector<double> read = reader.frame<double>("gas", "position", k);
      REQUIRE(read.size() == points.size());
      CHECK(std::memcmp(read.data(), points.data(), sizeof(double) * points.size()) == 0);
      CHECK(reader.frame<double>("gas", "pressure", k) == pressure);
      CHECK(reader.frame<float>("gas", "velocity", k) == velocity);
      CHECK(reader.frame<std::int32_t>("gas", "id", k) == id);
      CHECK(reader.frame<std::uint8_t>("gas", "set", k) == set);
    }
    CHECK(reader.frame<double>("gas", "position", 1) == places);
    CHECK(reader.frame<std::uint8_t>("gas", "set", 1) == std::vector<std::uint8_t>(many, 5));
    CHECK(reader.frame<double>("gas", "position", 2).empty());
    CHECK(reader.frame<double>("bodies", "position", 2) == node);
    CHECK(reader.frame<float>("bodies", "axial strain", 3) == std::vector<float>{0.25F});
  }
}

TEST_CASE("an HDF5 series names case, version and units, and checks all its data", "[io]") {
  const Directory directory;
  const std::filesystem::path path = directory.path / "run.h5";
  {
    Hdf5Series series(path, "sealed cavity, \u00bd bar");
    series.add(0, Frame(0).parts());
  }
  const Reader reader(path);
  CHECK(reader.attribute("/", "program") == "sphmbs");
  CHECK(reader.attribute("/", "version") == sphmbs::version);
  CHECK(reader.attribute("/", "case") == "sealed cavity, \u00bd bar");
  CHECK(reader.attribute("time", "unit") == "s");
  CHECK(reader.attribute("gas/position", "unit") == "m");
  CHECK(reader.attribute("gas/pressure", "unit") == "Pa");
  CHECK(reader.attribute("gas/velocity", "unit") == "m/s");
  for (const char* name : {"time", "gas/rows", "gas/position", "gas/pressure", "gas/velocity"}) {
    const Hdf5Handle set(H5Dopen2(reader.file, name, H5P_DEFAULT), H5Dclose);
    const Hdf5Handle properties(H5Dget_create_plist(set), H5Pclose);
    CHECK(H5Pall_filters_avail(properties) > 0);
    REQUIRE(H5Pget_nfilters(properties) == 1);
    unsigned flags = 0;
    std::size_t values = 0;
    CHECK(H5Pget_filter2(properties, 0, &flags, &values, nullptr, 0, nullptr, nullptr) ==
          H5Z_FILTER_FLETCHER32);
  }
}

TEST_CASE("a damaged number in an HDF5 series is not read", "[io]") {
  const Directory directory;
  const std::filesystem::path path = directory.path / "run.h5";
  {
    Hdf5Series series(path, "damaged");
    for (int k = 0; k < 3; ++k) series.add(0.1 * k, Frame(k).parts());
  }
  REQUIRE(good_frames(path) == 3);
  const double wanted = 1e5 + 1;
  std::fstream file(path, std::ios::in | std::ios::out | std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(file), {}};
  const std::size_t at = bytes.find(std::string(reinterpret_cast<const char*>(&wanted), 8));
  REQUIRE(at != std::string::npos);
  file.seekp(static_cast<std::streamoff>(at));
  file.put(static_cast<char>(bytes[at] ^ 1));
  file.close();
  const io::detail::Hdf5Quiet quiet;
  const Reader reader(path);
  CHECK(reader.frame<double>("gas", "pressure", 0).size() == 50);
  CHECK(reader.frame<double>("gas", "pressure", 1).empty());
  CHECK(reader.frame<double>("gas", "pressure", 2).size() == 50);
}

TEST_CASE("an HDF5 series refuses frames that do not fit", "[io]") {
  const Directory directory;
  const std::filesystem::path path = directory.path / "run.h5";
  Hdf5Series series(path, "misfits");
  const Frame good(0);
  const auto refused = [&](double time, const std::vector<Hdf5Part>& parts,
                           std::initializer_list<const char*> words) {
    try {
      series.add(time, parts);
    } catch (const InvalidInput& error) {
      CHECK(error.id == "E522");
      INFO(error.what());
      CHECK(test::mentions(error.what(), words));
      CHECK(test::mentions(error.what(), {"frame 0", "run.h5"}));
      return;
    }
    FAIL("was accepted");
  };
  const std::vector<double>& points = good.points;
  const std::vector<PointArray> short_array{{"p [Pa]", 1, std::vector<double>(49)}},
      no_components{{"p [Pa]", 0, std::vector<double>{}}},
      twice{{"p [Pa]", 1, std::vector<double>(50)}, {"p", 1, std::vector<double>(50)}},
      slash{{"p [m/s] of", 1, std::vector<double>(50)}},
      taken{{"position [m]", 1, std::vector<double>(50)}};
  refused(std::nan(""), {{"gas", points, good.arrays}}, {"time is not finite"});
  refused(0, {{"gas", std::span(points).first(4), {}}}, {"4 coordinates of part \"gas\""});
  refused(0, {{"gas", points, short_array}}, {"49 values of \"p [Pa]\"", "must be 50"});
  refused(0, {{"gas", points, no_components}}, {"0 values", "0 for each point"});
  refused(0, {{"gas", points, twice}}, {"two \"p\""});
  refused(0, {{"gas", points, taken}}, {"two \"position\""});
  refused(0, {{"gas", points, {}}, {"gas", points, {}}}, {"two \"gas\""});
  refused(0, {{"gas", points, slash}}, {"\"p [m/s] of\" cannot name"});
  refused(0, {{"", points, {}}}, {"\"\" cannot name"});
  refused(0, {{"time", points, {}}}, {"cannot be called \"time\""});

  CHECK_NOTHROW(series.add(0, good.parts()));
  std::vector<PointArray> other = good.arrays;
  other[0].values = std::vector<float>(50);
  for (const std::vector<Hdf5Part>& parts : {std::vector<Hdf5Part>{},
                                             {{"fluid", points, good.arrays}},
                                             {{"gas", points, other}},
                                             {{"gas", points, {}}}})
    CHECK(test::refusal([&] { series.add(0.1, parts); }).find("not those of the first frame") !=
          std::string::npos);
  CHECK_NOTHROW(series.add(0.1, Frame(1).parts()));
  CHECK(series.size() == 2);
  series.close();
  CHECK(good_frames(path) == 2);
}

TEST_CASE("an HDF5 series says why a file cannot be created", "[io]") {
  const Directory directory;
  const std::filesystem::path path = directory.path / "missing" / "run.h5";
  try {
    Hdf5Series(path, "nowhere");
    FAIL("was created");
  } catch (const OutputError& error) {
    CHECK(error.id == "E520");
    CHECK(test::mentions(error.what(), {path.c_str(), "No such file or directory"}));
  }
}

TEST_CASE("an HDF5 series refuses a file that another one writes", "[io]") {
  const Directory directory;
  const std::filesystem::path path = directory.path / "run.h5";
  Hdf5Series series(path, "first");
  series.add(0, Frame(0).parts());
  try {
    Hdf5Series(path, "second");
    FAIL("was created");
  } catch (const OutputError& error) {
    CHECK(error.id == "E520");
    CHECK(test::mentions(error.what(), {path.c_str(), "already open"}));
  }
  series.add(0.1, Frame(1).parts());
  series.close();
  CHECK(good_frames(path) == 2);
}

TEST_CASE("a full disk ends an HDF5 series, whose frames are kept", "[io]") {
  const Directory directory;
  const std::filesystem::path path = directory.path / "run.h5";
  // In a process of its own: a limit on the size of files holds for all that it does.
  const pid_t writer = fork();
  REQUIRE(writer >= 0);
  if (writer == 0) {
    std::signal(SIGXFSZ, SIG_IGN);
    const rlimit limit{2000000, 2000000};
    setrlimit(RLIMIT_FSIZE, &limit);
    int code = 1;
    try {
      Hdf5Series series(path, "full disk");
      for (int k = 0; k < 1000; ++k) series.add(0.1 * k, Frame(k).parts());
    } catch (const OutputError& error) {
      const bool said = test::mentions(error.what(), {"run.h5", "File too large"});
      code = error.id == "E521" && said ? 0 : 2;
    }
    std::exit(code);  // where HDF5 crashes if it could not write
  }
  int status = 0;
  waitpid(writer, &status, 0);
  CHECK(WIFEXITED(status));
  CHECK(WEXITSTATUS(status) == 0);
  CHECK(good_frames(path) > 10);
}

TEST_CASE("a killed program leaves the frames of its HDF5 series", "[io]") {
  const char* const more = std::getenv("SPHMBS_TEST_KILLS");
  const int kills = more ? std::atoi(more) : 20;
  std::minstd_rand random(1);
  int unreadable = 0, lost = 0, total = 0;
  for (int kill_number = 0; kill_number < kills; ++kill_number) {
    const Directory directory;
    const std::filesystem::path path = directory.path / "run.h5";
    int done[2];
    REQUIRE(pipe(done) == 0);
    const pid_t writer = fork();
    REQUIRE(writer >= 0);
    if (writer == 0) {
      Hdf5Series series(path, "killed");
      for (int k = 0; k < 100000; ++k) {
        series.add(0.1 * k, Frame(k, 500 + static_cast<std::size_t>(k) % 700).parts());
        if (write(done[1], "", 1) != 1) break;
      }
      _exit(0);
    }
    close(done[1]);
    char byte;
    int finished = 0;
    if (read(done[0], &byte, 1) == 1) ++finished;
    std::this_thread::sleep_for(std::chrono::microseconds(random() % 60000));
    kill(writer, SIGKILL);
    waitpid(writer, nullptr, 0);
    while (read(done[0], &byte, 1) == 1) ++finished;
    close(done[0]);
    const int frames = good_frames(path);
    if (frames < 0) ++unreadable;
    if (frames >= 0 && frames < finished) ++lost;
    total += finished;
  }
  INFO(total << " frames in " << kills << " files");
  CHECK(unreadable == 0);
  CHECK(lost == 0);
  CHECK(total > 5 * kills);
}
