// Runs this program once more, as a child process, and reads what the child writes to stderr.
#pragma once

#include <sys/types.h>

#include <string>
#include <vector>

namespace grainreel {

class Child {
  public:
    // words: the arguments after the program's name. The child's stdin and stdout are /dev/null. It has a
    // process group of its own, so that Ctrl-C reaches only us, and gets SIGTERM when we are killed. Throws
    // RunError when no process can be made.
    explicit Child(const std::vector<std::string>& words);
    ~Child();  // kills the child if it still runs
    Child(Child&& other) noexcept;
    Child& operator=(Child&& other) noexcept;

    int file() const { return pipe_; }  // file descriptor to poll; -1 once the child has ended
    // Gives the lines that have come since the last call, without their ends. When the child has closed its
    // stderr this waits for its end; ended() is true then.
    std::vector<std::string> read();
    bool ended() const { return process_ < 0; }
    int status() const { return status_; }  // exit status; 128 + the signal's number when a signal ended it
    void send(int signal) const;

  private:
    void reap();

    pid_t process_ = -1;
    int pipe_ = -1, status_ = -1;
    std::string rest_;  // beginning of a line that has not ended yet
};

// The path of this program.
std::string own_program();

}  // namespace grainreel
