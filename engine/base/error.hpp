// UserError and RunError are the two ways in which a run can fail, and FirstFailure remembers such a failure.
// Everything else is a bug, for which GRAINREEL_CHECK ends the process. Keep this header light: nearly all
// files include it.
#pragma once

#include <exception>
#include <new>
#include <stdexcept>
#include <string>

namespace grainreel {

// A mistake in the user's input. what() is the whole line to print:
// "scene.toml:12:5: what is wrong; what to do". The program ends with exit code 2.
class UserError : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

// A run that cannot continue: it became unstable, or the disk is full. what() says where, what and the
// remedy. The program ends with exit code 1.
class RunError : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

// What a failure says. The standard library's words for memory that is used up tell users nothing.
inline std::string words_of(const std::exception& failure) {
    if (dynamic_cast<const std::bad_alloc*>(&failure) == nullptr) return failure.what();
    return "not enough memory: all that the machine or a limit (ulimit -v) gives is used up; take fewer "
           "grains, "
           "or a machine with more";
}

// Remembers the first failure while the remaining work is still tried, so that a failed run keeps as much as
// it can.
class FirstFailure {
  public:
    void note(const std::string& what) {
        if (what_.empty()) what_ = what;
    }
    template <class Action>
    void attempt(const Action& action) {
        try {
            action();
        } catch (const std::exception& problem) {
            note(words_of(problem));
        }
    }
    bool any() const { return !what_.empty(); }
    const std::string& what() const { return what_; }

  private:
    std::string what_;
};

// Prints that a condition of the program itself does not hold, and ends the process.
[[noreturn]] void check_failed(const char* condition, const char* file, int line);

}  // namespace grainreel

#define GRAINREEL_CHECK(condition) \
    ((condition) ? void(0) : ::grainreel::check_failed(#condition, __FILE__, __LINE__))
