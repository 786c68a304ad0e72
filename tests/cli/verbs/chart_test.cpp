// Tests of the verb `chart`: it stops when told to, continues, and touches no folder that is not its own.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>

#include <chrono>
#include <thread>

#include "tests/cli/program.hpp"
#include "tests/support/tells.hpp"
#include "tests/support/temporary_folder.hpp"

namespace grainreel {
namespace {

namespace fs = std::filesystem;
using namespace test;
using testing::HasSubstr;

std::size_t lines_in(const fs::path& file) {
    std::ifstream in(file);
    std::string line;
    std::size_t count = 0;
    while (std::getline(in, line)) ++count;
    return count;
}

TEST(Chart, StopsOnCtrlCAndGoesOnFromThere) {
    const TemporaryFolder here;
    const fs::path table = here / "chart/contacts.csv";
    const std::vector<std::string> words = {"chart", "accuracy", "--quick", "--out", "chart"};
    const auto run_until = [&](std::size_t lines) {
        Program program(words, {here.path(), {}, 0});
        while (lines_in(table) < lines && program.running())
            std::this_thread::sleep_for(std::chrono::milliseconds(5));
        program.send(SIGINT);
        return program.wait();
    };
    const Ended first = run_until(6);
    EXPECT_EQ(first.status, 130);
    EXPECT_THAT(first.err, HasSubstr("the same command goes on"));
    const std::size_t had = lines_in(table);
    EXPECT_GE(had, 6u);
    const Ended second = run_until(had + 4);
    EXPECT_EQ(second.status, 130);
    EXPECT_GE(lines_in(table), had + 4);
    std::ifstream in(table);
    std::string line, repeated;
    std::getline(in, line);
    std::getline(in, line);
    for (const std::string once = line; std::getline(in, line);)
        if (line == once) repeated = line;
    EXPECT_EQ(repeated, "") << "what was there was made again";
}

TEST(Chart, RefusesAFolderOfSomethingElse) {
    const TemporaryFolder here;
    fs::create_directories(here / "chart");
    std::ofstream(here / "chart/contacts.csv") << "not,ours\n";
    Program program({"chart", "accuracy", "--out", "chart"}, {here.path(), {}, 0});
    const Ended end = program.wait();
    EXPECT_EQ(end.status, 2);
    EXPECT_THAT(end.err, tells({"not a table", "move it", "--out"}));
    EXPECT_EQ(lines_in(here / "chart/contacts.csv"), 1u);
    Program unknown({"chart", "beauty"}, {here.path(), {}, 0});
    EXPECT_EQ(unknown.wait().status, 2);
}

}  // namespace
}  // namespace grainreel
