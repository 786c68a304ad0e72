// UserError and RunError are the two ways in which a run can fail, and FirstFailure remembers such a failure.
// Everything else is a bug, for which GRAINREEL_CHECK ends the process. Keep this header light: nearly all
// files include it.
#pragma once

#include <fmt/core.h>
#include <exception>
#include <new>
#include <stdexcept>
#include <string>
#include <utility>

namespace grainreel {

// What both say, given as a text or as the arguments of fmt::format().
class Failure : public std::runtime_error {
  public:
    explicit Failure(const std::string& text) : std::runtime_error(text) {}
    template <class First, class... Rest>
    Failure(fmt::format_string<First, Rest...> text, First&& first, Rest&&... rest)
        : std::runtime_error(fmt::format(text, std::forward<First>(first), std::forward<Rest>(rest)...)) {}
};

// A mistake in the user's input. what() is the whole line to print:
// "scene.toml:12:5: what is wrong; what to do". The program ends with exit code 2.
class UserError : public Failure {
  public:
    using Failure::Failure;
};

// A run that cannot continue: it became unstable, or the disk is full. what() says where, what and the
// remedy. The program ends with exit code 1.
class RunError : public Failure {
  public:
    using Failure::Failure;
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
