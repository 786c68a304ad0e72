// Remembers the first failure while the remaining work is still tried, so that a failed run keeps as much as
// it can.
#pragma once

#include <exception>
#include <new>
#include <string>

namespace grainreel {

// What a failure says. The library's own word for used up memory tells users nothing.
inline std::string words_of(const std::exception& failure) {
    if (dynamic_cast<const std::bad_alloc*>(&failure) == nullptr) return failure.what();
    return "not enough memory: all that the machine or a limit (ulimit -v) gives is used up; take fewer "
           "grains, "
           "or a machine with more";
}

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

}  // namespace grainreel
