// A process with all that it starts, which does not outlive us. A guard stands between: a small process that
// waits for the program's end or for ours, adopts what the program leaves behind, and ends all of it.
//
// We may be killed by a signal that nobody can catch: the guard sees it at a pipe that closes then. Is the
// guard killed, the program gets SIGTERM, which mpirun passes on to its ranks.
#pragma once

#include <sys/types.h>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace grainreel {

class GuardedProcess {
  public:
    // words: the program's full path and its arguments. It works in `folder`, reads nothing, and both its
    // outputs go to the end of the file `output`. Ctrl-C of the terminal does not come to it. Throws RunError
    // where no process can be made.
    GuardedProcess(const std::vector<std::string>& words, const std::filesystem::path& folder,
                   const std::filesystem::path& output);
    // Ends what still runs, and waits for that: two seconds at most.
    ~GuardedProcess();
    GuardedProcess(const GuardedProcess&) = delete;
    GuardedProcess& operator=(const GuardedProcess&) = delete;

    // The exit status, 128 and the signal where one ended it; none while it runs. Throws RunError where the
    // guard was killed.
    std::optional<int> status();
    // Asks it to end: SIGTERM, and after two seconds SIGKILL to all of its processes. Returns at once.
    void stop();

  private:
    void reap();

    pid_t guard_ = -1;
    int alive_ = -1, result_ = -1;  // ends of pipes: the guard sees the first close, and writes to the second
    std::optional<int> status_;
};

}  // namespace grainreel
