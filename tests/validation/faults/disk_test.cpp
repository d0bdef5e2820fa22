// SPDX-License-Identifier: MIT
// Disks that are full, fail or go away, and memory that is not enough: never a damaged file under a
// final name, and the last good checkpoint stays.
#include <algorithm>
#include <cerrno>
#include <fstream>
#include <string>
#include <utility>
#include <vector>

#include "support/catch.hpp"
#include "support/process.hpp"
#include "support/program.hpp"
#include "support/results.hpp"

namespace {

namespace fs = std::filesystem;
using Words = std::vector<std::string>;

constexpr const char* program = SPHMBS_LAGRANGE_GUN;

struct Ended {
  int code;
  std::string log;
};

Ended run(const test::Scratch& scratch, const Words& more, const test::Surroundings& around = {}) {
  const fs::path log = scratch.path() / "log";
  fs::remove(log);
  Words words{"--until", "0.3", "--no-plots"};
  if (std::find(more.begin(), more.end(), "--spacing") == more.end())
    words.insert(words.end(), {"--spacing", "0.02"});
  words.insert(words.end(), more.begin(), more.end());
  test::Process process(program, words, log, around);
  const int code = process.wait();
  return {code, test::text_of(log)};
}

/// Every checkpoint that has its final name is one that a run goes on from.
void check_checkpoints(const test::Scratch& scratch, const fs::path& folder) {
  std::error_code none;
  for (const auto& entry : fs::directory_iterator(folder / "checkpoint", none)) {
    CHECK(entry.path().extension() == ".ckpt");
    const Ended ended =
        run(scratch, {"--output", folder.string(), "--resume", entry.path().string()});
    INFO(ended.log);
    CHECK(ended.code == 0);
  }
}

}  // namespace

TEST_CASE("no file may grow: the run ends with exit code 5 or goes on", "[fault]") {
  for (const rlim_t most : {1000, 5000, 20000}) {
    CAPTURE(most);
    const test::Scratch scratch;
    const fs::path folder = scratch.work() / "run";
    const Ended ended =
        run(scratch, {"--output", folder.string(), "--checkpoint-every", "1e-6", "--quiet"},
            {.file_size = most});
    INFO(ended.log);
    CHECK(ended.code == 5);
    CHECK_THAT(ended.log, Catch::Contains("error E5") && Catch::Contains(folder.string()) &&
                              Catch::Contains("File too large"));
    check_checkpoints(scratch, folder);
  }
}

TEST_CASE("the n-th call on a checkpoint fails: no effect, or the next one serves", "[fault]") {
  const test::Scratch scratch;
  const fs::path straight = scratch.work() / "straight";
  REQUIRE(run(scratch, {"--output", straight.string()}).code == 0);
  for (const int error : {0, EINTR, EIO})
    for (const int at : {1, 2, 3, 10, 500, 501, 502, 503, 504, 505, 506, 507, 508, 509, 510, 700}) {
      CAPTURE(error, at);
      const fs::path folder = scratch.work() / "run";
      fs::remove_all(folder);
      const Ended ended = run(scratch, {"--output", folder.string(), "--checkpoint-every", "1e-6"},
                              {.environment = {{"LD_PRELOAD", SPHMBS_FAILING_FILES},
                                               {"FAIL_IN", (folder / "checkpoint").string()},
                                               {"FAIL_AT", std::to_string(at)},
                                               {"FAIL_WITH", std::to_string(error)}}});
      INFO(ended.log);
      CHECK(ended.code == 0);  // one failure is a warning
      CHECK((ended.log.find("checkpoint not written") != std::string::npos) == (error == EIO));
      CHECK(test::differences(straight, folder) == "");
      for (const auto& entry : fs::directory_iterator(folder / "checkpoint"))
        CHECK(entry.path().extension() == ".ckpt");
    }
}

TEST_CASE("less room than the last checkpoint took is noticed before the next one is written",
          "[fault]") {
  const test::Scratch scratch;
  const fs::path folder = scratch.work() / "run";
  const Ended ended =
      run(scratch, {"--output", folder.string(), "--checkpoint-every", "1e-6"},
          {.environment = {{"LD_PRELOAD", SPHMBS_FAILING_FILES}, {"FAIL_ROOM", "1"}}});
  INFO(ended.log);
  CHECK(ended.code == 5);
  CHECK_THAT(ended.log, Catch::Contains("it needs about ") && Catch::Contains(" are free"));
  check_checkpoints(scratch, folder);
}

TEST_CASE("a failed write of any file of results is told of, or has no effect", "[fault]") {
  const test::Scratch scratch;
  const fs::path straight = scratch.work() / "straight", folder = scratch.work() / "run";
  REQUIRE(run(scratch, {"--output", straight.string()}).code == 0);
  int told = 0;
  for (const int error : {0, EINTR, EIO, ENOSPC})
    for (int at = 1; at <= 15; ++at) {
      CAPTURE(error, at);
      fs::remove_all(folder);
      const Ended ended = run(scratch, {"--output", folder.string()},
                              {.environment = {{"LD_PRELOAD", SPHMBS_FAILING_FILES},
                                               {"FAIL_IN", folder.string()},
                                               {"FAIL_CALL", "write"},
                                               {"FAIL_AT", std::to_string(at)},
                                               {"FAIL_WITH", std::to_string(error)}}});
      INFO(ended.log);
      const bool is_told = ended.log.find("not written") != std::string::npos;
      if (error == 0 || error == EINTR) CHECK(ended.code == 0);
      if (ended.code == 0 && !is_told) CHECK(test::differences(straight, folder) == "");
      if (ended.code != 0)
        CHECK((ended.code == 5 && ended.log.find("error E5") != std::string::npos));
      told += ended.code == 5 || is_told;
    }
  CHECK(told > 5);
}

TEST_CASE("no failure on the way to a checkpoint's name goes unnoticed", "[fault]") {
  struct Failure {
    const char* call;
    int at, error;
    const char* said = "";
  };
  const test::Scratch scratch;
  const fs::path straight = scratch.work() / "straight", folder = scratch.work() / "run";
  REQUIRE(run(scratch, {"--output", straight.string()}).code == 0);
  // Of fsync and close every second call is on the folder, whose close tells nothing. A byte that
  // the disk changes shows when the file is read again.
  for (const Failure& f : {Failure{"fsync", 1, EIO, ".ckpt: "},
                           {"fsync", 2, EIO},
                           {"fsync", 9, EIO},
                           {"close", 1, EIO},
                           {"close", 9, EIO},
                           {"rename", 1, EIO},
                           {"rename", 5, EIO},
                           {"write", 20, -1}}) {
    CAPTURE(f.call, f.at);
    fs::remove_all(folder);
    const Ended ended = run(scratch, {"--output", folder.string(), "--checkpoint-every", "1e-6"},
                            {.environment = {{"LD_PRELOAD", SPHMBS_FAILING_FILES},
                                             {"FAIL_IN", (folder / "checkpoint").string()},
                                             {"FAIL_CALL", f.call},
                                             {"FAIL_AT", std::to_string(f.at)},
                                             {"FAIL_WITH", std::to_string(f.error)}}});
    INFO(ended.log);
    CHECK(ended.code == 0);
    CHECK_THAT(ended.log, Catch::Contains("checkpoint not written") && Catch::Contains(f.said));
    CHECK(test::differences(straight, folder) == "");
    check_checkpoints(scratch, folder);
  }
}

TEST_CASE("a folder for checkpoints that goes away is told of, and ends the run in the end",
          "[fault]") {
  const test::Scratch scratch;
  const fs::path folder = scratch.work() / "run";
  fs::create_directories(folder);
  std::ofstream(folder / "checkpoint") << "a file, not a folder";
  const Ended ended =
      run(scratch, {"--output", folder.string(), "--overwrite", "--checkpoint-every", "1e-6"});
  INFO(ended.log);
  CHECK(ended.code == 5);
  CHECK_THAT(ended.log, Catch::Contains((folder / "checkpoint").string()));
}

TEST_CASE("a failed output of fields is a warning, the third in a row ends the run", "[fault]") {
  const test::Scratch scratch;
  const int blocked = GENERATE(1, 2, 3);
  CAPTURE(blocked);
  const fs::path folder = scratch.work() / "run";
  // Folders in place of files that are to be written.
  for (int k = 1; k <= blocked; ++k)
    fs::create_directories(folder / ("bodies_000" + std::to_string(k) + ".vtp") / "full");
  const Ended ended = run(scratch, {"--output", folder.string(), "--overwrite"});
  INFO(ended.log);
  CHECK(ended.code == (blocked < 3 ? 0 : 5));
  CHECK_THAT(ended.log, Catch::Contains("warning: fields not written: W500") &&
                            Catch::Contains("bodies_0001.vtp"));
  const std::string list = test::text_of(folder / "scene.pvd");
  CHECK(list.find("bodies_0000.vtp") != std::string::npos);
  CHECK(list.find("bodies_0001.vtp") == std::string::npos);
  CHECK((list.find("bodies_0003.vtp") != std::string::npos) == (blocked < 3));
  if (blocked < 3)
    CHECK_THAT(
        ended.log,
        Catch::Contains("warning   fields not written: " + std::to_string(blocked) + " time"));
}

TEST_CASE("tables are handed to the disk before the checkpoint that goes on from them", "[fault]") {
  const test::Scratch scratch;
  const fs::path folder = scratch.work() / "run";
  using Call = std::pair<const char*, const char*>;  // what comes first, but for renaming
  for (const auto& [file, call] : {Call{"history.csv", "1"}, Call{"fields_0000.vtp", "2"}}) {
    fs::remove_all(folder);
    const Ended ended = run(scratch, {"--output", folder.string(), "--checkpoint-every", "1e-6"},
                            {.environment = {{"LD_PRELOAD", SPHMBS_FAILING_FILES},
                                             {"FAIL_IN", (folder / file).string()},
                                             {"FAIL_AT", call},
                                             {"FAIL_WITH", std::to_string(EIO)}}});
    CAPTURE(file);
    INFO(ended.log);
    CHECK(ended.code == 0);
    CHECK_THAT(ended.log, Catch::Contains("warning: checkpoint not written") &&
                              Catch::Contains("cannot hand to the disk") && Catch::Contains(file));
  }
}

TEST_CASE("a directory that cannot be locked is told of, and the run goes on", "[fault]") {
  const test::Scratch scratch;
  const fs::path folder = scratch.work() / "run";
  const Ended ended = run(scratch, {"--output", folder.string()},
                          {.environment = {{"LD_PRELOAD", SPHMBS_FAILING_FILES},
                                           {"FAIL_FLOCK", std::to_string(ENOLCK)}}});
  INFO(ended.log);
  CHECK(ended.code == 0);
  CHECK_THAT(ended.log, Catch::Contains("warning: no lock: W033"));
}

TEST_CASE("a damaged checkpoint gives way to the one before, which is said", "[fault]") {
  const test::Scratch scratch;
  const fs::path folder = scratch.work() / "run", straight = scratch.work() / "straight";
  REQUIRE(run(scratch, {"--output", straight.string()}).code == 0);
  REQUIRE(run(scratch, {"--output", folder.string(), "--steps", "10"}).code == 0);
  REQUIRE(run(scratch, {"--output", folder.string(), "--steps", "20", "--resume"}).code == 0);
  const fs::path newest = folder / "checkpoint" / "step_00000000000000000020.ckpt";
  std::string bytes = test::text_of(newest);
  bytes[bytes.size() / 2] ^= 4;
  std::ofstream(newest, std::ios::binary) << bytes;
  const Ended named = run(scratch, {"--output", folder.string(), "--resume", newest.string()});
  CHECK(named.code == 4);
  CHECK_THAT(named.log, Catch::Contains("error E403") && Catch::Contains("checksum of section"));
  const Ended ended = run(scratch, {"--output", folder.string(), "--resume"});
  CHECK(ended.code == 0);
  CHECK_THAT(ended.log, Catch::Contains("checksum of section") && Catch::Contains("skipped") &&
                            Catch::Contains("step 10"));
  CHECK(test::differences(straight, folder) == "");
}

TEST_CASE("going on from an older checkpoint puts the newer ones aside", "[fault]") {
  const test::Scratch scratch;
  const fs::path folder = scratch.work() / "run";
  const auto go = [&](const Words& more) {
    Words words{"--output", folder.string()};
    words.insert(words.end(), more.begin(), more.end());
    const Ended ended = run(scratch, words);
    INFO(ended.log);
    REQUIRE(ended.code == 0);
    return ended.log;
  };
  go({"--steps", "10"});
  go({"--steps", "20", "--resume"});
  const fs::path older = folder / "checkpoint" / "step_00000000000000000010.ckpt";
  go({"--steps", "12", "--resume", older.string()});
  CHECK_THAT(go({"--resume"}), Catch::Contains("resumed") && Catch::Contains("step 12,"));
}

TEST_CASE("memory that is not enough ends a run with exit code 6", "[fault]") {
  const test::Scratch scratch;
  const fs::path folder = scratch.work() / "run";
  const Ended ended =
      run(scratch, {"--output", folder.string(), "--spacing", "1e-6"}, {.memory = rlim_t{1} << 29});
  INFO(ended.log);
  CHECK(ended.code == 6);
  CHECK_THAT(ended.log, Catch::Contains("memory"));
}
