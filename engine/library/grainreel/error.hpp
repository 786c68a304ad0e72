/// @file
/// What goes wrong, as an exception.
#pragma once

#include <stdexcept>
#include <string>

#include "grainreel/version.hpp"

namespace grainreel::v1 {

/// The one exception of this library. what() is the whole line for a user:
/// "scene.toml:12:5: what is wrong; what to do". Exceptions that your own functions throw come through as
/// they are. The library never ends the process, but for a bug of its own, which fails a check.
class [[gnu::visibility("default")]] Error : public std::runtime_error {
  public:
    /// Who can help.
    enum class Kind {
        mistake,  ///< What was given is wrong: a scene, a file, a setting, an argument.
        failure   ///< What was given is right, and the run failed: it became unstable, the disk is full.
    };

    /// An error of one's own, as a reader of one's own throws it. Where the message begins with a place,
    /// "file:line:column: ", that place is taken from it.
    explicit Error(const std::string& message, Kind kind = Kind::mistake);

    Kind kind() const noexcept {
        return kind_;
    }  ///< Who can help.
    const std::string& file() const noexcept {
        return file_;
    }  ///< The file it is about; empty: none is named.
    int line() const noexcept {
        return line_;
    }  ///< Its line, from 1; 0: none is named.
    int column() const noexcept {
        return column_;
    }  ///< Its column, from 1; 0: none is named.

  private:
    Kind kind_;
    std::string file_;
    int line_ = 0, column_ = 0;
};

}  // namespace grainreel::v1
