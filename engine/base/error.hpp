// UserError and RunError are the two ways in which a run can fail. Everything else is a bug, for which
// GRAINREEL_CHECK ends the process. Keep this header light: nearly all files include it.
#pragma once

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

// Prints that a condition of the program itself does not hold, and ends the process.
[[noreturn]] void check_failed(const char* condition, const char* file, int line);

}  // namespace grainreel

#define GRAINREEL_CHECK(condition) \
    ((condition) ? void(0) : ::grainreel::check_failed(#condition, __FILE__, __LINE__))
