// The folder of this process for files that readers are to open. It lies in memory, and goes with the
// process.
#pragma once

#include <cstdlib>
#include <filesystem>
#include <string>
#include <string_view>

#include "tests/support/temporary_folder.hpp"

namespace grainreel::fuzz {

class Scratch {
  public:
    // Indices and imports lie in the folder too.
    Scratch() { ::setenv("XDG_CACHE_HOME", folder_.path().c_str(), 1); }

    // The same file, with other content each time.
    std::filesystem::path write(const std::string& name, std::string_view bytes) const {
        return folder_.write_old(name, bytes);
    }

  private:
    const test::TemporaryFolder folder_{test::TemporaryFolder::Where::memory};
};

inline const Scratch& scratch() {
    static const Scratch one;
    return one;
}

}  // namespace grainreel::fuzz
