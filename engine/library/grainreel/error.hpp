/// @file
/// The exception for everything that goes wrong.
#pragma once

#include <stdexcept>
#include <string>

#include "grainreel/version.hpp"

namespace grainreel::v1 {

/// The one exception of this library. what() is the whole line for a user:
/// "scene.toml:12:5: what is wrong; what to do". Exceptions that your own functions throw come through as
/// they are. The library never ends the process, unless a bug of its own fails a check.
class [[gnu::visibility("default")]] Error : public std::runtime_error {
  public:
    /// What kind of error it is.
    enum class Kind {
        mistake,  ///< The input is wrong: a scene, a file, a setting, an argument.
        failure   ///< The input is right, but the run failed: it became unstable, or the disk is full.
    };

    /// An error of your own, for example from your reader. If the message begins with a place,
    /// "file:line:column: ", "file:line: " or "file: ", that place is taken from it. In the last form the
    /// name must have a folder or an extension, so that it is known as a file.
    explicit Error(const std::string& message, Kind kind = Kind::mistake);

    Kind kind() const noexcept {
        return kind_;
    }  ///< What kind of error it is.
    const std::string& file() const noexcept {
        return file_;
    }  ///< The file with whose name the message begins; empty if it begins with anything else, such as a
       ///< setting ("setting film.size: ..."), an argument or a time step.
    int line() const noexcept {
        return line_;
    }  ///< The line in that file, from 1; 0: none is named.
    int column() const noexcept {
        return column_;
    }  ///< The column in that line, from 1; 0: none is named.

  private:
    Kind kind_;
    std::string file_;
    int line_ = 0, column_ = 0;
};

}  // namespace grainreel::v1
