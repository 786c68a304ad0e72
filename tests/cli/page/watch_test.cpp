// Tests of `grainreel watch` and `movie --watch` as a user sees them, only by connections of this machine.
// What the page does in a browser is tested in tests/browser.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <csignal>
#include <thread>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "render/page/live/server.hpp"
#include "render/page/live/watch.hpp"
#include "tests/cli/page/http.hpp"
#include "tests/cli/program.hpp"
#include "tests/support/small_scene.hpp"
#include "tests/support/tells.hpp"
#include "tests/support/temporary_folder.hpp"

namespace grainreel {
namespace {

namespace fs = std::filesystem;
using namespace test;
using Json = nlohmann::json;
using testing::HasSubstr;
using testing::Not;

// A port that was free just now.
int free_port() {
    return Listening("127.0.0.1", 0).port();
}

// A run that somebody watches.
class Watched : public testing::Test {
  protected:
    void make_run(const std::vector<std::string>& more = {}) {
        write_small_scene(here.path());
        std::vector<std::string> words = {"movie", "fifty.toml", "--out", "run", "--no-report"};
        words.insert(words.end(), more.begin(), more.end());
        const Ended ended = run_program(words, {here.path(), {}});
        ASSERT_EQ(ended.status, 0) << ended.err;
    }

    void watch(const std::vector<std::string>& more = {}) {
        port = free_port();
        std::vector<std::string> words = {"watch", "run", "--port", std::to_string(port)};
        words.insert(words.end(), more.begin(), more.end());
        program.emplace(words, Program::Setting{here.path(), {}});
        ASSERT_TRUE(wait_until(*program, [&] { return get(port, "/live/state", host).status != 0; }))
            << program->wait().err;
    }

    Json state() { return Json::parse(get(port, "/live/state").body); }

    TemporaryFolder here;
    std::optional<Program> program;
    int port = 0;
    std::string host;
};

TEST_F(Watched, ShowsWhatThereIs) {
    make_run();
    watch();
    const Json now = state();
    EXPECT_EQ(now["stage"], "complete");
    EXPECT_EQ(now["done"], 1.0);
    EXPECT_NEAR(now["time"].get<double>(), 0.2, 1e-6);
    EXPECT_TRUE(now["over"]);

    const HttpAnswer page = get(port, "/");
    EXPECT_EQ(page.status, 200);
    EXPECT_THAT(page.body, HasSubstr("<h1>Fifty grains</h1>"));
    EXPECT_THAT(page.head, HasSubstr("Content-Security-Policy: default-src 'none'"));
    EXPECT_THAT(page.head, HasSubstr("frame-ancestors 'none'"));

    EXPECT_EQ(get(port, "/live/picture").body.substr(0, 2), "\xff\xd8");  // a JPEG
    const Json measures = Json::parse(get(port, "/live/measures").body);
    EXPECT_EQ(measures["columns"][0]["name"], "time_s");
    EXPECT_NEAR(measures["values"][0].back().get<double>(), 0.2, 1e-6);

    const std::string bed = get(port, "/live/bed").body;
    const auto byte = [&](std::size_t k) { return static_cast<unsigned char>(bed.at(k)); };
    const std::size_t length = byte(0) | byte(1) << 8 | byte(2) << 16;
    const Json facts = Json::parse(bed.substr(4, length));
    EXPECT_EQ(facts["grains"], 50);
    EXPECT_NEAR(facts["times"].back().get<double>(), 0.2, 1e-6);

    const HttpAnswer file = get(port, "/measures.csv");
    EXPECT_EQ(file.body, text_of(here / "run/measures.csv"));
    EXPECT_THAT(file.head, HasSubstr("text/csv"));

    program->send(SIGINT);
    const Ended ended = program->wait();
    EXPECT_EQ(ended.status, 130);
    EXPECT_THAT(ended.err, HasSubstr(fmt::format("http://127.0.0.1:{}/", port)));
}

TEST_F(Watched, GivesNothingFromOutsideTheRun) {
    make_run();
    write_text(here / "secret.txt", "nobody is to see this");
    fs::create_symlink(here / "secret.txt", here / "run/link.txt");
    ASSERT_EQ(::mkfifo((here / "run/pipe").c_str(), 0600), 0);
    watch();
    for (const char* path : {"/../secret.txt", "/%2e%2e/secret.txt", "/..%2fsecret.txt", "/link.txt", "/pipe",
                             "/.lock", "/checkpoints", "/checkpoints/", "/checkpoints/../run.json",
                             "//etc/passwd", "/nothing", "/live/nothing"}) {
        const HttpAnswer answer = get(port, path);
        EXPECT_EQ(answer.status, 404) << path;
        EXPECT_THAT(answer.body, Not(HasSubstr("nobody"))) << path;
    }
    EXPECT_EQ(get(port, "/run.json").status, 200);
}

// Another page whose name leads to this machine asks under that name.
TEST_F(Watched, RefusesAForeignHost) {
    make_run();
    watch();
    const std::vector<std::string> foreign = {"evil.example", "evil.example:" + std::to_string(port),
                                              "127.0.0.1", "127.0.0.1:1", "-"};
    for (const std::string& name : foreign) {
        const HttpAnswer answer = get(port, "/measures.csv", name);
        EXPECT_EQ(answer.status, 403) << name;
        EXPECT_THAT(answer.body, Not(HasSubstr("time_s")));
    }
    EXPECT_EQ(get(port, "/measures.csv", "LOCALHOST:" + std::to_string(port)).status, 200);
    const Visitor old(port);
    old.send("GET /measures.csv HTTP/1.0\r\n\r\n");  // without a header Host
    EXPECT_EQ(parsed(old.receive()).status, 403);
}

// Which of two hosts counts is not said anywhere, so a request that names two is not answered.
TEST_F(Watched, RefusesTwoHosts) {
    make_run();
    watch();
    const std::string own = fmt::format("127.0.0.1:{}", port);
    for (const std::string& other : {std::string("evil.example"), own}) {
        EXPECT_EQ(get(port, "/measures.csv", own, "Host: " + other + "\r\n").status, 400);
        EXPECT_NE(get(port, "/measures.csv", other, "hOST: " + own + "\r\n").status, 200);
    }
}

TEST_F(Watched, IsForReadingAlone) {
    make_run();
    watch();
    for (const char* method : {"POST", "PUT", "DELETE", "OPTIONS", "PATCH"}) {
        const Visitor visitor(port);
        visitor.send(fmt::format(
            "{} /measures.csv HTTP/1.1\r\nHost: 127.0.0.1:{}\r\nContent-Length: 0\r\n\r\n", method, port));
        EXPECT_EQ(parsed(visitor.receive(5, 2000)).status, 405) << method;
    }
    EXPECT_EQ(get(port, "/measures.csv").status, 200);
}

// The other side closes long before the whole request has come.
TEST_F(Watched, CutsOffWhatIsTooLarge) {
    make_run();
    watch();
    const std::string piece(1 << 20, 'x');
    const std::string host_line = fmt::format("Host: 127.0.0.1:{}\r\n", port);
    for (const std::string& head : {"POST / HTTP/1.1\r\n" + host_line + "Content-Length: 1000000000\r\n\r\n",
                                    "GET / HTTP/1.1\r\n" + host_line + "Content-Length: 1000000000\r\n\r\n",
                                    "GET / HTTP/1.1\r\n" + host_line + "Cookie: "}) {
        const Visitor visitor(port);
        visitor.send(head);
        int sent = 0;
        while (sent < 1000 && visitor.send(piece)) ++sent;
        EXPECT_LT(sent, 100) << head;
    }
    EXPECT_EQ(get(port, "/live/state").status, 200);
}

TEST(Visitors, AnAddressForOthersTakesAKeyOnce) {
    Visitors visitors("Hall.example", 8000, true);
    EXPECT_TRUE(visitors.knows_host("hall.example:8000"));
    EXPECT_FALSE(visitors.knows_host("localhost:8000"));
    const std::string address = visitors.address();
    const std::string key = address.substr(address.find("key=") + 4);
    EXPECT_THAT(address, HasSubstr("http://hall.example:8000/?key="));
    EXPECT_EQ(key.size(), 32u);
    EXPECT_FALSE(visitors.admitted(""));
    EXPECT_FALSE(visitors.admit("") || visitors.admit(key.substr(1)) || visitors.admit(std::string(32, '0')));
    const auto token = visitors.admit(key);
    ASSERT_TRUE(token);
    EXPECT_NE(*token, key);
    EXPECT_FALSE(visitors.admit(key)) << "good once";
    EXPECT_NE(visitors.address(), address);
    EXPECT_TRUE(visitors.admitted("theme=dark; grainreel=" + *token));
    EXPECT_FALSE(visitors.admitted("grainreel=" + key));
    EXPECT_FALSE(visitors.admitted("xgrainreel=" + *token));
    EXPECT_TRUE(Visitors("127.0.0.1", 8000, false).admitted(""));
}

TEST_F(Watched, MistakesAreOneLineAndStatusTwo) {
    make_run();
    const Listening taken("127.0.0.1", 0);
    const std::string port_taken = std::to_string(taken.port());
    const auto expect_mistake = [&](const std::vector<std::string>& words, const std::string& said) {
        const Ended ended = run_program(words, {here.path(), {}});
        EXPECT_EQ(ended.status, 2) << ended.err;
        EXPECT_THAT(ended.err, HasSubstr(said));
        EXPECT_EQ(std::count(ended.err.begin(), ended.err.end(), '\n'), 1) << ended.err;
    };
    const std::string in_use = "port " + port_taken + ": another program has it";
    expect_mistake({"watch", "run", "--port", port_taken}, in_use);
    expect_mistake({"movie", "fifty.toml", "--out", "new", "--watch", port_taken}, in_use);
    EXPECT_FALSE(fs::exists(here / "new"));
    expect_mistake({"watch", "nowhere"}, "nowhere: no such folder");
    expect_mistake({"watch", "fifty.toml"},
                   "fifty.toml: is a file; give the folder of a run, or run the scene: grainreel movie "
                   "fifty.toml");
    fs::create_directory(here / "empty");
    expect_mistake({"watch", "empty"}, "empty: holds no run");
    expect_mistake({"watch", "run", "--port", "high"}, "--port high: is no port");
    expect_mistake({"watch", "run", "--port", "65536"}, "is no port");
    expect_mistake({"watch", "run", "--watch-host", "0.0.0.0"}, "stands for every address");
    expect_mistake({"movie", "fifty.toml", "--watch", "high"}, "--watch high: is no port");
}

TEST_F(Watched, ARunThatVanishesEndsIt) {
    make_run();
    watch();
    EXPECT_EQ(state()["stage"], "complete");
    fs::remove_all(here / "run");
    ASSERT_TRUE(wait_until(*program, [&] { return state()["stage"] == "gone"; }));
    const Ended ended = program->wait();
    EXPECT_EQ(ended.status, 1);
    EXPECT_THAT(ended.err, tells({"run", "folder has gone"}));
}

std::size_t open_files(const fs::path& process) {
    return static_cast<std::size_t>(
        std::distance(fs::directory_iterator(process / "fd"), fs::directory_iterator()));
}

// Finds the process with these words in its command line.
fs::path process_with(const std::string& words) {
    for (const auto& entry : fs::directory_iterator("/proc")) {
        std::string line = text_of(entry.path() / "cmdline");
        std::replace(line.begin(), line.end(), '\0', ' ');
        if (line.find(words) != std::string::npos) return entry.path();
    }
    return {};
}

// A hundred visitors send nothing, or take nothing of what they asked for. Others are answered meanwhile, and
// when all have gone nothing of them is left.
TEST_F(Watched, SlowVisitorsHoldUpNobody) {
    make_run();
    watch();
    const fs::path process = process_with(fmt::format("watch run --port {}", port));
    ASSERT_FALSE(process.empty());
    get(port, "/live/state");
    const std::size_t files = open_files(process);
    {
        std::vector<Visitor> slow;
        for (int k = 0; k < 100; ++k) {
            slow.emplace_back(port);
            const std::string begun = fmt::format("GET / HTTP/1.1\r\nHost: 127.0.0.1:{}\r\n", port);
            slow.back().send(k % 2 == 0 ? begun : begun + "\r\n");
        }
        std::vector<std::thread> quick;
        std::atomic<int> answered = 0;
        for (int k = 0; k < 10; ++k)
            quick.emplace_back([&] {
                for (int n = 0; n < 10; ++n) answered += get(port, "/live/state").status == 200;
            });
        for (std::thread& one : quick) one.join();
        EXPECT_EQ(answered, 100);
    }
    EXPECT_TRUE(wait_until(*program, [&] { return open_files(process) <= files; })) << open_files(process);
}

TEST_F(Watched, AMovieShowsItselfWhileItRuns) {
    write_small_scene(here.path());
    port = free_port();
    Program movie({"movie", "fifty.toml", "--out", "run", "--duration", "60s", "--threads", "1", "--watch",
                   std::to_string(port)},
                  {here.path(), {}});
    // Asks in the middle of the run, as a browser would.
    Json seen;
    ASSERT_TRUE(wait_until(movie, [&] {
        const HttpAnswer answer = get(port, "/live/state");
        if (answer.status != 200) return false;
        seen = Json::parse(answer.body);
        return seen["stage"] == "running" && seen["bed"].get<int>() > 0 && seen["picture"].get<int>() > 0;
    })) << movie.wait().err;
    EXPECT_GT(seen["done"].get<double>(), 0);
    EXPECT_LT(seen["done"].get<double>(), 1);
    EXPECT_EQ(get(port, "/live/picture").body.substr(0, 2), "\xff\xd8");
    movie.send(SIGINT);
    const Ended ended = movie.wait();
    EXPECT_EQ(ended.status, 130) << ended.err;
    EXPECT_EQ(get(port, "/live/state").status, 0) << "it ends with the run";
}

}  // namespace
}  // namespace grainreel
