// The program as its users meet it: started with words, stopped by signals, and read through its outputs.
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "tests/support/temporary_folder.hpp"

namespace grainreel::test {

struct Ended {
    int status = -1;  // exit status; 128 + signal when a signal ended it
    std::string out, err;
};

class Program {
  public:
    struct Setting {
        std::filesystem::path folder = ".";      // where it runs
        std::vector<std::string> environment{};  // NAME=value, in addition to the test's own
        std::size_t file_size_limit = 0;         // bytes, for every file that it writes; 0: none
        std::size_t memory_limit = 0;            // bytes, for its addresses; 0: none
        int seconds_limit = 0;                   // s of processor time, after which SIGXCPU ends it; 0: none
        bool hang_up_ignored =
            false;  // whether SIGHUP is ignored, as under nohup; the test's own setting does not matter
        std::filesystem::path out{};  // takes stdout in place of Ended::out
        bool out_closed = false;      // stdout is a pipe whose reader has ended
    };

    // Starts the program with these words after its name.
    Program(const std::vector<std::string>& words, const Setting& setting);
    ~Program();  // kills what still runs
    Program(const Program&) = delete;
    Program& operator=(const Program&) = delete;

    void send(int signal) const;
    bool running();
    Ended wait();

  private:
    void collect(int status);

    pid_t process_ = -1;
    int status_ = -1;
    const TemporaryFolder folder_;  // its outputs go to files, because a pipe could fill up
    const std::filesystem::path out_ = folder_ / "out", err_ = folder_ / "err";
};

// Starts it and waits for its end.
Ended run_program(const std::vector<std::string>& words, const Program::Setting& setting);

// Waits until `condition` holds or the program has ended. Returns whether it holds.
bool wait_until(Program& program, const std::function<bool()>& condition);

}  // namespace grainreel::test
