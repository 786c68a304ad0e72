// Gives a target the files of folders, and damaged copies of each: without libFuzzer, in any build.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iterator>

#include "tests/fuzz/damage.hpp"
#include "tests/fuzz/targets.hpp"

namespace {

namespace fs = std::filesystem;
using grainreel::fuzz::Target;

std::vector<fs::path> files_of(const fs::path& path) {
    if (!fs::is_directory(path)) return {path};
    std::vector<fs::path> files;
    for (const fs::directory_entry& entry : fs::directory_iterator(path))
        if (entry.is_regular_file()) files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    return files;
}

std::string bytes_of(const fs::path& file) {
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

// The name of what is being read is said before it ends the process.
void replay(const Target& target, const fs::path& file, int copies) {
    const std::string whole = bytes_of(file);
    std::printf("%s %s\n", target.name, file.filename().c_str());
    std::fflush(stdout);
    target.attempt(whole);
    std::mt19937 random(1);
    for (int k = 0; k < copies; ++k) {
        std::string bytes = whole;
        for (auto times = 1 + random() % 3; times > 0; --times) grainreel::fuzz::damage(bytes, random);
        target.attempt(bytes);
    }
}

}  // namespace

int main(int count, char** words) {
    if (count < 4) {
        std::fputs("usage: fuzz_replay TARGET COPIES FILE|FOLDER...\n", stderr);
        return 2;
    }
    for (const Target& target : grainreel::fuzz::targets()) {
        if (std::strcmp(target.name, words[1]) != 0) continue;
        std::size_t read = 0;
        for (int at = 3; at < count; ++at)
            for (const fs::path& file : files_of(words[at])) {
                replay(target, file, std::atoi(words[2]));
                ++read;
            }
        std::printf("%zu files\n", read);
        return read > 0 ? 0 : 1;
    }
    std::fprintf(stderr, "there is no target \"%s\"\n", words[1]);
    return 2;
}
