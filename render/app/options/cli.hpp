// CLI11 as the verbs use it, in every version from 2.1 on. Files of this room include CLI11 through this
// header, which is precompiled: CLI11 alone takes a compiler four seconds.
#pragma once

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <CLI/Validators.hpp>
#include <CLI/Version.hpp>
#if __has_include(<CLI/ExtraValidators.hpp>)  // CLI11 2.6 moved IsMember there
#include <CLI/ExtraValidators.hpp>
#endif
