#include "engine/base/system/own_files.hpp"

#include <cstdlib>
#include <system_error>

#include "engine/base/plain_file.hpp"

namespace grainreel {

namespace {

// In an archive the program is lib/grainreel/grainreel.
std::filesystem::path find_own_files() {
    std::error_code none;
    const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe", none);
    const std::filesystem::path top = program.parent_path().parent_path().parent_path();
    const std::filesystem::path folder = top / "share" / "grainreel";
    const bool unpacked =
        !none && program == top / "lib" / "grainreel" / "grainreel" && is_there(folder / "files");
    return unpacked ? folder : std::filesystem::path();
}

// A file that the user named counts, if it is there: variables outlive what they were set for.
void set_file(const char* variable, const std::filesystem::path& file) {
    constexpr int replace = 1;
    const char* users = std::getenv(variable);
    if (users == nullptr || !is_there(users)) ::setenv(variable, file.c_str(), replace);
}

}  // namespace

const std::filesystem::path& own_files() {
    static const std::filesystem::path folder = find_own_files();
    return folder;
}

void use_own_files() {
    if (own_files().empty()) return;
    set_file("UDUNITS2_XML_PATH", own_files() / "units" / "udunits2.xml");
    set_file("FONTCONFIG_FILE", own_files() / "fonts.conf");
}

}  // namespace grainreel
