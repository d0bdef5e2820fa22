// SPDX-License-Identifier: MIT
// A run that is killed, asked to end or left alone by its terminal goes on later as if nothing had
// been, and asking twice ends it at once.
#include <chrono>
#include <csignal>
#include <fstream>
#include <random>
#include <string>
#include <vector>

#include <sys/stat.h>

#include <sphmbs/io/checkpoint_file.hpp>

#include "support/catch.hpp"
#include "support/process.hpp"
#include "support/program.hpp"
#include "support/results.hpp"

namespace {

namespace fs = std::filesystem;
using Words = std::vector<std::string>;

/// Gas and a body, about a second in a Release build.
constexpr const char* program = SPHMBS_LAGRANGE_GUN;
const Words options{"--spacing", "0.002", "--until", "0.5", "--no-plots"};

class Runs {
 public:
  Runs() {
    const test::Ended ended = test::start(scratch_, program, with({"--output", "straight"}));
    INFO(ended.err);
    REQUIRE(ended.code == 0);
  }

  fs::path straight() const { return scratch_.work() / "straight"; }
  fs::path folder() const { return scratch_.work() / "run"; }
  std::string log() const { return test::text_of(scratch_.path() / "log"); }
  bool begun() const { return fs::exists(folder() / "history.csv"); }

  test::Process start(const Words& more = {}, const test::Surroundings& surroundings = {}) {
    return {program, with({"--output", folder().string()}, more), scratch_.path() / "log",
            surroundings};
  }

  /// Goes on to the end, from the beginning where nothing was saved.
  void finish() {
    std::error_code none;
    bool saved = false;
    for (const auto& entry : fs::directory_iterator(folder() / "checkpoint", none))
      saved = saved || entry.path().extension() == ".ckpt";
    test::Process last = start({saved ? "--resume" : "--overwrite"});
    const int code = last.wait();
    INFO(log());
    REQUIRE(code == 0);
    CHECK(test::differences(straight(), folder()) == "");
  }

  /// What has its final name is whole.
  void check_names() const {
    std::error_code none;
    for (const auto& entry : fs::directory_iterator(folder() / "checkpoint", none))
      if (entry.path().extension() == ".ckpt")
        CHECK_NOTHROW(sphmbs::io::CheckpointFile(entry.path()));
  }

  void clear() {
    fs::remove_all(folder());
    fs::remove(scratch_.path() / "log");
  }

 private:
  static Words with(const Words& a, const Words& b = {}) {
    Words words = options;
    words.insert(words.end(), a.begin(), a.end());
    words.insert(words.end(), b.begin(), b.end());
    return words;
  }
  test::Scratch scratch_;
};

void sleep(double seconds) { std::this_thread::sleep_for(std::chrono::duration<double>(seconds)); }

}  // namespace

TEST_CASE("killed at any time, a run goes on from a checkpoint that is whole", "[fault]") {
  Runs runs;
  std::mt19937 random(5);
  for (int trial = 0; trial < 100; ++trial) {
    runs.clear();
    // Every step a checkpoint: most of the time goes into writing them.
    test::Process process = runs.start({"--checkpoint-every", "1e-6"});
    REQUIRE(test::wait_until([&] { return runs.begun(); }));
    sleep(1e-3 * static_cast<double>(random() % 300));
    process.signal(SIGKILL);
    CHECK(process.wait() == 128 + SIGKILL);
    runs.check_names();
    runs.finish();
  }
}

TEST_CASE("asked to end, a run saves its state within a step and says how to go on", "[fault]") {
  Runs runs;
  std::mt19937 random(6);
  for (int trial = 0; trial < 50; ++trial) {
    const int signal = std::array{SIGTERM, SIGINT, SIGHUP}[static_cast<std::size_t>(trial % 3)];
    runs.clear();
    test::Process process = runs.start();
    REQUIRE(test::wait_until([&] { return runs.begun(); }));
    sleep(1e-3 * static_cast<double>(random() % 200));
    process.signal(signal);
    const auto asked = std::chrono::steady_clock::now();
    CHECK(process.wait() == 128 + signal);
    CHECK(std::chrono::steady_clock::now() - asked < std::chrono::seconds(5));
    CHECK_THAT(runs.log(), Catch::Contains("used.toml --resume --output "));
    CHECK(fs::exists(runs.folder() / "summary.json"));
    runs.finish();
  }
}

TEST_CASE("asked to end twice, a run ends at once", "[fault]") {
  Runs runs;
  runs.clear();
  // The first SIGINT is noted while the disk takes its time, the second one ends that.
  test::Process process =
      runs.start({"--checkpoint-every", "1e-6"},
                 {.environment = {{"LD_PRELOAD", SPHMBS_FAILING_FILES},
                                  {"FAIL_IN", (runs.folder() / "checkpoint").string()},
                                  {"FAIL_AT", "300"},
                                  {"FAIL_WITH", "-2"}}});
  REQUIRE(test::wait_until([&] { return fs::exists(runs.folder() / "checkpoint"); }));
  sleep(1.0);
  process.signal(SIGINT);
  sleep(0.05);
  process.signal(SIGINT);
  const auto asked = std::chrono::steady_clock::now();
  CHECK(process.wait() == 128 + SIGINT);
  CHECK(std::chrono::steady_clock::now() - asked < std::chrono::seconds(2));
  runs.finish();
}

TEST_CASE("SIGUSR1 saves the state and the run goes on; so it does without a reader", "[fault]") {
  Runs runs;
  test::Process process = runs.start({}, {.output_gone = true});
  REQUIRE(test::wait_until([&] { return runs.begun(); }));
  process.signal(SIGUSR1);
  CHECK(test::wait_until([&] { return fs::exists(runs.folder() / "checkpoint"); }));
  CHECK(process.wait() == 0);
  runs.finish();
}

TEST_CASE("a sleep, a German user's locale, private files and odd names change no result",
          "[fault]") {
  Runs runs;
  const test::Scratch scratch;
  const fs::path folder = scratch.work() / "a run \u00fcber 'Nacht'";
  Words words = options;
  words.insert(words.end(), {"--output", folder.string()});
  const ::mode_t usual = ::umask(077);
  test::Process process(program, words, scratch.path() / "log",
                        {.environment = {{"LC_ALL", "de_DE.UTF-8"}, {"LANG", "de_DE.UTF-8"}}});
  ::umask(usual);
  CHECK(test::wait_until([&] { return fs::exists(folder / "history.csv"); }));
  process.signal(SIGSTOP);
  sleep(0.5);
  process.signal(SIGCONT);
  const int code = process.wait();
  INFO(test::text_of(scratch.path() / "log"));
  CHECK(code == 0);
  CHECK(test::differences(runs.straight(), folder) == "");
}

TEST_CASE("a file named stop and the time on the clock end a run with a checkpoint", "[fault]") {
  Runs runs;
  test::Process process = runs.start();
  REQUIRE(test::wait_until([&] { return runs.begun(); }));
  std::ofstream(runs.folder() / "stop") << "";
  CHECK(process.wait() == 0);
  CHECK_FALSE(fs::exists(runs.folder() / "stop"));
  test::Process second = runs.start({"--resume", "--walltime", "1e-3"});
  CHECK(second.wait() == 0);
  CHECK_THAT(runs.log(), Catch::Contains("stopped   by the file stop") &&
                             Catch::Contains("stopped   by the wall time of 0.001 s"));
  runs.finish();
}

TEST_CASE("a fixed step that is divided is ended before a run stops", "[fault]") {
  Runs runs;
  const Words long_steps{"--step", "2e-3"};  // of several parts
  test::Process straight = runs.start(long_steps);
  REQUIRE(straight.wait() == 0);
  fs::rename(runs.folder(), runs.folder().string() + "_long");
  for (const int wait : {0, 30, 100}) {
    runs.clear();
    test::Process process = runs.start(long_steps);
    REQUIRE(test::wait_until([&] { return runs.begun(); }));
    sleep(1e-3 * wait);
    process.signal(SIGTERM);
    CHECK(process.wait() == 128 + SIGTERM);
    CHECK_THAT(runs.log(), Catch::Contains("go on with ") && Catch::Contains(" --resume "));
    test::Process last = runs.start({"--step", "2e-3", "--resume"});
    const int code = last.wait();
    INFO(runs.log());
    CHECK(code == 0);
    CHECK(test::differences(runs.folder().string() + "_long", runs.folder()) == "");
  }
}

TEST_CASE("asked to end before its first step, a run ends at once and leaves nothing", "[fault]") {
  const test::Scratch scratch;
  const fs::path folder = scratch.work() / "run", log = scratch.path() / "log";
  const fs::path slow = scratch.work() / "slow.toml";  // a parameter file that nobody writes
  REQUIRE(::mkfifo(slow.c_str(), 0600) == 0);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    fs::remove(log);
    test::Process process(program, {slow.string(), "--output", folder.string()}, log);
    int end = -1;
    REQUIRE(test::wait_until([&] {
      end = ::open(slow.c_str(), O_WRONLY | O_NONBLOCK | O_CLOEXEC);
      return end >= 0;
    }));
    process.signal(signal);
    CHECK(process.wait() == 128 + signal);
    ::close(end);
    CHECK_THAT(test::text_of(log), Catch::Contains("stopped   before the first step"));
    CHECK_FALSE(fs::exists(folder));
  }
}
