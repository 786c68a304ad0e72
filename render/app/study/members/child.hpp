// This program once more, as a process of its own, and what it says on stderr.
#pragma once

#include <sys/types.h>

#include <string>
#include <vector>

namespace grainreel {

class Child {
  public:
    // words: those after the program's name. Its stdin and stdout are /dev/null. It has a process group of
    // its own, so that Ctrl-C comes to us alone, and gets SIGTERM when we are killed. Throws RunError when no
    // process can be made.
    explicit Child(const std::vector<std::string>& words);
    ~Child();  // kills it when it still runs
    Child(Child&& other) noexcept;
    Child& operator=(Child&& other) noexcept;

    int file() const { return pipe_; }  // to poll; -1 once it has ended
    // The lines that have come since, without their ends. Ends the child's life here once it has closed its
    // stderr: ended() holds then.
    std::vector<std::string> read();
    bool ended() const { return process_ < 0; }
    int status() const { return status_; }  // exit status; 128 + signal when one ended it
    void send(int signal) const;

  private:
    void reap();

    pid_t process_ = -1;
    int pipe_ = -1, status_ = -1;
    std::string rest_;  // of a line that has not ended
};

// The path of this program.
std::string own_program();

}  // namespace grainreel
