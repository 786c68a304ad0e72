// The two ways in which a run can end badly. Anything else that is wrong is a bug and a failed check.
#pragma once

#include <stdexcept>
#include <string>

namespace grainreel {

// A mistake in what the user gave us. what() is the whole line to print:
// "scene.toml:12:5: what is wrong; what to do". The program ends with exit code 2.
class UserError : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

// A run that cannot go on: a blow-up, a full disk. what() says where, what and the remedy. Exit code 1.
class RunError : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

// A broken promise between two parts of the program. Never caught.
[[noreturn]] void check_failed(const char* condition, const char* file, int line);

}  // namespace grainreel

#define GRAINREEL_CHECK(condition) \
    ((condition) ? void(0) : ::grainreel::check_failed(#condition, __FILE__, __LINE__))
