// Values that take precedence over those of a scene file, and who said them.
#pragma once

#include <initializer_list>
#include <string>
#include <vector>

namespace grainreel {

struct Assignment {
    Assignment(std::string assignment, std::string said_by = "")
        : text(std::move(assignment)), option(std::move(said_by)) {}
    Assignment(const char* assignment) : text(assignment) {}

    std::string text;    // "drive.frequency=30 Hz"
    std::string option;  // that was typed, "--size"; empty: --set

    std::string key() const;    // "drive.frequency"
    std::string value() const;  // "30 Hz"
    std::string place() const;  // for messages: "--size", "--set drive.frequency"
};

// The later of two assignments to one key wins.
class Assignments : public std::vector<Assignment> {
  public:
    using std::vector<Assignment>::vector;
    Assignments(const std::vector<std::string>& all) : std::vector<Assignment>(all.begin(), all.end()) {}
};

}  // namespace grainreel
