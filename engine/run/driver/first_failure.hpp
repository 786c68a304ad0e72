// Remembers the first failure while the remaining work is still tried, so that a failed run keeps as much as
// it can.
#pragma once

#include <exception>
#include <string>

namespace grainreel {

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
            note(problem.what());
        }
    }
    bool any() const { return !what_.empty(); }
    const std::string& what() const { return what_; }

  private:
    std::string what_;
};

}  // namespace grainreel
