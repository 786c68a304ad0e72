// Starts a program so that it and all processes that it starts end a few seconds after this process at the
// latest. A small process, the guard, waits for the program's end or for ours, adopts processes that the
// program leaves behind, and ends all of them.
//
// If we are killed by a signal that cannot be caught, a pipe closes and the guard notices. If the guard is
// killed, the program gets SIGTERM, which mpirun passes on to its ranks.
#pragma once

#include <sys/types.h>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace grainreel {

class GuardedProcess {
  public:
    // words: the program's full path and its arguments. It runs in `folder` without input, and both its
    // outputs are added to the file `output`. Ctrl-C in the terminal does not reach it. Throws RunError where
    // no process can be made.
    GuardedProcess(const std::vector<std::string>& words, const std::filesystem::path& folder,
                   const std::filesystem::path& output);
    // Ends what still runs and waits for it. Programs have two seconds to end by themselves.
    ~GuardedProcess();
    GuardedProcess(const GuardedProcess&) = delete;
    GuardedProcess& operator=(const GuardedProcess&) = delete;

    // The exit status, or 128 plus the signal that ended it; none while it runs. Throws RunError where the
    // guard was killed.
    std::optional<int> status();
    // Makes the guard end the program: by SIGTERM, and after two seconds by SIGKILL to all of its processes.
    // Returns at once.
    void stop();

  private:
    void reap();

    pid_t guard_ = -1;
    // Our ends of pipes: the guard notices when the first closes, and writes to the second.
    int alive_ = -1, result_ = -1;
    std::optional<int> status_;
};

}  // namespace grainreel
