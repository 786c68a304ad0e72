#include "engine/base/system/program.hpp"

#include <elf.h>
#include <fmt/format.h>
#include <link.h>
#include <sys/stat.h>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string_view>

#include "engine/base/error.hpp"
#include "engine/base/text.hpp"

namespace grainreel {

namespace {

constexpr std::size_t kAligned = 4;  // bytes; the parts of a note begin at multiples of this

std::size_t padded(std::size_t size) {
    return (size + kAligned - 1) / kAligned * kAligned;
}

std::string identity_in(std::string_view notes) {
    ElfW(Nhdr) head;
    while (notes.size() >= sizeof head) {
        std::memcpy(&head, notes.data(), sizeof head);
        const std::size_t name = sizeof head, content = name + padded(head.n_namesz),
                          end = content + padded(head.n_descsz);
        if (end > notes.size()) break;
        if (head.n_type == NT_GNU_BUILD_ID && notes.substr(name, 3) == "GNU") {
            std::string digits;
            for (const char byte : notes.substr(content, head.n_descsz))
                digits += fmt::format("{:02x}", static_cast<unsigned char>(byte));
            return digits;
        }
        notes.remove_prefix(end);
    }
    return "";
}

// Looks at the first object only, which is the program.
int look_at_program(dl_phdr_info* info, std::size_t, void* into) {
    auto& identity = *static_cast<std::string*>(into);
    for (int part = 0; part < info->dlpi_phnum && identity.empty(); ++part) {
        const ElfW(Phdr)& head = info->dlpi_phdr[part];
        if (head.p_type != PT_NOTE) continue;
        identity = identity_in({reinterpret_cast<const char*>(info->dlpi_addr + head.p_vaddr), head.p_memsz});
    }
    return 1;
}

}  // namespace

std::string build_identity() {
    std::string identity;
    dl_iterate_phdr(look_at_program, &identity);
    struct stat facts {};
    if (identity.empty() && ::stat("/proc/self/exe", &facts) == 0)
        identity = fmt::format("{} {}.{}", facts.st_size, facts.st_mtim.tv_sec, facts.st_mtim.tv_nsec);
    return identity;
}

std::string program_call() {
    const char* given = std::getenv("GRAINREEL_CALLED");
    return given == nullptr || *given == '\0' ? "grainreel" : shell_word(given);
}

void check_failed(const char* condition, const char* file, int line) {
    std::fprintf(stderr, "grainreel: bug: %s:%d: %s does not hold\n", file, line, condition);
    std::abort();
}

}  // namespace grainreel
