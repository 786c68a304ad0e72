// What libFuzzer calls. $GRAINREEL_FUZZ names the target; tests/fuzz/run starts it.
#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>

#include "tests/fuzz/damage.hpp"
#include "tests/fuzz/targets.hpp"

// From libFuzzer.
extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t most);

namespace {

void (*attempt)(std::string_view) = nullptr;

}  // namespace

extern "C" int LLVMFuzzerInitialize(int*, char***) {
    const char* name = std::getenv("GRAINREEL_FUZZ");
    for (const grainreel::fuzz::Target& target : grainreel::fuzz::targets())
        if (name != nullptr && std::strcmp(name, target.name) == 0) attempt = target.attempt;
    if (attempt != nullptr) return 0;
    std::fputs("set GRAINREEL_FUZZ to the name of a target, see tests/fuzz/run\n", stderr);
    std::exit(2);
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    attempt({reinterpret_cast<const char*>(data), size});
    return 0;
}

// Half of the changes are those of libFuzzer.
extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t most,
                                               unsigned seed) {
    if (seed % 2 == 0) return LLVMFuzzerMutate(data, size, most);
    std::mt19937 random(seed);
    std::string bytes(reinterpret_cast<const char*>(data), size);
    grainreel::fuzz::damage(bytes, random);
    const std::size_t kept = std::min(bytes.size(), most);
    std::memcpy(data, bytes.data(), kept);
    return kept;
}
